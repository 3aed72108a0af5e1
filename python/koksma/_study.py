# SPDX-License-Identifier: Apache-2.0
"""Studies: patterns x measures or scenes x trials, kept in a folder, and their report."""
from __future__ import annotations

import csv
import json
import os
import re
import secrets
import tempfile
from ctypes import byref, c_bool, c_char_p, c_size_t, c_void_p
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Sequence, SupportsIndex, Union

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._library import ArgumentError, MalformedError, call, check, flag, lab, one_line, several, text, whole

Plan = Union[str, "os.PathLike[str]", Dict[str, Any]]


@dataclass(frozen=True)
class Summary:
    """What a run did: jobs of it are point sets and renderings; `complete` is False after a time limit."""

    jobs: int
    done_before: int
    done_now: int
    workers: int
    seconds: float
    complete: bool


@dataclass(frozen=True)
class TableRow:
    """A row of a published table beside our numbers. NaN: there is none. `published` is mean, sd and maximum."""

    pattern: str
    label: str
    n: int
    published: tuple[float, float, float]
    mean: float
    interval: tuple[float, float]
    sd: float
    max: float
    trials: int
    verdict: str


@dataclass(frozen=True)
class Audit:
    """What an audit of a study's folder found; true if nothing differs.

    Of `rows`, which the stored plan, the files of now and this version make, `drawn` were drawn by `seed` and made again, and `agree` were
    equal, bit for bit. With 95 % confidence a smaller part of `rows` than `bound` is wrong (Clopper & Pearson 1934); if all
    were drawn, it is the part that differs. `other_rows` are not compared.
    Of `references`, the reference images, all of which are rendered again, `references_agree` were equal, and
    `references_missing` have no file. `differences` is a line for each thing that differs. `rows_missing` rows before the last trials of their
    series are not there: killed runs and failed jobs leave such gaps, as do rows that somebody removed.
    """

    rows: int
    other_rows: int
    seed: int
    drawn: int
    agree: int
    bound: float
    references: int
    references_agree: int
    references_missing: int
    differences: tuple[str, ...]
    rows_missing: int

    def __bool__(self) -> bool:
        return not self.differences


def _json_of(plan: Dict[str, Any]) -> bytes:
    try:
        return json.dumps(plan, indent=1, allow_nan=False).encode()
    except ValueError as error:  # NaN, infinite numbers, and a plan that contains itself
        raise MalformedError(f"plan: {one_line(str(error))}") from None


class Study:
    """A study that is open; also a context manager.

    Parameters
    ----------
    plan : str, path, dict, or a sequence of them
        The name of a plan that ships ("shirley1991"), a JSON file, or the plan itself; studies/README.md lists the
        fields. Relative paths in a plan start at the folder of its file, those of a dict at the present directory.
        An empty sequence, as when left out: the plan that the folder has.
    folder : path, optional
        Where results are kept; created if it does not exist. Without one the plan is only checked.
    trials : int, optional
        Replaces the plan's numbers of trials.
    quick : bool
        Every block's `quick` number of trials, where it has one.

    Raises
    ------
    MalformedError
        The plan is wrong; the text names file, line and field.
    koksma.SystemError
        The folder can't be written, or another run uses it.

    Notes
    -----
    One thread at a time may use a study. Results do not depend on threads or interruptions.

    Examples
    --------
    >>> import koksma
    >>> plan = {"name": "mine", "title": "Mine", "discrepancies": [{"id": "d", "patterns": ["random", "jittered"],
    ...         "measures": ["star"], "n": [16, 64], "trials": 10}]}
    >>> with koksma.Study(plan, "results") as study:
    ...     done = study.run()
    ...     page = study.report()
    ...     rows = study.rows()
    >>> len(rows)
    40
    """

    def __init__(self, plan: Union[Plan, Sequence[Plan]] = (), folder: Union[str, "os.PathLike[str]", None] = None, *,
                 trials: Optional[SupportsIndex] = None, quick: bool = False) -> None:
        self._handle = c_void_p()
        self.folder: Optional[Path] = None if folder is None else Path(os.fsdecode(text(folder, "folder"))).absolute()
        plans = [plan] if isinstance(plan, (str, os.PathLike, dict)) else several("plan", plan)
        names = []
        for one in plans:
            if isinstance(one, (str, bytes)) and not one:
                raise ArgumentError("plan must be a name, a path or a dict, or () for the plan that the folder has, not ''")
            if isinstance(one, dict):
                names.append(_json_of(one))
            else:  # a path is a file, a text may be a name
                names.append(text(os.path.join(os.curdir, one) if isinstance(one, os.PathLike) else one, "plan"))
        options = s.StudyOptions((c_char_p * len(names))(*names), len(names),
                                 None if folder is None else text(folder, "folder"),
                                 0 if trials is None else whole("trials", trials, 1, 100000000), flag("quick", quick))
        try:
            check(lab().koksma_study_open(byref(options), byref(self._handle)))
        except MalformedError as error:
            found = re.match(r"plan '\(text(?: (\d+))?\)': line (\d+): ", str(error))
            which = int(found[1] or 1) - 1 if found else 0
            if not found or which >= len(plans) or not isinstance(plans[which], dict):  # or it is the plan of the folder
                raise
            name = f"plan[{which}]" if len(plans) > 1 else "plan"
            again = MalformedError(f"line {found[2]} of json.dumps({name}, indent=1): {str(error)[found.end():]}")
            again.status = error.status
            raise again from None

    def _open(self) -> c_void_p:
        if not self._handle:
            raise ArgumentError("the study is closed")
        return self._handle

    def run(self, *, threads: SupportsIndex = 0, time_limit: Optional[float] = None,
            progress: Optional[Callable[[float], object]] = None) -> Summary:
        """Runs all jobs that are not done.

        time_limit: in seconds; ends the run early, `complete` is False then. progress: called from time to time with the
        fraction that is done. Ctrl-C keeps what is done. Raises ArgumentError if a pattern found no set for a job (all
        other jobs are done), and MissingError if a family of files ("file:my_{n}_{seed}.npy") has no file: each run counts
        them anew, of a plan with a relative path from the present directory. So it does for each file that a pattern names: a file
        that has changed gets new rows. Which numbers of points a family lacks is found when the study is opened.
        """
        raw = s.StudySummary()
        call(lab().koksma_study_run, self._open(), byref(raw), threads=threads, time_limit=time_limit, run_at=1,
             progress=progress)
        return Summary(raw.jobs, raw.done_before, raw.done_now, raw.workers, raw.seconds, raw.complete)

    def rows(self) -> npt.NDArray[np.void]:
        """All results, sorted by key, as a structured array (pandas.DataFrame takes it); texts are Unicode. Closes the
        study: the folder can be read by one at a time.

        Rows of kind "metric" have the error of an image by the metric in the column `metric`: its `value`, the `robust`
        value without the 0.1 % of the pixels with the largest errors, and their `top_share` of the error. The other columns
        are in studies/README.md; NaN and empty texts: not of this kind."""
        if self.folder is None:
            raise ArgumentError("the study has no folder")
        self.close()
        with tempfile.TemporaryDirectory(prefix="koksma-rows-") as room:
            path = os.path.join(room, "rows.csv")
            check(lab().koksma_study_export(text(os.fspath(self.folder)), 0, text(path)))
            with open(path, encoding="utf-8", newline="") as file:
                names, *lines = csv.reader(file)
        types = dict.fromkeys(("n", "dim", "width", "height", "trial"), "i8") | {"seed": "u8"} | dict.fromkeys(
            names[names.index("value"):names.index("metric")], "f8")
        columns = [np.array([field or "nan" for field in column] if types.get(name) == "f8" else column, types.get(name, "U"))
                   for name, column in zip(names, zip(*lines) if lines else [()] * len(names))]
        rows = np.empty(len(lines), [(name, column.dtype) for name, column in zip(names, columns)])
        for name, column in zip(names, columns):
            rows[name] = column
        return rows

    def report(self) -> Path:
        """Writes report.html and report.json into the folder; returns the path of the first."""
        call(lab().koksma_study_report, self._open(), run_at=1)
        return Path(self.folder or "") / "report.html"

    def undone(self) -> int:
        """The number of jobs whose rows the folder lacks, without those that failed: a run ended before them, or made rows of
        other files, scenes or code. `run` does them."""
        jobs, number = c_size_t(), c_size_t()
        check(lab().koksma_study_undone(self._open(), byref(jobs), byref(number)))
        return number.value

    def tables(self) -> List[str]:
        """The ids of the plan's published tables, such as "5.1"."""
        ids: List[str] = []
        while lab().koksma_study_table_at(self._open(), len(ids)):
            ids.append(lab().koksma_study_table_at(self._open(), len(ids)).decode())
        return ids

    def table(self, id: str) -> List[TableRow]:
        """A published table beside our numbers."""
        rows: List[TableRow] = []
        raw, found = s.StudyRow(), c_bool()
        while True:
            check(lab().koksma_study_table_row(self._open(), text(id, "id"), len(rows), byref(raw), byref(found)))
            if not found.value:
                return rows
            rows.append(TableRow(raw.pattern.decode(), raw.label.decode(), raw.n, tuple(raw.published), raw.mean,
                                 (raw.low, raw.high), raw.sd, raw.max, raw.trials,
                                 lab().koksma_study_verdict_name(raw.verdict).decode()))

    def close(self) -> None:
        """Writes what is not yet on disk, and frees the study."""
        handle, self._handle = self._handle, c_void_p()
        if handle:
            check(lab().koksma_study_close(handle))

    def __enter__(self) -> "Study":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self) -> None:
        try:
            self.close()
        except Exception:  # noqa: BLE001  nobody is there to be told
            pass


def audit(folder: Union[str, "os.PathLike[str]"], rows: Optional[SupportsIndex] = 200, *,
          seed: Optional[SupportsIndex] = None, threads: SupportsIndex = 0,
          progress: Optional[Callable[[float], object]] = None) -> Audit:
    """Makes rows of a study again by its stored plan, and all its reference images, and compares them bit for bit.

    Parameters
    ----------
    folder : path
        A study's folder, which is only read. No run may use it meanwhile; close a `Study` first.
    rows : int or None
        How many rows are drawn at random; None: all.
    seed : int or None
        Of the draw. The rows that are drawn depend on it and the folder alone, so that the result's `seed` repeats a draw.
        None: 64 random bits from the operating system. The bound holds only if nobody who could change the rows knew it.
    threads, progress
        As in `Study.run`. Ctrl-C ends the audit without a result.

    Returns
    -------
    Audit
        True if nothing differs. What differs is no error.

    Raises
    ------
    MissingError, MalformedError
        The folder has no results of a study, or they are damaged beyond reading.

    Examples
    --------
    >>> import koksma
    >>> plan = {"name": "mine", "title": "Mine", "discrepancies": [{"id": "d", "patterns": ["random"],
    ...         "measures": ["star"], "n": [16], "trials": 10}]}
    >>> with koksma.Study(plan, "audited") as study:
    ...     done = study.run()
    >>> found = koksma.audit("audited")
    >>> bool(found), found.agree == found.drawn
    (True, True)
    """
    lines: List[str] = []
    differs = s.Differs(lambda _context, line: lines.append(line.decode(errors="replace")))
    used = secrets.randbits(64) if seed is None else whole("seed", seed, 0, s.MAX_SEED)
    options = s.AuditOptions(text(folder, "folder"), 0 if rows is None else whole("rows", rows, 1, (1 << 63) - 1),
                             used, differs, None)
    raw = s.Audit()
    call(lab().koksma_study_audit, byref(options), byref(raw), threads=threads, run_at=1, progress=progress)
    return Audit(raw.rows, raw.other_rows, used, raw.drawn, raw.agree, raw.bound, raw.references, raw.references_agree,
                 raw.references_missing, tuple(lines), raw.rows_missing)


def plans() -> List[str]:
    """The names of the plans that ship.

    Returns
    -------
    list of str

    Examples
    --------
    >>> import koksma
    >>> "shirley1991" in koksma.plans()
    True
    """
    names: List[str] = []
    while lab().koksma_plan_name_at(len(names)):
        names.append(lab().koksma_plan_name_at(len(names)).decode())
    return names
