"""A file is written whole or not at all."""

from pathlib import Path

import pytest

from ion.out_file import write_whole


def test_it_is_written_over_what_was_there(tmp_path):
    path = tmp_path / "page.html"
    path.write_text("old")
    write_whole(path, "new")
    assert path.read_text() == "new"
    assert list(tmp_path.iterdir()) == [path]


def test_an_interrupt_in_the_middle_leaves_what_was_there(tmp_path, monkeypatch):
    path = tmp_path / "page.html"
    path.write_text("old")
    write_text = Path.write_text

    def interrupted(self, text, **how):
        write_text(self, text[: len(text) // 2], **how)
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "write_text", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_whole(path, "new and long")
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
