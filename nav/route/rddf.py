"""The route data definition file (RDDF): waypoints with a corridor's half-width and a speed limit.

A line holds: waypoint number, latitude [deg], longitude [deg], lateral boundary offset [ft],
speed limit [mph], and up to three phase-line times, which are ignored.
"""

import math
from dataclasses import dataclass, replace
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from nav.errors import NavError
from nav.route.geodesy import Floats, ecef

FOOT_M = 0.3048
"""International foot (exact, by definition)."""
MILE_M = 5280 * FOOT_M
MPH_MPS = 0.44704
"""International mile an hour (exact, by definition)."""
MAX_JUMP_M = 10_000.0
"""No two neighbouring waypoints of a real route are farther apart (72 m on average in GC05)."""
MIN_SEGMENT_M = 1e-3
"""Shorter is no segment: the file's last digit is worth 1 cm."""
COLUMNS = ("waypoint number", "latitude", "longitude", "boundary offset", "speed limit")


class RouteError(NavError):
    """A route that cannot be driven; names file, line and what was expected."""


@dataclass(frozen=True, eq=False)
class Route:
    """Waypoints in order, arrays of shape (n,), read-only. Width and speed hold until the next."""

    name: str
    number: NDArray[np.int64]
    latitude_deg: Floats
    longitude_deg: Floats
    half_width_m: Floats
    speed_mps: Floats
    """0 is allowed at the last waypoint only: the finish."""

    def __post_init__(self) -> None:
        for array in (self.number, *self._columns()):
            array.setflags(write=False)

    def __len__(self) -> int:
        return len(self.number)

    @property
    def first_deg(self) -> tuple[float, float]:
        """Latitude and longitude of the first waypoint."""
        return float(self.latitude_deg[0]), float(self.longitude_deg[0])

    def _columns(self) -> tuple[Floats, ...]:
        return self.latitude_deg, self.longitude_deg, self.half_width_m, self.speed_mps

    def stretch(self, first_number: int, last_number: int) -> "Route":
        """The part from one waypoint number to another, both included.

        Raises:
            RouteError: a number that the route does not have, or fewer than two waypoints.
        """
        low, high = int(self.number[0]), int(self.number[-1])
        if not low <= first_number < last_number <= high:
            raise RouteError(
                f"{self.name}: no stretch from {first_number} to {last_number}: "
                f"expected two waypoint numbers from {low} to {high}, the first below the last"
            )
        part = slice(first_number - low, last_number - low + 1)
        lat, lon, width, speed = (column[part].copy() for column in self._columns())
        number = self.number[part].copy()
        return replace(
            self, number=number, latitude_deg=lat, longitude_deg=lon,
            half_width_m=width, speed_mps=speed,
        )  # fmt: skip


def parse(text: str, name: str) -> Route:
    """The route in an RDDF's text; feet and miles an hour become metres and metres a second here.

    Args:
        text: the file's text.
        name: the file's name, for messages.

    Raises:
        RouteError: anything that a route file must not have; one line with file, line, expectation.
    """
    rows: list[tuple[float, ...]] = []
    lines: list[int] = []
    for line, content in enumerate(text.split("\n"), start=1):
        if content.strip():
            rows.append(_row(content, f"{name}, line {line}"))
            lines.append(line)
    if len(rows) < 2:
        found = "an empty file" if not rows else "one waypoint"
        raise RouteError(f"{name}: {found}, expected a route file of at least two waypoints")
    number, lat, lon, width, speed = np.array(rows).T.copy()
    _check_order(number, lines, name)
    _check_lengths(lat, lon, lines, name)
    _check_stops(speed, lines, name)
    return Route(name, number.astype(np.int64), lat, lon, width * FOOT_M, speed * MPH_MPS)


def _row(content: str, where: str) -> tuple[float, ...]:
    cells = [cell.strip() for cell in content.split(",")]
    if len(cells) < len(COLUMNS):
        raise RouteError(
            f"{where}: {_clip(content)} has {len(cells)} columns, {COLUMNS[len(cells)]} is missing"
            f", expected {', '.join(COLUMNS)}, separated by commas"
        )
    if not (cells[0].isascii() and cells[0].isdigit()):
        _refuse(where, 0, cells, "a whole number")
    values = [_number(where, column, cells) for column in range(len(COLUMNS))]
    for column, limit in ((1, 90.0), (2, 180.0)):
        if not abs(values[column]) <= limit:
            _refuse(where, column, cells, f"degrees from -{limit:g} to {limit:g}")
    if not 0.0 < values[3] < math.inf:
        _refuse(where, 3, cells, "feet above 0")
    if not 0.0 <= values[4] < math.inf:
        _refuse(where, 4, cells, "miles an hour, 0 or more")
    return tuple(values)


def _number(where: str, column: int, cells: list[str]) -> float:
    try:
        return float(cells[column])
    except ValueError:
        _refuse(where, column, cells, "a number")


def _refuse(where: str, column: int, cells: list[str], expected: str) -> NoReturn:
    raise RouteError(f"{where}: {COLUMNS[column]} is {_clip(cells[column])}, expected {expected}")


def _clip(text: str) -> str:
    return ascii(text if len(text) <= 40 else text[:37] + "...")


def _check_order(number: Floats, lines: list[int], name: str) -> None:
    """A number that is left out is a lost line, and the route would cut across."""
    for k in np.flatnonzero(np.diff(number) != 1)[:1]:
        raise RouteError(
            f"{name}, line {lines[k + 1]}: waypoint number {number[k + 1]:.0f} follows "
            f"{number[k]:.0f}, expected {number[k] + 1:.0f}"
        )


def _check_lengths(latitude: Floats, longitude: Floats, lines: list[int], name: str) -> None:
    length = np.linalg.norm(np.diff(ecef(latitude, longitude), axis=0), axis=1)
    for k in np.flatnonzero(~((length >= MIN_SEGMENT_M) & (length <= MAX_JUMP_M)))[:1]:
        what = "a zero-length segment" if length[k] < MIN_SEGMENT_M else f"{length[k]:.0f} m"
        raise RouteError(
            f"{name}, line {lines[k + 1]}: {what} from the waypoint before, "
            f"expected more than 0 and at most {MAX_JUMP_M:.0f} m"
        )


def _check_stops(speed: Floats, lines: list[int], name: str) -> None:
    for k in np.flatnonzero(speed[:-1] == 0.0)[:1]:
        raise RouteError(
            f"{name}, line {lines[k]}: speed limit is 0 before the finish, "
            "expected miles an hour above 0"
        )
