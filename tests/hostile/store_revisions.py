#!/usr/bin/env python3
"""store_revisions.py KOKSMA: study/stores/revisions.sqlite has rows of every pattern, measure and warp of an earlier
program, and of a few images. Each row is made again by this program, bit for bit, or its revision was raised:
then the row counts as another's. Who adds a pattern need not add rows; who changes one and forgets its revision fails
here."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

KOKSMA = os.path.abspath(sys.argv[1])
STORE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../study/stores/revisions.sqlite")

with tempfile.TemporaryDirectory() as folder:
    shutil.copy(STORE, folder + "/results.sqlite")
    audit = subprocess.run([KOKSMA, "study", "audit", folder, "--rows", "all"], capture_output=True, text=True, timeout=1800)
    export = subprocess.run([KOKSMA, "study", "export", folder], capture_output=True, text=True, timeout=1800).stdout
print(audit.stdout + audit.stderr)
if audit.returncode:
    print("where the bits of a pattern, measure or warp have changed on purpose, raise its `revision`; of images\n"
          "KOKSMA__RENDERER_REVISION (src/lab/study/plan/made_by.h)")
    sys.exit(1)
counted = sum(int(n) for n in re.findall(r"(\d+) rows drawn|not compared: (\d+) rows", audit.stdout) for n in n if n)
assert counted == len(export.strip().split("\n")) - 1 == 161, (counted, len(export))
