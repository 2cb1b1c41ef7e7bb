"""Outputs that designers ask for: expressions, transmission angles, shaking forces; beside `da.dynamics`, by name."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.over_positions import reduce_sides
from dalembert.analysis.result.named_quantities import quantity
from dalembert.bundled import examples
from tests.kernel.machines import four_bar
from tests.kernel.test_derivatives import checked
from tests.model.parts import FOUR_BAR

PLANE = [
    "reaction.O2.x + reaction.O4.x",
    "max(abs(effort.O2), 3)",
    "transmission.B",
    "-min(transmission.B, 50 deg)",
    "shaking_force",
    "shaking_moment",
    "shaking_moment.O4",
    "atan2(shaking_force.y, shaking_force.x)",
    "power.O2",
    "reaction.A.magnitude^2 - 2*reaction.B.magnitude",
    "effort.O2^0 + 3*effort.O2^-2 - reaction.A.magnitude^1.5",
    "effort.O2^16 + effort.O2^-16",
]


def agree(m: Any, outputs: list[str]) -> None:
    r, g = da.compile(m, outputs=outputs)(), da.dynamics(m)
    for name in outputs:
        wanted = g[name]
        assert np.abs(r.value(name)[0] - wanted).max() <= 1e-10 * max(np.abs(wanted).max(), 1e-3), name


def test_expressions_are_those_of_a_result() -> None:
    agree(da.four_bar(), PLANE)
    agree(da.load(examples()["engine"]), ["shaking_force", "shaking_moment", "power.O2"])  # a load by: ground
    agree(da.rssr(), ["shaking_force", "shaking_moment.z"])


def test_expressions_of_parameters_and_comparisons() -> None:
    m = da.load(examples()["pump"])
    outputs = [
        "effort.O/stroke",
        "reaction.O.x - 2*pressure*area",
        "reaction.O.x*(effort.O > 1 N*m)",
        "max(1 N, reaction.O.x, reaction.O.y)",
        "reaction.O.direction",
    ]
    agree(m, outputs)
    value = 1.1 * m.parameters["stroke"].value
    longer = da.dynamics(m.with_values({"stroke": value}))
    r = da.compile(m, ["stroke"], outputs)(np.array([[value]]))
    for name in outputs:
        np.testing.assert_allclose(r.value(name)[0], longer[name], rtol=1e-9, atol=1e-7, err_msg=name)
    assert [quantity(longer, name).kind for name in outputs] == ["number", "force", "force", "force", "angle"]
    assert quantity(longer, "3 N*slide.cylinder").kind == "number"
    assert np.array_equal(longer["reaction.O.x*(effort.O > 1 N*m)"] != 0, longer["effort.O"] > 1)
    for text, what in (
        ("effort.O + stroke", "effort.O is a moment, and stroke is a length"),
        ("3*(effort.O > 3 kg)", "effort.O is a moment, and 3 kg is a mass"),
    ):
        with pytest.raises(da.ModelError, match=what):
            longer[text]


@pytest.mark.parametrize("more", ["outside: zero", "outside: hold", "outside: zero, interpolate: cubic, shift: 5",
                                  "outside: zero, times: -2", "periodic: true, shift: 20"])  # fmt: skip
def test_a_table_is_compiled_within_its_points_and_outside(more: str) -> None:
    table = f"{{against: O2, x: [0, 60, 90], y: [1, 5, 2], {more}}}"
    text = FOUR_BAR.replace("value: 120}", f"value: {table}}}").replace(
        "position: 60 deg, speed: 25 rad/s, acceleration: -40 rad/s^2",
        "position: [-60, -10, 3, 30, 89, 100], speed: 1 rad/s",
    )
    m = da.loads(text)
    agree(m, ["effort.O2", "reaction.B.x"])


def test_derivatives_of_expressions() -> None:
    outputs = [
        "max(abs(effort.O2), 6)/transmission.B",
        "shaking_moment.O4",
        "shaking_force.magnitude",
        "power.O2",
    ]
    checked(four_bar(6), outputs, tolerance=1e-6)


def test_general_executor_answers_the_same_names() -> None:
    parallel = {"ground": 0.3, "crank": 0.1, "coupler": 0.3, "rocker": 0.1}
    m = da.four_bar(**parallel)
    r, g = da.compile(m, outputs=PLANE)(), da.dynamics(m, method="careful")
    assert r.redone == 1
    for name in PLANE:
        ok = r.ok[0]
        assert np.allclose(r.value(name)[0][ok], g[name][ok], rtol=1e-8, atol=1e-8), name


def test_asked_loads_shake() -> None:
    text = examples()["four_bar"].read_text(encoding="utf-8")
    text = text.replace("value: 80 @ 330", "direction: 330, value: unknown").replace(
        "60 deg,", "60 deg, effort: 3,"
    )
    agree(da.loads(text), ["shaking_force", "shaking_moment"])


def test_a_plane_that_turns_shakes_by_what_pulls_outward_too() -> None:
    tree = da.four_bar().to_tree() | {"turning": {"speed": "30 rad/s"}}
    agree(da.mechanism(tree), ["shaking_force", "shaking_moment"])


def test_transmission_angle_by_hand() -> None:
    r = da.kinematics(da.four_bar())
    a, b, o4 = r.point("coupler", "A"), r.point("coupler", "B"), r.point("rocker", "O4")
    u, v = a - b, o4 - b
    cosine = np.abs((u * v).sum(axis=1)) / np.linalg.norm(u, axis=1) / np.linalg.norm(v, axis=1)
    assert np.allclose(r["transmission.B"], np.arccos(cosine), atol=1e-12)
    slide = da.kinematics(da.slider_crank(crank=0.05, rod=0.2))
    rod = slide.point("rod", "B") - slide.point("rod", "A")
    assert np.allclose(slide["transmission.B"], np.arccos(np.abs(rod[:, 1]) / 0.2), atol=1e-7)


def test_names_with_signs_and_links_with_several_joints() -> None:
    text = examples()["four_bar"].read_text(encoding="utf-8").replace("O4", "O-4")
    m = da.loads(text)
    r = da.dynamics(m)
    name = "2*reaction.O-4.x-4"
    assert np.array_equal(r[name], 2 * r.reaction("O-4")[:, 0] - 4)
    assert np.allclose(da.compile(m, outputs=[name])().value(name)[0], r[name])
    watt = da.watt_1()
    several = [n for n in da.compile(watt).trace.catalogue.names if n.count(".") == 3 and "trans" in n]
    agree(watt, several)


@pytest.mark.parametrize(
    ("output", "message"),
    [
        ("efort.O2 + 1", "unknown output 'efort.O2'; did you mean 'effort.O2'?"),
        ("reaction.A + 3", "write reaction.A.x or reaction.A.magnitude"),
        ("effort.O2 +", "it is incomplete"),
        ("foo(effort.O2)", "unknown function 'foo'"),
        ("effort.O2 effort.O2", "'effort.O2 effort.O2': unexpected 'effort.O2' at the end"),
        ("transmission.O2", "unknown output 'transmission.O2'; did you mean 'transmission.B'?"),
        ("effort.O2 + 3 bananas", "bananas"),
    ],
)
def test_wrong_expressions(output: str, message: str) -> None:
    with pytest.raises(da.ModelError, match=re.escape(message)):
        da.compile(da.four_bar(), outputs=[output])


def test_peaks_between_positions() -> None:
    few, many = (da.four_bar(positions=n) for n in (24, 2400))
    true = np.abs(da.dynamics(many)["effort.O2"])
    for reduce, wanted in (("refined_peak", true.max()), ("refined_place", true.argmax() / 100)):
        k = da.compile(few, outputs=["effort.O2", "reaction.A"], reduce=reduce)
        r = k()
        assert r.value("effort.O2")[0] == pytest.approx(wanted, rel=5e-3)
        with pytest.raises(da.ModelError, match="not evenly spaced"):
            k(positions=[0.0, 0.1, 0.3, 0.4])
    open_ = np.linspace(0.0, 1.0, 5)
    values = (open_ - 0.9) ** 2 + 1  # largest at the first position, which has no neighbour
    assert reduce_sides("refined_peak", [values]) == values[0]
    wave = np.cos(2 * np.pi * np.arange(48) / 48 - 0.05) * 3
    assert reduce_sides("refined_place", [wave], cycle=True) == pytest.approx(0.05 * 48 / 2 / np.pi, abs=2e-3)


def test_share_of_the_cycle_above_a_limit() -> None:
    m = da.four_bar()
    share = da.compile(m, outputs=["(1 + sign(reaction.B.magnitude - 30 N))/2"], reduce="mean")
    wanted = (da.dynamics(m)["reaction.B.magnitude"] > 30).mean()
    assert share().value(share.outputs[0])[0] == pytest.approx(wanted)


def test_squares_to_a_target() -> None:
    """Of vectors by component, with exact derivatives; a target of another shape or kernel is refused."""
    vary, outputs = ["links.crank.points.A", "links.coupler.mass"], ["point.coupler.B", "effort.O2"]
    k, plain = (da.compile(da.four_bar(), vary, outputs, how, derivatives=True) for how in ("squares", None))
    values = k.nominal * np.array([[1, 1, 1], [1.05, 1, 2], [0.9, 1.1, 0.3]])
    each = plain(values)
    target = {name: 1.3 * each.value(name)[0] for name in outputs}
    found = k(values, target=target)
    blocks = [r.value("effort.O2")[0] for r in k.blocks(values, 1, target=target)]
    assert np.array_equal(found.value("effort.O2"), blocks)
    for name in outputs:
        off = each.value(name) - target[name]
        slope = 2 * (off[..., None] * each.gradient(name)).sum(axis=1)
        assert np.allclose(found.value(name), (off**2).sum(axis=1), rtol=1e-13)
        assert np.allclose(found.gradient(name), slope, rtol=1e-12, atol=1e-14 * np.abs(slope).max())
    assert np.allclose(k(values).value("effort.O2"), (each.value("effort.O2") ** 2).sum(axis=1), rtol=1e-13)
    short = target | {"effort.O2": np.zeros(71)}
    nowhere = target | {"effort.O2": np.full(72, np.nan)}
    for wrong, said in (
        (short, r"target= of effort.O2 has shape \(71,\); give one of shape \(72,\)"),
        (nowhere, "targets of effort.O2 are not all finite; leave those positions out: positions="),
        (
            {"effort.O2": np.zeros(72)},
            "target= is for effort.O2, and there are outputs point.coupler.B, effort.O2",
        ),
    ):
        with pytest.raises(da.ModelError, match=said):
            k(values, target=wrong)
    with pytest.raises(
        da.ModelError, match='only squares are taken to a target; compile with reduce="squares"'
    ):
        plain(values, target=target)
