"""Values put into the text of a file, taken out of it and added to it, form by form, with what is around them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from dalembert.errors import ModelError
from dalembert.model.files import json_text, toml_text
from dalembert.model.files.model_files import LARGEST, _form_of_stream, load, read_file, read_text
from dalembert.model.files.source import FileSource
from dalembert.model.files.splicing import REMOVED, Change, Renamed, changes_at_once, splice, value_text
from dalembert.model.files.yaml_text import DEEPEST

FLOW = '{"a": 1, "b": {"c": 2, "d": 3}, "e": [1, 2, 3], "f": {}}'
BLOCK = "a: 1\nb:\n  c: 2  # two\n  d: 'old'\ne: [1, 2]\nf: &x {p: 1}\ng: *x\n"
TABLES = "a = 1\n[b]\nc = 'old'\n[b.g.k]\ne = 3\n"
LISTED = (
    'a.b.c = 1\na.b.d = [1, {e = 2}]\n[[answers]]\nof = "x"\n[[answers]]\nof = "y"\n[[answers]]\nof = "w"\n'
)
INLINE = 'q = {r = [1, "x"], "\u00e4" = true}\n'
SPLICED: list[tuple[str, str, dict[tuple[str | int, ...], Any], str]] = [
    ("json", FLOW, {("b", "c"): 5.5}, FLOW.replace("2, ", "5.5, ", 1)),
    ("json", FLOW, {("a",): REMOVED}, FLOW.replace('"a": 1, ', "")),
    ("json", FLOW, {("b",): REMOVED}, FLOW.replace(', "b": {"c": 2, "d": 3}', "")),
    ("json", FLOW, {("f",): REMOVED}, FLOW.replace(', "f": {}', "")),
    ("json", FLOW, {("e", 0): REMOVED}, FLOW.replace("1, 2, 3", "2, 3")),
    ("json", FLOW, {("e", 2): REMOVED}, FLOW.replace("1, 2, 3", "1, 2")),
    ("json", '{"x": {"c": 2}}', {("x", "c"): REMOVED}, '{"x": {}}'),
    ("json", FLOW, {("b", "q"): "\u00e4"}, FLOW.replace("3}", '3, "q": "\u00e4"}')),
    ("json", FLOW, {("f", "\u00e4"): [1, "\u00f6"]}, FLOW.replace("{}", '{"\u00e4": [1, "\u00f6"]}')),
    ("json", FLOW, {("b", "q", "r"): 7}, FLOW.replace("3}", '3, "q": {"r": 7}}')),
    ("json", FLOW, {("q", "r", "s"): 7}, FLOW[:-1] + ', "q": {"r": {"s": 7}}}'),
    ("json", FLOW, {("b", "c"): Renamed("w", 7)}, FLOW.replace('"c": 2', '"w": 7')),
    (
        "json",
        FLOW,
        {("a",): 8, ("b", "d"): 9, ("e", 1): 10},
        '{"a": 8, "b": {"c": 2, "d": 9}, "e": [1, 10, 3], "f": {}}',
    ),
    ("json", FLOW, {("a",): REMOVED, ("b",): REMOVED}, '{"e": [1, 2, 3], "f": {}}'),
    ("json", FLOW, {("nothing",): REMOVED}, FLOW),
    ("yaml", BLOCK, {("b", "c"): 5}, BLOCK.replace("c: 2", "c: 5")),
    ("yaml", BLOCK, {("b", "d"): "new"}, BLOCK.replace("old", "new")),
    ("yaml", BLOCK, {("b", "d"): "it's"}, BLOCK.replace("'old'", '"it\'s"')),
    ("yaml", BLOCK, {("b", "q"): 4}, BLOCK.replace("'old'\n", "'old'\n  q: 4\n")),
    ("yaml", BLOCK, {("b", "c"): REMOVED}, BLOCK.replace("  c: 2  # two\n", "")),
    ("yaml", BLOCK, {("b",): 7}, BLOCK.replace("b:\n  c: 2  # two\n  d: 'old'", "b: 7")),
    ("yaml", BLOCK, {("g", "q"): 2}, BLOCK.replace("g: *x", "g: {<<: *x, q: 2}")),
    ("yaml", BLOCK, {("q", "r"): [3, "4 m"]}, f"{BLOCK}q: {{r: [3, 4 m]}}\n"),
    (
        "yaml",
        BLOCK.replace("\n", "\r\n"),
        {("b", "q"): 4},
        BLOCK.replace("'old'\n", "'old'\n  q: 4\n").replace("\n", "\r\n"),
    ),
    ("yaml", "a: 1\nb: 2", {("b",): REMOVED}, "a: 1\n"),
    ("yaml", "a: 1\nb: 2", {("c",): 3}, "a: 1\nb: 2\nc: 3"),
    ("yaml", "a: 1\r\nb: 2", {("c",): 3}, "a: 1\r\nb: 2\r\nc: 3"),
    ("yaml", "  a: 1\n  b: 2\n", {("c",): 3}, "  a: 1\n  b: 2\n  c: 3\n"),
    ("toml", TABLES, {("b", "c"): "new"}, TABLES.replace("old", "new")),
    ("toml", TABLES, {("b", "c"): "it's"}, TABLES.replace("'old'", '"it\'s"')),
    ("toml", TABLES, {("b", "q"): 4.5}, TABLES.replace("'old'\n", "'old'\nq = 4.5\n")),
    ("toml", TABLES, {("b", "g", "h"): 7}, f"{TABLES}\n[b.g]\nh = 7\n"),
    ("toml", TABLES, {("b", "g", "a b"): "\u00e4"}, f'{TABLES}\n[b.g]\n"a b" = "\u00e4"\n'),
    (
        "toml",
        TABLES,
        {("b", "q"): {"r": [1, "x"], "\u00e4": True}},
        TABLES.replace("'old'\n", "'old'\n" + INLINE),
    ),
    ("toml", LISTED, {("a", "b", "c"): 5}, LISTED.replace("c = 1", "c = 5")),
    ("toml", LISTED, {("a", "b", "d", 0): 5}, LISTED.replace("[1,", "[5,")),
    ("toml", LISTED, {("a", "b", "d", 1, "e"): 7}, LISTED.replace("e = 2", "e = 7")),
    ("toml", LISTED, {("answers", 0, "of"): "z"}, LISTED.replace('"x"', '"z"')),
    ("toml", LISTED, {("answers", 1, "of"): "z"}, LISTED.replace('"y"', '"z"')),
    ("toml", LISTED, {("answers", 2, "of"): "z"}, LISTED.replace('"w"', '"z"')),
    ("toml", LISTED, {("answers", 1, "of"): REMOVED}, LISTED.replace('of = "y"\n', "")),
    ("toml", TABLES, {("a",): REMOVED}, TABLES.replace("a = 1\n", "")),
]


@pytest.mark.parametrize(("form", "text", "values", "wanted"), SPLICED)
def test_a_value_in_a_text(form: str, text: str, values: dict[Any, Any], wanted: str) -> None:
    assert splice(text, form, values) == wanted
    changes = changes_at_once(text, form, values)
    again = text
    for change in reversed(changes or ()):
        again = again[: change.start] + change.text + again[change.end :]
    assert again == wanted or changes is None
    assert changes is None or changes == sorted(changes)


def test_changes_that_overlap_are_made_one_by_one() -> None:
    assert changes_at_once(FLOW, "json", {("e", 0): REMOVED, ("e", 1): REMOVED}) is None
    assert splice(FLOW, "json", {("e", 1): REMOVED, ("e", 0): REMOVED}) == FLOW.replace("1, 2, 3", "3")
    both = changes_at_once(FLOW, "json", {("e", 1): 7, ("a",): 5})
    assert both == [Change(6, 7, "5"), Change(FLOW.index("2, 3]"), FLOW.index(", 3]"), "7")]


@pytest.mark.parametrize(
    ("form", "value", "old", "text"),
    [
        ("yaml", "b", "'a'", "'b'"),
        ("yaml", "b", '"a"', '"b"'),
        ("yaml", "b", "a", "b"),
        ("yaml", 3.5, "'a'", "3.5"),
        ("yaml", 'b"', "'a'", '"b\\""'),
        ("toml", "b", "'a'", "'b'"),
        ("toml", "b", '"a"', '"b"'),
        ("toml", "b\\", "'a'", '"b\\\\"'),
        ("toml", True, "", "true"),
        ("toml", {"a": 1, "b c": (2, "d")}, "", '{a = 1, "b c" = [2, "d"]}'),
        ("json", {"a": [1, "\u00e4"]}, "", '{"a": [1, "\u00e4"]}'),
    ],
)
def test_a_text_keeps_its_quotes(form: str, value: Any, old: str, text: str) -> None:
    assert value_text(value, form, old) == text


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ('{"a": 1, "a": 2}', 1),
        ('{"a": 1,\n"b": {"a": 2},\n"c": [{"a": 3}, {"a": 4}],\n"a": 5}', 4),
        ('{"b": {"a": 1},\n"c": {"d": {"a": 1},\n"e": {\n"a": 2,\n"f": "a",\n"a": 3}}}', 6),
        ('{"b": [[{"a": 1}], {"a": 2,\n\n"a": 3}]}', 3),
    ],
)
def test_a_key_that_an_object_has_twice(text: str, line: int) -> None:
    with pytest.raises(ModelError) as caught:
        json_text.read(text)
    assert (caught.value.what, caught.value.line) == ("the key 'a' occurs twice", line)


def test_numbers_of_a_json_file() -> None:
    read: Any = json_text.read(f"[{'7' * 18}, {'7' * 19}, -{'7' * 17}, -{'7' * 18}]")
    assert read == [int("7" * 18), float("7" * 19), -int("7" * 17), -float("7" * 18)]
    assert [type(x) for x in read] == [int, float, int, float]
    assert json_text.read(" \n ") is None


@pytest.mark.parametrize(("open_", "close"), [("[", "]"), ('{"a":', "}")])
def test_how_deep_a_json_file_may_be(open_: str, close: str) -> None:
    def nested(n: int) -> str:
        return open_ * n + "1" + close * n

    assert json_text.read(nested(DEEPEST)) == json.loads(nested(DEEPEST))
    with pytest.raises(ModelError, match=f"nested deeper than {DEEPEST} levels") as caught:
        json_text.read("\n\n" + nested(DEEPEST + 1))
    assert caught.value.line == 3
    side_by_side = "[" + ", ".join([nested(DEEPEST - 1)] * 3) + "]"
    assert len(json_text.read(side_by_side)) == 3  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("a = 1\nb = \n", 2),
        ("a = 1\nb = [1,", 2),
        ("a = 1\n# b\nc = [\n1,\n2\n", 6),
    ],
)
def test_a_toml_file_that_is_none(text: str, line: int) -> None:
    with pytest.raises(
        ModelError, match=r"it is not TOML here: .*; check quotes, commas and brackets$"
    ) as caught:
        toml_text.read(text)
    assert caught.value.line == line
    assert " (at " not in caught.value.what


def test_a_toml_file_that_is_too_deep() -> None:
    deep = "a = " + "[" * 1500 + "]" * 1500
    for text, line in ((f"b = 1\n{deep}\nc = 2\n", 2), (f"b = [[1]]\n\n{deep}", 3)):
        with pytest.raises(ModelError, match="nested deeper than") as caught:
            toml_text.read(text)
        assert caught.value.line == line


def test_the_line_of_a_copied_part_is_that_of_its_copy() -> None:
    lines = {("links",): 2, ("links", "a"): 3, ("copies", 0): 9, ("links", "a", "mass"): 4}
    copied = {("links", "a_2"): ("copies", 0), ("joints", "J_2"): ("copies", 0)}
    source = FileSource("m.yaml", lambda: lines, copied=copied)  # type: ignore[arg-type]
    paths: list[tuple[tuple[str | int, ...], int]] = [
        (("links", "a", "mass"), 4),
        (("links", "a", "center", 1), 3),
        (("links", "a_2", "mass"), 9),
        (("joints", "J_2"), 9),
        (("links", "b"), 2),
        (("loads", "F"), 1),
        ((), 1),
    ]
    assert [source.line(path) for path, _ in paths] == [line for _, line in paths]


@pytest.mark.parametrize(
    ("name", "text", "form"),
    [
        ("-", '{"links": {}}', "json"),
        ("-", '\ufeff {"links": {}}', "json"),
        ("-", "{links: {}}", "yaml"),
        ("-", "# a = 1\n\n  links: {}", "yaml"),
        ("-", "# a: 1\n\n[links]", "toml"),
        ("-", "title = 'a'", "toml"),
        ("-", "\"ti tle\" = 'a'", "yaml"),
        ("-", "'title'.a = 'a'", "toml"),
        ("-", "title: a = b", "yaml"),
        ("-", "", "yaml"),
        ("/dev/fd/pipe.JSON", "title = 'a'", "json"),
        ("/dev/fd/pipe.yml", "title = 'a'", "yaml"),
    ],
)
def test_the_format_of_a_stream_is_guessed(name: str, text: str, form: str) -> None:
    assert _form_of_stream(name, text) == form


def test_the_largest_file(tmp_path: Path) -> None:
    """Its bytes are counted, and the characters of a text."""
    path, body = tmp_path / "m.yaml", b"{title: a}\n"
    path.write_bytes(body + b"#" * (LARGEST - len(body)))
    assert read_file(path)[0] == {"title": "a"}
    path.write_bytes(body + "\u00e4".encode() * (LARGEST // 2))
    with pytest.raises(ModelError) as caught:
        read_file(path)
    assert (
        str(caught.value) == f"{path}:1: the file has more than 1000000 bytes; give large tables fewer points"
    )
    text = body.decode() + "#" * (LARGEST - len(body))
    with pytest.raises(ModelError) as caught:
        read_text(f"{text}#", name="n.yaml")
    assert (
        str(caught.value)
        == "n.yaml:1: the file has more than 1000000 characters; give large tables fewer points"
    )


def test_a_name_that_no_file_can_have() -> None:
    with pytest.raises(ModelError) as caught:
        load("a\0b.yaml")
    assert str(caught.value) == (
        "a\\x00b.yaml:1: the file 'a\\x00b.yaml' cannot be read: embedded null byte; check its name and permissions"
    )
