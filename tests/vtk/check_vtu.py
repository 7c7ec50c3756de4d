"""Checks a .vtu file of a wall with VTK itself: cell types, number, orientation, convexity, data and total volume.

usage: check_vtu.py FILE.vtu CELLS VOLUME_M3      (needs the pip package `vtk`)

Exits with 1 and a message when the file is not what was expected.
"""

import sys

import vtk

# VTK sums volumes from its own triangulation in doubles; the expected volume comes as decimal text.
RELATIVE_TOLERANCE = 1e-9
# Points may lie this far off their face (m).
LENGTH_TOLERANCE = 1e-7
# A flag of vtkCellValidator's set. VTK 9.7 raises it for triangular prisms whose ends are not square to their edges,
# which are convex; convexity is checked here instead.
NONCONVEX = 0x10
ARRAYS = {"block": 1, "tag": 1, "density": 1, "volume": 1}


def fail(message):
    print(f"check_vtu: {message}", file=sys.stderr)
    sys.exit(1)


def read(path):
    """The grid of a file; any error or warning that VTK reports while reading is a failure."""
    complaints = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append("error"))
    reader.AddObserver("WarningEvent", lambda *_: complaints.append("warning"))
    if not reader.CanReadFile(path):
        fail(f"VTK cannot read {path}")
    reader.SetFileName(path)
    reader.Update()
    if complaints:
        fail(f"VTK reported {len(complaints)} errors or warnings while reading {path}")
    return reader.GetOutput()


def minus(a, b):
    return [a[k] - b[k] for k in range(3)]


def dot(a, b):
    return sum(a[k] * b[k] for k in range(3))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def faces(cell):
    """The corners of every face, in the file's order."""
    for f in range(cell.GetNumberOfFaces()):
        points = cell.GetFace(f).GetPoints()
        yield [points.GetPoint(i) for i in range(points.GetNumberOfPoints())]


def signed_volume(cell):
    """Volume from the faces' own order of points: negative when they are inside out."""
    total = 0.0
    for a, *rest in faces(cell):
        for b, c in zip(rest, rest[1:]):
            total += dot(a, cross(b, c)) / 6.0
    return total


def farthest_outside(cell):
    """How far a point of the cell lies outside the plane of one of its faces (m); 0 or round-off when convex."""
    everywhere = [corner for face in faces(cell) for corner in face]
    farthest = 0.0
    for a, *rest in faces(cell):
        normal = [0.0, 0.0, 0.0]
        for b, c in zip(rest, rest[1:]):
            part = cross(minus(b, a), minus(c, a))
            normal = [normal[k] + part[k] for k in range(3)]
        length = dot(normal, normal) ** 0.5
        for point in everywhere:
            farthest = max(farthest, dot(normal, minus(point, a)) / length)
    return farthest


def vtk_volumes(grid):
    """Cell volumes by VTK's own filter."""
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.SetComputeVolume(True)
    sizes.Update()
    array = sizes.GetOutput().GetCellData().GetArray("Volume")
    return [array.GetValue(i) for i in range(array.GetNumberOfTuples())]


def close(a, b):
    return abs(a - b) <= RELATIVE_TOLERANCE * abs(b)


def main():
    if len(sys.argv) != 4:
        fail(__doc__.strip())
    path, cells, volume = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
    grid = read(path)
    if grid.GetNumberOfCells() != cells:
        fail(f"{grid.GetNumberOfCells()} cells, expected {cells}")
    data = grid.GetCellData()
    for name, components in ARRAYS.items():
        array = data.GetArray(name)
        if array is None or array.GetNumberOfTuples() != cells or array.GetNumberOfComponents() != components:
            fail(f"cell array {name} is missing or has the wrong shape")
    validator = vtk.vtkCellValidator()
    by_filter = vtk_volumes(grid)
    total = 0.0
    for i in range(cells):
        cell = grid.GetCell(i)
        if cell.GetCellType() != vtk.VTK_POLYHEDRON:
            fail(f"cell {i} has type {cell.GetCellType()}, expected {vtk.VTK_POLYHEDRON} (polyhedron)")
        state = int(validator.Check(cell, LENGTH_TOLERANCE)) & ~NONCONVEX
        if state != 0:
            fail(f"cell {i} is not valid: VTK's state {state:#x}")
        outside = farthest_outside(cell)
        if outside > LENGTH_TOLERANCE:
            fail(f"cell {i} is not convex: a point lies {outside} m outside a face")
        own, stated = signed_volume(cell), data.GetArray("volume").GetValue(i)
        if not close(own, stated):
            fail(f"cell {i}: its faces enclose {own} m3, the file states {stated} m3")
        if not close(by_filter[i], stated):
            fail(f"cell {i}: VTK finds {by_filter[i]} m3, the file states {stated} m3")
        total += own
    if not close(total, volume):
        fail(f"the cells fill {total} m3, expected {volume} m3")
    print(f"check_vtu: {cells} polyhedra, {total:.9g} m3")


if __name__ == "__main__":
    main()
