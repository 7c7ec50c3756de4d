"""Runs the job that pirca prints for Slurm on a real cluster of two nodes, and kills what may be killed on one.

usage: check_slurm.py PIRCA      (PIRCA: the program; needs slurm-wlm and munge, and installs them with apt if it may)

1. The job as it is printed, with its merge.
2. A node that is lost in the middle of a shard: Slurm starts the shard again elsewhere.
3. A script killed with signal 9, which Slurm does not start again: the merge submits the shard anew.
4. A shard that is damaged afterwards: the same command computes this one alone.

Every time the results are, byte for byte, those of a run on one machine. No process of the cluster listens to another machine.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import packages
import processes
import shards
import slurm
from shards import fail, until

LONG = 120


def submitted(cluster, script):
    """Submits what is missing; what the script says."""
    answer = subprocess.run(
        ["bash", script], env=cluster.environment, cwd=script.parent, stdout=subprocess.PIPE, text=True
    )
    if answer.returncode != 0:
        fail(f"bash {script}: exit code {answer.returncode}")
    return answer.stdout


def logs(out, start):
    return "".join(file.read_text() for file in sorted((out / "shards/log").glob(f"{start}*.txt")))


def check_plain(cluster, pirca, work, expected):
    out = work / "as printed"
    submitted(cluster, shards.script(pirca, "slurm", out))
    until("a shard", LONG, lambda: shards.being_computed(out))
    family = processes.descendants()
    if not processes.listens(family):
        fail("no daemon of the cluster listens")
    if found := processes.open_to_others(family):
        fail(f"listening on {', '.join(found)}")
    until("the results", LONG, cluster.is_empty)
    shards.same("as it is printed", out, expected)
    return out


def check_damaged(cluster, out, expected):
    """A second go of the same command."""
    file = shards.shard_file(out, 5)
    others = {path: path.stat().st_mtime_ns for path in (out / "shards").glob("*.jsonl") if path != file}
    file.write_bytes(file.read_bytes()[:-40])
    (out / "members.parquet").unlink()
    said = submitted(cluster, out.with_name(f"{out.name}.sh"))
    until("the results", LONG, cluster.is_empty)
    shards.same("one shard damaged", out, expected)
    if "shards 5:" not in said or any(path.stat().st_mtime_ns != time for path, time in others.items()):
        fail(f"more than the damaged shard was computed: {said}")


def check_lost_node(cluster, pirca, work, expected):
    out = work / "lost node"
    # A job may submit, too.
    cluster.ask("sbatch", "--output=/dev/null", shards.script(pirca, "slurm", out))
    _, index = until("a shard on n2", LONG, lambda: shards.being_computed(out, "n2"))
    cluster.kill_node("n2")
    until("the results", LONG, cluster.is_empty)
    if "due to failure of node n2" not in (cluster.folder / "slurmctld.log").read_text():
        fail(f"Slurm did not start shard {index} again")
    shards.same(f"node lost in shard {index}", out, expected)
    cluster.start_node("n2")


def check_killed_script(cluster, pirca, work, expected):
    # Blanks are the shell's and %A is Slurm's: neither may matter.
    out = work / "killed at 50%A of it"
    said = submitted(cluster, shards.script(pirca, "slurm", out))
    pid, index = until("a shard", LONG, lambda: shards.being_computed(out))
    jobs = re.search(r"submitted as ([\d:]+)", said)[1].split(":")
    block, element = divmod(index, slurm.ELEMENTS)
    processes.kill([pid, processes.parent(pid)])
    until("its end", LONG, lambda: cluster.state(f"{jobs[block]}_{element}") == "FAILED")
    refused = subprocess.run(["bash", out.with_name(f"{out.name}.sh")], env=cluster.environment, capture_output=True, text=True)
    if refused.returncode != 1 or "still to come" not in refused.stderr:
        fail(f"shards in the queue are submitted a second time: {refused.stdout}")
    until("the results", LONG, cluster.is_empty)
    if f"shards {index}: submitted" not in logs(out, "merge-"):
        fail(f"the merge did not submit shard {index} again: {logs(out, 'merge-')}")
    shards.same(f"script killed in shard {index}", out, expected)


def main():
    if reason := packages.why_not(slurm.PROGRAMS, slurm.PACKAGES):
        print(f"skipped: {reason}")
        return
    pirca = pathlib.Path(sys.argv[1]).resolve()
    processes.keep_family()
    work = pathlib.Path(tempfile.mkdtemp(prefix="pirca-slurm-"))
    cluster = slurm.Cluster(work, f"{pirca.parent}:{os.environ['PATH']}")
    try:
        begun = time.monotonic()
        cluster.start()
        expected = shards.of_one_machine(pirca, work)
        out = check_plain(cluster, pirca, work, expected)
        check_damaged(cluster, out, expected)
        check_killed_script(cluster, pirca, work, expected)
        check_lost_node(cluster, pirca, work, expected)
        print(f"in {time.monotonic() - begun:.0f} s")
    except SystemExit:
        print(cluster.told(), file=sys.stderr)
        raise
    finally:
        processes.end_all()
        shutil.rmtree(work, ignore_errors=True)


if __name__ == "__main__":
    main()
