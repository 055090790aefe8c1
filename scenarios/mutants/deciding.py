"""Mutants that decide wrongly: states never entered, checks that pass all, old decisions."""

from collections.abc import Container, Mapping
from dataclasses import replace
from functools import partial

from nav.fusion.health import Health, HealthMonitor
from nav.fusion.obstacle_map import ObstacleMap
from nav.fusion.plausibility import Plausibility
from nav.fusion.plausibility.witnesses import Ego
from nav.high_level import HighLevelController, Senses
from nav.messages import Command, Decision, SensorMessage
from nav.navigator import IonNavigator
from nav.states import (
    alarm,
    obstacle_avoidance,
    road_following,
    robotic_operations,
    rollback,
    tunnel_mode,
)
from nav.states.machine import Machine
from nav.states.situation import Situation
from nav.states.transitions import TRANSITIONS
from scenarios.mutants.mutant import Mutant, remade

STALE_NS = 1_000_000_000


class BarredMachine(Machine):
    """Never enters one state; what would come after it is entered instead."""

    barred: str

    def _enter(self, state: str, reason: str, by: str, s: Situation) -> None:
        if state == self.barred:
            self._enter_another(s)
        else:
            super()._enter(state, reason, by, s)

    def _enter_another(self, s: Situation) -> None:
        """The guards that the barred state's has outrun have their turn."""
        for target, guard in TRANSITIONS[self.state]:
            if target == self.barred:
                continue
            if reason := guard(s, self.memory, self.parameters):
                self._enter(target, reason, guard.__name__, s)
                return


class CarelessMonitor(HealthMonitor):
    """Finds every sensor well."""

    def check(
        self, time_ns: int, newest_ns: Mapping[str, int], doubted: Container[str] = ()
    ) -> Health:
        """Nothing has failed."""
        return Health()


class Credulity(Plausibility):
    """Believes every message."""

    def believes(self, message: SensorMessage, ego: Ego) -> bool:
        """Yes."""
        return True


class SlowController(HighLevelController):
    """Decides once a second, and says the same in between."""

    said: tuple[Command, Decision] | None = None

    def decide(
        self, time_ns: int, senses: Senses, obstacles: ObstacleMap
    ) -> tuple[Command, Decision]:
        """The newest decision; what makes the vehicle stop for want of one does not notice."""
        if self.said is None or time_ns - self.said[1].time_ns >= STALE_NS:
            self.said = super().decide(time_ns, senses, obstacles)
        command, decision = self.said
        return replace(command, time_ns=time_ns), replace(decision, time_ns=time_ns)


def _never(state: str, navigator: IonNavigator) -> IonNavigator:
    high = navigator.high_level
    high.machine = remade(BarredMachine, high.machine, barred=state)
    return navigator


def _careless(navigator: IonNavigator) -> IonNavigator:
    navigator.health = remade(CarelessMonitor, navigator.health)
    return navigator


def _credulous(navigator: IonNavigator) -> IonNavigator:
    navigator.plausibility = remade(Credulity, navigator.plausibility)
    return navigator


def _slow(navigator: IonNavigator) -> IonNavigator:
    navigator.high_level = remade(SlowController, navigator.high_level)
    return navigator


_BARRED = (
    obstacle_avoidance, tunnel_mode, robotic_operations, rollback, road_following, alarm,
)  # fmt: skip

DECIDING = {
    **{
        f"never_{state.NAME}": Mutant(
            f"The machine never enters {state.NAME.replace('_', ' ').title()}.",
            partial(_never, state.NAME),
        )
        for state in _BARRED
    },
    "careless_health_monitor": Mutant("No sensor is ever found to have failed.", _careless),
    "believes_all": Mutant("What a sensor says is never doubted.", _credulous),
    "stale_decisions": Mutant("Decisions are made once a second, not ten times.", _slow),
}
"""By name."""
