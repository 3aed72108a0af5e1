# SPDX-License-Identifier: Apache-2.0
"""Koksma: sampling patterns for ray tracing, exact measures of how irregular they are, and a renderer to try them in.

    >>> import koksma
    >>> points = koksma.generate("n-rooks", 16, seed=7)
    >>> 0 < float(koksma.measure(points, "star")) < 1
    True
    >>> image = koksma.render("ball", "multi-jittered", spp=16)

Points are NumPy arrays of shape (n, dim) over the memory that the library itself fills. Equal arguments give equal
bits, the same as the program's. What fails raises koksma.Error with the library's own line.
"""
import typing as _typing

try:
    import numpy as _numpy  # noqa: F401
except ModuleNotFoundError:
    raise ImportError("koksma needs NumPy: apt install python3-numpy, or pip install numpy") from None

from ._compare import Comparison, MetricValue, compare, metrics
from ._datasheet import Datasheet, datasheet
from ._display import load_ipython_extension, unload_ipython_extension
from ._integrate import Integrand, Integration, integrand, integrands, integrate
from ._library import (ArgumentError, Error, ForbiddenError, MalformedError, MissingError, OutOfMemoryError,
                       SystemError as SystemError, UnsupportedError, allow_exec, refuse_unknown)
from ._mask import MaskQuality, mask, mask_quality, read_mask, write_mask
from ._optimise import Optimum, Record, optimise, radial_power, records
from ._points import (Finding, Identity, Member, Modifier, Named, Value, Witness, canonical, generate, has_ranges, identify, local_discrepancy, measure, measures,
                      modifiers, patterns, read, verify, verify_sets, warp_points, warps, write)
from ._picture import Picture, plot
from ._plot import plot_compare, plot_convergence
from ._rank import Asked, Ranked, Ranking, SizeCheck, Target, rank, rank_to_error
from ._render import (Layers, Replicates, SceneCheck, adaptive, check_scene, filters, integrators, read_image, render, render_replicates, scenes,
                      version, write_image)
from ._screen import ScreenError, screen_errors
from ._series import Convergence, Trials, convergence, trials
from ._spectrum import PairCorrelation, Spectrum, pair_correlation, spectrum
from ._study import Audit, Study, Summary, TableRow, audit, plans
from ._tolerance import Integral, Interval, Step, estimators, intervals

# Without SystemError: `from koksma import *` would put it in the place of Python's own.
__all__ = [
    "ArgumentError", "Asked", "Audit", "Comparison", "Convergence", "Datasheet", "Engine",
    "Error", "Finding", "ForbiddenError", "Identity", "Integral", "Integrand", "Integration",
    "Interval", "Layers", "MalformedError", "MaskQuality", "Member", "MetricValue", "MissingError", "Modifier",
    "Named", "Optimum", "OutOfMemoryError", "PairCorrelation", "Picture", "Ranked", "Ranking", "Record", "Replicates",
    "SceneCheck", "ScreenError", "SizeCheck",
    "Spectrum", "Step", "Study", "Summary", "TableRow", "Target", "Trials", "UnsupportedError", "Value", "Witness",
    "adaptive", "allow_exec", "audit", "canonical", "check_scene", "compare", "convergence", "datasheet",
    "estimators", "filters", "generate", "has_ranges", "identify", "integrand", "integrands", "integrate",
    "integrators", "intervals", "local_discrepancy", "mask", "mask_quality", "measure", "measures", "metrics",
    "modifiers", "optimise", "pair_correlation", "patterns", "plans", "plot", "plot_compare",
    "plot_convergence", "radial_power", "rank", "rank_to_error", "read", "read_image", "read_mask", "records",
    "refuse_unknown", "render", "render_replicates", "scenes", "screen_errors", "spectrum",
    "trials", "verify", "verify_sets", "version", "warp_points", "warps", "write", "write_image",
    "write_mask",
]

if _typing.TYPE_CHECKING:
    from ._engine import Engine

    __version__: str
else:
    class _Written(str):
        """An annotation as it is written: help() shows types, not texts."""

        __repr__ = str.__str__

    def _show_types() -> None:
        for item in list(globals().values()):
            if getattr(item, "__module__", "").startswith("koksma."):
                for function in [item, *vars(item).values()] if isinstance(item, type) else [item]:
                    function = getattr(function, "fget", getattr(function, "__wrapped__", function))
                    if isinstance(getattr(function, "__annotations__", None), dict) and hasattr(function, "__code__"):
                        function.__annotations__ = {k: _Written(str(v).strip("'\"")) for k, v in function.__annotations__.items()}

    _show_types()

    def _with_hints(function: _typing.Any) -> _typing.Any:
        """The function, whose error on an argument that it lacks names the nearest one that it has."""
        import re
        from functools import wraps

        @wraps(function)
        def called(*values: _typing.Any, **named: _typing.Any) -> _typing.Any:
            try:
                return function(*values, **named)
            except (TypeError, ArgumentError) as error:
                from ._hints import hint_of_argument, hint_of_values

                found = re.search(r"^.*got an unexpected keyword argument '(\w+)'", str(error))
                if found and error.__traceback__ is not None and error.__traceback__.tb_next is None:  # not of another call
                    raise TypeError(found[0] + hint_of_argument(found[1], function)) from None
                more = hint_of_values(str(error), function, values) if type(error) in (TypeError, ArgumentError) else ""
                if more and more not in str(error):
                    error.args = (str(error).split("; ")[0] + more, *error.args[1:])
                raise
        return called

    def _hint_at_arguments() -> None:
        import sys
        from types import FunctionType

        hinting = {}  # methods with two names stay one
        for name in __all__:
            item = globals().get(name)
            if isinstance(item, FunctionType):  # in its module, too: pickle looks there
                globals()[name] = _with_hints(item)
                setattr(sys.modules[item.__module__], item.__name__, globals()[name])
            for method, function in list(vars(item).items()) if isinstance(item, type) else ():
                if isinstance(function, FunctionType) and not method.startswith("_"):
                    setattr(item, method, hinting.setdefault(function, _with_hints(function)))

    _hint_at_arguments()

    def __getattr__(name: str) -> object:
        """Engine on first use: its base is a class of scipy, which takes most of a second to import."""
        if name == "Engine":
            from ._engine import Engine

            Engine.__init__ = _with_hints(Engine.__init__)
            globals()[name] = Engine
            return Engine
        if name == "__version__":
            return version()
        from ._hints import hint

        raise AttributeError(f"module {__name__!r} has no attribute {name!r}{'' if name.startswith('_') else hint(name, __all__)}")

    def __dir__() -> "list[str]":
        return sorted({*globals(), *__all__, "__version__"})
