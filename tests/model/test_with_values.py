"""Other values of the same mechanism, by path."""

from __future__ import annotations

import pytest

from dalembert.errors import ModelError
from dalembert.model import ForceLoad, loads
from dalembert.model.library import rssr
from tests.model.parts import FOUR_BAR

M = loads(FOUR_BAR, name="four.yaml")


def test_a_value_is_replaced_and_nothing_else() -> None:
    other = M.with_values({"links.crank.inertia": 2.0})
    assert other.inertia("crank") == 2.0
    assert other != M
    assert other.with_values({"links.crank.inertia": M.inertia("crank")}) == M
    assert other.source is M.source


def test_deep_values_numbers_in_si_texts_with_units() -> None:
    other = M.with_values(
        {
            "links.crank.points.A": [0.1, "2 in"],
            "links.rocker.center.0": 0.2,
            "drives.O2.position": 1.0,
            "loads.F_P.direction": "90 deg",
            "assembly.coupler": 0.3,
            "gravity": "standard",
            "title": "other",
            "source": "nobody",
            "joints.A.damping": 0.5,
        }
    )
    assert other.points("crank")["A"] == (0.1, 0.0508)
    assert other.center("rocker") == (0.2, 0.0)
    assert other.schedule().position.tolist() == [[1.0]]
    load = other.loads["F_P"]
    assert isinstance(load, ForceLoad)
    assert load.force({})[0] == 0.0
    assert other.assembly["coupler"] == 0.3
    assert other.gravity_vector == (0.0, -9.80665)
    assert (other.title, other.source_text) == ("other", "nobody")
    assert other.joints["A"].damping == 0.5  # type: ignore[union-attr]


def test_a_mass_takes_the_place_of_a_weight() -> None:
    other = M.with_values({"links.crank.mass": 2.0})
    assert other.mass("crank") == 2.0
    assert other.links["crank"].weight is None


@pytest.mark.parametrize(
    ("path", "value", "says"),
    [
        ("links.crnk.mass", 1, "path 'links.crnk': 'crnk' does not exist in links; did you mean 'crank'?"),
        (
            "links.crank.mas",
            1,
            "path 'links.crank.mas': 'mas' does not exist in links.crank; did you mean 'mass'?",
        ),
        ("lnks", 1, "path 'lnks': 'lnks' does not exist; did you mean 'links'?"),
        (
            "links.crank.mass.kg",
            1,
            "the path 'links.crank.mass.kg' goes into a single value; leave out its end",
        ),
        (
            "links.crank.center.2",
            1,
            "path 'links.crank.center.2': '2' does not exist in links.crank.center; choose among 0, 1",
        ),
        (
            "links.crank.mass",
            "3 N",
            "links.crank: mass: '3 N' is a force, but a mass is needed; write one, for example '1.5 kg'",
        ),
        (
            "joints.A.links",
            ["crank", "bar"],
            "joint 'A' names the link 'bar', which does not exist; choose among ground, crank, coupler, rocker",
        ),
    ],
)
def test_a_wrong_path_or_value(path: str, value: object, says: str) -> None:
    with pytest.raises(ModelError) as caught:
        M.with_values({path: value})
    assert str(caught.value) == says


def test_keys_of_a_joint_that_has_no_damping() -> None:
    """A ball has no damping to be replaced with the rest of it."""
    m = rssr().with_values({"joints.A.friction": {"coefficient": 0.1, "radius": 0.01}})
    friction = m.joints["A"].friction
    assert (friction.coefficient, friction.radius) == (0.1, 0.01)
    with pytest.raises(ModelError, match="no freedom about one axis to damp"):
        m.with_values({"joints.A.damping": 0.2})
