# SPDX-License-Identifier: Apache-2.0
"""What a notebook shows of arrays: points as the library's own SVG, images as PNG.

Results have `_repr_html_` or `_repr_svg_`, which notebooks call by themselves. Points and images are plain arrays of NumPy,
whose display belongs to NumPy: `%load_ext koksma` in a notebook adds pictures for the arrays that look like either.
"""
from __future__ import annotations

import ctypes
from ctypes import POINTER, byref, c_size_t, c_ubyte
from typing import Any

import numpy as np
import numpy.typing as npt

from ._compare import as_image, view_image
from ._library import check, free, lab
from ._picture import plot

MOST_POINTS = 1 << 16  # of an array that is shown as points
MOST_PIXELS = 1 << 22  # of one that is shown as an image


def png(image: npt.ArrayLike) -> bytes:
    """An image of linear light as the bytes of a PNG file, encoded as sRGB."""
    array = as_image(image)  # a copy, perhaps, which the name keeps
    view, data, size = view_image(array), POINTER(c_ubyte)(), c_size_t()
    check(lab().koksma_image_png_bytes(byref(view), byref(data), byref(size)))
    try:
        return ctypes.string_at(data, size.value)
    finally:
        free(data)


def looks_like_points(array: Any) -> bool:
    """Float64 in [0,1], of shape (n, d) with 2 <= d <= 16 and no more columns than rows."""
    return (isinstance(array, np.ndarray) and array.dtype == np.float64 and array.ndim == 2 and 2 <= array.shape[1] <= 16
            and array.shape[1] <= len(array) <= MOST_POINTS and bool(((array >= 0) & (array <= 1)).all()))


def looks_like_an_image(array: Any) -> bool:
    """Float32, as koksma.render makes it: of shape (height, width, 3), finite."""
    return (isinstance(array, np.ndarray) and array.dtype == np.float32 and array.ndim == 3 and array.shape[2] in (1, 3)
            and 0 < array.size <= MOST_PIXELS and bool(np.isfinite(array).all()))


def load_ipython_extension(shell: Any) -> None:
    """`%load_ext koksma`: arrays that look like points are shown as SVG, those that look like images as PNG."""
    formatters = shell.display_formatter.formatters
    formatters["image/svg+xml"].for_type(np.ndarray, lambda a: plot(a).svg if looks_like_points(a) else None)
    formatters["image/png"].for_type(np.ndarray, lambda a: png(a) if looks_like_an_image(a) else None)


def unload_ipython_extension(shell: Any) -> None:
    """`%unload_ext koksma`: as NumPy shows them."""
    for kind in ("image/svg+xml", "image/png"):
        shell.display_formatter.formatters[kind].pop(np.ndarray, None)
