"""What a page shows: a drive, as far as it is read, and where its clock stands."""

from dataclasses import dataclass, field
from threading import Event

from ion.recorded import Recorded
from ion.view import marks
from ion.view.player import Player
from ion.view.timeline import Timeline
from scenarios.course import Course


@dataclass
class Show:
    """Shared by the controls, which change the clock, and the loop that draws."""

    recorded: Recorded
    timeline: Timeline
    player: Player = field(default_factory=Player)
    changed: Event = field(default_factory=Event)

    def title(self, course: Course) -> str:
        """What was driven."""
        return f"{course.name}, seed {self.recorded.seed}"

    def wake(self) -> None:
        """Draw at once."""
        self.changed.set()

    def events(self) -> list[marks.Mark]:
        """Moments to jump to."""
        return marks.events(self.recorded, self.timeline)

    def replannings(self) -> list[marks.Mark]:
        """New local paths."""
        return marks.replannings(self.timeline)
