"""Questions are answered as by the command line."""

import json

import pandas
import polars
import pyarrow
import pytest
from conftest import ROOT

import pirca


@pytest.fixture
def told(pirca_command):
    def run(verb, study, *options, out):
        return json.loads(pirca_command(verb, study, *options, "--json", "--out", out).stdout)

    return run


def same_files(ours, theirs):
    """That two folders hold the same results, to the byte."""
    kinds = {".json", ".csv", ".svg", ".png", ".parquet"}
    names = sorted(
        path.name for path in ours.iterdir() if path.suffix in kinds and path.stem not in {"timing", "command"}
    )
    assert names, "nothing was written"
    for name in names:
        assert (ours / name).read_bytes() == (theirs / name).read_bytes(), name


def test_capacity(told, empty_folder):
    column = ROOT / "tests/peers/column"
    ours = pirca.Study(column, members=20).capacity(below_deg=25.5, out="ours")
    assert dict(ours) == told("capacity", column, "--members", 20, "--below-deg", 25.5, out="theirs")
    same_files(empty_folder / "ours", empty_folder / "theirs")
    assert "25.5" in ours.text and ours.text == str(ours) and "<pre>" in ours._repr_html_()
    assert ours.figure().svg.startswith("<svg")


def test_capacity_of_tested_specimens(studies, told, pirca_command):
    study = studies / "tilting-table"
    ours = pirca.Study(study).capacity(measured=True)
    assert dict(ours) == json.loads(pirca_command("capacity", study, "--measured", "--json").stdout)
    assert ours.out is None


def test_sensitivity(told, empty_folder):
    column = ROOT / "tests/peers/column"
    ours = pirca.Study(column, seed=3).sensitivity(points=32, out="ours")
    assert dict(ours) == told("sensitivity", column, "--seed", 3, "--points", 32, out="theirs")
    same_files(empty_folder / "ours", empty_folder / "theirs")


def test_compare(studies, told, empty_folder):
    ours = pirca.Study(studies / "joint-arrangement").compare(
        ["irregular", "continuous"], walls=40, same_within_m=1e-4, out="ours"
    )
    options = ["--arms", "irregular,continuous", "--walls", 40, "--same-within-m", 1e-4]
    assert dict(ours) == told("compare", studies / "joint-arrangement", *options, out="theirs")
    same_files(empty_folder / "ours", empty_folder / "theirs")


def test_plan_of_tests(told, empty_folder):
    column = ROOT / "tests/peers/column"
    ours = pirca.Study(column, members=20).plan_tests(6, cov=0.1, out="ours")
    theirs = told("plan-tests", column, "--members", 20, "--specimens", 6, "--cov", 0.1, out="theirs")
    assert dict(ours) == theirs
    same_files(empty_folder / "ours", empty_folder / "theirs")


def test_detectability(told, empty_folder, studies):
    towers = studies / "hidden-effects/example"
    ours = pirca.Study(towers).detectability(members=1, out="ours")
    assert dict(ours) == told("detectability", towers, "--members", 1, out="theirs")
    same_files(empty_folder / "ours", empty_folder / "theirs")


@pytest.mark.parametrize("verb", ["check", "init", "reference"])
def test_any_verb_gives_its_answer(verb, pirca_command, studies, empty_folder):
    table = studies / "tilting-table"
    files, options, typed = {
        "check": ([table], {}, ["check", table]),
        "init": (["wall-a"], {}, ["init", "wall-b"]),
        "reference": (["schema"], {"of": "published"}, ["reference", "schema", "--of", "published"]),
    }[verb]
    answer = pirca.ask(verb, *files, **options)
    assert answer.text.replace("wall-a", "wall-b") == pirca_command(*typed).stdout
    assert len(answer) > 0


def test_readings(told, empty_folder, studies):
    study = studies / "joint-arrangement"
    ours = pirca.Study(study, members=2).readings(departures=1, out="ours")
    assert dict(ours) == told("readings", study, "--members", 2, "--departures", 1, out="theirs")
    same_files(empty_folder / "ours", empty_folder / "theirs")
    with pytest.raises(pirca.UsageError, match="without a variant"):
        pirca.Study(study, variant="two-wythes").readings()


def test_homogenise_with_its_page(told, empty_folder, studies):
    study = studies / "homogenisation"
    ours = pirca.Study(study).homogenise(
        stones=[2], cells=2, arms=["random-heads"], directions=["none"], out="ours", report=True
    )
    options = ["--stones", "2", "--cells", 2, "--arms", "random-heads", "--directions", "none"]
    assert dict(ours) == told("homogenise", study, *options, out="theirs")
    same_files(empty_folder / "ours", empty_folder / "theirs")
    assert "as a plate" in (empty_folder / "ours" / "report.html").read_text()


@pytest.mark.slow
def test_a_measured_campaign_in_a_data_frame_gets_its_verdict(studies, told, empty_folder):
    study = studies / "tilting-table"
    readings = pandas.read_csv(study / "measured.csv", comment="#", dtype=str)
    ours = pirca.Study(study).diagnose(readings, build=False, gain=False, out="ours")
    theirs = told("diagnose", study, "--measured", "ours/measured.csv", "--no-build", "--no-gain", out="theirs")
    assert dict(ours) == theirs
    assert ours["measured"]["file"] == "measured.csv"


def test_a_table_of_any_kind_is_written_as_its_csv(studies, empty_folder):
    study = pirca.Study(studies / "tilting-table")
    columns = {"specimen": ["a", "b"], "family": ["CBL", "CBL"], "tilt_deg": ["2.5", None], "value": ["1.5", "20"]}
    for table in (columns, pandas.DataFrame(columns), polars.DataFrame(columns), pyarrow.table(columns)):
        file = study._file_of(table, "there")
        assert file.read_text() == "specimen,family,tilt_deg,value\na,CBL,2.5,1.5\nb,CBL,,20\n", type(table)
    assert study._file_of(columns, None) == (empty_folder / "runs/tilting-table-measured.csv").relative_to(empty_folder)
    with pytest.raises(pirca.UsageError, match="<class 'int'> is none"):
        study.diagnose(7)
    with pytest.raises(pirca.UsageError, match="not of the same length"):
        study.diagnose({"a": [1], "b": []})
    with pytest.raises(pirca.InputError, match="ours/measured.csv"):
        study.diagnose({"specimen": ["a"]}, out="ours")
