"""What the tests share: the command line beside the package, the studies, and an empty folder to work in."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
#: The command: that of the wheel, or another one that is named, as the one that cargo has built.
PIRCA = os.environ.get("PIRCA", str(Path(sys.executable).with_name("pirca")))


def pytest_addoption(parser):
    parser.addoption("--slow", action="store_true", help="run all slow tests, not only that of the day")


def pytest_collection_modifyitems(config, items):
    """Of the slow tests one a day is run, another one every day, unless all are asked for or one is named."""
    slow = [item for item in items if item.get_closest_marker("slow")]
    if config.getoption("--slow") or len(slow) < 2:
        return
    today = slow[int(time.time()) // 86400 % len(slow)]
    for item in slow:
        if item is not today:
            item.add_marker(pytest.mark.skip(reason="slow: it is run on another day, or with --slow"))


@pytest.fixture(autouse=True)
def empty_folder(tmp_path, monkeypatch):
    """Every test works in an empty folder of its own."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def studies():
    """The studies of the repository."""
    return ROOT / "studies"


@pytest.fixture
def walls():
    """Walls of the command line's own tests."""
    return ROOT / "tests/cli/fixtures/walls"


@pytest.fixture
def pirca_command():
    """The command line, as others use it."""

    def run(*arguments, code=0):
        done = subprocess.run([PIRCA, *map(str, arguments)], capture_output=True, text=True, check=False)
        assert done.returncode == code, done.stderr
        return done

    return run
