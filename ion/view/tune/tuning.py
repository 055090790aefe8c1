"""What people have tuned so far: texts of parameter files, and what was changed in them."""

from difflib import unified_diff
from pathlib import Path

from ion.view.tune.terms import Place, Points, turned
from nav.errors import NavError
from nav.parameters import Parameters, files_of, parameters_from

Files = tuple[tuple[str, str], ...]


class Tuning:
    """Begins as the tape has it. What cannot be is refused, and what was in force stays.

    Args:
        files: attached to the tape, by name.
        vehicle: that drove.
    """

    def __init__(self, files: dict[str, str], vehicle: str) -> None:
        self._vehicle = vehicle
        self._first = {name: files[name] for name in files_of(vehicle)}
        self._texts = self._first
        self.parameters: Parameters = parameters_from(self._texts, vehicle)
        self.refused = ""
        """Why the last turn was not taken, or an empty word."""

    def turn(self, place: Place, term: str, points: Points) -> None:
        """Give a term other points; `refused` says why not."""
        texts = turned(self._texts, self._vehicle, place, term, points)
        try:
            self.parameters, self.refused = parameters_from(texts, self._vehicle), ""
            self._texts = texts
        except NavError as error:
            self.refused = str(error)

    def reset(self) -> None:
        """As the tape has it."""
        self._texts, self.refused = self._first, ""
        self.parameters = parameters_from(self._texts, self._vehicle)

    def changed(self) -> Files:
        """Names and texts of the files that differ from the tape's."""
        return tuple((n, text) for n, text in self._texts.items() if text != self._first[n])

    def files(self) -> Files:
        """All of them."""
        return tuple(self._texts.items())

    def diff(self) -> str:
        """What was changed, as a unified diff; empty where nothing was."""
        return "".join(
            line
            for name, text in self.changed()
            for line in unified_diff(
                self._first[name].splitlines(True), text.splitlines(True),
                f"{name} on the tape", f"{name} as tuned", n=1,
            )
        )  # fmt: skip

    def save(self, folder: Path) -> list[Path]:
        """Write the files that were changed.

        Raises:
            OSError: they cannot be written.
        """
        folder.mkdir(parents=True, exist_ok=True)
        paths = [folder / name for name, _ in self.changed()]
        for path, (_, text) in zip(paths, self.changed(), strict=True):
            path.write_text(text, encoding="utf-8")
        return paths
