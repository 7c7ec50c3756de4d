from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

VERSION: str

def ask(arguments: Sequence[str], hear: Callable[[str], Any], /) -> tuple[str, str, Path | None, list[str]]:
    """Do what arguments of the command line ask: text, JSON, place of the files, warnings."""

def command_line(arguments: Sequence[str], /) -> int:
    """The command line itself, with the name of the program first: prints, and gives the exit code."""

def holds_run(folder: str | PathLike[str], /) -> None:
    """Raise what is wrong with a folder that should hold a run which has ended."""

def table(path: str | PathLike[str], /) -> tuple[list[str], int, Callable[[], Any]]:
    """Of a Parquet file the names of the columns, the number of rows, and what gives a capsule with an Arrow C stream."""
