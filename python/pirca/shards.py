"""Walls of a study on the workers of a Dask client.

A shard is computed in the process of its worker, so that both end together. The shards meet in one folder, which alone says what is
done: no more than the number of a shard comes back from a task.
"""

from __future__ import annotations

import asyncio
import json
import os
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple
from uuid import uuid4

from distributed import CancelledError, Client, Future, KilledWorker, get_worker, wait

from pirca.command import ask, warn
from pirca.errors import Error, RunError, UsageError
from pirca.shard_progress import Lines

__all__ = ["Work", "shards_on"]

_VERSION = version("pirca")
#: How often a shard that failed, as on a file system that was away for a moment, is tried again.
_RETRIES = 2
#: Shards that each worker gets at the least, so that the last ones end at about the same time.
_EACH = 4
#: Seconds after which workers are counted again: new ones get shards.
_PATIENCE = 1.0
#: Seconds until a file that was written on one machine must be seen on another one. Network file systems remember for up to a
#: minute that a file was not there.
_LATE = 90.0
#: How many workers an error names.
_NAMED = 4
#: A second command in a process would only wait for the first one, and would be stopped with it.
_ONE = threading.Lock()


class Work(NamedTuple):
    """Walls that are shared out: of a study or a batch, asked for with options of `pirca shards run`, and the folder of the shards."""

    name: str
    study: Path
    out: Path
    options: Mapping[str, Any]
    #: How many there are, where so few that none is timed first.
    walls: int | None = None

    def status(self) -> dict[str, Any]:
        """What `pirca shards status --json` says; empty before the first shard is begun."""
        if not (self.out / "shards" / "work.json").exists():
            return {}
        status: dict[str, Any] = json.loads(ask("shards", "status", self.out).json)
        return status

    def missing(self, of: int) -> list[int]:
        """Numbers of the shards that are not complete."""
        runs = self.status().get("missing", f"0-{of - 1}").split(",")
        ends = [(first, last or first) for first, _, last in (run.partition("-") for run in runs if run)]
        return [index for first, last in ends for index in range(int(first), int(last) + 1)]

    def number(self, workers: int, *, progress: bool) -> int:
        """Into how many shards: as the folder has begun with, or as `pirca shards plan` advises and enough for every worker."""
        if begun := self.status():
            return int(begun["shards"])
        if self.walls:
            return min(_EACH * workers, self.walls)
        plan = json.loads(ask("shards", "plan", self.study, progress=progress, **self.options).json)
        return int(min(max(plan["shards"], _EACH * workers), plan["evaluations"]))


def shards_on(client: Client, work: Work, of: int | None = None, *, progress: bool = False) -> None:
    """Compute those of so many shards that the folder lacks. Ctrl-C stops the workers as well; what is complete stays.

    Raises `pirca.RunError` where a worker has another version or does not see the folder, and where workers die of a shard.
    """
    if not isinstance(client, Client) or client.asynchronous:
        raise UsageError(f"client: a distributed.Client that waits for what it asks is needed, and {client!r} is none")
    if not client.nthreads():
        warn(f"no worker is connected to {client.scheduler_info()['address']}: waiting for the first one")
        client.wait_for_workers(1)
    with _mark(work.out) as mark:
        _check(client, work, mark)
        of = of or work.number(len(client.nthreads()), progress=progress)
        missing = work.missing(of)
        lines = Lines(work.name, work.status) if progress else None
        if lines:
            lines.begin(of, len(missing), len(client.nthreads()))
        # Where none is missing, one that is there is asked for: it says whether the folder is of this work.
        todo = missing or [0]
        while todo:
            died = _round(client, work, todo, of, mark, lines)
            left = work.missing(of)
            if left and len(left) >= len(missing):
                numbers = work.status().get("missing", "all")
                raise RunError(
                    f"{work.out}: shards {numbers} of {of} are missing: the workers died of them, or they were cancelled; look into "
                    "the logs of the workers (is there memory enough?). The same call goes on from what is complete"
                ) from died
            todo = missing = left
        if lines:
            lines.look(is_due=True)


def _round(
    client: Client, work: Work, todo: Sequence[int], of: int, mark: Path, lines: Lines | None
) -> BaseException | None:
    """Hand these shards out until each was computed or given up. Gives why one was given up, if workers died of it."""
    study = os.path.abspath(work.study)
    waiting, done = list(reversed(todo)), set[int]()
    running: dict[Future[int], int] = {}
    died = None
    try:
        while waiting or running:
            # One for each worker, however many threads it has: a shard takes them all.
            while waiting and len(running) < max(1, len(client.nthreads())):
                index = waiting.pop()
                key = f"shard-{index}-of-{of}-{uuid4().hex}"
                task = client.submit(
                    compute, study, index, of, work.options, mark, key=key, pure=False, retries=_RETRIES
                )
                running[task] = index
            for task in _ended(running):
                index = running.pop(task)
                error = task.exception() if task.status == "error" else None
                if isinstance(error, KilledWorker):
                    died = error
                elif error is not None:
                    raise error
                elif task.status == "finished":
                    done.add(index)
            if lines:
                lines.look()
    finally:
        client.cancel(list(running))
    # What was computed will be seen.
    until = time.monotonic() + _LATE
    while not done.isdisjoint(work.missing(of)) and time.monotonic() < until:
        time.sleep(_PATIENCE)
    return died


def _ended(running: Mapping[Future[int], int]) -> list[Future[int]]:
    """Those that have ended in whatever way; none if none does soon."""
    try:
        wait(list(running), timeout=_PATIENCE, return_when="FIRST_COMPLETED")
    except (asyncio.TimeoutError, CancelledError):
        pass
    return [task for task in running if task.status != "pending"]


def compute(study: str, index: int, of: int, options: Mapping[str, Any], mark: Path) -> int:
    """Compute a shard, on a worker, with as many threads as that has; the number of the shard."""
    worker = get_worker()
    key = worker.get_current_task()

    def look(_line: str = "") -> None:
        """Stop what was cancelled, so that its worker is free. The command says a line at every tenth of the walls."""
        task = worker.state.tasks.get(key)
        if task is None or task.state == "cancelled":
            raise RunError(f"shard {index} was cancelled")

    try:
        if not mark.exists():
            raise RunError(_unseen(mark.parent))
        with _ONE:
            look()
            ask("shards", "run", study, hear=look, index=index, of=of, threads=worker.state.nthreads, **options)
    except Error as error:
        raise type(error)(f"{error} (on worker {worker.address})") from None
    return index


@contextmanager
def _mark(out: Path) -> Iterator[Path]:
    """A file in the folder by which workers know that they see this very one, and none of the same name."""
    mark = Path(os.path.abspath(out)) / f".seen-{uuid4().hex}"
    try:
        mark.parent.mkdir(parents=True, exist_ok=True)
        mark.touch()
    except OSError as error:
        raise RunError(f"cannot write to {out}: {error.strerror}") from None
    try:
        yield mark
    finally:
        mark.unlink(missing_ok=True)


def _check(client: Client, work: Work, mark: Path) -> None:
    """Raise what the workers lack. They are asked by functions of the standard library, as one may lack the package."""

    def needed(found: Any) -> str:
        there = "none" if isinstance(found, Exception) else found
        return f"has pirca {there}, and here it is {_VERSION}: install the same"

    study = Path(os.path.abspath(work.study))
    _each(client.run(version, "pirca", on_error="return"), lambda found: found == _VERSION, needed)
    _each(client.run(os.path.exists, str(study)), bool, lambda _: _unseen(study))
    _each(client.run(os.path.exists, str(mark)), bool, lambda _: _unseen(mark.parent))


def _each(answers: Mapping[str, Any], is_right: Callable[[Any], bool], lacks: Callable[[Any], str]) -> None:
    """Raise what is said of the workers whose answer is not right."""
    wrong = [f"worker {worker} {lacks(answer)}" for worker, answer in answers.items() if not is_right(answer)]
    if wrong:
        more = [f"and {len(wrong) - _NAMED} more of {len(answers)} workers"] if len(wrong) > _NAMED else []
        raise RunError("\n".join([*wrong[:_NAMED], *more]))


def _unseen(path: Path) -> str:
    return f"does not see {path}: name a path on a file system that all machines share"
