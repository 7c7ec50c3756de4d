"""Figures that a notebook shows."""

from __future__ import annotations

from pathlib import Path

from pirca.errors import RunError

__all__ = ["Figure", "figure", "figures"]


class Figure:
    """A figure as SVG. A notebook shows it; `figure.save("name.svg")` keeps it.

    Attributes
    ----------
    svg : str
        The figure.
    path : pathlib.Path
        The file that it was read from.
    """

    def __init__(self, path: Path) -> None:
        self.path = Path(path)
        self.svg = self.path.read_text(encoding="utf-8")

    def save(self, path: str | Path) -> Path:
        """Write it to a file of its own."""
        path = Path(path)
        path.write_text(self.svg, encoding="utf-8")
        return path

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"<Figure {self.path.name}>"


def figures(folder: Path) -> list[str]:
    """Names of the figures in a folder, without their ending."""
    return sorted(path.stem for path in folder.glob("*.svg"))


def figure(folder: Path | None, name: str | None) -> Figure:
    """The figure of that name in a folder, or the first one."""
    if folder is None:
        raise RunError("nothing was written, so there is no figure; name a folder with out=")
    known = figures(folder)
    if not known:
        raise RunError(f"{folder}: there is no figure")
    if name is not None and name not in known:
        raise RunError(f"{folder}: there is no figure {name}; there is {', '.join(known)}")
    return Figure(folder / f"{name or known[0]}.svg")
