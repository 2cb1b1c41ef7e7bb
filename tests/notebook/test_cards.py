"""What Jupyter shows: tables with units, sentences, a drawing; bounded, escaped, without scripts; plots by name."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch import sweep_text
from dalembert.analysis.output.summary.printed_units import scale_for
from dalembert.bundled import cases, examples
from dalembert.notebook import html_card, html_views
from dalembert.notebook.html_card import COLUMNS, LARGEST_DRAWING, LETTERS, ROWS, card
from dalembert.printing import TextTable
from tests.tiers import tiers

HOSTILE = '</style></svg><script>alert(1)</script><img src=x onerror="alert(2)">&amp;'
FOUR_BAR = da.load(examples()["four_bar"])
TURN = da.dynamics(FOUR_BAR, positions=36)


class Reader(HTMLParser):
    """Elements, attributes and text; every element closed in its order."""

    EMPTY = ("br", "path", "circle", "rect", "meta")

    def __init__(self, html: str) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.names: set[str] = set()
        self.attributes: list[tuple[str, str]] = []
        self.rows: list[list[str]] = []
        self.text = ""
        self.feed(html)
        assert not self.open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names.add(tag)
        self.attributes += [(name, value or "") for name, value in attrs]
        if tag not in self.EMPTY:
            self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        elif tag in ("th", "td"):
            self.rows[-1].append("")

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in self.EMPTY:
            self.open.pop()

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] in ("th", "td"):
            self.rows[-1][-1] += data
        elif self.open and self.open[-1] != "style":
            self.text += data + "\n"


def read(thing: Any) -> Reader:
    """The card of a thing: well-formed, without anything that runs or asks the network."""
    html = thing if isinstance(thing, str) else thing._repr_html_()
    found = Reader(html)
    assert not found.names & {"script", "img", "iframe", "link", "object", "foreignobject", "a", "image"}
    assert not [n for n, _ in found.attributes if n.startswith("on") or n in ("href", "src")]
    for style in re.findall(r"<style>(.*?)</style>", html, re.S):
        assert not re.search(r"url\(|@import|javascript:", style)
    assert len(html) < LARGEST_DRAWING + 150_000
    return found


def things(m: da.Mechanism) -> list[Any]:
    r = da.solve(m)
    return [m, r, da.compile(m, vary=["links.crank.weight"]), da.wrench.on(r, "coupler")]


def test_each_thing_shows_its_table_and_its_drawing() -> None:
    m, r, k, s = map(read, things(FOUR_BAR))
    assert ["crank", "0.003886", "2.598, 1.5", "0.4", "O2, A"] in m.rows
    assert ["O2", "O2", "60 deg", "60 deg", "1"] in m.rows
    assert ["O2", "60 deg", "25 rad/s", "-40 rad/s^2", "243.2376 lbf*in"] in r.rows
    assert [
        "joint",
        "by i",
        "on j",
        "F_ij xlbf",
        "F_ij ylbf",
        "|F_ij|lbf",
        "directiondeg",
        "momentlbf*in",
    ] in r.rows
    assert "Assumptions: gravity none, inertia on (D'Alembert), friction off" in r.text
    assert k.rows[1] == ["links.crank.weight", "6.67233"]
    assert "effort.O2, reaction.O2" in k.text
    assert s.rows[0][:3] == ["part", "F xlbf", "F ylbf"]
    assert "It reduces to: zero. In equilibrium" in s.text
    for shown in (m, r, s):
        assert "svg" in shown.names


@pytest.mark.parametrize("name", tiers(["rssr"], ["truss", "balance_position", "engine"]))
def test_every_sort_of_mechanism_has_a_card(name: str) -> None:
    m = da.load(examples()[name])
    r = da.solve(m, positions=5 if m.drives and name != "balance_position" else None)
    assert "svg" in read(m).names
    assert m.title in read(r).text


def eighths(names: list[str]) -> list[Any]:
    return tiers([], names[::8], [name for k, name in enumerate(names) if k % 8])


@pytest.mark.parametrize("name", eighths([*cases(), *examples()]))
def test_every_bundled_file_has_cards_and_all_its_names(name: str, tmp_path: Any) -> None:
    m = da.load({**cases(), **examples()}[name])
    r = da.solve(m)
    assert m.title in read(m).text
    assert m.title in read(r).text
    for one in r._ipython_key_completions_():
        assert len(r[one]) == len(r.status), one
    r.to_xlsx(tmp_path / "r.xlsx")


PRESS = """
title: press
source: own
units: {length: mm, mass: g, force: kN}
parameters: {r: {value: 40 mm, about: crank radius}, n: "2.5"}
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [r, 0]}, mass: 250 g, center: [10 mm, -2.5 mm], inertia: 1200 g*mm^2}
  rod: {points: {A: [0, 0], B: [n*36 mm, 0]}}
  ram: {points: {B: [0, 0]}, mass: 2 kg}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, ram]}
  guide: {type: slider, links: [ground, ram], at: [O, B], direction: 0}
drives: {stroke: {joint: guide, position: {from: 100, to: 120, count: 3}}}
loads: {P: {type: force, on: ram, at: B, value: [-2, 0]}, brake: {type: couple, on: crank, value: unknown}}
assembly: {rod: -20}
"""


def test_a_mechanisms_card_row_by_row() -> None:
    shown = read(da.loads(PRESS))
    assert shown.rows == [
        ["parameter", "value", "what it is"],
        ["r", "40 mm", "crank radius"],
        ["n", "2.5", ""],
        ["link", "massg", "centermm", "inertiag*mm^2", "points"],
        ["ground", "0", "", "0", "O"],
        ["crank", "250", "10, -2.5", "1200", "O, A"],
        ["rod", "0", "", "0", "A, B"],
        ["ram", "2000", "0, 0", "0", "B"],
        ["joint", "type", "links"],
        ["O", "pin", "ground, crank"],
        ["A", "pin", "crank, rod"],
        ["B", "pin", "rod, ram"],
        ["guide", "slider", "ground, ram"],
        ["drive", "of joint", "from", "to", "positions"],
        ["stroke", "guide", "100 mm", "120 mm", "3"],
        ["load", "type"],
        ["P", "force"],
        ["brake", "couple"],
    ]
    assert shown.text.startswith("press\nown\npress, stroke = 100.0 mm\n")
    html = da.loads(PRESS)._repr_html_()
    lefts = [row.count('class="da-left"') for row in re.findall("<tr>.*?</tr>", html, re.S)]
    assert lefts == [3] * 3 + [1] * 5 + [3] * 5 + [2] * 5
    space = read(da.load(examples()["rssr"])).rows
    assert ["rod", "0.1106", "-20, 75, 45", "matrix", "A, B"] in space
    assert ["ground", "0", "", "0", "O, C"] in space
    plain = read(da.loads(re.sub("title.*\n|source.*\n|drives.*\n|loads.*\n", "", PRESS)))
    assert plain.text.startswith("Mechanism\n")
    assert [row[0] for row in plain.rows][-4:] == ["O", "A", "B", "guide"]


def test_a_kernels_card_says_how_it_was_compiled() -> None:
    weight, turn = "links.crank.weight", {"drives.O2.position": {"from": 0, "to": 90, "count": 4}}
    static = {"static": True, "reduce": "peak"}
    table: list[tuple[Any, dict[str, Any], str]] = [
        (FOUR_BAR, {}, "positions: 1; with inertia; values at every position"),
        (FOUR_BAR.with_values(turn), static, "positions: 4; static; reduced over them: peak"),
        (
            FOUR_BAR,
            {"derivatives": True},
            "positions: 1; with inertia; values at every position; exact derivatives",
        ),
    ]
    for m, how, text in table:
        shown = read(da.compile(m, vary=[weight], outputs=["effort.O2", "reaction.A"], lanes=2, **how))
        said = f"{text}; 2 values side by side."
        assert shown.text == f"Kernel of {FOUR_BAR.title}\n{said}\nOutputs: effort.O2, reaction.A.\n"
        assert shown.rows == [["number", "as described, SI"], [weight, "6.67233"]]
    assert read(da.compile(FOUR_BAR.with_values({"title": ""}))).text.startswith("Kernel of a mechanism\n")


def test_a_force_systems_card_row_by_row() -> None:
    force, couple = da.wrench.Force, da.wrench.Couple
    parts = (force([30, 40], at=[0.5, 0.2]), couple(7.0), force([1.5, -2]))
    plane = read(da.wrench.System(*parts, title="bracket", source="own"))
    assert plane.rows == [
        ["part", "F xN", "F yN", "at xm", "at ym", "MN*m"],
        ["F1", "30", "40", "0.5", "0.2", ""],
        ["M1", "", "", "", "", "7"],
        ["F2", "1.5", "-2", "0", "0", ""],
        ["sum at the origin", "31.5", "38", "0", "0", "21"],  # 0.5*40 - 0.2*30 + 7
    ]
    assert plane.text.startswith("bracket\nown\nIt reduces to: single force. Not in equilibrium: neither")
    space = read(da.wrench.System(force([30, 40, -5], at=[0.5, 0.2, 0.1]), couple([1, 2, 3])))
    assert space.rows == [
        ["part", *(f"F {a}N" for a in "xyz"), *(f"at {a}m" for a in "xyz"), *(f"M {a}N*m" for a in "xyz")],
        ["F1", "30", "40", "-5", "0.5", "0.2", "0.1", "", "", ""],
        ["M1", *[""] * 6, "1", "2", "3"],
        ["sum at the origin", "30", "40", "-5", "0", "0", "0", "-4", "7.5", "17"],
    ]
    assert space.text.startswith("Force system\nIt reduces to: wrench.")
    sums = read(da.wrench.System(force([6e5, 0]), force([6e5, 0], at=[0, 1])))  # either alone in kN
    assert (sums.rows[0][1], sums.rows[-1][1:]) == ("F xMN", ["1.2", "0", "0", "0", "-0.6"])
    turning = read(da.wrench.System(couple(6e8), couple(6e8)))
    assert (turning.rows[0][-1], turning.rows[-1][-1]) == ("MMN*m", "1200")


def test_the_bounds_of_a_card_from_both_sides() -> None:
    for rows, ends in ((ROWS, 0), (ROWS + 1, 4)):
        shown = read(card("", TextTable(["n"], [[str(k)] for k in range(rows)], 0)))
        found = [row[0] for row in shown.rows[1:]]
        every = [str(k) for k in range(rows)]
        assert found == (every if not ends else [*every[: ROWS - 5], "...", *every[-ends:]])
    for columns, note in ((COLUMNS, ""), (COLUMNS + 3, "3 more columns. and\n")):
        shown = read(card("", TextTable(["n"] * columns, [["1"] * columns], 0, "and" if note else "")))
        assert ([len(row) for row in shown.rows], shown.text) == ([COLUMNS, COLUMNS], note)
    for letters, cut in ((LETTERS, False), (LETTERS + 1, True)):
        text = "x" * letters
        kept = "x" * (LETTERS - 3) + "..." if cut else text
        shown = read(card(text, text, TextTable(["n"], [[text]], 0)))
        assert (shown.text, shown.rows[1]) == (f"{kept}\n{kept}\n", [kept])
    assert read(card("a  b\n c", "")).text == "a b c\n"
    html = card("", TextTable(["one\ntwo", "b"], [["x\ny", "2"]], 1))
    assert '<th class="da-left">one<br>two</th><th>b</th>' in html
    assert '<td class="da-left">x<br>y</td><td>2</td>' in html


def test_what_is_too_large_is_not_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn = lambda thing: "svg" in read(thing).names  # noqa: E731
    few, links = da.dynamics(FOUR_BAR, positions=3), len(FOUR_BAR.links)
    for most, limit in (("MOST_DRAWN", links), ("MOST_POSITIONS", 3)):
        monkeypatch.setattr(html_views, most, limit)
        assert drawn(few)
        monkeypatch.setattr(html_views, most, limit - 1)
        assert not drawn(few)
        assert drawn(FOUR_BAR) == (most == "MOST_POSITIONS")
        monkeypatch.undo()
    scene = FOUR_BAR.draw()
    monkeypatch.setattr(html_card, "LARGEST_DRAWING", len(scene.to_svg()))
    assert "<svg" in card("", scene)
    monkeypatch.setattr(html_card, "LARGEST_DRAWING", len(scene.to_svg()) - 1)
    shown = read(card("", scene))
    assert "svg" not in shown.names
    assert shown.text == "The drawing is too large for this card: .draw() shows it.\n"


def test_a_sweeps_card_row_by_row(monkeypatch: pytest.MonkeyPatch) -> None:
    varied: dict[str, Any] = {"links.coupler.weight": ["5 lbf", "9 lbf"], "links.rocker.weight": [10.0, 20.0]}
    s = da.sweep(FOUR_BAR, varied, positions=5, outputs=["effort.O2", "reaction.A", "rotation.rocker"])
    shown = read(s)
    assert shown.text.splitlines()[:3] == [FOUR_BAR.title, FOUR_BAR.source_text, repr(s).strip("<>")]
    assert shown.rows[0] == [*varied, "solved", "largest effort.O2lbf*in", "largest reaction.Albf"]
    named = [(a, b) for a in varied["links.coupler.weight"] for b in ("10 N", "20 N")]
    assert [row[:3] for row in shown.rows[1:]] == [[a, b, "5 of 5"] for a, b in named]
    for row, (a, b) in zip(shown.rows[1:], named, strict=True):
        r = da.dynamics(FOUR_BAR.with_values(dict(zip(varied, (a, b), strict=True))), positions=5)
        peaks = np.abs(r.effort("O2")).max(), np.linalg.norm(r.reaction("A"), axis=1).max()
        known = [peaks[0] / 0.1129848290276167, peaks[1] / 4.4482216152605]
        assert [float(x) for x in row[3:]] == pytest.approx(known, rel=1e-5)
    short = da.sweep(da.four_bar(), "links.coupler.points.B.0", [0.1, 0.11, 0.12], positions=8)
    problems = [f"{status}: {which}: {sentence}" for which, status, sentence in short.problems()]
    assert len(problems) == 3
    for most in (3, 2):
        monkeypatch.setattr(sweep_text, "MOST_SAID", most)
        said = read(short).text.splitlines()
        assert [p[:60] for p in problems if any(line.startswith(p[:60]) for line in said)] == [
            p[:60] for p in problems[:most]
        ]


def test_large_numbers_have_the_prefix_of_the_printed_tables() -> None:
    """A force system and a sweep in MN, as a result of such forces is; a small force beside them asks for kN."""
    s = da.wrench.System(da.wrench.Force([8e6, 0], at=[0, 2]), da.wrench.Couple(2e5))
    assert "F x<br>MN" in s._repr_html_()
    m = da.four_bar().with_values({"loads": {"P": {"type": "couple", "on": "rocker", "value": "8e6 N*m"}}})
    sweep = da.sweep(m, "links.coupler.mass", ["1 kg", "2 kg"])
    assert "largest effort.O2<br>MN*m" in sweep._repr_html_()
    assert scale_for(None, {"force": 8e6}).text("force") == "MN"
    assert scale_for(None, {"force": 8e6}, 0.5).text("force") == "kN"
    assert scale_for(None, {"force": 8e9}, 0.5).text("force") == "MN"


def test_a_long_result_shows_first_and_last_rows_and_extremes() -> None:
    shown = read(TURN)
    numbered = [row for row in shown.rows if row[0].isdigit()]
    assert (numbered[0][0], numbered[-1][0]) == ("1", "36")
    assert len(numbered) == 12
    assert "12 of 36 positions are shown; to_dataframe() has every one." in shown.text
    peak = next(row for row in shown.rows if row[0] == "effort O2")
    worst, at = TURN.worst("effort", "O2")
    place = f"{np.degrees(TURN.drive_position('O2')[at]):.6g} deg"
    found = dict(zip(peak[3::2], peak[2::2], strict=True))
    assert abs(float(found[place])) == pytest.approx(worst / 0.1129848290276167, rel=1e-5)


def test_no_answer_is_a_sentence() -> None:
    short = da.four_bar().with_values(
        {"links.coupler.points.B": [0.01, 0], "links.rocker.points.B": [0.01, 0]}
    )
    shown = read(da.statics(short))
    assert "not_assembled" in shown.text
    assert "svg" not in shown.names
    assert "No drawing:" in shown.text


def test_hostile_names_stay_text() -> None:
    tree = FOUR_BAR.to_tree()
    text = str(FOUR_BAR.with_values({"title": HOSTILE, "source": HOSTILE}))
    m = da.loads(text.replace("coupler", "'<b>&\"x'").replace("F_P", "'<i onload=1>'"))
    assert m.title == HOSTILE
    assert tree["title"] != HOSTILE
    for thing in (m, da.solve(m), da.compile(m), da.wrench.System(da.wrench.Force([1, 0]), title=HOSTILE)):
        found = read(thing)
        assert "alert" not in " ".join(value for _, value in found.attributes)
        assert HOSTILE in found.text


def test_cards_are_bounded() -> None:
    wide = TextTable([f"c{k}" for k in range(900)], [[str(j)] * 900 for j in range(5000)], 1)
    html = card("t" * 10_000, wide, "s " * 10_000)
    assert len(html) < 40_000
    found = read(html)
    assert len(found.rows) == ROWS + 1
    assert found.rows[-1][0] == "4999"
    assert "884 more columns." in found.text


def test_dark_and_light_have_the_looks_of_the_themes() -> None:
    html = FOUR_BAR._repr_html_()
    assert '[data-jp-theme-light="false"]' in html
    assert "prefers-color-scheme:dark" in html
    dark = html[html.index("prefers-color-scheme") :]
    assert re.search(r"\.da-card \.l-link\{stroke:#e8edf2", dark)
    assert not re.search(r"(?<!da-card )\.l-[\w-]+\{", html[: html.index("<svg")]), (
        "a dark rule is for cards only"
    )


# plots


def test_curves_by_name_are_the_numbers_of_the_result() -> None:
    scene = TURN.plot("effort.O2")
    assert isinstance(scene, da.Scene)
    assert list(scene.numbers) == ["effort.O2"]
    assert scene.numbers["effort.O2"] == pytest.approx(TURN.effort("O2") / 0.1129848290276167, rel=1e-9)
    labels = [t.text for t in scene.texts()]
    assert {"O2 in °", "Torque in lbf·in"} <= set(labels)
    several = TURN.plot("effort.O2", "reaction.A", "reaction.B.magnitude")
    assert [list(n) for n in several.numbers.values()] == [  # type: ignore[union-attr, call-overload]
        ["effort.O2"],
        ["reaction.A.x", "reaction.A.y", "reaction.A.magnitude", "reaction.B.magnitude"],
    ]
    assert TURN.plot().numbers == scene.numbers
    assert "angle.rocker in °" in [t.text for t in TURN.plot("effort.O2", against="angle.rocker").texts()]


def test_plots_on_axes_have_units_and_gaps() -> None:
    from matplotlib.figure import Figure

    gap = da.four_bar().with_values(
        {"links.crank.points.A": [0.9, 0.0], "links.coupler.points.B": [0.6, 0.0]}
    )
    r = da.statics(gap, positions=60)
    assert 0 < r.ok.sum() < 60
    ax = Figure().subplots()
    assert r.plot("reaction.A.magnitude", ax=ax) is ax
    (line,) = ax.lines
    drawn = np.asarray(line.get_ydata())
    assert (np.isnan(drawn) == ~r.ok).all()
    assert drawn[r.ok] == pytest.approx(r["reaction.A.magnitude"][r.ok])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("O2 in °", "Force in N")
    flat, round_ = Figure().subplots(), Figure().subplots(subplot_kw={"projection": "polar"})
    assert r.polar("A", ax=flat) is flat
    assert flat.get_xlabel() == "Force x in N"
    assert np.c_[flat.lines[0].get_data()][r.ok] == pytest.approx(r.reaction("A")[r.ok])
    theta, size = r.polar("A", ax=round_).lines[0].get_data()
    assert (size * np.exp(1j * np.asarray(theta)))[r.ok] == pytest.approx(r.reaction("A")[r.ok] @ [1, 1j])
    assert isinstance(r.polar("A", "B"), da.Scene)
    with pytest.raises(da.ModelError, match="moment and force have different units; give each separate axes"):
        r.plot("effort.O2", "reaction.A.magnitude", ax=ax)


def test_curves_have_their_values_labels_and_titles() -> None:
    """On axes a curve is what the result answers, in the units of its labels; panels for each kind in a scene."""
    from matplotlib.figure import Figure

    lbf = 4.4482216152605
    ax = Figure().subplots()
    TURN.plot("reaction.A", "reaction.B.x", ax=ax)
    assert [t.get_text() for t in ax.get_legend().texts] == [
        *(f"reaction.A.{part}" for part in ("x", "y", "magnitude")),
        "reaction.B.x",
    ]
    force = TURN.reaction("A") / lbf
    known = [force[:, 0], force[:, 1], np.hypot(*force.T), TURN.reaction("B")[:, 0] / lbf]
    for line, curve in zip(ax.lines, known, strict=True):
        assert line.get_xdata() == pytest.approx(np.degrees(TURN.drive_position("O2")))
        assert line.get_ydata() == pytest.approx(curve)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("O2 in °", "Force in lbf")
    one = Figure().subplots()
    TURN.plot("angle.rocker.speed", ax=one, against="angle.rocker")
    assert one.get_legend() is None
    assert one.lines[0].get_xdata() == pytest.approx(np.degrees(TURN["angle.rocker"]))
    assert (one.get_xlabel(), one.get_ylabel()) == ("angle.rocker in °", "Angular speed in rad/s")
    flat, round_ = Figure().subplots(), Figure().subplots(subplot_kw={"projection": "polar"})
    for ax in (flat, round_):
        assert [line.get_label() for line in TURN.polar(ax=ax).lines] == ["O2", "A", "B", "O4"]
        assert [t.get_text() for t in ax.get_legend().texts] == ["O2", "A", "B", "O4"]
    assert (flat.get_ylabel(), flat.get_aspect(), flat.get_title()) == ("Force y in lbf", 1.0, "")
    assert (round_.get_title(), round_.get_xlabel()) == ("Force in lbf", "")
    space = da.solve(da.load(examples()["rssr"]), positions=3)
    ax = Figure().subplots()
    space.plot("reaction.A", ax=ax)
    assert [line.get_label() for line in ax.lines] == [
        f"reaction.A.{p}" for p in ("x", "y", "z", "magnitude")
    ]
    assert ax.lines[-1].get_ydata() == pytest.approx(np.linalg.norm(space.reaction("A"), axis=1))
    assert "reaction.A" in {t.text for t in space.plot("reaction.A").texts()}
    wheel = Figure().subplots()
    TURN.plot("effort.O2", ax=wheel, against="reaction.A.x")
    assert wheel.lines[0].get_xdata() == pytest.approx(force[:, 0])
    assert wheel.get_xlabel() == "reaction.A.x in lbf"
    panels = TURN.plot("reaction.A", "reaction.B.x", "effort.O2")
    assert panels.title == TURN.mechanism.title
    assert {"reaction.A, reaction.B", "effort.O2", "Force in lbf"} <= {t.text for t in panels.texts()}


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda: TURN["efort.O2"], "unknown quantity 'efort.O2'; did you mean 'effort.O2'?"),
        (
            lambda: TURN.plot("reaction.A.w"),
            "reaction.A has no component 'w'; choose among x, y, magnitude, direction",
        ),
        (lambda: TURN.plot("effort.O3"), "unknown quantity 'effort.O3'; did you mean 'effort.O2'?"),
        (lambda: TURN.polar("Aa"), "unknown joint 'Aa'; choose among O2, A, B, O4"),
        (
            lambda: TURN.plot("rotation.rocker"),
            "rotation.rocker is a matrix, not a curve; plot angles or speeds",
        ),
        (
            lambda: da.solve(FOUR_BAR).plot(),
            "a plot needs two positions; ask for more: positions=36, or --positions 36",
        ),
        (
            lambda: TURN.plot("effort.O2", against="reaction.A"),
            "reaction.A is not a single number to plot against; name a component: reaction.A.x",
        ),
    ],
)
def test_unknown_quantities_are_refused_by_name(ask: Any, said: str) -> None:
    with pytest.raises(da.ModelError) as refused:
        ask()
    assert str(refused.value) == said


@pytest.mark.parametrize("name", ["four_bar", "rssr"])
def test_every_name_that_completes_is_answered(name: str) -> None:
    r = da.solve(da.load(examples()[name]))
    names = r._ipython_key_completions_()
    assert len(names) == len(set(names)) > 30
    for one in names:
        assert len(r[one]) == len(r.status), one


def test_a_drawing_in_one_line() -> None:
    assert FOUR_BAR.draw().texts()
    assert TURN.draw("free-bodies", at=3).arrows()


def test_completion_shows_the_mechanisms_own_words() -> None:
    from IPython.core.completer import IPCompleter, provisionalcompleter

    words = {word for word in dir(FOUR_BAR) if not word.startswith("_")}
    assert {"links", "joints", "draw", "with_values", "save", "mass"} <= words
    assert not [word for word in words if "model" in word or word in ("copy", "json", "dict", "schema")]
    completer = IPCompleter(namespace={"m": FOUR_BAR, "r": TURN})
    with provisionalcompleter():
        shown = {c.text for c in completer.completions("m.", 2)}
        keys = {c.text.strip("\"'[]") for c in completer.completions("r['effort.", 10)}
    assert {w for w in shown if not w.startswith(("_", "."))} <= words
    assert "effort.O2" in keys
