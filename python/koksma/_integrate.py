# SPDX-License-Identifier: Apache-2.0
"""Errors of integration, and which coordinates carry a function's variance."""
from __future__ import annotations

import math
from contextlib import contextmanager
from ctypes import POINTER, byref, c_double, c_int, c_size_t, c_void_p
from dataclasses import dataclass
from typing import Any, Callable, Iterator, List, Optional, Sequence, SupportsIndex, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._library import ArgumentError, call, check, core, real, several, spec, text, whole
from ._points import Member, PointArray, canonical, generate, table

Function = Union[str, Callable[[PointArray], npt.ArrayLike]]


@dataclass(frozen=True)
class Integrand:
    """What is known of an integrand; unknown numbers are NaN.

    axes: it depends on so many leading coordinates. value: its integral. variation: of Hardy and Krause, anchored at 1.
    """

    spec: str
    dim: int
    axes: int
    value: float
    variance: float
    variation: float
    lowest: float
    highest: float


@dataclass(frozen=True, eq=False)
class Integration:
    """The error of the mean of a function over sets of n points, against n.

    Attributes
    ----------
    integrand, pattern : str
    dim, trials : int
        trials is 1 for a deterministic pattern.
    sizes : ndarray of shape (k,)
    rmse, low, high : ndarray of shape (k,)
        Root mean square of estimate minus integral, and its 95 % interval. With one trial the absolute error. Where the
        integral is not known, the standard deviation of the estimates.
    mean, sd : ndarray of shape (k,)
        Of the estimates.
    gain : ndarray of shape (k,)
        How many times more random points give this error; NaN if the variance is not known.
    slope, slope_low, slope_high : float
        Of log rmse against log n, with its 95 % interval; NaN with fewer than three sizes.
    integral, variance : float
    """

    integrand: str
    pattern: str
    dim: int
    trials: int
    sizes: npt.NDArray[np.int64]
    rmse: npt.NDArray[np.float64]
    low: npt.NDArray[np.float64]
    high: npt.NDArray[np.float64]
    mean: npt.NDArray[np.float64]
    sd: npt.NDArray[np.float64]
    gain: npt.NDArray[np.float64]
    slope: float
    slope_low: float
    slope_high: float
    integral: float
    variance: float

    def __repr__(self) -> str:
        return (f"Integration({self.integrand!r}, {self.pattern!r}, n={self.sizes[0]}..{self.sizes[-1]}: "
                f"rmse {self.rmse[-1]:.3g}, slope {self.slope:.3f} ({self.slope_low:.3f} to {self.slope_high:.3f}))")


@dataclass(frozen=True)
class Share:
    """A part of the variance and its 95 % interval; both ends equal it where it is exact."""

    value: float
    low: float
    high: float

    def __float__(self) -> float:
        return self.value


@dataclass(frozen=True)
class Sensitivity:
    """Sobol' indices of a set u of coordinates. component: of exactly u; closed: of all within u; total: of all that meet
    u. exact: by a closed form; else estimated."""

    component: Share
    closed: Share
    total: Share
    variance: float
    exact: bool


def integrands() -> List[Member]:
    """All integrands, in the table's order.

    Returns
    -------
    list of Member

    Examples
    --------
    >>> import koksma
    >>> "genz-gaussian" in [i.name for i in koksma.integrands()]
    True
    """
    return table(core().koksma_integrand_at)


@contextmanager
def _opened(function: Function, dim: int, raised: List[BaseException]) -> Iterator[c_void_p]:
    """A koksma_integral. What a function of the caller raises is kept, since no exception passes through C."""
    handle, one = c_void_p(), None
    if isinstance(function, str):
        check(core().koksma_integral_open(text(function, "function"), dim, byref(handle)))
    elif not callable(function):
        raise TypeError(f"function must be a str or callable, not {function!r:.60}")
    else:
        def at(x: Any, _dim: int, _context: object) -> float:
            try:
                values = np.asarray(function(np.array(x[:dim])[None, :]), dtype=np.float64)
                return float(values.reshape(-1)[0])
            except BaseException as error:  # noqa: BLE001
                raised.append(error)
                return math.nan

        one = s.Function(_name_of(function).encode()[:63], dim, dim, s.FunctionAt(at), None, math.nan)
        check(core().koksma_integral_of_function(byref(one), dim, byref(handle)))
    try:
        yield handle
    finally:
        core().koksma_integral_close(handle)


def _name_of(function: Function) -> str:
    return getattr(function, "__name__", None) or type(function).__name__


def _facts(handle: c_void_p) -> Integrand:
    facts = s.IntegralFacts()
    core().koksma_integral_about(handle, byref(facts))
    return Integrand(facts.text.decode(), facts.dim, facts.axes, facts.value, facts.variance, facts.variation,
                     facts.lowest, facts.highest)


def integrand(name: str, dim: SupportsIndex = 2) -> Integrand:
    """What is known of an integrand.

    Parameters
    ----------
    name : str
        A spec such as "genz-gaussian:difficulty=5".
    dim : int

    Returns
    -------
    Integrand

    Examples
    --------
    >>> import koksma
    >>> known = koksma.integrand("genz-gaussian", 2)
    >>> known.lowest < known.value < known.highest
    True
    """
    if not isinstance(name, str):
        raise TypeError(f"name must be a str, not {name!r:.60}")
    with _opened(name, whole("dim", dim, 1, s.MAX_DIM), []) as handle:
        return _facts(handle)


def _estimates(function: Callable[[PointArray], npt.ArrayLike], pattern: str, sizes: Sequence[int], dim: int, trials: int, seed: int,
               threads: SupportsIndex) -> npt.NDArray[np.float64]:
    """[trial][size]; one trial of a deterministic pattern."""
    if trials > 1 and np.array_equal(generate(pattern, sizes[0], dim, seed, threads=threads), generate(pattern, sizes[0], dim, seed + 1, threads=threads)):
        trials = 1
    estimates = np.empty((trials, len(sizes)))
    for t in range(trials):
        for i, n in enumerate(sizes):
            values = np.asarray(function(generate(pattern, n, dim, seed + t, threads=threads)), dtype=np.float64)
            if values.shape != (n,):
                raise ArgumentError(f"{_name_of(function)}: for points of shape ({n}, {dim}) it returned the shape {values.shape}, "
                                    f"not ({n},)")
            estimates[t, i] = math.fsum(values) / n
    return estimates


def _each(name: str, numbers: Union[SupportsIndex, Sequence[SupportsIndex]]) -> Sequence[SupportsIndex]:
    """One number or several, as several."""
    return [numbers] if hasattr(numbers, "__index__") and not np.ndim(numbers) else several(name, numbers)  # type: ignore[arg-type]


def integrate(function: Function, pattern: str, n: Union[SupportsIndex, Sequence[SupportsIndex]],
              dim: SupportsIndex = 2, *, trials: SupportsIndex = 32, seed: SupportsIndex = 0,
              integral: float = math.nan, variance: float = math.nan, threads: SupportsIndex = 0) -> Integration:
    """Integrates a function by sets of a pattern, and measures the error.

    Parameters
    ----------
    function : str or callable
        A spec of an integrand, or a function of an (n, dim) array of points that returns its n values.
    pattern : str
        A spec, such as "sobol:scramble=owen".
    n : int or sequence of int
        Numbers of points; three or more give a slope.
    dim : int
    trials, seed : int
        Sets of each size with the seeds seed .. seed + trials - 1; one of a deterministic pattern.
    integral, variance : float
        Of a callable, where they are known.
    threads : int
        0: one for each processor.

    Returns
    -------
    Integration

    Examples
    --------
    >>> import koksma
    >>> found = koksma.integrate(lambda x: x[:, 0] * x[:, 1], "sobol:scramble=owen", [64, 256, 1024], integral=1/4)
    >>> found.slope < -1  # of random points -1/2
    True
    """
    sizes = [whole("n", k, 1, s.MAX_COORDINATES) for k in _each("n", n)]
    dim, trials = whole("dim", dim, 1, s.MAX_DIM), whole("trials", trials, 1, 1000000)
    seed = whole("seed", seed, 0, s.MAX_SEED - trials)
    if not 1 <= len(sizes) <= s.MAX_SIZES:
        raise ArgumentError(f"n must be 1 to {s.MAX_SIZES} sizes, not {len(sizes)}")
    options = s.IntegrationOptions((c_size_t * s.MAX_SIZES)(*sizes), len(sizes), seed, trials)
    result, parsed = s.Integration(), spec("pattern", pattern)
    if isinstance(function, str):
        with _opened(function, dim, []) as handle:
            facts = _facts(handle)
            call(core().koksma_integration_errors, handle, byref(parsed), byref(options), byref(result), threads=threads,
                 run_at=3)
        name, integral, variance = facts.spec, facts.value, facts.variance
    elif not callable(function):
        raise TypeError(f"function must be a str or callable, not {function!r:.60}")
    else:
        estimates = _estimates(function, pattern, sizes, dim, trials, seed, threads)
        options.trials, name = len(estimates), _name_of(function)
        check(core().koksma_integration_summary(real("integral", integral, nan_too=True), real("variance", variance, nan_too=True), byref(options),
                                                estimates.ctypes.data_as(POINTER(c_double)), byref(result)))
    rows = result.rows[:len(sizes)]
    columns = {key: np.array([getattr(row, key) for row in rows]) for key in ("rmse", "low", "high", "mean", "sd", "gain")}
    return Integration(name, canonical(pattern), dim, rows[0].trials, np.array(sizes), **columns,
                       slope=result.slope.value, slope_low=result.slope.low, slope_high=result.slope.high,
                       integral=integral, variance=variance)


def sensitivity(function: Function, axes: Union[SupportsIndex, Sequence[SupportsIndex]], dim: SupportsIndex = 2, *,
                samples: SupportsIndex = 0, seed: SupportsIndex = 0, threads: SupportsIndex = 0) -> Sensitivity:
    """Sobol' indices of a coordinate, or of several together.

    Parameters
    ----------
    function : str or callable
        As of integrate(); a callable is called for one point at a time.
    axes : int or sequence of int
        Up to 8 different coordinates, numbered from 0.
    dim : int
    samples : int
        Points in each of 16 sets for an estimate; 0: the closed form where there is one, else 4096.
    seed : int
    threads : int
        0: one for each processor.

    Returns
    -------
    Sensitivity

    Examples
    --------
    >>> import koksma
    >>> share = koksma.sensitivity(lambda x: x[:, 0] + 2 * x[:, 1], 1).total  # 4 of 5 parts
    >>> share.low <= 0.8 <= share.high
    True
    """
    dim = whole("dim", dim, 1, s.MAX_DIM)
    chosen: Tuple[int, ...] = tuple(whole("axes", a, 0, dim - 1) for a in _each("axes", axes))
    result = s.Sensitivity()
    raised: List[BaseException] = []
    with _opened(function, dim, raised) as handle:
        try:
            call(core().koksma_integral_sensitivity, handle, (c_int * max(1, len(chosen)))(*chosen), len(chosen),
                 whole("samples", samples, 0, 1 << 20), whole("seed", seed, 0, s.MAX_SEED), byref(result),
                 threads=threads if isinstance(function, str) else 1, run_at=5)
        finally:
            if raised:
                raise raised[0]
    component, closed, total = (Share(x.value, x.low, x.high) for x in (result.component, result.closed, result.total))
    return Sensitivity(component, closed, total, result.variance, result.exact)
