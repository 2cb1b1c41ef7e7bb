"""Views at their limits: small tensions, wheels without a force, two positions, questions, shafts and bolts by hand."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.notebook.plots import _parts, _values, _vectors, label
from dalembert.pages.inputs import series
from dalembert.pages.messages.number_reading import sign_sentences
from dalembert.views.both_ends import at_both_ends, end_words, open_at
from dalembert.views.charts import _backwards, effort_chart, mean_effort
from dalembert.views.machine.pin_view import _draw_moment
from dalembert.views.notation import Notation, Shown
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.paper.scene import Arc, Arrow, Circle, Line, Polygon, Scene, Text
from dalembert.views.plane.elements.belt_drawings import rope_items, width_of
from dalembert.views.plane.teeth_view import _draw_force, _sizes, tooth_force
from dalembert.views.question import _elsewhere
from tests.methods.test_belts_drawn import middle_line

UNKNOWN: Any = None
FOUR_BAR = da.load(examples()["four_bar"])


def test_two_positions_have_an_order_too() -> None:
    r: Any = SimpleNamespace(
        drives=("O",),
        status=("ok", "ok"),
        schedule=SimpleNamespace(time=None),
        drive_position=lambda _: np.array([1.0, 0.5]),
        drive_speed=lambda _: np.array([3.0, 3.0]),
    )
    assert _backwards(r).tolist() == [True, True]


@pytest.mark.parametrize("low", [0.5, -2.0])
def test_a_question_stands_at_the_golden_part_of_the_range_of_an_equilibrium(low: float) -> None:
    """0.381966 is the square of the golden ratio (sqrt 5 - 1)/2."""
    m = da.load(examples()["balance_position"]).with_values({"drives.O.range": [low, low + 2.5]})
    r = _elsewhere(da.solve(m))
    golden = ((math.sqrt(5) - 1) / 2) ** 2
    assert r.drive_position("O") == pytest.approx([low + 2.5 * golden], abs=1e-5)
    assert r.mechanism.drives["O"].effort is None
    assert r.mechanism.drives["O"].range is None


@pytest.mark.parametrize("size", [0.4, 40.0])
def test_a_rope_is_as_wide_as_its_part_of_the_largest_tension(
    size: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever the largest is, less than 1 N too."""
    r: Any = da.solve(da.hoist(), positions=1)
    tension = size * np.linspace(0.25, 1.0, r.rope("rope").tension.shape[1])
    known = SimpleNamespace(tension=tension[None], direction=r.rope("rope").direction)
    monkeypatch.setattr(type(r), "rope", lambda self, name: known)
    (first,) = [n for n, j in r.mechanism.joints.items() if getattr(j, "rope", "") and j.WRAPPED][:1]
    bands = [i for i in rope_items(r, first, 0, PaperFrame(0.01)) if isinstance(i, Polygon)]
    for band, t in zip(bands, tension, strict=False):
        assert middle_line(band)[1] == pytest.approx([0.6 * width_of(float(t), size)] * 2)


# forces of teeth


def gears() -> Any:
    return da.dynamics(da.load(examples()["gear_train"]))


def test_wheels_without_a_force_say_so() -> None:
    r = gears()
    shown, e = Shown(r, Notation()), np.array([1.0, 0.0])
    name = next(n for n, j in r.mechanism.joints.items() if j.TOOTHED)
    for force, said in (([0.0, 0.0], "no force"), ([np.nan, 0.0], "force not known")):
        canvas = Canvas()
        _draw_force(
            canvas, shown, name, r.mechanism.joints[name].links[1], (3.0, 4.0), np.array(force), e, 2.0
        )
        assert [t.text for t in canvas.scene("").texts() if t.text] == [said]
        assert not any(isinstance(i, (Line, Arrow)) for i in canvas.items)


def test_a_force_of_teeth_is_split_along_the_line_of_centres_and_across_it() -> None:
    """(40, 30) N at 2 N for one millimetre, the pitch point to the left of the wheel's centre."""
    r = gears()
    shown, canvas = Shown(r, Notation()), Canvas()
    name = next(n for n, j in r.mechanism.joints.items() if j.TOOTHED)
    on = r.mechanism.joints[name].links[1]
    at = (3.0, 4.0)
    _draw_force(canvas, shown, name, on, at, np.array([40.0, 30.0]), np.array([-1.0, 0.0]), 2.0)
    arrows = [i for i in canvas.items if isinstance(i, Arrow)]
    assert [(a.tail, a.head, a.value, a.role) for a in arrows] == [
        ((3, 4), (23, 19), 50.0, "joint-force"),
        ((3, 4), (3, 19), 30.0, "effort"),
        ((3, 19), (23, 19), 40.0, "effort"),
    ]
    action, tangent = (i for i in canvas.items if isinstance(i, Line))
    assert (action.role, tangent.role) == ("line-of-action", "construction")
    assert np.array(action.points) == pytest.approx(np.array([(3 - 20.8, 4 - 15.6), (3 + 20.8, 4 + 15.6)]))
    assert np.array(tangent.points) == pytest.approx(np.array([(3, 4 - 26), (3, 4 + 26)]))
    (arc,) = (i for i in canvas.items if isinstance(i, Arc))
    assert arc.center == at
    assert (arc.radius, arc.start) == pytest.approx((20.8, math.pi / 2))
    assert arc.end == pytest.approx(math.atan2(3, 4))
    texts = {t.text for t in canvas.scene("").texts()}
    assert f"α = {shown.notation.degrees(math.atan2(4, 3))}°" in texts
    sign = shown.reaction(name, on)
    force = [shown.text("force", x) for x in (50.0, 30.0, 40.0)]
    assert {f"{sign} = {force[0]}", f"{sign}^{{t}} = {force[1]}", f"{sign}^{{r}} = {force[2]}"} <= texts
    plain = Canvas()
    _draw_force(plain, shown, name, on, at, np.array([0.0, 30.0]), np.array([-1.0, 0.0]), 2.0)
    assert not any(isinstance(i, Arc) for i in plain.items)  # without a radial part no angle
    assert len([i for i in plain.items if isinstance(i, Arrow)]) == 2


def test_teeth_are_pushed_from_the_side_of_the_other_wheel() -> None:
    """From a wheel's centre to the pitch point; inside a ring the other way."""
    r = gears()
    toothed = {name: joint for name, joint in r.mechanism.joints.items() if joint.TOOTHED}
    assert toothed
    for name, joint in toothed.items():
        on, force, e = tooth_force(r, name, 0)
        assert on == (joint.links[1] if joint.links[1] != "ground" else joint.links[0])
        assert force == pytest.approx(r.reaction(name, on)[0])
        assert np.hypot(*e) == pytest.approx(1.0)
        words = _sizes(Shown(r, Notation()), joint, list(joint.links))
        assert words.startswith("Pitch radii: ")
        assert f"pressure angle {math.degrees(joint.pressure_angle):.2f}°: the force acts along" in words


# both ends of what friction leaves open


def test_both_ends_are_under_sentences_and_an_end_without_a_value_says_so() -> None:
    r: Any = da.solve(da.load(cases()["seed-002-7d-engine-at-rest"]))
    k = r.status.index("at_rest")
    shown = Shown(r, Notation())
    assert open_at(r, k)
    marks = [Scene((Circle((0.0, 0.0), float(n), "pin"),)) for n in (1, 2)]
    drawn = iter(marks)
    scene = at_both_ends(r, k, shown, lambda _: next(drawn), "Both")
    assert scene.title == "Both"
    heads = [t.text for t in scene.texts() if t.role == "title"]
    assert any(t.startswith("Low end of ") for t in heads)
    assert any(t.startswith("High end of ") for t in heads)
    assert next(drawn, None) is None
    (pair, *_) = r.ends
    name = (*r.drives, *r.unknown_loads)[0]
    low, high = (
        float(end.effort(name)[k]) if name in r.drives else float(end.unknown_load(name)[k]) for end in pair
    )
    assert low < high
    said = end_words(r, name, pair[0], "Low", k, shown)
    assert said.startswith(f"Low end of {name}, ")
    assert ": friction is at its limit in " in said
    never = np.full(len(r.status), np.inf)
    fake: Any = SimpleNamespace(effort=lambda _: never, unknown_load=lambda _: never)
    assert end_words(r, name, fake, "High", k, shown).startswith(f"High end of {name}: ")
    plain = da.statics(FOUR_BAR)
    assert not open_at(plain, 0)
    one = Scene((Circle((0.0, 0.0), 1.0, "pin"),))
    assert at_both_ends(plain, 0, Shown(plain, Notation()), lambda _: one, "Both") is one


# words and units


def test_a_sign_that_is_wrong_is_told_in_the_words_of_the_model() -> None:
    assert sign_sentences() == {
        "positive": "{text} is not positive; write a positive one",
        "not negative": "{text} is negative; write a positive one, or 0",
    }


def test_even_numbers_below_zero_are_even_to_their_rounding() -> None:
    values = np.linspace(-7.3, 0.0, 11)
    values[3] = np.nextafter(values[3], 0.0)
    assert series(values) == {"from": -7.3, "to": 0.0, "count": 11}
    assert isinstance(series(np.array([-7.3, -5.0, -2.0, 0.0])), str)


def values_of(kind: str, values: list[Any]) -> tuple[list[float], str, bool]:
    """The abscissa of a sweep of one path."""
    r = da.statics(da.four_bar(), positions=2)
    sweep: Any = SimpleNamespace(paths=["p"], labels={"p": SimpleNamespace(values=values, kind=kind)})
    x, text, angle = _values(sweep, Shown(r, Notation()))
    return x.tolist(), text, angle


def test_a_path_of_angles_is_in_degrees_and_texts_are_numbered() -> None:
    degrees, *words = values_of("angle", [0.5, 1.5])
    assert degrees == pytest.approx(np.degrees([0.5, 1.5]))
    assert words == ["p in °", True]
    assert values_of("length", [0.5, 1.5]) == ([0.5, 1.5], "p in m", False)
    assert values_of("number", [0.5, 1.5]) == ([0.5, 1.5], "p", False)
    assert values_of("", ["a", "b", "c"]) == ([1, 2, 3], "p", False)


def test_curves_of_vectors_are_named_by_their_parts() -> None:
    parts = _parts("reaction.A", np.array([[3.0, 4.0], [-5.0, 12.0]]))
    assert list(parts) == ["reaction.A.x", "reaction.A.y", "reaction.A.magnitude"]
    assert parts["reaction.A.magnitude"].tolist() == [5, 13]
    assert list(_parts("center.A", np.ones((2, 3)))) == [
        f"center.A.{p}" for p in ("x", "y", "z", "magnitude")
    ]
    assert _vectors({**parts, "effort.O": parts["reaction.A.x"], "B.magnitude": parts["reaction.A.y"]}) == [
        "reaction.A",
        "effort.O",
        "B",
    ]
    assert label("moment", "N·m") == "Torque in N·m"
    assert label("angular_speed", "rad/s") == "Angular speed in rad/s"
    assert label("number", "") == "Number"


def test_the_mean_of_an_effort_that_is_rounding_is_nothing() -> None:
    r = da.dynamics(FOUR_BAR, positions=36)
    mean = mean_effort(r, "O2")
    assert mean is not None
    (scene,) = effort_chart(r)
    (named,) = (t.text for t in scene.texts() if t.text.startswith("mean of O2: "))
    assert named == f"mean of O2: {Shown(r, Notation()).number('moment', mean)}"
    part = FOUR_BAR.with_values({"drives.O2.position": [0.3, 0.5, 0.9]})
    effort, place = da.statics(part).effort("O2"), np.array([0.3, 0.5, 0.9])
    mean = float((effort[:-1] + effort[1:]) / 2 @ np.diff(place)) / 0.6
    assert mean_effort(da.statics(part), "O2") == pytest.approx(mean, rel=1e-12)


def test_a_bolt_without_a_moment_has_no_curve(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without places, and with nothing at each of them."""
    from dalembert.views.machine import pin_view

    stresses: Any = SimpleNamespace(moment=np.array([1.0, 3.0, 2.0]))
    shown = Shown(da.statics(da.four_bar(), positions=2), Notation())
    for s, m in (([], []), ([0.0, 0.1], [0.0, 0.0]), ([0.0, 0.1, 0.3], [0.0, 6.0, 0.0])):
        canvas = Canvas()
        monkeypatch.setattr(pin_view, "moment_along", lambda x, k, s=s, m=m: (np.array(s), np.array(m)))
        _draw_moment(stresses, shown, canvas, -20.0, lambda a: 100 * a)
        assert len(canvas.items) == (3 if len(s) == 3 else 0)
    base, curve, said = canvas.items
    assert isinstance(base, Line)
    assert isinstance(curve, Line)
    assert isinstance(said, Text)
    assert base.points == ((0, -20), (30, -20))
    assert curve.points == ((0, -20), (0, -20), (10, -42), (30, -20), (30, -20))
    assert (said.text, said.at) == ("M = 6.000 N·m at position 2", (10, -46))
