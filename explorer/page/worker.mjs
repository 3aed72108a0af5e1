// SPDX-License-Identifier: Apache-2.0
// A worker: the first message is the WebAssembly.Module, each further one a request; one answer each, in order. A search
// sends { progress } before, ten times a second at most.
import { openService } from "./service.mjs";

let service = null, sent = 0;
const report = progress => {
  if (progress.steps === 0 || performance.now() - sent >= 100) {
    sent = performance.now();
    self.postMessage({ progress });
  }
  return true;
};
self.onmessage = async ({ data }) => {
  if (service) {
    self.postMessage(await (await service)(data, report));
  } else {
    service = openService(data);
  }
};
