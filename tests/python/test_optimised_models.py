#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The models of tools/optimised_models.py on simulated rows: they find planted effects, and where there is none they say so in
95 % of the experiments; their parts against definitions; the stored rows still give the page."""
import json
import lzma
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

TREE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TREE / "tools"))
import optimised_models as models  # pylint: disable=wrong-import-position,import-error


def simulated(rng, targets, search, scene, both):
    """Log errors [target, search, scene], with standard deviations of what is drawn for each target."""
    return (search * rng.normal(size=(targets, 8, 1)) + scene * rng.normal(size=(targets, 1, 10)) + both * rng.normal(size=(targets, 8, 10)))


class Parts(unittest.TestCase):
    def test_student(self):
        """Tables of Student's t: 95 % two-sided, and 99 %."""
        for confidence, df, value in [(0.95, 1, 12.7062), (0.95, 9, 2.26216), (0.95, 30, 2.04227), (0.99, 7, 3.49948), (0.95, 1e6, 1.95997)]:
            self.assertAlmostEqual(models.student(confidence, df) / value, 1, places=4)

    def test_squares(self):
        """They add up to the total, and a two-way layout's are those of the textbook."""
        y = np.random.default_rng(3).normal(size=(3, 4, 5, 2))
        found = models.squares(y, "abcd")
        self.assertAlmostEqual(sum(ss for ss, _ in found.values()), ((y - y.mean())**2).sum())
        self.assertEqual(sum(df for _, df in found.values()), y.size - 1)
        two = y[:, :, 0, 0]
        self.assertAlmostEqual(models.squares(two, "ab")["a",][0], 4 * ((two.mean(1) - two.mean())**2).sum())
        share = models.shares(y, "abcd", {"a": lambda e: e == {"a"}, "rest": lambda e: True})
        self.assertAlmostEqual(sum(share.values()), 1)

    def test_correlations(self):
        """Spearman's by ranks with ties averaged; the partial one is that of the residuals of a regression on the other ranks."""
        self.assertEqual(list(models.ranks([3, 1, 3, 2])), [2.5, 0, 2.5, 1])
        rng = np.random.default_rng(4)
        x = rng.normal(size=(60, 3))
        y = x[:, 0] + 0.5 * x[:, 1] + 0.3 * rng.normal(size=60)
        ranked = np.column_stack([models.ranks(v) for v in (*x.T, y)])
        whole, partial = models.correlations(ranked)
        for j in range(3):
            others = np.column_stack([np.ones(60), np.delete(ranked[:, :3], j, 1)])
            rest = [v - others @ np.linalg.lstsq(others, v, rcond=None)[0] for v in (ranked[:, j], ranked[:, 3])]
            self.assertAlmostEqual(partial[j], np.corrcoef(*rest)[0, 1], places=6)
            self.assertAlmostEqual(whole[j], 1 - 6 * ((ranked[:, j] - ranked[:, 3])**2).sum() / (60 * 3599), places=6)

    def test_components(self):
        """The means over experiments are the variances that were planted."""
        rng, planted = np.random.default_rng(5), {"target": 0.3, "target x n": 0.2, "target x scene": 0.25, "search": 0.15, "set x scene, noise": 0.1}
        found = []
        for _ in range(16):
            y = planted["target"] * rng.normal(size=(15, 1, 1, 1)) + planted["target x n"] * rng.normal(size=(15, 7, 1, 1))
            y = y + planted["target x scene"] * rng.normal(size=(15, 1, 1, 10)) + planted["search"] * rng.normal(size=(15, 7, 8, 1))
            found.append(models.components(y + planted["set x scene, noise"] * rng.normal(size=(15, 7, 8, 10))))
        for name, sd in planted.items():
            values = [f[name] for f in found]
            self.assertLess(abs(np.mean(values) - sd**2), 4 * np.std(values) / 16**0.5 + 1e-9, name)


class Contrasts(unittest.TestCase):
    CASES = [(0.02, 0.05, 0.05), (0.05, 0.02, 0.02), (0, 0.05, 0.02), (0.03, 0, 0.02), (0, 0, 0.05)]

    def test_no_effect(self):
        """In at least 95 % of families of 15 contrasts none is wrong; 95 % here within four standard errors of a simulation."""
        for case in self.CASES:
            rng, wrong, trials = np.random.default_rng(6), 0, 120
            for _ in range(trials):
                y = simulated(rng, 16, *case)
                found = [models.contrast(y[k] - y[0], 15) for k in range(1, 16)]
                wrong += any(low > 0 or high < 0 for _, low, high in found)
            self.assertLess(wrong / trials, 0.05 + 4 * (0.05 * 0.95 / trials)**0.5, case)

    def test_effect(self):
        """An effect of six standard errors is found in most experiments, with its size."""
        for case in self.CASES:
            rng, search, scene, both = np.random.default_rng(7), *case
            size = 6 * (2 * (search**2 / 8 + scene**2 / 10 + both**2 / 80))**0.5
            y = [simulated(rng, 2, *case) for _ in range(100)]
            found = [models.contrast(v[1] - v[0] - size) for v in y]
            self.assertGreater(np.mean([high < 0 for _, _, high in found]), 0.9, case)
            self.assertGreater(np.mean([low <= -size <= high for _, low, high in found]), 0.95 - 4 * (0.05 * 0.95 / 100)**0.5, case)


class Rows(unittest.TestCase):
    def test_planted(self):
        """From files: one target is 10 % better in all scenes, the others differ by searches and scenes alone."""
        design = {"n": [4, 16], "searches": 8, "targets": [{"name": t} for t in ("none", "a", "b", "good")], "scenes": [{"name": f"s{c}"} for c in range(10)],
                  "measures": ["good"], "patterns": ["p"], "best-patterns": ["p"]}
        rng, rows, sets = np.random.default_rng(8), ["target,n,search,scene,filter,arm,trial,mae,rmse"], ["target,n,search,good"]
        for n in design["n"]:
            noise = simulated(rng, 4, 0.01, 0.01, 0.01) + np.log(1 / n)
            for t, target in enumerate(("none", "a", "b", "good")):
                for s in range(8):
                    sets.append(f"{target},{n},{s},{0.2 if target == 'good' else 0.5 + 0.1 * t}")
                    rows += [f"{target},{n},{s},s{c},box,shift,0,{np.exp(noise[t, s, c]) * (0.9 if target == 'good' else 1)},1" for c in range(10)]
            rows += [f"pattern:p,{n},-1,s{c},box,pattern,{k},{0.95 / n},1" for c in range(10) for k in range(4)]
        with tempfile.TemporaryDirectory() as folder:
            for kind, lines in (("images", rows), ("sets", sets), ("bias", ["target"])):
                (pathlib.Path(folder) / f"{kind}-1.csv.xz").write_bytes(lzma.compress("\n".join(lines).encode()))
            seed = models.Seed(pathlib.Path(folder), 1, design)
        found = {t: e["none"] for t, e in models.effects(seed, "shift").items()}
        self.assertTrue(found["good"][1] <= 0.9 <= found["good"][2] < 1, found)
        self.assertTrue(all(found[t][1] <= 1 <= found[t][2] for t in "ab"), found)
        self.assertEqual(seed.best_target(), "good")
        self.assertAlmostEqual(models.reached(seed)["good"], 0.2 / 0.5)
        low, high = models.against(seed, "good", "p")[1:]
        self.assertTrue(low <= 0.9 / 0.95 <= high)
        only = models.in_scene(seed, "good", "p", "s3")
        self.assertTrue(0 < only[1] <= only[0] <= only[2])

    def test_page(self):
        """The stored rows give every line of the page's tables, and the stored numbers."""
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "o.json"
            done = subprocess.run([sys.executable, "-B", str(TREE / "tools/optimised_models.py"), "-o", str(out), "--check",
                                   str(TREE / "docs/findings/optimised.md")], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            stored, made = (json.loads(p.read_text(encoding="utf-8")) for p in (TREE / "docs/findings/optimised.json", out))
            self.assertEqual(stored["images"], made["images"])
            for seed in stored["seeds"]:
                self.assertEqual(stored["seeds"][seed]["hypotheses"], made["seeds"][seed]["hypotheses"])


if __name__ == "__main__":
    unittest.main()
