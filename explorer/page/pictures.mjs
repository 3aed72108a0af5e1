// SPDX-License-Identifier: Apache-2.0
// What the points make of a picture: three scenes, each converged, from the points of each set, and the difference.
import { byId, element, short } from "./dom.mjs";
import { sceneNames } from "./scenes.mjs";

const unknown = "mean error …, RMS …";
const scenesText = {
  "checkerboard": "a checkerboard to the horizon; the points are places in the pixel",
  "zone plate": "rings that narrow to the right; the points are places in the pixel",
  "soft shadow": "the shadow of a leaning card; the points are places on a square light",
};

// Grey values; y is up in the picture and down on the canvas.
function paintGrey(canvas, { width, height }, grey) {
  const image = new ImageData(width, height), rgba = image.data;
  for (let j = 0, k = 0; j < height; j++) {
    for (let i = 0; i < width; i++, k += 4) {
      rgba[k] = rgba[k + 1] = rgba[k + 2] = Math.round(255 * Math.min(Math.max(grey((height - 1 - j) * width + i), 0), 1));
      rgba[k + 3] = 255;
    }
  }
  Object.assign(canvas, { width, height });
  canvas.getContext("2d").putImageData(image, 0, 0);
}

const figure = (caption, label) => {
  const canvas = element("canvas", { class: "picture", role: "img", width: 3, height: 2, "aria-label": label });
  return { canvas, caption, node: element("figure", {}, canvas, element("figcaption", {}, caption)) };
};

export class Pictures {
  constructor() {
    this.scenes = new Map();
    for (const scene of sceneNames) {
      const shown = { converged: figure("converged", `${scene}, converged: ${scenesText[scene]}`), sets: {} };
      const parts = [];
      for (const name of ["a", "b"]) {
        const label = name.toUpperCase(), numbers = element("span", { class: "numbers" }, ""), gain = element("span", {}, "");
        const image = figure(element("span", {}, `set ${label}`), `${scene} from the points of set ${label}`);
        const error = figure(element("span", {}, `error of ${label}`, gain, element("br"), numbers), `${scene}: error of set ${label}`);
        image.node.classList.add("image");
        shown.sets[name] = { image, error, numbers, gain, answer: null };
        parts.push(image.node, error.node);
      }
      this.scenes.set(scene, shown);
      byId("pictures").append(element("div", { class: "scene" }, element("h3", { title: scenesText[scene] }, scene), shown.converged.node, ...parts));
    }
  }

  get names() {
    return [...this.scenes.keys()];
  }

  // answer: null while it is being computed; without a size there is none.
  show(scene, name, answer) {
    const shown = this.scenes.get(scene), set = shown.sets[name];
    set.answer = answer?.error ? null : answer;
    set.numbers.textContent = set.answer ? `mean ${short(answer.mean_error, 3)}, RMS ${short(answer.rms_error, 3)}` : answer?.error || unknown;
    set.error.node.classList.toggle("waiting", !set.answer);
    if (!set.answer) return;
    paintGrey(shown.converged.canvas, answer.size, i => answer.converged[i]);
    paintGrey(set.image.canvas, answer.size, i => answer.values[i]);
    this.drawErrors(shown);
  }

  // Errors of both sets with one gain: four RMS errors of the worse set reach from grey to white.
  drawErrors(shown) {
    const sets = Object.values(shown.sets).filter(set => set.answer && !set.image.node.hidden);
    const worst = Math.max(...sets.map(set => set.answer.rms_error));
    const gain = worst > 0 ? 2 ** Math.min(Math.max(Math.floor(Math.log2(1 / (8 * worst))), 0), 10) : 1;
    for (const set of sets) {
      const { size, values, converged } = set.answer;
      set.gain.textContent = gain > 1 ? ` × ${gain}` : "";
      paintGrey(set.error.canvas, size, i => 0.5 + gain * (values[i] - converged[i]));
    }
  }

  // Which sets there are; why: a reason why there are no pictures, or "".
  choose(names, why) {
    byId("pictures").hidden = Boolean(why);
    byId("pictures-why").textContent = why;
    for (const shown of this.scenes.values()) {
      for (const [name, set] of Object.entries(shown.sets)) {
        set.image.node.hidden = set.error.node.hidden = !names.includes(name);
        if (set.image.node.hidden) set.answer = null;
      }
      this.drawErrors(shown);
    }
  }

  // What is shown, in full: { scene: { a: { mean_error, rms_error, size }, .. }, .. }
  results() {
    return Object.fromEntries([...this.scenes].map(([scene, { sets }]) => [scene,
      Object.fromEntries(Object.entries(sets).filter(([, set]) => set.answer).map(([name, { answer }]) => [name, answer]))]));
  }
}
