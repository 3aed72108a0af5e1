# SPDX-License-Identifier: Apache-2.0
"""Pictures of the library, which notebooks show as SVG: of points, and charts of curves."""
from __future__ import annotations

import ctypes
import os
from ctypes import byref, c_char_p, c_double, c_int, c_size_t, c_ubyte, POINTER
from typing import Any, Callable, List, Optional, Sequence, SupportsIndex, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._library import ArgumentError, call, check, choice, core, flag, free, lab, quoted, real, spec, text, texts, whole
from ._points import as_points, find_warp, view

_FORMATS = ("svg", "pdf", "png")


class Picture:
    """A drawing. A notebook shows it; `save` writes it by the ending of a path; `svg` is its text."""

    def __init__(self, draw: Callable[[int, Any, Any], None]) -> None:
        self._draw = draw

    def bytes(self, format: str = "svg") -> bytes:
        """The file of a format: "svg", "pdf" or "png". Equal pictures have equal bytes."""
        data, size = POINTER(c_ubyte)(), c_size_t()
        self._draw(choice("format", format, _FORMATS), byref(data), byref(size))
        try:
            return ctypes.string_at(data, size.value)
        finally:
            free(data)

    @property
    def svg(self) -> str:
        """The text of the drawing."""
        return self.bytes().decode()

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a .svg, .pdf or .png file, whole or not at all."""
        format = c_int()
        name = text(path, "path")
        check(lab().koksma_plot_format_of(name, byref(format)))
        data = self.bytes(_FORMATS[format.value])
        check(lab().koksma_plot_write(name, data, len(data)))

    def __getattr__(self, name: str) -> Any:
        meant = {"savefig": "; save(path) writes it", "write": "; save(path) writes it", "show": "; a notebook shows it, save(path) writes it"}
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}{meant.get(name, '')}")

    def _repr_svg_(self) -> str:
        return self.svg


def figure_of(rows: "Sequence[Sequence[Union[s.Panel, s.Chart]]]", title: Optional[str], width: float, theme: str,
            kept: Any) -> Picture:
    """A figure of rows of cells; what they point to lives as long as the picture."""
    if real("size", width, nan_too=True) and not 16 <= width <= 32767:
        raise ArgumentError(f"size must be 16 to 32767, or 0 for the size that the picture needs, not {quoted(width)}")
    flat = [(cell, row) for row, cells in enumerate(rows) for cell in cells]
    cells = (s.Cell * len(flat))()
    for i, (cell, row) in enumerate(flat):
        setattr(cells[i], "chart" if isinstance(cell, s.Chart) else "panel", ctypes.pointer(cell))
        cells[i].row = row
    figure = s.Figure(text(title, "title") if title is not None else None, cells, len(flat), width, 0, True,
                      choice("theme", theme, ("light", "dark")) == 1)

    def draw(format: int, data: Any, n: Any, _kept: Any = (cells, kept)) -> None:
        call(lab().koksma_plot_figure, byref(figure), format, data, n, run_at=2)

    return Picture(draw)


def plot(*sets: npt.ArrayLike, witness: Optional[str] = None, columns: SupportsIndex = 0, rows: SupportsIndex = 0,
         captions: Optional[Sequence[str]] = None, size: float = 0, local_discrepancy: bool = False,
         title: Optional[str] = None, titles: Optional[Sequence[str]] = None, theme: str = "light",
         warp: Optional[str] = None) -> Picture:
    """Draws sets of points side by side: points of the plane, or the projections on all pairs of their first 8 axes.

    Parameters
    ----------
    *sets : array_like of shape (n, dim), dim 2 or more
        At most 64.
    witness : str, optional
        A measure: the region where its supremum is reached is drawn, with its value.
    columns, rows : int
        Guide lines.
    titles, captions : sequence of str, optional
        A line above each, such as the pattern, and one below.
    size : float
        Width of the picture in points, or pixels of a PNG; 0: 320 for each square. Sets that are too narrow wrap.
    local_discrepancy : bool
        Colours the background by the discrepancy of the box to each place.
    title : str, optional
        The heading of the picture.
    theme : {"light", "dark"}
    warp : str, optional
        Draws points and guide lines mapped by it; warps() has them all.

    Returns
    -------
    Picture

    Examples
    --------
    >>> import koksma
    >>> picture = koksma.plot(koksma.generate("n-rooks", 16), witness="star", titles=["n-rooks"])
    >>> picture.save("points.svg")
    """
    if len(sets) == 1 and isinstance(sets[0], (list, tuple)) and all(getattr(points, "ndim", 0) == 2 for points in sets[0]):
        sets = tuple(sets[0])
    if not 1 <= len(sets) <= 64:
        raise ArgumentError(f"{len(sets)} sets: give 1 to 64")
    for name, lines in (("captions", captions), ("titles", titles)):
        if lines is not None and len(texts(name, lines)) != len(sets):
            raise ArgumentError(f"{len(lines)} {name} for {len(sets)} sets: give one for each")
    mapped = None if warp is None else find_warp(warp)
    arrays = [as_points(points).copy() for points in sets]  # the caller may change its own before the picture is drawn
    panels = [s.Panel() for _ in arrays]
    kept: List[Any] = []
    for i, (array, panel) in enumerate(zip(arrays, panels)):
        c_points = view(array)
        panel.points = ctypes.pointer(c_points)
        panel.scatter.columns = whole("columns", columns, 0, 65536)
        panel.scatter.rows = whole("rows", rows, 0, 65536)
        panel.scatter.local_discrepancy = flag("local_discrepancy", local_discrepancy)
        panel.scatter.warp = mapped
        caption = captions[i] if captions is not None else ""
        if witness is not None:
            text(witness, "witness")
            value, parsed = s.Value(), spec("measure", witness)
            call(core().koksma_evaluate, byref(parsed), byref(c_points), byref(value), run_at=2)
            if not value.witness.kind:
                raise ArgumentError(f"{witness} has no witness, a region where it reaches its supremum; star, extreme, edge and disk have one")
            panel.scatter.witness = ctypes.pointer(value.witness)
            caption = f"{caption}{', ' if caption else ''}{witness} = {value.value:.4g}"
            kept.append(value)
        if caption:
            panel.caption = text(caption, "captions")
        if titles is not None:
            panel.title = text(titles[i], "titles")
        kept.append((c_points, array))
    return figure_of([panels], title, size, theme, kept)


def colours(patterns: Sequence[str]) -> List[int]:
    """The numbers of the colours that patterns have in all pictures."""
    numbers = (c_size_t * len(patterns))()
    check(lab().koksma_plot_colours((c_char_p * len(patterns))(*(text(p, "pattern") for p in patterns)), len(patterns), numbers))
    return list(numbers)


def convergence_chart(results: Sequence[Any], kept: "list[Any]") -> s.Chart:
    """Of each Convergence, a curve in the colour of its pattern, with the standard errors of the means."""
    one = len({r.measure for r in results}) == 1
    curves = (s.Curve * len(results))()
    for i, (r, colour) in enumerate(zip(results, colours([r.pattern for r in results]))):
        xs, ys, errors = ((c_double * len(r.sizes))(*column) for column in (r.sizes, r.mean, r.standard_error))
        label = r.pattern if one else f"{r.pattern}, {r.measure}"
        curves[i] = s.Curve(f"{label}: slope {r.slope:.2f}".encode(), len(r.sizes), xs, ys, errors if len(r.values) > 1 else None,
                            True, False, colour)
        kept.append((xs, ys, errors))
    kept.append(curves)
    return s.Chart(b"n", results[0].measure.encode() if one else b"value", True, True, curves, len(results))


def chart(x_label: str, y_label: str, curves: Sequence[Tuple[str, npt.ArrayLike, npt.ArrayLike]], level: Optional[float] = None,
          title: Optional[str] = None) -> Picture:
    """A chart of curves (label, xs, ys) on linear axes; level: a dashed line."""
    kept: List[Any] = []
    drawn = (s.Curve * len(curves))()
    for i, (label, xs, ys) in enumerate(curves):
        columns = [np.ascontiguousarray(c, np.float64) for c in (xs, ys)]
        kept.append(columns)
        pointers = [c.ctypes.data_as(POINTER(c_double)) for c in columns]
        drawn[i] = s.Curve(label.encode(), len(columns[0]), *pointers, None, False, False, i)
    kept.append(drawn)
    return figure_of([[s.Chart(x_label.encode(), y_label.encode(), False, False, drawn, len(curves), level is not None,
                             level or 0.0)]], title, 0, "light", kept)


def convergence_figure(results: Sequence[Any], size: float = 0, title: Optional[str] = None, theme: str = "light") -> Picture:
    """What plot_convergence draws."""
    kept: "list[Any]" = []
    chart = convergence_chart(results, kept)
    measures = {r.measure for r in results}
    return figure_of([[chart]], f"Convergence of {measures.pop()}" if title is None and len(measures) == 1 else title, size, theme, kept)
