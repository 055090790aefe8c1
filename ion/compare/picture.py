"""Variants of one drive as a picture: way against time."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ion.compare.variants import Comparison, Drive
from ion.style import DPI, INK, MISSED, PASSED, new_figure, plain

STYLES = ("-", "--", ":", "-.")


def draw(drives: Sequence[Drive], comparison: Comparison, path: Path) -> None:
    """Write the picture as PNG: one line a variant of one seed.

    Raises:
        OSError: the file cannot be written.
    """
    figure = new_figure(10.0, 6.0)
    axes = figure.add_subplot()
    plain(axes, f"{comparison.source.title}, seed {drives[0].seed}: how far, and when")
    for drive in drives:
        time_s, way_m = [look.time_s for look in drive.looks], [look.way_m for look in drive.looks]
        said = _said(comparison.variants[drive.variant])
        label = f"{said}: {drive.outcome}"
        axes.plot(time_s, way_m, STYLES[drive.variant % len(STYLES)], linewidth=1.4, label=label)
        ended = PASSED if drive.outcome == "finished" else MISSED
        axes.plot(time_s[-1], way_m[-1], "o", color=ended, markersize=5.0)
    if comparison.at_s:
        axes.axvline(comparison.at_s, color=INK, linewidth=0.7)
    axes.set_xlabel("time, s", color=INK)
    axes.set_ylabel("way, m", color=INK)
    axes.legend(frameon=False, fontsize=8.0)
    figure.savefig(path, dpi=DPI, format="png")


def _said(variant: dict[str, Any]) -> str:
    return ", ".join(f"{name.split('.')[-1]} {value}" for name, value in variant.items())
