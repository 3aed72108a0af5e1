# SPDX-License-Identifier: Apache-2.0
"""Errors of integration, and integrals to a tolerance."""
from __future__ import annotations

import math
import os
from contextlib import contextmanager
from ctypes import POINTER, byref, c_double, c_size_t, c_void_p
from dataclasses import dataclass
from typing import Any, Callable, Dict, Iterator, List, Optional, Sequence, SupportsIndex, Union, overload

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._frame import Framed, number, table
from ._library import (ArgumentError, Seed, call, check, core, first_seed, flag, quoted, real, several, sizes_of, spec, text,
                       warn, warn_of_one_set, whole)
from ._points import Member, PointArray, as_points, canonical, generate, members, view
from ._tolerance import Integral, integrate_to, values_at

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
class Integration(Framed):
    """The error of the mean of a function over sets of n points, against n.

    Attributes
    ----------
    integrand, pattern : str
        pattern is "points" for points that were given.
    dim, trials : int
        trials is 1 for points, and for a pattern that gave the same points for all seeds.
    sizes : ndarray of shape (k,)
    rmse, low, high : ndarray of shape (k,)
        Root mean square of estimate minus integral, and its 95 % interval. With one trial the absolute error. Where the
        integral is not known, the standard deviation of the estimates.
    approximate : ndarray of shape (k,)
        Whether the interval may hold in less than 93 % of cases: with fewer than 16 trials, and if the errors are much more
        skewed or heavy-tailed than normal ones. In simulations of 8 to 128 trials the intervals of rmse and slope hold in 95 to
        98 % for nearly normal errors, in 76 to 99 % for skewed or heavy-tailed ones, in 98 to 99.9 % for uniform ones.
    mean, sd : ndarray of shape (k,)
        Of the estimates.
    gain : ndarray of shape (k,)
        How many times more random points give this error; NaN if the variance is not known, or z or `bias` tell of a bias.
    z : ndarray of shape (k,)
        Mean minus integral in standard errors, sd / sqrt(trials); NaN with one trial. Beyond the quantile of Student's t at the
        level of 4 standard deviations (6.3e-5, two-sided) the estimates are taken as biased; where the interval is approximate,
        only if the mean is off by 4 standard errors of random points, too.
    slope, slope_error, slope_low, slope_high : float
        Of log rmse against log n, its standard error and 95 % interval; NaN with fewer than three sizes.
    slope_approximate : bool
        As `approximate`, by the mean over the sizes, for any number of trials.
    slope_sizes : int
        How many sizes the slope is of: all but those whose error is only rounding.
    integral, variance : float
    bias : str
        Where the sets of the pattern are biased (verify_sets, with up to 64 of the 32 trials or more): in which box; else "".
    """

    integrand: str
    pattern: str
    dim: int
    trials: int
    sizes: npt.NDArray[np.int64]
    rmse: npt.NDArray[np.float64]
    low: npt.NDArray[np.float64]
    high: npt.NDArray[np.float64]
    approximate: npt.NDArray[np.bool_]
    mean: npt.NDArray[np.float64]
    sd: npt.NDArray[np.float64]
    gain: npt.NDArray[np.float64]
    z: npt.NDArray[np.float64]
    slope: float
    slope_error: float
    slope_low: float
    slope_high: float
    slope_approximate: bool
    slope_sizes: int
    integral: float
    variance: float
    bias: str = ""

    def _slope_interval(self) -> str:
        return f"{'about ' * self.slope_approximate}{self.slope_low:.3f} to {self.slope_high:.3f}"

    def _repr_html_(self) -> str:
        errors = zip(self.sizes, self.rmse, self.low, self.high, self.approximate, self.gain, self.z)
        slope = "" if math.isnan(self.slope) else f"; slope {self.slope:.3f} ({self._slope_interval()})"
        return table(("n", "rmse", "low", "high", "interval", "gain", "z"),
                     [(int(n), *map(float, (rmse, low, high)), "approximate" if about else "", float(gain), float(z))
                      for n, rmse, low, high, about, gain, z in errors],
                     f"{self.integrand} by {self.pattern}, {self.trials} set{'s' * (self.trials != 1)}{slope}")

    def __float__(self) -> float:
        if len(self.sizes) != 1:
            raise ArgumentError(f"it has {len(self.sizes)} estimates, of n = {self.sizes[0]}..{self.sizes[-1]}: .mean[-1] is the last")
        return float(self.mean[0])

    def _columns(self) -> Dict[str, Any]:
        names = ("rmse", "low", "high", "approximate", "mean", "sd", "gain", "z")
        return {"n": self.sizes, **{name: getattr(self, name) for name in names}}

    def __repr__(self) -> str:
        several = "" if len(self.sizes) == 1 else f"..{self.sizes[-1]}"
        slope = "" if math.isnan(self.slope) else f", slope {self.slope:.3f} ({self._slope_interval()})"
        error = f"rmse {self.rmse[-1]:.3g}"
        if not math.isfinite(self.mean[-1]):
            error = f"mean {self.mean[-1]}: a value of the function is not finite"
        elif math.isnan(self.rmse[-1]):  # one set, of which a second trial is the same, and no integral
            error = f"mean {self.mean[-1]:.6g}; its error takes integral=, or a pattern that depends on the seed"
        return f"Integration({self.integrand!r}, {self.pattern!r}, n={self.sizes[0]}{several}: {error}{slope})"


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
    return members(core().koksma_integrand_at)


@contextmanager
def _opened(function: Function, dim: int, raised: List[BaseException]) -> Iterator[c_void_p]:
    """A koksma_integral. What a function of the caller raises is kept, since no exception passes through C."""
    handle, one = c_void_p(), None
    if isinstance(function, str):
        check(core().koksma_integral_open(text(function, "function"), dim, byref(handle)))
    elif not callable(function):
        raise TypeError(f"function must be a str or callable, not {quoted(function)}")
    else:
        def at(x: Any, _dim: int, _context: object) -> float:
            try:
                return math.nan if raised else _mean(function, np.array(x[:dim])[None, :])
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
        raise TypeError(f"name must be a str, not {quoted(name)}")
    with _opened(name, whole("dim", dim, 1, s.MAX_DIM), []) as handle:
        return _facts(handle)


def _mean(function: Callable[[PointArray], npt.ArrayLike], points: PointArray) -> float:
    """Of the function's values at the points."""
    n, dim = points.shape
    values = values_at(function, _name_of(function), points)
    if values.shape != (n,):
        raise ArgumentError(f"{_name_of(function)}: for points of shape ({n}, {dim}) it returned the shape {values.shape}, "
                            f"not ({n},)")
    try:
        return math.fsum(values) / int(n)
    except OverflowError:  # of the sum, not of the mean
        return math.fsum(values / n)
    except ValueError:  # infinite values of both signs
        return math.nan


def _known(name: str, value: float, least: float) -> float:
    """An integral or a variance: finite, or NaN if it is not known."""
    number = real(name, value, nan_too=True)
    if math.isinf(number) or number < least:
        bound = "" if math.isinf(least) else f", {least:g} or more"
        raise ArgumentError(f"{name} must be a finite number{bound}, or NaN if it is not known, not {quoted(value)}")
    return number


def _estimates(function: Callable[[PointArray], npt.ArrayLike], source: Union[str, PointArray], sizes: Sequence[int], dim: int,
               trials: int, seed: int, threads: SupportsIndex) -> npt.NDArray[np.float64]:
    """[trial][size]; one trial of a deterministic pattern and of points."""
    if not isinstance(source, str):
        return np.array([[_mean(function, source)]])
    pattern: str = source

    def made(n: int, trial: int) -> PointArray:
        return generate(pattern, n, dim, seed + trial, threads=threads)

    found = np.array([[_mean(function, made(n, t)) for n in sizes] for t in range(trials)])
    if (found == found[0]).all() and all(np.array_equal(made(sizes[0], 0), made(sizes[0], t)) for t in range(1, trials)):
        return found[:1]
    return found


def _doubt(integral: float, sizes: Sequence[int], estimates: npt.NDArray[np.float64], unbiased: bool) -> None:
    """Warns of an integral that is surely another: by the standard error at the largest size, where the sets have no bias; of
    one set by how little the estimates moved on the way there, the last fourfold of it above all."""
    if not np.isfinite(estimates).all() or np.abs(estimates).max() > 1e100:
        return
    order, means = np.argsort(sizes), estimates.mean(axis=0)
    n, moved = np.asarray(sizes)[order], means[order] - means[order[-1]]
    if len(estimates) > 1:
        error = estimates[:, order[-1]].std(ddof=1) / math.sqrt(len(estimates)) if unbiased else math.inf
    else:
        error = max(abs(moved[n <= n[-1] / 4][-1]), np.ptp(moved) / 4) if n[0] <= n[-1] / 16 else math.inf
    if 0 < 10 * error < abs(means[order[-1]] - integral):
        warn(f"integral {integral:g}: the estimates are {means[order[-1]]:.6g} +- {error:.2g}; is it the function's over the "
             "unit cube, or has that a pole?")


def _summary(integral: float, variance: float, options: s.IntegrationOptions, estimates: npt.NDArray[np.float64]) -> s.Integration:
    result = s.Integration()
    options.trials = len(estimates)
    check(core().koksma_integration_summary(integral, variance, byref(options), estimates.ctypes.data_as(POINTER(c_double)),
                                            byref(result)))
    return result


def _errors(handle: c_void_p, source: Union[str, PointArray], options: s.IntegrationOptions, threads: SupportsIndex) -> s.Integration:
    """Of an integrand of the table, or a component of one, over sets of a pattern or over points."""
    if isinstance(source, str):
        result, parsed = s.Integration(), spec("pattern", source)
        call(core().koksma_integration_errors, handle, byref(parsed), byref(options), byref(result), threads=threads, run_at=3)
        return result
    mean, c_points, facts = c_double(), view(source), _facts(handle)
    call(core().koksma_integrate, handle, byref(c_points), byref(mean), threads=threads, run_at=2)
    return _summary(facts.value, facts.variance, options, np.array([[mean.value]]))


def _each(name: str, numbers: Union[SupportsIndex, Sequence[SupportsIndex]]) -> Sequence[SupportsIndex]:
    """One number or several, as several."""
    if isinstance(numbers, float):
        raise TypeError(f"{name} must be an int, not {numbers}")
    return [numbers] if hasattr(numbers, "__index__") and not np.ndim(numbers) else several(name, numbers)  # type: ignore[arg-type]


@overload
def integrate(function: Function, pattern: Union[str, npt.ArrayLike], n: Union[SupportsIndex, Sequence[SupportsIndex], None] = None,
              dim: SupportsIndex = 2, *, trials: SupportsIndex = 32, seed: Seed = 0,
              integral: float = math.nan, variance: float = math.nan,
              threads: SupportsIndex = 0, tolerance: None = None) -> Integration: ...


@overload
def integrate(function: Function, pattern: Union[str, SupportsIndex, None] = None, n: Optional[SupportsIndex] = None,
              dim: SupportsIndex = 2, *, tolerance: float, relative: bool = False, estimator: Optional[str] = None,
              interval: Optional[str] = None, confidence: float = 0.95, replicates: Optional[SupportsIndex] = None,
              max_points: SupportsIndex = 1 << 24, value_range: Optional[Sequence[float]] = None,
              bounds: Optional[npt.ArrayLike] = None, warp: Optional[str] = None,
              resume: Union[str, "os.PathLike[str]", None] = None, seed: Seed = 0, threads: SupportsIndex = 0) -> Integral: ...


def integrate(function: Function, pattern: Any = None, n: Any = None, dim: SupportsIndex = 2, *, trials: SupportsIndex = 32,
              seed: Seed = 0, integral: float = math.nan, variance: float = math.nan, threads: SupportsIndex = 0,
              tolerance: Optional[float] = None, relative: bool = False,
              estimator: Optional[str] = None, interval: Optional[str] = None, confidence: float = 0.95,
              replicates: Optional[SupportsIndex] = None, max_points: SupportsIndex = 1 << 24,
              value_range: Optional[Sequence[float]] = None, bounds: Optional[npt.ArrayLike] = None, warp: Optional[str] = None,
              resume: Union[str, "os.PathLike[str]", None] = None) -> Any:
    """Integrates a function by sets of a pattern, and measures the error; or, with a tolerance, to that tolerance.

    Parameters
    ----------
    function : str or callable
        A spec of an integrand, or a function of an (n, dim) array of points that returns its n values, real numbers.
    pattern : str or array_like of shape (n, dim)
        A spec, such as "sobol:scramble=owen"; or points, which are one set. With a tolerance a spec of unbiased sets, None
        for "sobol:scramble=lms,digital-shift=1", or a number of dimensions: integrate(f, 3, tolerance=1e-6).
    n : int or sequence of int
        Numbers of points of a pattern, each once; three or more give a slope. Points have their own. With a tolerance the
        number of points of each set in the first step (64 of each part, 256 of independent sets).
    dim : int
        Of a pattern.
    trials, seed : int
        Sets of each size with the seeds seed .. seed + trials - 1, at most 2^64 - 1; one of a deterministic pattern.
    integral, variance : float
        Of a callable, where they are known: finite, and the variance not negative.
    threads : int
        0: one for each processor.
    tolerance : float
        The points of each set double until the error of the estimate, with the stated confidence, is at most this. 0, with
        n: one estimate of sets of n points. The remaining parameters have an effect only with a tolerance.
    relative : bool
        Whether the tolerance is relative to the integral.
    estimator, interval : str
        Names of estimators() and intervals(). By default the mean and "student" for parts of one set, else the interval "auto",
        which takes median or mean.
    confidence : float
        Of the last interval, whenever the search ends, for about normal estimates whose error falls at least as n**-0.5. With
        fewer than 6 replicates, a confidence below 0.9 or a proved interval all steps that max_points allows share it.
    replicates, max_points : int
        Number of independent sets; limit of their points together. None: with a tolerance, without estimator and interval, and
        for sequences of nets in base 2, the 8 consecutive parts of one set, whose mean has the least error, and a ninth of another set as a check; else 15
        sets.
    value_range : pair of float
        Least and largest value of the function, for the intervals that need them. A value outside is an error.
    bounds : array_like of shape (dim, 2)
        (low, high) of each coordinate: the integral is that over this box, whose points the function gets.
    warp : str
        A name of warps() that maps the first two coordinates to the disk, triangle, hemisphere or sphere: the function gets
        those points (of two or three coordinates) with the other coordinates behind, and the result is its mean over the
        domain, with the warp's density.
    resume : path
        File that keeps the steps. If it exists, its steps are taken from it, and the search continues as if it had never been
        interrupted; tolerance, confidence, estimator, interval and max_points may differ.

    Returns
    -------
    Integration, with a tolerance Integral

    Raises
    ------
    What the function raises.

    Examples
    --------
    >>> import koksma, numpy
    >>> found = koksma.integrate(lambda x: numpy.exp(-(x**2).sum(axis=1)), 3, tolerance=1e-6, bounds=[(-1, 1)] * 3)
    >>> found.reached, abs(float(found) - 1.493648265624854**3) <= 1e-6
    (True, True)
    >>> errors = koksma.integrate(lambda x: x[:, 0] * x[:, 1], "sobol:scramble=owen", [64, 256, 1024], integral=1/4)
    >>> errors.slope < -1  # of random points -1/2
    True
    """
    if tolerance is not None:
        if trials != 32 or not (math.isnan(integral) and math.isnan(variance)):
            raise ArgumentError("trials, integral and variance have no effect with a tolerance; the number of sets is replicates")
        if np.ndim(pattern):
            raise ArgumentError("points of one's own are one set, which tells no error; give a pattern, such as 'sobol:scramble=owen'")
        if hasattr(pattern, "__index__"):
            pattern, dim = None, pattern
        return integrate_to(_opened, function, pattern, n, dim, tolerance=tolerance, relative=relative, estimator=estimator,
                            interval=interval, confidence=confidence, replicates=replicates, max_points=max_points,
                            value_range=value_range, bounds=bounds, warp=warp, resume=resume, seed=seed, threads=threads)
    numbers_given = real("confidence", confidence), whole("max_points", max_points, 2, 1 << 40)
    given = {"relative": flag("relative", relative), "confidence": numbers_given[0] != 0.95, "max_points": numbers_given[1] != 1 << 24}
    for name, value in dict(estimator=estimator, interval=interval, replicates=replicates, value_range=value_range, bounds=bounds,
                            warp=warp, resume=resume).items():
        given[name] = value is not None
    for name in (name for name, is_given in given.items() if is_given):
        raise TypeError(f"{name} has an effect only with a tolerance, integrate(..., tolerance=1e-3)")
    if pattern is None:
        raise TypeError("pattern must be a str or points, or tolerance a number")
    sizes: List[int]
    if isinstance(pattern, (list, tuple)) or hasattr(pattern, "__array__"):
        points = as_points(pattern)
        for i, k in np.argwhere(~((points >= 0) & (points <= 1)))[:1]:
            raise ArgumentError(f"point {i}: coordinate {points[i, k]:g} is outside [0,1]")
        if n is not None:
            raise ArgumentError(f"n must be None, not {quoted(n)}: points have their own number")
        source: Union[str, PointArray] = points
        sizes, dim, trials = [len(points)], points.shape[1], 1
    elif n is None:
        raise TypeError("n must be the number of points of a pattern, or several numbers, not None: integrate(function, pattern, n)")
    else:
        source = _pattern(pattern)
        sizes = sizes_of("n", _each("n", n))
    dim, trials = whole("dim", dim, 1, s.MAX_DIM), whole("trials", trials, 1, 1000000)
    if isinstance(source, str) and core().koksma_has_one_set(byref(spec("pattern", source))):
        if trials != 32 or seed != 0:
            warn_of_one_set(source)
        trials = 1
    seed = first_seed(seed, trials)
    if not 1 <= len(sizes) <= s.MAX_SIZES:
        raise ArgumentError(f"n must be 1 to {s.MAX_SIZES} sizes, not {len(sizes)}")
    options = s.IntegrationOptions((c_size_t * s.MAX_SIZES)(*sizes), len(sizes), seed, trials)
    integral, variance = _known("integral", integral, -math.inf), _known("variance", variance, 0)
    raised: List[BaseException] = []
    with _opened(function, dim, raised) as handle:
        if isinstance(function, str):
            facts, result = _facts(handle), _errors(handle, source, options, threads)
            name, integral, variance = facts.spec, facts.value, facts.variance
        else:
            name = _name_of(function)
            estimates = _estimates(function, source, sizes, dim, trials, seed, threads)
            result = _summary(integral, variance, options, estimates)
            _doubt(integral, sizes, estimates, isinstance(source, str) and bool(core().koksma_is_unbiased(byref(spec("pattern", source)))))
        rows = result.rows[:len(sizes)]
    columns = {key: np.array([getattr(row, key) for row in rows])
               for key in ("rmse", "low", "high", "approximate", "mean", "sd", "gain", "z")}
    return Integration(name, canonical(source) if isinstance(source, str) else "points", dim, rows[0].trials, np.array(sizes), **columns,
                       slope=result.slope.value, slope_error=result.slope.standard_error, slope_low=result.slope.low,
                       slope_high=result.slope.high, slope_approximate=result.slope.approximate, slope_sizes=result.slope.count,
                       integral=integral, variance=variance, bias=result.bias.decode())


def _pattern(pattern: Any) -> str:
    """The text of a spec."""
    return os.fsdecode(text(pattern, "pattern"))
