"""The `ion` command."""

import sys
from collections.abc import Callable
from importlib import import_module
from importlib.resources import files
from typing import Annotated, Any, NoReturn

from scenarios.processor import fix_processor

BAD_INPUT, INTERRUPTED = 2, 130
COMMANDS = {
    "drive": "Let the twin of ION drive a course, and say how it went.",
    "explain": "Say why one decision on a tape came out as it did, in numbers and as a picture.",
    "replay": "Run the present navigator on what a tape recorded, and compare what it says.",
    "calibrate": "Find the vehicle's mass, friction, steering and centre of gravity on a tape.",
    "compare": "Drive variants of one drive from the same moment on, and say where they part.",
    "falsify": "Search what a scenario varies for a drive that fails, and make it simple.",
    "figures": "Draw the paper's figures 6.5 to 6.13 again, from our own runs, as one page.",
    "reconstruct": "Make a scenario from a tape: route, obstacles as they were seen, faults.",
    "report": "Put one drive on a page: verdict, map, curves, events, and how to repeat it.",
    "route": "Say what a route file amounts to: lengths, limits, turns; and draw it.",
    "scenarios": "List what can be driven by name, and what one's own scenario files say.",
    "suite": (
        "Drive many scenarios over many seeds, and judge them; or break the navigator, and see."
    ),
    "truth": "Hold the twin against what is measured and published of the vehicle, as one page.",
    "view": "Show a recorded drive as a web page, moment by moment.",
    "bench": "Measure what a simulated second costs: against bare MuJoCo and Embree, part by part.",
}
"""Each is a package of its name, with its options and what it does."""


def main() -> NoReturn:
    """Entry point: fix the processor before numpy loads, then do as the arguments say."""
    fix_processor()
    from ion.errors import UsageError
    from nav.errors import NavError
    from scenarios.checkpoint import CheckpointError
    from tape.errors import TapeError

    try:
        sys.exit(_command())
    except (UsageError, NavError, TapeError, CheckpointError) as error:
        print(f"ion: {error}", file=sys.stderr)
        sys.exit(BAD_INPUT)
    except KeyboardInterrupt:
        print("ion: interrupted", file=sys.stderr)
        sys.exit(INTERRUPTED)


def _command() -> int:
    import tyro

    app = tyro.extras.SubcommandApp()
    for name, says in COMMANDS.items():
        app.command(name=name)(_entry(name, says))
    app.command(states)
    app.command(layout)
    return app.cli(
        prog="ion",
        description="ION, the six-wheeler of the Grand Challenge 2005, as a digital twin.",
        config=(tyro.conf.FlagCreatePairsOff,),
    )


def _entry(name: str, says: str) -> Callable[[Any], int]:
    """What a command does with its options; only the one that is asked for is loaded."""
    import tyro

    def entry(options: Any) -> int:
        return getattr(import_module(f"ion.{name}.command"), name)(options)

    options = import_module(f"ion.{name}.options").Options
    entry.__doc__ = says
    entry.__annotations__["options"] = Annotated[options, tyro.conf.arg(name="")]
    return entry


def states() -> int:
    """Print the navigator's state machine as a Mermaid diagram."""
    from nav.states.diagram import mermaid

    print(mermaid(), end="")
    return 0


def layout() -> int:
    """Print a layout of panels for Foxglove and Lichtblick, to be imported there."""
    print((files("tape") / "foxglove_layout.json").read_text(encoding="utf-8"), end="")
    return 0


if __name__ == "__main__":
    main()
