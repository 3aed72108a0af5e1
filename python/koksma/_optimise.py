# SPDX-License-Identifier: Apache-2.0
"""Search for point sets with a small value of a measure."""
from __future__ import annotations

import ctypes
from ctypes import byref, c_double, c_uint64
from dataclasses import dataclass
from math import ceil, sqrt
from typing import Any, Callable, List, Optional, Sequence, SupportsIndex, Union

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._library import ArgumentError, Seed, call, choice, core, quoted, seed_of, spec, text, whole
from ._points import PointArray, as_points, numbers, shown, view

_KEEP = ("none", "latin", "net", "sequence", "every-prefix")


@dataclass(frozen=True, eq=False)
class Optimum:
    """The best set of a search. Equal seed and steps give it again, unless last_gain, the step that found it, is
    steps + 1: a step that the time limit or progress ended. lower: no set
    has a smaller value; NaN where no bound is known."""

    points: PointArray
    value: float
    lower: float
    steps: int
    last_gain: int
    method: str

    def __repr__(self) -> str:
        n, dim = self.points.shape
        return f"Optimum({self.value:.8g}, {n} points in {dim} dimensions, {self.steps} steps by {self.method})"

    def _repr_svg_(self) -> Optional[str]:
        from ._picture import plot

        return plot(self.points).svg if self.points.shape[1] > 1 else None


@dataclass(frozen=True)
class Record:
    """The best known set of n points by a measure, which the pattern "record" has. published: the best published value, from
    `source`; None: none is known. optimise(measure, start=generate("latin-hypercube", n, dim, seed=seed), seed=seed,
    steps=steps) found the set; seed and steps None: an earlier version did."""

    measure: str
    n: int
    dim: int
    value: float
    published: Optional[float]
    source: str
    seed: Optional[int]
    steps: Optional[int]


def records() -> List[Record]:
    """The best known sets, sorted by measure, dim and n.

    Returns
    -------
    list of Record

    Examples
    --------
    >>> import koksma
    >>> best = next(r for r in koksma.records() if (r.measure, r.n, r.dim) == ("star", 8, 2))
    >>> abs(best.value - koksma.measure(koksma.generate("record", 8), "star").value) < 1e-12
    True
    """
    found: List[Record] = []
    at = core().koksma_record_at
    while at(len(found)):
        r = at(len(found)).contents
        found.append(Record(r.measure.decode(), r.n, r.dim, r.value, r.published or None, r.source.decode(),
                            r.seed if r.steps else None, r.steps or None))
    return found


def _optimum(best: s.Optimum) -> Optimum:
    points = shown(best.points.xs, best.points.n, best.points.dim).copy()
    return Optimum(points, best.value, best.lower, best.steps, best.last_gain, best.method.decode())


def radial_power(target: str, n: SupportsIndex, rings: Optional[SupportsIndex] = None, *,
                 threads: SupportsIndex = 0) -> "npt.NDArray[np.float64]":
    """The mean power of n points in the plane at the frequencies 1, 2, .., rings: a target for optimise(power=).

    Parameters
    ----------
    target : str
        "step" (0 below the frequency sqrt(n / pi), else 1), "gaussian" (1 - exp(-pi f^2 / n)), a pattern (the mean of 16
        sets), or a file of lines with a frequency, in units of sqrt(n), and a power.
    n : int
    rings : int, optional
        The number of frequencies; 2 sqrt(n), rounded up, by default.
    threads : int
        0: one for each processor.

    Returns
    -------
    ndarray of shape (rings,)

    Examples
    --------
    >>> import koksma
    >>> [float(power) for power in koksma.radial_power("step", 16, 4)]
    [0.0, 0.0, 1.0, 1.0]
    >>> target = koksma.radial_power("gaussian", 64) * 0.5
    >>> best = koksma.optimise(None, 64, power=target, steps=1)
    """
    n = whole("n", n, 1, s.MAX_COORDINATES // 2)
    rings = min(ceil(2 * sqrt(n)), s.MAX_HALF) if rings is None else whole("rings", rings, 1, s.MAX_HALF)
    power = np.empty(rings)
    call(core().koksma_radial_power, text(target, "target"), n, rings, power.ctypes.data_as(ctypes.POINTER(c_double)),
         threads=threads, run_at=3)
    return power


def optimise(measure: Optional[str], n: Optional[SupportsIndex] = None, dim: Optional[SupportsIndex] = None, *,
             start: Optional[npt.ArrayLike] = None, keep: str = "none",
             projections: Union[str, Sequence[Sequence[SupportsIndex]]] = (),
             weights: Optional[Sequence[float]] = None, power: Union[str, npt.ArrayLike, None] = None,
             seed: Seed = 0, steps: SupportsIndex = 0, time_limit: Optional[float] = None, threads: SupportsIndex = 0,
             progress: Optional[Callable[[Optimum], object]] = None) -> Optimum:
    """Searches for n points in [0,1)^dim with a small value of a measure (a large one of a distance).

    Parameters
    ----------
    measure : str or None
        A spec of a measure with exact values, such as "star" or "l2-centered".
    n, dim : int
        dim is 2 where it is left out.
    start : array_like of shape (n, dim), optional
        The first set; n and dim may then be left out. None: the best set that a listed pattern makes.
    keep : {"none", "latin", "net", "sequence", "every-prefix"}
        "latin" changes only which coordinates go together; "net" leaves each in its interval of length 1/n; "sequence"
        changes the generator matrices of a digital sequence in base 2, and the value is the geometric mean of the measure over
        its first 2, 4, .., n points; "every-prefix" keeps nothing, and the value is that mean over the first 8, 9, .., n points.
    projections : sequence of sequences of int, or "pairs"
        The coordinates in which points are measured, as [(0, 1), (0, 2)]; "pairs": every two; empty: all together. The value
        is the root of the mean of the squares.
    weights : sequence of float, optional
        The weights of the projections in that mean, one for each.
    power : str or array_like, optional
        With measure None, a target for the mean power at the frequencies 1, 2, .. in the plane, or what radial_power takes,
        such as "step"; the value is the root mean square difference, in which ring r counts r times.
    seed : int
    steps : int
        Of a fixed amount of work; equal steps and seed give equal sets. 0: until time_limit.
    time_limit : float, optional
        In seconds. It ends the search within a step, whose best set counts; a first set is made and measured in any case.
    threads : int
        0: one for each processor.
    progress : callable, optional
        Called with the first set and after each step; returns False to stop.

    Returns
    -------
    Optimum

    Examples
    --------
    >>> import koksma
    >>> round(koksma.optimise("star", 8, steps=1).value, 9)  # 17/128, the least that 8 points in the plane can have
    0.1328125
    >>> koksma.optimise(None, 16, power="step", steps=1).value < 1e-3
    True
    """
    kept = choice("keep", keep, _KEEP)
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be callable, not {quoted(progress)}")
    first = None if start is None else as_points(start)
    if n is not None:
        n = whole("n", n, 1, s.MAX_COORDINATES)
    elif first is not None:
        n = int(first.shape[0])
    else:
        raise ArgumentError("n, the number of points, is missing")
    dim = (2 if first is None else int(first.shape[1])) if dim is None else whole("dim", dim, 1, s.MAX_DIM)
    if first is not None and dim != first.shape[1]:
        raise ArgumentError(f"dim = {dim}, but the points of start have {first.shape[1]}")
    steps = whole("steps", steps, 0, s.MAX_SEED)
    if not steps and time_limit is None and progress is None:
        raise ArgumentError("the search would never end: give steps, time_limit or progress")
    if isinstance(projections, str):
        if projections != "pairs":
            raise ArgumentError(f"projections must be groups of coordinates, such as [(0, 1), (0, 2)], or 'pairs', not {quoted(projections)}")
        projections = [(k, j) for k in range(min(dim, 64)) for j in range(k)]
    try:
        groups = [{whole("projections", k, 0, 63) for k in u} for u in projections]
    except TypeError:
        raise TypeError(f"projections must be groups of coordinates, such as [(0, 1), (0, 2)], not {quoted(projections)}") from None
    heavy = None if weights is None else numbers("weights", weights)
    if heavy is not None and heavy.shape != (len(groups),):
        raise ArgumentError(f"weights must be one for each of the {len(groups)} projections, not the shape {heavy.shape}")
    if (measure is None) == (power is None):
        raise ArgumentError("give a measure or a target power, not both")
    target = radial_power(power, n, threads=threads) if isinstance(power, str) else None if power is None else numbers("power", power)
    if target is not None and target.ndim != 1:
        raise ArgumentError(f"power must have a number for each of the frequencies 1, 2, .., not the shape {target.shape}")
    raised: List[BaseException] = []

    def tell(_context: object, best: Any) -> bool:
        try:
            going = progress is None or progress(_optimum(best.contents))
            return bool(going) or not isinstance(going, (bool, np.bool_))
        except BaseException as error:  # comes out of optimise()
            raised.append(error)
            return False

    bits = [sum(1 << k for k in u) for u in groups]
    parsed, best = None if measure is None else byref(spec("measure", measure)), s.Optimum()
    c_first = None if first is None else ctypes.pointer(view(first))
    options = s.OptimiseOptions(n, dim, c_first, kept, seed_of(seed), steps,
                                s.OptimiseProgress(tell), None, (c_uint64 * len(bits))(*bits),
                                None if heavy is None else (c_double * len(heavy))(*heavy), len(bits),
                                None if target is None else (c_double * target.size)(*target),
                                0 if target is None else target.size)
    try:
        call(core().koksma_optimise, parsed, byref(options), byref(best), threads=threads,
             time_limit=time_limit, run_at=2, raised=raised)
        return _optimum(best)
    finally:
        core().koksma_optimum_fini(byref(best))
