"""The `ion` command."""

import sys
from typing import Annotated, NoReturn

from scenarios.processor import fix_processor

BAD_INPUT, INTERRUPTED = 2, 130


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

    from ion.bench.options import Options as BenchOptions
    from ion.calibrate.options import Options as CalibrateOptions
    from ion.compare.options import Options as CompareOptions
    from ion.explain.options import Options as ExplainOptions
    from ion.falsify.options import Options as FalsifyOptions
    from ion.figures.options import Options as FiguresOptions
    from ion.options import Options
    from ion.replay.options import Options as ReplayOptions
    from ion.report.options import Options as ReportOptions
    from ion.route.options import Options as RouteOptions
    from ion.scenarios.options import Options as ScenariosOptions
    from ion.suite.options import Options as SuiteOptions
    from ion.truth.options import Options as TruthOptions
    from ion.view.options import Options as ViewOptions

    app = tyro.extras.SubcommandApp()

    @app.command
    def drive(options: Annotated[Options, tyro.conf.arg(name="")]) -> int:
        """Let the twin of ION drive a course, and say how it went."""
        from ion import drive as command

        return command.drive(options)

    @app.command
    def explain(options: Annotated[ExplainOptions, tyro.conf.arg(name="")]) -> int:
        """Say why one decision on a tape came out as it did, in numbers and as a picture."""
        from ion.explain import command

        return command.explain(options)

    @app.command
    def replay(options: Annotated[ReplayOptions, tyro.conf.arg(name="")]) -> int:
        """Run the present navigator on what a tape recorded, and compare what it says."""
        from ion.replay import command

        return command.replay_tapes(options)

    @app.command
    def calibrate(options: Annotated[CalibrateOptions, tyro.conf.arg(name="")]) -> int:
        """Find the vehicle's mass, friction, steering and centre of gravity on a tape."""
        from ion.calibrate import command

        return command.calibrate(options)

    @app.command
    def compare(options: Annotated[CompareOptions, tyro.conf.arg(name="")]) -> int:
        """Drive variants of one drive from the same moment on, and say where they part."""
        from ion.compare import command

        return command.compare(options)

    @app.command
    def figures(options: Annotated[FiguresOptions, tyro.conf.arg(name="")]) -> int:
        """Draw the paper's figures 6.5 to 6.13 again, from our own runs, as one page."""
        from ion.figures import command

        return command.figures(options)

    @app.command
    def report(options: Annotated[ReportOptions, tyro.conf.arg(name="")]) -> int:
        """Put one drive on a page: verdict, map, curves, events, and how to repeat it."""
        from ion.report import command

        return command.report(options)

    @app.command
    def route(options: Annotated[RouteOptions, tyro.conf.arg(name="")]) -> int:
        """Say what a route file amounts to: lengths, limits, turns; and draw it."""
        from ion.route import command

        return command.route(options)

    @app.command
    def scenarios(options: Annotated[ScenariosOptions, tyro.conf.arg(name="")]) -> int:
        """List what can be driven by name, and what one's own scenario files say."""
        from ion.scenarios import command

        return command.scenarios(options)

    @app.command
    def suite(options: Annotated[SuiteOptions, tyro.conf.arg(name="")]) -> int:
        """Drive many scenarios over many seeds, and judge them; or break the navigator, and see."""
        from ion.suite import command

        return command.suite(options)

    @app.command
    def falsify(options: Annotated[FalsifyOptions, tyro.conf.arg(name="")]) -> int:
        """Search a scenario for the drive that fails, and make the simplest case of it."""
        from ion.falsify import command

        return command.falsify(options)

    @app.command
    def truth(options: Annotated[TruthOptions, tyro.conf.arg(name="")]) -> int:
        """Hold the twin against what is measured and published of the vehicle, as one page."""
        from ion.truth import command

        return command.truth(options)

    @app.command
    def view(options: Annotated[ViewOptions, tyro.conf.arg(name="")]) -> int:
        """Show a recorded drive as a web page, moment by moment."""
        from ion.view import command

        return command.view(options)

    @app.command
    def bench(options: Annotated[BenchOptions, tyro.conf.arg(name="")]) -> int:
        """Measure what a simulated second costs: against bare MuJoCo and Embree, part by part."""
        from ion.bench import command

        return command.bench(options)

    @app.command
    def states() -> int:
        """Print the navigator's state machine as a Mermaid diagram."""
        from nav.states.diagram import mermaid

        print(mermaid(), end="")
        return 0

    @app.command
    def layout() -> int:
        """Print a layout of panels for Foxglove and Lichtblick, to be imported there."""
        from importlib.resources import files

        print((files("tape") / "foxglove_layout.json").read_text(encoding="utf-8"), end="")
        return 0

    return app.cli(
        prog="ion",
        description="ION, the six-wheeler of the Grand Challenge 2005, as a digital twin.",
        config=(tyro.conf.FlagCreatePairsOff,),
    )


if __name__ == "__main__":
    main()
