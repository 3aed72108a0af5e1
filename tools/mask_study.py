#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What masks do in pictures and over frames: the tables of docs/findings/masks.md.

    tools/mask_study.py pictures [--fast FOLDER] [--seeds N] [--size N] [--spp N,..] [CASE...]
    tools/mask_study.py frames [--seeds N]

pictures: the error of renders with N samples a pixel, before and after the Gaussian of sigma = 1 that the masks were made
for, root mean square against 1,024 samples, mean of N seeds with its 95 % interval; `less` is how much lower the filtered
error is than with void-and-cluster masks. Each seed shifts the tile. Masks of one sample a pixel take N shifts of it for N
samples. FOLDER has FAST's textures, of github.com/electronicarts/fastnoise.

frames: the error of an exponential moving average of frames with a weight of alpha for the newest, when the mask changes from
frame to frame in several ways.

It runs by the Python package of this tree and NumPy."""
import argparse
import os
import tempfile

import numpy as np

import koksma

FILTER, TILE = "gaussian:sigma=1", 128
FIXED = ";pixel=middle;lens=middle;time=middle"  # what a G-buffer gives: the middles of pixels, lens and shutter
MIDDLE = ""  # the pattern of samples in the middle: write_middle
CASES = {  # scene, integrator, patterns of single uses
    "ao-glossy": ("glossy", "ambient-occlusion", ""),
    "ao-glossy-fixed": ("glossy", "ambient-occlusion", FIXED),
    "ao-balls-fixed": ("balls", "ambient-occlusion", FIXED),
    "ao-balls": ("balls", "ambient-occlusion", ""),
    "shadow": ("ball", "distribution", ";pixel=middle"),
    "depth-of-field": ("balls", "distribution", ";pixel=middle;time=middle"),
}


def blur(image):
    """The Gaussian of sigma = 1 as FILTER has it; the image's edge is continued."""
    weights = np.exp(-np.arange(-4, 5)**2 / 2)
    weights /= weights.sum()
    for axis in (0, 1):
        padded = np.pad(image, [(4, 4) if axis == a else (0, 0) for a in (0, 1)], "edge")
        image = sum(w * np.take(padded, range(k, k + image.shape[axis]), axis) for k, w in enumerate(weights))
    return image


def rms(image):
    return float(np.sqrt(np.mean(np.square(image))))


def write_middle(folder):
    """A file of samples in the middle of the square, which MIDDLE then is."""
    global MIDDLE  # pylint: disable=global-statement
    path = os.path.join(folder, "middle.csv")
    with open(path, "w", encoding="utf-8") as file:
        file.write(".5,.5\n" * 256)
    MIDDLE = "file:" + path


def render(case, pattern, spp, seed, size):
    scene, integrator, fixed = CASES[case]
    image = koksma.render(scene, pattern + fixed.replace("middle", MIDDLE), spp=spp, seed=seed, integrator=integrator, size=(size, size),
                          threads=1)
    return image.mean(2, dtype=float) if image.ndim == 3 else image.astype(float)


def reference(case, size):
    return sum(render(case, "sobol:scramble=owen", 256, 1000 + i, size) for i in range(4)) / 4


def make_masks(folder, fast):
    """The patterns by name, and whether each has one sample a pixel."""
    masks = {"independent": ("random", False), "void-and-cluster": ("mask-offset:width=%d" % TILE, False)}
    kinds = (("scalar", "real/real_uniform"), ("vector2", "vector2/vector2_uniform"), ("hemisphere", "sphere/sphere_cosine"))
    for space, of_fast in kinds:
        for maker in ("FAST", "koksma") if fast else ("koksma",):
            path = os.path.join(folder, maker + space + ".npy")
            if maker == "koksma":
                mask = koksma.mask(FILTER, (TILE, TILE), space=space)
            else:
                name = os.path.join(fast, of_fast + "_gauss_1.0.png")
                name = name if os.path.exists(name) else os.path.join(fast, "analysis", of_fast + "_gauss_1.0.png")
                mask = koksma.read_mask(name, space)
            koksma.write_mask(path, mask, space=space)
            masks["%s, %s" % (maker, space)] = ("mask-file:" + path, space != "scalar")
    return masks


def interval(values):
    return 1.984 * np.std(values, ddof=1) / np.sqrt(len(values))


def errors(case, pattern, single, spp, seed, truth):
    if single and spp > 1:
        image = sum(render(case, pattern, 1, seed * spp + i, len(truth)) for i in range(spp)) / spp
    else:
        image = render(case, pattern, spp, seed, len(truth))
    return rms(image - truth), rms(blur(image - truth))


def pictures(options):
    with tempfile.TemporaryDirectory() as folder:
        masks = make_masks(folder, options.fast)
        write_middle(folder)
        for case in options.case or CASES:
            truth = reference(case, options.size)
            for spp in options.spp:
                print("\n%s, %d x %d, %d samples\n| mask | before | after | less |\n|---|---|---|---|" % (case, options.size, options.size, spp))
                compare(case, masks, spp, options.seeds, truth)


def compare(case, masks, spp, seeds, truth):
    base = None
    for name, (pattern, single) in masks.items():
        found = np.array([errors(case, pattern, single, spp, seed, truth) for seed in range(seeds)])
        mean, half = found.mean(0), interval(found[:, 1])
        base = (mean[1], half) if name == "void-and-cluster" else base
        less = ""
        if base:
            ratio = mean[1] / base[0]
            less = "%.1f +- %.1f %%" % (100 - 100 * ratio, 100 * ratio * np.hypot(half / mean[1], base[1] / base[0]))
        print("| %s | %.4f | %.5f +- %.5f | %s |" % (name, mean[0], mean[1], half, less), flush=True)


GOLDEN, PLASTIC = (np.sqrt(5) - 1) / 2, 1.32471795724474602596  # x^2 = 1 - x; x^3 = x + 1
STEP = (1 / PLASTIC, 1 / PLASTIC**2)


def frame_masks(way, first, others, frame, rng):
    """The mask of a frame; `first` has the shape (height, width, numbers)."""
    if way == "one mask":
        return first
    if way == "values shifted by a sequence":  # on the torus of the values
        return (first + frame * np.array([GOLDEN] if first.shape[2] == 1 else STEP)) % 1
    if way == "tile shifted by a sequence":
        return np.roll(first, [int(TILE * (frame * s % 1)) for s in STEP], (0, 1))
    if way == "tile shifted at random":
        return np.roll(first, tuple(rng.integers(TILE, size=2)), (0, 1))
    if way == "independent masks":
        return others[frame % len(others)]
    return rng.random(first.shape)


WAYS = ("one mask", "values shifted by a sequence", "tile shifted by a sequence", "tile shifted at random", "independent masks", "independent noise")
ALPHAS, FRAMES, LAST = (0.1, 0.2), 64, 16  # the error is that of the last frames: (1 - alpha)^48 is below .007


def averages(images):
    """The mean error of single frames and of the last moving averages, before and after the filter, of a stack of errors."""
    rows = [[rms(i) for i in images[-LAST:]], [rms(blur(i)) for i in images[-LAST:]]]
    for alpha in ALPHAS:
        mean, before, after = images[0], [], []
        for frame, image in enumerate(images[1:], 1):
            mean = (1 - alpha) * mean + alpha * image
            if frame >= FRAMES - LAST:
                before.append(rms(mean))
                after.append(rms(blur(mean)))
        rows += [before, after]
    return [np.mean(row) for row in rows]


def frames(options):
    """Over thresholds of scalar masks, and in ambient occlusion by masks of vectors."""
    with tempfile.TemporaryDirectory() as folder:
        write_middle(folder)
        truth = reference("ao-glossy-fixed", TILE)
        print("| | frames | one frame | filtered | average, .1 | filtered | average, .2 | filtered |\n|---|---|---|---|---|---|---|---|")
        for space in ("scalar", "vector2"):
            shape = (TILE, TILE, 1 if space == "scalar" else 2)
            others = [koksma.mask(FILTER, (TILE, TILE), space=space, seed=s).reshape(shape) for s in range(FRAMES)]
            for way in WAYS:
                found = []
                for seed in range(options.seeds):
                    rng = np.random.default_rng(seed)
                    masks = [frame_masks(way, others[seed], others[seed:] + others[:seed], f, rng) for f in range(FRAMES)]
                    if space == "scalar":
                        t = (seed + 0.5) / options.seeds
                        found.append(averages([(m[..., 0] < t) - float(np.mean(m < t)) for m in masks]))
                        continue
                    images = []
                    for mask in masks:
                        path = os.path.join(folder, "frame.npy")
                        koksma.write_mask(path, np.minimum(mask, 1 - 2.0**-24).astype(np.float32))
                        images.append(render("ao-glossy-fixed", "mask-file:" + path, 1, seed, TILE) - truth)
                    found.append(averages(images))
                found = np.array(found)
                mean = np.sqrt(np.mean(found**2, 0)) if space == "scalar" else found.mean(0)
                print("| %s | %s | %s |" % ("thresholds" if space == "scalar" else "ambient occlusion", way, " | ".join("%.4f" % m for m in mean)),
                      flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=("pictures", "frames"))
    parser.add_argument("case", nargs="*")
    parser.add_argument("--fast")
    parser.add_argument("--seeds", type=int, default=0)
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--spp", type=lambda text: [int(n) for n in text.split(",")], default=[1])
    options = parser.parse_intermixed_args()
    options.seeds = options.seeds or {"pictures": 100, "frames": 16}[options.study]
    for case in options.case:
        if case not in CASES:
            parser.error("no case %r; there are %s" % (case, ", ".join(CASES)))
    {"pictures": pictures, "frames": frames}[options.study](options)


if __name__ == "__main__":
    main()
