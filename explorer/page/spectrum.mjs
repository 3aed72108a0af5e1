// SPDX-License-Identifier: Apache-2.0
// The power spectrum: a picture for each set, and the radial means of all in one chart.
import { element, short } from "./dom.mjs";
import { chart } from "./chart.mjs";
import { limits } from "./state.mjs";

const white = 2; // the power that is drawn white, as `koksma plot --curve power` does

// Frequencies up to these, as the program's: of the picture and rings, and of the quality.
export const halfOf = n => Math.ceil(2 * Math.sqrt(n));
export const halfOfQuality = n => Math.ceil(7 * Math.sqrt(n));

function paint(canvas, { half, power }) {
  const side = 2 * half + 1, image = new ImageData(side, side);
  for (let ky = -half; ky <= half; ky++) {
    for (let kx = -half; kx <= half; kx++) {
      const [x, y] = ky < 0 ? [-kx, -ky] : [kx, ky]; // the power at -k is that at k
      const value = kx || ky ? power[y * side + half + x] : 0;
      const grey = Math.floor(255 * Math.min(value / white, 1) + 0.5), to = 4 * ((half - ky) * side + half + kx);
      image.data.set([grey, grey, grey, 255], to);
    }
  }
  Object.assign(canvas, { width: side, height: side });
  canvas.getContext("2d").putImageData(image, 0, 0);
}

export class Spectrum {
  constructor(name, label) {
    this.name = name;
    this.canvas = element("canvas", { class: "spectrum", role: "img", width: 1, height: 1, "aria-label": `Power spectrum of set ${label}` });
    this.caption = element("figcaption", {}, "");
    this.node = element("figure", {}, this.canvas, this.caption);
    this.rings = null;
  }

  // One coordinate has no plane, and more points than the limit would take too long.
  static reason(set) {
    if (set.dim < 2) return "A power spectrum takes two coordinates.";
    return set.n > limits.spectrum_n ? `A power spectrum is made of up to ${limits.spectrum_n} points here.` : "";
  }

  say(text) {
    this.rings = null;
    this.canvas.hidden = true;
    this.caption.textContent = text;
  }

  // It is being computed: what is known is another set's.
  wait(label) {
    this.rings = null;
    this.canvas.classList.add("waiting");
    this.caption.textContent = `${label}: …`;
  }

  show(label, answer) {
    this.canvas.classList.remove("waiting");
    if (answer.error) return this.say(answer.error);
    this.canvas.hidden = false;
    this.rings = answer.rings;
    paint(this.canvas, answer);
    this.canvas.setAttribute("aria-label",
      `Power spectrum of ${label}: frequencies to ${answer.half}, power 0 is black and ${white} white`);
    this.caption.textContent = `${label}: frequencies to ${answer.half}; power 0 is black, ${white} white`;
  }

  showQuality(answer) {
    if (answer.error || !this.rings) return;
    const part = (name, value) => value === null ? "" : `; ${name} ${short(value)}`;
    this.caption.textContent = this.caption.textContent.split("; effective")[0] + part("effective Nyquist frequency", answer.effective_nyquist) +
      part("over √n/2", answer.relative_nyquist) + part("oscillation", answer.oscillation);
  }
}

export function radialChart(place, spectra) {
  const shown = spectra.filter(s => s.rings);
  chart(place, {
    title: `Radial mean of the power: ${shown.map(s => s.canvas.getAttribute("aria-label")).join("; ")}`,
    x: { title: "frequency", zero: true }, y: { title: "mean power", zero: true }, level: 1,
    series: shown.map(s => ({ className: `set-${s.name}`, line: true, points: s.rings.map(r => [r.frequency, r.power]) })),
  });
}
