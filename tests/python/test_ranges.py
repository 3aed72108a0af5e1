# SPDX-License-Identifier: Apache-2.0
"""Ranges of sequences far out, against whole numbers of Python: no value here comes from the library."""
import unittest
from decimal import Decimal, getcontext
from fractions import Fraction

import numpy as np

import koksma
from koksma import Engine, _points, generate

PRIMES = (2, 3, 5, 7, 11, 13, 17)


def radical_inverse(i, base):
    numerator, denominator = 0, 1
    while i:
        i, digit = divmod(i, base)
        numerator, denominator = numerator * base + digit, denominator * base
    return Fraction(numerator, denominator)


def faure(i, base, k):
    """Digit r is the sum over c of C(c, r) k^(c-r) a_c, modulo the base."""
    digits = []
    while i:
        i, digit = divmod(i, base)
        digits.append(digit)
    x, place = Fraction(0), Fraction(1)
    for r in range(len(digits)):
        y, binomial, power = 0, 1, 1
        for c in range(r, len(digits)):
            y += binomial * power * digits[c]
            binomial, power = binomial * (c + 1) // (c + 1 - r), power * k
        place /= base
        x += y % base * place
    return x


# Joe & Kuo 2008, new-joe-kuo-6: degree, a, m_i of dimensions 2 to 5.
JOE_KUO = ((1, 0, (1,)), (2, 1, (1, 3)), (3, 1, (1, 3, 1)), (3, 2, (1, 1, 1)))


def sobol(i, k):
    """Point i in natural order, by the direction numbers v_j = m_j / 2^j, without a Gray code."""
    m = [1] * 32
    if k:
        s, a, first = JOE_KUO[k - 1]
        m = list(first)
        for j in range(s, 32):
            new = m[j - s] ^ m[j - s] << s
            for t in range(1, s):
                if a >> (s - 1 - t) & 1:
                    new ^= m[j - t] << t
            m.append(new)
    x = 0
    for j in range(32):
        if i >> j & 1:
            x ^= m[j] << (31 - j)
    return Fraction(x, 1 << 32)


def far(*last):
    """Indices small and large, about powers of two and others, up to the last that are served."""
    places = [0, 1, 1000, 99999, (1 << 28) - 2, 10 ** 9, (1 << 31) - 1, (1 << 32) - 5]
    return sorted(set(places) | set(last))


class Ranges(unittest.TestCase):
    def check(self, spec, dim, value, places, n=4, **keywords):
        for first in places:
            points = generate(spec, n, dim, first=first, **keywords)
            wanted = [[float(value(first + i, k)) for k in range(dim)] for i in range(n)]
            with self.subTest(spec, first=first):
                np.testing.assert_array_equal(points, np.array(wanted))

    def test_halton(self):
        self.check("halton", 7, lambda i, k: radical_inverse(i, PRIMES[k]), far(1 << 40, 3 * 10 ** 13, 17 ** 12 - 4))

    def test_faure(self):
        for dim, base, last in ((2, 2, (1 << 51) - 4), (3, 3, 3 ** 31), (5, 5, 5 ** 21), (7, 7, 7 ** 17)):
            self.check("faure", dim, lambda i, k, b=base: faure(i, b, k), far(1 << 40, last))

    def test_sobol(self):
        self.check("sobol", 5, sobol, far())
        for first in (0, 12345, (1 << 31) - 9):  # over the ends of groups, and in many dimensions
            np.testing.assert_array_equal(generate("sobol", 70000, 20, first=first)[69990:, :5],
                                          generate("sobol", 10, 5, first=first + 69990))

    def test_r_sequence(self):
        """To the last bit by the ratios in 64 bits, rounded down or to nearest, and near {1/2 + i a} with 60 digits."""
        getcontext().prec = 60
        for dim in (1, 2):
            g = Decimal(1)
            for _ in range(200):  # Newton, g^(dim+1) = g + 1
                g -= (g ** (dim + 1) - g - 1) / ((dim + 1) * g ** dim - 1)
            ratios = [1 / g ** (k + 1) for k in range(dim)]
            words = []
            for k in range(dim):  # what a step adds has 53 bits of the ratio: only one of the two fits far out
                low = int(ratios[k] * 2 ** 64)
                out = int(generate("r-sequence", 1, dim, first=(1 << 51) - 1)[0, k] * 2 ** 53)
                words += [w for w in (low, low + 1) if ((1 << 63) + (1 << 51) * w) % (1 << 64) >> 11 == out]
            self.assertEqual(len(words), dim)
            for first in far(1 << 40, (1 << 51) - 4):
                points = generate("r-sequence", 4, dim, first=first)
                for i in range(4):
                    for k in range(dim):
                        x = ((1 << 63) + (first + i + 1) * words[k]) % (1 << 64) >> 11
                        self.assertEqual(points[i, k], x / 2 ** 53)
                        gap = abs(Decimal(x) / 2 ** 53 - (Decimal("0.5") + (first + i + 1) * ratios[k]) % 1)
                        self.assertLess(min(gap, 1 - gap), (first + 5) * Decimal(2) ** -64 + Decimal(2) ** -53)

    def test_scrambled_nets(self):
        """Aligned blocks far out are (0,m,2)-nets, and a shift by digits is one."""
        for spec in ("sobol:scramble=owen", "sobol:scramble=hash-owen,shuffle=1", "sobol:scramble=lms", "pmj02",
                     "pmj02:shuffle=1", "sobol:owen=1", "sobol:digital-shift=1"):
            for first in (1 << 20, 7 << 28, (1 << 32) - 256):
                points = generate(spec, 256, 2, 5, first=first)
                for a in range(9):
                    cells = np.floor(points * (1 << a, 1 << (8 - a)))
                    self.assertEqual(len({tuple(c) for c in cells}), 256, (spec, first, a))
        shift = {sum((int(x * 2 ** 32) ^ int(sobol(i, k) * 2 ** 32)) << 32 * k for k, x in enumerate(p))
                 for i, p in enumerate(generate("sobol:scramble=digital-shift", 64, 2, 3, first=1 << 30), 1 << 30)}
        self.assertEqual(len(shift), 1)

    def test_pieces(self):
        """What lies far out does not depend on where a range begins."""
        for member in koksma.patterns():
            if member.operand or not (koksma.has_ranges(member.name) and _points.is_sequence(member.name)):
                continue
            end = 3 ** 20 if member.name == "ternary-quads" else 1 << 32  # its matrices have 20 columns
            for first in (1 << 31, end - 5000):
                whole = generate(member.name, 5000, 2, 9, first=first)
                for at in (1, 511, 512, 4095, 4999):
                    np.testing.assert_array_equal(generate(member.name, 5000 - at, 2, 9, first=first + at), whole[at:])

    def test_ends(self):
        for spec, dim, end in (("sobol", 2, 1 << 32), ("sobol:scramble=owen", 2, 1 << 32), ("pmj02", 2, 1 << 32),
                               ("r-sequence:shuffle=1", 2, 1 << 32), ("random", 3, 1 << 51), ("halton", 7, 17 ** 12),
                               ("faure", 7, 7 ** 18)):
            self.assertEqual(generate(spec, 3, dim, first=end - 3).shape, (3, dim))
            with self.assertRaisesRegex(koksma.ArgumentError, spec.partition(":")[0] + r"\b.*point"):
                generate(spec, 3, dim, first=end - 2)

    def test_refused(self):
        for spec in ("n-rooks", "hammersley", "best-candidate", "halton:scramble=owen", "file:x"):
            with self.assertRaisesRegex(koksma.ArgumentError, "^" + spec + ": first is for sequences that have ranges"):
                generate(spec, 3, 2, first=1)

    def test_engine(self):
        for spec in ("sobol:scramble=owen", "halton", "random", "r-sequence:shift=1"):
            engine = Engine(spec, 3, seed=4).fast_forward(10 ** 9)
            drawn = np.concatenate([engine.random(n) for n in (1, 1, 5, 100, 3, 60000, 2)])
            np.testing.assert_array_equal(drawn, generate(spec, len(drawn), 3, 4, first=10 ** 9))
            np.testing.assert_array_equal(engine.reset().random(5), generate(spec, 5, 3, 4))
        self.assertEqual(Engine("sobol").fast_forward((1 << 32) - 3).random(1).shape, (1, 2))
        engine = Engine("sobol").fast_forward((1 << 32) - 3)
        self.assertEqual([len(engine.random()) for _ in range(3)], [1, 1, 1])


if __name__ == "__main__":
    unittest.main()
