"""What is written reads back equal, to the last bit; converting keeps the user's own text."""

from __future__ import annotations

import os
import pickle
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dalembert.errors import ModelError
from dalembert.model import Mechanism, convert, load, loads, read_text, tree_text
from dalembert.model import mechanism as from_tree
from tests.model.parts import FOUR_BAR, mechanisms, texts
from tests.tiers import tiers


@pytest.mark.parametrize("form", ["yaml", "json", "toml"])
@settings(max_examples=25)
@given(mechanism=mechanisms())
def test_what_is_written_reads_back_equal(form: str, mechanism: Mechanism) -> None:
    assert loads(tree_text(mechanism.to_tree(), form), form) == mechanism


@pytest.mark.parametrize("form", ["yaml", "json", "toml"])
@pytest.mark.parametrize("count", tiers((), [150], [2000]))
def test_what_is_written_reads_back_equal_at_length(form: str, count: int) -> None:
    @settings(max_examples=count)
    @given(mechanism=mechanisms())
    def reads_back_equal(mechanism: Mechanism) -> None:
        assert loads(tree_text(mechanism.to_tree(), form), form) == mechanism

    reads_back_equal()


@settings(max_examples=300)
@given(
    st.dictionaries(
        texts, texts | st.integers(-99, 99) | st.floats(allow_nan=False, allow_infinity=False), min_size=1
    )
)
@pytest.mark.long
def test_any_text_survives_yaml(tree: dict[str, object]) -> None:
    assert read_text(tree_text(tree))[0] == tree


@pytest.mark.parametrize(
    "word", ["", "on", "null", "~", "true", "1e-3", "0x1f", ".5", "- a", "a: b", "# a", "*a", "&a"]
)
def test_words_that_yaml_would_read_otherwise_are_quoted(word: str) -> None:
    assert read_text(tree_text({"title": word, "links": {word: [word]}}))[0] == {
        "title": word,
        "links": {word: [word]},
    }


@pytest.mark.parametrize("suffix", [".yaml", ".yml", ".json", ".toml"])
def test_save_and_load(tmp_path: Path, suffix: str) -> None:
    mechanism = loads(FOUR_BAR)
    mechanism.save(tmp_path / f"four{suffix}")
    assert load(tmp_path / f"four{suffix}") == mechanism


def test_save_overwrites_only_when_told(tmp_path: Path) -> None:
    mechanism, path = loads(FOUR_BAR), tmp_path / "four.yaml"
    path.write_text("mine")
    with pytest.raises(
        ModelError, match=r"four\.yaml exists; name another file, or overwrite it: --force, in"
    ):
        mechanism.save(path)
    assert path.read_text() == "mine"
    mechanism.save(path, overwrite=True)
    assert load(path) == mechanism


def test_a_file_is_overwritten_whole_or_not_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "four.yaml"
    path.write_text("mine")

    def full(self: Path, content: bytes) -> int:
        with self.open("wb") as file:
            file.write(content[:100])
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(
        ModelError, match=r"cannot write .*four\.yaml: no space left on device; name a file that"
    ):
        loads(FOUR_BAR).save(path, overwrite=True)
    assert path.read_text() == "mine"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(os.name == "nt", reason="permissions and symbolic links as POSIX has them")
def test_what_is_overwritten_keeps_its_permissions_and_its_links(tmp_path: Path) -> None:
    path, link = tmp_path / "four.yaml", tmp_path / "latest.yaml"
    path.write_text("mine")
    path.chmod(0o640)
    link.symlink_to(path.name)
    loads(FOUR_BAR).save(link, overwrite=True)
    assert link.readlink() == Path(path.name)
    assert load(path) == loads(FOUR_BAR)
    assert path.stat().st_mode & 0o777 == 0o640


def test_convert_keeps_units_and_texts(tmp_path: Path) -> None:
    paths = [tmp_path / f"four.{suffix}" for suffix in ("yaml", "json", "toml", "yml")]
    paths[0].write_text(FOUR_BAR)
    for source, target in pairwise(paths):
        convert(source, target)
    assert all(load(path) == load(paths[0]) for path in paths)
    for path in paths[1:]:
        assert "25 rad/s" in path.read_text()
        assert "9 @ 45" in path.read_text()
        assert "blob" in path.read_text()


def test_convert_refuses_what_is_wrong(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text("links: {bar: {mass: 3 N}}")
    with pytest.raises(
        ModelError, match=r"a.yaml:1: mass of link 'bar': '3 N' is a force, but a mass is needed"
    ):
        convert(tmp_path / "a.yaml", tmp_path / "a.json")
    assert not (tmp_path / "a.json").exists()


def test_what_cannot_be_written_is_said_and_leaves_no_file(tmp_path: Path) -> None:
    mechanism = from_tree({"title": "\ud800", "links": {"a": {}}})
    for name, says in {
        "a.json": r"cannot write .*a\.json: a text in it has '\\ud800', half a character; write that text again",
        "none/a.yaml": r"cannot write .*a\.yaml: folder .*none does not exist; create it, or name another",
        "a\0.yaml": r"cannot write .*\.yaml: .*null byte; name a file that can be written",
        "a.txt": "'.txt' is not an extension of model files; use .yaml, .json or .toml",
    }.items():
        with pytest.raises(ModelError, match=says):
            mechanism.save(tmp_path / name)
        assert list(tmp_path.iterdir()) == []


def test_blank_sections_are_not_converted(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text("drives:\nlinks: {a: {mass: 3 lbm}}\n")
    convert(tmp_path / "a.yaml", tmp_path / "a.toml")
    assert (tmp_path / "a.toml").read_text() == '[links.a]\nmass = "3 lbm"\n'


def test_a_mechanism_is_pickled_with_its_source() -> None:
    mechanism = loads(FOUR_BAR, name="four.yaml")
    other = pickle.loads(pickle.dumps(mechanism))
    assert other == mechanism
    assert other.source.line(("loads", "F_P")) == 28


def test_a_file_has_each_entry_of_a_mixed_list_on_its_own_line() -> None:
    """Plain values beside mappings: open at the top of the file; what is only plain stays on one line."""
    tree = {"units": {"length": "mm"}, "parameters": {"r": "45 mm", "k": {"value": "2 kg", "about": "mass"}}}
    assert tree_text(tree).splitlines() == [
        "units: {length: mm}",
        "parameters:",
        "  r: 45 mm",
        "  k: {value: 2 kg, about: mass}",
    ]
