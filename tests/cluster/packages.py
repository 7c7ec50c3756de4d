"""Programs that a test needs: there, installed with apt, or a reason to skip the test."""

import os
import shutil
import subprocess


def why_not(programs, names):
    """Why these programs are not there and their packages cannot be installed; empty where they are."""
    if all(shutil.which(program) for program in programs):
        return ""
    if os.geteuid() != 0 or not shutil.which("apt-get"):
        return f"{' and '.join(names)} are to be installed"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    subprocess.run(["apt-get", "update", "-qq"], **quiet)
    subprocess.run(["apt-get", "install", "-y", "-qq", "--no-install-recommends", *names], **quiet)
    return "" if all(shutil.which(program) for program in programs) else f"{' and '.join(names)} cannot be installed"
