"""A Slurm cluster of two nodes on one machine, as a user of it sees one. Everything of it lies in a folder and listens on loopback."""

import os
import pwd
import socket
import subprocess

import processes
from shards import fail, until

PACKAGES = ["slurm-wlm", "munge"]
PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol"]
NODES = ("n1", "n2")
# Without the two InAddrAny all daemons listen to the world. Every interval is as short as it goes: a node is given up after
# SlurmdTimeout seconds, and its jobs begin again cred_expire seconds later (Slurm's own: 300 and 120). An array has fewer elements
# than there are shards (Slurm's own: 1001).
CONFIGURATION = """
ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={control}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,bf_interval=1
MaxArraySize={elements}
ReturnToService=2
SlurmdTimeout=5
SlurmdParameters=config_overrides
StateSaveLocation={folder}/state
SlurmctldPidFile={folder}/slurmctld.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdSpoolDir={folder}/spool-%n
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmdLogFile={folder}/slurmd-%n.log
NodeName=n[1-2] NodeHostname=localhost NodeAddr=127.0.0.1 Port=[{first}-{second}] CPUs=1 RealMemory=2000
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""
ELEMENTS = 5


def free_ports():
    """Three ports that nobody listens on, the last two next to each other."""
    for first in range(20000, 60000, 3):
        taken = [socket.socket() for _ in range(3)]
        try:
            for place, own in enumerate(taken):
                own.bind(("127.0.0.1", first + place))
            return first, first + 1, first + 2
        except OSError:
            pass
        finally:
            for own in taken:
                own.close()
    fail("no ports are free")


class Cluster:
    def __init__(self, folder, path):
        """In an empty folder; jobs find programs along a path."""
        self.folder = folder
        control, first, second = free_ports()
        user = pwd.getpwuid(os.geteuid()).pw_name
        text = CONFIGURATION.format(
            folder=folder, user=user, control=control, first=first, second=second, elements=ELEMENTS
        )
        (folder / "slurm.conf").write_text(text)
        key = folder / "munge.key"
        key.touch(mode=0o600)
        key.write_bytes(os.urandom(1024))
        # None of a cluster that this test itself may run on.
        kept = {name: value for name, value in os.environ.items() if not name.startswith(("SLURM", "SBATCH", "SQUEUE"))}
        self.environment = {**kept, "SLURM_CONF": str(folder / "slurm.conf"), "PATH": path}

    def start(self):
        folder = self.folder
        files = [f"--{name}={folder}/munge.{end}" for name, end in
                 [("key-file", "key"), ("socket", "socket"), ("pid-file", "pid"), ("log-file", "log"), ("seed-file", "seed")]]
        self._start("munged", "--foreground", "--force", *files)
        until("munged", 10, (folder / "munge.socket").exists)
        self._start("slurmctld", "-D", "-c")
        for node in NODES:
            self.start_node(node)
        until("two idle nodes", 30, lambda: self.ask("sinfo", "--noheader", "--Node", "--format=%t").split() == ["idle"] * 2)

    def start_node(self, node):
        self._start("slurmd", "-D", "-N", node)

    def _start(self, *command):
        with (self.folder / "daemons.log").open("a") as log:
            subprocess.Popen(
                command, env=self.environment, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=log, stderr=log
            )

    def ask(self, *command):
        """What a command of a user prints; empty where it fails, as while the cluster begins."""
        return subprocess.run(
            command, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        ).stdout

    def state(self, job):
        """The state that Slurm keeps of a job, such as FAILED."""
        words = self.ask("scontrol", "--oneliner", "show", "job", job).split()
        return next((word.split("=")[1] for word in words if word.startswith("JobState=")), "")

    def is_empty(self):
        return not self.ask("squeue", "--noheader").strip() and not self.ask("scontrol", "ping").count("DOWN")

    def told(self):
        """What the cluster has to say when something went wrong."""
        logs = sorted(self.folder.glob("*.log")) + sorted(self.folder.glob("*/shards/log/*.txt"))
        ends = [f"{log}:\n{''.join(log.read_text(errors='replace').splitlines(keepends=True)[-20:])}" for log in logs]
        return "\n".join([self.ask("squeue"), *ends])

    def kill_node(self, node):
        """As if its machine had lost power: the daemon, its steps, and what they run."""
        family = processes.descendants()
        own = {pid for pid in family if processes.environment(pid).get("SLURMD_NODENAME") == node}
        own |= {processes.parent(pid) for pid in own if processes.name(processes.parent(pid)) == "slurmstepd"}
        own |= {pid for pid in family if processes.arguments(pid)[-2:] == ["-N", node]}
        processes.kill(own)
