"""A saved file is the author's text: only the characters of changed values change."""

from __future__ import annotations

import random
import shutil
from collections.abc import Iterator
from difflib import SequenceMatcher
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest
from pydantic import BaseModel

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.errors import ModelError
from dalembert.model import Mechanism, load, loads, read_text, tree_text
from dalembert.model.files.rewriting import _file_text, file_tree, text_of
from dalembert.model.library import TEMPLATES
from dalembert.units import file_units
from tests.model.parts import FOUR_BAR
from tests.tiers import over, tiers

M = loads(FOUR_BAR, name="four.yaml")
FORMS = ("yaml", "json", "toml")


@cache
def bundled() -> list[Path]:
    library = Path(str(files("dalembert.model.library"))) / "files"
    return [*cases().values(), *examples().values(), *sorted(library.glob("*.yaml"))]


def numbers(part: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[str, float]]:
    """Path and value of every number of a description, but for its answers."""
    if isinstance(part, BaseModel):
        for name, field in type(part).model_fields.items():
            if name not in ("units", "answers", "dalembert"):
                yield from numbers(getattr(part, name), (*path, field.alias or name))
    elif isinstance(part, dict):
        for key, value in part.items():
            yield from numbers(value, (*path, key))
    elif isinstance(part, tuple):
        for i, value in enumerate(part):
            yield from numbers(value, (*path, str(i)))
    elif isinstance(part, float):
        yield ".".join(path), part


def in_form(path: Path, form: str) -> tuple[str, Mechanism]:
    """A bundled file in a format: its text and its mechanism."""
    text = path.read_text(encoding="utf-8")
    if form != "yaml":
        tree = {key: value for key, value in read_text(text)[0].items() if value is not None}
        text = tree_text(tree, form)
    return text, loads(text, form, str(path))


def changed_lines(before: str, after: str) -> tuple[int, int]:
    """How many lines are no longer there, and how many more there are."""
    a, b = before.splitlines(), after.splitlines()
    blocks = SequenceMatcher(None, a, b, autojunk=False).get_matching_blocks()
    return len(a) - sum(block.size for block in blocks), len(b) - len(a)


def check_one_number(m: Mechanism, text: str, path: str, value: float) -> None:
    """One number changed: the text is read as the changed mechanism, and all other lines are as they were."""
    other = m.with_values({path: value * 1.01 if value else 0.25})
    assert m.source is not None
    own, left_out = _file_text(other, m.source), len(m.parameters) - len(other.parameters)
    if left_out and m.source.form == "toml":  # a table of TOML is not cut out of the text: it is written anew
        own = own or text_of(other, "toml")
        assert loads(own, "toml", m.source.name).to_tree() == other.to_tree()
        return
    written_out = "copies" in text or "cylinder" in text
    if (
        own is None and written_out
    ):  # one copy, or a link that stands for a cylinder, changes alone: all is written
        anew = loads(text_of(other, m.source.form), m.source.form, m.source.name)
        assert anew.to_tree() == other.to_tree()
        return
    assert own is not None, path
    assert loads(own, m.source.form, m.source.name) == other
    changed, added = changed_lines(text, own)
    assert changed <= (2 if "inertia" in path else 1) + 6 * left_out, (
        path
    )  # a product of inertia stands twice
    assert added <= (3 if m.source.form == "toml" else 1), path
    assert changed or added, path


@pytest.mark.parametrize("form", FORMS)
@over(4, 1000)
def test_one_number_changed_changes_one_value(form: str, seed: int) -> None:
    draw = random.Random(f"{form}{seed}")
    text, m = in_form(draw.choice(bundled()), form)
    assert str(m) == text if form == "yaml" else text_of(m, form) == text
    while True:
        path, value = draw.choice(list(numbers(m)))
        try:
            m.with_values({path: value * 1.01 if value else 0.25})
        except ModelError:  # half of what belongs together
            continue
        return check_one_number(m, text, path, value)


@pytest.mark.exhaustive
@pytest.mark.parametrize("k", range(20))
def test_every_number_of_every_file(k: int) -> None:
    count = 0
    for path in bundled()[k::20]:
        text, m = in_form(path, "yaml")
        for where, value in numbers(m):
            try:
                m.with_values({where: value * 1.01 if value else 0.25})
            except ModelError:
                continue
            check_one_number(m, text, where, value)
            count += 1
    assert count > 50


@pytest.mark.parametrize("path", tiers(bundled()[::40], bundled()), ids=lambda path: path.stem)
def test_what_is_not_changed_is_saved_to_the_last_byte(path: Path, tmp_path: Path) -> None:
    for table in path.parent.glob(
        "*.csv"
    ):  # what it refers to: from another folder the points are written out
        shutil.copy(table, tmp_path)
    load(shutil.copy(path, tmp_path)).save(tmp_path / "same.yaml")
    assert (tmp_path / "same.yaml").read_bytes() == path.read_bytes()


SAID: dict[str, tuple[dict[str, Any], str, str]] = {
    "polar text": ({"links.crank.center": "4 @ 35"}, "center: 3 @ 30", "center: 4 @ 35"),
    "polar, of what comes out as polar": (
        {"links.crank.center": da.loads("{units: {length: in}, links: {a: {center: 4 @ 30}}}").center("a")},
        "center: 3 @ 30", "center: 4 @ 30",
    ),
    "a pair in SI": ({"links.crank.center": (0.1, 0.05)}, "center: 3 @ 30", "center: [0.1 m, 0.05 m]"),
    "a pair as text": ({"links.crank.center": "[1 in, 20 mm]"}, "center: 3 @ 30", "center: [1 in, 20 mm]"),
    "bare pair as text": ({"links.crank.points.A": "[6, 0.5]"}, "A: [5, 0]}", "A: [6, 0.5]}"),
    "one component": ({"links.crank.points.A.0": 0.1524}, "A: [5, 0]}", "A: [6, 0]}"),
    "from another point": ({"links.coupler.points.P": [0.0254, 0]}, "{from: center, at: 3 @ 100}", "[1, 0]"),
    "a bare number": ({"links.crank.inertia": "0.5"}, "inertia: 0.4}", "inertia: 0.5}"),
    "a mass for a weight": ({"links.crank.mass": 2.0}, "weight: 1.5", "mass: 2 kg"),
    "its own unit": ({"drives.O2.speed": 30.0}, "speed: 25 rad/s", "speed: 30 rad/s"),
    "an angle in radians": ({"drives.O2.position": 1.0}, "position: 60 deg", "position: 1 rad"),
    "an angle in degrees": ({"drives.O2.position": 0.5235987755982988}, "60 deg", "30 deg"),
    "the size of a polar force": ({"loads.F_P.value": "90"}, "80 @ 330", "90 @ 330"),
    "its direction": ({"loads.F_P.direction": "45 deg"}, "80 @ 330", "80 @ 45"),
    "its components": ({"loads.F_P.value": ["1 N", "2 lbf"]}, "80 @ 330", "[1 N, 2 lbf]"),
    "an expression": ({"loads.T_4.value": "1e3*sin(O2)"}, "value: 120", "value: 1e3*sin(O2)"),
    "unknown": ({"loads.T_4.value": "unknown"}, "value: 120", "value: unknown"),
    "a range": (
        {"drives.O2": {"position": {"from": 0, "to": "360 deg", "count": 7}}},
        "{position: 60 deg, speed: 25 rad/s, acceleration: -40 rad/s^2}",
        "{position: {from: 0, to: 360 deg, count: 7}}",
    ),
    "a title": ({"title": "Another: one"}, "title: Four-bar linkage, dynamic", 'title: "Another: one"'),
    "what was not there": ({"joints.A.damping": 0.5}, "[crank, coupler]", "[crank, coupler], damping: 0.5 N*m*s/rad"),
    "a word": ({"gravity": "standard"}, "gravity: none ", "gravity: standard "),
    "nothing": ({"links.crank.weight": None}, "  weight: 1.5,", ""),
}  # fmt: skip


@pytest.mark.parametrize("what", SAID)
def test_a_value_is_written_as_its_author_would(what: str) -> None:
    values, old, new = SAID[what]
    assert FOUR_BAR.count(old) == 1
    other = M.with_values(values)
    assert other != M
    assert str(other) == FOUR_BAR.replace(old, new)
    assert loads(str(other)) == other


def test_changes_add_up_and_the_last_one_counts() -> None:
    other = M.with_values({"links.crank.points.A.0": 1.0, "title": "x"}).with_values(
        {"links.crank.points": {"O2": [0, 0], "A": "[6, 0]"}, "title": "Four"}
    )
    expected = FOUR_BAR.replace("title: Four-bar linkage, dynamic", "title: Four")
    assert str(other) == expected.replace("A: [5, 0]}", "A: [6, 0]}", 1)
    assert str(other.with_values({"links.crank.points.A": "5 @ 0", "title": M.title})) == FOUR_BAR.replace(
        "A: [5, 0]}", "A: 5 @ 0}", 1
    )


@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_line_ends_and_byte_order_marks_stay(line_end: str, mark: str, tmp_path: Path) -> None:
    content = (mark + FOUR_BAR.replace("\n", line_end)).encode()
    (tmp_path / "a.yaml").write_bytes(content)
    m = load(tmp_path / "a.yaml")
    m.save(tmp_path / "b.yaml")
    assert (tmp_path / "b.yaml").read_bytes() == content
    m.with_values({"links.rocker.inertia": "0.9", "friction.coefficient": 0.1}).save(tmp_path / "c.yaml")
    expected = content.replace(b"inertia: 0.8", b"inertia: 0.9").rstrip()
    expected += f"{line_end}friction: {{coefficient: 0.1}}".encode()
    assert (tmp_path / "c.yaml").read_bytes().rstrip() == expected
    assert load(tmp_path / "c.yaml") == m.with_values(
        {"links.rocker.inertia": "0.9", "friction.coefficient": 0.1}
    )


SHARED = """\
links:            # three alike
  ground: {points: {O: [0, 0], P: [1, 0], Q: [2, 0]}}
  first: &bar     # the first one
    points: {O: [0, 0], P: [0, 0], Q: [0, 0]}
    mass: &m 2 kg
    inertia: 0.1
  second: {<<: *bar, inertia: 0.2}
  third: *bar
  fourth: {mass: *m}
joints:
  O: {type: pin, links: [ground, first]}
  P: {type: pin, links: [ground, second]}
  Q: {type: pin, links: [ground, third]}
"""


def test_anchors_aliases_and_merged_keys() -> None:
    m = loads(SHARED)
    assert [m.mass(link) for link in ("first", "second", "third", "fourth")] == [2, 2, 2, 2]
    assert [m.inertia(link) for link in ("first", "second", "third")] == [0.1, 0.2, 0.1]
    several = (
        "{links: {a: &a {mass: 1, inertia: 1}, b: &b {mass: 2}, c: {<<: [*b, *a], points: {O: [0, 0]}}}}"
    )
    assert (loads(several).mass("c"), loads(several).inertia("c")) == (2, 1)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("inertia: 0.2}", "inertia: -1}", "x:7: inertia of link 'second': -1 is negative"),
        ("{<<: *bar, inertia: 0.2}", "{<<: *baz}", "x:7: unknown anchor 'baz'"),
        ("{<<: *bar, inertia: 0.2}", "{<<: 3}", "x:7: 3 cannot be merged: << needs a mapping; write <<: *name"),
        ("{<<: *bar, inertia: 0.2}", "{<<: *bar, <<: *bar}", "x:7: the key '<<' occurs twice"),
        ("{<<: *bar, inertia: 0.2}", '{"<<": *bar}', "x:7: unknown key '<<' in link 'second'"),
        (
            "    inertia: 0.1\n", "    inertia: 1 kg\n",
            "x:6: inertia of link 'first': '1 kg' is a mass, but a moment of inertia is needed; write one, for example "
            "'0.02 kg*m^2'\nx:8: inertia of link 'third'",
        ),
        (
            "mass: &m 2 kg", "mass: &m 2 m",
            "x:5: mass of link 'first': '2 m' is a length, but a mass is needed; write one, for example '1.5 kg'\n"
            "x:7: mass of link 'second'",
        ),
    ],
)  # fmt: skip
def test_a_merged_key_stands_in_the_line_that_takes_it_in(old: str, new: str, says: str) -> None:
    assert old in SHARED
    with pytest.raises(ModelError) as caught:
        loads(SHARED.replace(old, new), name="x")
    assert str(caught.value).startswith(says)


@pytest.mark.parametrize(
    ("path", "old", "new"),
    [
        ("second.mass", "{<<: *bar, inertia: 0.2}", "{<<: *bar, inertia: 0.2, mass: 3 kg}"),
        ("second.inertia", "inertia: 0.2", "inertia: 3"),
        ("third.mass", "third: *bar", "third: {<<: *bar, mass: 3 kg}"),
        ("fourth.mass", "mass: *m}", "mass: 3 kg}"),
    ],
)
def test_what_an_anchor_hands_on_is_changed_for_one_only(path: str, old: str, new: str) -> None:
    other = loads(SHARED).with_values({f"links.{path}": 3.0})
    assert str(other) == SHARED.replace(old, new)
    assert loads(str(other)) == other


def test_what_others_take_from_an_anchor_stays_theirs() -> None:
    other = loads(SHARED).with_values({"links.first.inertia": 3.0, "links.first.mass": 4.0})
    text = str(other)
    assert "# three alike" in text
    assert "# the first one" in text
    assert loads(text) == other
    assert [other.mass(link) for link in ("first", "second", "third", "fourth")] == [4, 2, 2, 2]


JSON = '{\n\t"units": {"length": "mm"},\n\t"links":\t{"a": {"points": {"O": [0,0],\n\t\t"A": "3 @ 30"}, "mass": 2.50}}}'
TOML = """# a bar
units = { length = 'mm' }  # of length

[links.a]
mass = 2.50 # heavy
points.O = [0, 0]
points.A = '3 @ 30'

[links."b.c"]
inertia = \"\"\"1 kg*m^2\"\"\"
"""


def test_json_and_toml_keep_all_other_characters() -> None:
    m = loads(JSON, "json")
    other = m.with_values(
        {"links.a.mass": 3.0, "links.a.points.A": "4 @ 31", "links.a.points.O.1": 0.001, "links.a.inertia": 1}
    )
    expected = (
        JSON.replace("2.50", '3, "inertia": 1000000').replace("3 @ 30", "4 @ 31").replace("[0,0]", "[0,1]")
    )
    assert text_of(other, "json") == expected
    assert text_of(m, "json") == JSON
    m = loads(TOML.replace('"b.c"', "bc"), "toml")
    other = m.with_values(
        {"links.a.mass": 3.0, "links.a.points.A": "4 @ 31", "links.bc.inertia": 2.0, "links.a.center": None}
    )
    expected = TOML.replace("2.50", "3").replace("3 @ 30", "4 @ 31").replace('"""1 kg*m^2"""', '"2 kg*m^2"')
    assert text_of(other, "toml") == expected.replace('"b.c"', "bc")


@pytest.mark.parametrize("form", FORMS)
def test_letters_of_other_languages_are_written_as_they_are(form: str) -> None:
    """In values that replace others, and in keys that were not there."""
    old = loads(tree_text({"title": "Bar", "links": {"ground": {}, "größe": {}}}, form), form)
    text = text_of(old.with_values({"title": "Prüfstand", "source": "Müller", "links.größe.mass": 2.0}), form)
    assert all(word in text for word in ("Prüfstand", "Müller", "größe"))
    assert "\\u" not in text
    assert loads(text, form).title == "Prüfstand"


def test_a_table_that_others_lie_within_is_added_after_them() -> None:
    text = "[links.ground.points]\nO = [0, 0]\n\n[links.bar.points]  # of the bar\nO = [0, 0]\n"
    other = loads(text, "toml").with_values({"links.bar.mass": 3})
    assert text_of(other, "toml") == text + "\n[links.bar]\nmass = 3\n"


@pytest.mark.parametrize("value", ["3 @ 40", ["1 N", "2 N"]])
def test_a_vector_takes_the_place_of_size_and_direction(value: Any) -> None:
    written = str(value).replace("'", "")
    text = FOUR_BAR.replace("value: 80 @ 330", "value: 80, direction: 330")
    assert text != FOUR_BAR
    other = loads(text).with_values({"loads.F_P.value": value})
    assert str(other) == text.replace("value: 80, direction: 330", f"value: {written}")


@pytest.mark.parametrize("form", FORMS)
def test_another_format_keeps_units_and_texts(form: str, tmp_path: Path) -> None:
    other = M.with_values({"links.crank.center": "4 @ 35"})
    other.save(tmp_path / f"other.{form}")
    assert load(tmp_path / f"other.{form}") == other
    assert "4 @ 35" in (tmp_path / f"other.{form}").read_text()
    assert "80 @ 330" in (tmp_path / f"other.{form}").read_text()


def test_without_a_file_a_person_would_have_written_it() -> None:
    assert str(da.four_bar()) == """\
title: Four-bar linkage
links:
  ground: {points: {O2: [0, 0], O4: [0.3, 0]}}
  crank: {points: {O2: [0, 0], A: [0.09, 0]}, mass: 0.18, center: [0.045, 0], inertia: 0.0001215}
  coupler: {points: {A: [0, 0], B: [0.3, 0]}, mass: 0.6, center: [0.15, 0], inertia: 0.0045}
  rocker: {points: {O4: [0, 0], B: [0.24, 0]}, mass: 0.48, center: [0.12, 0], inertia: 0.002304}
joints:
  O2: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, coupler]}
  B: {type: pin, links: [coupler, rocker]}
  O4: {type: pin, links: [ground, rocker]}
drives:
  O2: {position: {from: 0, to: 360, count: 72}, speed: 120 rpm}
loads:
  torque: {type: couple, on: rocker, value: -10}
assembly: {coupler: 52.616802, rocker: 96.665427}
"""  # fmt: skip


@pytest.mark.parametrize("name", tiers(["rssr", "toggle_press"], TEMPLATES))
@pytest.mark.parametrize(
    "units", [{}, {"length": "in", "force": "lbf", "mass": "blob", "time": "ms", "angle": "rad"}]
)
def test_a_mechanism_built_in_python_is_written_short_and_reads_back_equal(
    name: str, units: dict[str, str]
) -> None:
    m = TEMPLATES[name].function().model_copy(update={"units": file_units(units)})
    for form in FORMS:
        assert loads(text_of(m, form), form) == m
    for drive, keys in file_tree(m)["drives"].items():
        assert ("freedom" in keys) == (len(m.joints[m.drive_joint(drive)].freedoms) > 1)


def test_a_copy_that_was_changed_otherwise_is_saved_as_it_is() -> None:
    other = M.model_copy(update={"title": "Copy"})
    assert str(other) == FOUR_BAR.replace("title: Four-bar linkage, dynamic", "title: Copy")


TEXTS = [
    "3", "3 mm", "-0.0", "\u22123 mm", "1e3", "3 @ 30", "3 mm @ 30 deg", "3 @ 30 mm", "-3 @ 1 rad", "[1, 2]",
    "[1 in, 20 mm]", "[1 in]", "1,5", "1,000 N", "1 000", "3 N", "2 kg", "60 deg", "25 rad/s", "10 rpm", "1e3*O2",
    "2*sin(O2) kN", "unknown", "none", "", " ", "[", "[1, [2]]", "[*a]", "@", "3 @", "\ufeff3", "3\t mm", "3\nmm",
    "{a: 1}", "'3'", "\"3\"", "# 3", "a: b", "null", "~", "true", "x" * 3000,
]  # fmt: skip


def paths(value: Any, path: tuple[str, ...] = ()) -> Iterator[str]:
    """Every path down a tree."""
    if path:
        yield ".".join(path)
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, item in inner:
        yield from paths(item, (*path, str(key)))


@pytest.mark.parametrize("k", tiers([0], range(1, 12)))
def test_any_text_at_any_path_is_refused_or_saved_as_it_is_meant(k: int) -> None:
    taken = 0
    everywhere = [(path, text) for path in paths(read_text(FOUR_BAR)[0]) for text in TEXTS]
    for path, text in random.Random(k).sample(everywhere, 150):
        try:
            other = M.with_values({path: text})
        except ModelError:
            continue
        taken += 1
        assert loads(str(other)) == other, (path, text)
        assert "# version of this format" in str(other), (path, text)
    assert taken > 5
