"""What a replay came to, for people."""

from rich.table import Table

from ion.replay.numbers import Result


def sentence(result: Result) -> str:
    """The answer: identical, or what differs first."""
    if "outcome" in result:
        return result["message"]
    first, platform = result["first_difference"], result["platform"]
    if first is None:
        how = "to the bit" if platform["same"] else f"to {platform['tolerance']:g}"
        return f"identical {how}: {result['ticks']:,} ticks"
    where = first["index"] or ""
    return (
        f"differs first at tick {first['tick']:,}, t = {first['time_s']:.2f} s: "
        f"{first['field']}{where} was {first['logged']}, is now {first['now']}"
    )


def platform(result: Result) -> str:
    """What is not as where the tape was made; empty where all is."""
    differs = result["platform"]["differs"].items()
    words = [
        f"{name} {v['logged'] or 'unknown'}, here {v['now'] or 'unset'}" for name, v in differs
    ]
    if not words:
        return ""
    tolerance = result["platform"]["tolerance"]
    return f"numbers are compared to {tolerance:g}, as the tape is of another platform: " + (
        "; ".join(words)
    )


def table(result: Result) -> Table:
    """One line a field that moved, in the order in which they did."""
    grid = Table(title="What moved, the inputs being the same", title_justify="left")
    grid.add_column("field", overflow="fold")
    for name in ("ticks", "first at [s]", "last at [s]", "largest difference"):
        grid.add_column(name, justify="right")
    for name, each in result["fields"].items():
        most = "-" if each["most"] is None else f"{float(each['most']):.3g}"
        times = f"{each['first_s']:.2f}", f"{each['last_s']:.2f}"
        grid.add_row(name, f"{each['ticks']:,}", *times, most)
    return grid
