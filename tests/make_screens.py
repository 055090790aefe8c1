"""The pictures of the viewer in docs/: `python tests/make_screens.py LOG`, of an NQE with seed 0.

They are looked at before they are committed.
"""

import re
import subprocess
import sys
from io import BytesIO
from pathlib import Path

from browser import chromium_page
from PIL import Image

ION = str(Path(sys.executable).with_name("ion"))
DOCS = Path(__file__).parent.parent / "docs"
SIZE = {"width": 1400, "height": 900}
VIEW_S, TUNE_S = 106.3, 107.9
"""Where an obstacle stands in the way, and a moment later."""


def main(log: str) -> None:
    """Take them all."""
    with subprocess.Popen([ION, "view", log], stdout=subprocess.PIPE, text=True) as viewer:
        assert viewer.stdout is not None
        found = re.match(r"(http://127\.0\.0\.1:\d+) ", viewer.stdout.readline())
        assert found, "no viewer"
        with chromium_page(SIZE) as page:
            page.goto(found[1])
            page.get_by_text("Path-Point Keeping").first.wait_for()
            page.get_by_role("button", name="Close notification").or_(
                page.locator(".mantine-Notification-closeButton")
            ).first.click()
            _view(page)
            _tune(page)
        viewer.terminate()
    path = DOCS.parent / "runs" / "screen.html"
    subprocess.run([ION, "view", log, "--export", path, "--to", str(VIEW_S + 5)], check=True)
    with chromium_page(SIZE) as page:
        page.goto(f"file://{path}")
        page.get_by_text("Path-Point Keeping since").first.wait_for()
        page.locator(".mantine-Notification-closeButton").first.click()
        clock = page.locator("#root input[inputmode=decimal]")
        clock.fill(str(VIEW_S))
        page.wait_for_timeout(5000)
        _keep(page, "export")


def _view(page) -> None:
    _scrub(page, VIEW_S)
    page.wait_for_timeout(6000)
    _keep(page, "view")


def _tune(page) -> None:
    _scrub(page, TUNE_S)
    page.get_by_text("tune", exact=True).click()
    page.wait_for_timeout(12_000)
    for term, points in (("S", "0.5, 0.9"), ("M", "0.5, 0.9, 1.1, 1.4")):
        label = page.get_by_text(f"{term} =", exact=True)
        label.locator("xpath=following::input[1]").fill(points)
        page.wait_for_timeout(1000)
    page.mouse.move(1200, 700)
    page.mouse.wheel(0, 640)
    page.wait_for_timeout(3000)
    _keep(page, "tune")


def _scrub(page, time_s: float) -> None:
    clock = page.locator("input[inputmode=decimal]").first
    clock.fill(str(time_s))
    clock.press("Enter")


def _keep(page, name: str) -> None:
    """With 256 colours it takes a third of the room."""
    shot = Image.open(BytesIO(page.screenshot())).convert("RGB")
    shot.quantize(256).save(DOCS / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main(sys.argv[1])
