#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: pfsin | pfsout of a PPM, with nothing between, gives its bytes again.
# Seen: of 256 greys one comes back, black: the stream between is XYZ in floats, pfsoutppm rounds down, and the others
# lose one in blue, four of five in red as well. After eight trips a grey of 128 is (126, 128, 120): a chain of tools
# that writes bytes at each step tints.
# Packages: pfstools 2.2.0-5+b1 (Debian bookworm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -c "
import sys
sys.stdout.buffer.write(b'P6\n256 1\n255\n' + bytes(i for i in range(256) for _ in range(3)))" >0.ppm
for trip in 1 2 3 4 5 6 7 8; do
  pfsin $((trip - 1)).ppm | pfsout $trip.ppm
done
python3 - <<'END_OF_CHECK'
def greys(trip):
    with open(f"{trip}.ppm", "rb") as file:
        data = file.read()[-768:]
    return [tuple(data[3 * i:3 * i + 3]) for i in range(256)]


kept = [i for i, pixel in enumerate(greys(1)) if pixel == (i, i, i)]
print("greys that come back:", kept, "- 128 after one trip:", greys(1)[128], "after eight:", greys(8)[128])
red, green, blue = greys(8)[128]
print("averages after eight:", [sum(channel) / 256 for channel in zip(*greys(8))], "of 127.5")
raise SystemExit(not (kept == [0] and red < green and blue <= green - 5))
END_OF_CHECK
