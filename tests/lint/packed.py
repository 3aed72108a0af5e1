#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""packed.py OBJDUMP OBJECT...: every fast kernel computes with vectors, in every instruction set.

Disassembles the objects of the kernels and counts the floating-point additions, products, quotients, roots, comparisons
and extremes of each kernel, with those of the functions of the same object that it calls. Exit code 1: a kernel has more
scalar than packed ones and no reason below, or no kernel was found.
"""
import re
import subprocess
import sys

TAIL = "the loop is packed; what is left of less than a vector is unrolled, number by number"
NO_BLEND = "a loop of choices, which compilers do not vectorise for SSE2: it has no blend"
REASONS = {
    "kernel_quotients": TAIL,
    "kernel_steps": TAIL,
    "kernel_fractions": TAIL,
    "kernel_cells_2d": TAIL,
    "kernel_rows_of_columns": TAIL,
    "kernel_rooks_2d": TAIL,
    "batch_place": TAIL,
    "batch_jitter": TAIL,
    "batch_move": TAIL,
    "batch_estimate": "few vectors a call, and what is the same for all lanes is computed before the loop",
    "batch_albedo": NO_BLEND,
    "batch_shade": NO_BLEND,
    "batch_land": NO_BLEND + "; clang 14 gives up on it everywhere",
    "batch_meet_faces": NO_BLEND,
    "batch_step_off": NO_BLEND,
    "batch_beams": NO_BLEND,
    "batch_reflect": NO_BLEND,
    "batch_scatter": NO_BLEND,
    "batch_surfaces": NO_BLEND,
    "batch_background": NO_BLEND,
    "batch_collect": NO_BLEND,
    "batch_travel": NO_BLEND,
    "batch_attenuate": NO_BLEND,
    "kernel_far_corners": "the loop over corners is packed; what is scalar is the largest of its lanes, once for each block of 128, "
                          "and the unrolled rest",
    "batch_closest": "the loops over lanes are packed; what is the same for all rays of a shape is computed before them, once for each "
                     "shape, and the fused loop of rectangles has tails",
}
ARITHMETIC = re.compile(r"v?(?:add|sub|mul|div|sqrt|min|max|u?comi|cmp\w*?|fn?m(?:add|sub)\w*)([sp])[sd]$")


def functions(dump):
    """Of each function: [scalar, packed] instructions, and the functions that it calls."""
    found = {}
    for line in dump.splitlines():
        head = re.match(r"[0-9a-f]+ <(.+)>:$", line)
        if head:
            counts, calls = found.setdefault(head.group(1), ([0, 0], set()))
            continue
        instruction = re.match(r"\s+[0-9a-f]+:\s+(\S+)(?:\s.*<([^+>]+)>)?", line)
        if instruction:
            kind = ARITHMETIC.match(instruction.group(1))
            if kind:
                counts["sp".index(kind.group(1))] += 1
            if instruction.group(2):
                calls.add(instruction.group(2))
    return found


def total(found, name):
    """The counts of a function with all that it calls here."""
    reached, todo = set(), [name]
    while todo:
        function = todo.pop()
        if function in found and function not in reached:
            reached.add(function)
            todo += found[function][1]
    return [sum(found[function][0][kind] for function in reached) for kind in (0, 1)]


seen, failed = 0, False
for path in sys.argv[2:]:
    found = functions(subprocess.run([sys.argv[1], "-d", "--no-show-raw-insn", path], check=True, capture_output=True,
                                     text=True).stdout)
    for name in sorted(found):
        kernel = re.match(r"koksma__((?:kernel|batch)_\w+)_(baseline|avx2|avx512)$", name)
        if kernel:
            seen += 1
            scalar, packed = total(found, name)
            if scalar > packed and kernel.group(1) not in REASONS:
                print(f"{name}: {scalar} scalar and {packed} packed instructions; use the vectors of src/engine/kernels/lanes64.h, "
                      f"or give a reason in tests/lint/packed.py")
                failed = True
if seen < 100:
    print(f"only {seen} kernels found")
sys.exit(failed or seen < 100)
