"""The diagram of the machine is the table by which it runs."""

from pathlib import Path

from nav.states.diagram import mermaid
from nav.states.machine import PLANNERS
from nav.states.transitions import TRANSITIONS

PAGE = Path(__file__).parents[1] / "docs" / "states.md"


def test_the_page_shows_the_machine():
    assert f"```mermaid\n{mermaid()}```" in PAGE.read_text(encoding="utf-8")


def test_every_state_has_a_planner_and_leads_to_states():
    assert set(TRANSITIONS) == set(PLANNERS)
    assert {target for ways in TRANSITIONS.values() for target, _ in ways} <= set(PLANNERS)


def test_tunnel_mode_leaves_only_to_path_point_keeping():
    assert {target for target, _ in TRANSITIONS["tunnel_mode"]} == {"path_point_keeping"}
