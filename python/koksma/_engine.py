# SPDX-License-Identifier: Apache-2.0
"""A pattern as an engine with the interface of scipy.stats.qmc.QMCEngine."""
from __future__ import annotations

import copy
from ctypes import byref
from typing import Any, Dict, Optional, SupportsIndex

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._library import ArgumentError, OutOfMemoryError, core, one_line, one_of, quoted, seed_of, spec, text, warn_of_one_set, whole
from ._optimise import optimise
from ._points import PointArray, generate, has_ranges, is_sequence, measures

_FAR = (1 << 63) - 1
_LARGE = 1 << 17  # coordinates: draws of so many are not kept for the next
_SCIPYS = ("random-cd", "lloyd")  # optimizations that scipy has
_STEPS = 2  # of the search for any other

try:
    from scipy.stats.qmc import QMCEngine as _Base  # type: ignore[import-untyped, import-not-found, unused-ignore]
except ImportError:
    class _Base:  # type: ignore[no-redef]
        """What the engine needs of scipy's class, where scipy is not installed."""

        def __init__(self, d: Any, *, optimization: Optional[str] = None, seed: Any = None) -> None:
            if not np.issubdtype(type(d), np.integer) or d < 0:
                raise ValueError("d must be a non-negative integer value")
            if optimization is not None:
                raise ValueError("optimization needs scipy, which is not installed")
            self.d, self.rng_seed, self.num_generated, self.optimization_method = d, copy.deepcopy(seed), 0, None
            self.rng = seed if isinstance(seed, np.random.RandomState) else np.random.default_rng(seed)

        def _random(self, n: int = 1, *, workers: int = 1) -> PointArray:
            raise NotImplementedError

        def random(self, n: int = 1, *, workers: int = 1) -> PointArray:
            sample: PointArray = self._random(n, workers=workers)
            if self.optimization_method is not None:
                sample = self.optimization_method(sample)
            self.num_generated += n
            return sample

        def integers(self, l_bounds: npt.ArrayLike, *, u_bounds: Optional[npt.ArrayLike] = None, n: int = 1,
                     endpoint: bool = False, workers: int = 1) -> npt.NDArray[np.int64]:
            low, high = (0, l_bounds) if u_bounds is None else (l_bounds, u_bounds)
            low, high = np.atleast_1d(low), np.atleast_1d(high)
            if not (np.issubdtype(low.dtype, np.integer) and np.issubdtype(high.dtype, np.integer)):
                raise ValueError("'u_bounds' and 'l_bounds' must be integers or array-like of integers")
            high = high + 1 if endpoint else high
            if np.any(low >= high):
                raise ValueError("Bounds are not consistent 'l_bounds' < 'u_bounds'")
            drawn: npt.NDArray[np.int64] = np.floor(self.random(n) * (high - low) + low).astype(np.int64)
            return drawn


class Engine(_Base):  # type: ignore[misc, unused-ignore]
    """A pattern's points, drawn a few at a time.

    pattern: a spec such as "sobol:scramble=owen" or "n-rooks". seed: an int (Engine(p, d, seed=s).random(n) is then
    generate(p, n, d, s)), a numpy SeedSequence, Generator or RandomState, or None; rng is another name of it, and may also be
    whatever numpy.random.default_rng takes; dim is another name of d. optimization:
    "random-cd" and "lloyd" are scipy's; any other is a measure such as "l2-centered" or "min-distance", for which each set is
    improved by `optimise` with keep="latin": along each axis the coordinates stay, so that Latin hypercubes stay Latin.

    Of a sequence (a pattern whose first k of n points are the set of k points), random(n) goes on where the last call
    ended. Of any other pattern each call draws a set of n points of its own, which depends on the seed and on how many
    points came before. But where the pattern itself is deterministic, such as "regular", "hammersley" and the
    lattices, every call gives the same n points, whatever the seed: with "hammersley:shift=1" the sets differ.

    Examples
    --------
    >>> import koksma
    >>> engine = koksma.Engine("sobol:scramble=owen", d=2, seed=7)
    >>> bool((engine.random(8) == koksma.generate("sobol:scramble=owen", 8, 2, 7)).all())
    True
    >>> engine
    Engine('sobol:scramble=owen', d=2, num_generated=8)
    """

    def __init__(self, pattern: str, d: SupportsIndex = 2, *, optimization: Optional[str] = None, seed: Any = None,
                 rng: Any = None, dim: Optional[SupportsIndex] = None) -> None:
        d = one_of("d", d, 2, "dim", dim)
        if seed is not None and rng is not None:
            raise TypeError("seed and rng are two names of one argument: give one of them")
        if rng is not None and not isinstance(rng, (int, np.integer, np.random.Generator, np.random.RandomState)):
            try:
                seed = np.random.default_rng(rng)  # as SPEC 7 has it: also a BitGenerator or several ints
            except (TypeError, ValueError) as error:
                raise type(error)(f"rng: NumPy makes no generator of {quoted(rng)} ({one_line(str(error))}): give an integer, "
                                  "a SeedSequence, a Generator or None") from None
        elif isinstance(seed, np.random.SeedSequence):
            seed = np.random.default_rng(seed)  # scipy takes none
        seed = rng if seed is None else seed
        if optimization is not None:
            text(optimization, "optimization")
        scipys = optimization is None or optimization.lower() in _SCIPYS
        try:
            super().__init__(d=d, optimization=optimization if scipys else None, seed=seed)
        except (TypeError, ValueError) as error:  # the base class's, of a seed or d, which may be an array
            raise (TypeError if type(error) is TypeError else ArgumentError)(one_line(str(error))) from None
        self.d: int = int(d)
        if not scipys:
            self._measure: str = str(optimization)
            if self._measure.partition(":")[0] not in {m.name for m in measures()}:
                raise ArgumentError(f"{quoted(optimization)} is not a valid optimization method: give {', '.join(_SCIPYS)} or a measure "
                                    "(koksma.measures() names them)")
            if spec("measure", self._measure).measure.contents.answer != 0:
                raise ArgumentError(f"optimization {quoted(optimization)}: the measure must have exact values, as star and l2-star have")
            self.optimization_method: Any = self._optimised
        self._init_quad: Dict[str, Any] = {"pattern": pattern, "d": d, "optimization": optimization}  # for qmc_quad
        self.pattern = pattern
        self._sequence = is_sequence(pattern)
        self._ranges = self._sequence and has_ranges(pattern)
        self._known: Optional[PointArray] = None  # the points from number _known_first on
        self._known_first = 0
        self._refused: Optional[int] = None  # the fewest points that the pattern was seen not to serve
        if core().koksma_has_one_set(byref(spec("pattern", pattern))):
            self._seed = 0
            if seed is not None:
                warn_of_one_set(pattern)
        elif isinstance(seed, (int, np.integer)) and 0 <= seed < 1 << 64:
            self._seed = int(seed)
        else:
            self._seed = seed_of(self.rng)

    def random(self, n: SupportsIndex = 1, *, workers: SupportsIndex = 1) -> PointArray:
        """The next n points, or another set of n. workers: threads to use, -1 for all."""
        workers = whole("workers", workers, -1, s.MAX_INT)
        if workers == 0:
            raise ArgumentError("workers must be a number of threads, or -1 for all, not 0")
        self._threads = 0 if workers == -1 else int(workers)
        drawn: PointArray = super().random(whole("n", n, 0, s.MAX_COORDINATES), workers=workers)
        return drawn

    def random_base2(self, m: SupportsIndex) -> PointArray:
        """The next 2^m points; of a sequence only where all drawn are then a power of two, as scipy's Sobol asks."""
        m = whole("m", m, 0, 28)
        n = 1 << m
        total = self.num_generated + n
        if self._sequence and total & (total - 1):
            raise ValueError(f"with 2^{m} more there would be {total} points, not a power of two; reset() begins again")
        return self.random(n)

    def __repr__(self) -> str:
        return f"Engine({self.pattern!r}, d={self.d}, num_generated={self.num_generated})"

    def _random(self, n: int = 1, *, workers: int = 1) -> PointArray:
        threads = 0 if workers == -1 else workers
        if n == 0 or self.d == 0:
            return np.empty((n, self.d))
        first = self.num_generated
        if not self._sequence:
            return generate(self.pattern, n, self.d, self._seed_at(first), threads=threads)
        if self._ranges:
            return self._from_range(first, n, threads)
        if first == 0 and self._known is None:
            return generate(self.pattern, n, self.d, self._seed, threads=threads)
        if self._known is None or len(self._known) < first + n:
            self._known = self._generated(first + n, threads)
        return self._known[first:first + n].copy()

    def _optimised(self, sample: PointArray) -> PointArray:
        if sample.size == 0:
            return sample
        return optimise(self._measure, start=sample, keep="latin", steps=_STEPS, seed=self._seed_at(self.num_generated),
                        threads=self._threads).points

    def _from_range(self, first: int, n: int, threads: int) -> PointArray:
        """Small draws that follow each other come from blocks of growing size."""
        def drawn(count: int) -> PointArray:
            return generate(self.pattern, count, self.d, self._seed, first=first, threads=threads)

        if n * self.d >= _LARGE:
            return drawn(n)
        at = first - self._known_first
        if self._known is None or at < 0 or at + n > len(self._known):
            follows = self._known is not None and 0 <= at <= len(self._known)
            more = max(n, min(2 * len(self._known), _LARGE // self.d)) if follows and self._known is not None else n
            try:
                self._known = drawn(more)
            except ArgumentError:  # the sequence may end before
                if more == n:
                    raise
                self._known = drawn(n)
            self._known_first, at = first, 0
        return self._known[at:at + n].copy()

    def _generated(self, needed: int, threads: int) -> PointArray:
        """Twice what is needed, so that many small draws cost no more than one large one; but where the sequence ends
        before, half of what is left at least, so that the draws on the way to its end don't either."""
        room = min(2 * needed, max(needed, s.MAX_COORDINATES // self.d))
        while True:
            if self._refused is not None:
                room = max(needed, min(room, (needed + self._refused) // 2))
            try:
                return generate(self.pattern, room, self.d, self._seed, threads=threads)
            except (ArgumentError, OutOfMemoryError):
                if room == needed:
                    raise
                self._refused = room

    def _seed_at(self, position: int) -> int:
        """The seed of the set that is drawn after `position` points: the engine's own at first."""
        if position == 0:
            return self._seed
        x = (self._seed + position * 0x9E3779B97F4A7C15) % (1 << 64)  # Steele, Lea & Flood (2014): SplitMix
        x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9 % (1 << 64)
        x = (x ^ x >> 27) * 0x94D049BB133111EB % (1 << 64)
        return x ^ x >> 31

    def reset(self) -> "Engine":
        """Back to the first point."""
        self.num_generated: int = 0
        return self

    def fast_forward(self, n: SupportsIndex) -> "Engine":
        """As if n points had been drawn; of a pattern with ranges nothing is generated before the next draw."""
        self.num_generated += whole("n", n, 0, _FAR)
        return self
