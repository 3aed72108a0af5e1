// SPDX-License-Identifier: Apache-2.0
// A worker: the first message is the WebAssembly.Module, each further one a request; one answer each, in order.
import { openService } from "./service.mjs";

let service = null;
self.onmessage = async ({ data }) => {
  if (service) {
    self.postMessage(await (await service)(data));
  } else {
    service = openService(data);
  }
};
