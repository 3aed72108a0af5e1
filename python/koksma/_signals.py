# SPDX-License-Identifier: Apache-2.0
"""Signals while the library runs."""
from __future__ import annotations

import threading
from types import FrameType
from typing import Callable, Dict, List, Optional

# What signal wraps: it looks at all signals in 3 us, signal in 300, a call for 16 points takes 15.
import _signal  # type: ignore[import-not-found]

_ALL = sorted(_signal.valid_signals())


class Signals:
    """Keeps what the handlers of signals raise during a call, for the caller to raise when the library has returned.

    Python runs its handlers in the callback by which the library asks whether to go on, and ctypes drops what a
    callback raises. So during the call each of Python's handlers is replaced by this object, which runs it.
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
            if callable(handler):
                self._theirs[number] = handler
                _signal.signal(number, self)

    def give_back(self) -> None:
        """Puts back what take has replaced, also when that was interrupted. A handler that is back may raise here."""
        try:
            for number, handler in self._theirs.items():
                if _signal.getsignal(number) is self:  # a handler may have put another in its place
                    _signal.signal(number, handler)
        except BaseException:
            self.give_back()  # the rest
            raise
        finally:
            self._keeps = False  # whoever still has this object as a handler has the one that it replaced
