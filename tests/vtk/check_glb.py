"""Checks the animation of a wall (.glb) with VTK's reader: its blocks, and that they move.

usage: check_glb.py FILE.glb BLOCKS      (needs the pip package `vtk`)

Exits with 1 and a message when the file is not what was expected.
"""

import sys

import vtk

# When the wall is shown at first (s).
FIRST = 0.0
# What moves by less than this (m, of walls of a metre or so) does not fall.
MOVES = 0.01


def fail(message):
    print(f"check_glb: {message}", file=sys.stderr)
    sys.exit(1)


def points(reader, time):
    """The corners of every mesh at a time, in metres and in the file's axes (y upwards)."""
    reader.UpdateTimeStep(time)
    leaves = reader.GetOutput().NewIterator()
    all_meshes = []
    while not leaves.IsDoneWithTraversal():
        mesh = leaves.GetCurrentDataObject()
        all_meshes.append([mesh.GetPoint(i) for i in range(mesh.GetNumberOfPoints())])
        leaves.GoToNextItem()
    return all_meshes


def reader_of(path):
    """A reader of the one animation of a file; what VTK complains of is a failure."""
    reader = vtk.vtkGLTFReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: fail(f"VTK reported an error or a warning while reading {path}"))
    reader.SetFileName(path)
    reader.SetFrameRate(10)
    reader.ApplyDeformationsToGeometryOn()
    reader.UpdateInformation()
    if reader.GetNumberOfAnimations() != 1:
        fail(f"{reader.GetNumberOfAnimations()} animations, expected 1")
    reader.EnableAnimation(0)
    reader.UpdateInformation()
    return reader


def main():
    if len(sys.argv) != 3:
        fail(__doc__.strip())
    path, blocks = sys.argv[1], int(sys.argv[2])
    reader = reader_of(path)
    built, fallen = points(reader, FIRST), points(reader, reader.GetAnimationDuration(0))
    if len(built) != blocks:
        fail(f"{len(built)} meshes, expected {blocks}")
    up = [point[1] for mesh in built for point in mesh]
    flat = [point[2] for mesh in built for point in mesh]
    furthest = max(
        sum((a - b) ** 2 for a, b in zip(p, q)) ** 0.5
        for one, other in zip(built, fallen)
        for p, q in zip(one, other)
    )
    if furthest < MOVES:
        fail(f"no corner moves by more than {furthest} m")
    print(
        f"check_glb: {blocks} blocks, {max(up) - min(up):.3g} m high, {max(flat) - min(flat):.3g} m deep; "
        f"the furthest corner moves by {furthest:.3g} m"
    )


if __name__ == "__main__":
    main()
