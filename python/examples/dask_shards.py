"""The walls of a study on a Dask cluster whose workers have the command `pirca`, and not its Python package.

    python dask_shards.py tcp://SCHEDULER:8786 STUDY --of 64 --out DIR --threads 1

All machines see the same folders. Started once more it goes on from what is complete. `pirca shards plan STUDY --script dask` prints this file with
the study in it, so that the address of the scheduler is all that it needs. With the package, `pirca.Study(STUDY).run(client=client)` does it.
"""

import json
import os
import subprocess
import sys

from dask.distributed import Client, as_completed

# What `pirca shards plan` writes here, or else the arguments, as `pirca shards run` takes them.
PLANNED = r"""@SHARD_LIST@"""
ASKED = json.loads(PLANNED) if PLANNED.startswith("[") else ["shards", "run", *sys.argv[2:]]
FOLDER = os.getcwd()
OF, OUT = (ASKED[ASKED.index(option) + 1] for option in ("--of", "--out"))


def shard(index):
    # A worker that is killed leaves this command behind, while Dask has the shard computed elsewhere. That is harmless: both
    # write the same bytes, each under a name of its own first, so that the later one replaces a file by its like.
    command = ["pirca", *ASKED, "--index", str(index)]
    ended = subprocess.run(command, cwd=FOLDER, stderr=subprocess.PIPE, text=True, check=False)
    if ended.returncode != 0:
        raise RuntimeError(ended.stderr)
    return index


client = Client(sys.argv[1])
shards = client.map(shard, range(int(OF)), pure=False, retries=2)
for count, future in enumerate(as_completed(shards), 1):
    print(f"shard {future.result()} is complete, {count} of {OF}", file=sys.stderr)
sys.exit(subprocess.run(["pirca", "shards", "merge", OUT], check=False).returncode)
