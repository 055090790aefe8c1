"""The scenario's file: what was found as keys, what cannot be known as comments."""

from collections.abc import Iterable, Mapping, Sequence

from ion.reconstruct.rebuilt import Rebuilt
from ion.reconstruct.stretches import Stretch
from scenarios.planned import Thing
from twin.faults import Fault

UNKNOWN = """\
# The tape does not tell these; they are assumed, and may be varied:
#   the ground: a plane (bumps = 0.0); drops, holes and berms that no scanner took for an obstacle
#   are left out, and what hangs overhead is;
#   its friction: drawn by the seed, 0.5 to 0.9 ("world.friction" under [vary]);
#   the vehicle's mass and wear: those of the twin (`ion calibrate` finds them on a test drive);
#   how deep things are behind the sides that were seen, and their height above the highest beam.
"""


def scenario_text(found: Rebuilt, title: str, route: str, time_limit_s: float) -> str:
    """The whole file.

    Args:
        found: what the tape came to.
        title: a sentence.
        route: of `route_text`.
        time_limit_s: of the drive.
    """
    parts = [
        f'title = "{_quoted(title)}"\n{route}',
        f"roadside = false\nbumps = 0.0\ntime_limit_s = {time_limit_s:g}\n",
        UNKNOWN,
        _faults(found.faults, _unexplained(found)),
        _things(found.things),
        '[verdicts]\noutcome = "finished"\ncontacts = 0\n',
    ]
    return "\n".join(parts)


def route_text(name: str, stretch: Mapping[str, int]) -> str:
    """The lines that say what is driven.

    Args:
        name: of the route file, which lies beside the scenario.
        stretch: numbers of the waypoints `from` and `to` which it is driven, where not all of it.
    """
    part = "".join(f"{key} = {number}\n" for key, number in stretch.items())
    times = "# Times count from when the tape passed that waypoint.\n" if "from" in stretch else ""
    return f'route = "{_quoted(name)}"\n{part}{times}'


def _faults(faults: Sequence[Fault], others: Iterable[str]) -> str:
    """With what happened to devices, but is no fault that a scenario can repeat."""
    lines = "".join(f'  "{fault}",\n' for fault in faults)
    said = "".join(f"# {line}\n" for line in others)
    return said + (f"faults = [\n{lines}]\n" if faults else "faults = []\n")


def _unexplained(found: Rebuilt) -> Iterable[str]:
    for s in found.evidence.unfixed:
        yield (
            f"gps spoke, but had no fix from {s.from_s:.1f} s to {s.to_s:.1f} s, with {s.why}: "
            "the sky, and no fault of the receiver"
        )
    for s in found.evidence.doubted:
        if not any(_explains(fault, s) for fault in found.faults):
            yield (
                f"{s.device} was not believed from {s.from_s:.1f} s to {s.to_s:.1f} s ({s.why}): "
                "noisy or wrong, but by how much the tape does not tell"
            )


def _explains(fault: Fault, doubt: Stretch) -> bool:
    return fault.device == doubt.device and fault.begins <= doubt.to_s


def _things(things: Sequence[Thing]) -> str:
    if not things:
        return "things = []\n"
    return "things = [\n" + "".join(f"  {{ {_thing(each)} }},\n" for each in things) + "]\n"


def _thing(thing: Thing) -> str:
    (x, y), (length, width) = thing.at_m, thing.half_m
    words = [
        f'kind = "{thing.kind}"',
        f"at_m = [{x:g}, {y:g}]",
        f"half_m = [{length:g}, {width:g}]",
        f"height_m = {thing.height_m:g}",
        f"yaw_deg = {thing.yaw_deg:g}",
        *([f'shape = "{thing.shape}"'] if thing.shape != "box" else []),
        f"shift_m = {thing.shift_m:g}",
    ]
    return ", ".join(words)


def _quoted(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')
