"""From Python's arguments to those of the command line, which alone knows what is allowed."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Callable, Mapping
from numbers import Integral, Real
from pathlib import Path
from typing import Any, NamedTuple

from pirca import _native
from pirca.errors import UsageError

__all__ = ["Answered", "ask", "warn"]

_HERE = os.path.dirname(os.path.abspath(__file__))


class Answered(NamedTuple):
    """What a command answers: in words, as JSON, where its files are, and what looks wrong."""

    text: str
    json: str
    out: Path | None
    warnings: list[str]


def ask(
    verb: str, *files: Any, progress: bool = False, hear: Callable[[str], object] | None = None, **options: Any
) -> Answered:
    """Do what a verb does; options are those of the command line, with `_` for `-`. Warnings are Python's.

    What else it says is printed with `progress`, or goes to who is to `hear` it; what that raises stops the verb.
    """

    def said(line: str) -> None:
        if line.startswith("warning: "):
            warn(line.removeprefix("warning: "))
        elif hear:
            hear(line)
        elif progress:
            print(line, file=sys.stderr)

    named = [argument for name, value in options.items() for argument in _spelled(name, value)]
    answered = Answered(*_native.ask([verb, *map(_place, files), *named], said))
    for warning in answered.warnings:
        warn(warning)
    return answered


def warn(text: str) -> None:
    """A warning, of the line that called the package, however deep in it this is."""
    depth, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_HERE):
        depth, frame = depth + 1, frame.f_back
    warnings.warn(text, stacklevel=depth)


def _place(file: Any) -> str:
    """A path as it is typed: no option, whatever it begins with."""
    path = str(os.fspath(file))
    return os.path.join(".", path) if path.startswith("-") else path


def _spelled(name: str, value: Any) -> list[str]:
    """An option as it is typed: nothing for None and False, once for each item of a list and of a mapping."""
    option = "--" + name.replace("_", "-")
    if value is None or value is False:
        return []
    if value is True:
        return [option]
    if isinstance(value, Mapping):
        return [f"{option}={_said(key)}={_said(item)}" for key, item in value.items()]
    if isinstance(value, list):
        return [f"{option}={_said(item)}" for item in value]
    if isinstance(value, tuple):
        if len(value) != 2:
            raise UsageError(f"{name}: a range is (low, high), and {value!r} has {len(value)} values")
        return [f"{option}={_said(value[0])}..{_said(value[1])}"]
    return [f"{option}={_said(value)}"]


def _said(value: Any) -> str:
    """A number, a text or a path as the command line reads it, to the last bit."""
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Real):
        return repr(float(value))
    return str(os.fspath(value))
