"""Runs the script that pirca prints for GNU parallel, and kills a shard on the way.

usage: check_parallel.py PIRCA      (PIRCA: the program; needs parallel, and installs it with apt if it may)

1. A shard killed with signal 9 is begun again.
2. All killed in the middle: the same command computes what is missing.

Both times the results are, byte for byte, those of a run on one machine.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import packages
import processes
import shards
from shards import fail, until

LONG = 120


class Started:
    """The script, under way."""

    def __init__(self, pirca, script):
        path = f"{pirca.parent}:{os.environ['PATH']}"
        with open(f"{script}.log", "a") as log:
            self.process = subprocess.Popen(
                ["bash", script, "--jobs", "2"], env={**os.environ, "PATH": path}, stdout=log, stderr=log
            )

    def to_its_end(self):
        if code := self.process.wait(LONG):
            fail(f"{self.process.args[1]}: exit code {code}: {pathlib.Path(f'{self.process.args[1]}.log').read_text()}")


def check_killed_shard(pirca, work, expected):
    out = work / "killed shard 5 %"
    script = shards.script(pirca, "parallel", out)
    started = Started(pirca, script)
    pid, index = until("a shard", LONG, lambda: shards.being_computed(out))
    processes.kill([pid])
    started.to_its_end()
    shards.same(f"shard {index} killed", out, expected)


def check_killed_script(pirca, work, expected):
    out = work / "all killed"
    script = shards.script(pirca, "parallel", out)
    Started(pirca, script)
    until("a complete shard", LONG, lambda: list((out / "shards").glob("*.jsonl")))
    processes.end_all()
    complete = {path: path.stat().st_mtime_ns for path in (out / "shards").glob("*.jsonl")}
    if len(complete) == shards.SHARDS:
        fail("the kill came too late")
    Started(pirca, script).to_its_end()
    shards.same(f"all killed after {len(complete)} shards", out, expected)
    jobs = (out / "shards/log/parallel.txt").read_text().count("\n") - 1
    if jobs != shards.SHARDS - len(complete) or any(path.stat().st_mtime_ns != time for path, time in complete.items()):
        fail(f"{jobs} shards were begun, where {len(complete)} of {shards.SHARDS} were complete")


def main():
    if reason := packages.why_not(["parallel"], ["parallel"]):
        print(f"skipped: {reason}")
        return
    pirca = pathlib.Path(sys.argv[1]).resolve()
    processes.keep_family()
    work = pathlib.Path(tempfile.mkdtemp(prefix="pirca-parallel-"))
    try:
        expected = shards.of_one_machine(pirca, work)
        check_killed_shard(pirca, work, expected)
        check_killed_script(pirca, work, expected)
    finally:
        processes.end_all()
        shutil.rmtree(work, ignore_errors=True)


if __name__ == "__main__":
    main()
