# SPDX-License-Identifier: Apache-2.0
"""Datasheets: one page that measures one sampler and compares it with others."""
from __future__ import annotations

import ctypes
import json
import os
from ctypes import byref, c_char_p, c_void_p
from typing import Any, Callable, Dict, Optional, Sequence, SupportsIndex, Union

from . import _structs as s
from ._library import ArgumentError, call, check, flag, free, lab, quoted, text, texts


def _owned(pointer: c_void_p) -> str:
    """The text of a pointer that the library allocated, which is freed."""
    try:
        return ctypes.string_at(pointer).decode()
    finally:
        free(pointer)


class Datasheet:
    """What is known about a sampler: `data` as docs/report-format.md has it, `html` the page that shows it."""

    def __init__(self, json_text: str) -> None:
        self._json = json_text
        self.data: Dict[str, Any] = json.loads(json_text)

    @property
    def html(self) -> str:
        """The page, which needs no other file."""
        page = c_void_p()
        check(lab().koksma_datasheet_page(text(self._json), byref(page)))
        return _owned(page)

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a .html page, or the data as .json; whole or not at all."""
        name = os.fsdecode(text(path, "path"))
        if not name.endswith((".html", ".json")):
            raise ArgumentError(f"{name}: the name of a datasheet must end in .html or .json")
        data = (self.html if name.endswith(".html") else self._json).encode()
        check(lab().koksma_plot_write(text(name), data, len(data)))

    def table(self, name: str) -> "list[Dict[str, Any]]":
        """The rows of a table, by the names of its columns."""
        def blocks(content: Any) -> Any:
            for block in content:
                yield block
                yield from blocks(block.get("content", []))
        for block in blocks(self.data["content"]):
            if block["kind"] == "table" and block["name"] == name:
                return [dict(zip([c["name"] for c in block["columns"]], row)) for row in block["rows"]]
        raise ArgumentError(f"no table {quoted(name)} in this datasheet")

    def __repr__(self) -> str:
        return f"<koksma.Datasheet of {self.data['samplers'][0]}>"


def datasheet(sampler: Union[str, "os.PathLike[str]"], beside: Optional[Sequence[str]] = None,
              scenes: Optional[Sequence[str]] = None, metric: str = "mae", quick: bool = False, threads: SupportsIndex = 0,
              progress: Optional[Callable[[float], object]] = None) -> Datasheet:
    """Measures a sampler beside others: errors in scenes, all measures against n, errors of integration, spectra,
    properties, projections.

    Parameters
    ----------
    sampler : str or path
        The spec of a pattern, a file of points, or files such as "my_{n}_{seed}.npy".
    beside : sequence of str, optional
        Up to 7 samplers to compare with; None: random, jittered and sobol:scramble=owen.
    scenes : sequence of str, optional
        Up to 16; None: ball, checker and cornell; empty: none.
    metric : str
        Of the errors in scenes, such as "relmse" or "ldr-flip:ppd=40".
    quick : bool
        Fewer sets, sizes and images.
    threads : int
        0: one for each processor.
    progress : callable, optional
        Called with the fraction that is done.

    Returns
    -------
    Datasheet

    Examples
    --------
    >>> import koksma
    >>> sheet = koksma.datasheet("sobol:scramble=owen", beside=["jittered"], scenes=[], quick=True)
    >>> sheet.table("measures")[0]["best of the others"]
    'jittered'
    """
    options = s.DatasheetOptions(sampler=text(sampler, "sampler"), metric=text(metric, "metric"), quick=flag("quick", quick))
    if beside is not None:
        beside = texts("beside", beside)
        options.beside = (c_char_p * max(len(beside), 1))(*[text(name, "beside") for name in beside])
        options.n_beside = len(beside)
    if scenes is not None:
        scenes = texts("scenes", scenes)
        options.scenes = (c_char_p * max(len(scenes), 1))(*[text(name, "scenes") for name in scenes])
        options.n_scenes = len(scenes)
    found = c_void_p()
    call(lab().koksma_datasheet, byref(options), byref(found), threads=threads, run_at=1, progress=progress)
    return Datasheet(_owned(found))
