#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: UsdLux.BlackbodyTemperatureAsRgb(6500), the default colour temperature of lights, is white: (1, 1, 1).
# Seen: it is (1.043, .984, 1.035), slightly purple, since a black body of 6,500 K is not the white point D65;
# enableColorTemperature with the default temperature changes a light's colour.
# Packages: usd-core==26.11
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check usd-core==26.11
venv/bin/python - <<'END'
from pxr import UsdLux

rgb = tuple(UsdLux.BlackbodyTemperatureAsRgb(6500))
luminance = .2126 * rgb[0] + .7152 * rgb[1] + .0722 * rgb[2]
print("6500 K: %.4f %.4f %.4f, luminance %.4f" % (*rgb, luminance))
raise SystemExit(abs(rgb[0] - 1.0433) > 5e-4 or abs(rgb[1] - .9836) > 5e-4 or abs(luminance - 1) > .002)
END
