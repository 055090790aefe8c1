"""The part of the panel in which membership functions are tuned."""

from collections.abc import Callable
from pathlib import Path
from threading import Lock

import viser

from ion.view.tune.dials import Dials
from ion.view.tune.rest import RestOfRun, Task
from ion.view.tune.terms import Place, Points, places
from ion.view.tune.tuning import Tuning

SHOW, WRITE = "Show what changed", "Write it"
FIRST = "steering: focus, delta_2_rad"


class TuneFolder:
    """Dials, and what to do with what they say.

    Args:
        gui: drawn in.
        tuning: changed by the dials.
        rest: drives on with it.
        folder: where the files go.
        changed: is called when what is tuned has changed.
        now_s: the moment shown.
    """

    def __init__(
        self, gui: viser.GuiApi, tuning: Tuning, rest: RestOfRun, folder: Path,
        changed: Callable[[], None], now_s: Callable[[], float],
    ) -> None:  # fmt: skip
        self._gui, self._tuning, self._rest = gui, tuning, rest
        self._target, self._changed, self._now_s = folder, changed, now_s
        self._one_at_a_time = Lock()  # events of one client come in several threads
        self._places = {str(place): place for place in places(tuning.parameters)}
        self._folder = gui.add_folder("tune", expand_by_default=False)
        with self._folder:
            self._which = gui.add_dropdown("variable", tuple(self._places), initial_value=FIRST)
            self._said = gui.add_markdown("Drag a breakpoint, or type one.", order=1e6)
            self._add_buttons()
        self._dials = self._made()
        self._which.on_update(lambda _: self._choose())

    def _add_buttons(self) -> None:
        gui = self._gui
        self._save = gui.add_button(SHOW, order=1e6 + 1)
        reset = gui.add_button("Reset", order=1e6 + 2)
        rest = gui.add_button("Rest of the run", order=1e6 + 3)
        self._went_on = gui.add_markdown("", order=1e6 + 4)
        rest.on_click(lambda _: self._drive())
        self._save.on_click(lambda _: self._show_or_write())
        reset.on_click(lambda _: self._reset())

    def tell(self, words: str) -> None:
        """How the rest of the run goes."""
        self._went_on.content = words

    def _say(self, words: str) -> None:
        self._said.content = words

    def _made(self) -> Dials:
        place: Place = self._places[self._which.value]
        with self._folder:
            return Dials(self._gui, place, self._tuning.parameters, self._turn)

    def _choose(self) -> None:
        self._dials.remove()
        self._dials = self._made()

    def _turn(self, place: Place, term: str, points: Points) -> None:
        with self._one_at_a_time:
            self._take(place, term, points)

    def _take(self, place: Place, term: str, points: Points) -> None:
        self._tuning.turn(place, term, points)
        self._save.label = SHOW
        if self._tuning.refused:
            self._say(f"Not taken: {self._tuning.refused}")
            return
        self._dials.show(self._tuning.parameters)
        self._say("")
        self._changed()

    def _reset(self) -> None:
        self._tuning.reset()
        self._dials.show(self._tuning.parameters)
        self._save.label = SHOW
        self._say("As the tape has it.")
        self._changed()

    def _show_or_write(self) -> None:
        diff = self._tuning.diff()
        if not diff:
            self._say("Nothing is changed.")
        elif self._save.label == SHOW:
            self._say(f"```diff\n{diff}\n```\nThis goes to `{self._target}`.")
            self._save.label = WRITE
        else:
            self._write()

    def _write(self) -> None:
        try:
            paths = self._tuning.save(self._target)
        except OSError as error:
            self._say(f"{self._target}: cannot be written: {error.strerror}")
            return
        names = ", ".join(f"`{path}`" for path in paths)
        self._say(f"Written: {names}. `ion replay --parameters {self._target}` tries it on a tape.")
        self._save.label = SHOW

    def _drive(self) -> None:
        self._rest.ask(Task(self._now_s(), self._tuning.files()))
        self.tell("Driving it again ...")
