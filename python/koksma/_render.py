# SPDX-License-Identifier: Apache-2.0
"""The renderer of libkoksma-lab."""
from __future__ import annotations

import os
from ctypes import byref, c_void_p
from typing import Dict, List, Optional, SupportsIndex, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._library import ArgumentError, call, check, core, lab, text, whole
from ._points import free_with, shown


def scenes() -> List[str]:
    """The names of the scenes that ship."""
    names: List[str] = []
    while lab().koksma_scene_name_at(len(names)):
        names.append(lab().koksma_scene_name_at(len(names)).decode())
    return names


def _choice(kind: str, word: str) -> int:
    names, name_of = [], getattr(lab(), f"koksma_{kind}_name")
    while name_of(len(names)):
        names.append(name_of(len(names)).decode())
    if word not in names:
        raise ArgumentError(f"{kind} '{word}': it takes {', '.join(names)}")
    return names.index(word)


def _found(kind: str, name: str) -> int:
    found = getattr(lab(), f"koksma_{kind}_find")(text(name))
    if not found:
        raise ArgumentError(f"no {kind} '{name}'; 'koksma list {kind}s' names them")
    return found


def render(scene: Union[str, "os.PathLike[str]"], pattern: str = "n-rooks", spp: SupportsIndex = 16, *,
           size: Optional[Tuple[SupportsIndex, SupportsIndex]] = None, seed: SupportsIndex = 0,
           pairing: str = "shuffled", scope: str = "pixel", lights: str = "all", integrator: Optional[str] = None,
           filter: Optional[str] = None, threads: SupportsIndex = 0) -> npt.NDArray[np.float32]:
    """Renders a scene that ships, or a JSON file (a path, or a text with a '/' or that ends in ".json").

    pattern: of all uses of a sample; or also patterns of single uses and of groups of uses, which one pattern of their
    total dimension samples together, with ';' between: "random;lens=sobol;pixel+time=scan-time".
    size: (width, height); the scene's own when left out. The other arguments are those of `koksma render`, and give
    the same bits. Returns linear light of shape (height, width, channels), channels 1 or 3; row 0 is on top.
    """
    handle, options, image = c_void_p(), s.RenderOptions(), s.Image()
    choices: Dict[str, int] = {"pairing": _choice("pairing", pairing), "scope": _choice("scope", scope),
                               "lights": _choice("light_selection", lights)}
    spp, seed = whole("spp", spp, 1, s.MAX_SPP), whole("seed", seed, 0, s.MAX_SEED)
    name = os.path.join(os.curdir, scene) if isinstance(scene, os.PathLike) else scene
    check(lab().koksma_scene_open(text(name), byref(handle)))
    try:
        lab().koksma_render_options_init(byref(options), handle)
        options.spp, options.seed = spp, seed
        check(lab().koksma_render_patterns(text(pattern), byref(options)))
        for name, value in choices.items():
            setattr(options, name, value)
        if size is not None:
            width, height = size
            options.width = whole("width", width, 1, s.MAX_IMAGE_SIDE)
            options.height = whole("height", height, 1, s.MAX_IMAGE_SIDE)
        if integrator is not None:
            options.integrator = _found("integrator", integrator)
        if filter is not None:
            options.filter = _found("filter", filter)
        call(lab().koksma_render, handle, byref(options), byref(image), threads=threads, run_at=2)
    except BaseException:  # a signal's handler's, perhaps, when the image was there
        lab().koksma_image_fini(byref(image))
        raise
    finally:
        lab().koksma_scene_close(handle)
    return adopt_image(image)


def adopt_image(image: s.Image) -> npt.NDArray[np.float32]:
    """An array over an image's own memory, freed with the array."""
    array = shown(image.pixels, image.height, image.width, image.channels)
    return free_with(array, lab().koksma_image_fini, image)


def read_image(path: Union[str, "os.PathLike[str]"]) -> npt.NDArray[np.float32]:
    """An EXR, PNG or PFM file as linear light, of shape (height, width, channels)."""
    image = s.Image()
    check(lab().koksma_image_read(text(os.fspath(path)), byref(image)))
    return adopt_image(image)


def version() -> str:
    """The library's version."""
    return core().koksma_version().decode()
