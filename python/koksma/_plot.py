# SPDX-License-Identifier: Apache-2.0
"""Pictures by the library: points, spectra and convergence, shown by notebooks as SVG."""
from __future__ import annotations

import ctypes
import os
from ctypes import byref, c_double, c_int, c_size_t, c_ubyte, c_void_p, POINTER
from typing import Any, Callable, Optional, Sequence, SupportsIndex, Union

import numpy.typing as npt

from . import _structs as s
from ._library import ArgumentError, check, core, lab, spec, text, whole, without_zero
from ._points import as_points, view
from ._series import Convergence

_FORMATS = ("svg", "pdf", "png")
_free = ctypes.CDLL(None).free
_free.argtypes = [c_void_p]


class Picture:
    """A drawing. A notebook shows it; `save` writes it by the ending of a path; `svg` is its text."""

    def __init__(self, draw: Callable[[int, Any, Any], int]) -> None:
        self._draw = draw

    def bytes(self, format: str = "svg") -> bytes:
        """The file of a format: "svg", "pdf" or "png". Equal pictures have equal bytes."""
        if format not in _FORMATS:
            raise ArgumentError(f"format '{format}': it takes {', '.join(_FORMATS)}")
        data, size = POINTER(c_ubyte)(), c_size_t()
        check(self._draw(_FORMATS.index(format), byref(data), byref(size)))
        try:
            return ctypes.string_at(data, size.value)
        finally:
            _free(data)

    @property
    def svg(self) -> str:
        return self.bytes().decode()

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a .svg, .pdf or .png file, whole or not at all."""
        format = c_int()
        name = text(os.fspath(path))
        check(lab().koksma_plot_format_of(name, byref(format)))
        data = self.bytes(_FORMATS[format.value])
        check(lab().koksma_plot_write(name, data, len(data)))

    def _repr_svg_(self) -> str:
        return self.svg


def plot(*sets: npt.ArrayLike, witness: Optional[str] = None, columns: SupportsIndex = 0, rows: SupportsIndex = 0,
         captions: Optional[Sequence[str]] = None, size: float = 0, local_discrepancy: bool = False) -> Picture:
    """Draws the first two coordinates of sets of points, side by side.

    Parameters
    ----------
    *sets : array_like of shape (n, dim), dim 2 or more
        At most 64.
    witness : str, optional
        A measure: the region where its supremum is reached is drawn, with its value.
    columns, rows : int
        Guide lines.
    captions : sequence of str, optional
        A line below each.
    size : float
        Side of a square in points, or pixels of a PNG; 0: 320.
    local_discrepancy : bool
        Colours the background by the discrepancy of the box to each place.

    Returns
    -------
    Picture

    Examples
    --------
    >>> import koksma
    >>> picture = koksma.plot(koksma.generate("n-rooks", 16), witness="star", captions=["n-rooks"])
    >>> picture.save("points.svg")  # doctest: +SKIP
    """
    if not 1 <= len(sets) <= 64:
        raise ArgumentError(f"{len(sets)} sets: it takes 1 to 64")
    if captions is not None and len(captions) != len(sets):
        raise ArgumentError(f"{len(captions)} captions for {len(sets)} sets")
    arrays = [as_points(points) for points in sets]
    panels, kept = (s.Panel * len(arrays))(), []
    for i, array in enumerate(arrays):
        c_points = view(array)
        panel = panels[i]
        panel.points = ctypes.pointer(c_points)
        panel.scatter.columns = whole("columns", columns, 0, 65536)
        panel.scatter.rows = whole("rows", rows, 0, 65536)
        panel.scatter.local_discrepancy = local_discrepancy
        caption = captions[i] if captions is not None else ""
        if witness is not None:
            value, parsed = s.Value(), spec("measure", witness)
            check(core().koksma_evaluate(byref(parsed), byref(c_points), None, byref(value)))
            if not value.witness.kind:
                raise ArgumentError(f"{witness} has no region where it is reached; star, extreme, edge and disk have")
            panel.scatter.witness = ctypes.pointer(value.witness)
            caption = f"{caption}{', ' if caption else ''}{witness} = {value.value:.4g}"
            kept.append(value)
        if caption:
            panel.caption = without_zero("a caption", caption.encode())
        kept.append((c_points, array))

    def draw(format: int, data: Any, n: Any, _kept: Any = kept) -> int:  # the panels' memory lives as long as the picture
        return lab().koksma_plot_panels(panels, len(arrays), size, format, data, n)

    return Picture(draw)


def plot_convergence(*results: Convergence, size: float = 0) -> Picture:
    """Draws measures against the number of points on logarithmic axes, with the standard errors of the means.

    Parameters
    ----------
    *results : Convergence
        Each a curve, named by its pattern; all of one measure, or the measure's name stands beside.
    size : float
        Width in points, or pixels of a PNG; 0: 480.

    Returns
    -------
    Picture
    """
    if not results:
        raise ArgumentError("it takes at least one Convergence")
    one = len({r.measure for r in results}) == 1
    curves, kept = (s.Curve * len(results))(), []
    for i, r in enumerate(results):
        xs, ys, errors = ((c_double * len(r.sizes))(*column) for column in (r.sizes, r.mean, r.standard_error))
        label = r.pattern if one else f"{r.pattern}, {r.measure}"
        curves[i] = s.Curve(f"{label}: {r.slope:.2f}".encode(), len(r.sizes), xs, ys, errors if len(r.values) > 1 else None, True,
                            False, i)
        kept.append((xs, ys, errors))
    chart = s.Chart(b"points", results[0].measure.encode() if one else b"value", True, True, curves, len(results), False, 0, size)

    def draw(format: int, data: Any, n: Any, _kept: Any = kept) -> int:
        return lab().koksma_plot_chart(byref(chart), format, data, n)

    return Picture(draw)
