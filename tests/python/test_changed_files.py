#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Files that change while a process goes on: a row's hash is that of the file which made its value.

The files of samplers have one point, whose discrepancies have closed forms; values are compared with these."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import koksma

INCLUDE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "include")
PLUGIN = """#include <koksma/plugin.h>
static int same(uint64_t seed, size_t n, int dim, double *xs, char reason[KOKSMA_PLUGIN_REASON])
{
    (void)seed, (void)reason;
    for (size_t i = 0; i < n * (size_t)dim; i++) {
        xs[i] = %s;
    }
    return 0;
}
static const koksma_plugin plugin = {KOKSMA_PLUGIN_VERSION, "same", 1, 9, same};
const koksma_plugin *koksma_plugin_at(size_t i) { return i ? NULL : &plugin; }
"""


def star(x):
    """The star discrepancy of the point (x, x): of the boxes below it, whose area is at most x, of those up to it, which have
    the point and an area of at least x^2, and of those beside it."""
    return max(x, 1 - x * x)


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def plan(self, pattern, n=1, trials=9):
        return {"name": "m", "title": "M", "discrepancies": [{"patterns": [pattern], "measures": ["star"], "n": [n], "trials": trials}]}


class Libraries(Folder):
    """A process can't load a library of one path twice: dlopen returns the first. So the second is refused."""

    def build(self, name, x):
        pathlib.Path("plugin.c").write_text(PLUGIN % x)
        subprocess.run(["cc", "-shared", "-fPIC", "-I", INCLUDE, "plugin.c", "-o", "built.so"], check=True)
        os.makedirs(os.path.dirname(name) or ".", exist_ok=True)
        os.replace("built.so", name)

    def test_a_rebuilt_library_is_refused(self):
        self.build("s.so", 0.5)
        with koksma.allow_exec():
            for pattern in ("plugin:./s.so", "plugin:s.so:same"):
                self.assertEqual(koksma.measure(koksma.generate(pattern, 1), "star").value, star(0.5))
            with koksma.Study(self.plan("plugin:./s.so"), "out") as study:
                study.run()
                self.assertEqual([row["value"] for row in study.rows()], [star(0.5)] * 9)
            self.build("s.so", 0.25)
            for pattern in ("plugin:./s.so", "plugin:s.so:same", f"plugin:{os.getcwd()}/s.so"):
                with self.assertRaisesRegex(koksma.MalformedError, r"s\.so.*: the file has changed since this process loaded it"):
                    koksma.generate(pattern, 1)
            with self.assertRaisesRegex(koksma.MalformedError, "the file has changed since"):
                with koksma.Study(self.plan("plugin:./s.so"), "out") as study:
                    study.run()
            with koksma.Study([], "out") as study:
                self.assertEqual([row["value"] for row in study.rows()], [star(0.5)] * 9)
            os.rename("s.so", "t.so")
            self.assertEqual(koksma.measure(koksma.generate("plugin:./t.so", 1), "star").value, star(0.25))

    def test_a_touched_or_copied_library_is_the_same(self):
        self.build("s.so", 0.5)
        with koksma.allow_exec():
            value = lambda: koksma.measure(koksma.generate("plugin:./s.so", 1), "star").value
            self.assertEqual(value(), star(0.5))
            for times in ((1, 1), (2, 2)):
                os.utime("s.so", times)
                self.assertEqual(value(), star(0.5))
            shutil.copy("s.so", "copy.so")
            os.replace("copy.so", "s.so")
            self.assertEqual(value(), star(0.5))
            old = os.stat("s.so")
            self.build("s.so", 0.2)  # the same size
            os.utime("s.so", ns=(old.st_atime_ns, old.st_mtime_ns))
            for _ in range(2):
                with self.assertRaisesRegex(koksma.MalformedError, "the file has changed since"):
                    value()


class Files(Folder):
    """Each run of an open study looks at its files anew, as a study that is opened then does."""

    def write(self, name, x):
        pathlib.Path(name).write_text(f"{x} {x}\n")

    def values(self, study, kind="discrepancy"):
        return sorted((row["scene_hash"], row["trial"], row["seed"], row["value"]) for row in study.rows() if row["kind"] == kind)

    def test_a_file_that_changes(self):
        self.write("one.txt", 0.5)
        with koksma.Study(self.plan("file:one.txt"), "out") as study:
            for x in (0.5, 0.25, 0.75):  # the last has the discrepancy of the first
                self.write("one.txt", x)
                again = study.run()
                self.assertEqual((again.jobs, again.done_before, again.done_now), (1, 0, 1))
            for x in (0.75, 0.5):  # each has its row
                self.write("one.txt", x)
                self.assertEqual(study.run().done_now, 0)
            self.assertEqual(sorted(value[3] for value in self.values(study)), sorted(map(star, (0.5, 0.25, 0.75))))


if __name__ == "__main__":
    unittest.main()
