#!/usr/bin/env python3
"""store_flips.py KOKSMA: 1,000 random bit flips (50 with sanitizers) in the database and the reference images of a study. Each is found by
`audit --rows all`, which then has another exit code than 0, or changes nothing that export and report have of results;
and no flip makes `export` write other rows with exit code 0, whatever the audit says. Half of the flips of the database are
anywhere, half next to bytes that are not 0, as much of a small file is empty. Then one flip in each byte of the headers of the
database's pages, whose numbers of cells decide which rows there are (SQLite's file format, 1.6)."""
import os
import random
import re
import subprocess
import sys
import tempfile

KOKSMA = os.path.abspath(sys.argv[1])
PLAN = """{"name": "f", "title": "f",
  "discrepancies": [{"patterns": ["random", "zaremba"], "measures": ["star", "l2-star", "extreme"], "n": [4], "trials": 3}],
  "images": [{"scenes": ["checker"], "patterns": ["random"], "spp": [1], "size": [8, 6], "trials": 3,
              "references": [{"name": "r", "pattern": "jittered", "spp": 4, "replicates": 2}]}]}"""
FLIPS = 50 if os.environ.get("KOKSMA_SANITIZED") == "1" else 1000


def run(*arguments):
    return subprocess.run([KOKSMA, "study", *arguments], capture_output=True, timeout=1800)


def results(folder):
    """All that is exported and reported but when and where it was made; None: refused."""
    export, report = run("export", folder), run("report", folder)
    if export.returncode or report.returncode:
        return None
    with open(folder + "/report.json", "rb") as file:
        return export.stdout + re.sub(rb'\{[^{}]*"id":"runs".*', b"", file.read())


def draw(sound, chance):
    if chance < 0.5:
        return random.randrange(len(sound))
    return random.choice([i for i, byte in enumerate(sound) if byte])


def flip(path, sound, place):
    damaged = bytearray(sound)
    damaged[place] ^= 1 << random.randrange(8)
    with open(path, "wb") as file:
        file.write(damaged)


def main():
    random.seed(5)
    found = silent = 0
    with open("plan.json", "w", encoding="ascii") as file:
        file.write(PLAN)
    assert run("run", "./plan.json", "-o", "d", "-q", "--threads", "1").returncode == 0
    sound_results = results("d")
    assert sound_results and run("audit", "d", "--rows", "all").returncode == 0
    files = {"d/" + n: open("d/" + n, "rb").read() for n in ["results.sqlite", "references/" + os.listdir("d/references")[0]]}
    database, reference = files
    size = int.from_bytes(files[database][16:18], "big")  # of a page; that of the first page begins behind the file's header
    headers = [page + byte + (0 if page else 100) for page in range(0, len(files[database]), size) for byte in range(8)]
    for i in range(FLIPS + len(headers)):
        path = reference if i < FLIPS and i % 5 == 0 else database
        place = headers[i - FLIPS] if i >= FLIPS else draw(files[path], random.random())
        flip(path, files[path], place)
        audit = run("audit", "d", "--rows", "all", "--threads", "1")
        if audit.returncode in (1, 3):
            found += 1
            assert audit.stdout or audit.stderr
            export = run("export", "d")
            assert export.returncode == 3 or (export.returncode == 0 and sound_results.startswith(export.stdout)), place
        else:
            assert audit.returncode == 0, f"flip in byte {place} of {path}: exit code {audit.returncode}: {audit.stderr}"
            # The results are read again only where the audit saw other revisions or a part that it does not read.
            assert results("d") == sound_results, f"flip in byte {place} of {path}: other results, and none found"
            silent += 1
        with open(path, "wb") as file:
            file.write(files[path])
    print(f"{FLIPS} flips and {len(headers)} in headers: {found} found by the audit or at opening, {silent} without effect")
    assert found > FLIPS / 10 and silent > 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as work:
        os.chdir(work)
        main()
