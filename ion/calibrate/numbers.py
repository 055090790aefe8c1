"""What a fit found, as plain numbers: for tables, pages and JSON."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from scenarios.calibration.fit import Fit
from scenarios.calibration.quantities import ALONG, QUANTITIES

Result = dict[str, Any]
EXPLAINED = 4.0
"""Mean square difference, in units of the noise, up to which a model explains a tape (chosen). The
twin's own tapes give 1.6 to 1.9, ground that is not as the model's 28: docs/calibrate.md."""


def numbers(log: Path, fit: Fit, made_with: Mapping[str, float]) -> Result:
    """The result of `--json`.

    Args:
        log: the tape.
        fit: what was found.
        made_with: what the twin was told that made it; empty for a truck's tape.
    """
    rows = {f.name: _row(f.name, f.value, f.half_width, made_with.get(f.name)) for f in fit.found}
    asked = {name: row for name, row in rows.items() if name not in ALONG}
    along = {name: row for name, row in rows.items() if name in ALONG}
    misfit = {"before": round(fit.misfit[0], 3), "after": round(fit.misfit[1], 3)}
    return {
        "log": str(log), "parameters": asked, "fitted_along": along, "misfit": misfit,
        "explained": fit.misfit[1] < EXPLAINED, "drives": fit.drives,
    }  # fmt: skip


def _row(name: str, value: float, half_width: float, made_with: float | None) -> Result:
    q = QUANTITIES[name]
    error = None if not made_with else round(value / made_with - 1.0, 6)
    return {
        "unit": q.unit, "model": q.model, "value": round(value, 6), "made_with": made_with,
        "low": round(value - half_width, 6), "high": round(value + half_width, 6),
        "error": error, "at_bound": not q.least < value < q.most,
    }  # fmt: skip
