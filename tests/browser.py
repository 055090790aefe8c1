"""A headless Chromium for tests of pages, and what they look at in it."""

import shutil
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path

import pytest
from matplotlib.image import imread

SCREENS = Path(__file__).parent.parent / "runs" / "screens"
FLAGS = (
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
)  # fmt: skip
SIZE = {"width": 800, "height": 600}
PATIENCE_MS = 60_000


@contextmanager
def chromium_page(size=None):
    """An empty page that collects in `errors` what goes wrong in it."""
    names = ("chromium", "chromium-browser", "google-chrome")
    path = next(filter(None, map(shutil.which, names)), None)
    if path is None:
        pytest.skip("no chromium here; tools/browser.sh installs it where it may")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        page = browser.new_page(viewport=size or SIZE)
        page.set_default_timeout(PATIENCE_MS)
        page.errors = []
        page.on("console", lambda m: m.type == "error" and page.errors.append(m.text))
        page.on("pageerror", lambda error: page.errors.append(error.stack))
        yield page
        browser.close()


def picture(page, name, part):
    """What a part of the page shows, shape (h, w, 3); the whole of it stays in runs/screens."""
    SCREENS.mkdir(parents=True, exist_ok=True)
    content = page.screenshot(path=SCREENS / f"{name}.png", timeout=PATIENCE_MS)
    return imread(BytesIO(content), format="png")[part]
