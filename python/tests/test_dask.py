"""A run on the workers of a Dask cluster is the run of one machine, to the byte, whatever becomes of the workers."""

import hashlib
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from conftest import PIRCA, ROOT

import pirca

distributed = pytest.importorskip("distributed", reason="Dask is not installed: pip install 'pirca[dask]'")

FILES = ["members.parquet", "steps.parquet", "summary.json", "manifest.json"]
HERE = ["--host", "127.0.0.1", "--dashboard-address", "127.0.0.1:0"]


class Cluster:
    """A scheduler and two workers with nannies, each a process of its own that listens on this machine alone."""

    def __init__(self, folder):
        self.folder = folder
        self.file = folder / "scheduler.json"
        # Workers find the command, and have nothing of this folder in theirs.
        path = os.pathsep.join([str(Path(PIRCA).resolve().parent), os.environ["PATH"]])
        self.environment = {**os.environ, "PATH": path, "DASK_DISTRIBUTED__WORKER__MEMORY__TERMINATE": "False"}
        self.processes = [self.start("scheduler", "--port", "0", "--scheduler-file", self.file)]
        for name in ("one", "two"):
            own = ["--name", name, "--nworkers", "1", "--nthreads", "1", "--local-directory", folder / name]
            self.processes.append(self.start("worker", "--scheduler-file", self.file, *own))
        self.client = distributed.Client(scheduler_file=str(self.file))
        self.client.wait_for_workers(2, timeout=60)

    def start(self, what, *options):
        """A process of Dask."""
        command = [sys.executable, "-m", "dask", what, *HERE, *map(str, options)]
        with open(self.folder / "log", "ab") as log:
            return subprocess.Popen(command, cwd=self.folder, env=self.environment, stdout=log, stderr=log)

    def pids(self):
        """Process ids of the workers, by their addresses."""
        return self.client.run(os.getpid)

    def close(self):
        self.client.shutdown()
        for process in self.processes:
            process.wait(timeout=30)


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    cluster = Cluster(tmp_path_factory.mktemp("cluster"))
    yield cluster
    cluster.close()


@pytest.fixture
def block(studies):
    """Walls that take a while: a shard of them can be stopped in the middle."""
    return pirca.Study(studies / "tilting-block", members=8)


@pytest.fixture
def quick(studies):
    """Walls that take no time."""
    return pirca.Study(studies / "joint-arrangement", members=2)


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """Sums of the files of runs on this machine, by study."""
    out = tmp_path_factory.mktemp("plain")
    studies = {"tilting-block": 8, "joint-arrangement": 2}
    return {
        name: sums(pirca.Study(ROOT / "studies" / name, members=n).run(out=out / name).out)
        for name, n in studies.items()
    }


def sums(out):
    return {name: hashlib.sha256((Path(out) / name).read_bytes()).hexdigest() for name in FILES}


def shards(out):
    """Which file each shard is: another one has another number or another time."""
    return {path.name: (path.stat().st_ino, path.stat().st_mtime_ns) for path in Path(out).glob("shards/*.jsonl")}


def begun(out):
    """Whether a shard is being computed that is not complete."""
    return any(path.stat().st_size > 0 for path in Path(out).glob("shards/*.part"))


def until(condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it did not happen"
        time.sleep(0.02)


def test_a_run_is_that_of_one_machine(cluster, quick, plain, capfd):
    run = quick.run(client=cluster.client, shards=5, out="one", progress=True)
    assert sums("one") == plain[quick.name] and str(run.out) == "one"
    said = capfd.readouterr().err
    assert "joint-arrangement: 5 of 5 shards to compute, on 2 workers\n" in said
    assert "joint-arrangement: 24/24 walls done, 5/5 shards" in said
    # What is complete is not computed again, and a number of shards that is not named is that of the folder.
    before = shards("one")
    again = quick.run(client=cluster.client, out="one")
    assert len(before) == 5 and shards("one") == before and sums("one") == plain[quick.name]
    assert again.text == run.text
    assert not list(Path("one").glob(".seen-*"))


def test_it_is_written_where_a_run_is_and_has_what_a_run_has(cluster, studies):
    study = pirca.Study(studies / "joint-arrangement", members=2, **{"joint.phi_deg": 32})
    ours = study.run(client=cluster.client, csv=True, report=True)
    files = {name: (ours.out / name).read_bytes() for name in (*FILES, "members.csv", "figure-10.svg")}
    assert (ours.out / "report.html").exists()
    shutil.rmtree("runs")
    theirs = study.run(csv=True)
    assert (ours.out, ours.text) == (theirs.out, theirs.text)
    for name, held in files.items():
        assert (theirs.out / name).read_bytes() == held, name


def test_a_worker_that_is_killed_changes_nothing(cluster, block, plain):
    pids, killed = cluster.pids(), []

    def kill():
        until(lambda: begun("killed"))
        killed.append(min(pids.values()))
        os.kill(killed[0], signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    block.run(client=cluster.client, shards=6, out="killed")
    killer.join()
    assert killed and sums("killed") == plain[block.name]
    cluster.client.wait_for_workers(2, timeout=60)
    assert killed[0] not in cluster.pids().values(), "its nanny has started another one"


@pytest.fixture
def impatient(cluster):
    """The scheduler gives a task up as soon as a worker has died of it."""
    cluster.client.run_on_scheduler(lambda dask_scheduler: setattr(dask_scheduler, "allowed_failures", 0))
    yield cluster
    cluster.client.run_on_scheduler(lambda dask_scheduler: setattr(dask_scheduler, "allowed_failures", 3))
    cluster.client.wait_for_workers(2, timeout=60)


def test_what_is_given_up_is_handed_out_again_while_there_is_progress(impatient, block, plain):
    """As above, but for the task, which does not survive its worker."""
    pids, killed = impatient.pids(), []

    def kill():
        until(lambda: begun("given-up"))
        killed.append(max(pids.values()))
        os.kill(killed[0], signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    block.run(client=impatient.client, shards=6, out="given-up")
    killer.join()
    assert killed and sums("given-up") == plain[block.name]


def test_workers_that_die_again_and_again_are_an_error(impatient, block):
    over = threading.Event()

    def kill():
        while not over.wait(0.05):
            if begun("dying"):
                for pid in impatient.pids().values():
                    os.kill(pid, signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    try:
        with pytest.raises(pirca.RunError, match="shards 0-1 of 2 are missing: the workers died of them"):
            block.run(client=impatient.client, shards=2, out="dying")
    finally:
        over.set()
        killer.join()


def test_files_that_are_seen_late_are_waited_for(cluster, quick, plain, monkeypatch):
    from pirca.shards import Work

    seen, answers = Work.missing, []

    def late(work, of):
        # As a network file system may remember for a while that a file is not there.
        answers.append(seen(work, of) if len(answers) not in (1, 2) else answers[0])
        return answers[-1]

    monkeypatch.setattr(Work, "missing", late)
    quick.run(client=cluster.client, shards=3, out="late")
    assert answers[0] == answers[2] == [0, 1, 2] and sums("late") == plain[quick.name]


def test_shards_of_another_seed_are_refused(cluster, quick, studies):
    quick.run(client=cluster.client, shards=3, out="seeds")
    before = shards("seeds")
    with pytest.raises(pirca.RunError, match="(?s)seeds holds shards of other work.*on worker tcp://127.0.0.1"):
        pirca.Study(studies / "joint-arrangement", members=2, seed=5).run(client=cluster.client, out="seeds")
    assert shards("seeds") == before


def test_another_version_is_named_with_the_worker(cluster, quick, monkeypatch):
    monkeypatch.setattr("pirca.shards._VERSION", "0.0.9")
    wanted = rf"worker tcp://127.0.0.1:\d+ has pirca {pirca.__version__}, and here it is 0.0.9: install the same"
    with pytest.raises(pirca.RunError, match=wanted):
        quick.run(client=cluster.client, out="versions")
    assert not list(Path("versions").iterdir())


def test_a_worker_without_the_package_is_named(cluster, quick, monkeypatch):
    monkeypatch.setattr("pirca.shards.version", lambda _: __import__("importlib.metadata").metadata.version("no-such"))
    with pytest.raises(pirca.RunError, match=rf"has pirca none, and here it is {pirca.__version__}"):
        quick.run(client=cluster.client, out="versions")


def test_of_many_workers_a_few_are_named():
    from pirca.shards import _each

    with pytest.raises(pirca.RunError) as raised:
        _each({f"w{number}": number for number in range(8)}, lambda number: number < 2, lambda number: f"has {number}")
    assert str(raised.value).splitlines() == [*(f"worker w{n} has {n}" for n in range(2, 6)), "and 2 more of 8 workers"]


def test_folders_that_workers_do_not_see_are_named_with_the_worker(cluster, quick):
    # By this path each process sees its own working folder, as each machine its own disk.
    own = "/proc/self/cwd/unseen"
    wanted = rf"worker tcp://127.0.0.1:\d+ does not see {own}: name a path on a file system that all machines share"
    for _ in range(2):
        with pytest.raises(pirca.RunError, match=wanted):
            quick.run(client=cluster.client, out=own)
        # A folder of the same name is another one.
        (cluster.folder / "unseen").mkdir(exist_ok=True)
    assert not list((cluster.folder / "unseen").iterdir())
    shutil.copytree(ROOT / "studies/joint-arrangement", "mine")
    with pytest.raises(pirca.RunError, match="does not see /proc/self/cwd/mine: name a path"):
        pirca.Study("/proc/self/cwd/mine").run(client=cluster.client, out="unseen-study")


def test_a_fault_that_a_worker_finds_is_raised_as_it_is(cluster, empty_folder):
    for folder in (empty_folder, cluster.folder):
        (folder / "repository").mkdir()
        (folder / "repository/distributions").symlink_to(ROOT / "distributions")
        shutil.copytree(ROOT / "studies/joint-arrangement", folder / "repository/faulty")
    file = cluster.folder / "repository/faulty/study.toml"
    file.write_text(file.read_text().replace("phi_deg", "phi_degg", 1))
    study = pirca.Study("/proc/self/cwd/repository/faulty", members=2)
    with pytest.raises(pirca.InputError, match="(?s)joint.phi_degg is not a known key.*on worker tcp://127.0.0.1"):
        study.run(client=cluster.client, out="faulty", shards=2)


def test_what_is_no_client_that_waits_is_refused(quick):
    with pytest.raises(pirca.UsageError, match="client: a distributed.Client that waits .* 'tcp://somewhere' is none"):
        quick.run(client="tcp://somewhere")


def test_ctrl_c_frees_the_workers_and_what_was_recorded_stays(cluster, studies):
    # So many walls that none is at its end when it is interrupted.
    study = pirca.Study(studies / "tilting-block", members=600)

    def interrupt():
        until(lambda: begun("stopped"))
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt).start()
    with pytest.raises(KeyboardInterrupt) as stopped:
        study.run(client=cluster.client, shards=2, out="stopped")
    begin = time.monotonic()
    until(lambda: not any(cluster.client.run(lambda: __import__("pirca.shards").shards._ONE.locked()).values()))
    # A shard has 900 walls, and looks whether it was cancelled at every ninth. As a notebook would, somebody still holds the error.
    assert not shards("stopped") and begun("stopped"), f"{time.monotonic() - begin} s from {stopped} on"


def test_the_first_worker_is_waited_for(studies):
    with (
        distributed.LocalCluster(
            n_workers=0, threads_per_worker=2, host="127.0.0.1", dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        timer = threading.Timer(0.5, cluster.scale, (1,))
        timer.start()
        with pytest.warns(UserWarning, match="no worker is connected to tcp://127.0.0.1"):
            run = pirca.Study(studies / "joint-arrangement", members=1).run(client=client)
        timer.join()
    assert len(run.members) == 18


def test_the_command_alone_will_do(cluster, quick, plain):
    script = [sys.executable, ROOT / "python/examples/dask_shards.py", cluster.client.scheduler.address]
    asked = [quick.path, "--members", "2", "--of", "4", "--out", "by-command", "--threads", "1"]
    done = subprocess.run(
        [*map(str, script), *map(str, asked)], capture_output=True, text=True, env=cluster.environment, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "is complete, 4 of 4" in done.stderr and "24 evaluations" in done.stdout
    assert sums("by-command") == plain[quick.name]
    (Path("by-command/shards/0001-of-0004.jsonl")).unlink()
    asked[2] = "9"
    refused = subprocess.run([*map(str, script), *map(str, asked)], capture_output=True, text=True, check=False)
    assert refused.returncode != 0 and "holds shards of other work" in refused.stderr


def test_the_script_that_is_printed_needs_the_address_alone(cluster, quick, plain, pirca_command):
    planned = ["--script", "dask", "--members", 2, "--of", 3, "--out", "planned by pirca"]
    Path("shards.py").write_text(pirca_command("shards", "plan", quick.path, *planned).stdout)
    command = [sys.executable, "shards.py", cluster.client.scheduler.address]
    done = subprocess.run(command, capture_output=True, text=True, env=cluster.environment, check=False)
    assert done.returncode == 0, done.stderr
    assert len(shards("planned by pirca")) == 3 and sums("planned by pirca") == plain[quick.name]


def test_a_bank_is_that_of_one_machine(cluster, studies, pirca_command):
    study, measured = studies / "hidden-effects/example", ROOT / "tests/cli/fixtures/diagnose/gauge-offset.csv"
    bank = pirca.Study(study).bank(cluster.client, measured=measured, points=10, shards=3)
    assert bank == Path("runs/example-bank") and len(shards(bank)) == 3
    whole = ["--bank", "--measured", measured, "--points", 10, "--index", 0, "--of", 1, "--out", "theirs"]
    pirca_command("shards", "run", study, *whole)
    pirca_command("shards", "merge", "theirs")
    assert (bank / "bank.parquet").read_bytes() == Path("theirs/bank.parquet").read_bytes()


def test_the_walls_that_a_capacity_needs_further_are_shared_out(cluster, capfd):
    study = pirca.Study(ROOT / "tests/peers/column", members=64)
    asked = {"below_deg": 18.8, "walls": 1500, "method": "subset"}
    ours = study.capacity(**asked, client=cluster.client, out="ours", progress=True)
    assert "column: 8 of 8 shards to compute, on 2 workers" in capfd.readouterr().err
    assert len(list(Path("ours/batches").iterdir())) > 1
    assert dict(ours) == dict(study.capacity(**asked, out="theirs"))
    for name in ("capacity.json", "evaluations.parquet", "members.parquet"):
        assert Path("ours", name).read_bytes() == Path("theirs", name).read_bytes(), name


def test_nobody_else_can_reach_it(cluster):
    listening = {}
    for table in ("tcp", "tcp6"):
        for line in Path("/proc/net", table).read_text().splitlines()[1:]:
            _, address, _, state, *_, inode = line.split()[:10]
            if state == "0A":
                listening[f"socket:[{inode}]"] = address.partition(":")[0]
    family = [process.pid for process in cluster.processes]
    for pid in family:
        for task in Path(f"/proc/{pid}/task").iterdir():
            family += [int(child) for child in (task / "children").read_text().split()]
    handles = [handle for pid in family for handle in Path(f"/proc/{pid}/fd").iterdir()]
    own = [listening[where] for where in map(os.readlink, handles) if where in listening]
    assert len(own) >= 5 and set(own) == {"0100007F"}, own
