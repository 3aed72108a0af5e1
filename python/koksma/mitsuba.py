# SPDX-License-Identifier: Apache-2.0
"""Koksma's patterns as samplers of Mitsuba 3, and rankings of samplers in Mitsuba's scenes.

    >>> import mitsuba as mi                                                        # doctest: +SKIP
    >>> mi.set_variant("llvm_ad_rgb")                                               # doctest: +SKIP
    >>> import koksma.mitsuba                                                       # doctest: +SKIP
    >>> koksma.mitsuba.register()                                                   # doctest: +SKIP
    >>> scene = mi.cornell_box()                                                    # doctest: +SKIP
    >>> scene["sensor"]["sampler"] = {"type": "koksma", "pattern": "jittered", "sample_count": 16}  # doctest: +SKIP
    >>> image = mi.render(mi.load_dict(scene))                                      # doctest: +SKIP
    >>> print(koksma.mitsuba.rank("scene.xml", ["independent", "n-rooks"], spp=16)) # doctest: +SKIP

As in <koksma/sampler.h>, samples are functions of a domain and an index: each pixel has a domain, and each request for
one or two numbers (a use) derives one from it, so that uses are independent of each other and no pattern runs out of
dimensions. The domains are computed by Dr.Jit arrays, for a whole wavefront at once, and the number of uses so far is
an array, too: Dr.Jit carries it through symbolic loops, such as that over the bounces of a path. Mitsuba's own
"stratified" and "multijitter" work in the same way.

The default pattern, Owen-scrambled Sobol' points by hashing, is computed for each use, with the bits of koksma_sobol_2d.
Of every other pattern `sets` sets of two-dimensional points are made beforehand; a use takes one of them at random, in an
order of its own (Kensler's permutation). One number is the first coordinate of two.

In "scalar_..." variants Mitsuba gives a sampler no seed but a number for each pixel, seed * width * height + block *
block_size^2 + i. The numbers of the last blocks reach into those of the next seed, so that neighbouring seeds share pixels,
with Mitsuba's own samplers as well. There register() makes Integrator.render hand the seed to our sampler and render with
seed 0: the number is that of the pixel, and the seed is part of each domain's key and of that of the prepared sets. For
Mitsuba's own samplers a Renderer multiplies seeds until the numbers of neighbouring ones no longer meet.

Needs Mitsuba 3.7 or later. Variants "llvm_..." take an LLVM library that Dr.Jit finds: Mitsuba 3.9 needs 17 or later
(Debian: libllvm19 and DRJIT_LIBLLVM_PATH). The "scalar_..." variants work, slowly.
"""
from __future__ import annotations

import functools
import os
import threading
import time
from typing import Any, Callable, Dict, List, Optional, Sequence, SupportsIndex, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._library import ArgumentError, Error, UnsupportedError, quoted
from ._points import canonical, generate
from ._rank import Asked, Ranking
from ._rank import rank as _rank

try:
    import drjit  # type: ignore[import-not-found, import-untyped, unused-ignore]
    import mitsuba  # type: ignore[import-not-found, import-untyped, unused-ignore]
except ModuleNotFoundError:
    raise ImportError("koksma.mitsuba needs Mitsuba 3: pip install mitsuba") from None

dr: Any = drjit  # their arrays have other types in each variant
mi: Any = mitsuba

OWEN_SOBOL = "sobol:scramble=hash-owen,shuffle=1"
_FOR_POINT, _FOR_SHUFFLE = 2, 3  # purposes of random words, as in sampler.h
_WORD = 0xFFFFFFFF
_classes: Dict[str, Any] = {}  # sampler classes by variant
_making = threading.Lock()  # held by the thread that makes the sets of a scalar variant's image; the others wait for them


# ---- Random words and domains: sampler.h, for numbers of Python and arrays of Dr.Jit -----------------------------------

def _wide(a: Any, b: int) -> Tuple[Any, Any]:
    """The upper and the lower 32 bits of a product."""
    if isinstance(a, int):
        return a * b >> 32, a * b & _WORD
    kind = dr.uint64_array_t(type(a))
    product = kind(a) * kind(b)
    return type(a)(product >> 32), type(a)(product)


def _words(key: Tuple[Any, Any], purpose: int, index: Tuple[Any, Any], lane: int) -> Tuple[Any, Any, Any, Any]:
    """Philox4x32-10 (Salmon et al. 2011), as koksma_words. Key and index: lower and upper word."""
    kind: Any = type(key[0])
    a, b, c, d = kind(index[0]), kind(index[1]), kind(lane), kind(purpose)
    k0, k1 = key
    for _ in range(10):
        (p_high, p_low), (q_high, q_low) = _wide(a, 0xD2511F53), _wide(c, 0xCD9E8D57)
        a, b, c, d = q_high ^ b ^ k0, q_low, p_high ^ d ^ k1, p_low
        k0, k1 = k0 + 0x9E3779B9, k1 + 0xBB67AE85
        if kind is int:
            k0, k1 = k0 & _WORD, k1 & _WORD
    return a, b, c, d


def _masked(x: Any) -> Any:
    return x & _WORD if isinstance(x, int) else x


def _mix(key: Tuple[Any, Any]) -> Tuple[Any, Any]:
    """koksma_mix."""
    high, low = _wide(key[0], 0x6659FD93)
    high = _masked(high + key[0] * 0xD6E8FEB8 + key[1] * 0x6659FD93)
    return low ^ high, high


def _domain_of_pixel(seed: int, pixel: Any) -> Tuple[Any, Any]:
    """koksma_domain_of_pixel with y = 0."""
    kind = type(pixel)
    image = _mix((seed & _WORD ^ 0x03707344, seed >> 32 ^ 0x13198A2E))
    return _mix(_mix((kind(image[0]) ^ pixel, kind(image[1]))))


def _domain_of_use(domain: Tuple[Any, Any], use: Any) -> Tuple[Any, Any]:
    high, low = _wide(use, 0x7F4A7C15)
    return _mix((domain[0] ^ low ^ 0x85A308D3, domain[1] ^ _masked(high + use * 0x9E3779B9) ^ 0x243F6A88))


def _seed_of(mixed: Tuple[Any, Any], dimension: int) -> Any:
    """koksma_seed_of the key whose koksma_mix is given."""
    x = _masked(mixed[0] + ((dimension + 1) * 0x9E3779B9 & _WORD))
    x = _masked((x ^ x >> 16) * 0x7FEB352D)
    x = _masked(((x ^ x >> 15) + mixed[1]) * 0x846CA68B)
    return x ^ x >> 16


def _mirror(x: Any) -> Any:
    """Reverses the order of the bits."""
    for mask, shift in ((0x55555555, 1), (0x33333333, 2), (0x0F0F0F0F, 4), (0x00FF00FF, 8), (0xFFFF, 16)):
        x = (x & mask) << shift | (x >> shift & mask)
    return _masked(x)


def _owen_hash(x: Any, seed: Any) -> Any:
    x = x ^ _masked(x * 0x3D20ADEA)
    x = _masked(x + seed)
    x = _masked(x * (seed >> 16 | 1))
    x = x ^ _masked(x * 0x05526C56)
    return x ^ _masked(x * 0x53A22864)


def _pascal(i: Any) -> Any:
    for mask, shift in ((0xAAAAAAAA, 1), (0xCCCCCCCC, 2), (0xF0F0F0F0, 4), (0xFF00FF00, 8), (0xFFFF0000, 16)):
        i = i ^ (i & mask) >> shift
    return i


def _sobol_2d(domain: Tuple[Any, Any], i: Any) -> Tuple[Any, Any]:
    """koksma_sobol_2d, as 32-bit fractions."""
    mixed = _mix(domain)
    order = _mix(mixed)[1]
    j = _mirror(_owen_hash(_mirror(i), order)) ^ _mirror(_owen_hash(type(i)(0), order)) & 0xFFFF0000
    return _mirror(_owen_hash(j, _seed_of(mixed, 0))), _mirror(_owen_hash(_pascal(j), _seed_of(mixed, 1)))


# ---- The sampler ---------------------------------------------------------------------------------------------------

def _sampler_class(variant: str) -> Any:
    jit = dr.is_jit_v(mi.Float)
    number = mi.UInt32 if jit else int

    class KoksmaSampler(mi.Sampler):  # type: ignore[misc, unused-ignore]
        """One sampler of a wavefront, or of one pixel at a time in scalar variants. Dr.Jit carries every attribute that
        is an array through loops."""

        def __init__(self, props: Any) -> None:
            mi.Sampler.__init__(self, props)
            self._take(str(props.get("pattern", OWEN_SOBOL)), int(props.get("seed", 0)), int(props.get("sets", 1024)))

        def _take(self, pattern: str, base_seed: int, sets: int) -> None:
            if not 1 <= sets <= 1 << 20:
                raise ArgumentError(f"sets must be 1 to {1 << 20}, not {sets}")
            self.pattern, self.base_seed, self.sets = canonical(pattern), base_seed, sets
            self._key: Optional[Tuple[int, int]] = None
            self.image_seed = 0  # scalar variants: the seed of the image, which render sets
            self._made: Dict[Tuple[int, int], Tuple[Any, Any]] = {}  # scalar variants: the sets, shared by the threads

        def _like(self) -> Any:
            props = mi.Properties()
            props["sample_count"] = self.sample_count()
            other = KoksmaSampler(props)
            other._take(self.pattern, self.base_seed, self.sets)
            other.image_seed, other._made = self.image_seed, self._made
            return other

        def fork(self) -> Any:
            return self._like()

        def clone(self) -> Any:
            other = self._like()
            for name, value in self.__dict__.items():
                setattr(other, name, value)
            if self.wavefront_size():
                mi.Sampler.seed(other, self.run_seed, self.wavefront_size())
            return other

        def seed(self, seed: Any, wavefront_size: int = _WORD) -> None:
            mi.Sampler.seed(self, seed, wavefront_size)
            self.run_seed = seed
            given = int(seed[0]) if hasattr(seed, "__len__") else int(seed)
            of_image = given if jit else self.image_seed
            self._prepare(of_image)
            if jit:
                lane = dr.arange(mi.UInt32, wavefront_size)
                self.index = lane % mi.UInt32(self.sample_count())
                pixel = lane // mi.UInt32(self.sample_count())
            else:  # the number of a pixel
                self.index, pixel = 0, given
            self.domain = _domain_of_pixel(self.base_seed << 32 | of_image, pixel)
            self.use = dr.zeros(mi.UInt32, wavefront_size) if jit else 0

        def _prepare(self, seed: int) -> None:
            """Makes the sets of points, again for each seed: independent images have independent sets."""
            key = (self.sample_count(), seed)
            if self.pattern == OWEN_SOBOL or self._key == key:
                return
            if jit:
                self.xs, self.ys = map(mi.UInt32, self._make(*key))
            else:
                with _making:
                    if key not in self._made:
                        made = tuple(column.tolist() for column in self._make(*key))
                        self._made.clear()
                        self._made[key] = made
                    self.xs, self.ys = self._made[key]
            self._key = key

        def _make(self, n: int, seed: int) -> Tuple[npt.NDArray[np.uint32], npt.NDArray[np.uint32]]:
            first = _words((self.base_seed & _WORD, seed), _FOR_POINT, (0, 0), 0)
            start = first[0] << 31  # room for the seeds of the sets
            points = np.concatenate([generate(self.pattern, n, 2, start + s) for s in range(self.sets)])
            fractions = np.floor(points * 2.0 ** 32).astype(np.uint32)
            return fractions[:, 0].copy(), fractions[:, 1].copy()

        def advance(self) -> None:
            if jit:
                raise UnsupportedError("koksma: samples_per_pass is not supported: the sampler takes all samples of a pixel in "
                                       "one pass; render several seeds and average them")
            self.index += 1
            self.use = 0

        def _next(self, active: Any) -> Tuple[Any, Any]:
            domain = _domain_of_use(self.domain, self.use)
            self.use = self.use + 1
            if self.pattern == OWEN_SOBOL:
                return _sobol_2d(domain, self.index)
            n, w = self.sample_count(), _words(domain, _FOR_SHUFFLE, (number(0), number(0)), 0)
            at = w[0] % self.sets * n
            if jit:
                at += mi.permute_kensler(self.index, n, w[1], active)
                return dr.gather(mi.UInt32, self.xs, at, active), dr.gather(mi.UInt32, self.ys, at, active)
            at += int(mi.permute_kensler(self.index, n, w[1]))
            return self.xs[at], self.ys[at]

        @staticmethod
        def _unit(fraction: Any) -> Any:
            """Down to a multiple of 2^-24, so that no number is 1."""
            return mi.Float(fraction >> 8) * 2.0 ** -24

        def next_1d(self, active: Any = True) -> Any:
            return self._unit(self._next(active)[0])

        def next_2d(self, active: Any = True) -> Any:
            x, y = self._next(active)
            return mi.Point2f(self._unit(x), self._unit(y))

        def schedule_state(self) -> None:
            if jit:
                dr.schedule(self.index, self.use, self.domain)

        def to_string(self) -> str:
            return f"KoksmaSampler[pattern = {self.pattern}, sample_count = {self.sample_count()}]"

    return KoksmaSampler


def _hand_over_seeds() -> None:
    """Scalar variants: Integrator.render gives our sampler the image's seed, and Mitsuba the seed 0 (above)."""
    plain = mi.Integrator.render
    ours = _classes[mi.variant()]
    rendering: List[Any] = []  # samplers of renders that are under way

    @functools.wraps(plain)
    def render(self: Any, scene: Any, sensor: Any = 0, seed: Any = 0, *arguments: Any, **options: Any) -> Any:
        sampler = (scene.sensors()[sensor] if isinstance(sensor, int) else sensor).sampler()
        if not isinstance(sampler, ours) or any(other is sampler for other in rendering):  # integrators in Python come here again, with seed 0
            return plain(self, scene, sensor, seed, *arguments, **options)
        sampler.image_seed = int(seed) & _WORD
        rendering.append(sampler)
        try:
            return plain(self, scene, sensor, 0, *arguments, **options)
        finally:
            rendering.remove(sampler)

    mi.Integrator.render = render


def register(name: str = "koksma") -> None:
    """Registers the sampler plug-in for the variant that is set. Call it again after mi.set_variant.

    Its properties are `pattern`, any pattern of Koksma in two dimensions ("sobol:scramble=hash-owen,shuffle=1" when left
    out), `sample_count`, `seed` (0 to 2**32 - 1) and `sets` (1024 when left out), the number of different sets of points
    that pixels and uses choose from. One wavefront takes all samples of a pixel: samples_per_pass is refused.
    """
    variant = mi.variant()
    if variant is None:
        raise ArgumentError("no variant of Mitsuba is set: call mi.set_variant(\"llvm_ad_rgb\") before")
    if variant not in _classes:
        _classes[variant] = _sampler_class(variant)
        if not dr.is_jit_v(mi.Float):
            _hand_over_seeds()
    mi.register_sampler(name, _classes[variant])


# ---- Rankings ------------------------------------------------------------------------------------------------------

_BLOCK = 32  # the side of Mitsuba's largest blocks of pixels, if the integrator has no block_size
_KEPT = 16  # scenes that a Renderer keeps: one for each sampler, as a round of a ranking goes through them all
OWN = ("independent", "stratified", "multijitter", "orthogonal", "ldsampler")  #: Mitsuba's own samplers


def _canonical(pattern: str) -> str:
    """A pattern's spec; of a name that is like none of ours the message says which ones Mitsuba has. It is short: `koksma rank`
    shows the first 207 characters of a line."""
    try:
        return canonical(pattern)
    except Error as error:
        if str(error).startswith("no pattern") and "did you mean" not in str(error):
            raise ArgumentError(f"no sampler {quoted(pattern)}: Mitsuba has {', '.join(OWN)}; koksma.patterns() ours") from None
        raise


class Renderer:
    """Renders a scene of Mitsuba with the samplers that koksma.rank asks for: Mitsuba's own by their names, Koksma's
    patterns by their specs. An ending "*F" (as in "jittered*0.8") multiplies the number of samples, for rankings at equal
    time.

    scene: the path of an XML file, or a dict as for mi.load_dict.
    """

    def __init__(self, scene: Union[str, "os.PathLike[str]", Dict[str, Any]]) -> None:
        if not hasattr(mi, "parser"):
            raise UnsupportedError(f"Mitsuba {mi.__version__}: koksma.mitsuba needs 3.7 or later, whose parser lets samplers be replaced")
        register()
        self.scene: Union[str, Dict[str, Any]] = scene if isinstance(scene, dict) else os.fspath(scene)
        self._loaded: Dict[Any, Any] = {}
        self._blocks: Tuple[int, int] = (_BLOCK, 1)  # an integrator's block_size, and passes over a picture at most

    def load(self, pattern: str, spp: int, size: Optional[Tuple[int, int]] = None) -> Any:
        """The scene with a sampler of its sensors, and with a size of its films, other than in its file."""
        key = (pattern, spp, size)
        if key not in self._loaded:
            config = mi.parser.ParserConfig(mi.variant())
            given = isinstance(self.scene, dict)
            state = mi.parser.parse_dict(config, self.scene) if given else mi.parser.parse_file(config, self.scene)
            mi.parser.transform_all(config, state)
            self._set(state, pattern, spp, size)
            self._blocks = self._blocks_of(state, spp)
            scenes = mi.parser.instantiate(config, state)
            while len(self._loaded) >= _KEPT:  # scenes are large
                del self._loaded[next(iter(self._loaded))]
            self._loaded[key] = scenes[0] if isinstance(scenes, list) else scenes
        return self._loaded[key]

    @staticmethod
    def _set(state: Any, pattern: str, spp: int, size: Optional[Tuple[int, int]]) -> None:
        sampler = mi.Properties("koksma" if pattern not in OWN else pattern)
        sampler["sample_count"] = spp
        if pattern not in OWN:
            sampler["pattern"] = _canonical(pattern)
        node = mi.parser.SceneNode()
        node.type, node.props = mi.ObjectType.Sampler, sampler
        state.nodes.append(node)
        place = mi.Properties.ResolvedReference(len(state.nodes) - 1)
        for node in state.nodes:
            if node.type == mi.ObjectType.Sensor:
                for name in list(node.props.keys()):  # not references(), which lacks those without a name of an XML file
                    if node.props.type(name) == mi.Properties.Type.ResolvedReference \
                            and state.nodes[node.props[name].index()].type == mi.ObjectType.Sampler:
                        del node.props[name]
                node.props["sampler"] = place
            elif node.type == mi.ObjectType.Film and size:
                node.props["width"], node.props["height"] = size

    @staticmethod
    def _blocks_of(state: Any, spp: int) -> Tuple[int, int]:
        side, passes = _BLOCK, 1
        for node in state.nodes:
            if node.type == mi.ObjectType.Integrator:
                side = max(side, int(node.props.get("block_size", 0)))
                passes = max(passes, -(-spp // (int(node.props.get("samples_per_pass", spp)) or spp)))
        return 1 << (side - 1).bit_length(), passes

    def _spread(self, scene: Any, seed: int) -> int:
        """The seed for one of Mitsuba's own samplers in a scalar variant: a multiple, by which the numbers of the pixels of
        one seed, those of whole blocks, end before those of the next begin. Odd, so that no two seeds meet modulo 2^32."""
        (width, height), (side, passes) = map(int, scene.sensors()[0].film().crop_size()), self._blocks
        numbers = (width + side - 1) * (height + side - 1) * passes
        return seed * (-(-numbers // (width * height)) | 1) & _WORD

    def __call__(self, asked: Asked) -> npt.NDArray[np.float32]:
        pattern, star, factor = asked.pattern.partition("*")
        spp = max(1, round(asked.spp * float(factor))) if star else asked.spp
        try:
            scene, seed = self.load(pattern, spp, asked.size), asked.seed
            if pattern in OWN and not dr.is_jit_v(mi.Float):
                seed = self._spread(scene, seed)
            image = np.array(mi.render(scene, spp=spp, seed=seed), dtype=np.float32)
        except RuntimeError as error:  # Dr.Jit's around the sampler's own
            reason: Optional[BaseException] = error
            while reason is not None and not isinstance(reason, (ArgumentError, UnsupportedError)):
                reason = reason.__cause__
            raise error if reason is None else reason
        return image[:, :, :3] if image.shape[2] >= 3 else image[:, :, :1]


def rank(scene: Union[str, "os.PathLike[str]", Dict[str, Any]], patterns: Sequence[str], spp: SupportsIndex = 16, *,
         size: Optional[Tuple[SupportsIndex, SupportsIndex]] = None, time_limit: Optional[float] = 60,
         max_trials: SupportsIndex = 4096, reference: str = "independent", metric: str = "mae") -> Ranking:
    """Ranks samplers by the error (`metric`, by default the mean absolute one in luminance) that they leave in a scene of Mitsuba: koksma.rank, with its statistics,
    over pictures of Mitsuba.

    patterns: Mitsuba's own samplers ("independent", "multijitter" ...) and Koksma's patterns. Those of Koksma that cannot
    make spp samples are left out. Mitsuba's round the number up where it does not suit them (and say so): choose a power
    of 4, which suits all.
    """
    name = os.fspath(scene) if not isinstance(scene, dict) else "a scene of Mitsuba"
    return _rank(name, patterns, spp, size=size, time_limit=time_limit, max_trials=max_trials, reference=reference,
                 metric=metric, renderer=Renderer(scene))


def times(scene: Union[str, "os.PathLike[str]", Dict[str, Any]], patterns: Sequence[str], spp: int = 16, *,
          size: Optional[Tuple[int, int]] = None, repeats: int = 5,
          clock: Callable[[], float] = time.perf_counter) -> List[float]:
    """The seconds of a picture by each sampler, the least of several after a first one, for rankings at equal time:
    "NAME*F" in a ranking is a sampler with F times the samples. Samplers take turns, so that a change of the machine's speed
    meets all of them. clock: time.process_time counts those of all threads, where other programs take turns with this one."""
    renderer = Renderer(scene)
    taken: List[List[float]] = [[] for _ in patterns]
    for first in range(0, len(patterns), _KEPT):  # so many scenes stay loaded
        for seed in range(repeats + 1):
            for i, pattern in list(enumerate(patterns))[first:first + _KEPT]:
                start = clock()
                renderer(Asked("", pattern, spp, size, seed))
                taken[i].append(clock() - start)
    return [min(seconds[1:]) for seconds in taken]


def _main(arguments: List[str]) -> int:
    """`python3 -m koksma.mitsuba SCENE SAMPLER SPP SEED WIDTH HEIGHT OUT` renders one picture; width and height 0: the
    scene's own. It is what `koksma rank --with mitsuba` runs. KOKSMA_MITSUBA_VARIANT names another variant than llvm_ad_rgb."""
    import sys

    if len(arguments) != 7:
        print("usage: python3 -m koksma.mitsuba SCENE SAMPLER SPP SEED WIDTH HEIGHT OUT", file=sys.stderr)
        return 2
    scene, pattern, spp, seed, width, height, out = arguments
    size = (int(width), int(height)) if int(width) else None
    try:
        mi.set_variant(os.environ.get("KOKSMA_MITSUBA_VARIANT", "llvm_ad_rgb"))
        pixels = Renderer(scene)(Asked(scene, pattern, int(spp), size, int(seed)))
        mi.util.write_bitmap(out, pixels, write_async=False)
    except (Error, ImportError, RuntimeError) as error:  # rank shows the last line
        print(f"koksma.mitsuba: {' '.join(str(error).split())}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    import sys

    sys.exit(_main(sys.argv[1:]))
