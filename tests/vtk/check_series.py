"""Checks the replay of a wall with VTK: the series of its blocks and its joints, beside the OBJ files and the animation of the same.

usage: check_series.py FOLDER BLOCKS      (needs the pip package `vtk`)

Exits with 1 and a message when the files are not what was expected.
"""

import sys
import xml.etree.ElementTree
from pathlib import Path

import vtk

from check_glb import points as animated
from check_glb import reader_of
from check_vtu import fail, read, signed_volume

# Rigid blocks keep their volume; rounding of a turn.
RELATIVE_TOLERANCE = 1e-9
# OBJ and glTF are read in single precision (m, of walls of a metre or so).
SINGLE = 2e-6
# The last state of a fall is at least so far (m) from the first one.
FALLS = 0.05


def collection(path):
    """The files of a collection in the order of their times, which are their numbers."""
    sets = xml.etree.ElementTree.parse(path).getroot().find("Collection").findall("DataSet")
    times = [float(one.get("timestep")) for one in sets]
    if times != list(range(len(times))) or not times:
        fail(f"{path}: times are {times[:3]}..., expected 0, 1, 2, ...")
    return [path.parent / one.get("file") for one in sets]


def numbers(data, name):
    array = data.GetArray(name)
    if array is None:
        fail(f"no array {name}")
    return [array.GetValue(i) for i in range(array.GetNumberOfTuples())]


def warped(grid):
    """What the filter Warp By Vector makes of it, as ParaView calls it: by the vectors of its points."""
    grid.GetPointData().SetActiveVectors("displacement")
    warp = vtk.vtkWarpVector()
    warp.SetInputData(grid)
    warp.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "displacement")
    warp.Update()
    return warp.GetOutput()


def cells(grid):
    """The corners of every cell."""
    for i in range(grid.GetNumberOfCells()):
        corners = grid.GetCell(i).GetPoints()
        yield [corners.GetPoint(k) for k in range(corners.GetNumberOfPoints())]


def apart(one, other):
    return max(max(abs(a - b) for a, b in zip(p, q)) for p, q in zip(one, other))


def box(corners):
    return [(min(c[k] for c in corners), max(c[k] for c in corners)) for k in range(3)]


def obj_points(path):
    reader = vtk.vtkOBJReader()
    reader.SetFileName(str(path))
    reader.Update()
    # VTK may repeat or reorder points: they are compared as a set.
    output = reader.GetOutput()
    return sorted({tuple(round(x, 5) for x in output.GetPoint(i)) for i in range(output.GetNumberOfPoints())})


def check_walls(files, blocks):
    """The warped states of the blocks, and whether each is at rest."""
    states = []
    for file in files:
        grid = read(str(file))
        if grid.GetNumberOfCells() != blocks:
            fail(f"{file}: {grid.GetNumberOfCells()} cells, expected {blocks}")
        if numbers(grid.GetCellData(), "block") != list(range(blocks)):
            fail(f"{file}: the blocks are not numbered from 0")
        for name in ("tag", "held", "there", "density", "volume"):
            numbers(grid.GetCellData(), name)
        moved = warped(grid)
        for i, volume in enumerate(numbers(grid.GetCellData(), "volume")):
            own = signed_volume(moved.GetCell(i))
            if abs(own - volume) > RELATIVE_TOLERANCE * volume:
                fail(f"{file}: block {i} has {own} m3 when it is warped, and {volume} m3 as built")
        field = grid.GetFieldData()
        at_rest, there = numbers(field, "at_rest")[0], numbers(grid.GetCellData(), "there")
        numbers(field, "load")
        states.append((moved, at_rest == 1.0, there))
    rests = [rest for _, rest, _ in states]
    if rests != sorted(rests, reverse=True):
        fail("a wall that falls is at rest again")
    return states


def check_joints(files, walls, blocks):
    """Joints lie on the block that they go with; their numbers are in their bounds."""
    pressed = 0
    for file, (wall, _, _) in zip(files, walls):
        grid = read(str(file))
        data = grid.GetCellData()
        arrays = {name: numbers(data, name) for name in (
            "first", "second", "area", "opening", "slip", "normal_stress", "shear_stress", "state")}
        if any(x < 0.0 for name in ("area", "opening", "slip", "shear_stress") for x in arrays[name]):
            fail(f"{file}: a size is below 0")
        if not set(arrays["state"]) <= {0, 1, 2, 3} or not set(arrays["first"]) <= set(range(blocks)):
            fail(f"{file}: state {set(arrays['state'])}, first {set(arrays['first'])}")
        pressed += sum(1 for x in arrays["normal_stress"] if x > 0.0)
        solids = list(cells(wall))
        for first, corners in zip(arrays["first"], cells(warped(grid))):
            for (low, high), (least, most) in zip(box(solids[int(first)]), box(corners)):
                if least < low - 1e-3 or most > high + 1e-3:
                    fail(f"{file}: a joint lies outside of block {int(first)}, which it goes with")
    if pressed == 0:
        fail("no joint is pressed in any state")


def check_obj(path, state):
    moved, _, there = state
    corners = [c for cell, is_there in zip(cells(moved), there) if is_there for c in cell]
    wanted, found = sorted({tuple(round(x, 5) for x in c) for c in corners}), obj_points(path)
    # Rounding to five digits may go either way.
    if len(wanted) != len(found) and abs(len(wanted) - len(found)) > 2:
        fail(f"{path}: {len(found)} points, expected {len(wanted)}")
    for one in found:
        if min(apart([one], [other]) for other in wanted) > 2e-5:
            fail(f"{path}: no block has the point {one} in that state")


def check_animation(path, states):
    """The animation at its beginning and its end, block by block, beside the series. Its y points up."""
    reader = reader_of(str(path))
    last = 8.0 if sum(1 for _, rest, _ in states if rest) > 1 else 4.0
    if abs(reader.GetAnimationDuration(0) - last) > 1e-6:
        fail(f"{path}: the animation takes {reader.GetAnimationDuration(0)} s, expected {last}")
    for time, (moved, _, there) in ((0.0, states[0]), (last, states[-1])):
        for mesh, corners, is_there in zip(animated(reader, time), cells(moved), there):
            turned = box([(x, -z, y) for x, y, z in mesh])
            if is_there and apart(turned, box(corners)) > 10 * SINGLE:
                fail(f"{path}: at {time} s a block is at {turned}, the series has it at {box(corners)}")


def main():
    if len(sys.argv) != 3:
        fail(__doc__.strip())
    folder, blocks = Path(sys.argv[1]), int(sys.argv[2])
    files = {name: collection(folder / f"{name}.pvd") for name in ("wall", "joints")}
    if len(files["wall"]) != len(files["joints"]):
        fail("the collections have different numbers of states")
    states = check_walls(files["wall"], blocks)
    check_joints(files["joints"], states, blocks)
    first, last = list(cells(states[0][0])), list(cells(states[-1][0]))
    furthest = max(apart(p, q) for p, q, there in zip(first, last, states[-1][2]) if there)
    rests = [state for state in states if state[1]]
    if len(rests) == len(states) or furthest < FALLS:
        fail(f"the wall does not fall: no corner moves by more than {furthest} m")
    check_obj(folder / "rest.obj", rests[-1])
    check_obj(folder / "collapse.obj", states[-1])
    check_animation(folder / "wall.glb", states)
    print(f"check_series: {len(rests)} states at rest and {len(states) - len(rests)} of the fall; a corner moves by {furthest:.3g} m")


if __name__ == "__main__":
    main()
