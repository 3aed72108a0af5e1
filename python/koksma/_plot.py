# SPDX-License-Identifier: Apache-2.0
"""Pictures of several patterns: their convergence, points and spectra."""
from __future__ import annotations

import ctypes
import math
from ctypes import c_double, POINTER
from typing import Any, List, Optional, Sequence, SupportsIndex

import numpy as np

from . import _structs as s
from ._library import ArgumentError, Seed, first_seed, text, whole
from ._picture import Picture, colours, convergence_chart, convergence_figure, figure_of
from ._points import as_points, generate, view
from ._series import Convergence, convergence
from ._spectrum import spectrum


def plot_convergence(*results: Convergence, size: float = 0, title: Optional[str] = None, theme: str = "light") -> Picture:
    """Draws measures against the number of points on logarithmic axes, with the standard errors of the means.

    Parameters
    ----------
    *results : Convergence
        Each a curve, named by its pattern; all of one measure, or the measure's name stands beside.
    size : float
        Width in points, or pixels of a PNG; 0: 480.
    title : str, optional
        The heading; else the measure.
    theme : {"light", "dark"}

    Returns
    -------
    Picture

    Examples
    --------
    >>> import koksma
    >>> curves = [koksma.convergence(pattern, sizes=[16, 64, 256]) for pattern in ("sobol", "halton")]
    >>> koksma.plot_convergence(*curves).svg.count("slope")
    2
    """
    if not all(isinstance(r, Convergence) for r in results):
        raise TypeError("results must be what koksma.convergence returns")
    if not results:
        raise ArgumentError("plot_convergence takes at least one Convergence")
    return convergence_figure(results, size, title, theme)


def plot_compare(*patterns: str, n: SupportsIndex = 256, measure: str = "l2-star", sizes: Optional[Sequence[SupportsIndex]] = None,
                 trials: SupportsIndex = 10, seed: Seed = 0, size: float = 0, title: Optional[str] = None,
                 theme: str = "light") -> Picture:
    """Draws patterns side by side: points, mean power spectra, their radial means, and the convergence of a measure.

    Parameters
    ----------
    *patterns : str
        Specs, at most 16.
    n : int
        Points of each set, of the plane.
    measure : str
    sizes : sequence of int, optional
        Numbers of points for the convergence; else 16, 64, 256 and 1024.
    trials, seed : int
        Sets with the seeds seed .. seed + trials - 1, at most 2^64 - 1.
    size : float
        Width in points, or pixels of a PNG; 0: as many as the patterns need, up to 960.
    title : str, optional
    theme : {"light", "dark"}

    Returns
    -------
    Picture

    Examples
    --------
    >>> import koksma
    >>> picture = koksma.plot_compare("random", "sobol:scramble=owen", n=64, sizes=[16, 64], trials=4)
    >>> picture.svg.count("<image")
    2
    """
    if not 1 <= len(patterns) <= 16:
        raise ArgumentError(f"{len(patterns)} patterns: give 1 to 16")
    count, n_sets = whole("n", n, 1, s.MAX_COORDINATES), whole("trials", trials, 1, 10**9)
    first = first_seed(seed, n_sets)
    half = min(math.ceil(2 * math.sqrt(count)), s.MAX_HALF)
    points: List[s.Panel] = []
    spectra: List[s.Panel] = []
    kept: List[Any] = []
    curves = (s.Curve * len(patterns))()
    for i, (pattern, colour) in enumerate(zip(patterns, colours(patterns))):
        array = as_points(generate(pattern, count, seed=first))
        c_points = view(array)
        mean = spectrum((generate(pattern, count, seed=first + t) for t in range(n_sets)), half)
        power, rings = np.ascontiguousarray(mean.power[half:]), np.zeros(half + 1)
        raw = s.Spectrum(half, mean.sets, count, power.ctypes.data_as(POINTER(c_double)), rings.ctypes.data)
        name = text(f"{pattern}, n = {count}", "pattern")
        points.append(s.Panel(points=ctypes.pointer(c_points), title=name, swatch=1 + colour))
        spectra.append(s.Panel(spectrum=ctypes.pointer(raw), title=name, swatch=1 + colour))
        xs, ys, errors = ((c_double * half)(*column)
                          for column in (mean.frequency / math.sqrt(count), mean.ring_power, mean.standard_error))
        curves[i] = s.Curve(name, half, xs, ys, errors, False, False, colour)
        kept += [array, c_points, power, rings, raw, xs, ys, errors]
    radial = s.Chart(b"frequency / \xe2\x88\x9an", b"power; dashed: 1 of random points", False, False, curves, len(patterns), True, 1,
                     title=b"Radial mean of the power spectrum")
    falling = convergence_chart([convergence(p, measure, sizes, trials=n_sets, seed=first) for p in patterns], kept)
    falling.title = f"Convergence of {measure}".encode()
    return figure_of([points, spectra, [radial, falling]], "Points, power spectra and convergence" if title is None else title, size,
                   theme, kept)
