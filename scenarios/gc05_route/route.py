"""The route definition file."""

from functools import cache

from nav.route.geodesy import Frame
from nav.route.rddf import MILE_M, parse
from scenarios.course import Floats
from scenarios.gc05_route.limits import half_widths_ft, speeds_mph
from scenarios.gc05_route.line import positions_m
from scenarios.gc05_route.plan import Plan, load_plan
from scenarios.route.statistics import length_m

NAME = "gc05.rddf"


@cache
def text() -> str:
    """Its text."""
    plan = load_plan()
    position = positions_m(plan)
    longer = length_m(parse(_text(plan, position), NAME)) / (plan.miles * MILE_M)
    return _text(plan, position / longer)


def _text(plan: Plan, position: Floats) -> str:
    lat, lon = Frame(*plan.anchor_deg).to_geodetic(position)
    rows = zip(lat, lon, half_widths_ft(plan, position), speeds_mph(plan, position), strict=True)
    return "".join(
        f"{k},{a:.7f},{b:.7f},{w:g},{v:g},####,####,####\n"
        for k, (a, b, w, v) in enumerate(rows, start=1)
    )
