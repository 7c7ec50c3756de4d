"""The wheel carries the command line."""

import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pirca

#: That of the wheel, whichever other one the tests compare with.
COMMAND = str(Path(sys.executable).with_name("pirca"))


def run(*arguments):
    return subprocess.run([COMMAND, *map(str, arguments)], capture_output=True, text=True, check=False)


def test_it_runs_and_says_its_version(studies):
    assert run("--version").stdout == f"pirca {version('pirca')}\n" == f"pirca {pirca.__version__}\n"
    checked = run("check", studies / "joint-arrangement")
    assert checked.returncode == 0 and checked.stdout.startswith("joint-arrangement: valid")


def test_its_exit_codes_are_those_of_the_command():
    assert [run(*arguments).returncode for arguments in (["--help"], ["none"], ["check", "nowhere"])] == [0, 2, 3]
