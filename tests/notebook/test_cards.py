"""What Jupyter shows: tables with units, sentences, a drawing; bounded, escaped, without scripts; plots by name."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.output.summary.printed_units import scale_for
from dalembert.bundled import cases, examples
from dalembert.notebook.html_card import LARGEST_DRAWING, ROWS, card
from dalembert.printing import Table
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
    wide = Table([f"c{k}" for k in range(900)], [[str(j)] * 900 for j in range(5000)], 1)
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
    several = TURN.plot("effort.O2", "reaction.A", "magnitude.B")
    assert [list(n) for n in several.numbers.values()] == [  # type: ignore[union-attr, call-overload]
        ["effort.O2"],
        ["reaction.A.x", "reaction.A.y", "reaction.A.magnitude", "magnitude.B"],
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
    assert r.plot("magnitude.A", ax=ax) is ax
    (line,) = ax.lines
    drawn = np.asarray(line.get_ydata())
    assert (np.isnan(drawn) == ~r.ok).all()
    assert drawn[r.ok] == pytest.approx(r["magnitude.A"][r.ok])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("O2 in °", "Force in N")
    flat, round_ = Figure().subplots(), Figure().subplots(subplot_kw={"projection": "polar"})
    assert r.polar("A", ax=flat) is flat
    assert flat.get_xlabel() == "Force x in N"
    assert np.c_[flat.lines[0].get_data()][r.ok] == pytest.approx(r.reaction("A")[r.ok])
    theta, size = r.polar("A", ax=round_).lines[0].get_data()
    assert (size * np.exp(1j * np.asarray(theta)))[r.ok] == pytest.approx(r.reaction("A")[r.ok] @ [1, 1j])
    assert isinstance(r.polar("A", "B"), da.Scene)
    with pytest.raises(
        da.ModelError, match="moment and force have no unit in common; give each axes of its own"
    ):
        r.plot("effort.O2", "magnitude.A", ax=ax)


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda: TURN["efort.O2"], "there is no quantity 'efort.O2'; did you mean 'effort.O2'?"),
        (lambda: TURN.plot("reaction.A.w"), "reaction.A has no component 'w'; choose among x, y, magnitude"),
        (lambda: TURN.plot("effort.O3"), "there is no quantity 'effort.O3'; did you mean 'effort.O2'?"),
        (lambda: TURN.polar("Aa"), "there is no joint 'Aa'; choose among O2, A, B, O4"),
        (
            lambda: TURN.plot("rotation.rocker"),
            "rotation.rocker is a matrix and no curve; plot angles or speeds",
        ),
        (
            lambda: da.solve(FOUR_BAR).plot(),
            "a plot needs two positions; ask for more: positions=36, or --positions 36",
        ),
        (
            lambda: TURN.plot("effort.O2", against="reaction.A"),
            "reaction.A is no single number to plot against; name a component: reaction.A.x",
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
