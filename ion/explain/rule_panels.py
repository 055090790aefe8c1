"""How strongly each rule fired: the cells of Table 6.1, and the rules A and T of (6.8)."""

from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from ion.explain.explanation import Explanation
from ion.style import DECIDED, GRID, INK, PAPER, QUIET, REAL, SAFE, head
from nav.fuzzy.rule_base import RuleBase
from nav.fuzzy.rules import Rule
from nav.planning.speed import SpeedDecision

TERMS = ("S", "M", "L")
WORDS = ("Small", "Medium", "Large")
SHOWN = 0.005
"""A weaker rule does not fire."""


def draw_table(axes: Axes, why: Explanation) -> None:
    """Table 6.1: the darker, the stronger; the cell that decided has a frame."""
    assert why.considered is not None
    head(axes, "Table 6.1: the selection rule")
    axes.set(xlim=(-1.35, 3.05), ylim=(4.0, -0.95))
    axes.axis("off")
    decision = why.considered.decision
    rules = why.parameters.steering.select.rules
    strengths = decision.select_rules
    winner = strongest(strengths, decision.selected)
    for rule in rules:
        for x, y, width in _places(rule.when[0]):
            strength = strengths.get(rule.label, 0.0)
            _cell(axes, (x, y, width), rule.then, strength, rule.label == winner)
    for k, word in enumerate(WORDS):
        axes.text(k + 0.5, -0.08, word, color=QUIET, fontsize=8.5, ha="center", va="bottom")
        axes.text(-0.08, k + 0.5, word, color=QUIET, fontsize=8.5, ha="right", va="center")
    axes.text(1.5, -0.42, r"$|\theta_{SD}-\theta_{RD}|$", color=INK, fontsize=9, ha="center")
    axes.text(
        -1.2, 1.5, r"$|\theta_{SD}-\phi|$", color=INK, fontsize=9, ha="center", va="center",
        rotation=90,
    )  # fmt: skip
    axes.text(-0.08, 3.6, "closed (ours)", color=QUIET, fontsize=8.5, ha="right", va="center")


def strongest(strengths: dict[str, float], selected: str) -> str:
    """The rule in words that decided: of those that conclude what was selected, the strongest."""
    return max(
        (label for label in strengths if label.endswith(f"-> {selected}")),
        key=lambda label: strengths[label],
    )


def _places(when: dict[str, str]) -> list[tuple[float, float, float]]:
    """Left, upper edge and width of a rule's cell; what is closed spans the row below."""
    if "offset_rad" not in when:
        return [(0.0, 3.15, 3.0)]
    return [(float(TERMS.index(when["spread_rad"])), float(TERMS.index(when["offset_rad"])), 1.0)]


def _cell(
    axes: Axes, place: tuple[float, float, float], then: str, strength: float, wins: bool
) -> None:
    x, y, width = place
    color = SAFE if then == "safe" else REAL
    box: dict[str, Any] = {"linewidth": 1.0, "edgecolor": PAPER, "zorder": 2}
    shade = 0.13 + 0.87 * strength
    axes.add_patch(Rectangle((x, y), width, 0.95, facecolor=color, alpha=shade, **box))
    if wins:
        axes.add_patch(
            Rectangle((x, y), width, 0.95, fill=False, edgecolor=DECIDED, linewidth=2.2, zorder=4)
        )
    ink = "white" if strength > 0.5 else INK
    name = r"$\theta_{SD}$" if then == "safe" else r"$\theta_{RD}$"
    text = f"{name}  {strength:.2f}" if strength > SHOWN else name
    axes.text(
        x + 0.5 * width, y + 0.475, text, color=ink, fontsize=9, ha="center", va="center",
        fontweight="bold" if wins else "normal", zorder=5,
    )  # fmt: skip


def draw_speed_rules(axes: Axes, why: Explanation) -> None:
    """A bar for each rule, and what the terms of the minimum come to."""
    head(axes, "Speed (6.8): the rules A and T")
    axes.set_facecolor(PAPER)
    axes.axis("off")
    rules, p = why.plan.by_rules, why.parameters.speed
    if rules is None:
        axes.text(0.0, 0.9, "set by the state, not by these rules", color=QUIET, fontsize=9)
        return
    y = _bars(axes, "A of (D1, D)", p.anti_collision, rules.anti_collision_rules, SAFE, 0.0)
    y = _bars(axes, "T of Δθ", p.safe_steering, rules.safe_steering_rules, REAL, y + 0.5)
    axes.set(xlim=(-1.3, 1.2), ylim=(y + 1.6, -0.6))
    axes.text(-1.3, y + 0.9, _terms(rules), color=INK, fontsize=9.5, va="center")


def _bars(
    axes: Axes, name: str, base: RuleBase, strengths: dict[str, float], color: str, y: float
) -> float:
    """The rules of one base below each other, from `y` on; returns where they end."""
    axes.text(-1.3, y, name, color=INK, fontsize=9, va="center", fontweight="bold")
    for rule in base.rules:
        y += 1.0
        strength = strengths[rule.label]
        axes.barh(y, 1.0, color=GRID, height=0.66)
        axes.barh(y, strength, color=color, height=0.66)
        axes.text(-0.03, y, _short(rule, base), color=INK, fontsize=8.5, ha="right", va="center")
        if strength > SHOWN:
            axes.text(1.02, y, f"{strength:.2f}", color=INK, fontsize=8.5, va="center")
    return y + 1.0


def _short(rule: Rule, base: RuleBase) -> str:
    """`(L,M) (M,L): ML` for a rule: the terms in the order of the inputs."""
    ways = [",".join(way.get(name, "-") for name in base.inputs) for way in rule.when]
    inputs = " ".join(f"({way})" if len(base.inputs) > 1 else way for way in ways)
    return f"{inputs}:  {rule.then}"


def _terms(rules: SpeedDecision) -> str:
    names = {"V0": "$V_0$", "A": "$A$", "T": "$T$"}
    terms = [f"{names.get(name, name)} {value:.1f}" for name, value in rules.terms_mps.items()]
    return f"$V_s$ = min[{',  '.join(terms)}] = {rules.speed_mps:.2f} m/s"
