"""What is read from the answer of a kernel: by name, signed by link, in the link's axes, as columns and with labels."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.batch_columns import MOST_SAID, batch_arrays, batch_columns, batch_parts
from dalembert.analysis.batch.batch_result import (
    CODES,
    BatchResult,
    among,
    first_mark,
    mark_overflow,
    not_finite,
    one_number,
)
from dalembert.analysis.batch.sides import Sides
from dalembert.analysis.batch.tracing.symbolic_model import numbers
from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.errors import ModelError
from dalembert.printing import TextTable

CODE = {status: CODES.index(status) for status in CODES}
SI = Printed(None)


def machine(**units: str) -> da.Mechanism:
    tree = da.four_bar(positions=3).to_tree()
    return da.mechanism(tree | ({"units": units} if units else {}))


def batch(arrays: dict[str, Any], reduce: str | None = None, code: Any = None, **more: Any) -> BatchResult:
    """An answer of two designs at three positions, of some arrays."""
    m = more.pop("mechanism", None) or machine()
    varied = numbers(m, ["links.coupler.mass", "links.coupler.center"])
    kernel = SimpleNamespace(
        mechanism=m,
        reduce=reduce,
        numbers=tuple(n.path for n in varied),
        trace=SimpleNamespace(numbers=varied, inertia=True),
    )
    shape = (2,) if reduce else (2, 3)
    values = np.array([[0.6, 0.1, 0.02], [0.8, 0.15, 0.03]])
    codes = np.zeros(shape, np.uint8) if code is None else np.array(code, np.uint8)
    here = {name: np.array(a, float) for name, a in arrays.items()}
    return BatchResult(
        kernel, values, np.array([[0.0], [1.0], [2.0]]), codes, here, more.pop("gradients", {}), **more
    )


EFFORT = np.array([[3.0, -5.0, 2.0], [7.0, 4.0, -9.0]])
FORCE = np.stack([EFFORT * 2 + 1, EFFORT * 3 - 2], axis=-1)
ANGLE = np.array([[0.3, 0.6, 0.9], [1.2, 1.5, 1.8]])


def test_quantities_are_read_by_the_name_that_was_compiled() -> None:
    names = {
        "effort": (("O2",), "effort.O2"),
        "unknown_load": (("F",), "load.F"),
        "magnitude": (("A",), "reaction.A.magnitude"),
        "angle": (("coupler",), "angle.coupler"),
        "rotation": (("coupler",), "rotation.coupler"),
        "speed": (("coupler",), "angle.coupler.speed"),
        "acceleration": (("coupler",), "angle.coupler.acceleration"),
        "position": (("coupler",), "point.coupler.origin"),
        "velocity": (("coupler",), "point.coupler.origin.velocity"),
        "center": (("coupler",), "point.coupler.center"),
        "center_velocity": (("coupler",), "point.coupler.center.velocity"),
        "center_acceleration": (("coupler",), "point.coupler.center.acceleration"),
        "point": (("coupler", "B"), "point.coupler.B"),
        "point_velocity": (("coupler", "B"), "point.coupler.B.velocity"),
        "point_acceleration": (("coupler", "B"), "point.coupler.B.acceleration"),
    }
    arrays = {name: EFFORT + k for k, (_, name) in enumerate(names.values())}
    b = batch(arrays)
    for method, (of, name) in names.items():
        assert getattr(b, method)(*of).tolist() == arrays[name].tolist(), method
        assert b.value(name) is b.arrays[name]
    assert b.keys() == list(arrays)
    with pytest.raises(ModelError) as raised:
        b.effort("O4")
    assert str(raised.value) == "'effort.O4' was not compiled; compile with outputs=[..., 'effort.O4']"


def test_components_are_read_behind_the_name_of_a_vector() -> None:
    b = batch({"reaction.A": FORCE, "effort.O2": EFFORT, "reaction.A.magnitude": EFFORT})
    assert b["reaction.A.x"].tolist() == FORCE[..., 0].tolist()
    assert b["reaction.A.y"].tolist() == FORCE[..., 1].tolist()
    assert b["reaction.A.magnitude"].tolist() == EFFORT.tolist()
    assert b["effort.O2"].tolist() == EFFORT.tolist()
    reduced = batch({"reaction.A": FORCE[:, 0]}, "peak")
    for answer, name in ((b, "reaction.B.x"), (reduced, "reaction.A.x")):
        with pytest.raises(ModelError, match=f"'{name}' was not compiled"):
            answer[name]


def test_a_reaction_acts_on_either_link_with_either_sign() -> None:
    b = batch(
        {"reaction.A": FORCE, "reaction_moment.A": EFFORT, "angle.coupler": ANGLE, "angle.crank": -ANGLE}
    )
    for on, sign in ((None, 1.0), ("coupler", 1.0), ("crank", -1.0)):
        assert b.reaction("A", on).tolist() == (sign * FORCE).tolist()
        assert b.reaction_moment("A", on).tolist() == (sign * EFFORT).tolist()
    for on, angle, sign in ((None, ANGLE, 1.0), ("coupler", ANGLE, 1.0), ("crank", -ANGLE, -1.0)):
        c, s = np.cos(angle), np.sin(angle)
        x, y = sign * FORCE[..., 0], sign * FORCE[..., 1]
        turned = np.stack([c * x + s * y, c * y - s * x], axis=-1)
        assert b.reaction("A", on, axes="link") == pytest.approx(turned, rel=1e-14)


def test_the_axes_of_the_ground_are_those_of_a_reaction_on_it() -> None:
    b = batch({"reaction.O2": FORCE})
    assert b.reaction("O2", "ground", axes="link").tolist() == (-FORCE).tolist()


def test_a_reaction_in_space_is_turned_by_the_matrix_of_its_link() -> None:
    m = da.rssr()
    turn = np.broadcast_to(np.array([[0.0, -1, 0], [0, 0, -1], [1, 0, 0]]), (2, 3, 3, 3))
    force = np.arange(1.0, 19.0).reshape(2, 3, 3)
    kernel = SimpleNamespace(mechanism=m, reduce=None)
    joint, (_, link) = next((n, j.links) for n, j in m.joints.items() if j.links[1] != "ground")
    arrays = {f"reaction.{joint}": force, f"rotation.{link}": turn.reshape(2, 3, 9)}
    b = BatchResult(kernel, np.zeros((2, 0)), np.zeros((3, 1)), np.zeros((2, 3), np.uint8), arrays, {})
    assert b.reaction(joint, axes="link") == pytest.approx(
        np.stack([force[..., 2], -force[..., 0], -force[..., 1]], axis=-1)
    )


@pytest.mark.parametrize(
    ("reduce", "sign"), [("peak", 1.0), ("rms", 1.0), ("norm8", 1.0), ("mean", -1.0), ("argpeak", 1.0)]
)
def test_a_reduced_reaction_on_the_other_link_has_its_sign_where_sizes_have_none(
    reduce: str, sign: float
) -> None:
    b = batch({"reaction.A": FORCE[:, 0]}, reduce)
    assert b.reaction("A", "crank").tolist() == (sign * FORCE[:, 0]).tolist()
    assert b.reaction("A", "coupler").tolist() == FORCE[:, 0].tolist()


@pytest.mark.parametrize(
    ("reduce", "asked", "sentence"),
    [
        (None, {"axes": "joint"}, "unknown axes 'joint'; use ground or link"),
        (None, {"joint": "Q"}, "unknown joint 'Q'; the joints are O2, A, B, O4"),
        (None, {"on": "rocker"}, "joint 'A' does not act on 'rocker'; it joins crank and coupler"),
        ("envelope", {"on": "crank"}, "the envelope is that of the force on 'coupler'; ask on='coupler'"),
        ("peak", {"axes": "link"}, 'a reduced reaction has ground axes only; leave axes="link" out'),
        (
            None,
            {"axes": "link"},
            "'angle.coupler' was not compiled; compile with outputs=[..., 'angle.coupler']",
        ),
    ],
)
def test_a_reaction_that_cannot_be_read_is_refused(
    reduce: str | None, asked: dict[str, str], sentence: str
) -> None:
    b = batch({"reaction.A": FORCE}, reduce)
    with pytest.raises(ModelError) as raised:
        b.reaction(**({"joint": "A"} | asked))
    assert str(raised.value) == sentence
    if "on" in asked and reduce is None:
        assert raised.value.path == ("joints", "A")


def test_derivatives_are_read_if_they_were_compiled() -> None:
    slope = np.arange(18.0).reshape(2, 3, 3)
    b = batch({"effort.O2": EFFORT, "angle.crank": ANGLE}, gradients={"effort.O2": slope})
    assert b.gradient("effort.O2") is slope
    with pytest.raises(ModelError) as raised:
        b.gradient("angle.crank")
    assert str(raised.value) == "no derivatives were compiled; compile with derivatives=True"
    with pytest.raises(ModelError, match=r"'load\.F' was not compiled"):
        b.gradient("load.F")


def test_a_reduced_quantity_is_one_number_a_design() -> None:
    assert one_number("effort.O2", EFFORT, False) is EFFORT
    assert one_number("effort.O2", EFFORT[0], True).tolist() == EFFORT[0].tolist()
    with pytest.raises(ModelError) as raised:
        one_number("reaction.A", FORCE[:, 0], True)
    assert str(raised.value) == (
        'reaction.A has 2 numbers a design; ask for one: reduce="peak" of a scalar, as reaction.A.magnitude'
    )
    b = batch({"effort.O2": EFFORT}, after=batch({"effort.O2": EFFORT + 1}))
    assert [side.tolist() for side in b.both_sides("effort.O2")] == [EFFORT.tolist(), (EFFORT + 1).tolist()]
    with pytest.raises(ModelError, match="2 numbers a design"):
        batch({"reaction.A": FORCE[:, 0]}, "peak").both_sides("reaction.A")


def test_the_mark_of_several_positions_is_the_first_without_numbers() -> None:
    codes = [
        ([0, 0, 0], "ok"),
        ([0, CODE["reversal"], 0], "reversal"),
        ([CODE["reversal"], CODE["jammed"], 0], "jammed"),
        ([CODE["jammed"], CODE["not_assembled"], CODE["self_locking"]], "not_assembled"),
        ([CODE["slack"], CODE["overflow"], 0], "overflow"),
        ([CODE["no_derivative"], 0, 0], "no_derivative"),
    ]
    found = first_mark(np.array([c for c, _ in codes], np.uint8))
    assert [CODES[k] for k in found] == [status for _, status in codes]
    assert found.dtype == np.uint8


def test_numbers_that_are_none_have_a_status() -> None:
    code = np.array([[0, 0, CODE["jammed"]], [CODE["no_derivative"], 0, CODE["self_locking"]]], np.uint8)
    values = FORCE.copy()
    values[0, 1, 1], values[0, 2, 0], values[1, 2, 0] = np.inf, np.nan, np.nan
    rates = np.ones((2, 3, 2, 4))
    rates[1, 1, 0, 2], rates[0, 2, 1, 1], rates[0, 0, 1, 0] = np.inf, -np.inf, np.nan
    assert not_finite(code, {"F": values}).tolist() == [[False, True, True], [False, False, True]]
    assert not_finite(code, {"F": values, "G": EFFORT * [[1, 1, 1], [np.nan, 1, 1]]}).tolist() == [
        [False, True, True],
        [True, False, True],
    ]
    mark_overflow(code, {"F": values}, {"F": rates})
    assert [[CODES[k] for k in row] for row in code] == [
        ["no_derivative", "overflow", "jammed"],
        ["no_derivative", "no_derivative", "overflow"],
    ]
    assert np.isnan(rates[1, 1, 0, 2])
    assert np.isnan(rates[0, 2, 1, 1])
    assert np.isnan(rates).sum() == 3


def test_a_code_is_among_some() -> None:
    assert among(np.array([[3, 0], [5, 9]], np.uint8), (5, 3)).tolist() == [[True, False], [True, False]]


def test_problems_name_designs_by_their_worst_mark() -> None:
    code = [[0, CODE["reversal"], 0], [CODE["self_locking"], CODE["jammed"], 0]]
    b = batch({"effort.O2": EFFORT}, code=code)
    assert b.status[1].tolist() == ["self_locking", "jammed", "ok"]
    assert b.ok.tolist() == [[True, True, True], [False, False, True]]
    assert [(d, status) for d, status, _ in b.problems()] == [(1, "jammed")]
    reduced = batch({"effort.O2": EFFORT[:, 0]}, "peak", code=[CODE["no_derivative"], CODE["undecided"]])
    sentences = {status: why for _, status, why in reduced.problems()}
    assert sentences["undecided"] == (
        "The kernel cannot decide this design, and the fallback to the general executor is switched off."
    )
    failed = batch({"effort.O2": EFFORT[:, 0]}, "peak", code=[0, CODE["failed"]]).problems()
    assert failed == [(1, "failed", "The analysis of this design stopped with an error.")]


def test_sides_begin_with_the_numbers_before_and_are_blanked_where_unsolved() -> None:
    values, slopes, words = EFFORT.copy(), np.ones((2, 3, 1)), np.array([["a"] * 3] * 2)
    sides = Sides(np.zeros((2, 3), np.uint8), {"e": values, "w": words}, {"e": slopes})
    sides.open_after()
    sides.after["e"][0, 0] = 100.0
    assert values[0, 0] == 3.0
    sides.open_after()  # a second time they stay
    assert sides.after["e"][0, 0] == 100.0
    assert sides.after_rates["e"] is not slopes
    lost = np.array([[False, True, False], [False, False, True]])
    sides.blank(lost)
    for array in (values, sides.after["e"], slopes[..., 0], sides.after_rates["e"][..., 0]):
        assert np.isnan(array).tolist() == lost.tolist()
    for where in ("arrays", "rates"):
        some = Sides(sides.code, {"e": EFFORT.copy()}, {"e": np.ones((2, 3, 1))})
        assert some.finite
        getattr(some, where)["e"][1, 1] = np.inf
        assert not some.finite


def columns(b: BatchResult) -> dict[str, tuple[str, list[Any]]]:
    return {c.name: (c.kind, np.asarray(c.values).tolist()) for c in batch_columns(b)}


def test_columns_have_a_row_a_position_of_each_design() -> None:
    after = batch({"effort.O2": EFFORT + 1, "reaction.A": FORCE - 1})
    b = batch({"effort.O2": EFFORT, "reaction.A": FORCE}, after=after)
    found = columns(b)
    assert list(found) == [
        *("design", "position", "links.coupler.mass", "links.coupler.center.0", "links.coupler.center.1"),
        *("drive.O2", "status", "effort.O2", "reaction.A.x", "reaction.A.y"),
        *("after.effort.O2", "after.reaction.A.x", "after.reaction.A.y"),
    ]
    assert found["design"][1] == [1, 1, 1, 2, 2, 2]
    assert found["position"][1] == [1, 2, 3, 1, 2, 3]
    assert found["links.coupler.mass"] == ("mass", [0.6, 0.6, 0.6, 0.8, 0.8, 0.8])
    assert found["links.coupler.center.1"] == ("length", [0.02] * 3 + [0.03] * 3)
    assert found["drive.O2"] == ("angle", [0.0, 1.0, 2.0, 0.0, 1.0, 2.0])
    assert found["status"][1] == ["ok"] * 6
    assert found["effort.O2"] == ("moment", EFFORT.ravel().tolist())
    assert found["reaction.A.y"] == ("force", FORCE[..., 1].ravel().tolist())
    assert found["after.effort.O2"][1] == (EFFORT + 1).ravel().tolist()


def test_columns_of_reduced_answers_have_a_row_a_design() -> None:
    b = batch({"effort.O2": [[-5.0, 3.0], [-9.0, 7.0]]}, "envelope")
    found = columns(b)
    assert "position" not in found
    assert "drive.O2" not in found
    assert found["design"][1] == [1, 2]
    assert found["links.coupler.mass"][1] == [0.6, 0.8]
    assert found["effort.O2.least"] == ("moment", [-5.0, -9.0])
    assert found["effort.O2.greatest"] == ("moment", [3.0, 7.0])
    place = columns(batch({"effort.O2": [2.0, 1.0]}, "argpeak"))
    assert place["effort.O2"] == ("number", [2.0, 1.0])
    assert columns(batch({"what": [2.0, 1.0]}, "peak"))["what"] == ("number", [2.0, 1.0])


def test_labelled_arrays_have_axes_units_and_coordinates() -> None:
    b = batch({"effort.O2": EFFORT, "reaction.A": FORCE})
    data, names = batch_arrays(b, SI)
    assert data["status"][0] == ("design", "position")
    assert data["status"][1].tolist() == [["ok"] * 3] * 2
    over, values, unit = data["reaction.A"]
    assert (over, unit) == (("design", "position", "component"), {"units": "N"})
    assert values.tolist() == FORCE.tolist()
    assert data["effort.O2"][2] == {"units": "N*m"}
    assert names["design"].tolist() == [1, 2]
    assert names["position"].tolist() == [1, 2, 3]
    assert names["component"] == ["x", "y"]
    over, values, unit = names["links.coupler.center.0"]
    assert (over, values.tolist(), unit) == ("design", [0.1, 0.15], {"units": "m"})
    over, values, unit = names["drive_O2"]
    assert (over, values.tolist(), unit) == ("position", [0.0, 1.0, 2.0], {"units": "rad"})
    data, names = batch_arrays(batch({"effort.O2": [[-5.0, 3.0], [-9.0, 7.0]]}, "envelope"), SI)
    assert data["effort.O2"][0] == ("design", "end")
    assert data["status"][0] == ("design",)
    assert not {"component", "position", "drive_O2"} & set(names)


def test_printed_are_least_and_greatest_and_the_first_problems() -> None:
    code = [[0, 0, CODE["jammed"]], [0, 0, 0]]
    values = np.where([[False, False, True], [False] * 3], np.nan, EFFORT)
    b = batch({"effort.O2": values}, code=code, mechanism=machine(length="mm"))
    head, table, *sentences = batch_parts(b, "file")
    assert head == repr(b).strip("<>")
    assert isinstance(table, TextTable)
    rows = {row[0]: row[1:] for row in table.rows}
    assert rows["effort.O2 [N*mm]"] == ["-9000", "7000"]
    assert rows["links.coupler.center.0 [mm]"] == ["100", "150"]
    assert len(sentences) == 1
    assert str(sentences[0]).startswith("jammed: design 1: ")
    _, in_si, *_ = batch_parts(b, "SI")
    assert isinstance(in_si, TextTable)
    assert ["effort.O2 [N*m]", "-9", "7"] in in_si.rows
    many = np.full((12, 3), CODE["jammed"], np.uint8)
    kernel = b.kernel
    lost = BatchResult(
        kernel, np.ones((12, 3)), b.positions, many, {"effort.O2": np.full((12, 3), np.nan)}, {}
    )
    assert len(list(batch_parts(lost, "SI"))) == 2 + MOST_SAID
    assert math.isfinite(float(rows["effort.O2 [N*mm]"][0]))
