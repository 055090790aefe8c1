"""One drive from its course to its tape and map. A job can be sent to another process."""

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ion.courses import SCENARIO_FILE, Source
from ion.segments import Checkpoint, Checkpoints, Segments, is_long
from scenarios.batch import stop_asked
from scenarios.processor import fingerprint
from scenarios.run import Watch, run

if TYPE_CHECKING:
    from ion.recorded import Recorded
    from ion.trace import Trace
    from scenarios.course import Course
    from scenarios.episode import Episode
    from tape.held_back import HeldBack
    from tape.writer import TapeWriter


TAPE = ".mcap"


@dataclass(frozen=True)
class Job:
    """What `ion drive` was asked for, without the seed."""

    source: Source
    out: Path
    log: str = "full"
    ablate: tuple[str, ...] = ()
    failures_only: bool = False
    """Whether tape and map of a drive that went as it should are not kept."""

    def drive(self, seed: int, watches: Sequence[Watch] = ()) -> dict[str, Any]:
        """Drive one seed to its end; returns its figures, and where tape (`log`) and `map` lie.

        Raises:
            NavError: the route cannot be driven.
            OSError: tape or map cannot be written.
        """
        from ion.code import code
        from ion.trace import Trace
        from scenarios.behaviour import Behaviour
        from scenarios.events import Events

        episode = self.source.episode(seed, self.ablate)
        start = Checkpoint(self, seed, 0, episode, Trace(), Events(), Behaviour(), code())
        return self.go_on(start, watches)

    def go_on(self, start: "Checkpoint", watches: Sequence[Watch] = ()) -> dict[str, Any]:
        """As `drive`, from where a checkpoint was written.

        Raises:
            OSError: tape or map cannot be written.
        """
        from ion.recorded import EVENTS, FIGURES
        from ion.telling import as_asked, as_json
        from scenarios.events import as_rows
        from scenarios.true_states import TrueStates

        _, seed, _, episode, trace, events, behaviour, _ = start
        course, tape = episode.course, self._log(episode.course, seed)
        with self._tape(start, tape) as writer:
            told = [*watches, trace, events, behaviour, TrueStates(writer)]
            if isinstance(writer, Segments):
                told.append(Checkpoints(start, writer))
            figures = run(episode, writer, told) | behaviour.figures()
            figures |= {"scenario": self.source.title, "ablate": list(self.ablate)}
            figures |= self._verdicts(figures)
            wanted = not self.failures_only or not as_asked(figures)
            if wanted:
                writer.keep()
                writer.attach(FIGURES, as_json(figures))
                writer.attach(EVENTS, as_json(as_rows(events.found)))
        if not wanted:
            tape.unlink(missing_ok=True)
            return figures | {"log": None, "map": None}
        log = None if self.log == "off" else str(tape)
        return figures | {"log": log, "map": self._draw(course, trace, episode, seed)}

    def _verdicts(self, figures: dict[str, Any]) -> dict[str, Any]:
        """What a scenario's file asks of a drive, and whether it is so."""
        file = self.source.file
        return {"verdicts": [v._asdict() for v in file.judged(figures)]} if file else {}

    def drive_in_worker(self, seed: int) -> dict[str, Any]:
        """As `drive`, for `scenarios.batch`: stops when the user wants no more."""
        return self.drive(seed, [stop_when_asked])

    def path(self, seed: int, suffix: str) -> Path:
        """Where a file of this drive lies."""
        name = "_".join((self.source.name, *self.ablate, f"seed{seed}"))
        return self.out / f"{name}{suffix}"

    def _log(self, course: "Course", seed: int) -> Path:
        """Where the tape goes: of a long drive into a folder."""
        segments = is_long(course) and not self.failures_only
        return self.path(seed, "" if segments else TAPE)

    def _tape(self, start: "Checkpoint", path: Path) -> "HeldBack | Segments":
        """The tape of a drive; one that may not be wanted waits in memory."""
        from tape.held_back import MOST, HeldBack

        course, seed = start.episode.course, start.seed
        if path.suffix != TAPE:
            return Segments(path, lambda part: self._writer(course, seed, part), start.segment)
        most = MOST if self.failures_only else 0
        return HeldBack(lambda: self._writer(course, seed, path), most)

    def recorded(self, seed: int) -> "Recorded":
        """What the tape of this drive says before the first tick."""
        from ion.recorded import Recorded

        course = self.source.course(seed)
        log, attached = self._log(course, seed), self._attached(course)
        return Recorded(log, self._said(course, seed), attached, {}, ())

    def _writer(self, course: "Course", seed: int, path: Path) -> "TapeWriter":
        from tape.writer import TapeWriter

        attached, said = self._attached(course), self._said(course, seed)
        return TapeWriter(path, attached, said, self.log, _view(course.vehicle))

    def _said(self, course: "Course", seed: int) -> dict[str, str]:
        said = {"scenario": self.source.title, "seed": str(seed), "ablate": " ".join(self.ablate)}
        return said | {"vehicle": course.vehicle, **self.source.said} | fingerprint()

    def _attached(self, course: "Course") -> dict[str, str]:
        """The route, the parameters, and the scenario if there is one."""
        from scenarios.parameter_files import parameter_texts

        attached = {course.route_name: course.route_text, **parameter_texts(course.vehicle)}
        if self.source.scenario:
            folder = files("scenarios") / self.source.scenario
            attached["scenario.toml"] = (folder / "scenario.toml").read_text(encoding="utf-8")
        if self.source.file:
            attached[SCENARIO_FILE] = self.source.file.as_json()
        return attached

    def _draw(self, course: "Course", trace: "Trace", episode: "Episode", seed: int) -> str:
        from ion.map_picture import draw_map

        path = self.path(seed, ".png")
        title = _title(course.title, seed, episode.figures())
        draw_map(course, trace, episode.judge, title, path)
        return str(path)


def stop_when_asked(episode: "Episode", records: object) -> None:
    """A watch, for who drives in a worker of `scenarios.batch`."""
    del episode, records  # Unused.
    if stop_asked():
        raise KeyboardInterrupt


def _view(vehicle: str) -> Any:
    """Draws `/view/`, knowing a vehicle's box and where its scanners sit."""
    from scenarios.parameter_files import parameters_of
    from scenarios.vehicles import VEHICLES
    from tape.view import View

    known = parameters_of(vehicle).vehicle
    box = known.outline
    size = (box.front_m, box.rear_m, box.half_width_m, VEHICLES[vehicle].height_m)
    return View(known.lidar_mounts, size)


def _title(course: str, seed: int, figures: dict[str, Any]) -> str:
    from ion.telling import duration, way

    gates = f"{figures['gates_passed']} of {figures['gates_total']} gates, "
    return (
        f"{course}\nSeed {seed}: {figures['outcome']}, {gates if figures['gates_total'] else ''}"
        f"{way(figures['distance_m'])} in {duration(figures['sim_time_s'])}"
    )
