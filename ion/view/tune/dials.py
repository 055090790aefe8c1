"""One fuzzy variable: its terms drawn, and its breakpoints to drag or to type."""

from collections.abc import Callable
from contextlib import suppress

import numpy as np
import viser
from viser import uplot

from ion.style import DECIDED, GOAL, REAL, SAFE, SEEN, TRACK
from ion.view.tune.terms import OUTPUT, Place, Points, points_of, range_of, rule_base
from nav.fuzzy.membership import memberships
from nav.messages import Floats
from nav.parameters import Parameters

COLORS = (REAL, SAFE, SEEN, GOAL, TRACK, DECIDED)
STEPS = 400
"""Of a slider over the range of its variable."""
SAMPLES = 240
HEIGHT_PX = 130
MARGIN = 1.15
"""The picture ends a little beyond the last breakpoint."""
Turned = Callable[[Place, str, Points], None]
"""Is told which term got which points, by a person."""


class Dials:
    """Built into what is open; `remove` takes them away again.

    Args:
        gui: drawn in.
        place: of the variable.
        parameters: that are in force.
        turned: is called when somebody turns one.
    """

    def __init__(
        self, gui: viser.GuiApi, place: Place, parameters: Parameters, turned: Turned
    ) -> None:
        self._place, self._turned = place, turned
        self._sliders: dict[str, viser.GuiMultiSliderHandle[float]] = {}
        self._texts: dict[str, viser.GuiTextHandle] = {}
        points, (low, high) = points_of(parameters, place), range_of(parameters, place)
        self._plot = None if place.variable == OUTPUT else _plot(gui, place, parameters)
        high = min(high, max(p[-1] for p in points.values()) * 2.0)
        step = _step(high - low)
        for name, at in points.items():
            slider = gui.add_multi_slider(name, low, high, step, at)
            text = gui.add_text(f"{name} =", _typed(at))
            self._sliders[name], self._texts[name] = slider, text
            self._listen(name, slider, text)

    def _listen(
        self, name: str, slider: "viser.GuiMultiSliderHandle[float]", text: viser.GuiTextHandle
    ) -> None:
        @slider.on_update
        def _(event: viser.GuiEvent) -> None:
            if event.client is not None:
                self._turned(self._place, name, tuple(float(v) for v in slider.value))

        @text.on_update
        def _(event: viser.GuiEvent) -> None:
            with suppress(ValueError):  # somebody is still typing
                if event.client is not None:
                    self._turned(self._place, name, tuple(map(float, text.value.split(","))))

    def show(self, parameters: Parameters) -> None:
        """Show what is in force."""
        for name, at in points_of(parameters, self._place).items():
            if tuple(self._sliders[name].value) != at:
                self._sliders[name].value = at
            if self._texts[name].value != _typed(at):
                self._texts[name].value = _typed(at)
        if self._plot:
            self._plot.data = _drawn(self._place, parameters)

    def remove(self) -> None:
        """Make room for another variable."""
        plots = [self._plot] if self._plot else []
        for handle in (*plots, *self._sliders.values(), *self._texts.values()):
            handle.remove()


def _typed(points: Points) -> str:
    return ", ".join(f"{point:g}" for point in points)


def _step(span: float) -> float:
    """A round number, about one of STEPS."""
    return float(10.0 ** np.floor(np.log10(span / STEPS)))


def _plot(gui: viser.GuiApi, place: Place, parameters: Parameters) -> viser.GuiUplotHandle:
    """The membership of each value in each term."""
    data = _drawn(place, parameters)
    terms = points_of(parameters, place)
    lines = [
        uplot.Series(label=name, stroke=COLORS[k % len(COLORS)], width=2)
        for k, name in enumerate(terms)
    ]
    return gui.add_uplot(
        data,
        (uplot.Series(label=place.variable), *lines),
        title=place.variable,
        scales={
            "x": uplot.Scale(time=False, auto=False, range=(data[0][0], data[0][-1])),
            "y": uplot.Scale(auto=False, range=(0.0, 1.05)),
        },
        legend=uplot.Legend(show=True, live=False),
        padding=(10, 14, 0, 0),
        height=HEIGHT_PX,
    )


def _drawn(place: Place, parameters: Parameters) -> tuple[Floats, ...]:
    """Values and, of each term, their memberships."""
    variable = rule_base(parameters, place.controller, place.base).inputs[place.variable]
    low, high = variable.range
    x = np.linspace(low, min(high, MARGIN * max(variable.breakpoints)), SAMPLES)
    return (x, *memberships(variable.flanks, x))
