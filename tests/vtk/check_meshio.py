"""Checks .vtu files with meshio: the number of their cells, and the volume of each polyhedron by its faces.

usage: check_meshio.py CELLS FILE.vtu [FILE.vtu ...]      (needs the pip package `meshio`, see requirements.txt)

meshio 5.3.5 orders the data of polyhedra by their number of corners, and the cells by their first appearance: walls whose blocks have
different numbers of corners may not be readable for it. The walls of this check have boxes only.

Exits with 1 and a message when a file is not what was expected.
"""

import sys

import meshio
import numpy

# Volumes by the divergence theorem from the same corners; the file states its own as decimal text.
RELATIVE_TOLERANCE = 1e-9


def fail(message):
    print(f"check_meshio: {message}", file=sys.stderr)
    sys.exit(1)


def volume(points, faces):
    """Signed volume of a solid (m3), positive where its faces are counter-clockwise seen from outside."""
    total = 0.0
    for face in faces:
        a = points[face[0]]
        for b, c in zip(face[1:], face[2:]):
            total += numpy.dot(a, numpy.cross(points[b], points[c])) / 6.0
    return total


def main():
    if len(sys.argv) < 3:
        fail(__doc__.strip())
    cells = int(sys.argv[1])
    for path in sys.argv[2:]:
        mesh = meshio.read(path)
        found = sum(len(block.data) for block in mesh.cells)
        if found != cells:
            fail(f"{path}: {found} cells, expected {cells}")
        for name, arrays in mesh.cell_data.items():
            shapes = {array.shape[1:] for array in arrays}
            if shapes != {(3,) if name == "displacement" else ()}:
                fail(f"{path}: cell array {name} has entries of the shape {shapes}")
        for block, stated in zip(mesh.cells, mesh.cell_data.get("volume", [])):
            for faces, wanted in zip(block.data, stated):
                own = volume(mesh.points, faces)
                if abs(own - wanted) > RELATIVE_TOLERANCE * wanted:
                    fail(f"{path}: the faces of a cell enclose {own} m3, the file states {wanted} m3")
    print(f"check_meshio: {len(sys.argv) - 2} files of {cells} cells")


if __name__ == "__main__":
    main()
