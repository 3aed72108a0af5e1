# SPDX-License-Identifier: Apache-2.0
"""koksma/sampler.h for NumPy: samples are functions of a domain (a 64-bit key) and an index, for arrays of either.

    import numpy as np
    import koksma_sampler as ks
    pixel = ks.domain_of_pixel(seed=7, x=np.arange(640), y=np.arange(480)[:, None])    # keys, 480 x 640
    FILM, LENS = 0, 1
    film = ks.sobol(ks.domain_of_use(pixel, FILM), 5, 2)                               # sample 5: 480 x 640 x 2
    lens = ks.sobol(ks.domain_of_use(pixel, LENS), 5, 2)

Keys are uint64, indices uint32, results float64 in [0, 1); all arguments broadcast against each other. Every result has the
bits of the header, whose comments say what the functions promise; tests/ports checks 2^20 draws of each.
"""
import numpy as np

_M = np.uint64(0xD6E8FEB86659FD93)
_NUMBER = np.uint64(0x9E3779B97F4A7C15)
_USE, _SAMPLE, _FRAME, _WHITE = (np.uint64(high << 32 | 0x85A308D3)
                                 for high in (0x243F6A88, 0xA4093822, 0x082EFA98, 0x452821E6))
# Column b of each dimension: the digits of point 2^b, bits reversed.
_SOBOL = np.array([
    [0x00000001, 0x00000002, 0x00000004, 0x00000008, 0x00000010, 0x00000020, 0x00000040, 0x00000080,
     0x00000100, 0x00000200, 0x00000400, 0x00000800, 0x00001000, 0x00002000, 0x00004000, 0x00008000,
     0x00010000, 0x00020000, 0x00040000, 0x00080000, 0x00100000, 0x00200000, 0x00400000, 0x00800000,
     0x01000000, 0x02000000, 0x04000000, 0x08000000, 0x10000000, 0x20000000, 0x40000000, 0x80000000],
    [0x00000001, 0x00000003, 0x00000005, 0x0000000f, 0x00000011, 0x00000033, 0x00000055, 0x000000ff,
     0x00000101, 0x00000303, 0x00000505, 0x00000f0f, 0x00001111, 0x00003333, 0x00005555, 0x0000ffff,
     0x00010001, 0x00030003, 0x00050005, 0x000f000f, 0x00110011, 0x00330033, 0x00550055, 0x00ff00ff,
     0x01010101, 0x03030303, 0x05050505, 0x0f0f0f0f, 0x11111111, 0x33333333, 0x55555555, 0xffffffff],
    [0x00000001, 0x00000003, 0x00000006, 0x00000009, 0x00000017, 0x0000003a, 0x00000071, 0x000000a3,
     0x00000116, 0x00000339, 0x00000677, 0x000009aa, 0x00001601, 0x00003903, 0x00007706, 0x0000aa09,
     0x00010117, 0x0003033a, 0x00060671, 0x000909a3, 0x00171616, 0x003a3939, 0x00717777, 0x00a3aaaa,
     0x01170001, 0x033a0003, 0x06710006, 0x09a30009, 0x16160017, 0x3939003a, 0x77770071, 0xaaaa00a3],
    [0x00000001, 0x00000003, 0x00000004, 0x0000000a, 0x0000001f, 0x0000002e, 0x00000045, 0x000000c9,
     0x0000011b, 0x000002a4, 0x0000079a, 0x00000b67, 0x0000101e, 0x0000302d, 0x00004041, 0x0000a0c3,
     0x0001f104, 0x0002e28a, 0x000457df, 0x000c9bae, 0x0011a105, 0x002a7289, 0x0079e7db, 0x00b6dba4,
     0x0100011a, 0x030002a7, 0x0400079e, 0x0a000b6d, 0x1f001001, 0x2e003003, 0x45004004, 0xc900a00a]], dtype=np.uint32)
_PMJ02 = np.array([
    [0x00000001, 0x00000002, 0x00000006, 0x0000000c, 0x00000014, 0x00000028, 0x00000078, 0x000000f0,
     0x00000110, 0x00000220, 0x00000660, 0x00000cc0, 0x00001540, 0x00002a80, 0x00007f80, 0x0000ff00,
     0x00010100, 0x00020200, 0x00060600, 0x000c0c00, 0x00141400, 0x00282800, 0x00787800, 0x00f0f000,
     0x01111000, 0x02222000, 0x06666000, 0x0cccc000, 0x15554000, 0x2aaa8000, 0x7fff8000, 0xffff0000],
    [0x00000001, 0x00000003, 0x00000006, 0x0000000a, 0x00000014, 0x0000003c, 0x00000078, 0x00000088,
     0x00000110, 0x00000330, 0x00000660, 0x00000aa0, 0x00001540, 0x00003fc0, 0x00007f80, 0x00008080,
     0x00010100, 0x00030300, 0x00060600, 0x000a0a00, 0x00141400, 0x003c3c00, 0x00787800, 0x00888800,
     0x01111000, 0x03333000, 0x06666000, 0x0aaaa000, 0x15554000, 0x3fffc000, 0x7fff8000, 0x80008000]], dtype=np.uint32)


def _u32(x):
    return np.asarray(x).astype(np.uint32)


def _mix(key):
    with np.errstate(over="ignore"):
        key = np.asarray(key, dtype=np.uint64) * _M
    return key ^ key >> np.uint64(32)


def _derived(key, purpose, number):
    with np.errstate(over="ignore"):
        return _mix(np.asarray(key, dtype=np.uint64) ^ purpose ^ _u32(number).astype(np.uint64) * _NUMBER)


def domain_of_use(domain, use):
    """The domain for one purpose of another domain's samples."""
    return _derived(domain, _USE, use)


def domain_of_sample(domain, i):
    """The domain for one sample of another domain."""
    return _derived(domain, _SAMPLE, i)


def seed_of_frame(seed, frame):
    """The seed of one frame of an animation."""
    return _mix(_derived(np.uint64(seed), _FRAME, frame))


def domain_of_pixel(seed, x, y):
    """The domain of a pixel of the image with this seed."""
    image = _mix(np.asarray(seed, dtype=np.uint64) ^ np.uint64(0x13198A2E03707344))
    return _mix(_mix(image ^ (_u32(y).astype(np.uint64) << np.uint64(32) | _u32(x))))


def _mirror(x):
    for mask, shift in ((0x55555555, 1), (0x33333333, 2), (0x0F0F0F0F, 4), (0x00FF00FF, 8), (0x0000FFFF, 16)):
        mask, shift = np.uint32(mask), np.uint32(shift)
        x = (x & mask) << shift | (x >> shift & mask)
    return x


def _owen_hash(x, seed):
    with np.errstate(over="ignore"):
        x = x ^ x * np.uint32(0x3D20ADEA)
        x = (x + seed) * (seed >> np.uint32(16) | np.uint32(1))
        x = x ^ x * np.uint32(0x05526C56)
        return x ^ x * np.uint32(0x53A22864)


def _seed_of(mixed, dimension):
    with np.errstate(over="ignore"):
        x = _u32(mixed & np.uint64(0xFFFFFFFF)) + np.uint32((dimension + 1) * 0x9E3779B9 & 0xFFFFFFFF)
        x = (x ^ x >> np.uint32(16)) * np.uint32(0x7FEB352D)
        x = (x ^ x >> np.uint32(15)) + _u32(mixed >> np.uint64(32))
        x = x * np.uint32(0x846CA68B)
        return x ^ x >> np.uint32(16)


def _digital(columns, domain, i, dim):
    """The words of a scrambled digital sequence in a shuffled order, one array for each dimension."""
    mixed = _mix(domain)
    order = _u32(_mix(mixed) >> np.uint64(32))
    j = _owen_hash(_mirror(_u32(i)), order) ^ _owen_hash(np.uint32(0), order) & np.uint32(0xFFFF)
    words = []
    for k in range(dim):
        x = np.zeros(np.shape(j), np.uint32)
        for b in range(32):
            x = x ^ columns[k, b] * (j >> np.uint32(31 - b) & np.uint32(1))
        words.append(_mirror(_owen_hash(x, _seed_of(mixed, k))))
    return words


def _fractions(words):
    return np.stack(np.broadcast_arrays(*words), -1) * 2.0 ** -32


def sobol(domain, i, dim=4):
    """Sample i of the domain in 1 to 4 dimensions, along a last axis: koksma_sobol_1d to koksma_sobol_4d."""
    if not 1 <= dim <= 4:
        raise ValueError(f"dim {dim}: sobol has 1 to 4 dimensions; draw more from other domains")
    return _fractions(_digital(_SOBOL, domain, i, dim))


def pmj02(domain, i):
    """Sample i of the domain in two dimensions, along a last axis: koksma_pmj02_2d."""
    return _fractions(_digital(_PMJ02, domain, i, 2))


def white(domain, i, dim=4):
    """1 to 4 independent random numbers of sample i, along a last axis: koksma_white_4d."""
    if not 1 <= dim <= 4:
        raise ValueError(f"dim {dim}: white has 1 to 4 dimensions; draw more from other domains")
    mixed = _mix(_derived(domain, _WHITE, i))
    return _fractions([_seed_of(mixed, k) for k in range(dim)])
