#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_outputs.py PROGRAM: output files in folders that others may write to, and streams and stores that are full.

Links are planted under the names that the program chooses. A file is the old or the new one, whole, and no file but the one
that was asked for changes. tests/faults has runs that end in the middle, and disks that are full.
"""
import glob
import os
import shutil
import subprocess
import sys
import tempfile

import files

HERE = os.path.dirname(os.path.abspath(__file__))
PLAN = os.path.join(os.path.dirname(HERE), "faults", "inputs", "plan.json")
VICTIM = b"what somebody keeps here\n"
POINTS = ["generate", "random", "-q"]


def write(path, data=VICTIM):
    with open(path, "wb") as stream:
        stream.write(data)
    return path


def read(path):
    with open(path, "rb") as stream:
        return stream.read()


def good(checks, what, done):
    return checks.check(done is not None and done.code == 0, f"{what}: {done and (done.code, done.err)}")


# ---- Links ----------------------------------------------------------------------------------------------------

def check_planted_links(checks, program, folder):
    """Links of the names that process numbers gave once, and of names like those of today."""
    victim = write(os.path.join(folder, "victim"))
    last = int(read("/proc/sys/kernel/ns_last_pid")) if os.path.exists("/proc/sys/kernel/ns_last_pid") else os.getpid()
    for pid in range(last, last + 3000):
        os.symlink("victim", os.path.join(folder, f".koksma-{pid}-0-out.txt"))
    os.symlink("victim", os.path.join(folder, ".koksma-" + "0" * 16))
    good(checks, "planted links", files.run(program, *POINTS, "-n", "4", "-o", "out.txt", cwd=folder))
    checks.check(read(victim) == VICTIM, "a planted link was followed")
    checks.check(not os.path.islink(os.path.join(folder, "out.txt")), "the output is a planted link")
    checks.check(b"random" in read(os.path.join(folder, "out.txt")), "the output is not there")


def check_own_names(checks, program, folder):
    """Names that the program chose itself, in a folder that came from somebody."""
    good(checks, "study", files.run(program, "study", "run", PLAN, "-q", "-o", "study", cwd=folder))
    study, victim = os.path.join(folder, "study"), write(os.path.join(folder, "victim"))
    picture = os.path.basename(glob.glob(os.path.join(study, "references", "*.exr"))[0])
    for name in ("report.html", "report.json"):
        for to in ("../victim", "../nothing"):
            os.remove(os.path.join(study, name))
            os.symlink(to, os.path.join(study, name))
            good(checks, f"{name} -> {to}", files.run(program, "study", "report", "study", "-q", cwd=folder))
            checks.check(read(victim) == VICTIM, f"{name}: the link was followed")
            checks.check(not os.path.lexists(os.path.join(folder, "nothing")), f"{name}: a link to nothing was followed")
            checks.check(not os.path.islink(os.path.join(study, name)), f"{name} is still a link")
    again = ["study", "run", PLAN, "-q", "--trials", "4", "-o", "study"]
    os.remove(os.path.join(study, "references", picture))
    os.symlink("../../nothing", os.path.join(study, "references", picture))
    good(checks, "a reference that is a link", files.run(program, *again, cwd=folder))
    checks.check(not os.path.lexists(os.path.join(folder, "nothing")), "a reference was written through a link")
    shutil.rmtree(os.path.join(study, "references"))
    os.mkdir(os.path.join(folder, "elsewhere"))
    os.symlink("../elsewhere", os.path.join(study, "references"))
    done = files.run(program, *again[:-3], "6", "-o", "study", cwd=folder)
    checks.refused("references/ that is a link", done, 3, "study/references", "link")
    checks.check(not os.listdir(os.path.join(folder, "elsewhere")), "a reference was written below a link")


def check_user_names(checks, program, folder):
    """What the user named is written where it leads: through links, and to streams and devices as they are."""
    target, link = write(os.path.join(folder, "target.txt")), os.path.join(folder, "link.txt")
    os.chmod(target, 0o600)
    os.symlink("target.txt", link)
    os.symlink("new.txt", os.path.join(folder, "dangling.txt"))
    for name, to in (("link.txt", "target.txt"), ("dangling.txt", "new.txt")):
        good(checks, name, files.run(program, *POINTS, "-n", "4", "-o", name, cwd=folder))
        checks.check(os.path.islink(os.path.join(folder, name)), f"{name} is no link any more")
        checks.check(b"random" in read(os.path.join(folder, to)), f"{name}: not written where it leads")
    for name, to in (("loop", "loop"), ("l1", "l2"), ("l2", "l1"), ("first", "second"), ("second", "third.txt")):
        os.symlink(to, os.path.join(folder, name))
    for name in ("loop", "l1", "l2"):
        checks.refused(f"a link without an end, {name}", files.run(program, *POINTS, "-n", "4", "-o", name, cwd=folder), 4,
                       f"{name}: can't be written: Too many levels of symbolic links")
    good(checks, "a link to a link to nothing", files.run(program, *POINTS, "-n", "4", "-o", "first", cwd=folder))
    checks.check(b"random" in read(os.path.join(folder, "third.txt")), "a link to a link: not written where it leads")
    for name in ("loop", "l1", "l2", "first", "second"):
        checks.check(os.path.islink(os.path.join(folder, name)), f"{name} is no link any more")
    for name in ("target.txt/", "target.txt/x", "link.txt/"):
        checks.refused(name, files.run(program, *POINTS, "-n", "4", "-o", name, cwd=folder), 4,
                       f"{name}: can't be written: Not a directory")
    checks.check(os.stat(target).st_mode & 0o777 == 0o600, "a private file is private no more")
    for name in ("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):
        done = files.run(program, *POINTS, "-n", "4", "-s", "5", "-o", name, cwd=folder)
        checks.check(good(checks, name, done) and done.out.count(b"\n") == 9, f"{name}: {done.out}")
    good(checks, "/dev/null", files.run(program, *POINTS, "-n", "4", "-o", "/dev/null", cwd=folder))
    done = files.run("/bin/sh", "-c", 'echo before >log; "$0" generate random -q -n 4 -o /dev/fd/3 3>>log; echo after >>log',
                     program, cwd=folder)
    lines = read(os.path.join(folder, "log")).split(b"\n")
    checks.check(lines[0] == b"before" and lines[-2] == b"after" and len(lines) == 12, f"/dev/fd/3: {lines}")
    checks.refused("a folder", files.run(program, *POINTS, "-n", "4", "-o", ".", cwd=folder), 4, "it is a directory")


# ---- Full disks --------------------------------------------------------------------------------------------------

def check_stores(checks, program, folder):
    """A store that can't be made or written is called by its path, with the system's reason; stores are not half made."""
    plan = [program, "study", "run", PLAN, "-q", "-o"]
    for what, limit, reason in (("a limit of the length", "ulimit -f 10", "File too large"),
                                ("few descriptors", "ulimit -n 4", "Too many open files")):
        done = files.run("/bin/sh", "-c", limit + '; exec "$@"', "sh", *plan, "study", cwd=folder)
        checks.refused(what, done, 4, "study: study/results.sqlite: ", reason)
        good(checks, f"{what}: without it", files.run(*plan, "study", cwd=folder))
        shutil.rmtree(os.path.join(folder, "study"))


def check_streams(checks, program, folder):
    """Standard output that is full or closed, for rows of all kinds, short and long."""
    good(checks, "points", files.run(program, *POINTS, "-n", "4", "-o", "r.txt", cwd=folder))
    good(checks, "study", files.run(program, "study", "run", PLAN, "-q", "-o", "study", cwd=folder))
    for name in ("-", "/dev/stdout", "/dev/full"):
        with open("/dev/full", "wb") as full:
            done = subprocess.run([program, *POINTS, "-n", "3000", "-o", name], cwd=folder, stdout=full,
                                  stderr=subprocess.PIPE, check=False)
        checks.refused(f"{name} that is full", files.Done(done.returncode, b"", done.stderr, 0), 4,
                       "No space left on device")
    for arguments in (["study", "audit", "study", "--json"], ["measure", "r.txt", "--json"], ["measure", "r.txt"],
                      ["list", "patterns", "--json"], ["list", "patterns"], ["help", "study"], ["manual"], ["version"],
                      ["verify", "r.txt", "--json"], ["completion", "bash"]):
        for to, reason in ((">/dev/full", "No space left on device"), (">&-", "Bad file descriptor")):
            done = files.run("/bin/sh", "-c", f'exec "$@" {to}', "sh", program, *arguments, cwd=folder)
            checks.refused(f"{arguments} {to}", done, 4, f"standard output could not be written: {reason}")


def main():
    program, checks = os.path.abspath(sys.argv[1]), files.Checks()
    for case in (check_planted_links, check_own_names, check_user_names, check_stores, check_streams):
        with tempfile.TemporaryDirectory() as folder:
            case(checks, program, folder)
    checks.end()


if __name__ == "__main__":
    main()
