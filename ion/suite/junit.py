"""Verdicts as JUnit XML, as CI systems read it."""

from collections.abc import Sequence
from pathlib import Path
from xml.etree.ElementTree import Element, ElementTree, SubElement, indent

from ion.telling import Result, verdict


def write(path: Path, suite: str, results: Sequence[Result]) -> None:
    """A test case for each verdict of each drive, one test suite in all.

    Raises:
        OSError: the file cannot be written.
    """
    root = Element("testsuite", name=suite)
    for result in results:
        for said in result.get("verdicts", ({},)):
            _case(root, result, said)
    root.set("tests", str(len(root)))
    root.set("failures", str(len(root.findall("*/failure"))))
    root.set("errors", str(len(root.findall("*/error"))))
    indent(root)
    ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def _case(root: Element, result: Result, said: Result) -> None:
    time = f"{result.get('wall_time_s', 0.0):.3f}"
    name = said.get("figure", "drive")
    case = SubElement(root, "testcase", classname=result["case"], name=name, time=time)
    if not said:
        SubElement(case, "error", message=result.get("message", result["outcome"]))
    elif not said["passed"]:
        text = f"{verdict(said)}; {result['command']}"
        SubElement(case, "failure", message=text).text = result["log"]
