"""Walls of one's own: from arrays, meshes or files to the load at which they fall."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from pirca.answer import Answer
from pirca.command import ask, warn
from pirca.errors import UsageError
from pirca.wall import Block, Wall

__all__ = ["Analysis", "analyse"]

#: A number, a range (low, high) of it, or a text as "normal(34,2)".
Known = float | tuple[float, float] | str
#: Density (kg/m3) of blocks that come without one, as of objects of an OBJ file.
DENSITY = 2400.0
#: Name of the file that blocks are handed over in.
FILE = "wall.json"


class Analysis(Answer):
    """How a wall falls: a mapping of what `pirca analyse --json` prints, with its main entries at hand."""

    @property
    def outcome(self) -> str:
        """How it ended: "collapsed", "stable", "unstable_at_rest", ..."""
        return str(self["outcome"])

    @property
    def collapse_angle_deg(self) -> float | None:
        """Tilt at which it falls (deg), if it is tilted."""
        angle: float | None = self.get("collapse_angle_deg")
        return angle

    @property
    def multiplier(self) -> float | None:
        """Horizontal load over the weight at which it falls, if it is pushed."""
        multiplier: float | None = self.get("multiplier")
        return multiplier

    @property
    def collapse_multiplier(self) -> float | None:
        """The same of either load; of a tilt its tangent."""
        multiplier: float | None = self.get("collapse_multiplier")
        return multiplier

    @property
    def undecided(self) -> Mapping[str, Any] | None:
        """What rigid blocks leave open: "lower", "upper" (in "unit") and the "reason"; None where the answer is one number."""
        undecided: Mapping[str, Any] | None = self.get("undecided")
        return undecided

    @property
    def moves(self) -> list[int]:
        """Ids of the blocks that move at collapse; none of a wall that was shaken, whose `fallen` says what fell when."""
        return list(self.get("mechanism", ()))


def analyse(
    wall: Any,
    *,
    phi_deg: Known | None = None,
    demand: str | None = None,
    verify: str | Path | None = None,
    fixed: Collection[int] = (),
    density_kg_per_m3: float | Sequence[float] | None = None,
    unit: str | None = None,
    solver: str = "limit",
    load: str = "tilt",
    direction: str | float | None = None,
    worst_direction: bool = False,
    vertical: float | None = None,
    dead_load: Mapping[int, float] | None = None,
    settle: Mapping[int, float] | None = None,
    fill_density: float | None = None,
    fill_phi_deg: float | None = None,
    wall_friction: float | None = None,
    fill_slope_deg: float | None = None,
    surcharge_pa: float | None = None,
    undrained: bool = False,
    pressure_pa: float | None = None,
    base_over_top: float | None = None,
    crest_force: float | None = None,
    crest_at: str | None = None,
    crest_line: float | None = None,
    crest_down_deg: float | None = None,
    kn: Known | None = None,
    ks: float | None = None,
    cohesion: float | None = None,
    flow: str | None = None,
    step_deg: float | None = None,
    touch_tolerance: float | str | None = None,
    flatness: str | None = None,
    mend: str | None = None,
    parts: bool = False,
    thickness: str | None = None,
    pixel: str | None = None,
    width: str | None = None,
    section: bool = False,
    scan_bearing: str | None = None,
    up: str | None = None,
    density: Known | None = None,
    walls: int | None = None,
    seed: int | None = None,
    colour: str | None = None,
    fclib: str | Path | None = None,
    at_deg: float | None = None,
    record: str | Path | list[str | Path] | None = None,
    scale: float | list[float] | None = None,
    restitution: float | None = None,
    lean_deg: float | None = None,
    lean_direction: str | float | None = None,
    once: bool = False,
    rayleigh: tuple[float, float, float] | None = None,
    time_step: float | None = None,
    study: str | Path | None = None,
    out: str | Path | None = None,
    report: bool = False,
    progress: bool = False,
) -> Analysis:
    """Say at which tilt or horizontal load a wall falls, as `pirca analyse`.

    Parameters
    ----------
    wall : path, Wall, or list of blocks
        A file or a folder that `pirca analyse` reads; a `pirca.Wall`; or convex blocks, each a pair (vertices, faces), a
        trimesh or COMPAS mesh (anything with `vertices` and `faces`, or `to_vertices_and_faces()`), a `pirca.Block`, or a
        mapping as in `wall.json`. They are numbered from 0 in the order of the list, or by their own ids. Axes: z up.
    phi_deg : float, (low, high) or str
        Friction angle of the joints (deg), or what is known of it: a range, or "normal(34,2)". Default: 25 to 38, the range of
        published joints of stone.
    demand : str, optional
        What the wall must bear, with its unit: "0.15g", "8.5deg". `answer["demand"]` says whether it does.
    verify : path, optional
        The file with a code, the ground and the place by which the wall's mechanism is checked. `answer["verification"]` has the checks.
    fixed : collection of int
        Ids of the blocks that are supports; of a file, besides those that it says are.
    density_kg_per_m3 : float or list of float, optional
        Density of all blocks, or of each; of an OBJ file, of the objects that have none. 2400 with a warning without it.
    unit : {"m", "cm", "mm"}, optional
        Unit of the coordinates of blocks, or of an OBJ file; "m" without it.
    solver : {"limit", "implicit", "explicit", "nonsmooth"}
        Limit analysis of rigid blocks, elastic joints, which need `kn`, or contact dynamics of rigid blocks.
    load : {"tilt", "lateral", "base-motion", "fill", "water", "pressure", "point"}
        Gravity turns towards the direction, a multiple of the weight pushes there, the ground moves as `record` says, fill or water
        rises behind the wall, or a pressure on its back or a load on its crest grows.
    direction : str or float, optional
        "x+", "x-", "y+", "y-", or an angle (deg) from x+ seen from above; "y+" without it.
    dead_load, settle : dict, optional
        Weights (N) on blocks, and ways (m) that supports go down, by the id of the block.
    fill_density, fill_phi_deg, wall_friction, fill_slope_deg, surcharge_pa, undrained : optional
        The fill of `load="fill"`: density (kg/m^3), friction angle (deg), its share on the back of the wall, slope of the surface
        (deg), weight on it (Pa), and whether water stands in it.
    pressure_pa, base_over_top : float, optional
        Of `load="pressure"`: the mean pressure (Pa), and that at the base over that at the top.
    crest_force, crest_at, crest_line, crest_down_deg : optional
        Of `load="point"`: a force (N) and where it acts ("1.2m"), or a force per length (N/m), and by how much it points down (deg).
    kn, ks : optional
        Normal and shear stiffness of the joints per area (Pa/m); ks is kn / 2 without it.
    worst_direction, vertical, cohesion, flow, step_deg, touch_tolerance, flatness, mend, parts, thickness
        As the options of `pirca analyse`; see its help.
    pixel, width, section, scan_bearing, up
        As the options of `pirca analyse`; see its help.
    density, walls, seed, colour
        As those options as well.
    fclib : path, optional
        File for the contact problem of one step, at the tilt `at_deg`: as the option of `pirca analyse`.
    record : path or list of paths, optional
        Record of the ground's motion, for `load="base-motion"`: PEER .AT2, ESM, ITACA or K-NET ASCII, COSMOS or CSMIP V2,
        or CSV with units in its heads. Several, or several scales, make a table of runs.
    scale : float or list of float, optional
        Factor on the records; 1 without it.
    restitution : float, optional
        Share of the closing speed with which joints of contact dynamics part again; 0 without it.
    lean_deg : float, optional
        Lean of the ground (deg), towards `lean_direction`, or `direction` without it.
    lean_direction : str or float, optional
        The side towards which a leaning ground is lower, as `direction`.
    once : bool
        Leave out the second run, which starts 1e-9 m/s off rest.
    rayleigh : (float, float, float), optional
        Rayleigh damping of the explicit solver: share of critical, and two frequencies (Hz) at which it is so. Without it
        stones that swing in their joints are damped by half of critical, in proportion to stiffness alone; (0, 1, 10) is no damping.
    time_step : float, optional
        Time step of contact dynamics under a base motion (s); 0.002 without it.
    study : path, optional
        Folder for the same question as a study, with a copy of the wall: `Study(study)` then has capacity, sensitivity and the like.
    out : path, optional
        Folder for a page of it all, the picture of the mechanism, files for ParaView, tables of blocks and joints, and the blocks
        themselves (`wall.json`).
    report : bool
        Write the page alone, as `<wall>-report.html` here; with `out` it is in that folder anyway.
    progress : bool
        Say on standard error how far it is.

    Raises
    ------
    pirca.InputError
        With everything that is wrong with the blocks.
    """
    options: dict[str, Any] = {
        "phi_deg": phi_deg,
        "demand": demand,
        "verify": verify,
        "solver": solver,
        "load": load,
        "direction": direction,
        "worst_direction": worst_direction,
        "vertical": vertical,
        "dead_load": dead_load,
        "settle": settle,
        "fill_density": fill_density,
        "fill_phi_deg": fill_phi_deg,
        "wall_friction": wall_friction,
        "fill_slope_deg": fill_slope_deg,
        "surcharge_pa": surcharge_pa,
        "undrained": undrained,
        "pressure_pa": pressure_pa,
        "base_over_top": base_over_top,
        "crest_force": crest_force,
        "crest_at": crest_at,
        "crest_line": crest_line,
        "crest_down_deg": crest_down_deg,
        "kn": kn,
        "ks": ks,
        "cohesion": cohesion,
        "flow": flow,
        "step_deg": step_deg,
        "touch_tolerance": touch_tolerance,
        "flatness": flatness,
        "mend": mend,
        "parts": parts,
        "thickness": thickness,
        "pixel": pixel,
        "width": width,
        "section": section,
        "scan_bearing": scan_bearing,
        "up": up,
        "density": density,
        "walls": walls,
        "seed": seed,
        "colour": colour,
        "fclib": fclib,
        "at_deg": at_deg,
        "record": record,
        "scale": scale,
        "restitution": restitution,
        "lean_deg": lean_deg,
        "lean_direction": lean_direction,
        "once": once,
        "rayleigh": None if rayleigh is None else ",".join(map(str, rayleigh)),
        "time_step": time_step,
        "study": study,
        "out": out,
        "report": report,
        "progress": progress,
    }
    of_file: dict[str, Any] = {"unit": unit, "density_kg_per_m3": density_kg_per_m3}
    is_whole = isinstance(wall, (str, Path, Wall))
    if is_whole and fixed:
        options["fixed"] = ",".join(str(block) for block in fixed)
    if isinstance(wall, (str, Path)):
        return Analysis(ask("analyse", wall, **options, **of_file))
    if isinstance(wall, Wall):
        # Refused as of a file of that kind, which states both itself.
        options, text = {**options, **of_file}, wall.json
    else:
        text = _written(wall, set(fixed), density_kg_per_m3, unit or "m")
    if out is not None:
        # The file stays, so that the command can be given again.
        Path(out).mkdir(parents=True, exist_ok=True)
        file = Path(out) / FILE
        file.write_text(text, encoding="utf-8")
        return Analysis(ask("analyse", file, **options))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / FILE
        file.write_text(text, encoding="utf-8")
        return Analysis(ask("analyse", file, **options))


def _written(blocks: Iterable[Any], fixed: set[int], densities: float | Sequence[float] | None, unit: str) -> str:
    """Blocks as `wall.json`."""
    entries = [_entry(block, number) for number, block in enumerate(blocks)]
    unknown = fixed - {entry["id"] for entry in entries}
    if unknown:
        known = [entry["id"] for entry in entries]
        raise UsageError(f"fixed: there is no block {', '.join(map(str, sorted(unknown)))}; the blocks are {known}")
    if isinstance(densities, (Sequence, np.ndarray)) and len(densities) != len(entries):
        raise UsageError(
            f"density_kg_per_m3: {len(densities)} for {len(entries)} blocks; give one for each, or one for all"
        )
    given = [None] * len(entries) if densities is None else np.broadcast_to(densities, len(entries)).tolist()
    for entry, density in zip(entries, given):
        if entry["id"] in fixed:
            entry["fixed"] = True
        if density is not None:
            entry["density"] = density
    lack = [entry for entry in entries if "density" not in entry and not entry.get("fixed")]
    if lack:
        warn(f"{len(lack)} blocks have no density: {DENSITY:.0f} kg/m3 is taken; give density_kg_per_m3")
    for entry in lack:
        entry["density"] = DENSITY
    return json.dumps({"unit": unit, "blocks": entries})


def _entry(block: Any, number: int) -> dict[str, Any]:
    """A block as `wall.json` has it."""
    if isinstance(block, Mapping):
        own = {"id": number, **block}
        return {**own, "vertices": _points(own.get("vertices"), number), "faces": _faces(own.get("faces"), number)}
    if isinstance(block, Block):
        own = {"density": block.density, "fixed": block.fixed, "tag": block.tag}
        own |= {} if block.group is None else {"group": block.group}
        own |= {} if block.scan is None else {"scan": block.scan}
        return {"id": block.id, "vertices": block.vertices.tolist(), "faces": _faces(block.faces, number), **own}
    if hasattr(block, "to_vertices_and_faces"):
        vertices, faces = block.to_vertices_and_faces()
    elif hasattr(block, "vertices") and hasattr(block, "faces"):
        vertices, faces = block.vertices, block.faces
    elif isinstance(block, Sequence) and len(block) == 2:
        vertices, faces = block
    else:
        raise UsageError(
            f"block {number}: (vertices, faces), a mesh with vertices and faces, or a mapping is needed, and {type(block)} is none"
        )
    return {"id": number, "vertices": _points(vertices, number), "faces": _faces(faces, number)}


def _points(vertices: Any, number: int) -> list[list[float]]:
    points = np.asarray(vertices, dtype=float)
    if points.ndim != 2 or points.shape[1] != 3:
        raise UsageError(f"block {number}: the vertices are an array of shape {points.shape}; (n, 3) is needed")
    return [[float(x) for x in point] for point in points]


def _faces(faces: Any, number: int) -> list[list[int]]:
    try:
        return [[int(corner) for corner in face] for face in faces]
    except (TypeError, ValueError) as wrong:
        raise UsageError(f"block {number}: each face is a list of the indices of its corners: {wrong}") from wrong
