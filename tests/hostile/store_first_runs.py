#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""store_first_runs.py KOKSMA FAULTS: two first runs in one folder, of which the second makes and ends between two steps of the
first, which has seen that there is no store and pauses (KOKSMA_FAULT_PAUSE) before it removes the log of a deleted store, or
links its own. The second ends as by kill -9, so that its rows are in its log alone: the first must go on with all of them.
A run that has a log to remove holds a lock on the folder meanwhile."""
import fcntl
import os
import re
import shutil
import subprocess
import sys
import time

from stores import KOKSMA, check, end, koksma, own_folder

FAULTS = os.path.abspath(sys.argv[2])
PLAN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../study/plan.json")


def run(folder):
    return ["study", "run", PLAN, "--threads", "1", "--progress", "never", "-o", folder]


def faults(**fault):
    return subprocess.Popen([FAULTS, *run("d")], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                            env=os.environ | {f"KOKSMA_FAULT{name}": value for name, value in fault.items()})


def killed(call):
    """A run that ends at a call of SQLite."""
    victim = faults(**{"": "db", "_MODE": "end", "_AT": str(call), "_LOG": "log"})
    told = victim.communicate()[0]
    os.remove("log")
    return victim.returncode, told


def done_after(call):
    """Ends a run at a call of SQLite; how many jobs it has done by its log, and without its log."""
    shutil.rmtree("d", ignore_errors=True)
    killed(call)
    shutil.copytree("d", "bare")
    if os.path.exists("bare/results.sqlite-wal"):
        os.remove("bare/results.sqlite-wal")
    done = [done_before(told.stdout + told.stderr) for told in (koksma(*run(folder)) for folder in ("d", "bare"))]
    shutil.rmtree("d")
    shutil.rmtree("bare")
    return done


def paused():
    first = faults(**{"": "none", "_PAUSE": "pause"})
    while not os.path.exists("pause") and first.poll() is None:
        time.sleep(0.001)
    check(first.poll() is None, "the first run has a log to remove, or a store to link")
    return first


def released(first):
    """What the first run says at its end."""
    os.remove("pause")
    told = first.communicate()[0]
    check(first.returncode == 0, f"the first run: {first.returncode}: {told}")
    return told


def done_before(told):
    found = re.search(r"jobs, (\d+) of them done before", told)
    return int(found[1]) if found else -1


def export(folder):
    return koksma("study", "export", folder).stdout


def without_log():
    first = paused()
    check(killed(CALL)[0] == 99 and os.path.getsize("d/results.sqlite-wal") > 0, "the second run has rows in its log")
    found = done_before(released(first))
    check(found == DONE, f"of {DONE} jobs that the second run has done the first found {found}")
    check(export("d") == TRUTH, "all rows, once")


def with_log():
    """That of a store that is gone."""
    shutil.rmtree("d")
    check(killed(CALL)[0] == 99 and os.path.getsize("d/results.sqlite-wal") > 0, "the killed run has left a log")
    os.remove("d/results.sqlite")
    first = paused()
    code, told = killed(CALL)
    check(code == 4 and told.count("\n") == 1 and "d/results.sqlite: another program has locked its folder" in told,
          f"the second run waits, and ends: {code}: {told}")
    check(done_before(released(first)) == 0 and export("d") == TRUTH, "all rows, and none of the deleted store")
    check(sorted(os.listdir("d")) == LEFT, f"left: {os.listdir('d')}")


def locked_by_others():
    """As by `flock DIR koksma ...`: a run without a log to remove needs no lock."""
    shutil.rmtree("d")
    os.mkdir("d")
    held = os.open("d", os.O_RDONLY)
    fcntl.flock(held, fcntl.LOCK_EX)
    told = koksma(*run("d"))
    os.close(held)
    check(told.returncode == 0 and export("d") == TRUTH, f"a locked folder: {told}")


with own_folder():
    assert koksma(*run("whole")).returncode == 0
    TRUTH, LEFT = export("whole"), sorted(os.listdir("whole"))
    CALL, DONE = next((call, with_it) for call in range(300, 500, 5) for with_it, without in [done_after(call)] if with_it > without > 0)
    for part in without_log, with_log, locked_by_others:
        part()
end()
