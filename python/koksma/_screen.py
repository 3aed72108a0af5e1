# SPDX-License-Identifier: Apache-2.0
"""How much of the error over the pixels of a screen a filter leaves."""
from __future__ import annotations

from ctypes import byref
from dataclasses import dataclass
from typing import List, SupportsIndex, Union

import numpy.typing as npt

from . import _structs as s
from ._library import call, core, first_seed, spec, whole
from ._mask import filter_of


@dataclass(frozen=True)
class ScreenError:
    """Errors for 100 integrands of `coordinates` of the coordinates, each with its standard error, NaN with one image.

    plain: of a pixel, in units of that of as many random points. blurred: after the filter, in units of that of white noise
    with the same plain error.
    """

    coordinates: int
    plain: float
    plain_error: float
    blurred: float
    blurred_error: float


def screen_errors(pattern: str, n: SupportsIndex, dim: SupportsIndex = 2, *, filter: Union[str, npt.ArrayLike] = "gaussian:sigma=1.5",
                  side: SupportsIndex = 64, trials: SupportsIndex = 1, seed: SupportsIndex = 0, threads: SupportsIndex = 0
                  ) -> List[ScreenError]:
    """Measures how much of the error over a screen a filter leaves, as `koksma curve screen`.

    Parameters
    ----------
    pattern : str
        A spec. Patterns with a parameter `width`, and tiles, make all pixels by one set; every other pattern makes a set for
        each pixel. A pattern of fewer dimensions fills them in groups, each with another seed.
    n : int
        Samples a pixel, 1 to 256.
    dim : int
        Coordinates, 1 to 4: there is a row for integrands of 1, 2 .. dim of them.
    filter : str or array_like of shape (height, width)
        As of `mask`; at most side / 2 pixels wide and high.
    side : int
        Pixels a side of the image, 2 to 512.
    trials, seed : int
        Images with the seeds seed .. seed + trials - 1, 1 to 4096.
    threads : int
        0: one for each processor. The values do not depend on it.

    Returns
    -------
    list of ScreenError

    Raises
    ------
    ArgumentError
        A spec, or a filter that is too large; what `generate` refuses.

    Examples
    --------
    >>> import koksma
    >>> white, blue = (koksma.screen_errors(p, 1, trials=2)[1].blurred for p in ("random", "ranking-keys"))
    >>> blue < white / 2
    True
    """
    count = whole("trials", trials, 1, 4096)
    options = s.ScreenOptions(whole("dim", dim, 1, 4), whole("side", side, 2, 512), whole("n", n, 1, 256), filter_of(filter),
                              first_seed(seed, count), count)
    rows = (s.ScreenRow * options.dim)()
    call(core().koksma_screen_errors, byref(spec("pattern", pattern)), byref(options), rows, threads=threads, run_at=2)
    return [ScreenError(r.coordinates, r.plain, r.plain_error, r.blurred, r.blurred_error) for r in rows]
