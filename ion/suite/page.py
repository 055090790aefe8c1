"""The page of a suite: what failed and how to drive it again, and every bound over all seeds."""

from collections.abc import Sequence
from html import escape
from os.path import relpath
from pathlib import Path

from ion.html import document, image, mood, paragraph
from ion.suite.baseline import Changes
from ion.suite.plots import strips
from ion.suite.results import reasons, run_of
from ion.telling import Result
from scenarios.suites import Run, Suite

FILE = "report.html"


def write_page(
    folder: Path, suite: Suite, results: Sequence[Result], changes: Changes | None
) -> Path:
    """Write the page beside the results; pictures are in it, tapes beside it.

    Raises:
        OSError: it cannot be written.
    """
    path, failed = folder / FILE, [result for result in results if result["failed"]]
    told = f"{len(results) - len(failed)} of {len(results)} drives passed"
    parts = [paragraph(suite.title), paragraph(told, mood(not failed))]
    parts += [_changes(changes)] if changes else []
    parts += [_failures(folder, failed), *(_run(run, results) for run in suite.runs)]
    path.write_text(document(suite.name, "\n".join(parts)), encoding="utf-8")
    return path


def _failures(folder: Path, failed: Sequence[Result]) -> str:
    if not failed:
        return ""
    return f"<h2>What failed</h2><table>{''.join(_failure(folder, r) for r in failed)}</table>"


def _failure(folder: Path, result: Result) -> str:
    why = "<br>".join(map(escape, reasons(result)))
    left = [result[key] for key in ("log", "map") if result.get(key)]
    links = "<br>".join(f'<a href="{escape(relpath(p, folder))}">{Path(p).name}</a>' for p in left)
    again = f"<code>{escape(result['command'])}</code>"
    return f"<tr><td>{escape(result['case'])}</td><td>{why}<br>{again}</td><td>{links}</td></tr>"


def _run(run: Run, results: Sequence[Result]) -> str:
    """One scenario: how many passed each verdict, and where the figures lie."""
    scenario = run.scenario
    mine = [r for r in results if run_of(r) == scenario.name]
    verdicts = [verdict for result in mine for verdict in result.get("verdicts", ())]
    rows = "".join(_row(figure, verdicts) for figure in scenario.verdicts)
    head = f"<h2>{escape(scenario.name)}</h2><p>{escape(scenario.title)}</p>"
    picture = strips(mine, scenario.verdicts)
    over_seeds = image(picture, "Each bounded figure over the seeds") if picture else ""
    return f"{head}<table>{rows}</table>{over_seeds}"


def _row(figure: str, verdicts: Sequence[Result]) -> str:
    mine = [verdict for verdict in verdicts if verdict["figure"] == figure]
    passed = len([verdict for verdict in mine if verdict["passed"]])
    expected = escape(mine[0]["expected"]) if mine else ""
    counts = f'<td class="{mood(passed == len(mine))}">{passed} of {len(mine)}</td>'
    return f"<tr><td>{escape(figure)}</td><td>{expected}</td>{counts}</tr>"


def _changes(changes: Changes) -> str:
    rows = [
        f'<tr><td>{escape(v.case)}</td><td>{escape(v.figure)}</td><td class="{mood(v.passes)}">'
        f"{escape(f'{v.then} to {v.now}')}</td></tr>"
        for v in changes.turned
    ]
    rows += [
        f"<tr><td>{escape(f.run)}</td><td>{escape(f.figure)}</td><td>{f.then:.4g} to {f.now:.4g}"
        f" ({f.low:.3g} to {f.high:.3g} over {f.seeds} seeds)</td></tr>"
        for f in changes.moved
    ]
    first = f"; the first: {escape(changes.other[0])}" if changes.other else ""
    return (
        f"<h2>Against the baseline</h2><p>{len(changes.other)} drives went otherwise{first}</p>"
        f"<table>{''.join(rows)}</table>"
    )
