#!/usr/bin/env python3
"""store_kills.py KOKSMA: 200 kills (6 with sanitizers) at random moments of runs, audits, exports, reports,
five of them (with sanitizers one) in a row on one folder. The next run then has the rows of one that was never disturbed, the audit agrees
with all of them, and nothing is left in the folder but what such a run leaves."""
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

KOKSMA = os.path.abspath(sys.argv[1])
HERE = os.path.dirname(os.path.abspath(__file__))
PLAN = os.path.join(HERE, "../study/plan.json")
KILLS, IN_A_ROW = (6, 1) if os.environ.get("KOKSMA_SANITIZED") == "1" else (200, 5)
problems = 0


def command(verb, folder):
    return [KOKSMA, "study", *{"run": ["run", PLAN, "-o", folder, "-q"], "audit": ["audit", folder, "--rows", "all", "-q"],
                               "export": ["export", folder, "-o", folder + "/rows.csv"], "report": ["report", folder]}[verb]]


def run(verb, folder):
    return subprocess.run(command(verb, folder), capture_output=True, text=True, timeout=1800)


def listing(folder):
    return sorted(os.path.relpath(os.path.join(at, name), folder) for at, _, names in os.walk(folder) for name in names)


def rows_of(folder):
    with open(folder + "/rows.csv", encoding="utf-8") as lines:
        return lines.readlines()


def kill(verb, folder, within):
    """Kills a command at a random moment. within[verb], the longest wait, follows how long the command takes just now."""
    victim = subprocess.Popen(command(verb, folder), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(random.uniform(0, within[verb]))
    victim.send_signal(signal.SIGKILL)
    was_running = victim.wait() == -signal.SIGKILL
    within[verb] *= 1.1 if was_running else 0.7
    return was_running


def main():
    global problems
    random.seed(int(os.environ.get("KOKSMA_KILLS_SEED", "7")))
    began = time.monotonic()
    assert run("run", "whole").returncode == 0
    within = dict.fromkeys(("run", "audit", "export", "report"), 1.2 * (time.monotonic() - began))
    assert run("export", "whole").returncode == 0
    rows, left = rows_of("whole"), listing("whole")
    killed = 0
    for group in range(KILLS // IN_A_ROW):
        folder = f"d{group}"
        kind = group % 3
        if kind == 0:
            os.mkdir(folder)
            verbs = ["run"] * IN_A_ROW
        elif kind == 1:
            os.mkdir(folder)
            verbs = ["run", "run", "export", "report", "audit"][:IN_A_ROW]
        else:
            shutil.copytree("whole", folder)
            verbs = ["audit", "export", "report", "export", "report"][:IN_A_ROW]
        killed += sum(kill(verb, folder, within) for verb in verbs)
        for verb in "run", "export", "audit":
            told = run(verb, folder)
            if told.returncode:
                problems += 1
                print(f"{verb} after kills of {verbs}: exit code {told.returncode}: {told.stdout}{told.stderr}")
        if rows_of(folder) != rows:
            problems += 1
            print(f"kills of {verbs}, kind {kind}: other rows")
        if listing(folder) != left:
            problems += 1
            print(f"kills of {verbs}, kind {kind}: left: {set(listing(folder)) ^ set(left)}")
        shutil.rmtree(folder)
    print(f"{KILLS} kills, {killed} of them before the end; {problems} problems")
    assert killed > KILLS / 3
    sys.exit(problems > 0)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        main()
