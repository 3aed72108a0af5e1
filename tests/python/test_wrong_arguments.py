#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every parameter of every public function, wrong in turn: what comes is koksma's, Python's TypeError or ValueError, in words of
Python, on one line, and a TypeError names the parameter. Nothing crashes: that would end this process."""
import ctypes
import inspect
import os
import tempfile
import unittest
import warnings

import numpy as np

import koksma


class Odd:
    pass


WRONG = [None, -1, 2.5, float("nan"), float("inf"), 1 << 70, "", "q\0q", "nothing:of=this", b"bytes", "x" * 3000, [], [None], ["q"], {},
         (1, 2, 3), Odd(), 1j, np.zeros((0, 2)), np.full((3, 2), np.nan), np.zeros((2, 2, 2, 2, 2)), "\ud800", np.array(["a"]), [[1, [2]]],
         [2.5], [-1], ["random\0"], lambda *_: Odd()]
# Other words for a parameter: of scipy's and numpy's own checks, and of what a parameter consists of.
SYNONYMS = {"text_of_spec": "pattern", "patterns": "patterns?", "size": "width|size", "function": "function|integrand|argument|float",
            "axes": "axes|axis", "seed": "seed|SeedSequence|integer", "rng": "rng|seed|SeedSequence|integer", "d": "d|int|integer", "image": "image|pixels",
            "images": "images?|pixels", "reference": "image|pixels|reference", "plan": "plan|JSON|dict"}
NEVER = r"ctypes|koksma_[a-z]|(?<!\w)--[a-z]|koksma list"


class WrongArguments(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._before, cls._folder = os.getcwd(), tempfile.TemporaryDirectory()
        os.chdir(cls._folder.name)

    @classmethod
    def tearDownClass(cls):
        os.chdir(cls._before)
        cls._folder.cleanup()

    def calls(self):
        points, image, small = koksma.generate("jittered", 16), np.ones((4, 4), np.float32), (4, 3)
        plan = {"name": "m", "title": "M", "discrepancies": [{"id": "d", "patterns": ["random"], "measures": ["star"], "n": [4], "trials": 2}]}
        koksma.write("p.npy", points)
        koksma.write_image("i.pfm", image)
        koksma.write_mask("m.npy", image)
        koksma.write_image("i_1.pfm", image)
        with koksma.Study(plan, "done") as study:
            study.run()
        curve, engine = koksma.convergence("sobol", "l2-star", [4, 8]), koksma.Engine("sobol")
        for function, given in (
                (koksma.generate, dict(pattern="sobol", n=16)), (koksma.measure, dict(points=points)), (koksma.read, dict(path="p.npy")),
                (koksma.write, dict(path="q.npy", points=points)), (koksma.verify, dict(points=points)),
                (koksma.spectrum, dict(sets=points, half=4)), (koksma.pair_correlation, dict(sets=points)),
                (koksma.trials, dict(pattern="jittered", n=4, trials=2)), (koksma.convergence, dict(pattern="sobol", sizes=[4, 8])),
                (koksma.canonical, dict(text_of_spec="sobol")), (koksma.has_ranges, dict(pattern="sobol")),
                (koksma.integrand, dict(name="genz-gaussian")), (koksma.integrate, dict(function="genz-gaussian", pattern="sobol", n=4)),
                (koksma.optimise, dict(measure="l2-star", n=4, steps=1)),
                (koksma.mask, dict(filter="box:size=2", size=(4, 5), swaps=2)), (koksma.mask_quality, dict(mask=image, filter="box:size=2", tests=2)),
                (koksma.read_mask, dict(path="m.npy")), (koksma.write_mask, dict(path="n.npy", mask=image)),
                (koksma.radial_power, dict(target="step", n=4)), (koksma.render, dict(scene="ball", spp=1, size=small)),
                (koksma.rank, dict(scene="ball", patterns=["random"], spp=1, size=small, one_size=True, max_trials=8)),
                (koksma.compare, dict(images=image, reference=image)), (koksma.read_image, dict(path="i.pfm")),
                (koksma.write_image, dict(path="j.pfm", image=image)), (koksma.plot, dict(sets=points)),
                (koksma.plot_compare, dict(patterns="random", n=4, trials=2, sizes=[4, 8])), (koksma.plot_convergence, dict(results=curve)),
                (koksma.audit, dict(folder="done")), (koksma.Study, dict(plan=plan)), (koksma.Engine, dict(pattern="sobol")),
                (engine.random, {}), (engine.random_base2, dict(m=0)), (engine.fast_forward, dict(n=1)),
                (koksma.warp_points, dict(points=points, warp="polar-disk")),
                (koksma.local_discrepancy, dict(points=points, corner=[0.5, 0.5])), (koksma.check_scene, dict(scene="ball"))):
            yield function, given
        yield lambda seconds=1: koksma.allow_exec(seconds).__enter__(), {}

    def call(self, function, given):
        several = [p.name for p in inspect.signature(function).parameters.values() if p.kind is p.VAR_POSITIONAL]
        return function(*[given[name] for name in several if name in given], **{k: v for k, v in given.items() if k not in several})

    def test_all(self):
        warnings.simplefilter("ignore")
        for function, given in self.calls():
            for name in inspect.signature(function).parameters:
                for wrong in WRONG:
                    with self.subTest(function=getattr(function, "__qualname__", function), parameter=name, wrong=f"{wrong!r:.40}"):
                        try:
                            self.call(function, {**given, name: wrong})
                        except (koksma.Error, TypeError, ValueError) as error:
                            self.assertNotIsInstance(error, ctypes.ArgumentError)
                            self.assertNotRegex(str(error), NEVER)
                            self.assertNotIn("\n", str(error))
                            if type(error) is TypeError and not callable(wrong):
                                self.assertRegex(str(error), rf"\b({SYNONYMS.get(name, name)})\b")
        koksma._library.core().koksma_allow_exec(0.0)

    def test_flags(self):
        """What has a truth value is not yet True or False, least of all the texts 'no' and 'False', which are true."""
        seen = set()
        for function, given in self.calls():
            for name, parameter in inspect.signature(function).parameters.items():
                if parameter.annotation not in ("bool", "Optional[bool]"):
                    continue
                seen.add(name)
                for wrong in ("no", "False", "", -1, 0, 1, float("nan"), [], [True], np.array([True]), 0 * 1j):
                    with self.subTest(function=getattr(function, "__qualname__", function), parameter=name, wrong=repr(wrong)):
                        with self.assertRaisesRegex(TypeError, f"^{name} must be True or False, not "):
                            self.call(function, {**given, name: wrong})
                needs = dict(tolerance=1.0, pattern="random") if name == "relative" else {}
                for right in (True, False, np.True_, np.False_):
                    self.call(function, {**given, **needs, name: right})
        self.assertLessEqual({"allow_exec", "exact", "layers", "local_discrepancy", "one_size", "prefixes", "quick", "splat"}, seen)

    def test_numbers_that_are_none(self):
        """NaN is no number of the range that a message states, and the message states the same range as for -1."""
        for function, given in ((koksma.render, dict(scene="ball", spp=1, size=(4, 3), sky=-1.0)),
                                (koksma.render, dict(scene="ball", spp=1, size=(4, 3), adaptive="contrast", budget=-1.0)),
                                (koksma.plot, dict(sets=[[0.5, 0.5]], size=-1.0)), (koksma.pair_correlation, dict(sets=[[0.5, 0.5]], r_max=-1.0))):
            name = list(given)[-1]
            said = []
            for wrong in (-1.0, float("nan")):
                with self.assertRaises(koksma.ArgumentError) as caught:
                    self.call(function, {**given, name: wrong})
                said.append(str(caught.exception))
            self.assertEqual(said[0].replace("-1.0", "nan").replace("-1", "nan"), said[1])
            self.assertNotRegex(said[1], "-?inf")

    def test_data_in_place_of_files(self):
        """What is malformed is said of data as of a file: with MalformedError, and what is wrong."""
        nothing = np.zeros((4, 4), np.float32)
        self.assertRaisesRegex(koksma.MalformedError, "not a finite number", koksma.compare, nothing * np.nan, nothing)
        for plan in ("", [""]):
            self.assertRaisesRegex(koksma.ArgumentError, r"^plan must be .* \(\) for the plan that the folder has", koksma.Study, plan, "done")
        self.assertRaises(koksma.MissingError, koksma.Study, (), "no_study")

    def test_sizes_given_twice(self):
        """Two equal sizes and another are no three for a slope. The words are the program's."""
        self.assertRaisesRegex(koksma.ArgumentError, "^sizes: 16 is given twice$", koksma.convergence, "random", "l2-star", [16, 16, 64])
        self.assertRaisesRegex(koksma.ArgumentError, "^sizes: 4 is given twice$", koksma.plot_compare, "random", n=4, sizes=[4, 8, 4])
        for function in ("disk", lambda x: self.fail("it was called")):
            self.assertRaisesRegex(koksma.ArgumentError, "^n: 16 is given twice$", koksma.integrate, function, "random", [64, 16, 16])

    def test_the_last_seeds(self):
        """Trials have consecutive seeds, which end at 2^64 - 1; the message has the seed that was given."""
        last = 2**64 - 1
        wrong = f"^seed {last - 1}: 3 trials end at this seed . 2, but seeds end at {last}; {last - 2} or less would do$"
        for function, given in ((koksma.trials, ("random", 4)), (koksma.convergence, ("random", "l2-star", [4, 8])),
                                (koksma.plot_compare, ("random",)), (koksma.integrate, ("disk", "random", 4)),
                                (koksma.integrate, (lambda x: x[:, 0], "random", 4))):
            with self.assertRaisesRegex(koksma.ArgumentError, wrong):
                function(*given, trials=3, seed=last - 1)
        values = koksma.trials("random", 4, trials=3, seed=last - 2).values
        self.assertEqual(list(values), [koksma.measure(koksma.generate("random", 4, seed=last - 2 + t), "star").value for t in range(3)])
        self.assertEqual(koksma.integrate("disk", "random", 4, trials=3, seed=last - 2).trials, 3)

    def test_programs_are_not_run(self):
        """allow_exec guards the execution of code: only True runs a program, also where the same call was made before."""
        with open("evil.sh", "w") as program:
            program.write("#!/bin/sh\n: > was_run\nexit 1\n")
        os.chmod("evil.sh", 0o755)
        for wrong in ("no", "False", -1, 1, float("nan"), [False], np.array([True])):
            with self.subTest(wrong=repr(wrong)):
                self.assertRaises(TypeError, koksma.generate, "exec:./evil.sh", 4, 2, allow_exec=wrong)
        for wrong in ("no", "60", True, np.True_, None):  # a number of seconds, not a yes
            self.assertRaises(TypeError, koksma.allow_exec(wrong).__enter__)
        for _ in range(3):
            koksma.generate("jittered", 16, 2)
        self.assertRaises(TypeError, koksma.generate, "jittered", 16, 2, allow_exec="no")
        for right in (False, np.False_):
            self.assertRaises(koksma.ForbiddenError, koksma.generate, "exec:./evil.sh", 4, 2, allow_exec=right)
        self.assertFalse(os.path.exists("was_run"))
        self.assertRaises(koksma.Error, koksma.generate, "exec:./evil.sh", 4, 2, allow_exec=np.True_)
        self.assertTrue(os.path.exists("was_run"))


if __name__ == "__main__":
    unittest.main()
