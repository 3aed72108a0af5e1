#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Threads of Python, forked and spawned processes, and pickled objects: a call lets other threads of Python run, and what other
processes compute has the same bits."""
import multiprocessing
import os
import pathlib
import pickle
import tempfile
import threading
import time
import unittest
from ctypes import byref

import numpy as np

import koksma
from koksma._library import check, core, spec
from koksma._points import view

# Says that it runs, and waits for an answer, so that only a thread that runs meanwhile lets it end.
WAITING = """#!/bin/sh
: >started
until [ -e answered ]; do sleep 0.01; done
i=0
while [ $i -lt $1 ]; do echo 0.5 0.5; i=$((i + 1)); done
"""


def work(seed):
    """In another process: a pattern, a measure on two threads, a picture."""
    points = koksma.generate("jittered", 256, seed=seed, threads=2)
    return points, koksma.measure(points, "l2-star", threads=2).value, koksma.render("ball", spp=4, size=(16, 12), threads=2)


def drawn(engine):
    return engine.random(8)


class Threads(unittest.TestCase):
    def test_others_run_during_a_call(self):
        with tempfile.TemporaryDirectory() as folder:
            program, found = pathlib.Path(folder, "waiting.sh"), []
            program.write_text(WAITING.replace("started", f"{folder}/started").replace("answered", f"{folder}/answered"))
            program.chmod(0o755)

            def generate():
                # Without a koksma_run: the library asks Python nothing, which would let others run in its stead.
                with koksma.allow_exec(120):
                    points = np.zeros((4, 2))
                    check(core().koksma_generate(byref(spec("pattern", f"exec:{program}")), 0, None, byref(view(points))))
                    found.append(points)

            thread = threading.Thread(target=generate)
            thread.start()
            while thread.is_alive() and not os.path.exists(f"{folder}/started"):
                time.sleep(0.01)
            pathlib.Path(folder, "answered").touch()
            thread.join()
            np.testing.assert_array_equal(found, [np.full((4, 2), 0.5)])

    def test_equal_bits(self):
        found = {}
        threads = [threading.Thread(target=lambda seed=seed: found.update({seed: work(seed)})) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for seed in range(4):
            for ours, theirs in zip(work(seed), found[seed]):
                np.testing.assert_array_equal(ours, theirs)


class Processes(unittest.TestCase):
    def test_equal_bits(self):
        here = [work(seed) for seed in range(3)]  # before the fork, so that the library has had threads
        for method in ("fork", "spawn"):
            with self.subTest(method=method), multiprocessing.get_context(method).Pool(2) as pool:
                for ours, theirs in zip(here, pool.map(work, range(3))):
                    for a, b in zip(ours, theirs):
                        np.testing.assert_array_equal(a, b)
                np.testing.assert_array_equal(pool.starmap(koksma.generate, [("sobol", 16, 3, 7)])[0], koksma.generate("sobol", 16, 3, 7))

    def test_pickled_engines(self):
        """They go on where they were, here and in another process."""
        for pattern in ("sobol:scramble=owen", "n-rooks", "random"):
            with self.subTest(pattern=pattern), multiprocessing.get_context("spawn").Pool(1) as pool:
                engine = koksma.Engine(pattern, 2, seed=5)
                engine.random(8)
                again, there = pickle.loads(pickle.dumps(engine)), pool.map(drawn, [engine])[0]
                self.assertEqual(again.num_generated, 8)
                expected = engine.random(8)
                np.testing.assert_array_equal(again.random(8), expected)
                np.testing.assert_array_equal(there, expected)

    def test_pickled_results(self):
        sets = [koksma.generate("jittered", 64, seed=seed) for seed in range(2)]
        for result in (koksma.measure(sets[0]), koksma.trials("jittered", 16, trials=3), koksma.spectrum(sets, 8), koksma.verify(sets[0]),
                       koksma.convergence("sobol", sizes=[16, 32]), koksma.patterns(), koksma.render("ball", spp=1, size=(8, 6), layers=True),
                       koksma.rank("ball", ["random", "jittered"], 4, size=(8, 6), max_trials=8, one_size=True)):
            self.assertEqual(repr(pickle.loads(pickle.dumps(result))), repr(result))
        for error in (koksma.ArgumentError("a"), koksma.MissingError("b")):
            self.assertEqual(str(pickle.loads(pickle.dumps(error))), str(error))


if __name__ == "__main__":
    unittest.main()
