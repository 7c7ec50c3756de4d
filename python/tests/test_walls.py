"""Walls as arrays."""

import json
import sys

import numpy as np
import pytest

import pirca


def test_a_wall_is_the_one_that_generate_writes(studies, pirca_command):
    study = pirca.Study(studies / "joint-arrangement", variant="cut")
    wall = study.wall("irregular", 3, base=True)
    pirca_command(
        "wall",
        studies / "joint-arrangement",
        "--variant",
        "cut",
        "--arm",
        "irregular",
        "--member",
        3,
        "--with-base",
        "--out",
        "wall.json",
    )
    assert wall.json == open("wall.json", encoding="utf-8").read()
    entries = json.loads(wall.json)["blocks"]
    assert len(wall) == len(entries) and wall.blocks[-1].fixed
    for block, entry in zip(wall.blocks, entries):
        assert block.vertices.tolist() == entry["vertices"] and block.vertices.dtype == float
        assert [face.tolist() for face in block.faces] == entry["faces"]
        assert (block.id, block.density, block.fixed) == (entry["id"], entry["density"], entry["fixed"])


def test_faces_enclose_the_volume_of_the_stones(studies):
    wall = pirca.Study(studies / "joint-arrangement").wall(member=2)
    # By the divergence theorem, faces counter-clockwise seen from outside.
    a, b, c = (wall.vertices[wall.triangles[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0
    assert volume == pytest.approx(wall.drawn["volume_m3"], rel=1e-9)
    assert len(wall.faces) == len(wall.face_blocks)
    for face, block in zip(wall.faces, wall.face_blocks):
        own = wall.blocks[block].vertices
        assert all((own == wall.vertices[corner]).all(axis=1).any() for corner in face)


def test_a_wall_is_drawn(studies, empty_folder):
    pyvista = pytest.importorskip("pyvista")
    wall = pirca.Study(studies / "joint-arrangement").wall()
    mesh = wall.to_pyvista()
    assert mesh.n_cells == len(wall.faces) and mesh.volume == pytest.approx(wall.drawn["volume_m3"], rel=1e-6)
    wall.plot(off_screen=True, screenshot="wall.png", window_size=(400, 300))
    picture = pyvista.read("wall.png")
    assert np.ptp(np.asarray(picture.active_scalars)) > 100, "nothing but one colour"


def test_without_pyvista_it_is_said_what_to_install(studies, monkeypatch):
    wall = pirca.Study(studies / "joint-arrangement").wall()
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(ImportError, match="pip install pyvista"):
        wall.plot()
