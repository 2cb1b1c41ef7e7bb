"""What friction cannot be asked for, word for word."""

from __future__ import annotations

import pytest

import dalembert as da
from tests.friction.engines import engine


def test_equilibrium_positions() -> None:
    m = engine(drives={"O": {"position": "unknown", "effort": 100}})
    with pytest.raises(da.ModelError) as caught:
        da.statics(m)
    assert str(caught.value) == (
        "an unknown position with friction is not unique: every position of an arc is an equilibrium; "
        "switch friction off, or give the positions and compute the interval of efforts"
    )


def test_superposition() -> None:
    with pytest.raises(da.ModelError) as caught:
        da.superposition(da.statics(engine()))
    assert str(caught.value) == (
        "superposition is refused: with dry friction the forces do not add, because it depends on |F|; "
        "leave friction out with --no-friction, or use --method matrix"
    )


def test_teeth_whose_contact_is_not_known() -> None:
    with pytest.raises(da.ModelError) as caught:
        da.Gear(links=("a", "b"), radii=(0.1, 0.2), friction={"coefficient": 0.1})
    assert (
        "its friction needs the arm of the teeth's contact; give arm, or the size as teeth and module"
        in str(caught.value)
    )


def test_friction_of_a_redundant_mechanism() -> None:
    """Two sliders carry a table: how the load shares itself between them is not statics, and friction follows it."""
    rail = {"type": "slider", "links": ["ground", "table"], "friction": {"coefficient": 0.1}}
    m = da.mechanism(
        {
            "links": {
                "ground": {"points": {"A": [0, 0], "B": [1, 0]}},
                "table": {"points": {"A": [0, 0], "B": [1, 0]}},
            },
            "joints": {"A": rail, "B": rail},
            "drives": {"A": {"position": 0.2, "speed": 1}},
            "loads": {"F": {"type": "force", "on": "table", "at": "A", "value": [0, -10]}},
        }
    )
    r = da.statics(m)
    assert r.status == ("redundant",)
    assert r.reasons[0] == (
        "Friction follows reactions that statics does not determine here: constraints are redundant. "
        "Free a constraint, give the joints a stiffness, or switch friction off."
    )
    assert r.effort("A")[0] != r.effort("A")[0]
