// SPDX-License-Identifier: Apache-2.0
// @koksma/koksma: sampling patterns, discrepancies and samples for renderers, for Node, browsers and workers. module.mjs beside
// this file is the module that the Koksma explorer uses; here are its functions with the arguments that a program would give.
import { KoksmaError, openKoksma } from "./module.mjs";

export { KoksmaError };

async function compiled() {
  const address = new URL("./koksma.wasm", import.meta.url);
  if (address.protocol === "file:" && globalThis.process?.versions?.node) {
    const { readFile } = await import("node:fs/promises");
    return WebAssembly.compile(await readFile(address));
  }
  const response = await fetch(address);
  if (!response.ok) throw new KoksmaError(`${address}: ${response.status} ${response.statusText}`);
  return WebAssembly.compile(await response.arrayBuffer());
}

const samplers = { sobol: 0, pmj02: 1, white: 2 };
const whole = (name, value, least, most) => {
  if (!Number.isInteger(value) || value < least || value > most) throw new KoksmaError(`${name} = ${value}: whole numbers from ${least} to ${most}`);
  return value;
};
const u32 = (name, value) => whole(name, value, 0, 2 ** 32 - 1);
const key64 = (name, value) => {
  const good = typeof value === "bigint" ? value >= 0n && value < 1n << 64n : Number.isSafeInteger(value) && value >= 0;
  if (!good) throw new KoksmaError(`${name} = ${value}: whole numbers from 0 to 2^53 - 1, or a BigInt below 2^64`);
  return BigInt(value);
};
const set = points => {
  const { xs, n, dim } = points ?? {};
  if (!xs || !Number.isInteger(n) || !Number.isInteger(dim) || n < 1 || dim < 1 || xs.length !== n * dim)
    throw new KoksmaError("points are { xs, n, dim } with n * dim numbers in xs");
  return { xs, n, dim };
};

// A WebAssembly.Module, or nothing for the file of this package. Each worker opens its own.
export async function open(module) {
  const wasm = module ?? await compiled();
  let k = await openKoksma(wasm), broken = false;
  const reopen = async () => { k = await openKoksma(wasm); broken = false; };
  // After a trap, such as one for memory, the instance is in no known state.
  const call = (name, request) => {
    if (broken) throw new KoksmaError("this instance failed before; await its reopen(), or open another");
    try {
      return k[name](request);
    } catch (error) {
      broken = error instanceof WebAssembly.RuntimeError;
      throw broken ? new KoksmaError(`it failed: ${error.message}`) : error;
    }
  };
  const domain = (what, key, x, y) => call("domain", { what, key: key64("key", key), x: u32("number", x), y: u32("number", y ?? 0) });
  return {
    reopen,
    tables: () => call("tables"),
    generate(spec, { n, dim = 2, seed = 0 }) {
      const made = call("generate", { spec: String(spec), n: u32("n", n), dim: whole("dim", dim, 1, 1 << 20), seed: key64("seed", seed) });
      return { ...made.points, spec: made.spec };
    },
    measure: (points, measure) => call("measure", { points: set(points), measure: String(measure) }),
    verify: points => call("verify", { points: set(points) }),
    csv: points => call("csv", { points: set(points) }).csv,
    mask: (size, { seed = 0 } = {}) => call("mask", { size: whole("size", size, 4, 1024), seed: key64("seed", seed) }),
    domainOfPixel: (seed, x, y) => domain(0, seed, x, y),
    domainOfUse: (key, use) => domain(1, key, use),
    domainOfSample: (key, i) => domain(2, key, i),
    seedOfFrame: (seed, frame) => domain(3, seed, frame),
    samples(sampler, key, { first = 0, count, dim = 2 }) {
      if (!Object.hasOwn(samplers, sampler)) throw new KoksmaError(`sampler "${sampler}": one of ${Object.keys(samplers).join(", ")}`);
      whole("dim", dim, sampler === "pmj02" ? 2 : 1, sampler === "pmj02" ? 2 : 4);
      return call("samples", { sampler: samplers[sampler], key: key64("key", key), first: u32("first", first), count: whole("count", count, 1, 1 << 26), dim });
    },
  };
}

let opened;
export const koksma = () => opened ??= open();
