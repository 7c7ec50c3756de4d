"""The command `pirca`, as the wheel installs it."""

from __future__ import annotations

import signal
import sys

from pirca import _native


def main() -> int:
    """Do what the arguments of the process ask; the exit code."""
    # Python would look for Ctrl-C only after the command has ended.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.command_line(["pirca", *sys.argv[1:]])
