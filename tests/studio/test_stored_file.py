"""The file on disk: what another program wrote is never overwritten, and what was not saved is found again."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from dalembert.errors import ModelError
from dalembert.studio.stored_file import StoredFile


def test_what_changed_outside_is_never_overwritten(tmp_path: Path) -> None:
    file = StoredFile(tmp_path / "m.yaml")
    assert file.read() is None
    file.save("a")
    assert file.outside() is None
    file.path.write_text("b")
    assert file.outside() == "b"
    with pytest.raises(ModelError, match="changed by another program"):
        file.save("c")
    assert file.path.read_text() == "b"
    assert file.read() == "b"
    file.save("c")
    assert file.path.read_text() == "c"


def test_what_is_no_file_cannot_be_read(tmp_path: Path) -> None:
    (tmp_path / "m.yaml").mkdir()
    with pytest.raises(ModelError, match=r"^m\.yaml cannot be read: Is a directory; check its permissions$"):
        StoredFile(tmp_path / "m.yaml").read()


def test_what_was_not_saved_is_kept_beside_it(tmp_path: Path) -> None:
    file = StoredFile(tmp_path / "m.yaml")
    file.save("a")
    file.keep("typed")
    again = StoredFile(file.path)
    assert (again.read(), again.kept()) == ("a", "typed")
    again.save("typed")
    assert again.kept() is None
    assert [p.name for p in tmp_path.iterdir()] == ["m.yaml"]


@pytest.mark.parametrize(("code", "sentence"), [(errno.ENOSPC, "no space"), (errno.EROFS, "read-only")])
def test_a_full_disk_or_a_read_only_one_is_said_and_loses_nothing(
    code: int, sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = StoredFile(tmp_path / "m.yaml")
    file.save("a")
    file.keep("typed")

    def refuse(*_: object) -> None:
        raise OSError(code, os.strerror(code))

    monkeypatch.setattr(Path, "replace", refuse)
    for write in (file.save, file.keep):
        with pytest.raises(ModelError, match=f"cannot write .*: {sentence}"):
            write("typed later")
    assert (file.path.read_text(), file.side.read_text()) == ("a", "typed")
    assert {p.name for p in tmp_path.iterdir()} == {file.path.name, file.side.name}


@pytest.mark.parametrize(
    "name", ["../m.yaml", "a/b.yaml", "a\\b.yaml", "", ".hidden.yaml", "m.json", "m.txt", "m.yaml"]
)
def test_another_name_stays_in_the_folder(name: str, tmp_path: Path) -> None:
    file = StoredFile(tmp_path / "m.yaml")
    file.save("a")
    with pytest.raises(ModelError):
        file.elsewhere(name)
    assert file.elsewhere("n.yaml").path == tmp_path / "n.yaml"


def test_files_that_are_no_text_are_refused(tmp_path: Path) -> None:
    file = StoredFile(tmp_path / "m.yaml")
    for content, sentence in ((b"\xff\xfe", "not UTF-8"), (b"a" * 300_000, "more than 256000")):
        file.path.write_bytes(content)
        with pytest.raises(ModelError, match=sentence):
            file.read()
