"""The architecture: what the navigator may import, and that it needs no simulator."""

import ast
import re
import subprocess
import sys
from importlib.resources import files

import grimp
import pytest

NEVER = {"time", "os", "random", "datetime", "pathlib"}
"""The navigator reads no clock, no environment, no generator and no file."""
BLOCKED = ("mujoco", "numba", "matplotlib", "rich", "tyro", "msgspec", "mcap", "foxglove")

NAV_ALONE = f"""
import sys
for name in {BLOCKED!r}:
    sys.modules[name] = None
import {{module}}
ours = {{{{"twin", "tape", "scenarios", "ion", "hardware"}}}} & set(sys.modules)
assert not ours, ours
"""


@pytest.fixture(scope="module")
def graph():
    return grimp.build_graph("nav", include_external_packages=True, cache_dir=None)


def outside(graph):
    """What nav imports that is not nav: the module and who imports it."""
    for module in sorted(graph.modules):
        if module.split(".")[0] == "nav":
            for imported in sorted(graph.find_modules_directly_imported_by(module)):
                if imported.split(".")[0] != "nav":
                    yield module, imported


def test_nav_imports_numpy_and_the_standard_library_only(graph):
    allowed = {"numpy", *sys.stdlib_module_names}
    assert [pair for pair in outside(graph) if pair[1].split(".")[0] not in allowed] == []


def test_nav_reads_no_clock_no_generator_and_no_file(graph):
    assert [pair for pair in outside(graph) if pair[1].split(".")[0] in NEVER] == []


def test_nav_opens_nothing_and_draws_nothing_at_random():
    calls = [call for path in python_files(files("nav")) for call in called(path)]
    assert len(calls) > 100
    assert [call for call in calls if re.search(r"^open$|random|^input$|^__import__$", call)] == []


def called(path):
    """The names of all functions that a file calls."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return [ast.unparse(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)]


def python_files(folder):
    for path in sorted(folder.iterdir(), key=str):
        if path.is_dir():
            yield from python_files(path)
        elif path.name.endswith(".py"):
            yield path


@pytest.mark.parametrize("module", ["nav", "nav.messages", "nav.navigator"])
def test_nav_works_without_a_simulator(module):
    code = NAV_ALONE.format(module=module)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_the_command_starts_without_loading_what_it_does_not_need():
    code = (
        "import sys; sys.argv = ['ion', '--help']\n"
        "from ion.__main__ import main\n"
        "try:\n    main()\nexcept SystemExit:\n    pass\n"
        "heavy = {'mujoco', 'numba', 'matplotlib'} & set(sys.modules)\n"
        "assert not heavy, heavy"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "drive" in done.stdout
