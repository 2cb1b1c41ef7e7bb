"""Wrong files and what is said about them, word for word."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.model import ModelErrors, load, loads, read_file
from tests.model.parts import FOUR_BAR
from tests.tiers import crossed

WRONG: dict[str, list[dict[str, Any]]] = read_file(Path(__file__).parent / "wrong.yaml")[0]
CASES = [
    pytest.param(case, id=f"{i}-{group}") for group, cases in WRONG.items() for i, case in enumerate(cases)
]


@pytest.mark.parametrize("case", CASES)
def test_a_wrong_file_is_told_where_and_what(case: dict[str, str]) -> None:
    text = FOUR_BAR.replace(case["old"], case["new"], 1)
    with pytest.raises(ModelError) as caught:
        loads(text, name="four.yaml")
    if case["says"].endswith("..."):
        assert str(caught.value).startswith(case["says"][:-3])
    else:
        assert str(caught.value) == case["says"]


RSSR = (Path(__file__).parent / "rssr.yaml").read_text(encoding="utf-8")
WRONG_IN_SPACE: dict[str, list[dict[str, Any]]] = read_file(Path(__file__).parent / "wrong_in_space.yaml")[0]


@pytest.mark.parametrize(
    "case",
    [
        pytest.param(case, id=f"{i}-{group}")
        for group, cases in WRONG_IN_SPACE.items()
        for i, case in enumerate(cases)
    ],
)
def test_a_wrong_file_in_space_is_told_where_and_what(case: dict[str, str]) -> None:
    assert case["old"] in RSSR
    with pytest.raises(ModelError) as caught:
        loads(RSSR.replace(case["old"], case["new"], 1), name="rssr.yaml")
    assert str(caught.value) == case["says"]


def test_all_errors_of_a_file_are_listed_the_most_useful_first() -> None:
    text = FOUR_BAR.replace("weight: 1.5,", "weight: 1.5 kg,").replace("speed: 25 rad/s", "sped: 25 rad/s")
    with pytest.raises(ModelErrors) as caught:
        loads(text, name="four.yaml")
    assert str(caught.value).splitlines() == [
        "four.yaml:25: unknown key 'sped' in drive 'O2'; did you mean 'speed'?",
        "four.yaml:10: weight of link 'crank': '1.5 kg' is a mass, but a force is needed; "
        "write one, for example '80 N'",
    ]


def test_of_many_errors_twenty_are_listed() -> None:
    text = "links: {" + ", ".join(f"l{i}: {{mass: -1}}" for i in range(30)) + "}"
    with pytest.raises(ModelErrors) as caught:
        loads(text)
    assert len(str(caught.value).splitlines()) == 21
    assert str(caught.value).endswith("\nand 10 more")


FILES = {
    "empty.yaml": (
        b"",
        "empty.yaml:1: the file is empty; begin with links: and joints:, or with `dalembert new`",
    ),
    "comment.yaml": (b"# mine\n", "comment.yaml:1: the file is empty"),
    "empty.toml": (b"\n", "empty.toml:1: the file is empty"),
    "empty.json": (b"", "empty.json:1: the file is empty"),
    "list.yaml": (
        b"- 1\n",
        "list.yaml:1: expected a mapping, not a list; write links: and joints: ...",
    ),
    "word.json": (b'"hello"', "word.json:1: expected a mapping, not 'hello'"),
    "latin.yaml": (
        b"title: a\n# \xe9",
        "latin.yaml:2: the file is not UTF-8 text: invalid byte 0xe9",
    ),
    "wide.yaml": ("title: a".encode("utf-16"), "wide.yaml:1: the file is not UTF-8 text: invalid byte 0xff"),
    "control.yaml": (b"title: a\x07", "control.yaml:1: it is not YAML"),
    "mine.txt": (
        b"title: a",
        "mine.txt:1: the file has 0 links of PMKS+; give one: app.pmksplus.com/?...; the name of a model file ",
    ),
    "top.json": (
        b'{"links": {},\n"title": "links",\n "links": {}}',
        "top.json:3: the key 'links' occurs twice; leave one of them out",
    ),
    "beside.json": (
        b'{"links": {"a": {"points": {"A": [0, {"mass": 1}]}, "mass": 1}},\n'
        b'"mass": {},\n"k": [{"a": 1}, {"a": 2,\n"b": 1,\n"b": 2}]}',
        "beside.json:5: the key 'b' occurs twice; leave one of them out",
    ),
    "twice.json": (b'{"a": 1,\n"b": {"c": 1,\n"c": 2}}', "twice.json:3: the key 'c' occurs twice"),
    "nan.json": (
        b'{"links":\n{"a": {"mass": NaN}}}',
        "nan.json:2: NaN is not a JSON number; write a finite number",
    ),
    "comma.json": (b'{"links": {},\n}', "comma.json:2: it is not JSON here: "),
    "huge.json": (
        b'{"links": {"a": {"mass": 1' + b"0" * 5000 + b"}}}",
        "huge.json:1: mass of link 'a': inf is not a finite",
    ),
    "value.json": (
        b'{"links": {\n"a":\n{"points": {"P": [1,\n"2 N"]}}}}',
        "value.json:4: item 2 of point 'P' of link 'a'",
    ),
    "twice.toml": (b'title = "a"\ntitle = "b"\n', "twice.toml:2: it is not TOML here: "),
    "nan.toml": (b"[links.a]\nmass = nan\n", "nan.toml:2: mass of link 'a': nan is not a finite number"),
    "date.toml": (
        b"[links.a]\nmass = 1979-05-27\n",
        "date.toml:2: mass of link 'a': 1979-05-27 is not a mass",
    ),
    "array.toml": (
        b'[links.a]\n[links.b]\n[[answers]]\nquantity = "effort"\n[[answers]]\nquantity = "efort"\n',
        "array.toml:6: quantity of answer 2: 'efort' is not a valid value; did you mean 'effort'?",
    ),
    "inline.toml": (
        b'[links]\na = {mass = 1}\nb = {mass = "3 N"}\n',
        "inline.toml:3: mass of link 'b': '3 N' is a force",
    ),
    "open.toml": (b"[links.a]\nmass = [1, \n", "open.toml:3: it is not TOML here: "),
    "anchor.yaml": (b"links: &a {b: *a}", "anchor.yaml:1: unknown anchor 'a'"),
    "merge.yaml": (
        b"links:\n  a: &a {mass: 1}\n  b:\n    <<: [*a, 2]\n",
        "merge.yaml:4: 2 cannot be merged: << needs a mapping; write <<: *name",
    ),
    "fields.yaml": (
        b"source_text: a\nlinks: {a: {}}",
        "fields.yaml:1: unknown key 'source_text'; did you mean 'source'?",
    ),
    "ground.yaml": (
        b"links: {a: {points: {O: [0, 0]}}}\njoints:\n  O: {type: pin, links: [ground, a]}",
        "ground.yaml:3: joint 'O' needs the fixed link 'ground', which is missing; add ground: {points: ",
    ),
    "heavy.yaml": (
        b"links: {a: {}, ground: {mass: 3}}",
        "heavy.yaml:1: the fixed link 'ground' has mass properties",
    ),
    "still.yaml": (b"links: {ground: {}}", "still.yaml:1: the mechanism has no moving link"),
}


@pytest.mark.parametrize("name", FILES)
def test_a_wrong_file_on_disk(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    content, says = FILES[name]
    monkeypatch.chdir(tmp_path)
    Path(name).write_bytes(content)
    with pytest.raises(ModelError) as caught:
        load(name)
    assert str(caught.value).startswith(says)


def test_files_that_cannot_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("engine.yaml").write_text("links: {}")
    (tmp_path / "folder.yaml").mkdir()
    for name, says in {
        "engin.yaml": "engin.yaml: file not found; did you mean 'engine.yaml'?",
        "none/engine.yaml": "none/engine.yaml: file not found",
        "folder.yaml": "folder.yaml:1: folder.yaml is a directory; name a .yaml, .json or .toml file",
        "a\0b.yaml": "a\\x00b.yaml:1: the file 'a\\x00b.yaml' cannot be read: embedded null byte; "
        "check its name and permissions",
    }.items():
        with pytest.raises(ModelError) as caught:
            load(name)
        assert str(caught.value) == says


NESTED = {
    "brackets": "links: " + "[" * 900_000,
    "mappings": "links: " + "{a: " * 200_000,
    "indent": "\n".join(" " * i + "a:" for i in range(1000)),
    "dashes": "- " * 400_000,
    "keys": "? " * 400_000,
    "aliases": "a: &a [1,1,1,1,1,1,1,1,1,1]\n"
    + "".join(
        f"{b}: &{b} [{', '.join(['*' + a] * 10)}]\n" for a, b in zip("abcdefgh", "bcdefghi", strict=True)
    ),
    "large": "# " + "a" * 5_000_000,
    "values": "x: [" + "1," * 51_000 + "1]",
    "number": "links: {a: {mass: " + "9" * 900_000 + "}}",
    "expression": "links: {a: {}}\nloads: {F: {type: couple, on: a, value: " + "(" * 900_000 + "}}",
    "signs": "links: {a: {}}\nloads: {F: {type: couple, on: a, value: '" + "-" * 900 + "1'}}",
    "tag": "a: !" + "x" * 900_000,
    "anchor": "a: &" + "x" * 900_000,
    "directive": "%" + "x" * 900_000,
    "errors": "[links]\n" + "\n".join(f"a{i} = {{mass = 'x'}}" for i in range(2_000)),
    "unit": "links: {a: {mass: 1 " + "kg*" * 200_000 + "kg}}",
}


@crossed("name, form", NESTED, ["yaml", "json", "toml"])
def test_a_hostile_text_is_refused(name: str, form: str) -> None:
    with pytest.raises(ModelError):
        loads(NESTED[name], form)


@pytest.mark.parametrize(
    "text", ["[" * 900_000, '{"a":' * 100_000, '{"a": ' + "9" * 900_000 + "}", '"' + "\\" * 800_000]
)
def test_a_hostile_json_is_refused(text: str) -> None:
    with pytest.raises(ModelError):
        loads(text, "json")


@pytest.mark.parametrize(
    "text",
    [
        "a = " + "[" * 900_000,
        "a" + ".a" * 300_000 + " = 1",
        "a = " + "{a=" * 200_000,
        "[" + "a." * 200_000 + "a]",
    ],
)
def test_a_hostile_toml_is_refused(text: str) -> None:
    with pytest.raises(ModelError):
        loads(text, "toml")
