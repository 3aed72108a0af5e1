#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scipy's own tests of QMC engines, with koksma.Engine as the engine. Skipped without scipy, its tests, or pytest."""
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np
    import pytest
    from scipy.stats import qmc
    from scipy.stats.tests.test_qmc import QMCEngineTests
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(0)

import koksma


def engines(plain, scrambled):
    """scipy makes an engine from d, scramble and seed; ours has the pattern's name besides."""
    def make(d, scramble=False, seed=None, optimization=None):
        return koksma.Engine(scrambled if scramble else plain, d, seed=seed, optimization=optimization)
    return staticmethod(make)


def drawn(pattern, n):
    """What the library itself gives for the seed that scipy's tests draw."""
    seed = np.random.default_rng(170382760648021597650530316304495310428).integers(0, np.iinfo(np.int64).max, dtype=np.int64)
    return koksma.generate(pattern, n, 2, int(seed))


def scipys_sobol(m):
    """scipy's own points, which are in Gray code's order, in the natural one."""
    points, natural = qmc.Sobol(2, scramble=False).random_base2(m), np.empty((1 << m, 2))
    i = np.arange(1 << m)
    natural[i ^ i >> 1] = points
    return natural


class TestSobol(QMCEngineTests):
    qmce, can_scramble = engines("sobol", "sobol:scramble=owen"), True
    unscramble_nd = scipys_sobol(3)
    scramble_nd = drawn("sobol:scramble=owen", 8)


class TestHashedSobol(QMCEngineTests):
    qmce, can_scramble = engines("sobol", "sobol:scramble=hash-owen"), True
    unscramble_nd = scipys_sobol(3)
    scramble_nd = drawn("sobol:scramble=hash-owen", 8)


class TestHalton(QMCEngineTests):
    qmce, can_scramble = engines("halton", "halton:scramble=owen"), True
    unscramble_nd = qmc.Halton(2, scramble=False).random(9)
    scramble_nd = drawn("halton:scramble=owen", 9)


class TestRandom(QMCEngineTests):
    qmce, can_scramble = engines("random", "random"), True
    unscramble_nd = scramble_nd = drawn("random", 8)

    def test_distribution(self):
        pytest.skip("independent points are further from their quantiles than scipy asks")


class TestLatinHypercube(QMCEngineTests):
    """As scipy's own class: sets that are not a sequence don't continue."""
    qmce, can_scramble = engines("n-rooks", "n-rooks"), True
    unscramble_nd = scramble_nd = drawn("n-rooks", 8)

    def test_continuing(self):
        pytest.skip("not applicable: not a sequence")

    def test_fast_forward(self):
        pytest.skip("not applicable: not a sequence")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        sys.exit(pytest.main(["-q", "-p", "no:cacheprovider", "--rootdir", folder, "--override-ini=python_classes=Test*", "-W", "ignore",
                              str(Path(__file__).resolve())]))
