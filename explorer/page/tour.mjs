// SPDX-License-Identifier: Apache-2.0
// A guided tour: each step sets what the page shows, by its address, and points at a part of it. Keys: Enter on the buttons,
// Escape leaves.
import { byId, element } from "./dom.mjs";

// hash: the state; at: what is pointed at; values: measures whose values the step shows. strata: the step is about the bar
// that chooses strata: it stays at the top of the window, and the step says what each set has. names: what the sets are called.
const steps = [
  { title: "A pixel is a mean", hash: "a=random@16&a.seed=3&strata=none&witness=none", at: ".set-a .plane",
    text: "A renderer takes the mean of a few samples for each pixel, and each sample has a point of the unit square: a place in the pixel, or on a light. These sixteen are independent and random. They leave holes and form clumps: what lies in a hole counts too little, what lies in a clump too much." },
  { title: "Discrepancy", hash: "a=random@16&a.seed=3&strata=none&witness=star", at: ".set-a .plane", values: ["star"],
    text: "A box from the lower left corner should hold as large a share of the points as its area. The star discrepancy is the largest difference of the two, over all such boxes. The box that is drawn is the worst, and the line below the points counts it for you." },
  { title: "Move a point", hash: "a=random@16&a.seed=3&strata=none&witness=star", at: ".set-a .plane", values: ["star"],
    text: "Drag a point into a hole. The value is the exact one at every moment: only a move that changes the worst box can lower it, and then another box is the worst." },
  { title: "Strata", hash: "a=jittered@16&a.seed=1&strata=grid:4x4&witness=star", at: ".set-a .plane", values: ["star"], strata: true,
    text: "Jittered sampling puts one random point into each cell of a grid. Within its cell a point lies anywhere: of sixteen narrow columns some have two points, and some none. Choose “rooks” under Strata, at the top, to see them." },
  { title: "All shapes of cell at once", hash: "a=random@16&a.seed=3&b=sobol:scramble%3Dowen@16&strata=elementary:2,1&witness=star", at: ".set-b .plane", values: ["star"], strata: true, names: ["A, random", "B, Sobol’"],
    text: "Set B is Sobol’s sequence with Owen’s scrambling. Move the slider “Split” at the top: squares, columns, rows, each cell of 1/16 holds one point. Whole cells are then right in every box, which errs only where its border cuts some. Compare the star discrepancy of both sets; the end of the page has how it falls with n." },
  { title: "Koksma’s inequality", hash: "a=random@16&a.seed=3&b=sobol:scramble%3Dowen@16&strata=none&witness=star", at: "#inequality-section",
    text: "Why discrepancy matters: the error of a mean is at most V(f) D*, the variation of the function times the star discrepancy of the points. The table has functions with known integrals: each error stands beside its bound (a function of x alone is bounded by the discrepancy of the x alone). Set B has the smaller bounds, and mostly the smaller errors." },
  { title: "Where the bound ends", hash: "a=random@64&a.seed=3&b=sobol:scramble%3Dowen@64&strata=none&witness=edge", at: "#pictures-section", values: ["star", "edge"],
    text: "Pictures have slanted edges and shadows, whose variation is infinite: the inequality says nothing about them. Look at the errors themselves, now of 64 points each, and at the measure edge, which takes the worst slanted line, drawn in the squares above, instead of the worst box. The pictures follow each point that you move." },
  { title: "Spectra", hash: "a=random@256&a.seed=1&b=poisson-disk:d%3D0.045@256&strata=none&witness=none", at: "#spectrum-section",
    text: "The power spectrum says which frequencies of a picture become error. Random points have the power 1 everywhere. Set B is another pattern now, a Poisson disk, which keeps its points apart: around the middle it is dark, so slow changes over a pixel cost little, and the error goes to where the ring is bright." },
  { title: "Aliasing", hash: "a=regular@16&strata=grid:4x4&witness=none&pixels=equal", at: "#pictures-section",
    text: "The spectrum of the regular grid, below, has isolated spikes. Frequencies of the picture near a spike look like low ones: the zone plate gets rings where there are none, and the floor gets bands. This is aliasing, an error with a shape, which the eye forgives least." },
  { title: "Bands become noise", hash: "a=regular@16&strata=grid:4x4&witness=none", at: "#pictures-section",
    text: "The same grid, shifted at random in each pixel: much the same RMS error in the zone plate, and no false rings. The error has become noise. Good sampling patterns do both: a small error, and one without a shape. Finish shows the first two sets again: try any pattern." },
];

export class Tour {
  // go(hash) sets the state; text(measure, set): its value as shown, or ""
  constructor(go, text) {
    Object.assign(this, { go, text, step: -1, pointed: null });
    this.title = element("h2", { id: "tour-title", tabindex: -1 });
    this.words = element("p", {});
    this.values = element("p", { class: "values" });
    this.strata = element("p", { class: "values" });
    const button = (label, click) => {
      const node = element("button", { type: "button" }, label);
      node.onclick = click;
      return node;
    };
    this.back = button("Back", () => this.show(this.step - 1));
    this.next = button("Next", () => this.step + 1 < steps.length ? this.show(this.step + 1) : this.finish());
    this.node = byId("tour");
    this.node.append(this.title, this.words, this.values, this.strata, element("div", { class: "buttons" }, this.back, this.next, button("Leave the tour", () => this.leave())));
    byId("start-tour").onclick = () => this.show(0);
    // While answers come the page grows: what is pointed at is kept in sight, until the reader does something.
    for (const act of ["wheel", "touchmove", "pointerdown", "keydown"]) addEventListener(act, () => { this.settling = false; }, { capture: true, passive: true });
    new MutationObserver(() => this.showValues()).observe(byId("sets"), { subtree: true, childList: true });
    new ResizeObserver(() => { if (this.pointed && this.settling) this.scroll(); }).observe(document.querySelector("main"));
    addEventListener("keydown", event => {
      if (event.key === "Escape" && this.step >= 0 && !event.target.closest?.(".plane")) this.leave();
    });
  }

  show(step) {
    const { title, hash, at, text, strata } = steps[step];
    this.step = step;
    this.go(hash);
    this.node.hidden = false;
    document.body.classList.add("touring");
    document.body.classList.toggle("with-strata", Boolean(strata));
    this.title.textContent = `${step + 1} of ${steps.length}: ${title}`;
    this.words.textContent = text;
    this.back.disabled = step === 0;
    this.next.textContent = step + 1 < steps.length ? "Next" : "Finish";
    this.showValues();
    this.settling = true;
    this.point(document.querySelector(at));
    this.title.focus({ preventScroll: true });
  }

  showValues() {
    if (this.step < 0) return;
    const { values = [], strata, names = ["A", "B"] } = steps[this.step];
    const shown = strata ? [...document.querySelectorAll(".set:not([hidden]) .strata-text")].map(node => node.textContent) : [];
    this.strata.textContent = shown.map((text, i) => shown.length > 1 ? `${names[i]}: ${text}` : text).join("; ");
    this.values.textContent = values.map(measure => `${measure}: ` + ["a", "b"].map(set => this.text(measure, set)).filter(Boolean)
      .map((text, i, both) => both.length > 1 ? `${names[i]}: ${text}` : text).join(", ")).join("; ");
  }

  point(node) {
    this.pointed?.classList.remove("pointed");
    this.pointed = node;
    if (!node) return;
    const box = node.getBoundingClientRect();
    this.node.classList.toggle("left", box.left + box.right > innerWidth + 2); // beside what it points at
    node.classList.add("pointed");
    this.scroll();
  }

  scroll() {
    this.pointed.scrollIntoView({ block: innerWidth < 704 || this.pointed.matches("section") || this.pointed.getBoundingClientRect().height > innerHeight / 3 ? "start" : "center" });
  }

  finish() {
    this.go(steps[4].hash);
    this.leave();
  }

  leave() {
    this.step = -1;
    this.node.hidden = true;
    document.body.classList.remove("touring", "with-strata");
    this.point(null);
    byId("start-tour").focus();
  }
}
