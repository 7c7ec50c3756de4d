"""A run of a study: its tables, its statistics, its figures."""

from __future__ import annotations

import html
import json
from pathlib import Path
from typing import Any

from pirca import _native
from pirca.command import ask
from pirca.figure import Figure, figure, figures
from pirca.table import Table

__all__ = ["Run"]


class Run:
    """A run that has ended, read from its folder. `study.run()` gives one; `pirca.Run("runs/NAME")` opens one that is there.

    Raises `pirca.RunError` of a folder that holds none, one that was stopped, or one of another version.

    Attributes
    ----------
    out : pathlib.Path
        The folder.
    text : str
        What `pirca run` prints of it; empty of a run that was opened.
    """

    def __init__(self, out: str | Path, text: str = "") -> None:
        self.out = Path(out)
        self.text = text
        _native.holds_run(self.out)

    @property
    def members(self) -> Table:
        """A row for each wall and stiffness: what was drawn, how it ended, what was observed (`members.parquet`)."""
        return Table(self.out / "members.parquet")

    @property
    def steps(self) -> Table:
        """A row for each load step of each wall (`steps.parquet`)."""
        return Table(self.out / "steps.parquet")

    @property
    def summary(self) -> dict[str, Any]:
        """Statistics with their 95 % intervals, by arm and stiffness (`summary.json`)."""
        summary: dict[str, Any] = json.loads((self.out / "summary.json").read_text(encoding="utf-8"))
        return summary

    @property
    def figures(self) -> list[str]:
        """Names of the figures."""
        return figures(self.out)

    def figure(self, name: str | None = None) -> Figure:
        """A figure by its name (see `figures`), or the first one."""
        return figure(self.out, name)

    def report(self, out: str | Path | None = None, *, study: str | Path | None = None, progress: bool = False) -> Path:
        """Write the page of the run, one HTML file, and give its path.

        Parameters
        ----------
        out : path, optional
            File to write; `report.html` in the folder of the run without it.
        study : path, optional
            Folder of the study, where it does not lie any more where it was run from.
        progress : bool
            Say on standard error how far it is.
        """
        answered = ask("report", self.out, out=out, study=study, progress=progress)
        assert answered.out is not None, "a report is a file"
        return answered.out

    def __repr__(self) -> str:
        return f"<Run {self.out}: {len(self.members)} walls>"

    def _repr_html_(self) -> str:
        text = f"<pre>{html.escape(self.text)}</pre>" if self.text else f"<p>{html.escape(repr(self))}</p>"
        return text + "".join(self.figure(name).svg for name in self.figures[:1])
