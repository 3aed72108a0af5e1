# SPDX-License-Identifier: Apache-2.0
"""koksma_keys_4d of koksma/keys.h for NumPy: four coordinates of a sample, whose errors are blue noise over the screen.

    import numpy as np
    import koksma_keys as kk
    tables = kk.read_tables("include/koksma")                                      # the folder of the header's three tables
    pixel = kk.keys_of_4d(tables, 7, np.arange(640), np.arange(480)[:, None], quadruple=0, spp=4)
    xs = kk.keys_4d(tables, pixel, 2)                                              # sample 2: 480 x 640 x 4

All arguments but tables broadcast against each other. Every result has the bits of the header, whose comments say what the
functions promise; tests/ports checks 2^20 draws.
"""
import os
import re
from typing import NamedTuple

import numpy as np

import koksma_sampler as ks

# pylint: disable=protected-access


class Keys(NamedTuple):
    """The keys and the scrambling of pixels and a quadruple of dimensions; seeds has four arrays."""
    seeds: list
    key: np.ndarray
    order: np.ndarray
    ordered: np.ndarray
    tile: np.ndarray


def read_tables(folder):
    """The numbers of keys_4d.def, keys_4d_four.def and keys_4d_single.def, one after the other."""
    numbers = []
    for name in ("keys_4d.def", "keys_4d_four.def", "keys_4d_single.def"):
        with open(os.path.join(folder, name), encoding="ascii") as file:
            numbers += re.findall(r"\d+", re.sub(r"/\*.*?\*/", "", file.read(), flags=re.S))
    return np.array(numbers, np.uint32)


def _seed_of(key, dimension):
    return ks._seed_of(ks._mix(key), dimension)


def keys_of_4d(tables, seed, x, y, quadruple, spp):
    """The keys of pixels of the image with this seed: koksma_keys_of_4d."""
    x, y, quadruple, spp = np.broadcast_arrays(*(ks._u32(a) for a in (x, y, quadruple, spp)))
    u32 = np.uint32
    image = ks._derived(np.asarray(seed, np.uint64), np.uint64(0x34E90C6C << 32 | 0x85A308D3), quadruple)
    offset = ks._mix(image)
    tile = np.where((spp == 2) | (spp > 4), u32(0), np.where(spp == 1, u32(1), u32(4)))
    size = np.where(tile == 1, u32(64), u32(32))
    last = size - u32(1)
    with np.errstate(over="ignore"):
        column, row = x + (ks._u32(offset & np.uint64(63)) & last), y + (ks._u32(offset >> np.uint64(32)) & last)
    cell = ks.domain_of_pixel(image, column // size, row // size)
    pixel = ks._derived(ks.domain_of_pixel(image, column, row), np.uint64(0x38D01377 << 32 | 0x85A308D3), 0)
    symmetry = _seed_of(np.where(tile > 0, image, cell), 2)
    u, v = ((a & last) ^ last * (symmetry >> u32(k) & u32(1)) for k, a in enumerate((column, row)))
    place = np.where(symmetry & u32(4), u * size + v, v * size + u)
    m = np.ones_like(spp)
    for k in range(1, 22):
        m += u32(1) << u32(k) < spp
    lower = np.maximum(m, u32(6)) - u32(6)
    table = np.maximum(m - lower, u32(2)) - u32(2)
    own = _seed_of(pixel, 0) & (u32(1) << lower) - u32(1)
    key = (tables[np.where(tile > 0, 0, table * u32(1024) + place)] << lower | own) ^ _seed_of(cell, 3)
    seeds = [_seed_of(cell, k) for k in (0, 1, 4, 5)]
    mirrors = [ks._u32(0xE0000000) * (symmetry >> u32(3 + k) & u32(1)) for k in range(4)]
    return Keys([np.where(tile > 0, s >> u32(3) | mirror, s) for s, mirror in zip(seeds, mirrors)],
                np.where(tile > 0, place * tile + (symmetry >> u32(7) & np.maximum(tile, u32(1)) - u32(1)), key),
                ks._u32(ks._mix(ks._mix(pixel)) >> np.uint64(32)), np.minimum(quadruple, u32(1)), tile)


def keys_4d(tables, keys, i):
    """Sample i, four coordinates along a last axis: koksma_keys_4d."""
    u32 = np.uint32
    i = ks._u32(i)
    m = ks._u32(np.frexp(np.maximum(i, u32(2)))[1] - 1)
    with np.errstate(over="ignore"):
        mirrored = ks._owen_hash(ks._mirror(i << u32(32) - m), keys.order + m * u32(0x9E3779B9))
    shuffled = u32(1) << m | ks._mirror(mirrored) >> u32(32) - m
    index = keys.key ^ np.where((keys.ordered > 0) & (i > 1), shuffled, i)
    of_tile = tables[np.where(keys.tile > 1, 5120, 9216) + (index & u32(4095))]
    index = np.where(keys.tile > 0, of_tile, index)
    words = []
    for k in range(4):
        word = np.zeros_like(index)
        for b in range(32):
            word ^= ks._SOBOL[k, b] * (index >> u32(b) & u32(1))
        scrambled = ks._mirror(ks._owen_hash(word, keys.seeds[k]))
        words.append(np.where(keys.tile > 0, ks._mirror(word) ^ keys.seeds[k], scrambled))
    return ks._fractions(words)
