"""A run from Python is the run of the command line, to the byte."""

import json

import pandas
import polars
import pyarrow
import pytest

import pirca

SAME = [
    "members.parquet",
    "steps.parquet",
    "summary.json",
    "manifest.json",
    "figure-10.svg",
    "figure-10.png",
    "figure-10.csv",
]


@pytest.fixture
def run(studies):
    return pirca.Study(studies / "joint-arrangement", members=2).run()


def test_the_files_are_those_of_the_command_line(studies, run, pirca_command):
    printed = pirca_command("run", studies / "joint-arrangement", "--members", 2, "--out", "theirs").stdout
    for name in SAME:
        assert (run.out / name).read_bytes() == (run.out.parent.parent / "theirs" / name).read_bytes(), name
    assert str(run.out) == "runs/joint-arrangement"
    assert run.text.replace("runs/joint-arrangement", "theirs") == printed
    ours, theirs = [
        json.loads((folder / "command.json").read_text()) for folder in (run.out, run.out.parent.parent / "theirs")
    ]
    assert ours["command"] == f"pirca run {studies / 'joint-arrangement'} --members=2"
    assert ours["study"] == theirs["study"]


def test_a_seed_and_a_solver_are_those_that_are_asked_for(studies, pirca_command):
    ours = pirca.Study(studies / "joint-arrangement", members=2, seed=5).run(solver="limit", out="ours")
    options = ["--members", 2, "--seed", 5, "--solver", "limit", "--out", "theirs"]
    pirca_command("run", studies / "joint-arrangement", *options)
    theirs = pirca.Run("theirs")
    assert ours.summary == theirs.summary
    assert (ours.summary["seed"], ours.out.name) == (5, "ours")


def test_keys_are_set_by_their_paths(studies, pirca_command):
    study = pirca.Study(studies / "joint-arrangement", members=2, **{"joint.phi_deg": 32, "study.seed": 7})
    ours = study.run(out="ours")
    options = ["--variant", "joint.phi_deg=32+study.seed=7", "--members", 2, "--out", "theirs"]
    pirca_command("run", studies / "joint-arrangement", *options)
    assert ours.summary == pirca.Run("theirs").summary
    with pytest.raises(pirca.InputError, match="joint.phi_deg = 95: allowed is"):
        pirca.Study(studies / "joint-arrangement", **{"joint.phi_deg": 95})


def test_tables_are_taken_by_polars_pandas_and_pyarrow(run):
    for table, file in [(run.members, "members.parquet"), (run.steps, "steps.parquet")]:
        theirs = polars.read_parquet(run.out / file)
        assert polars.DataFrame(table).equals(theirs, null_equal=True)
        assert table.to_polars().equals(theirs, null_equal=True)
        assert pyarrow.table(table).to_pydict() == theirs.to_dict(as_series=False)
        pandas.testing.assert_frame_equal(table.to_pandas(), pandas.read_parquet(run.out / file), check_dtype=False)
        assert (len(table), table.columns) == (theirs.height, theirs.columns)
    assert len(run.members) == 4 * 6, "two regular walls and two irregular ones at six stiffnesses"
    # A stream is used up by whoever takes it: each one gets its own.
    table = run.members
    assert polars.DataFrame(table).equals(polars.DataFrame(table))


def test_a_notebook_shows_figure_and_words(run):
    figure = run.figure()
    assert figure._repr_svg_().startswith("<svg") and "figure-10" in repr(figure)
    shown = run._repr_html_()
    assert "<svg" in shown and "joint-arrangement: 4 walls" in shown
    with pytest.raises(pirca.RunError, match="there is no figure none; there is figure-10"):
        run.figure("none")
    assert run.report().read_text(encoding="utf-8").lower().startswith("<!doctype html>")


def test_a_folder_without_a_run_is_refused_as_by_the_command_line(pirca_command, empty_folder):
    with pytest.raises(pirca.RunError) as refused:
        pirca.Run(empty_folder)
    assert pirca_command("report", empty_folder, code=1).stderr == f"error: {refused.value}\n"


def test_what_is_said_on_the_way_is_heard_only_if_asked_for(studies, capfd):
    study = pirca.Study(studies / "joint-arrangement", members=1)
    study.run(out="quiet")
    assert capfd.readouterr() == ("", "")
    study.run(out="loud", progress=True)
    said = capfd.readouterr()
    assert said.out == "" and "18/18 done, 0 failed" in said.err
