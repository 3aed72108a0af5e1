# SPDX-License-Identifier: Apache-2.0
"""The renderer of libkoksma-lab."""
from __future__ import annotations

from ctypes import byref, c_void_p
from operator import index
from typing import Dict, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._library import ArgumentError, call, check, core, lab, spec, text
from ._points import free_with


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


def render(scene: str, pattern: str = "n-rooks", spp: int = 16, *, size: Optional[Tuple[int, int]] = None,
           seed: int = 0, pairing: str = "shuffled", scope: str = "pixel", lights: str = "all",
           integrator: Optional[str] = None, filter: Optional[str] = None, threads: int = 0) -> npt.NDArray[np.float32]:
    """Renders a scene that ships, or a JSON file (a text with a '/' or that ends in ".json").

    size: (width, height); the scene's own when left out. The other arguments are those of `koksma render`, and give
    the same bits. Returns linear light of shape (height, width, channels), channels 1 or 3; row 0 is on top.
    """
    handle, options, image = c_void_p(), s.RenderOptions(), s.Image()
    choices: Dict[str, int] = {"pairing": _choice("pairing", pairing), "scope": _choice("scope", scope),
                               "lights": _choice("light_selection", lights)}
    parsed, spp, seed = spec("pattern", pattern), index(spp), index(seed)
    if not (0 <= seed < 1 << 64 and 0 < spp < 1 << 31):
        raise ArgumentError(f"seed {seed}, spp {spp}: seeds are 0 to 2^64 - 1, spp is at least 1")
    check(lab().koksma_scene_open(text(scene), byref(handle)))
    try:
        lab().koksma_render_options_init(byref(options), handle)
        options.pattern, options.spp, options.seed = parsed, spp, seed
        for name, value in choices.items():
            setattr(options, name, value)
        if size is not None:
            width, height = size
            options.width, options.height = index(width), index(height)
        if integrator is not None:
            options.integrator = _found("integrator", integrator)
        if filter is not None:
            options.filter = _found("filter", filter)
        call(lab().koksma_render, handle, byref(options), byref(image), threads=threads, run_at=2)
    finally:
        lab().koksma_scene_close(handle)
    return adopt_image(image)


def adopt_image(image: s.Image) -> npt.NDArray[np.float32]:
    """An array over an image's own memory, freed with the array."""
    array = np.ctypeslib.as_array(image.pixels, shape=(image.height, image.width, image.channels))
    free_with(array, lab().koksma_image_fini, image)
    return array


def read_image(path: str) -> npt.NDArray[np.float32]:
    """An EXR, PNG or PFM file as linear light, of shape (height, width, channels)."""
    image = s.Image()
    check(lab().koksma_image_read(text(path), byref(image)))
    return adopt_image(image)


def version() -> str:
    """The library's version."""
    return core().koksma_version().decode()
