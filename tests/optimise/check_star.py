#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_star.py CERTIFICATE..: checks proofs that no n points in the plane have a star discrepancy below a value.

The star discrepancy f of n points is the largest |#/n - xy| over the boxes [0,x] x [0,y] and [0,x) x [0,y), which hold #
points. Number the points by x (ties by any rule) and let p(i) be the rank of point i by y. Let X_1 <= .. <= X_n, Y_1 <= .. <= Y_n
be the coordinates in order, X_n+1 = Y_n+1 = 1, and #(i,j) the number of points of number <= i and rank <= j. Then for all i, j

    (1)  n X_i Y_j >= #(i,j) - n f           [0,X_i] x [0,Y_j] holds at least #(i,j) points
    (2)  n X_i Y_j <= #(i-1,j-1) + n f       [0,X_i) x [0,Y_j) holds at most #(i-1,j-1)
    (3)  n X_n+1 Y_n+1 = n.

If only p(1) .. p(k) are known, (1) holds with the least number that #(i,j) can be, (2) with the largest.

A certificate has a first line `star-plane N VALUE`, then the nodes of a tree in preorder, one a line. A node stands for all p that
begin with the same p(1) .. p(k), the first one for all p.

    b   It has children: all ranks that are left as p(k+1), from the smallest on. k < n.
    m   The rank 1 is p(k) and k < p(1). Exchanging x and y gives a set of equal f, whose p begins with k and has rank 1 after
        that, at p(1): it belongs to another node.
    c i j i' j' ..   Groups (i,j,i',j')_t, t = 1 .. m, with j <= j' within a group and i' >= the next group's i (the first's, after
        the last). Let A_t be the right side of (1) for (i,j), B_t that of (2) for (i',j'), and n for (n+1,n+1), with n f = n VALUE.
        By (1) n X_i Y_j >= A_t > 0, by (2) n X_i' Y_j' <= B_t, so X_i' <= X_i B_t / A_t; and the next X_i <= X_i'. Once around,
        X_i <= X_i product(B_t / A_t). If the product is less than 1 there are no such coordinates, for VALUE and all below.

Arithmetic is in whole numbers. Exit code 1 if a certificate is wrong.
"""
import sys
from fractions import Fraction


class Wrong(Exception):
    pass


class Certificate:
    def __init__(self, lines):
        self.lines = iter(lines)
        head = next(self.lines, "").split()
        if len(head) != 3 or head[0] != "star-plane" or not head[1].isdecimal() or not head[2].replace(".", "", 1).isdecimal():
            raise Wrong("the first line is not `star-plane N VALUE`")
        self.n, self.value, self.nodes = int(head[1]), Fraction(head[2]), 0
        if self.n < 1 or not 0 < self.value < 1:
            raise Wrong("N or VALUE out of range")
        self.scale = self.value.denominator
        self.excess = self.n * self.value.numerator  # n VALUE, in units of 1 / scale

    def count(self, prefix, i, j, largest):
        """The least or the largest #(i,j) of a p that begins with prefix."""
        i, j = min(i, self.n), min(j, self.n)
        known = sum(rank <= j for rank in prefix[:i])
        unknown = max(0, i - len(prefix))  # points among the first i
        low = j - sum(rank <= j for rank in prefix)  # ranks up to j that are left
        later = self.n - len(prefix) - unknown
        return known + (min(unknown, low) if largest else max(0, low - later) if unknown else 0)

    def cut(self, prefix, numbers):
        n, side = self.n, self.n + 1
        if not numbers or len(numbers) % 4 or not all(1 <= x <= side for x in numbers):
            raise Wrong("a cut is not groups of four numbers from 1 to n + 1")
        groups = [numbers[g:g + 4] for g in range(0, len(numbers), 4)]
        above = below = 1
        for (i, j, i2, j2), following in zip(groups, groups[1:] + groups[:1]):
            if j > j2 or i2 < following[0]:
                raise Wrong("a cut is no cycle")
            a = n * self.scale if i == j == side else self.count(prefix, i, j, False) * self.scale - self.excess
            b = n * self.scale if i2 == j2 == side else self.count(prefix, i2 - 1, j2 - 1, True) * self.scale + self.excess
            if a <= 0:
                raise Wrong("the count of an excess is not above n VALUE")
            above, below = above * b, below * a
        if above >= below:
            raise Wrong("the product of a cut is not below 1")

    def node(self, prefix):
        self.nodes += 1
        kind, *numbers = next(self.lines, "end").split()
        if kind == "b" and not numbers and len(prefix) < self.n:
            for rank in range(1, self.n + 1):
                if rank not in prefix:
                    self.node(prefix + [rank])
        elif kind == "m" and not numbers:
            if not prefix or prefix[-1] != 1 or len(prefix) >= prefix[0]:
                raise Wrong("a node that is left out has no mirror image")
        elif kind == "c" and all(x.isdecimal() for x in numbers):
            self.cut(prefix, [int(x) for x in numbers])
        else:
            raise Wrong(f"no node: {kind}")

    def check(self):
        self.node([])
        if next(self.lines, None) is not None:
            raise Wrong("more nodes than the tree has")


def check(lines):
    """The n and VALUE that are proved; raises Wrong."""
    certificate = Certificate(lines)
    try:
        certificate.check()
    except Wrong as wrong:
        raise Wrong(f"node {certificate.nodes}: {wrong}") from None
    return certificate.n, certificate.value


if __name__ == "__main__":
    code = 0 if len(sys.argv) > 1 else 2
    for path in sys.argv[1:]:
        try:
            with open(path, encoding="ascii") as file:
                print(f"{path}: no %d points have a star discrepancy below %s" % check(file))
        except Wrong as wrong:
            print(f"{path}: {wrong}")
            code = 1
    sys.exit(code)
