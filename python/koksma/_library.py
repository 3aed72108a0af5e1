# SPDX-License-Identifier: Apache-2.0
"""Finds and loads the shared libraries; statuses become exceptions; long calls can be interrupted."""
from __future__ import annotations

import ctypes
import os
import re
import secrets
import sys
import warnings
from contextlib import contextmanager
from ctypes import POINTER, addressof, byref, c_bool, c_char_p, c_double, c_float, c_int, c_size_t, c_ubyte, c_uint64, c_void_p
from functools import lru_cache, wraps
from math import inf
from operator import index
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any, Callable, Dict, Hashable, Iterable, Iterator, List, Optional, Sequence, Set, SupportsIndex, Tuple, Type, Union

import numpy as np

from . import _structs as s
from ._signals import Signals

if TYPE_CHECKING:
    Seed = Union[SupportsIndex, np.random.Generator, np.random.RandomState, np.random.SeedSequence, np.random.BitGenerator, None]
else:
    Seed = Any

ABI = 0
_PACE_S = 0.005  # how often a long call runs handlers of signals
_QUICK_S = 0.01  # nobody wants to stop a call that took no longer when it was made before
_MOST_QUOTED = 60  # characters of a wrong value in a message
free = ctypes.CDLL("msvcrt" if os.name == "nt" else None).free  # the library's, by mingw-w64
free.argtypes = [c_void_p]
_SPECS: Dict[Tuple[str, str], s.Spec] = {}
quick: Set[Hashable] = set()  # what was seen to be short: of measures and patterns (text, shape)


class Error(Exception):
    """What the library says: one line that names the thing and the reason. `status` is the koksma_status."""

    status = -1


class ArgumentError(Error, ValueError):
    """An argument is out of its range, a name is unknown, or a pattern can't serve n, dim or its parameters."""


class MissingError(Error, FileNotFoundError):
    """A named file is missing or can't be read."""


class MalformedError(Error, ValueError):
    """A named file, or the plan (a dict) or image (an array) that is given in place of one, is malformed."""


class OutOfMemoryError(Error, MemoryError):
    """The library could not get the memory that a call needs."""


class SystemError(Error, OSError):
    """Writing failed, or the system did."""


class UnsupportedError(Error, NotImplementedError):
    """Left out of this build, or not installed."""


class ForbiddenError(Error, PermissionError):
    """A pattern runs a program or shared library, which only koksma.allow_exec() allows."""


# By the numbers of koksma/status.def, which never change.
_CLASSES = (None, ArgumentError, ArgumentError, ArgumentError, ArgumentError, ArgumentError, MissingError,
            MalformedError, OutOfMemoryError, SystemError, SystemError, UnsupportedError, KeyboardInterrupt,
            ForbiddenError)


def _places(name: str) -> Iterator[str]:
    folder = os.environ.get("KOKSMA_LIBRARY_DIR")
    if folder:
        yield str(Path(folder).absolute() / name)  # with a slash, so that no other folder is searched
        return
    bundled = Path(__file__).resolve().parent / "lib" / name  # of a wheel
    if bundled.exists():
        yield str(bundled)
        return
    for parent in Path(__file__).resolve().parents:  # of an installed package: PREFIX/lib/python3/dist-packages/koksma
        if parent.name.startswith("lib"):
            yield from (str(p) for p in [parent / name, *sorted(parent.glob("*-linux-*/" + name))] if p.exists())
    yield name


def _load(name: str) -> ctypes.CDLL:
    file = {"win32": f"lib{name}.dll", "darwin": f"lib{name}.{ABI}.dylib"}.get(sys.platform, f"lib{name}.so.{ABI}")
    reason = ""
    for place in _places(file):
        try:
            return ctypes.CDLL(place, mode=ctypes.RTLD_GLOBAL)
        except OSError as error:
            reason = str(error)
    raise UnsupportedError(f"{file} is not installed, or KOKSMA_LIBRARY_DIR does not say where it is: {reason}")


def _declare(library: ctypes.CDLL, result: object, name: str, *arguments: object) -> None:
    function = getattr(library, name)
    function.restype = result
    function.argtypes = list(arguments)


@lru_cache(maxsize=None)
def core() -> ctypes.CDLL:
    """libkoksma."""
    library = _load("koksma")
    spec, points, run = POINTER(s.Spec), POINTER(s.Points), POINTER(s.Run)
    for name in ("koksma_error_text", "koksma_version"):
        _declare(library, c_char_p, name)
    _declare(library, c_char_p, "koksma_status_text", c_int)
    _declare(library, c_int, "koksma_pattern_spec", c_char_p, spec)
    _declare(library, c_int, "koksma_measure_spec", c_char_p, spec)
    _declare(library, c_char_p, "koksma_closest_name", c_char_p, s.NameAt, c_void_p)
    _declare(library, None, "koksma_spec_text", spec, c_char_p)
    _declare(library, POINTER(s.Pattern), "koksma_pattern_at", c_size_t)
    _declare(library, POINTER(s.Measure), "koksma_measure_at", c_size_t)
    _declare(library, POINTER(s.Modifier), "koksma_modifier_at", c_size_t)
    _declare(library, c_int, "koksma_generate", spec, c_uint64, run, points)
    _declare(library, c_bool, "koksma_has_ranges", spec)
    _declare(library, c_bool, "koksma_has_one_set", spec)
    _declare(library, c_bool, "koksma_is_unbiased", spec)
    _declare(library, c_bool, "koksma_is_sequence", spec)
    _declare(library, c_double, "koksma_allow_exec", c_double)
    _declare(library, c_int, "koksma_generate_range", spec, c_uint64, c_uint64, c_uint64, run, points)
    _declare(library, c_int, "koksma_generate_whole", spec, c_uint64, run, c_int, points)
    _declare(library, None, "koksma_points_fini", points)
    _declare(library, c_int, "koksma_points_read", c_char_p, points)
    _declare(library, c_size_t, "koksma_points_oddities", points, c_char_p, c_size_t)
    _declare(library, c_int, "koksma_points_write", c_char_p, points, c_char_p, run)
    _declare(library, c_int, "koksma__evaluate_array", spec, c_void_p, c_int, POINTER(s.Value))
    _declare(library, c_int, "koksma__generate_array", spec, c_uint64, c_void_p, c_int)
    _declare(library, c_int, "koksma_evaluate", spec, points, run, POINTER(s.Value))
    _declare(library, c_int, "koksma_generate_sets", spec, c_uint64, c_size_t, run, points)
    _declare(library, c_int, "koksma_evaluate_sets", spec, points, c_size_t, run, POINTER(c_double))
    _declare(library, c_int, "koksma_evaluate_prefixes", spec, points, POINTER(c_size_t), c_size_t, run, POINTER(s.Value))
    _declare(library, c_bool, "koksma_log_line", c_size_t, POINTER(c_double), POINTER(c_double), POINTER(s.Line))
    _declare(library, c_double, "koksma_student_975", c_size_t)
    _declare(library, c_double, "koksma_rate", spec, POINTER(s.Measure), c_int)
    _declare(library, c_double, "koksma_best_rate", POINTER(s.Measure), c_int)
    _declare(library, c_int, "koksma_pair_correlation", points, c_double, c_size_t, run, POINTER(c_double))
    _declare(library, c_void_p, "koksma_warp_find", c_char_p)
    _declare(library, POINTER(s.Named), "koksma_warp_at", c_size_t)
    _declare(library, c_int, "koksma_warp_evaluate", c_void_p, spec, points, run, POINTER(s.Value))
    _declare(library, c_int, "koksma_warp_points", c_void_p, points, points)
    _declare(library, c_int, "koksma_local_discrepancy", points, POINTER(c_double), POINTER(c_double))
    _declare(library, POINTER(s.Record), "koksma_record_at", c_size_t)
    _declare(library, c_int, "koksma_verify", points, run, POINTER(s.Findings))
    _declare(library, c_int, "koksma_verify_sets", points, c_size_t, run, POINTER(s.Findings))
    _declare(library, None, "koksma_findings_fini", POINTER(s.Findings))
    _declare(library, c_int, "koksma_identify", points, run, POINTER(s.Identities))
    _declare(library, c_bool, "koksma_identity_names", POINTER(s.Identity))
    _declare(library, None, "koksma_identities_fini", POINTER(s.Identities))
    _declare(library, c_int, "koksma_optimise", spec, POINTER(s.OptimiseOptions), run, POINTER(s.Optimum))
    _declare(library, c_int, "koksma_radial_power", c_char_p, c_size_t, c_int, run, POINTER(c_double))
    _declare(library, None, "koksma_optimum_fini", POINTER(s.Optimum))
    _declare(library, POINTER(s.Integrand), "koksma_integrand_at", c_size_t)
    _declare(library, c_int, "koksma_integral_open", c_char_p, c_int, POINTER(c_void_p))
    _declare(library, c_int, "koksma_integral_of_function", POINTER(s.Function), c_int, POINTER(c_void_p))
    _declare(library, None, "koksma_integral_close", c_void_p)
    _declare(library, None, "koksma_integral_about", c_void_p, POINTER(s.IntegralFacts))
    options, result = POINTER(s.IntegrationOptions), POINTER(s.Integration)
    _declare(library, c_int, "koksma_integrate", c_void_p, points, run, POINTER(c_double))
    _declare(library, c_int, "koksma_integration_errors", c_void_p, spec, options, run, result)
    _declare(library, c_int, "koksma_integration_summary", c_double, c_double, options, POINTER(c_double), result)
    _declare(library, c_int, "koksma_screen_errors", spec, POINTER(s.ScreenOptions), run, POINTER(s.ScreenRow))
    for name, kind in (("koksma_estimator_at", s.Estimator), ("koksma_interval_at", s.Interval)):
        _declare(library, POINTER(kind), name, c_size_t)
    _declare(library, c_int, "koksma_integral_values", c_void_p, points, run, POINTER(c_double))
    _declare(library, c_int, "koksma_integrate_to", s.ValuesOf, c_void_p, c_int, spec, POINTER(s.ToleranceOptions), run,
             POINTER(s.Tolerance))
    space, kernel = POINTER(s.MaskSpace), POINTER(s.MaskFilter)
    _declare(library, space, "koksma_mask_space_at", c_size_t)
    _declare(library, space, "koksma_mask_space_find", c_char_p)
    _declare(library, c_int, "koksma_mask_filter_check", kernel)
    _declare(library, c_int, "koksma_mask_optimise", POINTER(s.MaskOptions), run, POINTER(c_float), c_void_p)
    _declare(library, c_int, "koksma_mask_measure", c_int, c_int, space, POINTER(c_float), kernel, c_int, run, POINTER(s.MaskQuality))
    spectrum = POINTER(s.Spectrum)
    _declare(library, c_int, "koksma_spectrum_init", spectrum, c_int)
    _declare(library, None, "koksma_spectrum_fini", spectrum)
    _declare(library, c_int, "koksma_spectrum_add", spectrum, points, c_int, run)
    _declare(library, c_double, "koksma_spectrum_power", spectrum, c_int, c_int)
    _declare(library, c_int, "koksma_spectrum_rings", spectrum, POINTER(s.Ring))
    _declare(library, None, "koksma_spectrum_quality", spectrum, POINTER(s.SpectrumQuality))
    return library


@lru_cache(maxsize=None)
def lab() -> ctypes.CDLL:
    """libkoksma-lab: scenes and the renderer."""
    core()
    library = _load("koksma-lab")
    options, image = POINTER(s.RenderOptions), POINTER(s.Image)
    _declare(library, c_char_p, "koksma_scene_name_at", c_size_t)
    _declare(library, c_int, "koksma_scene_open", c_char_p, POINTER(c_void_p))
    _declare(library, c_bool, "koksma_scene_refuse_unknown", c_bool)
    _declare(library, None, "koksma_scene_close", c_void_p)
    _declare(library, c_char_p, "koksma_scene_title", c_void_p)
    _declare(library, c_int, "koksma_scene_set_sky", c_void_p, c_char_p, c_double)
    for name in ("pairing", "scope", "light_selection"):
        _declare(library, c_char_p, f"koksma_{name}_name", c_int)
    for name in ("integrator", "filter"):
        _declare(library, c_void_p, f"koksma_{name}_find", c_char_p)
    for name, kind in (("integrator", s.Named), ("filter", s.Named), ("metric", s.Named), ("adaptive", s.Adaptive)):
        _declare(library, POINTER(kind), f"koksma_{name}_at", c_size_t)
    _declare(library, None, "koksma_render_options_init", options, c_void_p)
    _declare(library, c_int, "koksma_render_patterns", c_char_p, options)
    _declare(library, c_int, "koksma_render", c_void_p, options, POINTER(s.Run), image)
    _declare(library, c_int, "koksma_render_layers", c_void_p, options, POINTER(s.Run), POINTER(s.Layers))
    _declare(library, None, "koksma_layers_fini", POINTER(s.Layers))
    _declare(library, c_int, "koksma_render_replicates", c_void_p, options, c_size_t, POINTER(s.Run), POINTER(s.Replicates))
    _declare(library, None, "koksma_replicates_fini", POINTER(s.Replicates))
    _declare(library, c_int, "koksma_adaptive_parse", c_char_p, POINTER(s.AdaptiveOptions))
    _declare(library, c_int, "koksma_render_adaptive", c_void_p, options, POINTER(s.AdaptiveOptions), POINTER(s.Run),
             POINTER(s.Layers), POINTER(s.AdaptiveReport))
    _declare(library, c_int, "koksma_datasheet", POINTER(s.DatasheetOptions), POINTER(s.Run), POINTER(c_void_p))
    _declare(library, c_int, "koksma_datasheet_page", c_char_p, POINTER(c_void_p))
    _declare(library, c_int, "koksma_rank_patterns", POINTER(s.RankOptions), POINTER(s.Run), POINTER(s.RankRow),
             POINTER(s.Ranking))
    _declare(library, c_int, "koksma_rank_to_error", POINTER(s.RankOptions), c_double, POINTER(s.Run), POINTER(s.TargetRow),
             POINTER(s.TargetRanking))
    _declare(library, s.SceneCounts, "koksma_scene_count", c_void_p)
    for name in ("warning", "unknown"):
        _declare(library, c_bool, f"koksma_scene_{name}", c_void_p, c_size_t, c_char_p, c_size_t)
    _declare(library, c_char_p, "koksma_plan_name_at", c_size_t)
    _declare(library, c_int, "koksma_study_open", POINTER(s.StudyOptions), POINTER(c_void_p))
    _declare(library, c_int, "koksma_study_close", c_void_p)
    _declare(library, c_int, "koksma_study_run", c_void_p, POINTER(s.Run), POINTER(s.StudySummary))
    _declare(library, c_int, "koksma_study_export", c_char_p, c_int, c_char_p)
    _declare(library, c_int, "koksma_study_audit", POINTER(s.AuditOptions), POINTER(s.Run), POINTER(s.Audit))
    _declare(library, c_int, "koksma_study_undone", c_void_p, POINTER(c_size_t), POINTER(c_size_t))
    _declare(library, c_int, "koksma_study_report", c_void_p, POINTER(s.Run))
    _declare(library, c_char_p, "koksma_study_table_at", c_void_p, c_size_t)
    _declare(library, c_char_p, "koksma_study_verdict_name", c_int)
    _declare(library, c_int, "koksma_study_table_row", c_void_p, c_char_p, c_size_t, POINTER(s.StudyRow), POINTER(c_bool))
    data, size = POINTER(POINTER(c_ubyte)), POINTER(c_size_t)
    _declare(library, c_int, "koksma_plot_figure", POINTER(s.Figure), c_int, POINTER(s.Run), data, size)
    _declare(library, c_int, "koksma_plot_colours", POINTER(c_char_p), c_size_t, POINTER(c_size_t))
    _declare(library, c_int, "koksma_plot_format_of", c_char_p, POINTER(c_int))
    _declare(library, c_int, "koksma_plot_write", c_char_p, c_char_p, c_size_t)
    _declare(library, c_int, "koksma_image_init", image, c_int, c_int, c_int)
    _declare(library, None, "koksma_image_fini", image)
    _declare(library, c_int, "koksma_image_read", c_char_p, image)
    _declare(library, c_char_p, "koksma_image_remark")
    _declare(library, c_int, "koksma_image_png_bytes", image, POINTER(POINTER(c_ubyte)), POINTER(c_size_t))
    _declare(library, c_int, "koksma_image_write", c_char_p, image, c_char_p)
    _declare(library, c_int, "koksma_image_compare", image, image, POINTER(s.ImageError))
    _declare(library, c_char_p, "koksma_image_doubt", image, image, c_bool)
    _declare(library, c_int, "koksma_metric_parse", c_char_p, POINTER(s.MetricSpec))
    _declare(library, None, "koksma_metric_text", POINTER(s.MetricSpec), c_char_p)
    _declare(library, c_int, "koksma_metric_evaluate", POINTER(s.MetricSpec), image, image, POINTER(s.MetricValue))
    _declare(library, c_int, "koksma_mask_filter_parse", c_char_p, POINTER(s.MaskFilter))
    _declare(library, c_int, "koksma_mask_read", c_char_p, POINTER(s.MaskSpace), POINTER(s.Mask))
    _declare(library, c_int, "koksma_mask_write", c_char_p, POINTER(s.Mask), c_int)
    _declare(library, None, "koksma_mask_fini", POINTER(s.Mask))
    coherence = POINTER(s.Coherence)
    _declare(library, c_int, "koksma_coherence_init", coherence, c_int, c_int)
    _declare(library, None, "koksma_coherence_fini", coherence)
    _declare(library, c_int, "koksma_coherence_add", coherence, image, image)
    _declare(library, None, "koksma_coherence_find", coherence, POINTER(s.CoherenceValues))
    return library


class _Block:
    """A context manager, which says when it was made but not entered: without a block it has no effect."""

    def __init__(self, call: str, manager: Any) -> None:
        self._call, self._manager, self._entered = call, manager, False

    def __enter__(self) -> None:
        self._entered = True
        self._manager.__enter__()

    def __exit__(self, *error: Any) -> Any:
        return self._manager.__exit__(*error)

    def __del__(self) -> None:
        if not self._entered:
            warn(f"{self._call} has an effect in a block only: with {self._call}:")


def _block(function: Any) -> Any:
    manager = contextmanager(function)

    @wraps(function)
    def made(*values: Any, **named: Any) -> _Block:
        return _Block(f"koksma.{function.__name__}()", manager(*values, **named))
    return made


def warn(message: str, kind: Type[Warning] = UserWarning) -> None:
    """Warns of what looks like a mistake, at the line that called the package."""
    frame, level = sys._getframe(1), 2
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == os.path.dirname(__file__):
        frame, level = frame.f_back, level + 1
    warnings.warn(message, kind, stacklevel=level)


def warn_of_one_set(pattern: str) -> None:
    """A seed has no effect on a pattern with one set."""
    warn(f"{pattern} has one set, whatever the seed; a random modifier, such as shift=1, gives others")


@_block
def allow_exec(seconds: float = 60.0) -> Iterator[None]:
    """Lets the patterns "exec:PROGRAM" and "plugin:LIBRARY" run code in a block, in this thread.

    Parameters
    ----------
    seconds : float
        The longest that a program may take for one set.

    Examples
    --------
    >>> import koksma
    >>> with koksma.allow_exec():  # doctest: +SKIP
    ...     ranking = koksma.rank("ball", ["exec:./mysampler", "sobol"])
    """
    if seconds is None:
        raise TypeError("seconds must be a number, not None")
    before = core().koksma_allow_exec(seconds_of("seconds", seconds))
    try:
        yield
    finally:
        core().koksma_allow_exec(before)


@_block
def refuse_unknown() -> Iterator[None]:
    """Refuses scenes of pbrt and Mitsuba with parts that Koksma does not know in a block, in this thread.

    Without it such parts are replaced by what is nearest; `koksma scene check` names them.

    Examples
    --------
    >>> import koksma
    >>> with koksma.refuse_unknown():  # a scene that ships has no such part
    ...     image = koksma.render("ball", spp=1, size=(4, 3))
    """
    before = lab().koksma_scene_refuse_unknown(True)
    try:
        yield
    finally:
        lab().koksma_scene_refuse_unknown(before)


_OF_PYTHON = (  # what the library says of the program and of C, as this package has it
    (r"'koksma list (\w+)'", r"koksma.\1()"),
    (r"--allow-exec allows that \(koksma_allow_exec in C, koksma.allow_exec in Python\)", "'with koksma.allow_exec():' around the call allows that"),
    (r"^koksma_\w+: ", ""),
    (r"--[a-z-]+ \((\w+)\)", r"\1"),
    (r"^n_(beside)\b", r"\1"),
    (r"^([a-z].*): the number of points is missing$", r"\1: n, the number of points, is missing"),
)


def in_python(message: str) -> str:
    """A line of the library with the names that Python has for things."""
    for pattern, ours in _OF_PYTHON:
        message = re.sub(pattern, ours, message)
    return message


def check(status: int) -> None:
    """Raises what a failed call has to say."""
    if status == 0:
        return
    message = in_python(core().koksma_error_text().decode(errors="replace"))
    kind = _CLASSES[status] if status < len(_CLASSES) else Error
    error = (kind or Error)(message)
    if isinstance(error, Error):
        error.status = status
    raise error


@lru_cache(maxsize=None)
def _paced() -> Any:
    """Called by the library, in C: asks Python once in an interval only, as the library asks far more often."""
    return s.KeepGoing(("koksma__paced", core()))


def call(function: Callable[..., int], *arguments: object, threads: SupportsIndex = 0, time_limit: Optional[float] = None,
         run_at: int, progress: Optional[Callable[[float], object]] = None, short: bool = False,
         same: Optional[Hashable] = None, raised: Optional[List[BaseException]] = None) -> None:
    """Calls a library function that takes a koksma_run as argument `run_at`. What a signal's handler or `progress` raises
    stops it, and comes out: KeyboardInterrupt after Ctrl-C. A short call is over before anybody could want to stop it, and
    does without what that costs: Python runs handlers when it has returned. same: calls with equal ones take about the same
    time, so that one is short if another was. raised: where a callback of the library's keeps what it raises, which likewise
    stops the call and comes out."""
    time_limit = seconds_of("time_limit", time_limit)
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be callable, not {quoted(progress)}")
    threads = whole("threads", threads, 0, s.MAX_INT)
    if (short or same in quick) and time_limit is None and progress is None:
        check(function(*arguments[:run_at], byref(s.Run(threads)), *arguments[run_at:]))
        return _remember(same)
    signals = Signals()
    signals.raised = signals.raised if raised is None else raised

    def keep_going(_context: object, fraction_done: float) -> bool:
        if progress is not None and not signals.raised:
            try:
                progress(fraction_done)
            except BaseException as error:  # noqa: BLE001  no exception passes through C
                signals.raised.append(error)
        return not signals.raised

    asked = s.KeepGoing(keep_going)
    pacing = s.Pacing(asked, None, _PACE_S)
    if progress is None:
        run = s.Run(threads, time_limit or 0.0, _paced(), addressof(pacing))
    else:
        run = s.Run(threads, time_limit or 0.0, asked, None)
    try:
        signals.take()
        started = perf_counter()
        status = function(*arguments[:run_at], byref(run), *arguments[run_at:])
        if status == 0 and perf_counter() - started < _QUICK_S:
            _remember(same)
    finally:
        signals.give_back()
    if signals.raised:  # perhaps at the very end, when the library did not ask any more
        raise signals.raised.pop(0)
    check(status)


def _remember(same: Optional[Hashable]) -> None:
    if same is not None and same not in quick:
        if len(quick) > 4096:
            quick.clear()
        quick.add(same)


def kept_spec(kind: str, name: str) -> Optional[s.Spec]:
    """The spec that `spec` has kept, if it has."""
    return _SPECS.get((kind, name))


def one_line(words: str) -> str:
    """A text without its line breaks: a message is one line."""
    return " ".join(words.split())


def quoted(value: Any) -> str:
    """A value of the caller's as a message has it: its beginning, on one line. NumPy writes arrays on several."""
    try:
        words = one_line(repr(value))
    except Exception:  # noqa: BLE001  of a class of the caller's, or of an int with more digits than Python writes
        words = f"an object of type {type(value).__name__}"
    return words if len(words) <= _MOST_QUOTED else words[:_MOST_QUOTED - 3] + "..."


def whole(name: str, value: SupportsIndex, low: int, high: int) -> int:
    """A whole number within its range, so that it is itself in C: ctypes takes any, modulo 2^32 or 2^64."""
    try:
        number = index(value) if not isinstance(value, bool) else None
    except TypeError:
        number = None
    if number is None:
        raise TypeError(f"{name} must be an int, not {quoted(value)}") from None
    if not low <= number <= high:
        raise ArgumentError(f"{name} must be {low} to {high}, not {quoted(number)}")
    return number


def seed_of(seed: Seed, most: int = s.MAX_SEED) -> int:
    """A seed for the library: an int as it is, of None fresh entropy, of what NumPy draws from, a number drawn."""
    if seed is None:
        return secrets.randbits(62) % (most + 1)  # trials behind it fit
    source: Any = seed
    if hasattr(seed, "__index__"):
        return whole("seed", source, 0, most)
    if type(seed).__module__.startswith("numpy.random"):
        if not hasattr(seed, "random_sample"):
            source = np.random.default_rng(source)
        draw = getattr(source, "integers", None) or source.randint  # a Generator, or a RandomState
        return int(draw(0, min(most, np.iinfo(np.int64).max), dtype=np.int64))
    raise TypeError(f"seed must be an int, not {quoted(seed)}")


def one_of(name: str, value: Any, default: Any, other: str, given: Any) -> Any:
    """The argument that has two names."""
    if given is None:
        return value
    if value != default:
        raise TypeError(f"{name} and {other} are two names of one argument: give one of them")
    return given


def first_seed(seed: Seed, trials: int) -> int:
    """The seed of the first of several sets, whose seeds are consecutive."""
    most = s.MAX_SEED - (trials - 1)
    first = seed_of(seed, s.MAX_SEED)
    if first > most:
        raise ArgumentError(f"seed {first}: {trials} trials end at this seed + {trials - 1}, but seeds end at {s.MAX_SEED}; "
                            f"{most} or less would do")
    return first


def seconds_of(name: str, value: Any) -> Optional[float]:
    """A limit of time, or None."""
    if value is None:
        return None
    if not real(name, value, 0) > 0:
        raise ArgumentError(f"{name} must be more than 0 seconds, not {quoted(value)}")
    return float(value)


def several(name: str, values: Any) -> List[Any]:
    """The items of a sequence."""
    try:
        return list(values)
    except TypeError:
        raise TypeError(f"{name} must be a sequence, not {quoted(values)}") from None


def sizes_of(name: str, values: Any) -> List[int]:
    """Numbers of points, each once: a size given twice would count as two of those that a slope needs."""
    numbers = [whole(name, k, 1, s.MAX_COORDINATES) for k in several(name, values)]
    for i, k in enumerate(numbers):
        if k in numbers[:i]:
            raise ArgumentError(f"{name}: {k} is given twice")
    return numbers


def texts(name: str, values: Iterable[str]) -> List[str]:
    """Several texts. One alone would pass as the list of its letters."""
    if isinstance(values, str):
        raise ArgumentError(f"{name} must be a list of texts, not {quoted(values)}")
    if isinstance(values, dict):
        raise TypeError(f"{name} must be a list of texts, not a dict; a set of one's own is a file, 'file:PATH'")
    found = several(name, values)
    for value in found:
        if not isinstance(value, (str, bytes, os.PathLike)):
            raise TypeError(f"{name} must be a list of texts, not {quoted(values)}")
    return found


def pair(name: str, values: Tuple[SupportsIndex, SupportsIndex]) -> Tuple[SupportsIndex, SupportsIndex]:
    """Width and height."""
    try:
        width, height = values
    except (TypeError, ValueError):
        raise ArgumentError(f"{name} must be (width, height), not {quoted(values)}") from None
    return width, height


def real(name: str, value: Any, least: float = -inf, most: float = inf, nan_too: bool = False) -> float:
    """A number from `least` to `most`; NaN only where that means that it is not known. float() would also take a text,
    a truth value, and of NumPy's complex numbers the real part."""
    kind = getattr(getattr(value, "dtype", None), "kind", "O")
    try:
        number = None if isinstance(value, (str, bytes, bytearray, bool)) or kind not in "uifO" else float(value)
    except (TypeError, ValueError, OverflowError):
        number = None
    if number is None:
        raise TypeError(f"{name} must be a number, not {quoted(value)}")
    if not (least <= number <= most or (nan_too and number != number)):
        bounds = f"at least {least:g}" if most == inf else f"{least:g} to {most:g}"
        raise ArgumentError(f"{name} must be {bounds}, not {quoted(value)}")
    return number


def text(value: Any, name: str = "a name or path") -> bytes:
    """A name or path as the library takes it. name: of the argument, for messages."""
    if not isinstance(value, (str, bytes, os.PathLike)):
        raise TypeError(f"{name} must be a str, not {quoted(value)}")
    try:
        return without_zero(name, os.fsencode(value))
    except UnicodeEncodeError:
        raise ArgumentError(f"{name} must be a text that can be encoded, not {quoted(value)}") from None


def choice(name: str, value: Any, values: Sequence[str]) -> int:
    """The place of an argument among the words that it may be."""
    if not isinstance(value, str) or value not in values:
        raise ArgumentError(f"{name} must be one of {', '.join(values)}, not {quoted(value)}")
    return values.index(value)


def flag(name: str, value: Any) -> bool:
    """True or False, of Python or NumPy, and nothing with a truth value: 'no', -1 and NaN are true in Python."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} must be True or False, not {quoted(value)}")
    return bool(value)


def without_zero(what: str, raw: bytes) -> bytes:
    """A text that C, where a zero ends it, sees whole."""
    if b"\0" in raw:
        raise ArgumentError(f"{what} must not contain a zero character")
    return raw


def spec(kind: str, name: str) -> s.Spec:
    """A parsed spec of a pattern or measure, not to be changed: those without an operand (a file, a program) are kept."""
    kept = _SPECS.get((kind, name)) if type(name) is str else None
    if kept is not None:
        return kept
    result = s.Spec()
    check(getattr(core(), f"koksma_{kind}_spec")(text(name, kind), byref(result)))
    if type(name) is str and not (kind == "pattern" and result.pattern.contents.operand):
        if len(_SPECS) > 512:
            _SPECS.clear()
        _SPECS[kind, name] = result
    return result


def closest(word: str, names: Sequence[str]) -> str:
    """The name that a misspelt word means, as the program finds it; "" if none is like it."""
    kept = [ctypes.create_string_buffer(os.fsencode(name)) for name in names]
    at = s.NameAt(lambda _table, i: addressof(kept[i]) if i < len(kept) else None)
    found = core().koksma_closest_name(word.encode(errors="replace").split(b"\0")[0], at, None)
    return os.fsdecode(found) if found else ""
