# SPDX-License-Identifier: Apache-2.0
"""Rankings of patterns for a scene."""
from __future__ import annotations

import math
import os
from ctypes import byref, c_char_p, memmove, pointer
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Optional, Sequence, SupportsIndex, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._compare import as_image, _metric, view_image
from ._frame import Framed, columns_of, number, table
from ._library import (ArgumentError, Seed, call, flag, in_python, lab, pair, quoted, real, seconds_of, seed_of, text, texts,
                       warn, whole)
from ._points import canonical
from ._render import _found, _scene_name, check_scene

MODERN = ("sobol:scramble=owen", "pmj02", "correlated-multi-jittered", "multi-jittered", "n-rooks", "jittered", "random")
THESIS = ("n-rooks", "jittered", "half-jittered", "poisson-disk:d=0.2", "poisson-disk:d=0.1", "regular", "random")

_LISTS = {"modern": MODERN, "thesis": THESIS}
_STATES = ("ranked", "too-slow", "refused")
_DECISIONS = ("undecided", "best", "equal", "worse")
_TARGETS = ("checked", "extrapolated", "unknown", "refused")
_CHECKS = ("unchecked", "confirmed", "overturned", "unsettled", "failed")


@dataclass(frozen=True)
class Ranked:
    """A pattern of a ranking. Intervals (low, high) hold together for all patterns with 95 %; (NaN, NaN): none."""
    pattern: str
    position: Optional[int]  #: 1 + the number of patterns that are decided to leave less error; None: not ranked
    state: str  #: ranked, too-slow or refused
    decision: str  #: best, equal (to the first, within 2 %), worse or undecided
    trials: int
    error: float
    interval: Tuple[float, float]
    behind: float  #: relative difference to the error of the first
    behind_interval: Tuple[float, float]
    reason: str  #: why it is not ranked
    coherence: float  #: of the error of its first 8 trials, as koksma.compare has it; NaN: they are not all there
    coherence_interval: Tuple[float, float]  #: of the mean over the trials, at the peak's frequency
    coherence_noise: float  #: 97.5 % of white-noise errors have less
    coherence_p: float
    coherent: bool  #: the error has bands or another pattern
    robust: float  #: the error without the 0.1 % of the pixels with the largest, not corrected for the error of the reference
    top_share: float  #: the share of the error that these carry; from 0.5 on the order is that of few pixels
    unbiased: Optional[bool] = None  #: False: its error may be partly bias, the same in every trial; None: of another renderer


@dataclass(frozen=True)
class FirstPlace:
    """Whether the pattern with the least error, in bands or not, leaves the least at another size, too."""
    state: str  #: unchecked, confirmed, overturned (by `best`), unsettled or failed (no pictures of this size)
    best: Optional[str]
    behind: float  #: overturned: of the first pattern of the ranking against `best`
    behind_interval: Tuple[float, float]
    coherent: bool  #: confirmed, overturned: the error of what leaves the least there


@dataclass(frozen=True)
class SizeCheck:
    """The advised pattern at half or twice the size, among the first whose error is not coherent (among all, if all are)."""
    size: Tuple[int, int]
    state: str  #: unchecked, confirmed, overturned (by `best`), unsettled or failed (no pictures of this size)
    best: Optional[str]
    behind: float  #: overturned: of the checked pattern against `best`
    behind_interval: Tuple[float, float]
    trials: int
    coherent: bool  #: confirmed, overturned: the error of what is the best there is
    first: FirstPlace


@dataclass(frozen=True)
class Ranking(Framed):
    """What koksma.rank returns: rows[0] is the best pattern if `settled`."""
    rows: List[Ranked]
    settled: bool
    complete: bool  #: every pair is decided
    cut_short: bool  #: by the time limit
    trials: int
    needed_trials: Optional[int]  #: not settled: about so many trials of a pattern would decide; None: not known
    needed_seconds: Optional[float]
    size: Tuple[int, int]
    reference_error: float  #: of the last reference; NaN: it was given
    checks: Tuple[SizeCheck, ...]
    seconds: float
    advised: Optional[str]  #: decided to leave the least of those whose error is not coherent; None: undecided, or no such
    metric: str  #: what error is
    undecidable: bool  #: by 256 trials or more, 65,536 would not decide either: a noisy reference, or a small difference
    use: str  #: `advised`; else, of those that are not coherent (of all, if all are), the least `within`, if below .05, or error
    within: float  #: the error of `use` exceeds that of any other by at most this part of it (95 %); infinite: not known
    without_few: bool  #: `use` and `within` are of the errors without the 0.1 % of pixels that err most, since all leave it open
    spp: int
    random_spp: float  #: so many samples of the pattern random leave as much error as those of `use`; NaN: random is not ranked
    random_spp_interval: Tuple[float, float]

    @property
    def best(self) -> Optional[str]:
        """The pattern with the least error, in bands or not; None while it is undecided. What to use is `advised`."""
        return self.rows[0].pattern if self.settled else None

    def _advice(self) -> str:
        if len(self.rows) == 1:
            return f"{self.use} is alone: there is nothing to rank it against"
        if self.advised:
            return f"use {self.advised}"
        return f"use {self.use}, within {100 * self.within:.2g} % of the best{' but for few pixels' * self.without_few}" if self.within <= 0.05 else "undecided"

    def _columns(self) -> Dict[str, Any]:
        return columns_of(self.rows)

    def __repr__(self) -> str:
        width = max(len(r.pattern) for r in self.rows)
        lines = [f"Ranking({self.size[0]} x {self.size[1]} pixels, {self.metric}, "
                 f"{self._advice()}; place, pattern, error, interval)"]
        for r in self.rows:
            error = f"{number(r.error)} ({number(r.interval[0], 3)} to {number(r.interval[1], 3)})" if r.position else r.reason or r.state
            lines.append(f"{r.position or '-':>4}  {r.pattern:{width}}  {error}{', bands' * r.coherent}{', not unbiased' * (r.unbiased is False)}")
        if not math.isnan(self.random_spp) and self.use != "random":
            lines.append(f"{self.spp} samples of {self.use} are as good as {self.random_spp:.0f} random samples "
                         f"({self.random_spp_interval[0]:.0f} to {self.random_spp_interval[1]:.0f})")
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        return table(("position", "pattern", f"error ({self.metric})", "interval", "behind the first", "images", "error is"),
                     [(r.position if r.position else r.reason or r.state, r.pattern, r.error,
                       " to ".join(map(number, r.interval)), "" if math.isnan(r.behind) else f"{100 * r.behind:.3g} %", r.trials,
                       ("bands" if r.coherent else "noise") + ", perhaps bias" * (r.unbiased is False)) for r in self.rows],
                     f"{self._advice()} ({self.size[0]} x {self.size[1]} pixels; intervals hold together with 95 %)")


@dataclass(frozen=True)
class Target:
    """How many samples of a pattern leave an error, as koksma.rank_to_error finds it; NaN: not known."""
    pattern: str
    spp: Optional[int]  #: samples a pixel, checked by images of fresh seeds; None: the target was not reached
    error: float  #: their mean error; without spp that of the largest number that was measured
    interval: Tuple[float, float]  #: of the error, 95 %
    needed: float  #: samples at which the mean error is the target, by the rate
    needed_interval: Tuple[float, float]  #: from that of the error, or of the rate where state is extrapolated
    rate: float  #: slope of log error against log samples
    rate_error: float  #: its standard error
    state: str  #: checked, extrapolated (by the rate), unknown or refused
    coherent: bool  #: the error has bands or another pattern
    trials: int  #: images
    reason: str  #: why it is refused


@dataclass(frozen=True)
class Asked:
    """A picture that a ranking asks of another renderer."""
    scene: str
    pattern: str
    spp: int
    size: Optional[Tuple[int, int]]  #: width, height; None: the renderer's own, which the ranking asks for by a first picture
    seed: int  #: 0 to 2**31 - 1; pictures of different seeds are independent, those of equal seeds are equal


class _Renderer:
    """Another renderer as the library calls it. No exception passes through C: a ValueError takes its pattern out of the
    ranking, any other exception ends it."""

    _ARGUMENT, _SYSTEM = 1, 10  # KOKSMA_ARGUMENT, KOKSMA_SYSTEM

    def __init__(self, renderer: Optional[Callable[[Asked], npt.ArrayLike]],
                 process: Optional[Callable[[npt.NDArray[np.float32]], npt.ArrayLike]] = None) -> None:
        self.renderer, self.process = renderer, process
        self.raised: List[BaseException] = []
        self.reasons: Dict[str, str] = {}
        self.callback = s.RankRenderer(self._render if renderer is not None else 0)
        self.processed = s.RankProcess(self._process if process is not None else 0)

    def _render(self, _context: Any, picture: Any, _run: Any, image: Any) -> int:
        p = picture.contents
        asked = Asked(os.fsdecode(p.scene), os.fsdecode(p.pattern), p.spp, (p.width, p.height) if p.width else None, p.seed)
        try:
            assert self.renderer is not None
            status = self._put(self.renderer(asked), image)
            if status == 0:
                self.reasons.pop(asked.pattern, None)  # that of a picture that only asked for the size
            return status
        except ValueError as error:
            self.reasons.setdefault(asked.pattern, str(error))
            return self._ARGUMENT
        except BaseException as error:  # noqa: BLE001
            self.raised.append(error)
            return self._SYSTEM

    def _process(self, _context: Any, image: Any, _run: Any, out: Any) -> int:
        try:
            assert self.process is not None
            given = image.contents
            pixels = np.ctypeslib.as_array(given.pixels, (given.height, given.width, given.channels)).copy()
            return self._put(self.process(pixels), out)
        except BaseException as error:  # noqa: BLE001
            self.raised.append(ArgumentError(f"process: {error}") if type(error) is ArgumentError else error)
            return self._SYSTEM

    @staticmethod
    def _put(given: npt.ArrayLike, image: Any) -> int:
        pixels = as_image(given)
        height, width, channels = pixels.shape
        status = lab().koksma_image_init(image, width, height, channels)
        if status == 0:
            memmove(image.contents.pixels, pixels.ctypes.data, pixels.nbytes)
        return int(status)


class _Request:
    """The options of a ranking for the library, with all that they point to."""

    def __init__(self, scene: Union[str, "os.PathLike[str]"], patterns: Union[str, Sequence[str]], spp: SupportsIndex,
                 size: Optional[Tuple[SupportsIndex, SupportsIndex]], integrator: Optional[str], filter: Optional[str],
                 adaptive: Optional[str], metric: str, time_limit: Optional[float],
                 renderer: Optional[Callable[[Asked], npt.ArrayLike]], reference: Union[str, npt.ArrayLike, None], seed: Seed,
                 depth: Optional[SupportsIndex], lights: Optional[str], scope: Optional[str],
                 process: Optional[Callable[[npt.NDArray[np.float32]], npt.ArrayLike]]) -> None:
        if renderer is None and isinstance(reference, str):
            raise ArgumentError("a pattern as reference has an effect only with renderer: Koksma's own references are of sobol:scramble=owen")
        settings = {"scope": scope, "lights": lights, "depth": None if depth is None else whole("depth", depth, 0, s.MAX_DEPTH)}
        variant = ";".join(f"{name}={word}" for name, word in settings.items() if word is not None)
        if renderer is not None and variant:
            raise ArgumentError(f"{variant.split('=')[0]} has no effect with renderer, which reads the scene and makes the images")
        time_limit = seconds_of("time_limit", time_limit)
        if renderer is not None and not callable(renderer):
            raise TypeError(f"renderer must be callable, not {quoted(renderer)}")
        if process is not None and not callable(process):
            raise TypeError(f"process must be callable, not {quoted(process)}")
        self.other = _Renderer(renderer, process) if renderer is not None else None
        lists = [_LISTS.get(pattern, (pattern,)) for pattern in texts("patterns", [patterns] if isinstance(patterns, str) and patterns in _LISTS else patterns)]
        self.names = [canonical(pattern) if self.other is None else pattern for members in lists for pattern in members]
        if max(map(len, lists), default=0) > 1:  # a list may hold what is named, too
            self.names = list(dict.fromkeys(self.names))
        if not self.names or len(set(self.names)) < len(self.names):
            raise ArgumentError("patterns must be one or more, each once")
        self.spec, self.metric = _metric(metric)
        self.array = (c_char_p * len(self.names))(*[text(name, "patterns") for name in self.names])
        self.options = options = s.RankOptions(
            scene=text(_scene_name(scene), "scene"), patterns=self.array, n_patterns=len(self.names), time_limit_s=time_limit or 0.0,
            spp=whole("spp", spp, 1, s.MAX_SPP), integrator=None if integrator is None else _found("integrator", integrator),
            filter=_found("filter", "box" if filter is None else filter), metric=pointer(self.spec),
            adaptive=None if adaptive is None else text(adaptive, "adaptive"), seed=seed_of(seed),
            variant=text(variant, "scope") if variant else None)
        if size is not None:
            width, height = pair("size", size)
            options.width = whole("width", width, 1, s.MAX_IMAGE_SIDE)
            options.height = whole("height", height, 1, s.MAX_IMAGE_SIDE)
        if reference is not None and not isinstance(reference, str):
            self.pixels = as_image(reference)
            self.exact = view_image(self.pixels)
            options.reference_image = pointer(self.exact)
            if size is None and self.other is None:
                options.height, options.width = self.pixels.shape[:2]
        if self.other is not None:
            options.render = self.other.callback
            options.reference = text(reference, "reference") if isinstance(reference, str) else None
        doubts: List[str] = []
        self.doubts = doubts
        self.doubted = options.doubt = s.RankDoubt(lambda _context, line: doubts.append(line.decode(errors="replace")))
        self.calls = self.other if self.other is not None or process is None else _Renderer(None, process)
        if self.calls is not None and process is not None:
            options.process = self.calls.processed

    @property
    def reasons(self) -> Dict[str, str]:
        return {} if self.other is None else self.other.reasons

    def call(self, function: Any, *arguments: Any, threads: SupportsIndex, run_at: int) -> None:
        """Calls a function of the library; what a callable raised is raised again."""
        try:
            call(function, *arguments, threads=threads or (1 if self.calls is not None else 0), run_at=run_at)
        except Exception as error:
            if self.calls is not None and self.calls.raised:
                raise self.calls.raised[0] from None
            if self.reasons and isinstance(error, ArgumentError):  # the reference's pattern is left out
                pattern, reason = next(iter(self.reasons.items()))
                raise ArgumentError(f"renderer: {pattern}: {reason}") from None
            raise
        for doubt in self.doubts:
            warn(doubt)


def rank(scene: Union[str, "os.PathLike[str]"], patterns: Union[str, Sequence[str]] = "modern", spp: Optional[SupportsIndex] = None, *,
         size: Optional[Tuple[SupportsIndex, SupportsIndex]] = None, integrator: Optional[str] = None,
         filter: Optional[str] = None, adaptive: Optional[str] = None, metric: str = "mae", time_limit: Optional[float] = 60, max_trials: SupportsIndex = 4096,
         one_size: bool = False, threads: SupportsIndex = 0, renderer: Optional[Callable[[Asked], npt.ArrayLike]] = None,
         reference: Union[str, npt.ArrayLike, None] = None, seed: Seed = 0, depth: Optional[SupportsIndex] = None,
         lights: Optional[str] = None, scope: Optional[str] = None,
         process: Optional[Callable[[npt.NDArray[np.float32]], npt.ArrayLike]] = None) -> Ranking:
    """Ranks patterns by the error of the pictures that they make of a scene, as `koksma rank` does.

    Parameters
    ----------
    scene : str or path
        As of `render`.
    patterns : "modern", "thesis" or sequence of str, these among them
        Each once. "modern", the default: those that the project's own studies put first, and plainer ones to compare with;
        "thesis": the seven of Shirley 1991. One that has no set of spp points is not ranked (`reason` of its row);
        one whose file is missing or malformed, or whose program may not run, raises.
    spp : int, optional
        Samples a pixel. Left out, as many as the scene's own sampler takes (`check_scene`), 64 at most, or 16 where `paths` is 1; else 16.
    size : (width, height), optional
        Without it the scene's own, halved until it has 19,200 pixels at most.
    integrator, filter : str, optional
        As of `render`; left out, distribution, or path where `check_scene` says so (`paths`).
    adaptive : str, optional
        A method of adaptive sampling, which renders the pictures of all patterns with a budget of spp samples a pixel and a quarter
        of it in the first round (koksma.adaptive() names them). One that places its own samples takes one pattern.
    metric : str
        Of the error; mae is the mean absolute error in luminance (koksma.metrics() names them).
    time_limit : float or None
        Seconds, None for none; it cuts the work short and changes nothing else, so that a longer one names the same best
        pattern, or one where there was none.
    max_trials : int
        Images of a pattern, at most.
    one_size : bool
        Leave out the checks at half and twice the size.
    threads : int
    renderer : callable, optional
        Another renderer, a function of an Asked that returns linear light as koksma.compare takes it;
        koksma.mitsuba.Renderer is one of Mitsuba 3. Scene and patterns are then any texts that it knows, and it is called on
        one thread unless `threads` says more. Without size, the pictures' own is taken, and other sizes are not checked. A
        ValueError of the renderer leaves its pattern out of the ranking, another exception ends it.
    reference : array of pixels or str, optional
        A finished reference, taken as exact: an array of linear light as koksma.compare takes it, of the size of the images; no
        other sizes are checked then. As a str with renderer, the pattern of the reference (the first one when left out): the mean of 16 pictures of spp samples a pixel,
        at least 16, later of 4 and of 16 times as many, which must depend on the seed.
    seed : int
        Rankings with different seeds are independent.
    depth, lights, scope : optional
        As of `render`, but all lights get a shadow ray when lights is left out. Not with renderer.
    process : callable, optional
        Processes the images of the patterns, but not the reference, as a denoiser does: a function of an array of shape
        (height, width, channels) that returns one of this size. It is called on one thread unless `threads` says more; its
        exceptions end the ranking.

    Returns
    -------
    Ranking

    Examples
    --------
    >>> import koksma
    >>> ranking = koksma.rank("ball", ["random", "jittered"], 16, size=(32, 24), one_size=True)
    >>> ranking.best
    'jittered'
    """
    if renderer is None and spp is None:
        found = check_scene(scene)
        spp = min(found.spp or 16, 16 if found.paths else 64)
    asked = _Request(scene, patterns, 16 if spp is None else spp, size, integrator, filter, adaptive, metric, time_limit, renderer, reference, seed, depth, lights,
                     scope, process)
    asked.options.one_size = flag("one_size", one_size)
    asked.options.max_trials = whole("max_trials", max_trials, 8, s.MAX_RANK_TRIALS)
    names, options, out = asked.names, asked.options, s.Ranking()
    rows = (s.RankRow * len(names))()
    asked.call(lab().koksma_rank_patterns, byref(options), rows, byref(out), threads=threads, run_at=1)
    reasons, other = asked.reasons, renderer
    undecided = not out.settled
    return Ranking(
        rows=[Ranked(names[r.pattern], r.position or None, _STATES[r.state], _DECISIONS[r.decision], r.trials, r.mean,
                     (r.low, r.high), r.behind, (r.behind_low, r.behind_high),
                     reasons.get(names[int(r.pattern)], in_python(r.reason.decode(errors="replace"))),
                     r.coherence.coherence, (r.coherence.low, r.coherence.high), r.coherence.noise_high,
                     r.coherence.p, r.coherence.coherent, r.robust, r.top_share,
                     None if other is not None else not r.biased)
              for r in rows],
        settled=out.settled, complete=out.complete, cut_short=out.cut_short, trials=out.trials,
        needed_trials=out.needed_trials or None if undecided else None,
        needed_seconds=out.needed_s or None if undecided else None, size=(out.width, out.height),
        reference_error=out.reference_error, seconds=out.seconds,
        advised=names[rows[out.advised_row].pattern] if out.advised else None,
        checks=tuple(_check(c, names) for c in out.checks), metric=asked.metric,
        undecidable=out.undecidable, use=names[rows[out.use_row].pattern], within=out.within, without_few=out.without_few, spp=int(options.spp), random_spp=out.random_spp,
        random_spp_interval=(out.random_spp_low, out.random_spp_high))


def rank_to_error(scene: Union[str, "os.PathLike[str]"], target_error: float, patterns: Union[str, Sequence[str]] = "modern", *,
                  size: Optional[Tuple[SupportsIndex, SupportsIndex]] = None, integrator: Optional[str] = None,
                  filter: Optional[str] = None, adaptive: Optional[str] = None, metric: str = "mae", time_limit: Optional[float] = 60,
                  threads: SupportsIndex = 0, renderer: Optional[Callable[[Asked], npt.ArrayLike]] = None,
                  reference: Union[str, npt.ArrayLike, None] = None, seed: Seed = 0, depth: Optional[SupportsIndex] = None,
                  lights: Optional[str] = None, scope: Optional[str] = None,
                  process: Optional[Callable[[npt.NDArray[np.float32]], npt.ArrayLike]] = None) -> List[Target]:
    """How many samples a pixel of each pattern leave an error in a scene, as `koksma rank --target-error` finds it.

    The errors of 1, 4, 16, ... samples are measured by 8 images each until one is at most the target; the number is narrowed by
    the power law of the errors, and checked by 8 images of fresh seeds.

    Parameters
    ----------
    scene, patterns, size, integrator, filter, adaptive, metric, threads, renderer, reference, seed, depth, lights, scope, process
        As of `rank`.
    target_error : float
        The mean of `metric` over images, above 0.
    time_limit : float or None
        Seconds, None for none. It ends the work; what is not reached then is extrapolated by the rate of the errors.

    Returns
    -------
    list of Target
        Fewest samples first.

    Examples
    --------
    >>> import koksma
    >>> first, last = koksma.rank_to_error("ball", 0.02, ["random", "jittered"], size=(32, 24))
    >>> first.pattern, last.pattern
    ('jittered', 'random')
    """
    asked = _Request(scene, patterns, 1, size, integrator, filter, adaptive, metric, time_limit, renderer, reference, seed, depth, lights,
                     scope, process)
    rows, out = (s.TargetRow * len(asked.names))(), s.TargetRanking()
    asked.call(lab().koksma_rank_to_error, byref(asked.options), real("target_error", target_error), rows, byref(out), threads=threads,
               run_at=2)
    return [Target(asked.names[r.pattern], r.spp or None, r.error, (r.low, r.high), r.needed, (r.needed_low, r.needed_high), r.rate,
                   r.rate_error, _TARGETS[r.state], r.coherent, r.trials,
                   asked.reasons.get(asked.names[int(r.pattern)], in_python(r.reason.decode(errors="replace"))))
            for r in rows]


def _result(result: s.RankCheckResult, names: Sequence[str]) -> FirstPlace:
    overturned = _CHECKS[result.state] == "overturned"
    interval = (result.behind_low, result.behind_high) if overturned else (math.nan, math.nan)
    return FirstPlace(_CHECKS[result.state], names[int(result.pattern)] if overturned else None,
                      result.behind if overturned else math.nan, interval, result.coherent)


def _check(check: s.RankCheck, names: Sequence[str]) -> SizeCheck:
    advice = _result(check.advice, names)
    return SizeCheck((check.width, check.height), advice.state, advice.best, advice.behind, advice.behind_interval,
                     check.trials, advice.coherent, _result(check.first, names))
