"""What one can press, and what one reads."""

from time import monotonic

import viser

from ion.view.cameras import CAMERAS, FOLLOW, FREE
from ion.view.curves import Curves, band
from ion.view.marks import Mark, following, preceding
from ion.view.player import FASTEST, NEWEST, SLOWEST
from ion.view.sensor_scene import LAYERS
from ion.view.show import Show
from ion.view.timeline import Moment
from ion.view.words import sentence

LATEST = "newest"
SPEEDS = (*(f"{2.0**k:g}x" for k in range(-2, 5)), LATEST)
READ_S = 0.3
"""From one look of the panel to the next while it plays."""
STEP_S = 0.02
"""The slider's: one call of the navigator."""
assert SPEEDS[0] == f"{SLOWEST:g}x"
assert SPEEDS[-2] == f"{FASTEST:g}x"


class Panel:
    """The controls. What is pressed changes the player; `refresh` shows where that stands.

    Args:
        gui: drawn in.
        show: what is shown, and whom to wake when it changes.
        title: of the drive.
    """

    def __init__(self, gui: viser.GuiApi, show: Show, title: str) -> None:
        self._gui, self._show = gui, show
        self._drawn: object = None
        self._drawn_s = 0.0
        gui.set_panel_label(title)
        self._words = gui.add_markdown("")
        self._add_clock()
        self._band = gui.add_html("")
        self._add_jumps()
        self._add_looks()
        self._curves = Curves(gui)

    def refresh(self, moment: Moment) -> None:
        """Show a moment; while it plays not more often than people read and browsers can follow."""
        timeline, player = self._show.timeline, self._show.player
        state, now = (moment.time_s, timeline.end_s, player.playing), monotonic()
        if state == self._drawn or (player.playing and now < self._drawn_s + READ_S):
            return
        self._drawn, self._drawn_s = state, now
        if timeline.end_s > self._slider.max:
            self._slider.max = timeline.end_s
        self._slider.value = min(round(moment.time_s, 3), self._slider.max)
        self._play.visible, self._pause.visible = not player.playing, player.playing
        loading = "" if timeline.complete else f"{timeline.end_s:.0f} s so far"
        self._note.content = timeline.trouble or loading
        self._note.visible = bool(self._note.content)
        self._words.content = sentence(moment)
        self._band.content = band(timeline, moment.time_s)
        self._curves.show(timeline, moment.time_s)

    @property
    def camera(self) -> str:
        """The chosen one."""
        return self._camera.value

    @property
    def hidden(self) -> set[str]:
        """Layers that shall not be seen."""
        return {name for name, box in self._layers.items() if not box.value}

    # ------------------------------------------------------------------ time

    def _add_clock(self) -> None:
        gui, player = self._gui, self._show.player
        self._slider = gui.add_slider("time [s]", 0.0, 1.0, STEP_S, 0.0)
        self._note = gui.add_markdown("")
        # two buttons: what was pressed is meant, though the drive may have ended meanwhile
        self._play, self._pause = gui.add_button("Play"), gui.add_button("Pause", visible=False)
        speed = gui.add_dropdown("speed", SPEEDS, initial_value="1x")

        @self._slider.on_update
        def _(event: viser.GuiEvent) -> None:
            if event.client is not None:  # a person, not `refresh`
                self._go(self._slider.value)

        @self._play.on_click
        def _(_: viser.GuiEvent) -> None:
            player.play(self._show.timeline.end_s)
            self._show.wake()

        @self._pause.on_click
        def _(_: viser.GuiEvent) -> None:
            self._go(None)

        @speed.on_update
        def _(_: viser.GuiEvent) -> None:
            asked = speed.value
            player.speed = NEWEST if asked == LATEST else float(asked.removesuffix("x"))

    def _go(self, time_s: float | None) -> None:
        self._show.player.go(time_s)
        self._show.wake()

    # ------------------------------------------------------------------ jumps

    def _add_jumps(self) -> None:
        show, player = self._show, self._show.player
        step = self._gui.add_button_group("decision", ("back", "forward"))
        event = self._gui.add_button_group("event", ("previous", "next"))
        path = self._gui.add_button_group("new path", ("previous", "next"))
        self._last = self._gui.add_markdown("")

        @step.on_click
        def _(_: viser.GuiEvent) -> None:
            decisions = show.timeline.decision
            find = decisions.next_s if step.value == "forward" else decisions.previous_s
            self._go(find(player.time_s))

        @event.on_click
        def _(_: viser.GuiEvent) -> None:
            self._jump(show.events(), event.value)

        @path.on_click
        def _(_: viser.GuiEvent) -> None:
            self._jump(show.replannings(), path.value)

    def _jump(self, marks: list[Mark], way: str) -> None:
        find = following if way == "next" else preceding
        mark = find(marks, self._show.player.time_s)
        self._last.content = (
            f"{mark.time_s:.1f} s: {mark.text}" if mark else f"There is no {way} one."
        )
        self._go(mark and mark.time_s)

    # ------------------------------------------------------------------ looks

    def _add_looks(self) -> None:
        self._camera = self._gui.add_dropdown("camera", (*CAMERAS, FREE), initial_value=FOLLOW)
        self._camera.on_update(lambda _: self._show.wake())
        with self._gui.add_folder("show", expand_by_default=False):
            self._layers = {name: self._gui.add_checkbox(name, True) for name in LAYERS}
        for box in self._layers.values():
            box.on_update(lambda _: self._show.wake())
