# SPDX-License-Identifier: Apache-2.0
"""The error of images against a reference: its size, and whether it is noise or bands."""
from __future__ import annotations

import math
from ctypes import POINTER, byref, c_float, create_string_buffer
from dataclasses import dataclass, field
from typing import Any, Dict, Iterable, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._frame import Framed, columns_of, table
from ._library import ArgumentError, check, flag, lab, quoted, text, texts, warn
from ._points import Named, has_masked, named

FEW_PIXELS = 0.5  #: the share of the error in 0.1 % of the pixels from which on koksma warns


@dataclass(frozen=True)
class MetricValue:
    """The value of a metric, and what few pixels do to it; of several images their means."""

    value: float
    robust: float  #: the value without the 0.1 % of the pixels with the largest error
    top_share: float  #: the share of the error that these carry, 0 to 1


@dataclass(frozen=True)
class Comparison(Framed):
    """What `koksma compare` prints, with the same bits.

    mean, sd, max and rmse are those of the absolute error in luminance, means over the images. coherence is the peak
    of the error's power spectrum over its mean, or over the mean of frequencies as high if that is larger (so that blue
    noise counts as noise), averaged over the images; coherence_low to coherence_high its 95 % interval over them, at
    the peak's frequency (frequency_x, frequency_y) in cycles a pixel: of bands it holds, of noise, where the peak is the
    largest of many frequencies, it tends to lie above the true mean of 1. 95 % of white-noise errors
    have a coherence from noise_low to noise_high, and p of them at least this one; coherent says that p is below
    0.005 (and the coherence at least 2). common is the share of the squared error that is the same in all images.
    metrics has rmse and the metrics that were asked for, by their texts.
    What there is none of is NaN: intervals and common of one image, all of them where no image has an error or coherence was
    not asked for.
    """

    mean: float
    sd: float
    max: float
    rmse: float
    coherence: float
    coherence_low: float
    coherence_high: float
    noise_low: float
    noise_high: float
    p: float
    frequency_x: float
    frequency_y: float
    common: float
    coherent: bool
    images: int
    metrics: Dict[str, MetricValue] = field(default_factory=dict)

    def _columns(self) -> Dict[str, Any]:
        return {"metric": list(self.metrics), **columns_of(list(self.metrics.values()))}

    def __repr__(self) -> str:
        values = ", ".join(f"{name} {m.value:.6g}" for name, m in self.metrics.items())
        kind = "" if self.coherence != self.coherence else "; the error is bands" if self.coherent else "; the error is noise"
        return f"Comparison({self.images} image{'s' * (self.images != 1)}: mean {self.mean:.6g}, max {self.max:.6g}, {values}{kind})"

    def _repr_html_(self) -> str:
        rows: List[Tuple[str, float, Union[float, str], str]] = [("mean absolute error", self.mean, "", ""), ("largest", self.max, "", "")]
        rows += [(name, m.value, m.robust, f"{100 * m.top_share:.0f} %") for name, m in self.metrics.items()]
        kind = "bands" if self.coherent else "noise"
        said = f"; the error is {kind} (coherence {self.coherence:.3g}, noise is below {self.noise_high:.3g})"
        return table(("error", "value", "without 0.1 % of the pixels", "their share"), rows,
                     f"{self.images} image{'s' * (self.images != 1)}{said if self.coherence == self.coherence else ''}")


def _metric(name: str) -> Tuple[s.MetricSpec, str]:
    """A metric by its text, and the canonical text."""
    spec, canonical = s.MetricSpec(), create_string_buffer(s.MAX_SPEC)
    check(lab().koksma_metric_parse(text(name, "metric"), byref(spec)))
    lab().koksma_metric_text(byref(spec), canonical)
    return spec, canonical.value.decode()


def metrics() -> List[Named]:
    """All metrics of the error of images, in the table's order.

    Returns
    -------
    list of Named

    Examples
    --------
    >>> import koksma
    >>> "smape" in [m.name for m in koksma.metrics()]
    True
    """
    return named(lab().koksma_metric_at)


def as_image(image: npt.ArrayLike) -> npt.NDArray[np.float32]:
    try:
        given = np.asanyarray(image)
    except (TypeError, ValueError, RuntimeError):
        raise ArgumentError(f"an image must be an array of real numbers, not {quoted(image)}") from None
    if isinstance(image, (str, bytes)):
        raise ArgumentError(f"an image must be an array, not the text {quoted(image)}; read_image(path) reads a file")
    if given.dtype.kind not in "buifO":
        raise ArgumentError(f"pixels must be real numbers, not {given.dtype}")
    if given.dtype in (np.uint8, np.uint16):
        raise ArgumentError(f"pixels of linear light are floats, not {given.dtype}; read_image reads files, and decodes them")
    if has_masked(given):
        raise ArgumentError("an image must not have masked pixels")
    try:
        array = np.require(given, np.float32, ["C", "A"])
    except (TypeError, ValueError):
        raise ArgumentError(f"pixels must be real numbers, not {quoted(given)}") from None
    array = array[:, :, np.newaxis] if array.ndim == 2 else array
    if array.ndim != 3 or 0 in array.shape or array.shape[2] not in (1, 3) or max(array.shape) > s.MAX_IMAGE_SIDE:
        raise ArgumentError("an image must be an array of shape (height, width), (height, width, 1) or (height, width, 3), "
                            f"not {given.shape}")
    return array


def view_image(array: npt.NDArray[np.float32]) -> s.Image:
    height, width, channels = array.shape
    return s.Image(width, height, channels, array.ctypes.data_as(POINTER(c_float)))


def compare(images: Union[npt.ArrayLike, Iterable[npt.ArrayLike]], reference: npt.ArrayLike,
            metrics: Sequence[str] = (), *, coherence: Optional[bool] = None) -> Comparison:
    """Compares an image, or several in a list or another iterable, with a reference, all of linear light.

    Parameters
    ----------
    images : array_like, or an iterable of them
        Several images are those of one pattern with several seeds; an iterator is asked for one at a time.
    reference : array_like of shape (height, width) or (height, width, channels)
    metrics : sequence of str
        Beside rmse, such as "relmse", "smape:epsilon=0.001" or "hdr-flip:ppd=40" (`koksma.metrics()`).
    coherence : bool, optional
        Whether to find out if the error is noise or bands, which takes most of the time. None: only without metrics.

    Returns
    -------
    Comparison

    Raises
    ------
    ArgumentError
        A metric is unknown, or the images have other shapes than the reference.
    MalformedError
        A pixel is not a finite number.

    Warns
    -----
    RuntimeWarning
        0.1 % of the pixels carry half of the error or more; or an image looks as if units, order or scene were wrong.

    Examples
    --------
    >>> import koksma
    >>> import numpy as np
    >>> image = np.full((8, 8), 1.5)
    >>> round(koksma.compare(image, np.ones((8, 8)), metrics=["smape"]).metrics["smape"].value, 6)
    0.199203
    """
    asked = texts("metrics", metrics)
    specs = {name: _metric(name)[0] for name in ("rmse", *asked)}
    several: Any = images
    if hasattr(images, "__array__"):
        several = [images] if np.ndim(several) < 4 else several
    elif isinstance(images, (list, tuple)):
        try:
            several = [images] if images and np.ndim(images[0]) < 2 else images
        except ValueError:
            several = [images]
    elif not hasattr(images, "__iter__"):
        raise TypeError(f"images must be an array, or several of them, not {quoted(images)}")
    target = as_image(reference)
    c_target, raw, error, values = view_image(target), s.Coherence(), s.ImageError(), s.CoherenceValues()
    errors: List[List[float]] = []
    caveats: Dict[str, Optional[bytes]] = {}
    doubts: List[str] = []
    found: Dict[str, List[List[float]]] = {name: [] for name in specs}
    value = s.MetricValue()
    looks = not asked if coherence is None else flag("coherence", coherence)
    if looks:
        check(lab().koksma_coherence_init(byref(raw), target.shape[1], target.shape[0]))
    try:
        for image in several:
            array = as_image(image)
            c_image = view_image(array)
            check(lab().koksma_image_compare(byref(c_image), byref(c_target), byref(error)))
            if looks:
                check(lab().koksma_coherence_add(byref(raw), byref(c_image), byref(c_target)))
            for name, spec in specs.items():
                check(lab().koksma_metric_evaluate(byref(spec), byref(c_image), byref(c_target), byref(value)))
                found[name].append([value.value, value.robust, value.top_share])
                caveats[name] = value.caveat  # of the reference: the same for all images
            if doubt := lab().koksma_image_doubt(byref(c_image), byref(c_target), not errors).decode():
                doubts.append(f"image {len(errors)}: {doubt}")
            errors.append([error.mean, error.sd, error.max, error.rmse])
        if not errors:
            raise ArgumentError("a comparison takes at least one image")
        if looks:
            lab().koksma_coherence_find(byref(raw), byref(values))
        else:
            values = s.CoherenceValues(0, *[math.nan] * 9)
    finally:
        lab().koksma_coherence_fini(byref(raw))
    mean, sd, most, rmse = (sum(column) / len(errors) for column in zip(*errors))
    values_of = {name: MetricValue(*(sum(column) / len(errors) for column in zip(*rows))) for name, rows in found.items()}
    for doubt in doubts[:1]:
        warn(doubt, RuntimeWarning)
    for name, caveat in caveats.items():
        if caveat:
            warn(f"{name}: {caveat.decode()}", RuntimeWarning)
    for name, averaged in values_of.items():
        if averaged.top_share >= FEW_PIXELS:
            warn(f"0.1 % of the pixels carry {100 * averaged.top_share:.0f} % of the error; without them {name} is "
                 f"{averaged.robust:.5g}", RuntimeWarning)
    return Comparison(mean, sd, most, rmse, values.coherence, values.low, values.high, values.noise_low, values.noise_high, values.p,
                      values.frequency_x, values.frequency_y, values.common, values.coherent, len(errors), values_of)
