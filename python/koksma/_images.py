# SPDX-License-Identifier: Apache-2.0
"""Images of other renderers in many files: their errors by groups, as `koksma study images` has them."""
from __future__ import annotations

import os
from ctypes import POINTER, byref, c_size_t, cast, c_void_p
from dataclasses import dataclass
from typing import List, Optional, SupportsIndex, Tuple, Union

from . import _structs as s
from ._compare import _metric
from ._library import call, lab, text
from ._plot import _free


@dataclass(frozen=True)
class ImageGroup:
    """Images that differ only in {trial}: means over the trials. NaN: there is none, as of intervals of one trial."""

    group: str  #: the other names in braces with their texts: "pattern=halton scene=ball"
    spp: Optional[int]  #: the number at {spp}; None: there is no {spp}
    trials: int
    error: float
    interval: Tuple[float, float]  #: of the error, with 95 %
    robust: float  #: the error without the 0.1 % of the pixels with the largest
    top_share: float  #: the share of the error that these carry
    sd: float  #: of the absolute error in luminance over the pixels, as max and rmse
    max: float
    rmse: float
    slope: float  #: of log error against log spp; NaN with one spp
    slope_interval: Tuple[float, float]
    coherence: float  #: of the error of all trials, as koksma.compare has it
    coherent: bool
    position: int  #: by the error, among the groups with this spp
    behind: float  #: relative difference to the error of the first of them
    behind_interval: Tuple[float, float]


def study_images(places: Union[str, "os.PathLike[str]"], reference: Union[str, "os.PathLike[str]"], *, metric: str = "mae",
                 threads: SupportsIndex = 0) -> List[ImageGroup]:
    """Compares all images whose paths match a template with a reference image.

    Parameters
    ----------
    places : str or path
        Such as "out_{pattern}_{spp}_{trial}.exr": {spp} and {trial} are numbers, other names in braces any text without '/'.
    reference : str or path
    metric : str
        Of the error (koksma.metrics() names them).
    threads : int
        0: one for each processor.

    Returns
    -------
    list of ImageGroup
        Sorted by group and spp.

    Raises
    ------
    ArgumentError, MissingError, MalformedError

    Examples
    --------
    >>> import koksma
    >>> koksma.write_image("truth.pfm", koksma.render("ball", "jittered", 256, size=(16, 12)))
    >>> for pattern in ("random", "jittered"):
    ...     for trial in range(4):
    ...         image = koksma.render("ball", pattern, 4, size=(16, 12), seed=trial)
    ...         koksma.write_image(f"mine_{pattern}_{trial}.pfm", image)
    >>> [group.group for group in koksma.study_images("mine_{p}_{trial}.pfm", "truth.pfm")]
    ['p=jittered', 'p=random']
    """
    spec, _ = _metric(metric)
    rows, count = POINTER(s.ImagesRow)(), c_size_t()
    try:
        call(lab().koksma_study_images, text(places, "places"), text(reference, "reference"), byref(spec),
             byref(rows), byref(count), threads=threads, run_at=3)
        return [ImageGroup(os.fsdecode(r.group), r.spp or None, r.trials, r.mean, (r.low, r.high), r.robust, r.top_share, r.sd, r.max,
                           r.rmse, r.slope, (r.slope_low, r.slope_high), r.coherence.coherence, r.coherence.coherent, r.position,
                           r.behind, (r.behind_low, r.behind_high)) for r in rows[:count.value]]
    finally:
        _free(cast(rows, c_void_p))
