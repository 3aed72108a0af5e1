// SPDX-License-Identifier: Apache-2.0
// The comparer: two pictures of a scene flipped, split or subtracted, zoomed, with the values of a pixel.
"use strict";
for (const box of document.querySelectorAll(".comparer")) {
  const width = +box.dataset.width, height = +box.dataset.height;
  const pictures = [...box.querySelectorAll("template")].map(t => {
    const bytes = Uint8Array.from(atob(t.innerHTML), c => c.charCodeAt(0));
    return { name: t.dataset.name, channels: +t.dataset.channels, pixels: new Float32Array(bytes.buffer) };
  });
  const luminance = (p, i) => p.channels === 1 ? p.pixels[i]
    : 0.2126 * p.pixels[3 * i] + 0.7152 * p.pixels[3 * i + 1] + 0.0722 * p.pixels[3 * i + 2];
  const srgb = v => Math.round(255 * (v <= 0.0031308 ? 12.92 * Math.max(v, 0) : Math.min(1, 1.055 * v ** (1 / 2.4) - 0.055)));
  const make = (tag, properties, parent) => parent.appendChild(Object.assign(document.createElement(tag), properties));
  const bar = make("div", { className: "bar" }, box);
  const choose = (text, index) => {
    const label = make("label", { textContent: text + " " }, bar), select = make("select", {}, label);
    pictures.forEach((p, i) => make("option", { textContent: p.name, value: i, selected: i === index }, select));
    return select;
  };
  const left = choose("left (A)", Math.min(1, pictures.length - 1)), right = choose("right (B)", 0);
  const modes = ["flip", "split", "error"];
  const mode = make("select", { ariaLabel: "mode" }, make("label", { textContent: "mode " }, bar));
  modes.forEach(m => make("option", { textContent: m }, mode));
  const zoom = make("select", {}, make("label", { textContent: "zoom " }, bar));
  [1, 2, 4, 8, 16].forEach(z => make("option", { textContent: z, value: z, selected: z === (width <= 160 ? 4 : 2) }, zoom));
  const swap = make("button", { type: "button", textContent: "flip (space)" }, bar);
  const canvas = make("canvas", { tabIndex: 0 }, box);
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "comparer of " + box.dataset.name +
    ": space flips, s, f and e choose the mode, plus and minus zoom, arrows move the pixel");
  const value = make("output", { textContent: "space flips, s f e: mode, + -: zoom, arrows or mouse: a pixel's values" }, box);
  let flipped = false, at = [width >> 1, height >> 1], edge = 0.5;
  const draw = () => {
    const a = pictures[left.value], b = pictures[right.value], z = +zoom.value;
    const image = new ImageData(width, height);
    for (let y = 0, i = 0; y < height; y++) {
      for (let x = 0; x < width; x++, i++) {
        const useB = mode.value === "flip" ? flipped : x >= edge * width;
        const p = useB ? b : a;
        for (let c = 0; c < 3; c++) {
          const e = mode.value === "error" ? 8 * Math.abs(luminance(a, i) - luminance(b, i)) : p.pixels[p.channels === 1 ? i : 3 * i + c];
          image.data[4 * i + c] = srgb(e);
        }
        image.data[4 * i + 3] = 255;
      }
    }
    canvas.width = width;
    canvas.height = height;
    canvas.style.width = width * z + "px";
    canvas.style.maxWidth = z > 1 ? "none" : "100%";
    canvas.getContext("2d").putImageData(image, 0, 0);
  };
  const show = () => {
    const i = at[1] * width + at[0], a = luminance(pictures[left.value], i), b = luminance(pictures[right.value], i);
    value.textContent = `(${at[0]}, ${at[1]}): A ${a.toPrecision(5)}, B ${b.toPrecision(5)}, A - B ${(a - b).toPrecision(3)}` +
      (mode.value === "flip" ? `; shown: ${flipped ? "B" : "A"}` : "");
  };
  const change = () => { draw(); show(); };
  for (const s of [left, right, mode, zoom]) s.addEventListener("change", change);
  swap.addEventListener("click", () => { flipped = !flipped; mode.value = "flip"; change(); });
  canvas.addEventListener("mousemove", event => {
    const r = canvas.getBoundingClientRect();
    at = [Math.min(width - 1, Math.max(0, Math.floor((event.clientX - r.left) / r.width * width))),
      Math.min(height - 1, Math.max(0, Math.floor((event.clientY - r.top) / r.height * height)))];
    if (mode.value === "split") { edge = at[0] / width; draw(); }
    show();
  });
  canvas.addEventListener("keydown", event => {
    const moves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const letter = { f: "flip", s: "split", e: "error" }[event.key];
    if (moves) {
      at = [Math.min(width - 1, Math.max(0, at[0] + moves[0])), Math.min(height - 1, Math.max(0, at[1] + moves[1]))];
      if (mode.value === "split") edge = at[0] / width;
    } else if (letter) {
      mode.value = letter;
    } else if (event.key === " ") {
      flipped = !flipped;
      mode.value = "flip";
    } else if (event.key === "+" || event.key === "-") {
      zoom.selectedIndex = Math.min(4, Math.max(0, zoom.selectedIndex + (event.key === "+" ? 1 : -1)));
    } else {
      return;
    }
    event.preventDefault();
    change();
  });
  draw();
}
