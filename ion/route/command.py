"""`ion route`: read, tell, draw."""

import json
from math import degrees
from typing import Any

from rich.console import Console
from rich.table import Table

from ion.out_file import write_whole
from ion.route.options import Options, read
from ion.route.picture import draw
from nav.route.rddf import parse
from scenarios.route.statistics import Statistics, statistics


def route(options: Options) -> int:
    """Do what the options ask; returns the exit code.

    Raises:
        UsageError: a file that cannot be read or written.
        NavError: the file is no route.
    """
    text, name = read(options)
    parsed = parse(text, name)
    figures = statistics(parsed)
    draw(parsed, options.out)
    if options.write is not None:
        write_whole(options.write, text)
    if options.json:
        print(json.dumps({"route": name} | said(figures)))
        return 0
    Console().print(_table(name, figures))
    print(f"picture: {options.out}")
    return 0


def said(s: Statistics) -> dict[str, Any]:
    """The figures for JSON."""
    words = dict(zip(("least", "median", "mean", "greatest"), s.half_width_ft, strict=True))
    shares = {f"{mph:g}": share for mph, share in s.speed_share.items()}
    return s._asdict() | {"half_width_ft": words, "speed_share": shares}


def _table(name: str, s: Statistics) -> Table:
    table = Table(title=name, show_header=False)
    least, median, mean, greatest = s.half_width_ft
    shares = ", ".join(f"{mph:g} mph {share:.1%}" for mph, share in s.speed_share.items())
    for what, value in (
        ("waypoints", f"{s.waypoints}"),
        ("length", f"{s.miles:.2f} miles"),
        ("mean spacing", f"{s.mean_spacing_m:.1f} m"),
        ("half-width", f"{least:g} to {greatest:g} ft, median {median:g}, mean {mean:.1f}"),
        ("speed limits, by length", shares),
        ("sharpest turn", f"{degrees(s.sharpest_turn_rad):.1f} degrees"),
        ("turns above 30 degrees", f"{s.sharp_turns}"),
        ("tightest switchback", f"{degrees(s.switchback_rad):.0f} degrees within 40 m"),
        ("at the speed limits", f"{s.at_limits_s / 3600.0:.2f} hours"),
    ):
        table.add_row(what, value)
    return table
