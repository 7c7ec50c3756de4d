"""What a verb answers, in words and as a mapping."""

from __future__ import annotations

import html
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from pirca import command
from pirca.command import Answered
from pirca.figure import Figure, figure, figures

__all__ = ["Answer", "ask"]


class Answer(Mapping[str, Any]):
    """What a verb of the command line says.

    A mapping of what the command line prints with `--json`; `print(answer)` gives its words.

    Attributes
    ----------
    text : str
        The words.
    out : pathlib.Path or None
        The folder of the files that were written.
    warnings : list of str
        What looks wrong, where the command says it with the answer.
    """

    def __init__(self, answered: Answered) -> None:
        self.text: str = answered.text
        self.out: Path | None = answered.out
        self.warnings: list[str] = answered.warnings
        self._object: dict[str, Any] = json.loads(answered.json)

    @property
    def figures(self) -> list[str]:
        """Names of the figures that were written."""
        return figures(self.out) if self.out else []

    def figure(self, name: str | None = None) -> Figure:
        """A figure that was written: by its name (see `figures`), or the first one."""
        return figure(self.out, name)

    def __getitem__(self, key: str) -> Any:
        return self._object[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._object)

    def __len__(self) -> int:
        return len(self._object)

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        first = self.text.strip().splitlines()
        return f"<{type(self).__name__}: {first[0] if first else ''}>"

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"


def ask(verb: str, *files: Any, progress: bool = False, **options: Any) -> Answer:
    """Do what any verb of the command line does, as `pirca.ask("report", "runs/mine", cite=True)`.

    Parameters
    ----------
    verb : str
        The verb: "check", "init", "report", "reference", ...
    files
        What stands behind the verb without a name: the study, the folder of a run, a wall.
    progress : bool
        Print on standard error what the command says meanwhile.
    options
        Its options by name, with `_` for `-`: `members=30`; True for one without a value, a list for one that is given several times.
    """
    return Answer(command.ask(verb, *files, progress=progress, **options))
