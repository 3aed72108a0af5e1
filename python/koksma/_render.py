# SPDX-License-Identifier: Apache-2.0
"""The renderer of libkoksma-lab."""
from __future__ import annotations

import math
import os
from contextlib import contextmanager
from ctypes import byref, c_void_p, create_string_buffer
from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Literal, Optional, SupportsIndex, Tuple, Union, overload

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._library import (ArgumentError, Seed, call, check, choice, closest, core, flag, lab, pair, quoted, real, seed_of, text,
                       warn, whole)
from ._mask import looks_like_mask
from ._points import Named, free_with, named, shown


def scenes() -> List[str]:
    """The names of the scenes that ship.

    Returns
    -------
    list of str

    Examples
    --------
    >>> import koksma
    >>> "ball" in koksma.scenes()
    True
    """
    names: List[str] = []
    while lab().koksma_scene_name_at(len(names)):
        names.append(lab().koksma_scene_name_at(len(names)).decode())
    return names


@dataclass(frozen=True)
class SceneCheck:
    """What a scene contains, and what looks odd in it. warnings: what can be rendered but looks like a mistake; unknown: those of
    them for parts of pbrt's and Mitsuba's scenes that Koksma does not know, each with what replaces it. True without warnings."""

    title: str
    shapes: int
    meshes: int
    placements: int
    triangles: int
    materials: int
    lights: int
    warnings: Tuple[str, ...]
    unknown: Tuple[str, ...]
    media: int  #: 1 if the scene has a medium, which only path and its variants render
    paths: int  #: 1 if it has a medium, or is a scene of pbrt or Mitsuba whose integrator follows paths between surfaces
    spp: Optional[int]  #: samples a pixel that the sampler of a pbrt or Mitsuba scene asks for

    def __bool__(self) -> bool:
        return not self.warnings


def check_scene(scene: Union[str, "os.PathLike[str]"]) -> SceneCheck:
    """Reads a scene, and says what is in it and what looks odd, as `koksma scene check` does.

    Parameters
    ----------
    scene : str or path
        As of `render`.

    Returns
    -------
    SceneCheck

    Raises
    ------
    MissingError, MalformedError
        The text names file, line, field and reason.

    Examples
    --------
    >>> import koksma
    >>> found = koksma.check_scene("ball")
    >>> bool(found), found.lights
    (True, 2)
    """
    handle, line = c_void_p(), create_string_buffer(1024)

    def lines(kind: str) -> Tuple[str, ...]:
        found: List[str] = []
        while getattr(lab(), f"koksma_scene_{kind}")(handle, len(found), line, len(line)):
            found.append(line.value.decode(errors="replace"))
        return tuple(found)

    check(lab().koksma_scene_open(text(_scene_name(scene), "scene"), byref(handle)))
    try:
        counts = lab().koksma_scene_count(handle)
        return SceneCheck(lab().koksma_scene_title(handle).decode(errors="replace"), counts.shapes, counts.meshes, counts.placements,
                          counts.triangles, counts.materials, counts.lights, lines("warning"), lines("unknown"),
                          counts.media, counts.paths, counts.spp or None)
    finally:
        lab().koksma_scene_close(handle)


def _scene_name(scene: Union[str, "os.PathLike[str]"]) -> str:
    """A path is a file, a text may be a name."""
    return os.path.join(os.curdir, scene) if isinstance(scene, os.PathLike) else scene


def integrators() -> List[Named]:
    """All integrators, in the table's order.

    Returns
    -------
    list of Named

    Examples
    --------
    >>> import koksma
    >>> "path" in [i.name for i in koksma.integrators()]
    True
    """
    return named(lab().koksma_integrator_at)


def filters() -> List[Named]:
    """All pixel filters, in the table's order.

    Returns
    -------
    list of Named

    Examples
    --------
    >>> import koksma
    >>> "mitchell" in [f.name for f in koksma.filters()]
    True
    """
    return named(lab().koksma_filter_at)


def adaptive() -> List[Named]:
    """All methods of adaptive sampling, in the table's order.

    Returns
    -------
    list of Named

    Examples
    --------
    >>> import koksma
    >>> "contrast" in [m.name for m in koksma.adaptive()]
    True
    """
    return named(lab().koksma_adaptive_at)


def _choice(argument: str, kind: str, word: str) -> int:
    names: List[str] = []
    name_of: Any = getattr(lab(), f"koksma_{kind}_name")
    while name_of(len(names)):
        names.append(name_of(len(names)).decode())
    return choice(argument, word, names)


def _found(kind: str, name: str) -> int:
    found: int = getattr(lab(), f"koksma_{kind}_find")(text(name, kind))
    if not found:
        near = closest(os.fsdecode(name), [member.name for member in named(getattr(lab(), f"koksma_{kind}_at"))])
        meant = f"did you mean {near!r}? " if near else ""
        raise ArgumentError(f"no {kind} {quoted(name)}; {meant}koksma.{kind}s() names them")
    return found


@dataclass(frozen=True, eq=False)
class Layers:
    """An image and further values of its pixels, arrays of shape (height, width, channels).

    Attributes
    ----------
    image : ndarray
        Linear light, 1 or 3 channels.
    albedo, normal, depth : ndarray
        Of the first hit, means over the samples; of adaptive sampling over those of the first round. 3, 3 and 1 channels.
    samples, variance : ndarray
        Number of samples of a pixel, and the variance of its luminance as if they were independent.
    rays : int
        Rays cast.
    rounds, splits, needless : int
        Of adaptive sampling: rounds after the first, strata that were split, and splits that `probes` found not needed.
    """

    image: npt.NDArray[np.float32]
    albedo: npt.NDArray[np.float32]
    normal: npt.NDArray[np.float32]
    depth: npt.NDArray[np.float32]
    samples: npt.NDArray[np.float32]
    variance: npt.NDArray[np.float32]
    rays: int
    rounds: int
    splits: int
    needless: int = 0

    def __repr__(self) -> str:
        height, width, channels = self.image.shape
        return (f"Layers({width} x {height} pixels, {channels} channel{'s' * (channels > 1)}, {self.samples.mean():.6g} samples a "
                f"pixel, {self.rays} rays)")


@dataclass(frozen=True, eq=False)
class Replicates:
    """The mean of independent images with its standard errors.

    Attributes
    ----------
    image, error : ndarray of shape (height, width, channels)
        The mean, in linear light, and its standard error: the standard deviation of the images divided by the root of their
        number, itself an estimate with a relative error of 1 / sqrt(2 replicates - 2).
    replicates, rays : int
    mean, mean_interval : float, (low, high)
        Luminance of the picture, the mean over its pixels; 95 %, by Student's t over the images.
    rmse, rmse_interval : float, (low, high)
        Root mean square error of the luminance of `image`, from the spread of the images; likewise.
    """

    image: npt.NDArray[np.float32]
    error: npt.NDArray[np.float32]
    replicates: int
    rays: int
    mean: float
    mean_interval: Tuple[float, float]
    rmse: float
    rmse_interval: Tuple[float, float]

    def __repr__(self) -> str:
        height, width, _ = self.image.shape
        return (f"Replicates({width} x {height} pixels, mean of {self.replicates} images, rmse {self.rmse:.3g} in "
                f"[{self.rmse_interval[0]:.3g}, {self.rmse_interval[1]:.3g}])")


@contextmanager
def _opened(scene: Union[str, "os.PathLike[str]"], pattern: str, spp: SupportsIndex, size: Optional[Tuple[SupportsIndex, SupportsIndex]],
            seed: Seed, pairing: str, scope: str, lights: str, integrator: Optional[str], depth: Optional[SupportsIndex],
            filter: Optional[str], splat: bool, sky: Optional[float],
            environment: Union[str, "os.PathLike[str]", None]) -> Iterator[Tuple[c_void_p, s.RenderOptions]]:
    """An open scene, with the options of a render."""
    handle, options = c_void_p(), s.RenderOptions()
    splat = flag("splat", splat)
    choices: Dict[str, int] = {"pairing": _choice("pairing", "pairing", pairing), "scope": _choice("scope", "scope", scope),
                               "lights": _choice("lights", "light_selection", lights)}
    spp, seed = whole("spp", spp, 1, s.MAX_SPP), seed_of(seed)
    check(lab().koksma_scene_open(text(_scene_name(scene), "scene"), byref(handle)))
    try:
        if sky is not None or environment is not None:
            check(lab().koksma_scene_set_sky(handle, None if environment is None else text(environment, "environment"),
                                             1.0 if sky is None else real("sky", sky, nan_too=True)))
        lab().koksma_render_options_init(byref(options), handle)
        options.spp, options.seed = spp, seed
        check(lab().koksma_render_patterns(text(pattern, "pattern"), byref(options)))
        for name, value in choices.items():
            setattr(options, name, value)
        if size is not None:
            width, height = pair("size", size)
            options.width = whole("width", width, 1, s.MAX_IMAGE_SIDE)
            options.height = whole("height", height, 1, s.MAX_IMAGE_SIDE)
        if integrator is not None:
            options.integrator = _found("integrator", integrator)
        if filter is not None:
            options.filter = _found("filter", filter)
        if depth is not None:
            options.depth = whole("depth", depth, 0, s.MAX_DEPTH)
        options.splat = splat
        yield handle, options
    finally:
        lab().koksma_scene_close(handle)


@overload
def render(scene: Union[str, "os.PathLike[str]"], pattern: str = "n-rooks", spp: SupportsIndex = 16, *,
           size: Optional[Tuple[SupportsIndex, SupportsIndex]] = None, seed: Seed = 0,
           pairing: str = "shuffled", scope: str = "pixel", lights: str = "auto", integrator: Optional[str] = None,
           depth: Optional[SupportsIndex] = None, filter: Optional[str] = None, splat: bool = False,
           adaptive: Optional[str] = None, budget: float = 0, probes: SupportsIndex = 0, sky: Optional[float] = None,
           environment: Union[str, "os.PathLike[str]", None] = None, layers: Literal[False] = False,
           threads: SupportsIndex = 0) -> npt.NDArray[np.float32]: ...
@overload
def render(scene: Union[str, "os.PathLike[str]"], pattern: str = "n-rooks", spp: SupportsIndex = 16, *,
           size: Optional[Tuple[SupportsIndex, SupportsIndex]] = None, seed: Seed = 0,
           pairing: str = "shuffled", scope: str = "pixel", lights: str = "auto", integrator: Optional[str] = None,
           depth: Optional[SupportsIndex] = None, filter: Optional[str] = None, splat: bool = False,
           adaptive: Optional[str] = None, budget: float = 0, probes: SupportsIndex = 0, sky: Optional[float] = None,
           environment: Union[str, "os.PathLike[str]", None] = None, layers: Literal[True],
           threads: SupportsIndex = 0) -> Layers: ...
def render(scene: Union[str, "os.PathLike[str]"], pattern: str = "n-rooks", spp: SupportsIndex = 16, *,
           size: Optional[Tuple[SupportsIndex, SupportsIndex]] = None, seed: Seed = 0,
           pairing: str = "shuffled", scope: str = "pixel", lights: str = "auto", integrator: Optional[str] = None,
           depth: Optional[SupportsIndex] = None, filter: Optional[str] = None, splat: bool = False,
           adaptive: Optional[str] = None, budget: float = 0, probes: SupportsIndex = 0, sky: Optional[float] = None,
           environment: Union[str, "os.PathLike[str]", None] = None, layers: bool = False,
           threads: SupportsIndex = 0) -> Union[npt.NDArray[np.float32], Layers]:
    """Renders a scene, with the bits of `koksma render`.

    Parameters
    ----------
    scene : str or path
        The name of a scene that ships (koksma.scenes()), or a file: a path, or a text with a '/' or that ends in ".json".
    pattern : str
        Of all uses of a sample; or also patterns of single uses and of groups of uses, which one pattern of their total
        dimension samples together, with ';' between: "random;lens=sobol;pixel+time=scan-time".
    spp : int
        Samples a pixel.
    size : (width, height), optional
        The scene's own when left out.
    seed : int
    pairing : {"shuffled", "aligned", "native"}
        How the point sets of a pixel's uses are combined.
    scope : {"pixel", "image"}
        What one point set covers.
    lights : {"auto", "all", "one", "power", "uniform"}
        Which lights a sample takes: all, or one drawn by its estimated contribution, by its power or uniformly. auto: one for
        the integrator path with more than 8 lights, else all.
    integrator, filter : str, optional
        koksma.integrators() and koksma.filters() name them. Integrator None: path in a medium
        and where a scene of pbrt or Mitsuba asks for it, else distribution.
    depth : int, optional
        The longest path, in bounces.
    splat : bool
        Each sample adds to all pixels that the filter reaches.
    adaptive : str, optional
        A method, such as "hierarchical:levels=2", that takes more samples than spp where it needs them, until it needs none or
        `budget` is spent. Some methods draw strata of their own, and take no pattern.
    budget : float
        Samples a pixel, averaged over the image; 0: no limit.
    sky : float, optional
        Light of this radiance from all directions, instead of the scene's sky or the default lights of a model.
    environment : path, optional
        An image in latitude and longitude that gives the light instead, times `sky`.
    probes : int
        With adaptive: further samples to test whether each split was needed; `needless` counts those that were not.
    layers : bool
        Return a `Layers`.
    threads : int
        0: one for each processor. The image does not depend on it.

    Returns
    -------
    ndarray of float32, of shape (height, width, channels), or Layers
        Linear light, 1 or 3 channels; row 0 is on top.

    Raises
    ------
    ArgumentError, MissingError, MalformedError

    Examples
    --------
    >>> import koksma
    >>> koksma.render("cornell", spp=4, size=(8, 8), integrator="path", layers=True).depth.shape
    (8, 8, 1)
    """
    image, every, report = s.Image(), s.Layers(), s.AdaptiveReport()
    flag("layers", layers)
    with _opened(scene, pattern, spp, size, seed, pairing, scope, lights, integrator, depth, filter, splat, sky, environment) as (handle, options):
        try:
            if adaptive is not None:
                method = s.AdaptiveOptions()
                check(lab().koksma_adaptive_parse(text(adaptive, "adaptive"), byref(method)))
                if not 0 <= real("budget", budget, nan_too=True) < math.inf:
                    raise ArgumentError(f"budget must be samples a pixel, or 0 for no limit, not {quoted(budget)}")
                if method.method.contents.own_samples and pattern != "n-rooks":
                    raise ArgumentError(f"pattern '{pattern}': the adaptive method {adaptive} places its own samples")
                method.budget, method.probes = budget, whole("probes", probes, 0, s.MAX_INT)
                call(lab().koksma_render_adaptive, handle, byref(options), byref(method), byref(every), byref(report),
                     threads=threads, run_at=3)
            elif budget or probes:
                given = f"budget {budget}" if budget else f"probes {probes}"
                raise ArgumentError(f"{given}: give a method of adaptive sampling, too; koksma.adaptive() names them")
            elif layers:
                call(lab().koksma_render_layers, handle, byref(options), byref(every), threads=threads, run_at=2)
            else:
                call(lab().koksma_render, handle, byref(options), byref(image), threads=threads, run_at=2)
        except BaseException:  # a signal's handler's, perhaps, when the image was there
            lab().koksma_image_fini(byref(image))
            lab().koksma_layers_fini(byref(every))
            raise
    if adaptive is None and not layers:
        return adopt_image(image)
    parts = {name: adopt_image(s.Image.from_buffer_copy(getattr(every, name)))
             for name in ("image", "albedo", "normal", "depth", "samples", "variance")}
    if not layers:
        return parts["image"]
    return Layers(**parts, rays=every.rays, rounds=report.rounds, splits=report.splits, needless=report.needless)


def render_replicates(scene: Union[str, "os.PathLike[str]"], pattern: str = "n-rooks", spp: SupportsIndex = 16, replicates: SupportsIndex = 8,
                      *, size: Optional[Tuple[SupportsIndex, SupportsIndex]] = None, seed: Seed = 0, pairing: str = "shuffled",
                      scope: str = "pixel", lights: str = "auto", integrator: Optional[str] = None, depth: Optional[SupportsIndex] = None,
                      filter: Optional[str] = None, splat: bool = False, sky: Optional[float] = None,
                      environment: Union[str, "os.PathLike[str]", None] = None, threads: SupportsIndex = 0) -> Replicates:
    """Renders independent images and returns their mean with its standard errors, as `koksma render --error-map` does.

    Parameters
    ----------
    scene, pattern, spp, size, seed, pairing, scope, lights, integrator, depth, filter, splat, sky, environment, threads
        As of `render`; the images have the seeds seed, seed + 1, ... The pattern must be random and unbiased: no spread shows the
        error of others.
    replicates : int
        Number of images, 3 to 100,000, of spp samples a pixel each.

    Returns
    -------
    Replicates

    Raises
    ------
    ArgumentError, MissingError, MalformedError

    Examples
    --------
    >>> import koksma
    >>> found = koksma.render_replicates("ball", "random", 4, size=(16, 12))
    >>> found.image.shape == found.error.shape, found.mean_interval[0] < found.mean < found.mean_interval[1]
    (True, True)
    """
    found = s.Replicates()
    with _opened(scene, pattern, spp, size, seed, pairing, scope, lights, integrator, depth, filter, splat, sky, environment) as (handle, options):
        try:
            call(lab().koksma_render_replicates, handle, byref(options), whole("replicates", replicates, 3, 100000), byref(found),
                 threads=threads, run_at=3)
        except BaseException:
            lab().koksma_replicates_fini(byref(found))
            raise
    return Replicates(adopt_image(s.Image.from_buffer_copy(found.image)), adopt_image(s.Image.from_buffer_copy(found.error)),
                      found.replicates, found.rays, found.mean, (found.mean_low, found.mean_high), found.rmse,
                      (found.rmse_low, found.rmse_high))


def adopt_image(image: s.Image) -> npt.NDArray[np.float32]:
    """An array over an image's own memory, freed with the array."""
    array = shown(image.pixels, image.height, image.width, image.channels)
    return free_with(array, lab().koksma_image_fini, image)


def read_image(path: Union[str, "os.PathLike[str]"]) -> npt.NDArray[np.float32]:
    """Reads an image as linear light.

    A warning names what is odd about the file: the scale of a PFM file that is not 1.

    Parameters
    ----------
    path : str or path
        An EXR, PNG, PFM or JPEG file.

    Returns
    -------
    ndarray of float32, of shape (height, width, channels)

    Raises
    ------
    MissingError, MalformedError, UnsupportedError

    Examples
    --------
    >>> import koksma
    >>> koksma.write_image("image.pfm", [[0, 0.5, 1]])
    >>> koksma.read_image("image.pfm").shape
    (1, 3, 1)
    """
    image = s.Image()
    check(lab().koksma_image_read(text(path, "path"), byref(image)))
    if remark := lab().koksma_image_remark().decode():
        warn(f"{os.fspath(path)}: {remark}")
    array = adopt_image(image)
    if os.fsdecode(path).lower().endswith(".png") and looks_like_mask(array):
        warn(f"{os.fspath(path)}: all levels are equally often, as in a mask; read_mask has its numbers, this their light by sRGB")
    return array


def write_image(path: Union[str, "os.PathLike[str]"], image: npt.ArrayLike) -> None:
    """Writes an image, whole or not at all.

    Parameters
    ----------
    path : str or path
        Its ending says the format: .exr, .png, .pfm or .jpg.
    image : array_like of shape (height, width) or (height, width, channels)
        Linear light, 1 or 3 channels.

    Examples
    --------
    >>> import koksma
    >>> koksma.write_image("ball.png", koksma.render("ball", spp=4, size=(16, 12)))
    """
    from ._compare import as_image, view_image

    array = as_image(image)
    lossy = os.fsdecode(text(path, "path")).lower().endswith((".png", ".jpg", ".jpeg"))
    if lossy and 64 <= array.max() <= 256:
        warn(f"pixels up to {array.max():g}: white is 1; divide by 255 if they are of 0 to 255")
    elif lossy and (lost := int((~(array >= 0) | np.isinf(array)).sum())):
        warn(f"{lost} of {array.size} values are negative or not finite: 8 bits have black or white there")
    check(lab().koksma_image_write(text(path, "path"), byref(view_image(array)), None))


def version() -> str:
    """The library's version.

    Returns
    -------
    str

    Examples
    --------
    >>> import koksma
    >>> len(koksma.version().split("."))
    3
    """
    return str(core().koksma_version().decode())
