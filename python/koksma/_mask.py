# SPDX-License-Identifier: Apache-2.0
"""Blue-noise masks for a filter: making, measuring, reading and writing."""
from __future__ import annotations

import math
import os
from ctypes import POINTER, byref, c_float, c_int, cast
from dataclasses import dataclass
from typing import Any, Callable, List, Optional, SupportsIndex, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._library import ArgumentError, Seed, call, check, core, flag, lab, pair, quoted, real, seed_of, text, warn, whole

MaskArray = npt.NDArray[np.float32]
_BY_NUMBERS = ("scalar", "vector2", "vector3", "vector4")


@dataclass(frozen=True)
class MaskQuality:
    """How much of a mask a filter leaves: the root of the mean, over tests, of the variance over the pixels of the filtered
    image of (value < t).

    white: of the same values in random order. inside and seam: of the pixels whose filter lies within the mask, and of those
    whose filter spans two opposite sides; NaN if there are none.
    """

    error: float
    white: float
    inside: float
    seam: float


def _space(name: Any) -> Any:
    """A pointer to a line of the table."""
    found = core().koksma_mask_space_find(text(name, "space"))
    if not found:
        names: List[str] = []
        while core().koksma_mask_space_at(len(names)):
            names.append(core().koksma_mask_space_at(len(names)).contents.name.decode())
        raise ArgumentError(f"space must be one of {', '.join(names)}, not {quoted(name)}")
    return found


def filter_of(given: Union[str, npt.ArrayLike]) -> s.MaskFilter:
    """The filter of a text, or of an array of weights."""
    result = s.MaskFilter()
    if isinstance(given, (str, bytes, os.PathLike)):
        check(lab().koksma_mask_filter_parse(text(given, "filter"), byref(result)))
        return result
    weights = _numbers("filter", given)
    if weights.ndim != 2 or not weights.size or max(weights.shape) > s.MASK_MAX_SIDE:
        raise ArgumentError(f"filter must be a text or an array of up to {s.MASK_MAX_SIDE} x {s.MASK_MAX_SIDE} weights, not of shape "
                            f"{weights.shape}")
    result.height, result.width = weights.shape
    result.weights[:weights.size] = weights.ravel().tolist()
    check(core().koksma_mask_filter_check(byref(result)))
    return result


def _numbers(name: str, given: Any) -> npt.NDArray[np.float64]:
    array = np.asarray(given)
    if array.dtype.kind not in "uif":
        raise TypeError(f"{name} must be an array of numbers, not {quoted(given)}")
    return array.astype(np.float64)


def _as_mask(name: str, given: Any, space: Optional[str]) -> Tuple[MaskArray, Any]:
    """A mask as contiguous floats of shape (height, width, numbers), and its space."""
    array = np.ascontiguousarray(_numbers(name, given), dtype=np.float32)
    if array.ndim == 2:
        array = array[..., None]
    if array.ndim != 3 or not 1 <= array.shape[2] <= 4:
        raise ArgumentError(f"{name} must have the shape (height, width) or (height, width, numbers), not {np.shape(given)}")
    if max(array.shape) > s.MASK_MAX:
        raise ArgumentError(f"{name} must have sides of up to {s.MASK_MAX} pixels, not the shape {np.shape(given)}")
    found = _space(_BY_NUMBERS[array.shape[2] - 1] if space is None else space)
    if found.contents.dim != array.shape[2]:
        raise ArgumentError(f"{name} must have {found.contents.dim} numbers a pixel in the space {found.contents.name.decode()}, not "
                            f"{array.shape[2]}")
    return array, found


def _alike(array: npt.NDArray[Any]) -> float:
    """The correlation of neighbours in a row: about 0 of a mask or less, near 1 of a picture."""
    left, right = (side.ravel() - side.mean() for side in (array[:, :-1], array[:, 1:]))
    return float(left @ right / math.sqrt((left @ left) * (right @ right) or 1))


def is_permutation(array: npt.NDArray[Any]) -> bool:
    """Whether all numbers are equally often."""
    counts = np.unique(array, return_counts=True)[1]
    return bool(np.ptp(counts) <= 1 < len(counts))


def looks_like_mask(image: npt.NDArray[Any]) -> bool:
    return image.shape[2] == 1 and image.size >= 256 and _alike(image) < 0.2 and is_permutation(image)


def _doubt(name: str, array: MaskArray) -> None:
    if array.size > 1 and (array == array.flat[0]).all():
        warn(f"{name}: all numbers are {array.flat[0]:g}: a mask has different ones")
    elif array.size >= 256 and _alike(array) > 0.5 and not is_permutation(array):
        warn(f"{name}: neighbours are alike, as in a picture, not different, as in a mask; read_image reads pictures")


def _pointer(array: MaskArray) -> Any:
    return array.ctypes.data_as(POINTER(c_float))


def _shaped(array: MaskArray) -> MaskArray:
    return array[..., 0] if array.shape[2] == 1 else array


def mask(filter: Union[str, npt.ArrayLike] = "gaussian:sigma=1", size: Optional[Tuple[SupportsIndex, SupportsIndex]] = None, *,
         space: Optional[str] = None, swaps: float = 4000, seed: Seed = 0, levels: SupportsIndex = 0, open: bool = False,
         start: Optional[npt.ArrayLike] = None, target: float = 0, time_limit: Optional[float] = None,
         progress: Optional[Callable[[float], object]] = None) -> MaskArray:
    """A blue-noise mask of which a filter leaves as little as possible, by simulated annealing.

    Parameters
    ----------
    filter : str or array_like of shape (rows, columns)
        "box:size=K", "binomial:size=K", "gaussian:sigma=S", a name of `koksma.filters`, "file:PATH", or weights, up to 65 x 65.
    size : (width, height)
        In pixels, 4 to 1024. Default: (128, 128), or the size of `start`.
    space : str
        The numbers of a pixel: "scalar" (the default), "tent", "gaussian", "vector2" to "vector4", "disk", "circle", "sphere" or
        "hemisphere" (with the density of the cosine). With `start` the default follows from its shape.
    swaps : float
        Proposed swaps a pixel, 0 to 1e6; 0 gives a random arrangement.
    seed : int
        From 0 to 2^64 - 1.
    levels : int
        Scalars: the number of different values, each equally often; 0: as many as pixels.
    open : bool
        The mask has borders; False: it is a tile that repeats.
    start : array_like of shape (height, width) or (height, width, numbers)
        Rearrange this mask, in place of new values. The error of the result is never above its own.
    target : float
        End once the error is at most this number.
    time_limit : float
        In seconds: the mask is then as good as it was by then, and not the same every time.
    progress : callable
        Called with the fraction done.

    Returns
    -------
    ndarray of float32 and shape (height, width), or (height, width, numbers)
        Equal arguments give equal bits, those of `koksma mask`. The search uses one thread.

    Examples
    --------
    >>> import koksma
    >>> noise = koksma.mask("box:size=3", (16, 16), swaps=100)
    >>> quality = koksma.mask_quality(noise, "box:size=3")
    >>> quality.error < quality.white / 2
    True
    """
    options = s.MaskOptions(filter=filter_of(filter), open=flag("open", open), levels=whole("levels", levels, 0, s.MAX_INT),
                            seed=seed_of(seed), swaps=real("swaps", swaps), target=real("target", target))
    width, height = (whole("size", side, s.MASK_MIN, s.MASK_MAX) for side in pair("size", (128, 128) if size is None else size))
    options.space = _space("scalar" if space is None else space)
    if start is not None:
        first, options.space = _as_mask("start", start, space)
        if size is not None and (height, width) != first.shape[:2]:
            raise ArgumentError(f"size must be that of start, {first.shape[1]} x {first.shape[0]}, not {width} x {height}")
        height, width = first.shape[:2]
        setattr(options, "from", _pointer(first))
    options.width, options.height = width, height
    values = np.empty((height, width, options.space.contents.dim), np.float32)
    call(core().koksma_mask_optimise, byref(options), _pointer(values), None, run_at=1, time_limit=time_limit, progress=progress)
    return _shaped(values)


def mask_quality(mask: npt.ArrayLike, filter: Union[str, npt.ArrayLike] = "gaussian:sigma=1", *, space: Optional[str] = None,
                 tests: Optional[SupportsIndex] = None, threads: SupportsIndex = 0) -> MaskQuality:
    """Measures how much of a mask a filter leaves.

    Parameters
    ----------
    mask : array_like of shape (height, width) or (height, width, numbers)
        4 to 1024 pixels a side.
    filter : str or array_like
        As for `koksma.mask`.
    space : str
        Default: "scalar", "vector2", "vector3" or "vector4", by the shape.
    tests : int
        Thresholds of scalars, half-spaces of vectors, 1 to 65536. Default: 256, or 400.
    threads : int
        0: one for each processor. The result does not depend on it.

    Returns
    -------
    MaskQuality

    Examples
    --------
    >>> import koksma, numpy as np
    >>> ramp = np.arange(64).reshape(8, 8) / 64
    >>> koksma.mask_quality(ramp, "box:size=3").error > koksma.mask_quality(koksma.mask("box:size=3", (8, 8)), "box:size=3").error
    True
    """
    array, found = _as_mask("mask", mask, space)
    _doubt("mask", array)
    count = whole("tests", tests, 1, 65536) if tests is not None else 256 if array.shape[2] == 1 else 400
    result = s.MaskQuality()
    call(core().koksma_mask_measure, array.shape[1], array.shape[0], found, _pointer(array), byref(filter_of(filter)), count, byref(result),
         run_at=6, threads=threads)
    return MaskQuality(result.error, result.white, result.inside, result.seam)


def read_mask(path: Union[str, "os.PathLike[str]"], space: Optional[str] = None) -> MaskArray:
    """Reads a mask: .png, .exr, .pfm or .npy. Levels of b bits are read as (k + 1/2) / 2^b of the range of the space.

    Parameters
    ----------
    path : str or path
    space : str
        Default: that of the file's recipe, `path`.json; without one "scalar", "vector2", "vector3" or "vector4", by the channels.

    Returns
    -------
    ndarray of float32 and shape (height, width), or (height, width, numbers)

    Examples
    --------
    >>> import koksma
    >>> koksma.write_mask("m.npy", koksma.mask(size=(8, 8)))
    >>> koksma.read_mask("m.npy").shape
    (8, 8)
    """
    result = s.Mask()
    check(lab().koksma_mask_read(text(path, "path"), None if space is None else _space(space), byref(result)))
    shape = (result.height, result.width, result.space.contents.dim)
    array = np.ctypeslib.as_array(cast(result.values, POINTER(c_float * int(np.prod(shape)))).contents).reshape(shape).copy()
    lab().koksma_mask_fini(byref(result))
    _doubt(os.fsdecode(path), array)
    return _shaped(array)


def write_mask(path: Union[str, "os.PathLike[str]"], mask: npt.ArrayLike, *, space: Optional[str] = None, bits: SupportsIndex = 0) -> None:
    """Writes a mask, whole or not at all.

    Parameters
    ----------
    path : str or path
        Ends in .png, .exr, .npy, .raw (levels or floats alone) or .h (a table of C).
    mask : array_like of shape (height, width) or (height, width, numbers)
    space : str
        Default: "scalar", "vector2", "vector3" or "vector4", by the shape.
    bits : int
        8, 16 or 32 (floats); 0: the default of the ending.

    Examples
    --------
    >>> import koksma
    >>> koksma.write_mask("m.png", koksma.mask(size=(8, 8)), bits=8)
    """
    array, found = _as_mask("mask", mask, space)
    _doubt("mask", array)
    written = s.Mask(array.shape[1], array.shape[0], found, _pointer(array))
    check(lab().koksma_mask_write(text(path, "path"), byref(written), c_int(whole("bits", bits, 0, 32))))
