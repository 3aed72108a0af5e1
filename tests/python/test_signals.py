#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a signal's handler raises while the library runs stops the call and comes out of it; nothing else changes."""
import ctypes
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import koksma
from koksma import _library
from koksma._signals import Signals

ROWS = koksma.generate("random", 1500, 6)
PLANE = koksma.generate("random", 64)


class Timeout(Exception):
    pass


def long_call():
    return koksma.measure(ROWS, "star")  # days


def send_in_call(number):
    """Starts a thread that sends the signal when a call of the library has the handlers; after seconds anyway, as a function in
    Python that calls the library for short parts of its work may have them for moments only, and then not at all."""
    def send():
        end = time.monotonic() + 5
        while not isinstance(signal.getsignal(number), Signals) and time.monotonic() < end:
            time.sleep(0.001)
        os.kill(os.getpid(), number)

    thread = threading.Thread(target=send)
    thread.start()
    return thread


class Case(unittest.TestCase):
    def setUp(self):
        self.before = {number: signal.getsignal(number) for number in signal.valid_signals()}
        self.unraisable = []
        self.hook, sys.unraisablehook = sys.unraisablehook, self.unraisable.append

    def tearDown(self):
        signal.setitimer(signal.ITIMER_REAL, 0)
        sys.unraisablehook = self.hook
        for number, handler in self.before.items():
            if signal.getsignal(number) is not handler:
                signal.signal(number, handler)
        self.assertEqual(self.unraisable, [])  # where ctypes tells what it drops

    def on(self, number, handler):
        signal.signal(number, handler)
        return handler


def raising(error):
    def handler(_number, _frame):
        raise error
    return handler


class Raised(Case):
    def test_timeout(self):
        handler = self.on(signal.SIGALRM, raising(Timeout("alarm")))
        for call in (long_call, lambda: koksma.generate("best-candidate", 40000),
                     lambda: koksma.render("balls", spp=4096, size=(640, 480))):
            with self.assertRaisesRegex(Timeout, "alarm"):
                signal.setitimer(signal.ITIMER_REAL, 0.1)
                call()
            self.assertIs(signal.getsignal(signal.SIGALRM), handler)
            self.assertIs(signal.getsignal(signal.SIGINT), self.before[signal.SIGINT])

    def test_any_signal(self):
        for number in (signal.SIGTERM, signal.SIGUSR1, signal.SIGCHLD, signal.SIGRTMAX):
            self.on(number, raising(Timeout("any")))
            with self.assertRaises(Timeout):
                thread = send_in_call(number)
                long_call()
            thread.join()

    def test_adaptive_renders(self):
        """Control-C ends one of each method, and the next is as ever."""
        handler = self.on(signal.SIGINT, raising(KeyboardInterrupt()))
        for method in [m.name for m in koksma.adaptive()]:
            arguments = dict(size=(16, 12), adaptive=method, budget=32)
            before = koksma.render("ball", spp=4, **arguments)
            with self.subTest(method=method), self.assertRaises(KeyboardInterrupt):
                thread = send_in_call(signal.SIGINT)
                koksma.render("balls", spp=64, size=(1024, 1024), adaptive=method, budget=10000)
            thread.join()
            self.assertIs(signal.getsignal(signal.SIGINT), handler)
            np.testing.assert_array_equal(koksma.render("ball", spp=4, **arguments), before)

    def test_control_c_of_each_long_call(self):
        """KeyboardInterrupt comes out of each, as Python's own handler raises it; a study opens again."""
        signal.signal(signal.SIGINT, signal.default_int_handler)
        many = [{"name": "long", "title": "Long", "discrepancies": [{"id": "d", "patterns": ["random"], "measures": ["star"],
                                                                     "n": [2048], "trials": 100000}]}]
        picture = koksma.plot(koksma.generate("random", 1 << 21))
        with tempfile.TemporaryDirectory() as folder:
            study = koksma.Study(many, folder)
            calls = {"optimise": lambda: koksma.optimise("star", 64, time_limit=1e6),
                     "optimise with progress": lambda: koksma.optimise("star", 64, progress=lambda best: True),
                     "integrate": lambda: koksma.integrate("genz-gaussian", "sobol:scramble=owen", [1 << 20], trials=100000),
                     "integrate a callable": lambda: koksma.integrate(lambda x: x[:, 0], "sobol:scramble=owen", [1 << 20], trials=100000),
                     "witness": lambda: koksma.plot(koksma.generate("random", 1 << 11, 6), witness="star"),
                     "rank": lambda: koksma.rank("balls", spp=1024, size=(640, 480), time_limit=None),
                     "datasheet": lambda: koksma.datasheet("sobol:scramble=owen"),
                     "plot": lambda: picture.svg,
                     "study": study.run}
            for name, call in calls.items():
                with self.subTest(call=name), self.assertRaises(KeyboardInterrupt):
                    thread = send_in_call(signal.SIGINT)
                    call()
                thread.join()
                self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
            study.close()
            with koksma.Study(many, folder) as again:  # nothing is locked or damaged
                self.assertEqual(len(again.tables()), 0)

    def test_a_call_that_never_asks(self):
        self.on(signal.SIGUSR1, raising(Timeout("early")))
        with self.assertRaisesRegex(Timeout, "early"):
            _library.call(lambda _run: signal.raise_signal(signal.SIGUSR1) or 0, run_at=0)


class NotRaised(Case):
    def test_the_call_goes_on(self):
        seen, expected = [], koksma.generate("best-candidate", 1500, seed=4)
        self.on(signal.SIGALRM, lambda number, _frame: seen.append(number))
        signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
        while not seen:
            np.testing.assert_array_equal(koksma.generate("best-candidate", 1500, seed=4), expected)
        signal.setitimer(signal.ITIMER_REAL, 0)
        self.assertEqual(set(seen), {signal.SIGALRM})

    def test_a_handler_may_call_the_library(self):
        values = []

        def handler(_number, _frame):
            values.append(koksma.measure(PLANE, "star").value)
            if len(values) == 3:
                signal.setitimer(signal.ITIMER_REAL, 0)
                raise Timeout

        self.on(signal.SIGALRM, handler)
        with self.assertRaises(Timeout):
            signal.setitimer(signal.ITIMER_REAL, 0.05, 0.05)
            long_call()
        self.assertEqual(values, 3 * [koksma.measure(PLANE, "star").value])
        self.assertIs(signal.getsignal(signal.SIGALRM), handler)

    def test_errors_come_out_as_ever(self):
        handler = self.on(signal.SIGUSR1, raising(Timeout))
        with self.assertRaises(koksma.ArgumentError):
            koksma.measure([[0.5, 1.5]])
        self.assertIs(signal.getsignal(signal.SIGUSR1), handler)

    def test_short_calls_leave_handlers_alone(self):
        """Few points of any pattern that has ranges, strata or Latin sets, and any exact measure of few points, and what was
        short before; nothing else."""
        class Taken(Exception):
            pass

        def take():
            raise Taken

        self.addCleanup(setattr, _library, "Signals", Signals)
        _library.quick.clear()
        _library.Signals = take
        ranged = [m.name for m in koksma.patterns() if not m.operand and koksma.has_ranges(m.name) and m.min_dim <= 2 <= m.max_dim]
        self.assertGreater(len(ranged), 10)
        for name in ranged:
            points = koksma.generate(name, 13 if name == "fibonacci" else 16)
        sets = [m for m in koksma.patterns() if not m.operand and m.name not in ranged and {"stratified", "latin"} & set(m.claims)]
        self.assertGreater(len(sets), 5)
        for pattern in sets:
            koksma.generate(pattern.name, 25 if pattern.name == "orthogonal-array" else 16)
        self.assertEqual(koksma.generate("sobol", 16, first=1 << 30).shape, (16, 2))
        for name in ("star", "l2-star", "extreme", "edge", "min-distance"):
            self.assertGreater(koksma.measure(points, name).value, 0)
        for longer in (lambda: koksma.generate("best-candidate", 16), lambda: koksma.generate("sobol", 1 << 18),
                       lambda: koksma.generate("n-rooks", 33),
                       lambda: koksma.measure(PLANE, "star"), lambda: koksma.measure(points, "star-lower"),
                       lambda: koksma.measure(points, "extreme:grid=9"), lambda: koksma.measure(points, "star", time_limit=9)):
            self.assertRaises(Taken, longer)
        _library.Signals = Signals
        calls = (lambda: koksma.measure(PLANE, "star").value, lambda: koksma.generate("n-rooks", 33).tolist(),
                 lambda: koksma.generate("n-rooks", 33, out=np.zeros((33, 2))).tolist())
        values = [call() for call in calls]
        while not {("star", PLANE.shape), ("n-rooks", (33, 2))} <= _library.quick:  # a busy machine may take its time
            self.assertEqual([call() for call in calls], values)
        _library.Signals = take
        self.assertEqual([call() for call in calls], values)
        self.assertRaises(Taken, lambda: koksma.measure(PLANE[1:], "star"))
        _library.Signals = Signals
        self.on(signal.SIGUSR1, raising(Timeout("after")))
        with self.assertRaisesRegex(Timeout, "after"):
            _library.call(lambda _run: signal.raise_signal(signal.SIGUSR1) or 0, run_at=0, short=True)

    def test_in_another_thread(self):
        handler, results = self.on(signal.SIGUSR1, raising(Timeout("outside"))), []
        thread = threading.Thread(target=lambda: results.append(koksma.measure(ROWS, "star", time_limit=0.3).exact))
        thread.start()
        with self.assertRaisesRegex(Timeout, "outside"):
            os.kill(os.getpid(), signal.SIGUSR1)
            thread.join()
        thread.join()
        self.assertEqual(results, [False])
        self.assertIs(signal.getsignal(signal.SIGUSR1), handler)


LIBC = ctypes.CDLL(None)
LIBC.signal.argtypes, LIBC.signal.restype = [ctypes.c_int, ctypes.c_void_p], ctypes.c_void_p
NOTHING = ctypes.cast(LIBC.abs, ctypes.c_void_p).value  # a function in C that takes a signal's number and leaves no trace


class OfTheHost(Case):
    """What a program that Python is a part of has set in C."""

    def tearDown(self):
        if getattr(self, "pythons", None):
            LIBC.signal(signal.SIGUSR1, self.pythons)
        super().tearDown()

    def test_a_handler_in_c_stays(self):
        self.on(signal.SIGUSR1, raising(Timeout("the host's handler was not called")))
        self.pythons = LIBC.signal(signal.SIGUSR1, NOTHING)

        def body(_run):
            os.kill(os.getpid(), signal.SIGUSR1)
            return 0

        os.kill(os.getpid(), signal.SIGUSR1)
        koksma.generate("random", 4)
        _library.call(body, run_at=0)
        os.kill(os.getpid(), signal.SIGUSR1)
        self.assertEqual(LIBC.signal(signal.SIGUSR1, NOTHING), NOTHING)

    def test_signals_without_handlers_are_left_alone(self):
        code = ("import ctypes, signal, koksma\n"
                "of = ctypes.pythonapi.PyOS_getsig\n"
                "of.restype = ctypes.c_void_p\n"
                "before = [(of(n), signal.getsignal(n)) for n in sorted(signal.valid_signals())]\n"
                "koksma.generate('random', 4)\n"
                "print(before == [(of(n), signal.getsignal(n)) for n in sorted(signal.valid_signals())])\n")
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual((run.stdout, run.stderr), ("True\n", ""))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
