# SPDX-License-Identifier: Apache-2.0
"""The power spectrum of plane point sets."""
from __future__ import annotations

from ctypes import byref, c_double
from dataclasses import dataclass
from typing import Any, Dict, Iterable, Sequence, SupportsIndex

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._frame import Framed
from ._library import ArgumentError, call, check, core, flag, quoted, real, whole
from ._matplotlib import curve
from ._points import as_points, shown, view


@dataclass(frozen=True, eq=False)
class Spectrum(Framed):
    """The mean power spectrum of one or more sets; for random points 1 in the mean, except at frequency 0, where it is n.

    power[half + ky, half + kx] is the power at (kx, ky). Ring i has the frequencies of length i + 1/2 to i + 3/2:
    its mean, the standard error over the sets (NaN for one), and the anisotropy in dB: NaN for a ring without power,
    -inf for one of equal powers. After Heck, Schlömer and Deussen (2013), effective_nyquist (also over sqrt(n)/2, that
    of a large square lattice, in steps of 1/sqrt(n)) and oscillation sum the rings up. Each is NaN when the spectrum ends
    too early for it: a half of 7 sqrt(n) is enough for both, of 1.5 sqrt(n) for effective_nyquist.
    """

    power: npt.NDArray[np.float64]
    frequency: npt.NDArray[np.float64]
    ring_power: npt.NDArray[np.float64]
    standard_error: npt.NDArray[np.float64]
    anisotropy_db: npt.NDArray[np.float64]
    effective_nyquist: float
    relative_nyquist: float
    oscillation: float
    sets: int

    def _columns(self) -> Dict[str, Any]:
        return {"frequency": self.frequency, "power": self.ring_power, "standard_error": self.standard_error,
                "anisotropy_db": self.anisotropy_db}

    def __repr__(self) -> str:
        return (f"Spectrum({self.sets} set{'s' * (self.sets != 1)}, frequencies up to {len(self.frequency)}: effective_nyquist "
                f"{self.effective_nyquist:.4g}, oscillation {self.oscillation:.4g})")

    def draw(self, ax: Any = None, **style: Any) -> Any:
        """Draws the mean power of the rings on axes of matplotlib, or on new ones; returns them. style goes to Axes.errorbar."""
        return curve(ax, self.frequency, self.ring_power, error=self.standard_error, level=1, labels=("frequency", "power"), **style)

    plot = draw

    def _repr_svg_(self) -> str:
        from ._picture import chart

        return chart("frequency", "power", [(f"{self.sets} set{'s' * (self.sets != 1)}", self.frequency, self.ring_power)], 1,
                     "Mean power of rings").svg


def _result(raw: s.Spectrum) -> Spectrum:
    half, width = raw.half, 2 * raw.half + 1
    upper = shown(raw.power, half + 1, width)  # ky >= 0; the rest is its mirror
    power = np.concatenate([upper[:0:-1, ::-1], upper])
    rings = (s.Ring * half)()
    check(core().koksma_spectrum_rings(byref(raw), rings))
    table = np.frombuffer(rings, dtype=np.float64).reshape(half, 4).copy()
    quality = s.SpectrumQuality()
    core().koksma_spectrum_quality(byref(raw), byref(quality))
    return Spectrum(power, table[:, 0], table[:, 1], table[:, 2], table[:, 3], quality.effective_nyquist,
                    quality.relative_nyquist, quality.oscillation, raw.sets)


def _each(sets: "npt.ArrayLike | Iterable[npt.ArrayLike]") -> "Iterable[npt.ArrayLike]":
    """The sets one by one. What has rows of numbers is one set; an iterator is not looked into beforehand."""
    rows: Any = np.asanyarray(sets) if hasattr(sets, "__array__") else sets
    if isinstance(rows, (str, bytes)) or isinstance(rows, np.ndarray) and rows.ndim != 3:
        return [rows]
    try:
        single = isinstance(rows, Sequence) and len(rows) > 0 and np.ndim(rows[0]) == 1
        return [rows] if single else iter(rows)
    except (TypeError, ValueError):
        raise TypeError(f"sets must be an array of points, or several of them, not {quoted(rows)}") from None


def spectrum(sets: "npt.ArrayLike | Iterable[npt.ArrayLike]", half: SupportsIndex = 64, *,
             exact: bool = False, threads: SupportsIndex = 0) -> Spectrum:
    """The power spectrum at the frequencies |kx|, |ky| <= half of one (n, 2) set, or the mean over several.

    Parameters
    ----------
    sets : array_like of shape (n, 2), or an iterable of them
    half : int
    exact : bool
        Sums over all points at each frequency, instead of an FFT within 1e-9 of n.
    threads : int
        0: one for each processor.

    Returns
    -------
    Spectrum

    Examples
    --------
    >>> import koksma
    >>> found = koksma.spectrum([koksma.generate("jittered", 64, seed=seed) for seed in range(8)], half=16)
    >>> bool(found.ring_power[0] < 0.5 < found.ring_power[-1])
    True
    """
    raw, method = s.Spectrum(), 0 if flag("exact", exact) else 1
    check(core().koksma_spectrum_init(byref(raw), whole("half", half, 1, s.MAX_HALF)))
    try:
        for points in _each(sets):
            c_points = view(array := as_points(points))
            call(core().koksma_spectrum_add, byref(raw), byref(c_points), method, threads=threads, run_at=3)
            del array
        if not raw.sets:
            raise ArgumentError("a spectrum takes at least one set of points")
        return _result(raw)
    finally:
        core().koksma_spectrum_fini(byref(raw))


def pair_correlation(sets: "npt.ArrayLike | Iterable[npt.ArrayLike]", r_max: float = 0.25, bins: SupportsIndex = 64, *,
                     threads: SupportsIndex = 0) -> "PairCorrelation":
    """The density of pairs at each distance on the unit torus over that of random points; 1 for random points.

    Parameters
    ----------
    sets : array_like of shape (n, 2), or an iterable of them
        Of several the mean is returned.
    r_max : float
        Distances up to r_max, above 0 and at most 1/2.
    bins : int
        Equal bins of distance, each with its lower bound and without its upper; counts are over n (n - 1).
    threads : int
        0: one for each processor.

    Returns
    -------
    PairCorrelation

    Examples
    --------
    >>> import koksma
    >>> bool(koksma.pair_correlation(koksma.generate("poisson-disk:d=0.1,torus=1", 50), 0.08, 8).density.max() == 0)
    True
    """
    width, reach = whole("bins", bins, 1, 1 << 24), real("r_max", r_max, nan_too=True)
    total, count, values = np.zeros(width), 0, (c_double * width)()
    for points in _each(sets):
        c_points = view(array := as_points(points))
        call(core().koksma_pair_correlation, byref(c_points), reach, width, values, threads=threads, run_at=3)
        del array
        total += np.array(values)
        count += 1
    if not count:
        raise ArgumentError("a pair correlation takes at least one set of points")
    return PairCorrelation((np.arange(width) + 0.5) * reach / width, total / count, count)


@dataclass(frozen=True, eq=False)
class PairCorrelation(Framed):
    """density[b] is that of pairs in the bin whose middle is distance[b]; the mean over `sets` sets."""

    distance: npt.NDArray[np.float64]
    density: npt.NDArray[np.float64]
    sets: int

    def _columns(self) -> Dict[str, Any]:
        return {"distance": self.distance, "density": self.density}

    def __repr__(self) -> str:
        return f"PairCorrelation({self.sets} set{'s' * (self.sets != 1)}, {len(self.distance)} bins up to {self.distance[-1]:.4g})"

    def draw(self, ax: Any = None, **style: Any) -> Any:
        """Draws the density on axes of matplotlib, or on new ones; returns them. style goes to Axes.errorbar."""
        return curve(ax, self.distance, self.density, level=1, labels=("distance", "pair correlation"), **style)

    plot = draw

    def _repr_svg_(self) -> str:
        from ._picture import chart

        return chart("distance", "pair correlation", [(f"{self.sets} set{'s' * (self.sets != 1)}", self.distance, self.density)], 1).svg
