#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Is a point set that was optimised for one scene better in others? Prints the tables of docs/findings/records.md.

    tools/scene_sets.py build/release/koksma [SCENE] [SEED] >tables.md

Runs `koksma optimise --scene SCENE -n 16` (default: ball, 0), which takes minutes of processor time, and prints what its rows say:
the error of the set in the scene and in six that took no part, beside that of the best of 17 listed patterns there, and the gain
with its interval of 95 %.
"""
import json
import os
import resource
import subprocess
import sys
import tempfile


def percent(x):
    return "-" if x is None else f"{100 * x:+.1f} %"


def main():
    program, scene, seed = sys.argv[1], (sys.argv[2:3] or ["ball"])[0], (sys.argv[3:4] or ["0"])[0]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([program, "optimise", "--scene", scene, "-n", "16", "-s", seed, "-o", os.path.join(folder, "set.txt"),
                               "--json", "-q"], stdout=subprocess.PIPE, text=True)
    if done.returncode not in (0, 1):
        sys.exit(done.returncode)
    rows = [json.loads(line) for line in done.stdout.splitlines()]
    first, used = rows[0], resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"Variance along x, y and both: {first['share_x']:.2f}, {first['share_y']:.2f}, {first['share_xy']:.2f}. "
          f"{first['eliminated']} of {first['candidates']} candidates eliminated; chosen: {first['measure']}, phase "
          f"{first['phase']}. {used.ru_utime + used.ru_stime:.0f} s of processor time.\n")
    print("| scene | part | size | set | best listed | its error | gain | interval |\n|---|---|---|---|---|---|---|---|")
    for row in rows:
        size = f"{row['width']} x {row['height']}" if row["width"] else "-"
        errors = [f"{row[k]:.5f}" if row[k] is not None else "-" for k in ("error", "listed_error")]
        print(f"| {row['scene']} | {row['role']} | {size} | {errors[0]} | `{row['best_listed']}` | {errors[1]} | "
              f"{percent(row['gain'])} | {percent(row['gain_low'])} to {percent(row['gain_high'])} |")


main()
