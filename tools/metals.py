#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The reflectances of metals in src/render/scene/import.c, from published optical constants.

    tools/metals.py           print the rows of the table
    tools/metals.py FILE      compare them with the rows in FILE (exit code 1: they differ)

The reflectance along the normal is R = ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2). Its linear sRGB is that of daylight (CIE D65)
reflected by the metal: XYZ is the integral of R times D65 times the CIE 1931 functions, from 380 to 780 nm in steps of 1 nm,
by the fit of Wyman, Sloan & Shirley 2013; each channel is divided by that of R = 1, so that a perfect mirror is white, and
cut to [0, 1]. The constants, wavelength in nm, n, k, are from refractiveindex.info's database (CC0), commit ff11b58, some
rows of dense tables left out; between rows n and k are linear.
"""
import bisect
import math
import re
import sys

METALS = {  # name in scene files: source, constants
    "Au": ("Johnson & Christy 1972", """
        367.9 1.48 1.895, 381.5 1.46 1.933, 397.4 1.47 1.952, 413.3 1.46 1.958, 430.5 1.45 1.948, 450.9 1.38 1.914,
        471.4 1.31 1.849, 495.9 1.04 1.833, 520.9 0.62 2.081, 548.6 0.43 2.455, 582.1 0.29 2.863, 616.8 0.21 3.272,
        659.5 0.14 3.697, 704.5 0.13 4.103, 756 0.14 4.542, 821.1 0.16 5.083"""),
    "Ag": ("Johnson & Christy 1972", """
        367.9 0.07 1.657, 381.5 0.05 1.864, 397.4 0.05 2.07, 413.3 0.05 2.275, 430.5 0.04 2.462, 450.9 0.04 2.657,
        471.4 0.05 2.869, 495.9 0.05 3.093, 520.9 0.05 3.324, 548.6 0.06 3.586, 582.1 0.05 3.858, 616.8 0.06 4.152,
        659.5 0.05 4.483, 704.5 0.04 4.838, 756 0.03 5.242, 821.1 0.04 5.727"""),
    "Cu": ("Johnson & Christy 1972", """
        367.9 1.36 1.975, 381.5 1.33 2.045, 397.4 1.32 2.116, 413.3 1.28 2.207, 430.5 1.25 2.305, 450.9 1.24 2.397,
        471.4 1.25 2.483, 495.9 1.22 2.564, 520.9 1.18 2.608, 548.6 1.02 2.577, 582.1 0.7 2.704, 616.8 0.3 3.205,
        659.5 0.22 3.747, 704.5 0.21 4.205, 756 0.24 4.665, 821.1 0.26 5.18"""),
    "Al": ("Rakic 1995", """
        364.66 0.39877 4.3957, 413.28 0.52135 5.0008, 442.8 0.6079 5.3676, 476.87 0.7278 5.7781, 516.6 0.8734 6.2418,
        563.57 1.0728 6.7839, 619.93 1.366 7.4052, 652.25 1.5724 7.7354, 688.81 1.8301 8.0601, 729.32 2.1606 8.3565,
        774.91 2.6154 8.4914, 794.78 2.7675 8.3866"""),
    "Cr": ("Johnson & Christy 1974", """
        368 1.87 2.69, 381 1.92 2.74, 397 2 2.83, 413 2.08 2.93, 431 2.19 3.04, 451 2.33 3.14, 471 2.51 3.24, 496 2.75
        3.3, 521 2.94 3.33, 549 3.18 3.33, 582 3.22 3.3, 617 3.17 3.3, 659 3.09 3.34, 704 3.05 3.39, 756 3.08 3.42,
        821 3.2 3.48"""),
    "W": ("Weaver, Olson & Lynch 1975", """
        379 3.459 2.556, 400.2 3.406 2.415, 425.3 3.346 2.439, 448.7 3.314 2.511, 469.4 3.332 2.591, 492.1 3.38 2.664,
        529.8 3.49 2.716, 570.5 3.524 2.787, 599.7 3.557 2.86, 626 3.607 2.906, 646 3.657 2.925, 671.2 3.746 2.937,
        700.8 3.871 2.879, 731.4 3.891 2.828, 752.8 3.862 2.788, 777.8 3.789 2.737, 781.7 3.772 2.731"""),
    "Ni": ("Johnson & Christy 1974", """
        368 1.7 2.4, 381 1.72 2.48, 397 1.72 2.57, 413 1.7 2.69, 431 1.71 2.82, 451 1.73 2.95, 471 1.78 3.09, 496 1.82
        3.25, 521 1.85 3.42, 549 1.92 3.61, 582 1.96 3.8, 617 1.99 4.02, 659 1.99 4.26, 704 2.06 4.5, 756 2.13 4.73,
        821 2.26 4.97"""),
    "Ti": ("Johnson & Christy 1974", """
        368 1.9 2.9, 381 1.99 2.93, 397 2.08 2.95, 413 2.14 2.98, 431 2.21 3.01, 451 2.27 3.04, 471 2.32 3.1, 496 2.36
        3.19, 521 2.44 3.3, 549 2.54 3.43, 582 2.6 3.58, 617 2.67 3.72, 659 2.76 3.84, 704 2.86 3.96, 756 3 4.01, 821
        3.21 4.01"""),
    "CuZn": ("Querry 1985", """
        380 1.487 1.818, 400 1.445 1.805, 420 1.35 1.786, 440 1.191 1.797, 460 0.994 1.883, 480 0.816 2.046, 500 0.686
        2.25, 520 0.602 2.464, 540 0.549 2.668, 560 0.505 2.86, 580 0.468 3.059, 600 0.45 3.253, 620 0.449 3.434, 640
        0.444 3.609, 660 0.445 3.778, 680 0.444 3.943, 700 0.446 4.106, 720 0.45 4.266, 740 0.455 4.424, 760 0.458
        4.579, 780 0.464 4.737"""),
    "Ir": ("Schmitt et al. 2022", """
        378.3 1.91 3.831, 398.1 1.99 3.993, 417.9 2.067 4.143, 437.7 2.137 4.292, 457.5 2.209 4.447, 477.3 2.288
        4.602, 497.1 2.375 4.753, 517 2.468 4.896, 536.8 2.565 5.031, 556.6 2.663 5.155, 576.4 2.759 5.269, 596.2
        2.852 5.373, 616 2.938 5.47, 635.8 3.018 5.561, 655.6 3.09 5.649, 675.4 3.156 5.735, 695.2 3.214 5.82, 715.1
        3.268 5.906, 734.9 3.317 5.993, 754.7 3.362 6.082, 774.5 3.405 6.173, 784.4 3.425 6.218"""),
}
D65 = (49.9755, 82.7549, 93.4318, 104.865, 117.812, 115.923, 109.354, 104.79, 104.405, 100, 95.788, 90.0062, 87.6987, 83.6992,
       80.2146, 78.2842, 71.6091, 61.604, 75.087, 46.4182, 63.3828)  # at 380, 400 .. 780 nm
TO_SRGB = ((3.2404542, -1.5371385, -0.4985314), (-0.9692660, 1.8760108, 0.0415560), (0.0556434, -0.2040259, 1.0572252))
LOBES = (  # height, centre, width below and above it, in nm
    ((1.056, 599.8, 37.9, 31.0), (0.362, 442.0, 16.0, 26.7), (-0.065, 501.1, 20.4, 26.2)),
    ((0.821, 568.8, 46.9, 40.5), (0.286, 530.9, 16.3, 31.1)),
    ((1.217, 437.0, 11.8, 36.0), (0.681, 459.0, 26.0, 13.8)))


def linear(xs, ys, x):
    i = min(max(bisect.bisect(xs, x), 1), len(xs) - 1)
    t = min(max((x - xs[i - 1]) / (xs[i] - xs[i - 1]), 0), 1)
    return ys[i - 1] + t * (ys[i] - ys[i - 1])


def reflectance(metal, wavelength):
    rows = [[float(x) for x in row.split()] for row in METALS[metal][1].split(",")]
    n, k = (linear([row[0] for row in rows], [row[c] for row in rows], wavelength) for c in (1, 2))
    return ((n - 1) ** 2 + k ** 2) / ((n + 1) ** 2 + k ** 2)


def srgb(spectrum):
    """The linear sRGB of a reflectance that is a function of the wavelength, with 1 for white."""
    xyz, white = [0.0] * 3, [0.0] * 3
    for wavelength in range(380, 781):
        light, r = linear([380 + 20 * i for i in range(len(D65))], D65, wavelength), spectrum(wavelength)
        for c, lobes in enumerate(LOBES):
            seen = light * sum(h * math.exp(-.5 * ((wavelength - m) / (s if wavelength < m else t)) ** 2) for h, m, s, t in lobes)
            xyz[c] += r * seen
            white[c] += seen
    return [min(max(sum(a * b for a, b in zip(row, xyz)) / sum(a * b for a, b in zip(row, white)), 0), 1) for row in TO_SRGB]


def rows():
    return {m: srgb(lambda w, m=m: reflectance(m, w)) for m in METALS}


def main():
    """Prints the rows, or compares them with those of a file."""
    made = {name: ", ".join(f"{x:.3f}" for x in rgb) for name, rgb in rows().items()}
    if len(sys.argv) < 2:
        print("\n".join(f'{{"{name}", {{{rgb}}}}}, /* {METALS[name][0]} */' for name, rgb in made.items()))
        return 0
    with open(sys.argv[1], encoding="utf-8") as file:
        held = dict(re.findall(r'\{"(\w+)", \{([\d., ]+)\}\}', file.read()))
    wrong = [f"{name}: {held.get(name)} in the file, {rgb} computed" for name, rgb in made.items() if held.get(name) != rgb]
    if held.pop("none", None) != "1, 1, 1" or len(held) != len(made):
        wrong.append("the file has metals that have no constants here, or none for 'none'")
    print("\n".join(wrong) or f"{len(made)} metals agree")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
