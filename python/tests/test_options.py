"""Every option of a verb is an argument in Python, by its name, and no other one."""

import inspect
import re

import pytest

import pirca
from pirca import Study, analyse

#: By verb: what is asked in Python; arguments of its own; options that are said otherwise: of the study, by what is answered (--assert
#: is for exit codes), by others.
VERBS = {
    "run": (Study.run, {"progress", "client", "shards"}, {"variant", "json", "members", "seed", "threads", "assert"}),
    "capacity": (
        Study.capacity,
        {"progress", "client", "shards"},
        {"variant", "json", "members", "seed", "threads", "batches", "assert"},
    ),
    "sensitivity": (Study.sensitivity, {"progress"}, {"variant", "json", "seed", "threads", "shard"}),
    "compare": (Study.compare, {"progress"}, {"variant", "json", "seed", "threads"}),
    "plan-tests": (Study.plan_tests, {"progress"}, {"variant", "json", "members", "seed", "threads"}),
    "detectability": (Study.detectability, {"progress"}, {"variant", "json", "threads"}),
    "readings": (Study.readings, {"progress"}, {"json", "members", "seed", "threads"}),
    "homogenise": (Study.homogenise, {"progress"}, {"variant", "json", "seed", "threads", "shard"}),
    "diagnose": (
        Study.diagnose,
        {"progress", "build", "gain"},
        {"variant", "json", "seed", "threads", "no_build", "no_gain", "prepare", "judged"},
    ),
    "analyse": (analyse, {"progress", "wall"}, {"json", "assert"}),
    "wall": (
        Study.wall,
        {"base"},
        {
            *("variant", "json", "members", "seed", "solved", "with_base", "out", "draw", "draws"),
            *("colour", "magnify", "frames", "series"),
        },
    ),
}


@pytest.mark.parametrize("verb", VERBS)
def test_arguments_are_the_options(verb, pirca_command):
    asked, own, otherwise = VERBS[verb]
    shown = pirca_command(verb, "--help").stdout
    options = {name.replace("-", "_") for name in re.findall(r"^ +(?:-\w, )?--([a-z0-9-]+)", shown, re.MULTILINE)}
    arguments = set(inspect.signature(asked).parameters) - {"self"}
    assert arguments - own == options - otherwise - {"help", "quiet"}


def test_every_argument_is_described():
    for name, kind in [("Study", Study), ("analyse", analyse), *((k, v[0]) for k, v in VERBS.items())]:
        text = inspect.getdoc(kind) or ""
        for argument in set(inspect.signature(kind).parameters) - {"self"}:
            assert re.search(rf"\b{argument}\b", text), f"{name}: {argument}"


def test_all_that_is_public_is_described():
    for name in pirca.__all__:
        assert name == "__version__" or inspect.getdoc(getattr(pirca, name)), name
