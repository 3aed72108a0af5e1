// SPDX-License-Identifier: Apache-2.0
// What can be asked of the library, in a worker or, where a browser has none for this page, in the page itself.
import { openKoksma } from "./module.mjs";
import { picture } from "./scenes.mjs";

// A function from a request { kind, .. } to its answer; an error is an answer { error }. report(progress): of a search.
export async function openService(module) {
  let koksma = await openKoksma(module);
  const ask = {
    ...koksma,
    picture,
    // A measure of a fresh set of each seed, in one go: what `koksma measure pattern:..@n` gives.
    sample: ({ measure, ...set }) => ({ n: set.n, ...koksma.measure({ points: koksma.generate(set).points, measure }) }),
    // A measure of the first n points.
    prefix: ({ points, n, measure }) => ({
      n, ...koksma.measure({ points: { xs: points.xs.subarray(0, n * points.dim), n, dim: points.dim }, measure }),
    }),
  };
  return async (request, report) => {
    try {
      return ask[request.kind](request, report);
    } catch (error) {
      // After a trap (memory that ran out) the instance is in no known state: another one takes over.
      if (error instanceof WebAssembly.RuntimeError) {
        koksma = Object.assign(ask, await openKoksma(module));
        return { error: `it failed: ${error.message}` };
      }
      return { error: error.message };
    }
  };
}
