// SPDX-License-Identifier: Apache-2.0
// Requests to the library, answered by a few workers. A request has a key, as there is one place on the page that shows its
// answer; a newer one of the same key takes its place. Smaller ranks go first.
import { openService } from "./service.mjs";

const patience_ms = 150; // a request that is no longer wanted may run on for so long, as starting a worker costs, too
const late_ms = 100; // an answer that comes sooner takes the place of an older one at once, as while a point is dragged

export class Jobs {
  // limit_s: how long an answer may take.
  constructor(module, workerScript, limit_s) {
    Object.assign(this, { module, limit_s, waiting: new Map(), places: [], shown: new Map(), timers: new Map(), serial: 0, inPage: false });
    try {
      this.url = URL.createObjectURL(new Blob([workerScript], { type: "text/javascript" }));
      const count = Math.min(Math.max((navigator.hardwareConcurrency || 2) - 1, 2), 4); // two: quick ones pass slow ones
      for (let i = 0; i < count; i++) this.places.push(this.open({}));
    } catch {
      this.inPage = true; // the page says so
      this.places = [{ service: openService(module) }];
    }
  }

  open(place) {
    place.worker = new Worker(this.url);
    place.worker.postMessage(this.module);
    place.worker.onmessage = ({ data }) => this.answer(place, data);
    place.worker.onerror = event => this.answer(place, { error: event.message || "the worker failed" });
    place.job = null;
    return place;
  }

  // done(answer) is called once, unless the request is replaced or dropped before. late() is called when the page has shown
  // an older answer for late_ms, progress(message) with each that comes before the answer. Not limited are searches, and what
  // the page cannot do without: a machine that is slow to start is not one that failed.
  ask(key, rank, request, done, { limited = true, late = null, progress = null } = {}) {
    for (const place of this.places) {
      if (place.job?.key === key) place.job.stale = true;
    }
    const serial = ++this.serial;
    this.waiting.set(key, { key, rank, request, limited, late, progress, serial, done: this.inOrder(key, serial, done) });
    this.startLate(key, late);
    this.dropStale();
    this.next();
  }

  // An answer that comes after that to a newer request of its key is not shown.
  inOrder(key, serial, done) {
    return answer => {
      if (serial < (this.shown.get(key) || 0)) return;
      this.shown.set(key, serial);
      this.stopLate(key);
      const newer = [this.waiting.get(key), ...this.places.map(place => place.job)]
        .find(job => job?.key === key && job.serial > serial && !job.unwanted);
      if (newer) this.startLate(key, newer.late);
      done(answer);
    };
  }

  startLate(key, late) {
    if (late && !this.timers.has(key)) this.timers.set(key, setTimeout(late, late_ms));
  }

  stopLate(key) {
    clearTimeout(this.timers.get(key));
    this.timers.delete(key);
  }

  // No more answers for keys that begin like this.
  drop(prefix) {
    for (const key of [...this.waiting.keys()]) if (key.startsWith(prefix)) this.waiting.delete(key);
    for (const key of [...this.timers.keys()]) if (key.startsWith(prefix)) this.stopLate(key);
    for (const place of this.places) if (place.job?.key.startsWith(prefix)) place.job.stale = place.job.unwanted = true;
    this.dropStale();
  }

  get busy() {
    return this.waiting.size > 0 || this.places.some(place => place.job && !place.job.unwanted);
  }

  // Stops what runs for nobody, now or when its time is over.
  dropStale() {
    for (const place of this.places) {
      if (!place.worker || !place.job?.stale || place.job.timer) continue;
      const job = place.job;
      job.timer = setTimeout(() => { if (place.job === job) this.restart(place); },
        Math.max(0, patience_ms - (performance.now() - job.started)));
    }
  }

  restart(place) {
    place.worker.terminate();
    this.open(place);
    this.next();
  }

  startClock(place, job) {
    clearTimeout(job.limit);
    if (!job.limited) return;
    job.limit = setTimeout(() => {
      if (place.job !== job) return;
      if (!job.unwanted) job.done({ error: `stopped after ${this.limit_s} seconds`, stopped: true });
      this.restart(place);
    }, this.limit_s * 1000);
  }

  // Another limit, from now on, for what runs, too.
  setLimit(limit_s) {
    this.limit_s = limit_s;
    for (const place of this.places) if (place.worker && place.job) this.startClock(place, place.job);
  }

  next() {
    for (const place of this.places) {
      if (place.job || this.waiting.size === 0) continue;
      const job = [...this.waiting.values()].reduce((a, b) => b.rank < a.rank ? b : a);
      this.waiting.delete(job.key);
      place.job = job;
      job.started = performance.now();
      if (place.worker) {
        this.startClock(place, job);
        place.worker.postMessage(job.request);
      } else {
        setTimeout(async () => this.answer(place, await (await place.service)(job.request)), 0);
      }
    }
  }

  answer(place, data) {
    const job = place.job;
    if (data.progress) {
      if (!job?.stale) job?.progress(data.progress);
      return;
    }
    place.job = null;
    if (job) {
      clearTimeout(job.limit);
      clearTimeout(job.timer);
      if (!job.unwanted) job.done(data);
    }
    this.next();
  }
}
