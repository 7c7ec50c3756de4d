"""Studies: walls, stones, joints, load, and the arms to compare."""

from __future__ import annotations

import io
import json
import re
import tempfile
from collections.abc import Mapping, Sequence
from csv import writer as csv_writer
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pirca.answer import Answer
from pirca.command import Answered, ask
from pirca.errors import InputError, UsageError
from pirca.run import Run
from pirca.wall import Wall

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["Study"]

Path_ = str | Path


class Study:
    """A study: a folder with a `study.toml`. It is read and checked at once; what looks odd is a Python warning.

    Parameters
    ----------
    study : path
        Its folder, or the `study.toml` in it.
    members : int, optional
        Number of walls in every random arm, in the place of the study's, for `run`, `wall` and `capacity`.
    seed : int, optional
        Seed in the place of the study's.
    variant : str, optional
        A named variant of the study; see `variants`.
    threads : int, optional
        Worker threads; one per processor without it. No result depends on their number.
    **keys
        Keys of the study with other values, by their paths: `**{"joint.phi_deg": 32}`. `pirca reference keys` lists all.

    Raises
    ------
    pirca.InputError
        With every fault of the study's files, by line and key.

    Attributes
    ----------
    name : str
        What it is called: its folder.
    arms : list of str
        The kinds of wall.
    variants : dict
        Name of each variant, and why somebody would read the study so.
    info : dict
        All that `pirca check --json` says.
    """

    def __init__(
        self,
        study: Path_,
        *,
        members: int | None = None,
        seed: int | None = None,
        variant: str | None = None,
        threads: int | None = None,
        **keys: str | float | Sequence[Any] | Mapping[str, Any],
    ) -> None:
        self.path = Path(study)
        # What is written as JSON is read as TOML, but for objects.
        set_ = [f"{path}={_toml(value)}" for path, value in keys.items()]
        variant = "+".join([*([variant] if variant else []), *set_]) or None
        self._variant, self._members, self._seed, self._threads = variant, members, seed, threads
        checked = ask("check", self.path, variant=variant)
        self.text: str = checked.text
        self.info: dict[str, Any] = json.loads(checked.json)
        if "elements" in self.info:
            raise InputError(f"{self.path} compares types of elements, not walls: only the command line takes it")
        self.name: str = self.info["study"]
        self.arms: list[str] = [arm["arm"] for arm in self.info["arms"]]
        self.variants: dict[str, str] = {own["name"]: own["why"] for own in self.info["variants"]}

    def run(
        self,
        *,
        out: Path_ | None = None,
        solver: str | None = None,
        beside: Path_ | None = None,
        demand: str | None = None,
        csv: bool = False,
        report: bool = False,
        progress: bool = False,
        client: Client | None = None,
        shards: int | None = None,
    ) -> Run:
        """Build and solve all walls: as `pirca run`, whose files it writes. A run that was stopped goes on where it stood.

        Parameters
        ----------
        out : path, optional
            Folder of the results; `runs/NAME` without it, with `-VARIANT` behind.
        solver : {"explicit", "implicit", "nonsmooth", "limit"}, optional
            Solver in the place of the study's.
        beside : path, optional
            Folder of an earlier run of the study, whose means are drawn into the figure.
        demand : str, optional
            What a wall must bear, or how far it may move, with its unit: "0.15g", "8.5deg", "12kN", "4mm". The summary's `demand` has
            the share of walls that fails in each arm.
        csv : bool
            Write `members.csv` and `steps.csv` as well.
        report : bool
            Write `report.html` as well.
        progress : bool
            Say on standard error how far it is.
        client : distributed.Client, optional
            Have the walls computed by the workers of a Dask cluster, which see the same folders and have the same pirca. Each uses the
            threads that it has. The files are the same to the byte.
        shards : int, optional
            Into how many shards the walls are divided for the workers; by what a few walls take without it.

        Raises
        ------
        pirca.RunError
            Of a worker that has another version or sees other folders, or of shards that workers die of.
        """
        if client is not None:
            out = out or self._folder()
            asked = {"members": self._members, "seed": self._seed, "solver": solver}
            self._on(client, out, shards, progress, asked)
            answered = ask("shards", "merge", out, study=self.path)
        if client is None or beside or demand or csv or report:
            answered = self._ask(
                "run",
                out=out,
                solver=solver,
                beside=beside,
                demand=demand,
                csv=csv,
                report=report,
                members=self._members,
                progress=progress,
            )
        assert answered.out is not None, "a run has a folder"
        return Run(answered.out, answered.text)

    def bank(
        self,
        client: Client,
        *,
        measured: Any = None,
        points: int | None = None,
        out: Path_ | None = None,
        shards: int | None = None,
        progress: bool = False,
    ) -> Path:
        """Have the walls that diagnoses rest on computed by the workers of a Dask cluster; the folder, for `diagnose(bank=...)`.

        Without it `diagnose` computes them on this machine.

        Parameters
        ----------
        client, shards, progress
            As of `run`.
        measured, points
            As of `diagnose`, which needs the same.
        out : path, optional
            Folder of the bank; `runs/NAME-bank` without it.
        """
        out = Path(out or self._folder("bank"))
        measured = self._file_of(measured, out)
        absolute = measured and Path(measured).absolute()
        self._on(client, out, shards, progress, {"bank": True, "measured": absolute, "points": points})
        ask("shards", "merge", out, study=self.path)
        return out

    def wall(self, arm: str | None = None, member: int = 0, *, point: int = 0, base: bool = False) -> Wall:
        """Build one wall, as `pirca wall`.

        Parameters
        ----------
        arm : str, optional
            Name of the arm; without it the first whose walls are random.
        member : int
            Number of the wall in its arm, from 0.
        point : int
            Number of the kn point, from 0. The stones are the same at every point.
        base : bool
            With the ground, a fixed block, as `pirca.analyse` needs one.
        """
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "wall.json"
            answered = self._ask(
                "wall",
                threads=None,
                arm=arm,
                member=member,
                point=point,
                with_base=base,
                members=self._members,
                out=file,
            )
            text = file.read_text(encoding="utf-8")
        drawn = json.loads(answered.json)
        del drawn["out"]
        return Wall(text, drawn)

    def capacity(
        self,
        *,
        quantile: float | None = None,
        demand: str | None = None,
        below_deg: float | None = None,
        above_m: float | None = None,
        below_n: float | None = None,
        measured: bool = False,
        walls: int | None = None,
        cov: float | None = None,
        method: str | None = None,
        half_width: float | None = None,
        known_cov: float | None = None,
        out: Path_ | None = None,
        report: bool = False,
        progress: bool = False,
        client: Client | None = None,
        shards: int | None = None,
    ) -> Answer:
        """Say what walls may be counted on to bear, as `pirca capacity`: without a question the 5 % quantile.

        Parameters
        ----------
        quantile : float, optional
            Which share of walls lie below the value sought.
        demand : str, optional
            How probable is it that a wall does not bear this, or moves further: "0.15g", "8.5deg", "12kN", "4mm"?
        below_deg, above_m, below_n : float, optional
            How probable is a collapse before this tilt (deg), a displacement beyond this (m), a shear capacity below this (N)?
        measured : bool
            Take the collapse angles in `measured.csv` alone, and simulate nothing.
        walls, cov, method, half_width : optional
            Further walls towards a small probability or a narrow quantile; see `pirca capacity --help`.
        known_cov : float, optional
            Coefficient of variation of such walls, where more than these walls tell it: 0.1 is 10 %. It is tested against them:
            where it is in doubt there is a warning, and `answer["groups"]` has the values without it as well.
        out, report, progress
            As of `run`.
        client, shards
            As of `run`, for the further walls.
        """
        own = {} if measured else {"members": self._members}

        def answered() -> Answered:
            return self._ask(
                "capacity",
                measured=measured,
                quantile=quantile,
                demand=demand,
                below_deg=below_deg,
                above_m=above_m,
                below_n=below_n,
                walls=walls,
                cov=cov,
                method=method,
                half_width=half_width,
                known_cov=known_cov,
                batches=client is not None,
                out=out,
                report=report,
                progress=progress,
                **own,
            )

        answer = answered()
        # Which walls are needed next depends on what came of the last ones.
        while client is not None and "batch" in (waits := json.loads(answer.json)):
            batch = Path(waits["batch"])
            _share(client, shards, progress, self.name, batch, batch, {}, waits["walls"])
            answer = answered()
        return Answer(answer)

    def sensitivity(
        self,
        *,
        arm: str | None = None,
        point: int = 0,
        points: int | None = None,
        out: Path_ | None = None,
        report: bool = False,
        progress: bool = False,
    ) -> Answer:
        """Say where the scatter of walls comes from, as `pirca sensitivity`: shares of the variance by source.

        Parameters
        ----------
        arm, point
            As of `wall`.
        points : int, optional
            Base points, a multiple of 16; each costs two walls and one more for every source. 256 without it.
        out, report, progress
            As of `run`.
        """
        return Answer(
            self._ask("sensitivity", arm=arm, point=point, points=points, out=out, report=report, progress=progress)
        )

    def compare(
        self,
        arms: Sequence[str] | None = None,
        *,
        quantile: float | None = None,
        demand: str | None = None,
        below_deg: float | None = None,
        above_m: float | None = None,
        below_n: float | None = None,
        point: int = 0,
        confidence: float | None = None,
        walls: int | None = None,
        same_within_deg: float | None = None,
        same_within_m: float | None = None,
        same_within_n: float | None = None,
        same_within_share: float | None = None,
        out: Path_ | None = None,
        report: bool = False,
        progress: bool = False,
    ) -> Answer:
        """Say which arm is the best, and how sure that is, as `pirca compare`.

        Parameters
        ----------
        arms : list of str, optional
            The arms to compare; all without it.
        quantile, demand, below_deg, above_m, below_n : optional
            What is compared, as in `capacity`; the mean without one.
        point : int
            Number of the kn point, from 0.
        confidence : float, optional
            Probability with which all that is said holds together; 0.95 without it.
        walls : int, optional
            Most walls that are evaluated in all arms together; 1000 without it.
        same_within_deg, same_within_m, same_within_n, same_within_share : float, optional
            Differences that do not matter.
        out, report, progress
            As of `run`.
        """
        return Answer(
            self._ask(
                "compare",
                arms=None if arms is None else list(arms),
                quantile=quantile,
                demand=demand,
                below_deg=below_deg,
                above_m=above_m,
                below_n=below_n,
                point=point,
                confidence=confidence,
                walls=walls,
                same_within_deg=same_within_deg,
                same_within_m=same_within_m,
                same_within_n=same_within_n,
                same_within_share=same_within_share,
                out=out,
                report=report,
                progress=progress,
            )
        )

    def plan_tests(
        self,
        specimens: int,
        *,
        cov: float | None = None,
        error_deg: float | None = None,
        error_m: float | None = None,
        power: float | None = None,
        confidence: float | None = None,
        loss: float | None = None,
        point: int = 0,
        out: Path_ | None = None,
        report: bool = False,
        progress: bool = False,
    ) -> Answer:
        """Say how many specimens to test, and what to read, as `pirca plan-tests`.

        Parameters
        ----------
        specimens : int
            Specimens of each arm that might be tested.
        cov : float, optional
            Coefficient of variation of real specimens (0.05 is 5 %); that of simulated ones without it.
        error_deg, error_m : float, optional
            Standard deviation of the error of an angle (deg) and of a displacement (m) that is read; 0.25 and 0.0001 without them.
        power, confidence : float, optional
            Probability of seeing a difference, and of not seeing one that is not there; 0.8 and 0.95 without them.
        loss : float, optional
            Share of the true 5 % fractile that the characteristic value may lose in the mean; 0.05 without it.
        point : int
            Number of the kn point, from 0.
        out, report, progress
            As of `run`.
        """
        return Answer(
            self._ask(
                "plan-tests",
                specimens=specimens,
                members=self._members,
                cov=cov,
                error_deg=error_deg,
                error_m=error_m,
                power=power,
                confidence=confidence,
                loss=loss,
                point=point,
                out=out,
                report=report,
                progress=progress,
            )
        )

    def __getattr__(self, name):
        if name == "influence":
            raise AttributeError("`influence` is called `sensitivity` now")
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    def detectability(
        self,
        *,
        members: int | None = None,
        quantile: float | None = None,
        out: Path_ | None = None,
        report: bool = False,
        progress: bool = False,
    ) -> Answer:
        """Say which mechanisms the measurements of the study could show, as `pirca detectability`.

        Parameters
        ----------
        members : int, optional
            Walls in every arm that was measured; 3 without it.
        quantile : float, optional
            Quantile of the priors, counted from the end at which a mechanism is weak; 0.84 without it.
        out, report, progress
            As of `run`.
        """
        given = {"variant": self._variant, "threads": self._threads}
        options = {"members": members, "quantile": quantile, "out": out, "report": report, "progress": progress}
        return Answer(ask("detectability", self.path, **given, **options))

    def readings(
        self,
        *,
        departures: int | None = None,
        out: Path_ | None = None,
        report: bool = False,
        progress: bool = False,
    ) -> Answer:
        """Say which variants of the study, alone or together, explain what was published, as `pirca readings`.

        Parameters
        ----------
        departures : int, optional
            Most variants that are read together; 2 without it.
        out, report, progress
            As of `run`.
        """
        if self._variant is not None:
            raise UsageError("readings tries the variants of a study itself: take the study without a variant")
        given = {"members": self._members, "seed": self._seed, "threads": self._threads}
        options = {"departures": departures, "out": out, "report": report, "progress": progress}
        return Answer(ask("readings", self.path, **given, **options))

    def homogenise(
        self,
        *,
        stones: Sequence[int | str] | None = None,
        cells: int | None = None,
        walls: int | None = None,
        plates: int | None = None,
        arms: Sequence[str] | None = None,
        point: int = 0,
        directions: Sequence[str] | None = None,
        method: Sequence[str] | None = None,
        pressure_pa: float | None = None,
        out: Path_ | None = None,
        report: bool = False,
        progress: bool = False,
    ) -> Answer:
        """Say what masonry of the study's arms is as a plate, as `pirca homogenise`.

        Parameters
        ----------
        stones : sequence of int or str, optional
            Stones along a side of the cells, from small to large; "8x6" is 8 stones along the wall in 6 courses. 2, 4 and 8 without it.
        cells : int, optional
            Random cells of each size and arm; 50 without it.
        walls, plates : int, optional
            Random walls of each arm by limit analysis of all their stones, and plates with the strength of cells to compare them with;
            without `walls` none.
        arms : sequence of str, optional
            The arms; all without it.
        point : int
            Number of the kn point, from 0.
        directions : sequence of str, optional
            Stresses in which directions: "in-plane", "out-of-plane", or "none" for stiffness alone; the first two without it.
        method : sequence of str, optional
            How strength is found: "associative", "non-associative", "elastic"; the first without it.
        pressure_pa : float, optional
            Vertical stress (Pa); without it that of the stones' weight at half the wall's height.
        out, report, progress
            As of `run`.
        """
        return Answer(
            self._ask(
                "homogenise",
                stones=stones,
                cells=cells,
                walls=walls,
                plates=plates,
                arms=arms,
                point=point,
                directions=directions,
                method=method,
                pressure_pa=pressure_pa,
                out=out,
                report=report,
                progress=progress,
            )
        )

    def diagnose(
        self,
        measured: Any = None,
        *,
        bank: Path_ | None = None,
        points: int | None = None,
        build: bool = True,
        gain: bool = True,
        law: bool = False,
        out: Path_ | None = None,
        report: bool = False,
        progress: bool = False,
    ) -> Answer:
        """Say what the simulation gets wrong and what explains it, as `pirca diagnose`.

        Parameters
        ----------
        measured : path or data frame, optional
            What was measured, with the columns of `measured.csv`; the study's own file without it. A pandas, polars or pyarrow
            table, or a mapping of columns, is written beside the results as `measured.csv`.
        bank : path, optional
            Folder of the walls that the diagnosis rests on.
        points : int, optional
            Points in the priors for each mechanism that the bank has; 60 without it.
        build : bool
            Simulate the bank if there is none: minutes to hours.
        gain : bool
            Measure what the extended model gains on readings held out: minutes on a large design.
        law : bool
            Where no cause explains the readings, learn a free law of the joints.
        out, report, progress
            As of `run`; the folder without it is `runs/NAME-diagnosis`.
        """
        return Answer(
            self._ask(
                "diagnose",
                measured=self._file_of(measured, out),
                bank=bank,
                points=points,
                no_build=not build,
                no_gain=not gain,
                law=law,
                out=out,
                report=report,
                progress=progress,
            )
        )

    def _ask(self, verb: str, **options: Any) -> Answered:
        given = {"variant": self._variant, "seed": self._seed, "threads": self._threads, **options}
        return ask(verb, self.path, **given)

    def _on(self, client: Client, out: Path_, shards: int | None, progress: bool, asked: Mapping[str, Any]) -> None:
        """Compute shards of walls of this study on workers."""
        options = {"variant": self._variant, "out": Path(out).absolute(), **asked}
        _share(client, shards, progress, self.name, self.path, Path(out), options)

    def _folder(self, what: str = "") -> Path:
        """The folder of results that the command line takes where none is named."""
        variant = re.sub(r"[^\w.=+-]", "_", self._variant or "")
        return Path("runs") / "-".join(part for part in (self.name, variant, what) if part)

    def _file_of(self, measured: Any, out: Path_ | None) -> Path | None:
        """The file of what was measured. It stays, so that what was said of it can be said again."""
        if measured is None or isinstance(measured, (str, Path)):
            return None if measured is None else Path(measured)
        file = Path("runs") / f"{self.name}-measured.csv" if out is None else Path(out) / "measured.csv"
        text = _csv(measured)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file

    def __repr__(self) -> str:
        return f"<Study {self.name}: {', '.join(self.arms)}>"

    def __str__(self) -> str:
        return self.text


def _share(client: Client, shards: int | None, progress: bool, *walls: Any) -> None:
    # Dask is there where somebody has a client.
    from pirca.shards import Work, shards_on

    shards_on(client, Work(*walls), shards, progress=progress)


def _csv(table: Any) -> str:
    """A table as CSV; what is missing is empty."""
    if hasattr(table, "write_csv"):
        return str(table.write_csv())
    if hasattr(table, "to_csv"):
        return str(table.to_csv(index=False))
    if hasattr(table, "to_pydict"):
        table = table.to_pydict()
    if not isinstance(table, Mapping):
        raise UsageError(
            f"measured: a path, a pandas, polars or pyarrow table, or a mapping of columns is needed, and {type(table)} is none"
        )
    columns = {name: list(values) for name, values in table.items()}
    if len({len(values) for values in columns.values()}) > 1:
        raise UsageError("measured: the columns are not of the same length")
    text = io.StringIO()
    writer = csv_writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*columns.values()))
    return text.getvalue()


def _toml(value: str | float | Sequence[Any] | Mapping[str, Any]) -> str:
    """A value as TOML has it, in one line; without a plus, which stands between variants."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{json.dumps(key)} = {_toml(own)}" for key, own in value.items()) + " }"
    if isinstance(value, Sequence) and not isinstance(value, str):
        return "[" + ", ".join(_toml(own) for own in value) + "]"
    return json.dumps(value).replace("e+", "e")
