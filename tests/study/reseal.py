#!/usr/bin/env python3
"""reseal.py DIR...: writes the seal of DIR/results.sqlite anew, from src/lab/study/store/store_tables.c's description and not
its code: for tests that change rows by hand, as somebody who means to deceive would."""
import sqlite3
import struct
import sys

ONES = (1 << 64) - 1


def fold(h, x):
    h = (h + x) * 0x9E3779B97F4A7C15 & ONES
    return h ^ h >> 32


def text_hash(text):
    """FNV-1a and the finalizer of SplitMix64 (core/hash.h)."""
    h = 0xCBF29CE484222325
    for byte in text.encode():
        h = (h ^ byte) * 0x100000001B3 & ONES
    h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9 & ONES
    h = (h ^ h >> 27) * 0x94D049BB133111EB & ONES
    return h ^ h >> 31


def word(x):
    if x is None:
        return 0x7FF8000000000000
    if isinstance(x, float):
        return struct.unpack("<Q", struct.pack("<d", x))[0]
    return text_hash(x) if isinstance(x, str) else x & ONES


def checksum(table, values):
    h = fold(0, table)
    for value in values:
        h = fold(h, word(value))
    return h


def reseal(folder):
    database = sqlite3.connect(folder + "/results.sqlite")
    columns = [column[1] for column in database.execute("PRAGMA table_info(series)")]
    metric = "metric" if "metric" in columns else "''"  # schema 6 had none
    tables = [
        (1, "SELECT id, seed, v0, v1, v2, v3 FROM result"),
        (2, "SELECT id, kind, scene, scene_hash, options, pattern, what, made_by, measured_by, n, dim, width, height, "
            f"{metric} FROM series"),
        (3, "SELECT width, height, scene, scene_hash, options, reference, made_by, pixels, standard_error FROM reference"),
        (4, "SELECT key, value FROM meta WHERE key <> 'seal'"),
    ]
    rows = [(table, row) for table, query in tables for row in database.execute(query)]
    # the metric of a series is the last word, and only where there is one
    sums = [checksum(table, row[:-1] if table == 2 and not row[-1] else row) for table, row in rows]
    database.execute("UPDATE meta SET value = ? WHERE key = 'seal'", ("%d %d" % (len(sums), sum(sums) & ONES),))
    database.commit()
    database.close()


if __name__ == "__main__":
    for folder in sys.argv[1:]:
        reseal(folder)
