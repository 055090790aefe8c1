"""The wheel works away from the checkout, also beside a user's own folders of the same names."""

import json
import subprocess
import sys
import venv
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not (ROOT / "pyproject.toml").is_file(), reason="needs the checkout"),
]


def shell(*command, cwd=None):
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A fresh environment with the wheel in it; its dependencies are those of this one."""
    folder = tmp_path_factory.mktemp("wheel")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check"]
    shell(*pip, "wheel", ROOT, "--no-deps", "--no-build-isolation", "-q", "-w", folder)
    venv.create(folder / "env", with_pip=False)
    (wheel,) = folder.glob("*.whl")
    python = folder / "env" / "bin" / "python"
    shell(*pip, "--python", python, "install", "-q", "--no-deps", wheel)
    (site,) = (folder / "env" / "lib").glob("python*/site-packages")
    here = next(path for path in sys.path if path.endswith("site-packages"))
    (site / "dependencies.pth").write_text(here)
    return folder / "env" / "bin" / "ion"


@pytest.fixture
def users_folder(tmp_path):
    """A folder with a user's own packages, which must not get in the way."""
    for name in ("models", "scenarios", "nav", "twin", "tape"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("raise RuntimeError('the wrong package')")
    return tmp_path


def test_the_installed_command_drives(installed, users_folder):
    assert "drive" in shell(installed, "--help", cwd=users_folder)
    rows = [f"{k + 1},{34.9 + k * 0.0001:.7f},-117.0,12,{5 if k < 2 else 0}" for k in range(3)]
    (users_folder / "tiny.rddf").write_text("\n".join(rows))
    out = shell(installed, "drive", "--route", "tiny.rddf", "--json", cwd=users_folder)
    assert json.loads(out)["outcome"] == "finished"
    assert (users_folder / "runs" / "tiny_1-3_seed0.png").is_file()


def test_the_wheel_is_not_the_checkout(installed, users_folder):
    python = installed.parent / "python"
    where = "import sys; sys.path.pop(0); import nav; print(nav.__file__)"
    assert str(installed.parents[1]) in shell(python, "-c", where, cwd=users_folder)
