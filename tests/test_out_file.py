"""A file is written whole or not at all."""

from pathlib import Path

import pytest

from ion.out_file import check_file, write_whole


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


def test_trying_a_file_changes_nothing(tmp_path):
    there, new = tmp_path / "empty.html", tmp_path / "folder" / "new.html"
    there.touch()
    for path in (there, new):
        check_file(path)
    assert there.exists()
    assert not new.exists()


def test_what_is_no_file_is_written_to_and_stays():
    null = Path("/dev/null")
    check_file(null)
    write_whole(null, "text")
    assert null.is_char_device()
