# SPDX-License-Identifier: Apache-2.0
"""Search for a point set with which the image of one scene has a small error."""
from __future__ import annotations

import os
from ctypes import byref, c_char_p
from dataclasses import dataclass
from typing import Any, Callable, Optional, Sequence, SupportsIndex, Tuple, Union

from . import _structs as s
from ._library import Seed, call, lab, pair, seed_of, text, texts, whole
from ._points import PointArray, shown
from ._render import _scene_name


@dataclass(frozen=True)
class SceneGain:
    """How a set compares with the listed patterns in one scene. Errors are mean absolute errors in luminance."""

    scene: str
    size: Tuple[int, int]
    error: float
    best_listed: str  #: the listed pattern with the least error
    listed_error: float
    gain: float  #: 1 - error / listed_error
    interval: Tuple[float, float]  #: of the gain, with 95 %
    trials: int  #: images of the set
    settled: bool  #: it is decided which leaves the least error, the set or a listed pattern
    coherent: bool  #: the error of the set has bands or another pattern


@dataclass(frozen=True, eq=False)
class SceneOptimum:
    """A point set for a scene, and how it compares with other patterns.

    Attributes
    ----------
    points : ndarray of shape (spp, 2)
    gains : tuple of SceneGain
        The first in the scene itself, the others in the held-out scenes.
    gain, interval
        The mean gain over the held-out scenes and its 95 % interval; NaN where there are none. A gain that only the first scene
        shows is due to chance, not to better points.
    shares : tuple of float
        The shares of a pixel's variance along x, along y, and of their interaction, by which the candidates were made.
    candidates, eliminated : int
        Point sets that were tried, shifts included, and those that were decided to be worse.
    measure, phase : str, int
        The L2 discrepancy that the set was made for, and the number of its shift on the torus.
    """

    points: PointArray
    gains: Tuple[SceneGain, ...]
    gain: float
    interval: Tuple[float, float]
    shares: Tuple[float, float, float]
    candidates: int
    eliminated: int
    measure: str
    phase: int

    def __repr__(self) -> str:
        home = self.gains[0]
        return (f"SceneOptimum({home.scene!r}, {len(self.points)} points: gain {100 * home.gain:.3g} % over {home.best_listed}, "
                f"{100 * self.gain:.3g} % in {len(self.gains) - 1} held-out scenes)")

    def _repr_html_(self) -> str:
        from ._display import number, table

        return table(("scene", "error", "best listed", "its error", "gain", "interval"),
                     [(g.scene, g.error, g.best_listed, g.listed_error, f"{100 * g.gain:.3g} %",
                       " to ".join(f"{100 * x:.3g} %" for x in g.interval)) for g in self.gains],
                     f"{self.eliminated} of {self.candidates} candidates eliminated; mean gain in held-out scenes: "
                     f"{number(100 * self.gain, 3) or 'none'} %")


def optimise_scene(scene: Union[str, "os.PathLike[str]"], spp: SupportsIndex, *, held_out: Optional[Sequence[str]] = None,
                   against: Optional[Sequence[str]] = None, candidates: SupportsIndex = 8, phases: SupportsIndex = 4,
                   size: Optional[Tuple[SupportsIndex, SupportsIndex]] = None, max_trials: SupportsIndex = 32,
                   seed: Seed = 0, threads: SupportsIndex = 0,
                   progress: Optional[Callable[[float], object]] = None) -> SceneOptimum:
    """Searches for a point set with which the image of a scene has a small error, as `koksma optimise --scene` does.

    Parameters
    ----------
    scene : str or path
        As of `render`.
    spp : int
        The number of points, 1 to 4096: every pixel takes the set for its samples.
    held_out : sequence of str, optional
        Other scenes, at most 16, in which the set is tested; six that ship when left out, none if empty.
    against : sequence of str, optional
        Patterns, at most 64, to compare the set with; those of 17 that make `spp` points when left out.
    candidates, phases : int
        Candidate sets, and shifts of each on the torus, at most 1000.
    size : (width, height), optional
        Without it the scene's own, halved until it has 1,200 pixels at most.
    max_trials : int
        Images of each candidate and pattern, at least 8.
    seed : int
        0 to 2**32 - 1.
    threads : int
        0: one for each processor. The result does not depend on it.
    progress : callable, optional
        Called with the fraction that is done.

    Returns
    -------
    SceneOptimum

    Raises
    ------
    ArgumentError, MissingError, MalformedError

    Examples
    --------
    >>> import koksma
    >>> best = koksma.optimise_scene("ball", 4, held_out=["checker"], against=["jittered"], candidates=1, phases=1,
    ...                              size=(16, 12), max_trials=8)
    >>> best.points.shape, [gain.scene for gain in best.gains]
    ((4, 2), ['ball', 'checker'])
    """
    def listed(name: str, values: Optional[Sequence[str]]) -> Any:
        if values is None:
            return None, 0
        given = [text(value, name) for value in texts(name, values)]
        return (c_char_p * max(len(given), 1))(*given), len(given)

    options, best = s.SceneSearch(scene=text(_scene_name(scene), "scene"), spp=whole("spp", spp, 1, 4096)), s.SceneOptimum()
    options.seed = seed_of(seed, (1 << 32) - 1)
    options.candidates, options.phases = whole("candidates", candidates, 1, 1000), whole("phases", phases, 1, 1000)
    options.max_trials = whole("max_trials", max_trials, 8, s.MAX_RANK_TRIALS)
    options.held_out, options.n_held_out = listed("held_out", held_out)
    options.against, options.n_against = listed("against", against)
    if size is not None:
        width, height = pair("size", size)
        options.width = whole("width", width, 1, s.MAX_IMAGE_SIDE)
        options.height = whole("height", height, 1, s.MAX_IMAGE_SIDE)
    try:
        call(lab().koksma_optimise_scene, byref(options), byref(best), threads=threads, run_at=1, progress=progress)
        gains = tuple(SceneGain(os.fsdecode(g.scene), (g.width, g.height), g.error, os.fsdecode(g.best_listed), g.listed_error, g.gain,
                                (g.low, g.high), g.trials, g.settled, g.coherent) for g in best.gains[:best.n_gains])
        return SceneOptimum(shown(best.points.xs, best.points.n, best.points.dim).copy(), gains, best.gain, (best.low, best.high),
                            tuple(best.shares), best.candidates, best.eliminated, best.measure.decode(), best.phase)
    finally:
        lab().koksma_scene_optimum_fini(byref(best))
