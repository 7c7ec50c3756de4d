"""What every engine must come to: the bytes of a run on one machine."""

import hashlib
import pathlib
import subprocess
import sys
import time

import processes

STUDY = pathlib.Path(__file__).parent / "many-walls"
SHARDS = 8
RESULTS = ("members.parquet", "steps.parquet", "summary.json", "manifest.json")


def fail(message):
    print(f"{pathlib.Path(sys.argv[0]).stem}: {message}", file=sys.stderr)
    sys.exit(1)


def until(what, seconds, found):
    """Waits for something to be found, and hands it back."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if value := found():
            return value
        time.sleep(0.1)
    fail(f"waited {seconds} s for {what}")


def results(folder):
    """Hashes of what must be the same; an empty one of what is not there."""
    files = [folder / name for name in RESULTS]
    return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() if file.exists() else "" for file in files}


def same(what, folder, expected):
    """That the results in a folder are there, and have these hashes."""
    found = results(folder)
    if wrong := [name for name in RESULTS if not found[name] or found[name] != expected[name]]:
        fail(f"{what}: not the bytes of a run on one machine: {', '.join(wrong)}")
    print(f"{what}: the same bytes", flush=True)


def of_one_machine(pirca, work):
    """What a plain run comes to."""
    out = work / "one machine"
    subprocess.run([pirca, "run", STUDY, "--quiet", "--out", out], check=True, stdout=subprocess.DEVNULL)
    return results(out)


def script(pirca, engine, out):
    """The script that an engine is started by, in a file beside the results' folder."""
    command = [pirca, "shards", "plan", STUDY, "--quiet", "--script", engine, "--of", str(SHARDS), "--out", out]
    text = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    file = out.with_name(f"{out.name}.sh")
    file.write_text(text)
    return file


def shard_file(out, index):
    return out / "shards" / f"{index:04}-of-{SHARDS:04}.jsonl"


def being_computed(out, node=None):
    """A process that has evaluated some of its shard's walls, and the shard's number; on a node of a cluster, if one is named."""
    for pid in processes.descendants():
        words = processes.arguments(pid)
        if words[1:3] != ["shards", "run"]:
            continue
        if node and processes.environment(pid).get("SLURMD_NODENAME") != node:
            continue
        index = int(words[words.index("--index") + 1])
        parts = (out / "shards").glob(f"{index:04}-of-{SHARDS:04}.*.part")
        # A head, and two walls.
        if any(part.read_bytes().count(b"\n") >= 3 for part in parts):
            return pid, index
    return None
