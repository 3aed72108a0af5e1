# SPDX-License-Identifier: Apache-2.0
"""Integrals from replicates, with intervals, and to a tolerance: what koksma.integrate(tolerance=...) calls."""
from __future__ import annotations

import math
from contextlib import ExitStack
from ctypes import byref
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Optional, Sequence, SupportsIndex, Tuple

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._frame import Framed, columns_of, table
from ._library import ArgumentError, Seed, call, core, first_seed, flag, quoted, real, spec, text, warn, whole
from ._points import Named, PointArray, canonical, named, numbers, warp_points

#: The digital shift makes random the digits below the 32 of the sequence, whose truncation is a bias of 2^-33.
DEFAULT_PATTERN = "sobol:scramble=lms,digital-shift=1"
#: Independent sets, where the default is not parts of one.
REPLICATES = 15


@dataclass(frozen=True)
class Interval(Named):
    """A kind of interval for an integral, from estimates by independent sets.

    estimator: that it has by default; "": it chooses. assumes: what its coverage rests on. proved: for all integrands of the
    given range and every number of sets. bounded: it needs that range.
    """

    estimator: str
    assumes: str
    proved: bool
    bounded: bool


@dataclass(frozen=True)
class Step:
    """Estimates by sets of n points. points: function values so far, of all sets; error: the larger distance of value from the
    ends of the interval, which holds the integral with this confidence."""

    n: int
    points: int
    value: float
    low: float
    high: float
    error: float
    confidence: float
    estimator: str
    interval: str


@dataclass(frozen=True)
class Integral(Framed):
    """An integral with an interval that holds it with the stated confidence; float() gives its value.

    Attributes
    ----------
    value, low, high, error : float
        Of the last step.
    reached : bool
        Whether the error is within the tolerance; True without one (tolerance=0).
    points, replicates, dim : int
        Function values in all; sets; dimensions.
    parts : bool
        Whether the sets are consecutive parts of one set.
    path : tuple of Step
    rate, rate_error : float
        Slope of log error against log points over the last five steps, and its standard error; NaN with fewer than three.
    needed, needed_low, needed_high : float
        How many points the tolerance would take by this rate, with an approximate 95 % interval; NaN where no rate is known.
    pattern : str
    """

    value: float
    low: float
    high: float
    error: float
    reached: bool
    points: int
    replicates: int
    dim: int
    path: Tuple[Step, ...]
    rate: float
    rate_error: float
    needed: float
    needed_low: float
    needed_high: float
    pattern: str
    parts: bool

    def __float__(self) -> float:
        return self.value

    def _columns(self) -> Dict[str, Any]:
        return columns_of(self.path)

    def __repr__(self) -> str:
        missed = "" if self.reached else ", tolerance not reached"
        return f"Integral({self.value:.12g} in [{self.low:.12g}, {self.high:.12g}], {self.points} points in {self.dim} dimensions{missed})"

    def _repr_html_(self) -> str:
        return table(("n", "points", "value", "low", "high", "error", "interval"),
                     [(p.n, p.points, p.value, p.low, p.high, p.error, p.interval) for p in self.path],
                     f"{self.replicates} {'parts' if self.parts else 'sets'} of {self.pattern}; {'reached' if self.reached else 'not reached'}")


def estimators() -> List[Named]:
    """All estimators of an integral from several sets, in the table's order.

    Returns
    -------
    list of Named

    Examples
    --------
    >>> import koksma
    >>> [e.name for e in koksma.estimators()]
    ['mean', 'median', 'median-of-means', 'trimmed']
    """
    return named(core().koksma_estimator_at)


def intervals() -> List[Interval]:
    """All intervals for an integral, in the table's order.

    Returns
    -------
    list of Interval

    Examples
    --------
    >>> import koksma
    >>> [i.name for i in koksma.intervals() if i.proved]
    ['empirical-bernstein', 'betting']
    """
    found: List[Interval] = []
    while core().koksma_interval_at(len(found)):
        m = core().koksma_interval_at(len(found)).contents
        found.append(Interval(m.name.decode(), m.title.decode(), m.cite.decode(), (m.estimator or b"").decode(), m.assumes.decode(),
                              m.proved, m.bounded))
    return found


def _pairs(name: str, values: Any, count: Optional[int]) -> npt.NDArray[np.float64]:
    """(low, high) of each of `count` things, or of one: shape (count, 2)."""
    found = numbers(name, values)
    if found.shape != ((2,) if count is None else (count, 2)) or not np.isfinite(found).all():
        raise ArgumentError(f"{name} must be {'a pair' if count is None else f'{count} pairs'} of finite numbers (low, high), not "
                            f"{quoted(values)}")
    found = found.reshape(-1, 2)
    if not (found[:, 0] < found[:, 1]).all():
        raise ArgumentError(f"{name} must have low < high, not {quoted(values)}")
    return found


def values_at(function: Callable[[PointArray], npt.ArrayLike], name: str, points: PointArray) -> PointArray:
    """The function's values at the points, of whatever shape."""
    try:
        found = function(points)
    except IndexError as error:
        raise ArgumentError(f"{name}: {error}; its points have {points.shape[1]} dimensions, as dim says") from error
    return numbers(f"the values of the function {name}", found)


def _mapped(function: Callable[[PointArray], npt.ArrayLike], dim: int, bounds: Any,
            warp: Optional[str]) -> Tuple[Callable[[PointArray], npt.NDArray[np.float64]], float]:
    """The function on the unit cube, times the volume of the box of `bounds`, and this volume."""
    box = None if bounds is None else _pairs("bounds", bounds, dim)
    volume = 1.0 if box is None else float(np.prod(box[:, 1] - box[:, 0]))
    if warp is not None and (box is not None or dim < 2):
        raise ArgumentError(f"warp {quoted(warp)} takes the first two of dim={dim} coordinates, without bounds")
    name = getattr(function, "__name__", None) or type(function).__name__

    def at(points: PointArray) -> npt.NDArray[np.float64]:
        if box is not None:
            points = box[:, 0] + points * (box[:, 1] - box[:, 0])
        if warp is not None:
            points = np.hstack([warp_points(points[:, :2], warp), points[:, 2:]])
        values = values_at(function, name, points)
        if values.shape != (len(points),):
            raise ArgumentError(f"{name}: for points of shape {points.shape} it returned the shape {values.shape}, not ({len(points)},)")
        return values * volume

    return at, volume


def _callback(at: Callable[[PointArray], npt.NDArray[np.float64]], raised: List[BaseException]) -> Any:
    def values_of(_context: object, points: Any, out: Any) -> int:
        try:
            c = points.contents
            found = np.ctypeslib.as_array(c.xs, (c.n, c.dim)).copy()
            np.ctypeslib.as_array(out, (c.n,))[:] = at(found)
            return 0
        except BaseException as error:  # noqa: BLE001  no exception passes through C
            raised.append(error)
            return 1

    return s.ValuesOf(values_of)


def _of_integrand(handle: Any, threads: int) -> Callable[[Any, Any, Any], int]:
    """A callback for an integrand of the table."""
    def values_of(_context: object, points: Any, out: Any) -> int:
        return int(core().koksma_integral_values(handle, points, byref(s.Run(threads)), out))

    return values_of


def _name(name: str, value: Optional[str]) -> Optional[bytes]:
    return None if value is None else text(value, name)


def integrate_to(opened: Any, function: Any, pattern: Optional[str], n: Optional[SupportsIndex], dim: SupportsIndex, *, tolerance: float,
                 relative: bool, estimator: Optional[str], interval: Optional[str], confidence: float,
                 replicates: Optional[SupportsIndex], max_points: SupportsIndex, value_range: Optional[Sequence[float]], bounds: Any,
                 warp: Optional[str], resume: Any, seed: Seed, threads: SupportsIndex) -> Integral:
    """Opened: opens a spec of an integrand. See koksma.integrate."""
    pattern = DEFAULT_PATTERN if pattern is None else pattern
    dim, size = whole("dim", dim, 1, s.MAX_DIM), 0 if n is None else whole("n", n, 1, s.MAX_INDEX)
    most = whole("max_points", max_points, 2, 1 << 40)
    tolerance = real("tolerance", tolerance)
    if not tolerance >= 0 or (tolerance == 0 and not size):
        raise ArgumentError(f"tolerance must be above 0, or 0 with n for one estimate, not {quoted(tolerance)}")
    sets = whole("replicates", replicates, 2, 100000) if replicates is not None else 0 if tolerance else REPLICATES
    options = s.ToleranceOptions(replicates=sets, first_n=size, most_points=most if tolerance else sets * size,
                                 seed=first_seed(seed, sets or REPLICATES))
    if resume is not None:
        options.resume, options.function = text(resume, "resume"), text(getattr(function, "__qualname__", str(function)), "function")
    options.relative, options.absolute = (tolerance, 0) if flag("relative", relative) else (0, tolerance)
    options.estimate.estimator, options.estimate.interval = _name("estimator", estimator), _name("interval", interval)
    options.estimate.confidence = real("confidence", confidence)
    if 0 < confidence < 0.5:
        warn(f"confidence {confidence:g}: the interval misses the integral more often than not; 0.95 is 95 %")
    raised: List[BaseException] = []
    result, parsed = s.Tolerance(), spec("pattern", pattern)
    with ExitStack() as stack:
        volume = 1.0
        if isinstance(function, str):
            if bounds is not None or warp is not None:
                raise ArgumentError("bounds and warp are for callables; an integrand of the table has its own domain")
            handle = stack.enter_context(opened(function, dim, []))
            of = s.ValuesOf(_of_integrand(handle, whole("threads", threads, 0, s.MAX_INT)))
        elif callable(function):
            called: Any = function
            at, volume = _mapped(called, dim, bounds, warp)
            of = _callback(at, raised)
        else:
            raise TypeError(f"function must be a str or callable, not {quoted(function)}")
        if value_range is not None:
            options.estimate.lowest, options.estimate.highest = _pairs("value_range", value_range, None)[0] * volume
        call(core().koksma_integrate_to, of, None, dim, byref(parsed), byref(options), byref(result), threads=threads, run_at=5,
             raised=raised)
    path = tuple(Step(step.n, step.points, e.value, e.low, e.high, e.error, e.confidence, e.estimator.decode(), e.interval.decode())
                 for step in result.steps[:result.n_steps] for e in (step.estimate,))
    last = path[-1]
    if tolerance and not result.reached:
        warn(f"the tolerance {tolerance:g} is not reached: the error is {last.error:.3g} after {last.points} points", RuntimeWarning)
    if callable(function) and last.points > 1 and result.least == result.largest:
        warn(f"all {last.points} values are {result.least:g}, of points in {dim} dimensions", RuntimeWarning)
    elif last.points >= 4096 and result.top_share > 0.02:
        warn(f"one of {last.points} values is {100 * result.top_share:.0f} % of the sum: the integral may be infinite, or its "
             "peak is narrow", RuntimeWarning)
    return Integral(last.value, last.low, last.high, last.error, result.reached or not tolerance, last.points, result.replicates, dim, path,
                    result.rate, result.rate_error, math.nan if result.reached else result.needed, result.needed_low, result.needed_high,
                    canonical(pattern), result.parts)
