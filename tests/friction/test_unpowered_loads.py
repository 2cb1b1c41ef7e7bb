"""Unknown loads without power: the friction that they cause balances a given effort."""

from pathlib import Path

import numpy as np
import pytest

import dalembert as da

MODELS = Path(__file__).parents[1] / "machine" / "models"
BRAKE = (MODELS / "block-brake-with-a-short-shoe.yaml").read_text(encoding="utf-8").split("answers:")[0]


def brake(coefficient: float, effort: float, speed: float = 10) -> da.Mechanism:
    """The drum's effort given, the lever's load unknown."""
    text = BRAKE.replace("value: [0, -700]", "direction: -90, value: unknown")
    text = text.replace("speed: 10 rad/s", f"speed: {speed} rad/s, effort: {effort!r} N*m")
    return da.loads(text.replace("coefficient: 0.385", f"coefficient: {coefficient}"))


def load_for(coefficient: float, effort: float, sense: int = 1) -> float:
    """P l = N (b - mu c) with D = mu N R; N < 0 where the shoe is pulled."""
    return effort / (coefficient * 0.125) * (sense * 0.2 - coefficient * 0.05) / 0.45


@pytest.mark.parametrize("coefficient", [1e-3, 0.385, 3.9])
def test_a_brake_is_pressed_by_the_load_that_gives_its_torque(coefficient: float) -> None:
    r = da.solve(brake(coefficient, 83.86929460580913))
    assert r.status == ("ok",)
    assert r["load.P"][0] == pytest.approx(load_for(coefficient, 83.86929460580913), rel=1e-12)
    assert max(r.residual[0], r.power_balance[0]) < 1e-15
    assert not r.friction.single[0]  # the slot may bear on its other side


def test_the_torque_of_the_given_file_takes_700_newtons() -> None:
    assert da.solve(brake(0.385, 83.86929460580913))["load.P"][0] == pytest.approx(700, rel=1e-13)


def test_a_brake_that_draws_its_shoe_on_by_itself_is_pulled_the_other_way() -> None:
    """From a coefficient of 4 on no load in its direction lets the drum turn."""
    assert da.solve(brake(4.5, 83))["load.P"][0] == pytest.approx(load_for(4.5, 83, -1), rel=1e-12)


@pytest.mark.parametrize(
    ("coefficient", "effort", "speed", "why"),
    [
        (0.385, -83, 10, ", and the friction that it causes does not balance it either"),
        (0.0, 83, 10, ", and the friction that it causes does not balance it either"),
        (0.385, 83, 0, ", and friction at rest may have any value within its limits. Give the drive a speed"),
    ],
)
def test_efforts_that_friction_cannot_balance(
    coefficient: float, effort: float, speed: float, why: str
) -> None:
    r = da.solve(brake(coefficient, effort, speed))
    said = f"The unknown P cannot balance the given effort of D: it has no power here{why}."
    assert (r.status, r.reasons) == (("no_balance",), (said,))
    assert np.isnan(r["load.P"]).all()


def test_a_kernel_gives_the_same_load() -> None:
    pytest.importorskip("llvmlite")
    k = da.compile(brake(0.385, 83), vary=["joints.S.friction.coefficient"], outputs=["load.P"])
    found = k([[0.2], [0.385], [3.0]])
    assert found.ok.all()
    expected = [load_for(mu, 83) for mu in (0.2, 0.385, 3.0)]
    assert found.value("load.P")[:, 0] == pytest.approx(expected, rel=1e-12)


def test_there_is_no_iteration_to_show_without_an_answer_without_friction() -> None:
    with pytest.raises(da.ModelError, match="P: only friction balances the given effort"):
        da.fixed_point(da.solve(brake(0.385, 83)))


CASES = Path(__file__).parents[2] / "cases"


@pytest.mark.parametrize(
    ("file", "load", "drive"),
    [
        (CASES / "seed-001-da-guide-lower-face.yaml", "N", "guide"),
        (CASES / "seed-001-db-guide-upper-face.yaml", "N", "guide"),
        (MODELS / "clu-1-collar-thrust-bearing.yaml", "thrust", "O"),
    ],
)
def test_the_load_that_gives_an_effort_is_the_load_that_gave_it(file: Path, load: str, drive: str) -> None:
    """Solved forwards with the load known, then backwards with the effort given."""
    m = da.load(file)
    r = da.solve(m, positions=1)
    value = np.array(m.loads[load].value)
    size = float(np.linalg.norm(value))
    way = float(np.arctan2(value[1], value[0])) if m.dimension == 2 else tuple(map(float, value / size))
    unknown = m.loads[load].model_copy(update={"value": "unknown", "direction": way})
    back = m.model_copy(update={"loads": {**m.loads, load: unknown}})
    found = da.solve(back.with_values({f"drives.{drive}.effort": float(r.effort(drive)[0])}), positions=1)
    assert found.status == ("ok",)
    assert found[f"load.{load}"][0] == pytest.approx(size, rel=1e-12)
