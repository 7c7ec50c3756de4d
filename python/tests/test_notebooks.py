"""The example notebooks run, in a folder of their own, and show what they promise."""

import shutil

import nbformat
import pytest
from conftest import ROOT
from nbclient import NotebookClient

EXAMPLES = ROOT / "python/examples"
#: What the outputs of each must hold.
SHOWN = {
    "survey_to_capacity": ["image/png", "image/svg+xml", "of walls lie below", "together", "apart"],
    "campaign_to_verdict": ["collapse_angle", "image/svg+xml", "written to verdict", "CBL"],
    "mesh_to_picture": ["image/svg+xml", "The wall collapses at a tilt of", "implicit solver"],
}


def test_all_of_them_are_tried():
    assert {path.stem for path in EXAMPLES.glob("*.ipynb")} == set(SHOWN)


#: Those that take a minute or more.
SLOW = {"survey_to_capacity", "campaign_to_verdict"}


@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.slow if name in SLOW else ()) for name in SHOWN])
def test_a_notebook_runs(name, empty_folder):
    shutil.copytree(EXAMPLES, empty_folder / "python/examples")
    (empty_folder / "studies").symlink_to(ROOT / "studies")
    (empty_folder / "distributions").symlink_to(ROOT / "distributions")
    book = nbformat.read(EXAMPLES / f"{name}.ipynb", as_version=4)
    nbformat.validate(book)
    assert not any(cell.get("outputs") for cell in book.cells), "stored without outputs"
    where = {"metadata": {"path": str(empty_folder / "python/examples")}}
    NotebookClient(book, timeout=120, resources=where).execute()
    shown = "\n".join(str(cell.get("outputs")) for cell in book.cells)
    for wanted in SHOWN[name]:
        assert wanted in shown, wanted
