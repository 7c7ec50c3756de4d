"""Checks a .vtu file of a wall with VTK itself: cell types, number, orientation, convexity, data and total volume.

usage: check_vtu.py FILE.vtu CELLS VOLUME_M3      (needs the pip package `vtk`)

Exits with 1 and a message when the file is not what was expected.
"""

import sys

import vtk

# VTK sums volumes from its own triangulation in doubles; the expected volume comes as decimal text.
RELATIVE_TOLERANCE = 1e-9
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


def signed_volume(cell):
    """Volume from the faces' own order of points: negative when they are inside out."""
    total = 0.0
    for f in range(cell.GetNumberOfFaces()):
        points = cell.GetFace(f).GetPoints()
        corners = [points.GetPoint(i) for i in range(points.GetNumberOfPoints())]
        a = corners[0]
        for b, c in zip(corners[1:], corners[2:]):
            total += (
                a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
            ) / 6.0
    return total


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
        state = validator.Check(cell, 1e-7)
        if state != vtk.vtkCellValidator.Valid:
            fail(f"cell {i} is not valid: VTK's state {int(state)}")
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
