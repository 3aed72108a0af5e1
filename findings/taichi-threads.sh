#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: on a processor, ti.random() with random_seed=7 gives one set of numbers whatever the number of threads, as
# seeds exist to make runs repeatable.
# Seen: each thread has a state of its own, and the scheduler decides which indices a thread takes: two threads give
# other numbers than one, and not always the same ones.
# Packages: numpy==1.26.4 taichi==1.7.4
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==1.26.4 taichi==1.7.4
venv/bin/python - <<'END'
import subprocess
import sys

CODE = """
import sys
import numpy as np
import taichi as ti
ti.init(arch=ti.cpu, random_seed=7, cpu_max_num_threads=int(sys.argv[1]), log_level=ti.ERROR)
@ti.kernel
def fill(x: ti.types.ndarray()):
    for i in x:
        x[i] = ti.random()
x = np.zeros(1 << 20, np.float32)
fill(x)
print(repr(float(x.sum(dtype=np.float64))))
"""
with open("draw.py", "w") as file:
    file.write(CODE)


def total(threads):
    return subprocess.run([sys.executable, "draw.py", str(threads)], capture_output=True, text=True, check=True).stdout.split()[-1]


one, two = {total(1) for _ in range(3)}, {total(2) for _ in range(3)}
print("sums with one thread:", *sorted(one), "with two:", *sorted(two))
raise SystemExit(len(one) != 1 or one == two)
END
