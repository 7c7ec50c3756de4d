"""A wall of one's own, in whatever form it comes, is answered as the command line answers its file."""

import json

import numpy as np
import pytest
import trimesh

import pirca


def box(low, high):
    """A box as (vertices, faces): z up, faces counter-clockwise seen from outside."""
    (x, y, z), (X, Y, Z) = low, high
    corners = [[x, y, z], [X, y, z], [X, Y, z], [x, Y, z], [x, y, Z], [X, y, Z], [X, Y, Z], [x, Y, Z]]
    faces = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    return np.array(corners, dtype=float), faces


TOWER = [
    ([-0.3, -0.2, -0.1], [0.3, 0.2, 0.0]),
    ([-0.2, -0.1, 0.0], [0.2, 0.1, 0.3]),
    ([-0.2, -0.1, 0.3], [0.2, 0.1, 0.6]),
]


def tower():
    return [box(low, high) for low, high in TOWER]


def mesh(low, high):
    """The same box as a mesh of triangles."""
    return trimesh.creation.box(bounds=[low, high])


class Compas:
    """A mesh as COMPAS has it: vertices and faces by a method alone."""

    def __init__(self, low, high):
        self._box = box(low, high)

    def to_vertices_and_faces(self):
        return self._box[0].tolist(), self._box[1]


def same(ours, theirs):
    """Whether two answers are the same but for the time that they took."""
    return {**ours, "seconds": 0} == {**theirs, "seconds": 0}


@pytest.fixture
def told(pirca_command):
    """What the command line says of the tower."""
    entries = [{"id": k, "vertices": v.tolist(), "faces": f} for k, (v, f) in enumerate(tower())]
    entries[0]["fixed"] = True
    for entry in entries[1:]:
        entry["density"] = 2400.0
    with open("tower.json", "w", encoding="utf-8") as file:
        json.dump({"unit": "m", "blocks": entries}, file)
    return lambda *options: json.loads(pirca_command("analyse", "tower.json", "--json", *options).stdout)


def test_blocks_of_every_kind_get_the_answer_of_their_file(told):
    theirs = told("--phi-deg", 35)
    kinds = {
        "arrays": tower(),
        "trimesh": [mesh(low, high) for low, high in TOWER],
        "COMPAS": [Compas(low, high) for low, high in TOWER],
        "mappings": [{"vertices": v, "faces": f} for v, f in tower()],
    }
    for kind, blocks in kinds.items():
        ours = pirca.analyse(blocks, phi_deg=35, fixed=[0], density_kg_per_m3=2400)
        assert ours.collapse_angle_deg == pytest.approx(np.degrees(np.arctan(1 / 3)), abs=1e-6), kind
        assert (ours.outcome, ours.moves) == ("collapsed", [1, 2]), kind
        if kind != "trimesh":
            # Its corners come in another order, which moves the last bits.
            assert same(ours, theirs), kind
        assert ours["collapse_multiplier"] == pytest.approx(theirs["collapse_multiplier"], rel=1e-9), kind
    assert same(pirca.analyse("tower.json", phi_deg=35), theirs)


def test_options_are_those_of_the_command_line(told):
    ours = pirca.analyse(
        tower(),
        phi_deg=35,
        fixed=[0],
        density_kg_per_m3=[2400, 2400, 2400],
        solver="implicit",
        kn=5e7,
        load="lateral",
        direction="x+",
        dead_load={2: 150.5},
    )
    options = [
        "--solver",
        "implicit",
        "--kn",
        "5e7",
        "--load",
        "lateral",
        "--direction",
        "x+",
        "--dead-load",
        "2=150.5",
    ]
    assert same(ours, told("--phi-deg", 35, *options))
    assert ours.multiplier > 0.3 and ours.collapse_angle_deg is None
    ranges = pirca.analyse(tower(), phi_deg=(10, 25), fixed=[0], density_kg_per_m3=2400, walls=32)
    assert same(ranges, told("--phi-deg", "10..25", "--walls", 32))
    assert "uncertain" in ranges


@pytest.mark.filterwarnings("ignore:.*gap")
def test_a_unit_scales_and_a_generated_wall_is_taken(told, studies):
    in_mm = [(1000 * vertices, faces) for vertices, faces in tower()]
    ours = pirca.analyse(in_mm, phi_deg=35, fixed=[0], density_kg_per_m3=2400, unit="mm")
    assert same(ours, told("--phi-deg", 35))
    wall = pirca.Study(studies / "tilting-block").wall(base=True)
    answer = pirca.analyse(wall, phi_deg=30)
    assert answer.outcome == "collapsed"
    assert same(answer, pirca.analyse(wall.save("wall.json"), phi_deg=30))
    assert same(answer, pirca.analyse(wall.blocks, phi_deg=30))


def test_files_and_figure_are_written_where_asked(empty_folder):
    answer = pirca.analyse(tower(), phi_deg=35, fixed=[0], density_kg_per_m3=2400, out="seen")
    assert answer.out == empty_folder.relative_to(empty_folder) / "seen"
    assert answer.figures == ["mechanism", "views"] and answer.figure()._repr_svg_().startswith("<svg")
    assert (answer.out / "report.html").is_file()
    # What was asked can be asked again.
    assert same(answer, pirca.analyse("seen/wall.json", phi_deg=35))
    with pytest.raises(pirca.RunError, match="name a folder with out="):
        pirca.analyse("seen/wall.json", phi_deg=35).figure()


def test_what_looks_wrong_is_a_warning_at_the_line_that_asked():
    with pytest.warns(UserWarning, match="2 blocks have no density: 2400 kg/m3") as warned:
        pirca.analyse(tower(), phi_deg=35, fixed=[0])
    assert warned[0].filename == __file__
    with pytest.warns(UserWarning, match="--kn and --ks do not matter") as warned:
        answer = pirca.analyse(tower(), phi_deg=35, fixed=[0], density_kg_per_m3=2400, kn=1e9)
    assert warned[0].filename == __file__ and len(answer.warnings) == 1


def test_blocks_that_make_no_wall_are_refused():
    def refused(error, match, blocks=None, **options):
        given = {"phi_deg": 35, "fixed": [0], "density_kg_per_m3": 2400, **options}
        with pytest.raises(error, match=match):
            pirca.analyse(tower() if blocks is None else blocks, **given)

    apart = tower()
    apart[2] = (apart[2][0] + [0, 0, 0.05], apart[2][1])
    refused(pirca.InputError, "floats free", apart)
    refused(pirca.InputError, "fixed", fixed=[])
    refused(pirca.UsageError, "fixed: there is no block 7", fixed=[7])
    refused(pirca.UsageError, "2 for 3 blocks", density_kg_per_m3=[1, 2])
    refused(pirca.UsageError, r"shape \(8, 2\)", [(np.zeros((8, 2)), [[0, 1, 2]])])
    refused(pirca.UsageError, "block 0: .*<class 'int'> is none", [1])
    refused(pirca.UsageError, "indices of its corners", [(np.zeros((8, 3)), [0, 1, 2])])
    refused(pirca.UsageError, "--kn PA_PER_M is required", solver="explicit")
    refused(pirca.UsageError, "allowed is a number from 0 to 89 degrees", phi_deg=95)
    refused(pirca.UsageError, r"a range is \(low, high\)", phi_deg=(30, 34, 38))


def test_blocks_of_a_file_are_fixed_besides_those_that_it_fixes(told):
    assert told("--phi-deg", 35)["mechanism"] == [1, 2]
    assert pirca.analyse("tower.json", phi_deg=35, fixed=[1]).moves == [2]
    with pytest.raises(pirca.InputError, match="no block with the id 7"):
        pirca.analyse("tower.json", phi_deg=35, fixed=[7])


def test_the_same_question_as_a_study_has_the_same_answer(empty_folder):
    alone = pirca.analyse(tower(), fixed=[0], phi_deg=35, density_kg_per_m3=2400, study="mine")
    summary = pirca.Study("mine").run(out="out").summary
    assert summary["arms"][0]["mean"] == pytest.approx(alone["collapse_angle_deg"], abs=1e-9)
