"""Shaking forces and harmonics: the rate of momentum, reactions, closed forms, books."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.output.rounding import sizes
from dalembert.answer.column import Scale
from dalembert.bundled import examples
from dalembert.cli import main
from dalembert.errors import ModelError
from tests.machine.closed_forms import crank_points, shaking_of, turn
from tests.random_mechanisms import random_case
from tests.random_space import random_case as random_in_space
from tests.random_space import tree as tree_in_space
from tests.tiers import over

STEP = 1e-4
"""Time either side at which momentum is taken, times the time scale of the motion."""


def momentum(r: Any, point: Any) -> Any:
    """Linear and angular momentum about a fixed point (P, d + 1 or 2 d) from velocities alone."""
    m, d = r.mechanism, r.mechanism.dimension
    total = np.zeros((len(r.status), d + (1 if d == 2 else 3)))
    for link in r.links:
        p = m.mass(link) * r.center_velocity(link)
        arm = r.center(link) - point
        spin = r.speed(link)
        if d == 2:
            angular = arm[:, 0] * p[:, 1] - arm[:, 1] * p[:, 0] + m.inertia(link) * spin
            total += np.column_stack([p, angular])
        else:
            own = np.array(m.inertia(link), float)
            own = own if own.ndim == 2 else np.diag(np.broadcast_to(own, 3))
            turned = r.rotation(link) @ own @ np.swapaxes(r.rotation(link), 1, 2)
            total += np.column_stack([p, np.cross(arm, p) + np.einsum("pij,pj->pi", turned, spin)])
    return total


def around(m: Any) -> tuple[Any, float]:
    """The motion at five instants about the first position, the drives' accelerations kept."""
    schedule = m.schedule()
    q, u, a = (x[0] for x in (schedule.position, schedule.speed, schedule.acceleration))
    h = STEP / max(1.0, float(np.abs(u).max()), float(np.sqrt(np.abs(a)).max()))
    t = h * np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
    values = {}
    for k, name in enumerate(schedule.names):
        values[f"drives.{name}.position"] = [float(x) for x in q[k] + u[k] * t + a[k] * t**2 / 2]
        values[f"drives.{name}.speed"] = [float(x) for x in u[k] + a[k] * t]
        values[f"drives.{name}.acceleration"] = [float(a[k])] * 5
    return da.dynamics(m.with_values(values)), h


def check_rate_of_momentum(m: Any) -> None:
    r, h = around(m)
    assert np.isfinite(r.twist_array).all(), r.problems()
    point = np.full(m.dimension, 0.3)
    s = da.shaking(r, about=point)
    p = momentum(r, point)
    rate = (p[0] - 8 * p[1] + 8 * p[3] - p[4]) / (12 * h)
    force, moment = s.parts["inertia"]
    found = np.concatenate([force[2], np.atleast_1d(moment[2])])
    length = r.compiled.layout.length
    scale = np.concatenate([np.ones(m.dimension), np.full(len(rate) - m.dimension, 1 / length)])
    size = max(float(np.abs(found * scale).max()), float(np.abs(p * scale).max()) / h * 1e-7)
    assert np.abs((found + rate) * scale).max() <= 1e-6 * size  # both are 0 where nothing that moves has mass
    assert np.nanmax(s.residual) < 1e-9
    total = sum(part[0] for part in s.parts.values())
    assert np.allclose(s.force, total, rtol=0, atol=1e-12 * (1 + np.abs(total).max()))


@over(2, 200)
def test_the_shaking_force_is_minus_the_rate_of_momentum(seed: int) -> None:
    check_rate_of_momentum(da.mechanism(random_case(seed).tree))


@over(1, 200)
def test_the_same_in_space(seed: int) -> None:
    check_rate_of_momentum(da.mechanism(tree_in_space(random_in_space(seed))))


def test_chosen_links_add_up_to_the_machine() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]))
    whole = da.shaking(r, about=(0.1, 0.2))
    some = [da.shaking(r, about=(0.1, 0.2), links=[link]) for link in r.links]
    assert np.allclose(sum(s.force for s in some), whole.force)
    assert np.allclose(sum(s.moment for s in some), whole.moment)
    assert all(s.residual.max() < 1e-12 for s in some)


def test_what_counts_as_rounding_is_a_part_of_the_largest_force_and_of_its_moment() -> None:
    """Of a moment at the length of the mechanism, here 0.31 m."""
    s = da.shaking(da.dynamics(da.load(examples()["four_bar"])))
    largest = max(s.largest, sizes(s.result)["force"].max())
    assert s.floor("force") == pytest.approx(1e-12 * largest, rel=1e-12)
    assert s.floor("moment") == pytest.approx(s.floor("force") * s.result.compiled.layout.length, rel=1e-12)
    assert s.floor("moment") < 0.7 * s.floor("force")


def test_a_slider_crank_is_that_of_its_closed_form() -> None:
    m = da.slider_crank(crank=0.05, rod=0.2)
    values = {"links.rod.mass": 0.6, "links.rod.center": [0.06, 0.0], "drives.O2.speed": 300.0}
    drive = next(iter(m.drives))
    values = {k.replace("O2", drive): v for k, v in values.items()}
    m = m.with_values(values)
    r = da.dynamics(m, positions=64)
    q = r.drive_position(drive)
    assert np.allclose(q - q[0], turn(64))
    fine = turn() + q[0]
    pin, piston = crank_points(fine, 0.05, 0.2)
    on = {"rod": 0.7 * pin + 0.3 * piston, "piston": piston}
    crank = np.array(m.center("crank"))
    on["crank"] = np.hypot(*crank) * np.stack([np.cos(fine), np.sin(fine)], -1)
    expected = shaking_of([(m.mass(link), path) for link, path in on.items()], 300.0)[:: len(fine) // 64]
    found = da.shaking(r).parts["inertia"][0]
    assert np.abs(found - expected).max() < 1e-9 * np.abs(expected).max()


def test_harmonics_of_a_sum_of_waves() -> None:
    q = turn(24)
    y = np.stack([2 + np.cos(3 * q - 0.4), 5 * np.sin(q)], -1)
    found = da.harmonics(y, q, orders=3)
    assert np.allclose(found.amplitude, [[2, 0], [0, 5], [0, 0], [1, 0]], atol=1e-13)
    assert found.phase[3, 0] == pytest.approx(0.4)
    assert found.aliasing < 1e-13
    waves = np.exp(1j * np.outer(found.order, q))
    z = (found.forward[:, None] * waves + found.backward[:, None] * np.conj(waves)).sum(0)
    assert np.allclose(z, y[:, 0] + 1j * y[:, 1])
    assert da.harmonics(np.cos(11 * q), q, orders=[1]).aliasing == pytest.approx(1.0)  # 11 of 12 looks like 1


def test_periods_of_two_turns_have_half_orders() -> None:
    q = 2 * turn(48)
    assert da.harmonics(np.cos(1.5 * q), q, orders=[1, 1.5]).amplitude == pytest.approx([0, 1])
    r = da.dynamics(da.load(examples()["engine"]))
    by_name = r.harmonics("shaking_force", orders=2)
    assert by_name.order.tolist() == [0, 0.5, 1, 1.5, 2]
    assert np.allclose(by_name.amplitude, da.shaking(r).harmonics(2).amplitude)
    assert np.allclose(r.harmonics("reaction.A", 1).amplitude[:, 0], r.harmonics("reaction.A.x", 1).amplitude)


WRONG = [
    (np.array([0, 1, 3.0]), 1, "the positions are not even: steps of 57.3 to 114.6 deg"),
    (turn(8) / 3, 1, "the positions cover 120 deg, which is not a whole number of turns"),
    (turn(8), 4, "order 4 needs more than 8 positions, and there are 8"),
    (
        turn(8),
        [0.5],
        r"a period of 1 turn has no harmonic of each order in \[0.5\]; its orders are integers",
    ),
    (
        2 * turn(16),
        [0.5, 0.25],
        r"a period of 2 turns has no harmonic of each order in \[0.5, 0.25\]; its orders are multiples of 1/2",
    ),
    (turn(2), 1, "a period needs at least 3 positions, all of them solved"),
]


@pytest.mark.parametrize(("angle", "orders", "sentence"), WRONG)
def test_what_is_no_period_is_refused(angle: Any, orders: Any, sentence: str) -> None:
    with pytest.raises(ModelError, match=sentence):
        da.harmonics(np.cos(angle), angle, orders)
    with pytest.raises(ModelError, match="position 2 has no value"):
        da.harmonics([1.0, np.nan, 1.0, 0.0], turn(4), 1)


def test_what_slides_has_no_harmonics() -> None:
    r = da.dynamics(da.load(examples()["scissor_lift"]))
    with pytest.raises(ModelError, match="and base_roller slides"):
        r.harmonics("shaking_force")
    with pytest.raises(ModelError, match="unknown quantity 'shaken'"):
        da.dynamics(da.load(examples()["engine"])).harmonics("shaken")


GAS = """
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [0.1, 0]}, mass: 1}
joints:
  O: {type: pin, links: [ground, crank]}
drives:
  O: {position: 0, speed: 3 rad/s}
loads:
  F: {type: force, on: crank, at: A, value: [0, 5]}
"""


def test_what_the_ground_exerts_is_no_part_of_it() -> None:
    whole = da.shaking(da.dynamics(da.loads(GAS)))
    inside = da.shaking(da.dynamics(da.loads(GAS.replace("[0, 5]}", "[0, 5], by: ground}"))))
    driven = da.shaking(da.dynamics(da.loads(GAS.replace("rad/s}", "rad/s, by: outside}"))))
    found = [(s.force.tolist(), s.moment.tolist()) for s in (whole, inside, driven)]
    assert found == [([[0, 5]], [0.5]), ([[0, 0]], [0.0]), ([[0, 5]], [0.0])]
    assert max(s.residual.max() for s in (whole, inside, driven)) < 1e-15
    with pytest.raises(ModelError, match="by the ground or from outside, not by 'crank'"):
        da.loads(GAS.replace("[0, 5]}", "[0, 5], by: crank}"))
    with pytest.raises(ModelError, match="'P' is neither a joint with the ground nor a point"):
        da.shaking(da.dynamics(da.loads(GAS)), about="P")


def test_the_command_prints_and_writes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = str(examples()["engine"])
    table, record = tmp_path / "t.csv", tmp_path / "r.json"
    assert (
        main(
            [
                "shake",
                file,
                "--about",
                "[0, 100]",
                "--csv",
                str(table),
                "--json",
                str(record),
                "--units",
                "file",
            ]
        )
        == 0
    )
    said = capsys.readouterr().out
    assert "moment about (0, 0.1) m" in said
    assert "Computed from momentum; the sum of the reactions agrees" in said
    rows = list(csv.DictReader(table.read_text().splitlines()))
    read = json.loads(record.read_text())
    s = da.shaking(da.dynamics(da.load(file)), about=(0, 0.1))
    assert [float(row["shaking_moment [N*mm]"]) for row in rows[:3]] == pytest.approx(1e3 * s.moment[:3])
    assert read["positions"][1]["shaking_force.x"] == pytest.approx(s.force[1, 0])
    assert read["shaking"]["point"] == [0, 100]
    assert main(["shake", file, "--csv", str(table)]) == 2
    assert "exists" in capsys.readouterr().err


@pytest.mark.parametrize("command", ["shake", "solve"])
def test_files_are_written_though_nobody_reads_what_is_printed(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As in `dalembert shake FILE --csv x.csv | head -1`."""

    class Closed(io.StringIO):
        def write(self, text: str) -> int:
            raise BrokenPipeError

    monkeypatch.setattr("sys.stdout", Closed())
    monkeypatch.setattr("dalembert.cli._let_go", lambda: None)
    path = tmp_path / "x.csv"
    assert main([command, str(examples()["four_bar"]), "--csv", str(path)]) == 0
    assert path.read_text().startswith("position")


def test_its_drawing_has_the_numbers_and_its_report_the_sums() -> None:
    r = da.dynamics(da.load(examples()["engine"]))
    s = da.shaking(r)
    scene = da.draw.machine(s)
    words = {text.text for text in scene.texts()}
    assert {"Shaking moment about O2", "Harmonics of the force", "order"} <= words
    said = str(da.report(s))
    assert "Moments are about O2. Worked out at position 1 of 720" in said
    assert "F_sx = −Σ m_i a_i = 5503 = 5503 N" in said


def test_external_loads_are_named_and_those_by_the_ground_are_not() -> None:
    """Of the bundled shaper the cutting force is most of the shaking force; gas on a head is none of it."""
    r = da.dynamics(da.load(examples()["quick_return"]))
    s = da.shaking(r)
    assert s.outside == ("cutting",)
    record: Any = s.record(Scale(None))
    assert record["shaking"]["outside"] == ("cutting",)
    assert {"external_force.x", "external_moment"} <= {c.name for c in s.columns()}
    said = " ".join(str(s).split())
    assert "External: cutting. A load is external unless `by: ground` says that" in said
    assert "changes the amplitudes by at most 1e+01 N" in said
    gas = da.shaking(da.dynamics(da.in_line_engine(firing_order=(1, 2, 4, 3), gas=1e4), positions=24))
    assert gas.outside == ()
    assert "External:" not in str(gas)
    still = r.mechanism.with_values({"loads.cutting.value": [0.0, 0.0], "loads.cutting.direction": None})
    assert da.shaking(da.dynamics(still)).outside == ()  # a load of 0 is none


def test_a_machine_at_rest_without_loads_exerts_nothing() -> None:
    m = da.four_bar().with_values({"gravity": None, "loads": {}, "drives.O2.speed": 0.0})
    assert "Force and moment on the ground are zero." in str(da.shaking(da.dynamics(m, positions=12)))
    one = da.shaking(da.dynamics(m, positions=12), links=["crank"])
    assert "Force and moment on everything else are zero." in str(one)


def test_its_drawing_in_space_has_three_components_of_force_and_moment() -> None:
    s = da.shaking(da.dynamics(da.rssr()))
    words = [text.text for text in da.draw.machine(s).texts()]
    about = f"Shaking moment about {s.about}"
    assert {"Shaking force on the ground", about, "Harmonics of the force"} <= set(words)
    assert s.moment.shape == (72, 3)
    assert sum(w in ("x", "y", "z") for w in words) >= 6


def test_a_load_that_is_rounding_beside_the_forces_of_the_cycle_is_none() -> None:
    """Below 1e-12 of the largest single force, whatever the length of the machine; and so it is printed as 0."""
    m = da.slider_crank(crank=0.02, rod=0.06)
    largest = 2000.0
    for size, outside in ((1.1e-12 * largest, ("load", "more")), (0.9e-12 * largest, ("load",))):
        more = {"type": "force", "on": "piston", "at": "B", "value": [size, 0]}
        tree = m.to_tree()
        tree["loads"] = {"load": {**tree["loads"]["load"], "value": [-largest, 0]}, "more": more}
        tree["drives"]["O2"]["speed"] = "1 rad/s"
        assert da.shaking(da.dynamics(da.mechanism(tree), positions=12)).outside == outside
