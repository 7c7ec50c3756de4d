"""Runs walls on other processors than this one, by emulation, and compares bytes.

usage: check_processors.py PIRCA      (PIRCA: the program, for x86-64; needs qemu-user, and installs it with apt if it may)

Nehalem (2008) multiplies two numbers at a time and rounds before it adds. Haswell (2013), and most of what came after it,
multiplies four or more and does not round in between. The sparse factors of a large wall have dense parts, whose products are
taken as the processor can: their bytes are those of every processor with AVX2 and FMA. A wall of up to some 200 stones has no
such parts: its bytes are those of every processor.
"""

import pathlib
import platform
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

import packages
import shards

PIRCA = pathlib.Path(sys.argv[1]).resolve()
HERE = pathlib.Path(__file__).parent
ALL = ("Nehalem", "Haswell")
CASES = [
    (HERE / "large-wall", "limit", ALL[1:]),
    (shards.STUDY, "limit", ALL),
    (HERE / "small-walls", "implicit", ALL),
    (HERE / "small-walls", "explicit", ALL),
]


def run(command, study, solver, out):
    arguments = ["run", study, "--solver", solver, "--members", "1", "--threads", "1", "--quiet", "--out", out]
    # The emulator warns of what it lacks of a processor.
    answer = subprocess.run([*command, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if answer.returncode != 0:
        shards.fail(f"{' '.join(map(str, command))}: {answer.stderr}")


def compare(case, work):
    study, solver, processors = case
    out = work / f"{study.name}-{solver}"
    run([PIRCA], study, solver, out)
    for processor in processors:
        other = out.with_name(f"{out.name}-{processor}")
        run(["qemu-x86_64", "-cpu", processor, PIRCA], study, solver, other)
        shards.same(f"{study.name}, {solver}, on {processor}", other, shards.results(out))


def main():
    if platform.machine() != "x86_64":
        print("skipped: this is no x86-64 processor")
        return
    if reason := packages.why_not(["qemu-x86_64"], ["qemu-user"]):
        print(f"skipped: {reason}")
        return
    with tempfile.TemporaryDirectory(prefix="pirca-processors-") as work, ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda case: compare(case, pathlib.Path(work)), CASES))


if __name__ == "__main__":
    main()
