"""All figures of how a drive was driven, as one watch."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from scenarios.behaviour.comfort import Comfort
from scenarios.behaviour.commands import Commands
from scenarios.behaviour.energy import Energy
from scenarios.behaviour.localization import Localization
from scenarios.behaviour.reaction import Reaction
from scenarios.behaviour.sensing import Sensing
from scenarios.behaviour.speed import Speed
from scenarios.behaviour.transitions import Transitions
from scenarios.behaviour.watchdog import Standing
from scenarios.episode import Episode
from tape.record import Record


@dataclass
class Behaviour:
    """Watches a run from its first tick (`scenarios.run.run`). Picklable in the middle."""

    comfort: Comfort = field(default_factory=Comfort)
    commands: Commands = field(default_factory=Commands)
    energy: Energy = field(default_factory=Energy)
    transitions: Transitions = field(default_factory=Transitions)
    standing: Standing = field(default_factory=Standing)
    speed: Speed = field(default_factory=Speed)
    sensing: Sensing = field(default_factory=Sensing)
    reaction: Reaction = field(default_factory=Reaction)
    localization: Localization = field(default_factory=Localization)

    def __call__(self, episode: Episode, records: Sequence[Record]) -> None:
        """Show all of them this tick."""
        for watch in self._all():
            watch(episode, records)

    def figures(self) -> dict[str, Any]:
        """All that was measured, ready for JSON; None where there was nothing to measure."""
        return {name: value for watch in self._all() for name, value in watch.figures().items()}

    def _all(self) -> tuple[Any, ...]:
        """In the order of their figures."""
        return (
            self.comfort, self.commands, self.energy, self.transitions, self.standing, self.speed,
            self.sensing, self.reaction, self.localization,
        )  # fmt: skip
