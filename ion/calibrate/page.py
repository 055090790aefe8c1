"""The page of a fit."""

from ion.calibrate.numbers import Result
from ion.calibrate.picture import picture
from ion.calibrate.table import HEADS, caption, rows
from ion.html import document, image, paragraph, row
from ion.style import png
from scenarios.calibration.fit import Fit


def page(result: Result, fit: Fit) -> str:
    """The HTML file's text."""
    table = row(*HEADS, tag="th") + "".join(row(*each) for each in rows(result))
    curves = image(png(picture(fit)), "Measured and predicted curves, before and after")
    body = f"<table>{table}</table>{paragraph(caption(result), 'quiet')}{curves}"
    return document(f"Calibration: {result['log']}", body)
