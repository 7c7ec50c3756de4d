"""The processes that a test starts, and those that they start: found in /proc, and all of them ended."""

import ctypes
import os
import pathlib
import signal

PROC = pathlib.Path("/proc")
# prctl(2): a process whose parent ends becomes a child of this one, so that daemons cannot leave the family.
PR_SET_CHILD_SUBREAPER = 36
LOOPBACK = {"0100007F", "00000000000000000000000001000000"}
LISTENING = "0A"


def keep_family():
    if ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl")


def read(pid, file):
    """What /proc says of a process; empty where it has ended."""
    try:
        return (PROC / str(pid) / file).read_bytes()
    except OSError:
        return b""


def parent(pid):
    # The name in brackets may hold blanks.
    fields = read(pid, "stat").rpartition(b")")[2].split()
    return int(fields[1]) if fields else 0


def name(pid):
    return read(pid, "comm").decode().strip()


def arguments(pid):
    return read(pid, "cmdline").decode().split("\0")[:-1]


def environment(pid):
    pairs = (pair.split("=", 1) for pair in read(pid, "environ").decode(errors="replace").split("\0"))
    return {pair[0]: pair[1] for pair in pairs if len(pair) == 2}


def descendants():
    """Of this process."""
    parents = {int(path.name): parent(int(path.name)) for path in PROC.iterdir() if path.name.isdigit()}
    found = {os.getpid()}
    while more := {pid for pid, above in parents.items() if above in found} - found:
        found |= more
    return found - {os.getpid()}


def open_to_others(pids):
    """Addresses other than this machine's own to which these processes listen."""
    sockets = set()
    for pid in pids:
        try:
            sockets |= {os.readlink(file) for file in (PROC / str(pid) / "fd").iterdir()}
        except OSError:
            pass  # it has ended
    found = []
    for table in ("tcp", "tcp6"):
        for line in (PROC / "net" / table).read_text().splitlines()[1:]:
            fields = line.split()
            address, state, inode = fields[1], fields[3], fields[9]
            if state == LISTENING and f"socket:[{inode}]" in sockets and address.split(":")[0] not in LOOPBACK:
                found.append(address)
    return found


def listens(pids):
    """Whether any of these processes listens at all: `open_to_others` of none of them would say nothing."""
    sockets = {os.readlink(file) for pid in pids for file in (PROC / str(pid) / "fd").iterdir()}
    lines = (PROC / "net" / "tcp").read_text().splitlines()[1:]
    return any(line.split()[3] == LISTENING and f"socket:[{line.split()[9]}]" in sockets for line in lines)


def kill(pids):
    for pid in pids:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass


def end_all():
    """Ends this process's descendants, with those that they start meanwhile."""
    while pids := descendants():
        kill(pids)
        try:
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        except ChildProcessError:
            pass
