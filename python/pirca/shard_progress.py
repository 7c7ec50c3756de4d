"""How far the shards of a study are, in lines on standard error."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping
from typing import Any

__all__ = ["Lines"]

#: Seconds between two looks into the folder, at the least.
_SECONDS = 1.0
#: A look may take this share of the time: on a network file system it has to open every shard.
_SHARE = 0.05


class Lines:
    """A line whenever another hundredth of the walls is done, whoever did them: as the folder has them."""

    def __init__(self, name: str, status: Callable[[], Mapping[str, Any]]) -> None:
        self._name, self._status = name, status
        self._begun, self._before = time.monotonic(), _walls(status())
        self._next, self._said = self._begun, -1

    def begin(self, of: int, missing: int, workers: int) -> None:
        """Say what is to be done."""
        self._print(f"{missing} of {of} shards to compute, on {workers} {'worker' if workers == 1 else 'workers'}")

    def look(self, *, is_due: bool = False) -> None:
        """Look into the folder, if it is time to or due, and say what is new."""
        now = time.monotonic()
        if now < self._next and not is_due:
            return
        status = self._status()
        self._next = now + max(_SECONDS, (time.monotonic() - now) / _SHARE)
        done = _walls(status)
        hundredth = 100 * done // status["evaluations"] if status else self._said
        if hundredth > self._said:
            self._said = hundredth
            self._print(self._line(status, done, now - self._begun))

    def _print(self, line: str) -> None:
        print(f"{self._name}: {line}", file=sys.stderr)

    def _line(self, status: Mapping[str, Any], done: int, seconds: float) -> str:
        walls = f"{done}/{status['evaluations']} walls done, {status['complete']}/{status['shards']} shards"
        if done == self._before:
            return walls
        return f"{walls}, {_spoken(seconds / (done - self._before) * (status['evaluations'] - done))} left"


def _walls(status: Mapping[str, Any]) -> int:
    """Walls in complete shards and in those that are begun."""
    return sum(shard["walls"] for shard in status["begun"]) + status["evaluated"] if status else 0


def _spoken(seconds: float) -> str:
    """A time in the unit that it is best told in."""
    for unit, length in [("h", 3600), ("min", 60)]:
        if seconds >= 2 * length:
            return f"{seconds / length:.0f} {unit}"
    return f"{seconds:.0f} s"
