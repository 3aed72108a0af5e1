#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: a blue-noise mask in a DDS file of one channel, 8 or 16 bits (DXGI R8_UNORM, R16_UNORM), is read by Pillow
# and by OpenImageIO.
# Seen: OpenImageIO reads the 16 bits and refuses the 8; Pillow refuses both.
# Packages: numpy==2.3.5 pillow==13.0.0 OpenImageIO==3.2.2.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 pillow==13.0.0 OpenImageIO==3.2.2.0
venv/bin/python - <<'END'
import struct

import numpy as np
import OpenImageIO as oiio
from PIL import Image

R8, R16 = 61, 56


def write(name, dxgi, values):
    header = struct.pack("<7I", 124, 0x100F, 4, 4, 4 * values.itemsize, 0, 1) + bytes(44)
    header += struct.pack("<2I4s5I", 32, 4, b"DX10", 0, 0, 0, 0, 0) + struct.pack("<5I", 0x1000, 0, 0, 0, 0)
    with open(name, "wb") as file:
        file.write(b"DDS " + header + struct.pack("<5I", dxgi, 3, 0, 1, 0) + values.tobytes())


def pillow(name):
    try:
        return np.array(Image.open(name)).shape == (4, 4)
    except NotImplementedError:
        return False


def openimageio(name):
    file = oiio.ImageInput.open(name)
    return bool(file) and bool(np.allclose(file.read_image("float").ravel(), np.arange(16) / 15, atol=1e-6))


write("r8.dds", R8, np.arange(16, dtype=np.uint8) * np.uint8(17))
write("r16.dds", R16, (np.arange(16) * 4369).astype("<u2"))
read = {(name, by.__name__): by(name) for name in ("r8.dds", "r16.dds") for by in (pillow, openimageio)}
for (name, by), whether in read.items():
    print(name, by, "reads it" if whether else "refuses it")
raise SystemExit(list(read.values()) != [False, False, False, True])
END
