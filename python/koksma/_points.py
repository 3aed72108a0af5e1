# SPDX-License-Identifier: Apache-2.0
"""Points: generating, measuring, verifying, reading and writing. Arrays are the library's points themselves."""
from __future__ import annotations

import ctypes
import os
import weakref
from ctypes import byref
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Callable, Dict, Iterable, List, Optional, Sequence, SupportsIndex, Tuple, Union, cast, overload

import numpy as np
import numpy.typing as npt

from . import _structs as s
from ._frame import table
from ._library import (ArgumentError, MalformedError, allow_exec as allowing_exec, call, check, choice, core, flag, kept_spec,
                       one_of, quick, quoted, Seed, seed_of, spec, text, texts, warn, warn_of_one_set, whole)

PointArray = npt.NDArray[np.float64]
STRATIFIED, LATIN = 1 << 3, 1 << 4  # KOKSMA_CLAIM_STRATIFIED and so on
_SHORT_RANGE, _SHORT_SET = 1 << 18, 64  # coordinates made in 30 ms at most, and made or measured in 1 ms
_XS, _DOUBLE, _c_void_p = s.Points.xs.offset, np.dtype(np.float64), ctypes.c_void_p
_DATA = -(-20 // ctypes.sizeof(_c_void_p) - 2) * ctypes.sizeof(_c_void_p)  # in PyArrayInterface: 20 bytes, aligned, then shape, strides, data
_capsule_pointer = ctypes.pythonapi.PyCapsule_GetPointer
_capsule_pointer.argtypes, _capsule_pointer.restype = [ctypes.py_object, ctypes.c_char_p], _c_void_p
_NO_REAL_NUMBERS = (type(None), complex, np.complexfloating, np.datetime64, np.timedelta64, str, bytes)
_NO_COORDINATES = ("index", "idx", "id", "unnamed: 0", "weight", "weights", "seed", "trial")
_WITNESS_KINDS = ("none", "box", "half-plane", "disk")
_OF_SCIPY = {"CD": "l2-centered", "WD": "l2-wraparound", "MD": "l2-mixture", "L2-star": "l2-star"}
_CLAIMS = ("deterministic", "sequence", "any-n", "stratified", "latin", "unbiased", "exchangeable", "min-distance", "centred",
           "grid", "net2", "net2-prefixes", "net-prefixes", "oa2", "oa3", "fraction", "maximal", "lattice", "blue",
           "latin-prefixes", "independent", "pairs", "quadruples", "pairs-3", "quadruples-3", "classes",
           "lattice-prefixes", "dimension-prefixes")  # by their bits


@dataclass(frozen=True)
class Member:
    """A line of the table of patterns, measures or integrands.

    claims: what a pattern claims, as in <koksma/claims.def>; empty for others.
    """

    name: str
    title: str
    cite: str
    min_dim: int
    max_dim: int
    parameters: Tuple[str, ...]
    operand: str = ""  # what its text has after the colon, as PATH in "file:PATH"; "": parameters only
    claims: Tuple[str, ...] = ()


@dataclass(frozen=True)
class Named:
    """A line of one of the other tables."""

    name: str
    title: str
    cite: str


@dataclass(frozen=True)
class Witness:
    """The region where a supremum is reached: |count/n - volume| is the value.

    kind "box": sides lo[k] .. hi[k]; "half-plane": lo[0] x + lo[1] y <= hi[0]; "disk": centre lo, radius hi[0].
    closed: count takes the points on the boundary in.
    """

    kind: str
    closed: bool
    count: int
    volume: float
    lo: Tuple[float, ...]
    hi: Tuple[float, ...]

    def __str__(self) -> str:
        lo, hi = ([f"{x:.6g}" for x in side] for side in (self.lo, self.hi))
        region = {"box": " x ".join(map("..".join, zip(lo, hi))), "half-plane": f"({', '.join(lo)}) . x <= {hi[0]}",
                  "disk": f"around ({', '.join(lo)}) of radius {hi[0]}"}[self.kind]
        return f"{self.count} point{'s' * (self.count != 1)} in the {'closed' if self.closed else 'open'} {self.kind} {region}"


class Value(float):
    """What a measure says: a float, which compares, formats and computes as one, with the members below.

    Comparisons are those of the numbers: two Values are equal if their numbers are, whatever their witnesses.
    """

    __slots__ = ("_raw",)
    _raw: s.Value  # read when a member is asked for, which would be half of the time of a short call

    def __new__(cls, raw: s.Value) -> Value:
        value = float.__new__(cls, raw.value)
        value._raw = raw
        return value

    @property
    def value(self) -> float:
        """The number, as a plain float."""
        return float(self._raw.value)

    @property
    def square(self) -> float:
        """The square of the value where it is known to more digits than the value, as for the L2 family, else NaN."""
        return float(self._raw.square)

    @property
    def lower(self) -> float:
        """A certified lower bound; the value where it is exact, NaN for a sampled measure."""
        return float(self._raw.lower)

    @property
    def upper(self) -> float:
        """A certified upper bound, likewise."""
        return float(self._raw.upper)

    @property
    def standard_error(self) -> float:
        """That of a sampled measure, NaN for one sample; of other measures 0."""
        return float(self._raw.standard_error)

    @property
    def exact(self) -> bool:
        """Whether the value is exact, up to rounding."""
        return bool(self._raw.exact)

    @property
    def witness(self) -> Union[Witness, Any]:  # Any: who measures star need not ask
        """The region where a supremum is reached; None where a measure has none."""
        w = self._raw.witness
        lengths = {1: (w.dim, w.dim), 2: (w.dim, 1), 3: (2, 1)}.get(w.kind)
        return Witness(_WITNESS_KINDS[w.kind], w.closed, w.count, w.volume, tuple(w.lo[:lengths[0]]),
                       tuple(w.hi[:lengths[1]])) if lengths else None

    def __reduce__(self) -> Tuple[Any, ...]:
        return _value_from, (bytes(self._raw),)

    def __str__(self) -> str:
        return repr(self.value)

    def __repr__(self) -> str:
        parts = [f"{self.value:.6g}"]
        if not self.exact and self.lower < self.upper:
            parts.append(f"between {self.lower:.6g} and {self.upper:.6g}")
        if self.standard_error > 0:
            parts.append(f"standard error {self.standard_error:.2g}")
        if self.witness:
            parts.append(str(self.witness))
        return f"Value({', '.join(parts)})"

    def _repr_html_(self) -> str:
        rows: List[Tuple[str, Any]] = [("value", self.value)]
        if not self.exact and self.lower < self.upper:
            rows += [("at least", self.lower), ("at most", self.upper)]
        if self.standard_error > 0:
            rows.append(("standard error", self.standard_error))
        if self.witness:
            w = self.witness
            rows += [(f"witness: {'closed' if w.closed else 'open'} {w.kind}",
                      f"{', '.join(f'{x:.6g}' for x in w.lo)} to {', '.join(f'{x:.6g}' for x in w.hi)}"),
                     ("points in it", w.count), ("its volume", w.volume)]
        return table(("", "exact" if self.exact else "not exact"), rows)


def _value_from(raw: bytes) -> Value:
    return Value(s.Value.from_buffer_copy(raw))


@dataclass(frozen=True)
class Modifier:
    """What every pattern takes behind its own parameters, as in "file:set.txt,shift=1" (koksma.modifiers() names them)."""

    name: str
    title: str
    cite: str
    keeps: str
    measures: str


@dataclass(frozen=True)
class Finding:
    """A property of a set of points, and whether they have it (see `koksma verify --help`)."""

    property: str
    subject: str
    holds: bool
    value: float
    detail: str


@dataclass(frozen=True)
class Identity:
    """A statement of identify about where points come from (see `koksma identify --help`).

    relation: "equal", "reordered", "part", "shifted", "digital-shift", "digit-permutation", "linear-scramble",
    "nested-scramble", "lattice", "recurrence", "grid", "sequence", "stratified"; or "scaled", "rounded", "unknown".
    spec: a pattern that makes `what`, from index first on and with the seed; "" if there is none.
    names: whether the statement says where the points come from, as the relations before "scaled" do.
    """

    relation: str
    what: str
    spec: str
    first: int
    seed: int
    detail: str
    names: bool


def members(at: Any) -> List[Member]:
    """The members of a table of patterns, measures or integrands, by the function that returns member i."""
    members: List[Member] = []
    while at(len(members)):
        m = at(len(members)).contents
        names, i = [], 0
        while m.params and m.params[i].name:
            names.append(m.params[i].name.decode())
            i += 1
        claims = tuple(name for bit, name in enumerate(_CLAIMS) if getattr(m, "claims", 0) >> bit & 1)
        members.append(Member(m.name.decode(), m.title.decode(), m.cite.decode(), m.min_dim, m.max_dim, tuple(names),
                              (getattr(m, "operand", None) or b"").decode(), claims))
    return members


def named(at: Any) -> List[Named]:
    """The members of another table, by the function that returns member i."""
    found: List[Named] = []
    while at(len(found)):
        m = at(len(found)).contents
        found.append(Named(m.name.decode(), m.title.decode(), m.cite.decode()))
    return found


def warps() -> List[Named]:
    """All warps, in the table's order.

    Returns
    -------
    list of Named

    Examples
    --------
    >>> import koksma
    >>> koksma.warps()[0].name
    'concentric-disk'
    """
    return named(core().koksma_warp_at)


def patterns() -> List[Member]:
    """All patterns, in the table's order.

    Returns
    -------
    list of Member

    Examples
    --------
    >>> import koksma
    >>> [p.name for p in koksma.patterns() if "maximal" in p.claims]
    ['poisson-disk-maximal']
    """
    return members(core().koksma_pattern_at)


def modifiers() -> List[Modifier]:
    """All modifiers, in the order in which they are applied.

    Returns
    -------
    list of Modifier

    Examples
    --------
    >>> import koksma
    >>> "shift" in [m.name for m in koksma.modifiers()]
    True
    """
    at: Any = core().koksma_modifier_at
    found: List[Modifier] = []
    while at(len(found)):
        m = at(len(found)).contents
        found.append(Modifier(m.name.decode(), m.title.decode(), m.cite.decode(), m.keeps.decode(), m.measures.decode()))
    return found


def measures() -> List[Member]:
    """All measures, in the table's order.

    Returns
    -------
    list of Member

    Examples
    --------
    >>> import koksma
    >>> koksma.measures()[0].name
    'star'
    """
    return members(core().koksma_measure_at)


def view(array: PointArray) -> s.Points:
    """The array's own memory as the library's points; they hold no reference to it.

    The address is read from the struct of NumPy's array interface: array.ctypes and array.__array_interface__ run much
    more of Python, which takes 20 to 50 us where a call of the library has just used the processor's caches.
    """
    points = s.Points(*array.shape)
    interface = array.__array_struct__  # a capsule; it lives until the address has been read
    _c_void_p.from_buffer(points, _XS).value = _c_void_p.from_address(_capsule_pointer(interface, None) + _DATA).value
    return points


def has_masked(array: npt.NDArray[Any]) -> bool:
    """Whether values of an array are masked."""
    return bool(isinstance(array, np.ma.MaskedArray) and np.ma.is_masked(array))  # type: ignore[no-untyped-call, unused-ignore]


def as_points(points: npt.ArrayLike) -> PointArray:
    """A C-contiguous, aligned (n, dim) array of doubles; without a copy when it is one already.

    What NumPy would cut down to a real number without being asked (the imaginary part, a date, a mask) is refused.
    """
    if (type(points) is np.ndarray and points.dtype is _DOUBLE and points.ndim == 2 and points.flags.carray and points.size
            and not 4 <= 2 * points.shape[0] < points.shape[1]):
        return points
    try:
        given = np.asanyarray(points)
        kind, masked = given.dtype.kind, has_masked(given)
        refused = kind == "O" and any(isinstance(value, _NO_REAL_NUMBERS) for value in given.flat)
        array = np.ascontiguousarray(given, dtype=np.float64) if kind in "uifO" and not refused else given
    except (TypeError, ValueError, RuntimeError):  # the last of a tensor with a gradient
        raise ArgumentError(f"points must be an array of real numbers, not {quoted(points)}") from None
    if isinstance(points, (str, bytes)):
        raise ArgumentError(f"points must be an array, not the text {quoted(points)}; read(path) reads a file, generate(pattern, n) makes points")
    if kind not in "uifO":
        raise ArgumentError(f"points must be real numbers, not {given.dtype}")
    if refused:
        raise ArgumentError(f"points must be real numbers, not {quoted(points)}")
    if masked:
        raise ArgumentError("points must not have masked coordinates")
    for column in getattr(points, "columns", ()):  # of a frame
        if str(column).lower() in _NO_COORDINATES:
            warn(f"column {column!r} is taken as a coordinate; points[['x', 'y']] chooses columns")
    array = array if array.flags.aligned else array.copy()
    if given.ndim != 2 or 0 in array.shape:
        column = ("; x[:, None] has one dimension, x.reshape(-1, 2) two, and np.column_stack((x, y)) joins columns"
                  if given.ndim == 1 and len(given) > 1 else "")
        raise ArgumentError(f"points must be an array of shape (n, dim), with n and dim of at least 1, not {given.shape}{column}")
    if 2 <= array.shape[0] < array.shape[1] / 2 and array.shape[1] > 3:
        warn(f"{array.shape[0]} points in {array.shape[1]} dimensions; are rows and columns swapped?")
    return array


def doubt(points: PointArray, *told: str) -> None:
    """Warns of what looks like no coordinates in points that could be measured: the first remark of the library's, unless
    as_points or a result has told it."""
    c_points, room = view(points), ctypes.create_string_buffer(4096)
    core().koksma_points_oddities(byref(c_points), room, len(room))
    line = room.value.decode().partition("\n")[0]
    if line and not any(words in line for words in ("swapped", *told)):
        warn(line)


def numbers(name: str, values: npt.ArrayLike) -> PointArray:
    """An argument, or what a function of the caller's returned, as a C-contiguous array of doubles.

    As in as_points, nothing is cut down to real numbers: NumPy would drop imaginary parts with no more than a warning.
    """
    try:
        given = np.asanyarray(values)
        kind, masked = given.dtype.kind, has_masked(given)
        array = np.asarray(given, dtype=np.float64, order="C") if kind in "buifO" else None
    except (TypeError, ValueError, RuntimeError):
        raise TypeError(f"{name} must be numbers, not {quoted(values)}") from None
    if array is None:
        raise TypeError(f"{name} must be real numbers, not {given.dtype}")
    if kind == "O" and any(isinstance(value, _NO_REAL_NUMBERS) for value in given.flat):  # None would be NaN
        raise TypeError(f"{name} must be real numbers, not {quoted(values)}")
    if masked:
        raise TypeError(f"{name} must be numbers, without masked ones")
    return array


class _Memory:
    """Memory of the library's, as NumPy asks what is there."""

    __slots__ = ("__array_interface__", "__weakref__")


def shown(pointer: Any, *shape: int) -> npt.NDArray[Any]:
    """An array over the library's memory. (Not by np.ctypeslib.as_array: ctypes keeps a type of each shape for ever.)"""
    memory: Any = _Memory()
    memory.__array_interface__ = {"version": 3, "shape": shape, "typestr": np.dtype(pointer._type_).str,
                                  "data": (ctypes.addressof(pointer.contents), False)}
    return np.asarray(memory)


def adopt(points: s.Points) -> PointArray:
    """An array over memory that the library allocated, freed with the array."""
    return free_with(shown(points.xs, points.n, points.dim), core().koksma_points_fini, points)


def free_with(array: npt.NDArray[Any], fini: Callable[..., None], memory: ctypes.Structure) -> npt.NDArray[Any]:
    """The array that is shown; calls fini(memory) when it and its views are gone; never when Python ends, which may
    be before that."""
    weakref.finalize(array.base, fini, byref(memory)).atexit = False
    return array


def generate(pattern: str, n: Optional[SupportsIndex] = None, dim: Optional[SupportsIndex] = None,
             seed: Seed = 0, *, first: SupportsIndex = 0, threads: SupportsIndex = 0,
             out: Optional[PointArray] = None, allow_exec: bool = False,
             warp: Optional[str] = None, sets: Optional[SupportsIndex] = None, d: Optional[SupportsIndex] = None,
             rng: Seed = None) -> PointArray:
    """The points of a pattern, as an (n, dim) array in [0,1).

    Parameters
    ----------
    pattern : str
        A spec such as "n-rooks" or "poisson-disk:d=0.2"; koksma.patterns() has them all.
    n : int
        How many; may be left out for patterns that know it themselves ("file:PATH", "poisson-disk-maximal:d=0.1").
    dim : int
        2 where it is left out, but all that a file has where n is left out, too.
    seed : int, numpy.random.Generator, RandomState, SeedSequence or None
        0 to 2**64 - 1; 0, when left out, so that the same call gives the same points, and without scrambling unless the spec
        asks for it ("sobol:scramble=owen"). Of a generator a number is drawn; None: fresh entropy.
    first : int
        The number of the first point, of a sequence that has ranges (has_ranges): n points from there on.
    threads : int
        0: one for each processor. The points do not depend on it.
    out : ndarray, optional
        An aligned C-contiguous array of doubles of shape (n, dim) to fill, instead of a new one; n and dim may be left out,
        or are those of its shape.
    allow_exec : bool
        Run what "exec:PROGRAM" or "plugin:LIBRARY" names; allow_exec() is for other functions, and sets the time.
    warp : str, optional
        Maps the points of the square to a disk, triangle, hemisphere or sphere, as `warp_points` does; warps() has them all.
    sets : int, optional
        Makes so many sets in one call, with the seeds seed, seed + 1, ... (`measure` takes them all at once, too). Threads
        share the sets. Excludes first and warp; out has the shape (sets, n, dim).
    d, rng : optional
        Other names of dim and seed, as scipy has them.

    Returns
    -------
    ndarray of shape (n, dim); with warp (n, 2) or (n, 3); with sets (sets, n, dim)

    Raises
    ------
    ArgumentError
        The spec is wrong, or the pattern has no such set; the message says which n would do.
    MalformedError
        A file is malformed.
    ForbiddenError
        The pattern runs a program or shared library, which needs allow_exec=True.

    Notes
    -----
    Equal arguments give equal bits, and the same as `koksma generate`.

    Examples
    --------
    >>> import koksma
    >>> koksma.generate("sobol", 4)
    array([[0.  , 0.  ],
           [0.5 , 0.5 ],
           [0.25, 0.75],
           [0.75, 0.25]])
    """
    if d is not None or rng is not None:
        dim, seed = one_of("dim", dim, None, "d", d), one_of("seed", seed, 0, "rng", rng)
    given = seed is not None
    if type(seed) is not int or not 0 <= seed <= s.MAX_SEED:  # a short call does without a function
        seed = seed_of(seed)
    if sets is not None:
        if first or warp is not None:
            raise ArgumentError("sets excludes first and warp")
        return _generate_sets(pattern, n, dim, seed, whole("sets", sets, 1, s.MAX_COORDINATES), threads, out, flag("allow_exec", allow_exec))
    shape: Any = (n, 2 if dim is None else dim)
    if type(out) is np.ndarray and out.ndim == 2:
        shape = out.shape if (out.shape[0] if n is None else n, out.shape[1] if dim is None else dim) == out.shape else None
    elif out is not None:
        shape = None
    if (type(threads) is int and 0 <= threads <= s.MAX_INT and type(pattern) is str
            and type(allow_exec) is bool and warp is None and type(first) is int and first == 0
            and set(map(type, shape or ())) == {int} and (pattern, shape) in quick):
        quickly = _quick_points(pattern, shape, seed, threads, out)
        if quickly is not None:
            return quickly
    if flag("allow_exec", allow_exec):
        core().koksma_allow_exec(before := core().koksma_allow_exec(0))
        with allowing_exec(before if before > 0 else 60):  # the time of a block of allow_exec() remains
            return generate(pattern, n, dim, seed, first=first, threads=threads, out=out, warp=warp)
    if warp is not None:
        if out is not None:
            raise ArgumentError("warp excludes out: its points lie in another domain")
        found = find_warp(warp)
        return _warped(found, generate(pattern, n, 2 if dim is None else dim, seed, first=first, threads=threads))
    parsed = spec("pattern", pattern)
    if given and seed and core().koksma_has_one_set(byref(parsed)):
        warn_of_one_set(pattern)
    first = whole("first", first, 0, s.MAX_INDEX)
    dim = dim if dim is None else whole("dim", dim, 1, s.MAX_DIM)
    n = n if n is None else whole("n", n, 1, s.MAX_COORDINATES)
    if first and not (is_sequence(pattern) and has_ranges(pattern)):
        way = f"; generate(..., {first + n})[{first}:] has these points" if n is not None and is_sequence(pattern) else ""
        raise ArgumentError(f"{pattern}: first needs a sequence that has ranges (koksma.has_ranges){way}")
    if n is None and out is None:
        if first:
            raise ArgumentError("first needs n, the number of points")
        points = s.Points()
        known = dim or (0 if parsed.pattern.contents.operand else 2)
        try:
            call(core().koksma_generate_whole, byref(parsed), seed, known, byref(points), threads=threads, run_at=2)
        except BaseException:  # a signal's handler's, perhaps, when the points were there
            core().koksma_points_fini(byref(points))
            raise
        return adopt(points)
    if out is None:
        dim = dim or 2
        assert n is not None  # else the pattern has said it, above
        if n * dim > s.MAX_COORDINATES:
            raise ArgumentError(f"{n} points in {dim} dimensions: n times dim must be at most {s.MAX_COORDINATES}")
        out = np.zeros((n, dim))
    elif not (isinstance(out, np.ndarray) and out.dtype == np.float64 and out.ndim == 2 and out.flags.carray and out.size):
        raise ArgumentError("out must be a writable, aligned, C-contiguous array of doubles, of shape (n, dim)")
    elif out.shape != (n or out.shape[0], dim or out.shape[1]):
        raise ArgumentError(f"out has the shape {out.shape}, not ({n or out.shape[0]}, {dim or out.shape[1]})")
    points, member = view(out), parsed.pattern.contents
    short = not member.operand and out.size <= (
        _SHORT_RANGE if member.ranges else _SHORT_SET if member.claims & (STRATIFIED | LATIN) else 0)
    same = (pattern, out.shape) if not member.operand and (member.ranges or member.claims & (STRATIFIED | LATIN)) else None
    if first:
        call(core().koksma_generate_range, byref(parsed), seed, 0, first, byref(points), threads=threads, run_at=4, short=short)
    else:
        call(core().koksma_generate, byref(parsed), seed, byref(points), threads=threads, run_at=2, short=short, same=same)
    return out


def _generate_sets(pattern: str, n: Optional[SupportsIndex], dim: Optional[SupportsIndex], seed: int, sets: int,
                   threads: SupportsIndex, out: Optional[PointArray], allow_exec: bool) -> PointArray:
    if allow_exec:
        core().koksma_allow_exec(before := core().koksma_allow_exec(0))
        with allowing_exec(before if before > 0 else 60):
            return _generate_sets(pattern, n, dim, seed, sets, threads, out, False)
    parsed = spec("pattern", pattern)
    if out is None:
        if n is None:
            raise ArgumentError("sets needs n, the number of points of each set")
        axes = 2 if dim is None else whole("dim", dim, 1, s.MAX_DIM)
        out = np.zeros((sets, whole("n", n, 1, s.MAX_COORDINATES // (axes * sets)), axes))
    elif not (isinstance(out, np.ndarray) and out.dtype == np.float64 and out.ndim == 3 and out.flags.carray and out.size):
        raise ArgumentError("out must be a writable, aligned, C-contiguous array of doubles, of shape (sets, n, dim)")
    elif out.shape != (sets, out.shape[1] if n is None else n, out.shape[2] if dim is None else dim):
        raise ArgumentError(f"out has the shape {out.shape}, not that of sets, n and dim")
    if sets > 1 and core().koksma_has_one_set(byref(parsed)):
        warn_of_one_set(pattern)
    points = view(out.reshape(-1, out.shape[2]))
    call(core().koksma_generate_sets, byref(parsed), seed, sets, byref(points), threads=threads, run_at=3)
    return out


def find_warp(name: str) -> Any:
    """A warp of the library."""
    found = core().koksma_warp_find(text(name, "warp"))
    if not found:
        raise ArgumentError(f"no warp {quoted(name)}; koksma.warps() names them")
    return found


def _warped(warp: Any, points: PointArray) -> PointArray:
    c_points, mapped = view(points), s.Points()
    check(core().koksma_warp_points(warp, byref(c_points), byref(mapped)))
    return adopt(mapped)


def warp_points(points: npt.ArrayLike, warp: str) -> PointArray:
    """Maps points of the unit square to another domain, with areas in proportion.

    Parameters
    ----------
    points : array_like of shape (n, 2)
    warp : str
        Such as "concentric-disk" or "cosine-hemisphere"; warps() has them all.

    Returns
    -------
    ndarray of shape (n, 2), on a hemisphere or the sphere (n, 3)

    Examples
    --------
    >>> import koksma
    >>> koksma.warp_points([[0.5, 0.5], [1, 0.5]], "concentric-disk")
    array([[0., 0.],
           [1., 0.]])
    """
    return _warped(find_warp(warp), as_points(points))


def local_discrepancy(points: npt.ArrayLike, corner: npt.ArrayLike) -> float:
    """The fraction of the points in the box from the origin to a corner, minus the volume of the box.

    Parameters
    ----------
    points : array_like of shape (n, dim)
    corner : array_like of shape (dim,)
        In [0,1]. The box is half-open: a point with a coordinate of the corner is not counted.

    Returns
    -------
    float

    Examples
    --------
    >>> import koksma
    >>> koksma.local_discrepancy([[0.25, 0.25], [0.75, 0.75]], [0.5, 0.5])
    0.25
    """
    array, at = as_points(points), numbers("corner", corner)
    if at.shape != (array.shape[1],):
        raise ArgumentError(f"corner must have {array.shape[1]} coordinates, as the points have, not the shape {at.shape}")
    c_points, value = view(array), ctypes.c_double()
    check(core().koksma_local_discrepancy(byref(c_points), at.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), byref(value)))
    return value.value


@overload
def measure(points: npt.ArrayLike, measure: str = "star", *, warp: Optional[str] = None,  # type: ignore[overload-overlap, unused-ignore]
            threads: SupportsIndex = 0, time_limit: Optional[float] = None) -> Value: ...
@overload
def measure(points: npt.ArrayLike, measure: Sequence[str], *, warp: Optional[str] = None, threads: SupportsIndex = 0,
            time_limit: Optional[float] = None) -> Dict[str, Value]: ...
def measure(points: npt.ArrayLike, measure: Union[str, Sequence[str]] = "star", *, warp: Optional[str] = None,
            threads: SupportsIndex = 0, time_limit: Optional[float] = None) -> Union[Value, Dict[str, Value]]:
    """How uneven points in [0,1]^dim are; smaller is more even (of distances larger is).

    Parameters
    ----------
    points : array_like of shape (n, dim), or ndarray of shape (sets, n, dim)
        Of a stack of sets, which threads share, the result is an array of their values.
    measure : str or sequence of str
        A spec such as "star", "l2-star" or "disk:r=0.1"; measures() has them all. Of several the values come as a dict.
        The names of scipy.stats.qmc.discrepancy give its values: "CD", "WD" and "MD" are the squares of "l2-centered",
        "l2-wraparound" and "l2-mixture", "L2-star" is "l2-star" itself.
    warp : str, optional
        Measures the points mapped to another domain, such as "concentric-disk".
    threads : int
        0: one for each processor. The value does not depend on it.
    time_limit : float, optional
        In seconds, for each of star-lower, extreme, edge, disk and, from 3 dimensions on, star: one that is cut short gives
        bounds, and `exact` is False. Other measures ignore it. "disk" is so without a limit, too, after 2^28 point tests.

    Returns
    -------
    Value, or dict of Value; of a stack ndarray of shape (sets,), or dict of them

    Raises
    ------
    ArgumentError
        The spec is unknown, or does not take these dimensions, this number of points or their coordinates.

    Examples
    --------
    >>> import koksma
    >>> koksma.measure([[0.25, 0.25], [0.75, 0.75]], "star").value
    0.4375
    >>> sorted(koksma.measure(koksma.generate("sobol", 16), ["star", "l2-star"]))
    ['l2-star', 'star']
    """
    if isinstance(points, np.ndarray) and points.ndim == 3:
        # The types tell no stack from a set, and say what a set gives.
        return cast("Union[Value, Dict[str, Value]]", _measure_sets(points, measure, warp, threads, time_limit))
    if isinstance(measure, str):
        if (type(points) is np.ndarray and type(measure) is str and (measure, points.shape) in quick and type(threads) is int
                and 0 <= threads <= s.MAX_INT and warp is None and time_limit is None):
            value = _quick_value(points, measure, threads)
            if value is not None:
                return value
        array = as_points(points)
        found = _value_of(array, measure, warp=warp, threads=threads, time_limit=time_limit)
        doubt(array)
        return found
    names, array = texts("measure", measure), as_points(points)
    values = {name: _value_of(array, name, warp=warp, threads=threads, time_limit=time_limit) for name in names}
    doubt(array)
    return values


def _measure_sets(stack: PointArray, measure: Union[str, Sequence[str]], warp: Optional[str], threads: SupportsIndex,
                  time_limit: Optional[float]) -> Union[PointArray, Dict[str, PointArray]]:
    if not isinstance(measure, str):
        return {name: cast(PointArray, _measure_sets(stack, name, warp, threads, time_limit)) for name in texts("measure", measure)}
    if warp is not None:
        raise ArgumentError("warp takes one set, of shape (n, dim), not a stack")
    if 0 in stack.shape:
        raise ArgumentError(f"a stack must have the shape (sets, n, dim), with each at least 1, not {stack.shape}")
    squared, measure = measure in ("CD", "WD", "MD"), _OF_SCIPY.get(measure, measure)
    parsed, array, values = spec("measure", measure), as_points(stack.reshape(-1, stack.shape[2])), np.empty(stack.shape[0])
    points = view(array)
    call(core().koksma_evaluate_sets, byref(parsed), byref(points), len(values),
         values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), threads=threads, time_limit=time_limit, run_at=3)
    return values**2 if squared else values


def value_of(points: npt.ArrayLike, measure: str, *, warp: Optional[str] = None, threads: SupportsIndex = 0,
             time_limit: Optional[float] = None) -> Value:
    """One measure of one set."""
    array = as_points(points)
    parsed, value, c_points = spec("measure", measure), s.Value(), view(array)
    if warp is None:
        exact = parsed.measure.contents.answer == 0
        call(core().koksma_evaluate, byref(parsed), byref(c_points), byref(value), threads=threads,
             time_limit=time_limit, run_at=2, short=exact and ":" not in measure and array.size <= _SHORT_SET,
             same=(measure, array.shape) if exact else None)
    else:
        call(core().koksma_warp_evaluate, find_warp(warp), byref(parsed), byref(c_points), byref(value), threads=threads,
             time_limit=time_limit, run_at=3)
    return Value(value)


def _value_of(points: npt.ArrayLike, measure: str, **how: Any) -> Value:
    """Likewise, by the names of scipy.stats.qmc.discrepancy, too: "CD", "WD" and "MD" are squares."""
    scipys = _OF_SCIPY.get(measure) if isinstance(measure, str) else None
    if scipys is None or scipys == "l2-star":
        return value_of(points, scipys or measure, **how)
    raw = value_of(points, scipys, **how)._raw
    raw.value, raw.lower, raw.upper, raw.square = raw.square, raw.square, raw.square, np.nan
    return Value(raw)


@lru_cache(maxsize=None)
def _evaluate_array() -> Any:
    return core().koksma__evaluate_array


@lru_cache(maxsize=None)
def _generate_array() -> Any:
    return core().koksma__generate_array


def _quick_value(array: PointArray, measure: str, threads: int) -> Optional[Value]:
    """value_of where it was short before: one call of C. None: the long way serves."""
    parsed, raw = kept_spec("measure", measure), s.Value()
    if parsed is None:
        return None
    interface = array.__array_struct__  # a capsule, which owns the struct
    if _evaluate_array()(parsed, _capsule_pointer(interface, None), threads, raw):
        return None
    return Value(raw)


def _quick_points(pattern: str, shape: Tuple[int, ...], seed: int, threads: int, out: Optional[PointArray]) -> Optional[PointArray]:
    """generate where it was short before, likewise."""
    parsed = kept_spec("pattern", pattern)
    if parsed is None:
        return None
    array = np.zeros(shape) if out is None else out
    interface = array.__array_struct__
    if _generate_array()(parsed, seed, _capsule_pointer(interface, None), threads):
        return None
    return array


def verify(points: npt.ArrayLike, *, threads: SupportsIndex = 0) -> List[Finding]:
    """Which properties these points really have: nets, strata, distances, repeated points and more.

    Parameters
    ----------
    points : array_like of shape (n, dim)
    threads : int
        0: one for each processor.

    Returns
    -------
    list of Finding

    Examples
    --------
    >>> import koksma
    >>> found = koksma.verify(koksma.generate("n-rooks", 16))
    >>> all(f.holds for f in found if f.property == "latin")
    True
    """
    array = as_points(points)  # a copy, perhaps, which the name keeps
    c_points = view(array)
    findings = _findings(core().koksma_verify, byref(c_points), threads=threads, run_at=1)
    doubt(array, "equal earlier")
    return findings


def verify_sets(sets: Iterable[npt.ArrayLike], *, threads: SupportsIndex = 0) -> List[Finding]:
    """How the points of a random pattern are distributed: "unbiased", the mean share of the points in every box is its
    volume, and "uniform-samples", the first, second, fourth, ... and last point are each uniform.

    Parameters
    ----------
    sets : iterable of array_like of shape (n, dim)
        Independent sets of equal shapes, one for each seed; at least 32. A pattern that has a property fails it with a
        probability of at most .001; some 1,000 sets show a bias of one part in 20.
    threads : int
        0: one for each processor.

    Returns
    -------
    list of Finding
        The detail names the box where the evidence is strongest, and z, the difference in standard errors.

    Examples
    --------
    >>> import koksma
    >>> sets = [koksma.generate("half-jittered", 16, seed=seed) for seed in range(200)]
    >>> koksma.verify_sets(sets)[0].detail
    '[1/16,3/16) of coordinate 0: expected 0.125, mean share 0.25 in 200 sets, z = 14.1'
    """
    arrays = [as_points(points) for points in sets]
    c_sets = (s.Points * max(len(arrays), 1))(*map(view, arrays))
    return _findings(core().koksma_verify_sets, c_sets, len(arrays), threads=threads, run_at=2)


def identify(points: npt.ArrayLike, *, threads: SupportsIndex = 0) -> List[Identity]:
    """Which known points these are, or by which map they arise from them: sequences, lattices, patterns of this package.

    Parameters
    ----------
    points : array_like of shape (n, dim)
        Any finite coordinates: those outside [0,1) are taken for scaled ones.
    threads : int
        Up to this number is used by patterns that are tried; 0: one for each processor.

    Returns
    -------
    list of Identity
        The strongest statement first. Each was tested for every point.

    Examples
    --------
    >>> import koksma
    >>> points = koksma.generate("sobol", 69, 3)[5:]
    >>> found = koksma.identify(points)[0]
    >>> found.relation, found.what, found.first
    ('equal', "Sobol' (Joe & Kuo 2008, new-joe-kuo-6.21201)", 5)
    """
    identities = s.Identities()
    array = as_points(points)  # a copy, perhaps, which the name keeps
    c_points = view(array)
    try:
        call(core().koksma_identify, byref(c_points), byref(identities), threads=threads, run_at=1)
        doubt(array)
        return [Identity(i.relation.decode(), i.what.decode(), i.spec.decode(), i.first, i.seed, i.detail.decode(),
                         core().koksma_identity_names(byref(i))) for i in identities.items[:identities.count]]
    finally:
        core().koksma_identities_fini(byref(identities))


def _findings(function: Any, *arguments: Any, threads: SupportsIndex, run_at: int) -> List[Finding]:
    findings = s.Findings()
    try:
        call(function, *arguments, byref(findings), threads=threads, run_at=run_at)
        return [Finding(f.property.decode(), f.subject.decode(), f.holds, f.value, f.detail.decode())
                for f in findings.items[:findings.count]]
    finally:
        core().koksma_findings_fini(byref(findings))


def read(path: Union[str, "os.PathLike[str]"]) -> PointArray:
    """Reads points of [0,1]^dim, as measures take them.

    Parameters
    ----------
    path : str or path
        A .npy or text file, which its content tells.

    Returns
    -------
    ndarray of shape (n, dim)

    Examples
    --------
    >>> import koksma
    >>> koksma.write("points.txt", [[0.25, 0.75], [0.5, 0]])
    >>> koksma.read("points.txt")
    array([[0.25, 0.75],
           [0.5 , 0.  ]])
    """
    points = s.Points()
    check(core().koksma_points_read(text(path, "path"), byref(points)))
    return adopt(points)


def write(path: Union[str, "os.PathLike[str]"], points: npt.ArrayLike, comment: Optional[str] = None) -> None:
    """Writes points of [0,1]^dim, which `read` reads, whole or not at all. For those of a warp there is numpy.savetxt.

    Parameters
    ----------
    path : str or path
        Its ending says the format: .txt, .csv or .npy; without one it is text.
    points : array_like of shape (n, dim)
    comment : str, optional
        A line for the head of a text file.

    Examples
    --------
    >>> import koksma
    >>> koksma.write("points.npy", koksma.generate("sobol", 16))
    """
    array = as_points(points)
    c_points = view(array)
    ending = os.path.splitext(os.fsdecode(text(path, "path")))[1]
    if ending not in ("", ".txt", ".csv", ".npy"):
        raise ArgumentError(f"{quoted(path)}: its name must end in .txt, .csv or .npy")
    raw = None if comment is None else text(comment, "comment")
    call(core().koksma_points_write, text(path, "path"), byref(c_points), raw, run_at=3)


def is_sequence(pattern: str) -> bool:
    """Whether the first k of n points are the set of k points."""
    return bool(core().koksma_is_sequence(byref(spec("pattern", pattern))))


def has_ranges(pattern: str) -> bool:
    """Whether any range of a pattern's points is made in time and memory for that range.

    Parameters
    ----------
    pattern : str

    Returns
    -------
    bool

    Examples
    --------
    >>> import koksma
    >>> koksma.has_ranges("sobol:scramble=owen"), koksma.has_ranges("sample-elimination")
    (True, False)
    """
    return bool(core().koksma_has_ranges(byref(spec("pattern", pattern))))


def canonical(text_of_spec: str, kind: str = "pattern") -> str:
    """The canonical text of a spec, under which results are stored.

    Parameters
    ----------
    text_of_spec : str
    kind : {"pattern", "measure"}

    Returns
    -------
    str

    Examples
    --------
    >>> import koksma
    >>> koksma.canonical("poisson-disk:d=0.20")
    'poisson-disk:d=0.2'
    """
    choice("kind", kind, ("pattern", "measure"))
    parsed, room = spec(kind, text_of_spec), ctypes.create_string_buffer(s.MAX_SPEC)
    core().koksma_spec_text(byref(parsed), room)
    return os.fsdecode(room.value)  # it may have a path
