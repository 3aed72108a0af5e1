// SPDX-License-Identifier: Apache-2.0
// The core library as WebAssembly: explorer.c's functions, with JavaScript's texts, arrays and errors.

// What the library reports: its own line of text.
export class KoksmaError extends Error {}

// The system that the library sees: a clock, no files, no environment. 8 and 44 are WASI's and musl's "no such thing".
function system(memory, step) {
  const no_file = () => 8, no_entry = () => -44;
  const zeros = (...pointers) => {
    for (const pointer of pointers) new DataView(memory().buffer).setUint32(pointer, 0, true);
    return 0;
  };
  return {
    wasi_snapshot_preview1: {
      // The pointer comes last, behind a precision that is one BigInt or, from other versions of emcc, two numbers.
      clock_time_get: (...values) => {
        new DataView(memory().buffer).setBigUint64(values.at(-1), BigInt(Math.round(performance.now() * 1e6)), true);
        return 0;
      },
      environ_sizes_get: zeros, environ_get: () => 0,
      fd_write: no_file, fd_read: no_file, fd_close: no_file, fd_seek: no_file, fd_pread: no_file, fd_fdstat_get: no_file,
    },
    page: { step },
    env: {
      emscripten_notify_memory_growth: () => {},
      __syscall_fstat64: no_entry, __syscall_stat64: no_entry, __syscall_fstatat64: no_entry, __syscall_lstat64: no_entry,
    },
  };
}

// Starts an instance of a WebAssembly.Module.
export async function openKoksma(module) {
  let onStep = null;
  const instance = await WebAssembly.instantiate(module, system(() => instance.exports.memory, (...values) => onStep(...values)));
  const c = instance.exports;
  c._initialize();
  const maxText = 512;

  const textAt = pointer => {
    const bytes = new Uint8Array(c.memory.buffer);
    return new TextDecoder().decode(bytes.slice(pointer, bytes.indexOf(0, pointer)));
  };
  const fail = () => { throw new KoksmaError(textAt(c.explorer_error()) || "out of memory"); };
  const json = pointer => pointer ? JSON.parse(textAt(pointer)) : fail();
  const numbersAt = (pointer, count) => pointer ? new Float64Array(c.memory.buffer, pointer, count).slice() : fail();
  const say = text => {
    const bytes = new TextEncoder().encode(text);
    if (bytes.length >= maxText) throw new KoksmaError(`a text of ${bytes.length} characters; ${maxText - 1} is the most`);
    const room = new Uint8Array(c.memory.buffer, c.explorer_text_in(), maxText);
    room.set(bytes);
    room[bytes.length] = 0;
  };
  const put = ({ xs, n, dim }) => {
    const pointer = c.explorer_room(n, dim) || fail();
    new Float64Array(c.memory.buffer, pointer, n * dim).set(xs);
  };

  return {
    tables: () => json(c.explorer_tables()),

    // { spec: the canonical text, points: { xs, n, dim } }; seed: a BigInt
    generate({ spec, n, dim, seed }) {
      say(spec);
      const made = json(c.explorer_generate(n, dim, Number(seed & 0xffffffffn), Number(seed >> 32n)));
      return { ...made, points: { xs: numbersAt(c.explorer_points(), n * dim), n, dim } };
    },

    // The points as a .csv file of the program's.
    csv({ points }) {
      put(points);
      return { csv: textAt(c.explorer_csv() || fail()) };
    },

    // { value, value_text, witness, .. } of points
    measure({ points, measure }) {
      put(points);
      say(measure);
      return json(c.explorer_measure());
    },

    // [{ property, subject, holds, value, detail }, ..] of points
    verify({ points }) {
      put(points);
      return json(c.explorer_verify());
    },

    // A void-and-cluster mask: ranks 0 .. size^2 - 1, row after row.
    mask({ size, seed }) {
      const pointer = c.explorer_mask(size, Number(seed & 0xffffffffn), Number(seed >> 32n)) || fail();
      return new Uint32Array(c.memory.buffer, pointer, size * size).slice();
    },

    // The key of a domain (koksma/sampler.h), a BigInt. what: 0: of pixel (x, y) for the seed key, 1: of use x, 2: of sample x,
    // 3: the seed of frame x.
    domain({ what, key, x, y = 0 }) {
      const [low, high] = new Uint32Array(c.memory.buffer, c.explorer_domain(what, Number(key & 0xffffffffn), Number(key >> 32n), x, y), 2);
      return BigInt(high) << 32n | BigInt(low);
    },

    // Samples of a domain. sampler: 0: Sobol, 1: PMJ02, 2: independent.
    samples({ sampler, key, first, count, dim }) {
      return numbersAt(c.explorer_samples(sampler, Number(key & 0xffffffffn), Number(key >> 32n), first, count, dim), count * dim);
    },

    // Power at |kx|, |ky| <= half of the coordinates in axes, rows from ky = 0, and its rings and quality.
    spectrum({ points, half, axes }) {
      put(points);
      const power = numbersAt(c.explorer_spectrum(half, ...axes), (half + 1) * (2 * half + 1));
      return { half, power, ...json(c.explorer_rings()) };
    },

    // Koksma's inequality over two coordinates: { functions: [{ title, dim, variation, error, bound, range }, ..] }
    inequality({ points, axes }) {
      put(points);
      return json(c.explorer_inequality(...axes));
    },

    // Estimates by 15 sets with the seeds from `seed` on: { truth, values, estimates: [{ estimator, interval, value, low, high }, ..] },
    // or { error } where they have no interval.
    replicates({ integrand, spec, n, dim, seed }) {
      say(integrand + "\n" + spec);
      return json(c.explorer_replicates(n, dim, Number(seed & 0xffffffffn), Number(seed >> 32n)));
    },

    // Searches for better points: report({ points, value, lower, steps, last_gain, method }) is called with the first set
    // and after each step, and returns whether to go on. steps: at most so many; 0: without end. brief: a few steps a second.
    optimise({ points, measure, steps = 0, seed, brief = false }, report) {
      const { n, dim } = points;
      put(points);
      say(measure);
      onStep = (xs, value, lower, done, last_gain, method) => report({
        points: { xs: numbersAt(xs, n * dim), n, dim }, value, lower: Number.isNaN(lower) ? null : lower, steps: done, last_gain, method: textAt(method),
      });
      return json(c.explorer_optimise(steps, Number(brief), Number(seed & 0xffffffffn), Number(seed >> 32n)));
    },

    // The slope of log value over log n, and theory's; pairs: [[n, value], ..]
    line({ pairs, measure, pattern, dim }) {
      put({ xs: pairs.flat(), n: pairs.length, dim: 2 });
      say(measure + "\n" + pattern);
      return json(c.explorer_line(pairs.length, dim));
    },
  };
}
