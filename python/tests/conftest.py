"""What the tests share: the command line beside the package, the studies, and an empty folder to work in."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
#: The command: that of the wheel, or another one that is named, as the one that cargo has built.
PIRCA = os.environ.get("PIRCA", str(Path(sys.executable).with_name("pirca")))


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
