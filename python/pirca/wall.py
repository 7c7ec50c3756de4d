"""Walls as arrays."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pyvista

__all__ = ["Block", "Wall"]


@dataclass(frozen=True, eq=False)
class Block:
    """A convex block.

    Attributes
    ----------
    id : int
        Its number in the wall.
    vertices : numpy.ndarray
        Corners (n, 3) in m: x along the wall, y out of plane (positive downhill), z up.
    faces : list of numpy.ndarray
        Corners of each face by their index, counter-clockwise seen from outside.
    density : float
        In kg/m3.
    fixed : bool
        Whether it is a support.
    tag : str
        What it is: "stone", "header", "wedge", "base", ...
    group : str or None
        The stone that it is a part of, where stones have several.
    scan : dict or None
        Volume, centroid and inertia of the stone itself, where the faces are those of the hull of its scan.
    """

    id: int
    vertices: np.ndarray
    faces: list[np.ndarray]
    density: float
    fixed: bool
    tag: str
    group: str | None = None
    scan: dict[str, Any] | None = None


class Wall:
    """A wall of a study, as it is built.

    Attributes
    ----------
    blocks : list of Block
        Its blocks.
    drawn : dict
        What the command line says of it: stones, wedges, headers, volume_m3, and what it took to draw it.
    json : str
        The wall as `wall.json`, which `pirca analyse` reads.
    """

    def __init__(self, text: str, drawn: dict[str, Any]) -> None:
        self.json = text
        self.drawn = drawn
        self.blocks = [_block(entry) for entry in json.loads(text)["blocks"]]

    @cached_property
    def vertices(self) -> np.ndarray:
        """Corners of all blocks (n, 3), in m, in the order of the blocks."""
        return np.concatenate([block.vertices for block in self.blocks])

    @cached_property
    def faces(self) -> list[np.ndarray]:
        """Faces of all blocks, by the index of their corners in `vertices`."""
        first = np.cumsum([0] + [len(block.vertices) for block in self.blocks])
        return [face + start for block, start in zip(self.blocks, first) for face in block.faces]

    @cached_property
    def face_blocks(self) -> np.ndarray:
        """The id of the block of each face (n,)."""
        return np.repeat([block.id for block in self.blocks], [len(block.faces) for block in self.blocks])

    @cached_property
    def triangles(self) -> np.ndarray:
        """The faces as triangles (n, 3): each convex face as a fan around its first corner."""
        return np.array([(face[0], b, c) for face in self.faces for b, c in zip(face[1:-1], face[2:])])

    def save(self, path: str | Path) -> Path:
        """Write it as `wall.json`."""
        path = Path(path)
        path.write_text(self.json, encoding="utf-8")
        return path

    def to_pyvista(self) -> pyvista.PolyData:
        """As a `pyvista.PolyData` whose cells have the ids of their blocks (`block`)."""
        try:
            import pyvista
        except ImportError as missing:
            raise ImportError("a wall is drawn by pyvista, which is not installed: pip install pyvista") from missing
        faces = np.concatenate([np.concatenate([[len(face)], face]) for face in self.faces])
        mesh = pyvista.PolyData(self.vertices, faces)
        mesh.cell_data["block"] = self.face_blocks
        return mesh

    def plot(self, **options: Any) -> Any:
        """Show it in 3D by pyvista, from the front (+y), with the edges of its stones.

        Options go to `pyvista.plot`: `off_screen=True, screenshot="wall.png"` writes a picture.
        """
        seen_from_the_front = (0.5, 1.5, 0.6)
        given = {"color": "whitesmoke", "show_edges": True, "edge_color": "dimgray", "cpos": seen_from_the_front}
        return self.to_pyvista().plot(**{**given, **options})

    def __len__(self) -> int:
        return len(self.blocks)

    def __repr__(self) -> str:
        return f"<Wall: arm {self.drawn['arm']}, member {self.drawn['member']}, {len(self)} blocks>"


def _block(entry: dict[str, Any]) -> Block:
    return Block(
        id=entry["id"],
        vertices=np.array(entry["vertices"], dtype=float),
        faces=[np.array(face, dtype=int) for face in entry["faces"]],
        density=entry["density"],
        fixed=entry["fixed"],
        tag=entry["tag"],
        group=entry.get("group"),
        scan=entry.get("scan"),
    )
