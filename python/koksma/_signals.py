# SPDX-License-Identifier: Apache-2.0
"""Signals while the library runs."""
from __future__ import annotations

import ctypes
import os
import threading
from functools import lru_cache
from types import FrameType
from typing import Any, Callable, Dict, List, Optional

# What signal wraps: it looks at all signals in 3 us, signal in 300, a call takes 10.
import _signal  # type: ignore[import-not-found]

_ALL = sorted(_signal.valid_signals())

_Disposition = ctypes.c_char * 512  # room for a struct sigaction, whose members differ from system to system
_sigaction: Any = lambda *_: 0  # Windows has nothing to keep beside the handler
if os.name != "nt":
    _sigaction = ctypes.PyDLL(None).sigaction  # CDLL would let other threads of Python run between two calls
    _sigaction.argtypes = [ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p]
_c_handler = ctypes.pythonapi.PyOS_getsig  # what the system calls
_c_handler.argtypes, _c_handler.restype = [ctypes.c_int], ctypes.c_void_p


def _put(number: int, handler: object) -> None:
    """Python's handler of a signal, and nothing else: signal alone would also have the system call Python's, whatever
    it called before, and forget whether system calls go on after the signal (siginterrupt)."""
    before = _Disposition()
    _sigaction(number, None, before)
    try:
        _signal.signal(number, handler)
    finally:
        _sigaction(number, before, None)


@lru_cache(maxsize=None)
def _pythons() -> Optional[int]:
    """What the system calls for a signal that Python handles: found by one that nobody listens to. In the main
    thread only."""
    for number in reversed(_ALL):
        if _signal.getsignal(number) == _signal.SIG_DFL and not _c_handler(number):
            before = _Disposition()
            _sigaction(number, None, before)
            try:
                _signal.signal(number, lambda _number, _frame: None)
                return int(_c_handler(number))
            finally:
                _signal.signal(number, _signal.SIG_DFL)
                _sigaction(number, before, None)
    return None


class Signals:
    """Keeps what the handlers of signals raise during a call, for the caller to raise when the library has returned.

    Python runs its handlers in the callback by which the library asks whether to go on, and ctypes drops what a
    callback raises. So during the call each of Python's handlers is replaced by this object, which runs it. A signal
    whose handler in C is another's (the host's, where Python is a guest) stays as it is: Python's is not called.
    """

    def __init__(self) -> None:
        self.raised: List[BaseException] = []
        self._theirs: Dict[int, Callable[[int, Optional[FrameType]], object]] = {}
        self._keeps = True

    def __call__(self, number: int, frame: Optional[FrameType]) -> None:
        try:
            self._theirs[number](number, frame)
        except BaseException as error:
            if not self._keeps:
                raise
            self.raised.append(error)

    def take(self) -> None:
        """Begins to keep. Elsewhere than in the main thread Python runs no handlers, and lets nobody replace them."""
        if threading.current_thread() is not threading.main_thread():
            return
        for number, handler in zip(_ALL, map(_signal.getsignal, _ALL)):
            if callable(handler) and _c_handler(number) == _pythons():
                self._theirs[number] = handler
                _put(number, self)

    def give_back(self) -> None:
        """Puts back what take has replaced, also when that was interrupted. A handler that is back may raise here."""
        try:
            for number, handler in self._theirs.items():
                if _signal.getsignal(number) is self:  # a handler may have put another in its place
                    _put(number, handler)
        except BaseException:
            self.give_back()  # the rest
            raise
        finally:
            self._keeps = False  # whoever still has this object as a handler has the one that it replaced
