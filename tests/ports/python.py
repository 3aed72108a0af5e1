#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""python.py PORTS: the NumPy port has the bits of ports/vectors.txt, its domains are independent, its example prints
ports/example.txt."""
import subprocess
import sys

try:
    import numpy as np
except ModuleNotFoundError:
    print("no NumPy")
    sys.exit(77)

sys.dont_write_bytecode = True  # `make install` takes the whole folder
sys.path.insert(0, sys.argv[1] + "/python")
import koksma_keys as kk  # pylint: disable=wrong-import-position,import-error
import koksma_sampler as ks  # pylint: disable=wrong-import-position,import-error

FUNCTIONS = ("domain", "sobol", "pmj02", "white", "keys")
TABLES = kk.read_tables(sys.argv[1] + "/../include/koksma")


def words(k):
    """The words of draws k by tests/ports/vectors.c, one array for each function."""
    seed = ks.seed_of_frame(np.uint64(0x0123456789ABCDEF) ^ (k >> 18).astype(np.uint64), k >> 16 & 3)
    use = ks.domain_of_use(ks.domain_of_pixel(seed, k & 255, k >> 8 & 255), k % 5)
    domain = ks.domain_of_sample(use, k % 3)
    index = (k * 2654435761 & 0xFFFFFFFF) >> k % 25
    key = np.stack([domain & np.uint64(0xFFFFFFFF), domain >> np.uint64(32)], -1)
    spp = 1 + k % 130
    quadruples = kk.keys_4d(TABLES, kk.keys_of_4d(TABLES, seed, k & 255, k >> 8 & 255, k % 5, spp), index % spp)
    drawn = [f(domain, index) for f in (ks.sobol, ks.pmj02, ks.white)] + [quadruples]
    return [key.astype(np.uint32)] + [(xs * 2.0 ** 32).astype(np.uint32) for xs in drawn]


def hashes(block_words):
    """FNV over the words of each row."""
    h = np.full(len(block_words), 2166136261, np.uint32)
    with np.errstate(over="ignore"):
        for column in np.ascontiguousarray(block_words.T):
            h = (h ^ column) * np.uint32(16777619)
    return h


table = np.array([[int(word, 16) for word in line.split()[1:]] for line in open(sys.argv[1] + "/vectors.txt") if line[0] != "#"])
drawn = [words(np.arange(b << 14, (b + 1) << 14)) for b in range(64)]
failed = table.shape != (64, 5)
for f, name in enumerate(FUNCTIONS):
    different = np.flatnonzero(hashes(np.stack([block[f].ravel() for block in drawn])) != table[:, f])
    if different.size:
        print(f"{name}: {different.size} of 64 blocks differ, first block {different[0]}")
        failed = True

# Cells of 16 x 16 of one coordinate here and one there: uniform, by chi-square over 4096 domains with one sample each. With 255
# degrees of freedom the mean is 255, the deviation sqrt(510); 6 of them.
x, y = np.arange(64), np.arange(64)[:, None]
for name, f in (("sobol", ks.sobol), ("pmj02", ks.pmj02), ("white", ks.white)):
    def drawn_in(seed, dx, use, i):
        """Coordinates of sample i of a use of all pixels of an image."""
        return f(ks.domain_of_use(ks.domain_of_pixel(seed, x + dx, y), use), i)  # pylint: disable=cell-var-from-loop
    here = drawn_in(ks.seed_of_frame(1, 0), 0, 0, 3)
    for relation, there in (("uses", drawn_in(ks.seed_of_frame(1, 0), 0, 1, 3)), ("pixels", drawn_in(ks.seed_of_frame(1, 0), 1, 0, 3)),
                            ("frames", drawn_in(ks.seed_of_frame(1, 1), 0, 0, 3))):
        for a in range(here.shape[-1]):
            for b in range(here.shape[-1]):
                cells = (here[..., a] * 16).astype(int) * 16 + (there[..., b] * 16).astype(int)
                chi = ((np.bincount(cells.ravel(), minlength=256) - 16.0) ** 2 / 16).sum()
                if abs(chi - 255) > 6 * 510 ** .5:
                    print(f"{name}, {relation}, coordinates {a} and {b}: chi-square {chi:.0f} instead of 255")
                    failed = True

example = subprocess.run([sys.executable, "-B", sys.argv[1] + "/python/example.py"], capture_output=True, text=True, check=False)
if example.stdout != open(sys.argv[1] + "/example.txt").read():
    print("the example prints", example.stdout, example.stderr)
    failed = True
sys.exit(failed)
