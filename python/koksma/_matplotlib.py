# SPDX-License-Identifier: Apache-2.0
"""Curves on the axes of matplotlib, which is loaded on first use."""
from __future__ import annotations

from typing import Any, Optional, Tuple

import numpy as np
import numpy.typing as npt

from ._library import UnsupportedError


def axes(given: Any) -> Any:
    """The axes given, or new ones in a new figure."""
    if given is not None:
        return given
    try:
        from matplotlib import pyplot  # type: ignore[import-not-found, unused-ignore]
    except ModuleNotFoundError:
        raise UnsupportedError("drawing on new axes needs matplotlib (pip install matplotlib); koksma.plot, plot_compare and "
                               "plot_convergence draw without it") from None
    return pyplot.subplots()[1]


def curve(ax: Any, x: npt.ArrayLike, y: npt.ArrayLike, *, labels: Tuple[str, str], error: Optional[npt.ArrayLike] = None,
          level: Optional[float] = None, **style: Any) -> Any:
    """Draws a curve, with bars of 1.96 standard errors and a dashed level; returns the axes."""
    ax = axes(ax)
    bars = None if error is None or not np.isfinite(error).all() else 1.96 * np.asarray(error)
    ax.errorbar(x, y, yerr=bars, **style)
    if level is not None:
        ax.axhline(level, color="0.6", linestyle="--", linewidth=0.8)
    ax.set_xlabel(labels[0])
    ax.set_ylabel(labels[1])
    if "label" in style:
        ax.legend()
    return ax
