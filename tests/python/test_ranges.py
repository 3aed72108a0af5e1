# SPDX-License-Identifier: Apache-2.0
"""Ranges of sequences far out, against whole numbers of Python: no value here comes from the library."""
import os
import tempfile
import unittest
from decimal import Decimal, getcontext
from fractions import Fraction
from itertools import combinations_with_replacement

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


def golden_ratios(dim):
    """1/g, 1/g^2, ..., 1/g^dim with g^(dim+1) = g + 1, by Newton's method."""
    g = Decimal(1)
    for _ in range(200):
        g -= (g ** (dim + 1) - g - 1) / ((dim + 1) * g ** dim - 1)
    return [1 / g ** (k + 1) for k in range(dim)]


# Joe & Kuo 2008, new-joe-kuo-6: degree, a, m_i of dimensions 2 to 5.
JOE_KUO = ((1, 0, (1,)), (2, 1, (1, 3)), (3, 1, (1, 3, 1)), (3, 2, (1, 1, 1)))


def sobol(i, k):
    """Point i in natural order, by the direction numbers v_j = m_j / 2^j, without a Gray code."""
    m = [1] * 53
    if k:
        s, a, first = JOE_KUO[k - 1]
        m = list(first)
        for j in range(s, 53):
            new = m[j - s] ^ m[j - s] << s
            for t in range(1, s):
                if a >> (s - 1 - t) & 1:
                    new ^= m[j - t] << t
            m.append(new)
    x = 0
    for j in range(53):
        if i >> j & 1:
            x ^= m[j] << (52 - j)
    return Fraction(x, 1 << 53)


END = 1 << 51  # of all sequences
LATE = (1 << 32, (1 << 32) + 12345, 7 * 10 ** 9, (1 << 33) - 128, 5 << 37, (1 << 45) + 77, END - 1024)


def far(*last):
    """Indices small and large, about powers of two and others, up to the last that are served."""
    places = [0, 1, 1000, 99999, (1 << 28) - 2, 10 ** 9, (1 << 31) - 1, (1 << 32) - 5, (1 << 32) - 2]
    return sorted(set(places) | set(last))


# Sequences in base 2 and how they are scrambled: each keeps what is common to the first digits of two points.
SCRAMBLED = ("sobol:scramble=digital-shift", "sobol:scramble=lms", "sobol:scramble=owen", "sobol:scramble=hash-owen",
             "sobol:scramble=owen,numbers=groups", "sobol:owen=1", "sobol:digital-shift=1")


def columns_of(spec, dim):
    """The generator matrices of a digital sequence without scrambling: point 2^c has column c."""
    return [[int(generate(spec, 1, dim, first=1 << c)[0, k] * 2 ** 53) for c in range(51)] for k in range(dim)]


def kernel(columns, digits):
    """The index, below 2^51, whose digits are these: a triangular system, solved from the last column down."""
    index, rest = 0, digits
    for c in range(50, -1, -1):
        if rest >> (52 - c) & 1:
            index, rest = index | 1 << c, rest ^ columns[c]
    return index


def common_digits(x, y):
    return 53 - (int(x * 2 ** 53) ^ int(y * 2 ** 53)).bit_length()


def rank(rows):
    basis = {}
    for row in rows:
        while row:
            top = row.bit_length()
            if top not in basis:
                basis[top] = row
                break
            row ^= basis[top]
    return len(basis)


def t_value(matrices, m):
    """t of the first 2^m points of two coordinates: the first m - t rows in any split are independent."""
    rows = [[sum((c >> (52 - r) & 1) << j for j, c in enumerate(columns[:m])) for r in range(m)] for columns in matrices]
    for t in range(m):
        if all(rank(rows[0][:a] + rows[1][:m - t - a]) == m - t for a in range(m - t + 1)):
            return t
    return m


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
        self.check("sobol", 5, sobol, far(*LATE, END - 4))
        for first in (0, 12345, (1 << 31) - 9, (1 << 32) - 35000, 3 << 40):  # over the ends of groups, and in many dimensions
            np.testing.assert_array_equal(generate("sobol", 70000, 20, first=first)[69990:, :5],
                                          generate("sobol", 10, 5, first=first + 69990))

    def test_sobol_numbers_of_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "numbers.txt")
            with open(path, "w", encoding="ascii") as f:
                f.write("d s a m_i\n")
                for k, (s, a, first) in enumerate(JOE_KUO):
                    f.write(f"{k + 2} {s} {a} {' '.join(map(str, first))}\n")
            self.check("net-file:" + path, 5, sobol, far(*LATE, END - 4))

    def test_r_sequence(self):
        """To the last bit by the ratios in 64 bits, rounded down or to nearest, and near {1/2 + i a} with 60 digits."""
        getcontext().prec = 60
        for dim in (1, 2):
            ratios = golden_ratios(dim)
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
        for dim in range(3, 65):  # powers that are less exact
            for first in (0, 1 << 32, (1 << 51) - 1):
                for x, ratio in zip(generate("r-sequence", 1, dim, first=first)[0], golden_ratios(dim)):
                    gap = abs(Decimal(x) - (Decimal("0.5") + (first + 1) * ratio) % 1)
                    self.assertLess(min(gap, 1 - gap), (first + 1) * Decimal(2) ** -59 + Decimal(2) ** -53, (dim, first))

    def test_scrambled_nets(self):
        """Aligned blocks far out are (0,m,2)-nets, and a shift by digits is one."""
        for spec in ("sobol:scramble=owen", "sobol:scramble=hash-owen,shuffle=1", "sobol:scramble=lms", "pmj02",
                     "pmj02:shuffle=1", "sobol:owen=1", "sobol:digital-shift=1"):
            for first in (1 << 20, 7 << 28, (1 << 32) - 256, 1 << 32, 9 << 32, 12345678 << 8, (1 << 45) + (77 << 8), END - 256):
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
            for first in (1 << 31, (1 << 32) - 2500, (1 << 33) + 12345, 3 ** 20 - 2500, END - 5000):
                whole = generate(member.name, 5000, 2, 9, first=first)
                for at in (1, 511, 512, 2499, 2500, 2501, 4095, 4999):
                    np.testing.assert_array_equal(generate(member.name, 5000 - at, 2, 9, first=first + at), whole[at:])
                for at in range(0, 5000, 97):
                    np.testing.assert_array_equal(generate(member.name, 1, 2, 9, first=first + at)[0], whole[at])

    def test_scrambled_pieces(self):
        """The same with each choice of a parameter, in many dimensions, across point 2^32 and beyond."""
        for spec, dim in [(s, 19) for s in SCRAMBLED] + [("sobol:scramble=hash-owen,shuffle=1", 19), ("pmj02:shuffle=1", 2),
                          ("interlaced-sobol:order=3,scramble=owen", 5), ("r-sequence:shuffle=1", 3), ("sz", 19),
                          ("lattice-sequence", 19), ("halton:scramble=affine", 4), ("ternary-quads", 9)]:
            for first in ((1 << 32) - 2500, (5 << 40) - 3000):
                whole = generate(spec, 5000, dim, 9, first=first)
                self.assertEqual(len(np.unique(whole[:, 0])), 5000, spec)
                for at in (1, 512, 2499, 2500, 3001, 4999):
                    np.testing.assert_array_equal(generate(spec, 5000 - at, dim, 9, first=first + at), whole[at:], spec)
                np.testing.assert_array_equal(generate(spec, 5000, dim, 9, first=first, threads=1), whole)

    def test_parts_differ(self):
        """Points beyond 2^32 are others than those 2^32 before, and no two points of the first 2^51 are equal."""
        for member in koksma.patterns():
            if member.operand or not (koksma.has_ranges(member.name) and _points.is_sequence(member.name)):
                continue
            draws = [generate(member.name, 4096, 2, 9, first=first) for first in (0, *LATE[:2], 1 << 33, 1 << 40)]
            self.assertEqual(len(np.unique(np.concatenate(draws), axis=0)), 5 * 4096, member.name)
            for xs in draws:  # evenly distributed: chi-squared over 256 cells, for random points 255 +- 23
                cells = np.bincount((xs[:, 0] * 16).astype(int) * 16 + (xs[:, 1] * 16).astype(int), minlength=256)
                self.assertLess(((cells - 16.) ** 2 / 16).sum(), 255 + 6 * 23, member.name)

    def test_late_nets_in_other_bases(self):
        """Aligned blocks of b^m points beyond 2^32: every elementary interval of volume b^(t-m) has b^t points."""
        for spec, dim, axes, base, m, t in (("faure", 2, (0, 1), 2, 8, 0), ("faure", 3, (0, 1, 2), 3, 5, 0),
                                            ("faure", 5, (0, 1, 2, 3, 4), 5, 3, 0), ("ternary-quads", 2, (0, 1), 3, 6, 0),
                                            ("ternary-quads", 12, (10, 11), 3, 6, 0), ("ternary-quads", 12, (8, 9, 10, 11), 3, 5, 1),
                                            ("sz", 4, (0, 1, 2, 3), 4, 4, 0), ("sz", 64, (60, 61, 62, 63), 4, 4, 0),
                                            ("sz", 20, (18, 19), 2, 9, 0), ("sz", 16, tuple(range(16)), 16, 2, 0)):
            n = base ** m
            for near in (1 << 32, 3 ** 20, 5 << 37, 1 << 48, END - n):
                first = near // n * n
                digits = 1
                while base ** (digits + 1) <= 1 << 53:
                    digits += 1
                points = np.array([[round(Fraction(x) * base ** digits) for x in p]  # a double is the nearest to its digits
                                   for p in generate(spec, n, dim, first=first)[:, axes].tolist()])
                for split in combinations_with_replacement(range(len(axes)), m - t):  # the axes of m - t digits
                    boxes = points // [base ** (digits - split.count(k)) for k in range(len(axes))]
                    counts = np.unique(boxes, axis=0, return_counts=True)[1]
                    self.assertEqual((len(counts), *set(counts)), (base ** (m - t), base ** t), (spec, first, split))
        for k, base in enumerate(PRIMES):  # halton: one coordinate after the other
            first = (1 << 45) // base ** 3 * base ** 3
            column = generate("halton", base ** 3, 7, first=first)[:, k]
            self.assertEqual(len(np.unique(np.floor(column * base ** 3 + 1e-9))), base ** 3)

    def test_nets_of_all_points(self):
        """t of the first 2^m points, m up to 51, by the ranks of the matrices, which are read from single points."""
        for spec, pairs in (("sobol", ((0, 1),)), ("sz", ((0, 1), (2, 3), (6, 7), (30, 31))), ("faure", ((0, 1),))):
            matrices = columns_of(spec, max(map(max, pairs)) + 1 if spec != "faure" else 2)
            for a, b in pairs:
                for m in (31, 32, 33, 40, 51):
                    self.assertEqual(t_value((matrices[a], matrices[b]), m), 0, (spec, a, b, m))

    def test_nested_scrambling(self):
        """Owen 1995: points that share exactly j digits before the scrambling share exactly j digits after it. From the
        points below 2^32 to those far out, for every j."""
        rng = np.random.default_rng(26)
        plain = {"joe-kuo": columns_of("sobol", 3), "groups": columns_of("sobol:numbers=groups", 3)}
        for spec in SCRAMBLED:
            columns = plain["groups" if "groups" in spec else "joe-kuo"]
            for k in range(3):
                for j in range(51):
                    index = int(rng.integers(1 << (20, 32, 34, 45, 51)[j % 5]))
                    # any index whose point differs first in digit j: digits j, and below it random ones
                    tail = 1 << (52 - j) | (int(rng.integers(1 << 53)) & ((1 << (52 - j)) - 1)) & ~3
                    other = index ^ kernel(columns[k], tail)
                    x, y = (generate(spec, 1, 3, 9, first=i)[0, k] for i in (index, other))
                    self.assertEqual(common_digits(x, y), j, (spec, k, j, index, other))

    def test_scrambles_of_seeds(self):
        """Digits 34 and on of points beyond 2^33 differ between seeds, with each value as often, where the scrambling
        is random there."""
        for spec in ("sobol:scramble=owen", "sobol:scramble=hash-owen", "pmj02", "pmj02:shuffle=1"):
            for k in range(2):
                digits = [int(generate(spec, 1, 2, seed, first=(1 << 33) + 5)[0, k] * 2 ** 53) & 0xfffff for seed in range(512)]
                ones = np.array([[d >> b & 1 for b in range(20)] for d in digits]).sum(axis=0)
                late = ones[:19] if "shuffle" not in spec else ones[:18]
                self.assertTrue((np.abs(late - 256) < 6 * 11.4).all(), (spec, k, ones))

    def test_pmj02_matrix(self):
        """Its matrices are those of the Stirling numbers of the first kind modulo 2, also beyond row 32: points i and
        i ^ 2^c share the digits that column c leaves alone, so that the matrices have one solution."""
        stirling = [[1]]
        for n in range(60):
            row = stirling[-1]
            stirling.append([(row[r - 1] if r else 0) + n * (row[r] if r < len(row) else 0) & 1 for r in range(n + 2)])
        for k in range(2):
            columns = [sum((stirling[c + k][r + k] & 1) << (52 - r) for r in range(c + 1)) for c in range(51)]
            for seed in range(3):
                for j in range(51):
                    index = (0x5a5a5a5a5a5a5 + 977 * j) % (1 << 51)
                    other = index ^ kernel(columns, (1 << (52 - j) | 0x123456789abcd & ((1 << (52 - j)) - 1)) & ~3)
                    x, y = (generate("pmj02", 1, 2, seed, first=i)[0, k] for i in (index, other))
                    self.assertEqual(common_digits(x, y), j, (k, j))

    def test_ends(self):
        for spec, dim, end in (("sobol", 2, END), ("sobol:scramble=owen", 2, END), ("pmj02", 2, END),
                               ("sz", 2, END), ("lattice-sequence", 2, END), ("ternary-quads", 2, END),
                               ("r-sequence:shuffle=1", 2, END), ("random", 3, END), ("halton", 7, 17 ** 12),
                               ("faure", 7, 7 ** 18)):
            self.assertEqual(generate(spec, 3, dim, first=end - 3).shape, (3, dim))
            with self.assertRaisesRegex(koksma.ArgumentError, spec.partition(":")[0] + r"\b.*point"):
                generate(spec, 3, dim, first=end - 2)

    def test_refused(self):
        for spec in ("n-rooks", "hammersley", "best-candidate", "halton:scramble=owen", "file:x"):
            with self.assertRaisesRegex(koksma.ArgumentError, "^" + spec + ": first needs a sequence that has ranges"):
                generate(spec, 3, 2, first=1)
        with self.assertRaisesRegex(koksma.ArgumentError, r"generate\(\.\.\., 4\)\[1:\] has these points"):
            generate("best-candidate", 3, 2, first=1)

    def test_engine(self):
        for spec in ("sobol:scramble=owen", "halton", "random", "r-sequence:shift=1"):
            engine = Engine(spec, 3, seed=4).fast_forward(10 ** 9)
            drawn = np.concatenate([engine.random(n) for n in (1, 1, 5, 100, 3, 60000, 2)])
            np.testing.assert_array_equal(drawn, generate(spec, len(drawn), 3, 4, first=10 ** 9))
            np.testing.assert_array_equal(engine.reset().random(5), generate(spec, 5, 3, 4))
        for first in LATE:
            np.testing.assert_array_equal(Engine("sobol", 5).fast_forward(first).random(1000),
                                          [[float(sobol(i, k)) for k in range(5)] for i in range(first, first + 1000)])
        self.assertEqual(Engine("sobol").fast_forward(END - 3).random(1).shape, (1, 2))
        engine = Engine("sobol").fast_forward(END - 3)
        self.assertEqual([len(engine.random()) for _ in range(3)], [1, 1, 1])


if __name__ == "__main__":
    unittest.main()
