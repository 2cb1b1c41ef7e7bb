"""Work over a list of positions, against works known in closed form: a shaft that rubs in its bearing.

Its circle of friction has R sin(phi), so the couple it loses is that times F, and the work the integral over the turn.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da

ARM = 0.05 * np.sin(np.arctan(0.1))


def shaft(
    position: Any,
    speed: Any = "3 rad/s",
    force: Any = "100 + 20*cos(O)",
    couple: float = -3.0,
    drive: Any = None,
) -> Any:
    """Efficiency of a shaft that a force presses into its bearing, and a couple holds back."""
    tree = {
        "gravity": "none",
        "links": {"ground": {"points": {"O": [0, 0]}}, "shaft": {"points": {"O": [0, 0]}}},
        "joints": {
            "O": {
                "type": "pin",
                "links": ["ground", "shaft"],
                "friction": {"coefficient": 0.1, "radius": 0.05},
            }
        },
        "drives": {"O": drive or {"position": position, "speed": speed}},
        "loads": {
            "F": {"type": "force", "on": "shaft", "at": "O", "value": force, "direction": 30},
            "M": {"type": "couple", "on": "shaft", "value": couple},
        },
    }
    return da.efficiency(da.statics(da.mechanism(tree)))


@pytest.mark.parametrize("count", [3, 8, 72])
def test_work_over_a_whole_turn(count: int) -> None:
    """The list stops a step before it closes: the last position stands for the step back to the first too."""
    e = shaft({"from": 0, "to": 360, "count": count})
    assert e.lost == pytest.approx(2 * np.pi * 100 * ARM, rel=1e-12)
    assert e.put_in == pytest.approx(2 * np.pi * (3 + 100 * ARM), rel=1e-12)
    assert e.cycle == pytest.approx(3 / (3 + 100 * ARM), rel=1e-12)
    assert e.share == {"O": pytest.approx(100 * ARM / (3 + 100 * ARM), rel=1e-12)}


def test_work_of_a_load_that_drives_is_what_the_drive_takes_and_what_rubs() -> None:
    e = shaft({"from": 0, "to": 360, "count": 8}, couple=3.0)
    assert e.put_in == pytest.approx(2 * np.pi * 3, rel=1e-12)
    assert e.cycle == pytest.approx(1 - 100 * ARM / 3, rel=1e-12)


@pytest.mark.parametrize("degrees", [[0, 10, 40, 90, 100], [100, 90, 20, 0], [0, 120]])
def test_work_over_part_of_a_turn_in_uneven_steps(degrees: list[float]) -> None:
    """Exact where the force goes with the angle, as the ends stand for half a step."""
    e = shaft(degrees, force="100 + 20*O", couple=0.0)
    turned = np.radians(100 if max(degrees) == 100 else 120)
    assert e.lost == pytest.approx(ARM * (100 * turned + 20 * turned**2 / 2), rel=1e-12)
    assert e.put_in == pytest.approx(e.lost, rel=1e-12)
    assert e.cycle == pytest.approx(0, abs=1e-12)


def test_speed_does_not_change_the_work_of_a_couple() -> None:
    """Of a constant force: faster or slower on the way, in one sense or the other."""
    speeds = [f"{v} rad/s" for v in (1, 4, 2, 5)]
    e = shaft([0, 30, 80, 100], speed=speeds, force=100.0, couple=0.0)
    assert e.lost == pytest.approx(np.radians(100) * 100 * ARM, rel=1e-12)
    back = shaft([100, 80, 30, 0], speed=[f"-{v}" for v in reversed(speeds)], force=100.0, couple=0.0)
    assert back.lost == pytest.approx(e.lost, rel=1e-12)


def test_one_position_stands_for_a_second() -> None:
    assert shaft(0, force=100.0).lost == pytest.approx(3.0 * 100 * ARM, rel=1e-12)


def test_a_law_of_motion_has_its_own_times() -> None:
    """Of a rise, at rest at both ends, where nothing is lost."""
    rise = {"law": {"type": "cycloidal", "from": 0, "to": 90, "duration": "0.5 s", "count": 201}}
    e = shaft(None, force=100.0, couple=0.0, drive=rise)
    assert e.lost == pytest.approx(np.pi / 2 * 100 * ARM, rel=1e-5)


@pytest.mark.parametrize("places", [[0, 0.05, 0.2, 0.3], [0.3, 0.1, 0], [0, 0.1, 0.2, 0.3]])
def test_work_along_a_slide(places: list[float]) -> None:
    """A stroke is no turn that would close: mu N times its length."""
    tree = {
        "gravity": "none",
        "links": {"ground": {"points": {"O": [0, 0]}}, "block": {"points": {"B": [0, 0]}}},
        "joints": {
            "S": {
                "type": "slider",
                "links": ["ground", "block"],
                "at": ["O", "B"],
                "friction": {"coefficient": 0.2},
            }
        },
        "drives": {"S": {"position": places, "speed": "2 m/s"}},
        "loads": {"N": {"type": "force", "on": "block", "at": "B", "value": [0, -50]}},
    }
    e = da.efficiency(da.statics(da.mechanism(tree)))
    assert e.lost == pytest.approx(0.2 * 50 * 0.3, rel=1e-12)
    assert e.put_in == pytest.approx(0.2 * 50 * 0.3, rel=1e-12)


def test_the_drive_moves_the_load_whichever_of_them_is_asked_for() -> None:
    """A block that a drive pushes against a load; its normal force rubs: 1/1.2 and 1 - 0.2."""
    tree = {
        "links": {"ground": {"points": {"O": [0, 0]}}, "block": {"points": {"O": [0, 0]}}},
        "joints": {"O": {"type": "slider", "links": ["ground", "block"], "friction": {"coefficient": 0.2}}},
        "drives": {"O": {"position": 0, "speed": 1}},
        "loads": {
            "N": {"type": "force", "on": "block", "at": "O", "value": [0, -100]},
            "F": {"type": "force", "on": "block", "at": "O", "value": [-100, 0]},
        },
    }
    asked = da.efficiency(da.statics(da.mechanism(tree)))
    assert (asked.forward[0], asked.reverse[0]) == pytest.approx((1 / 1.2, 0.8), rel=1e-12)
    tree["loads"]["F"] = {"type": "force", "on": "block", "at": "O", "direction": 180, "value": "unknown"}
    tree["drives"]["O"]["effort"] = 100
    known = da.efficiency(da.statics(da.mechanism(tree)))
    assert (known.forward[0], known.reverse[0]) == pytest.approx((0.8, 1 / 1.2), rel=1e-12)
    tree["drives"]["O"]["effort"] = 0
    idle = da.efficiency(da.statics(da.mechanism(tree)))
    assert np.isnan(idle.reverse[0])
    assert idle.forward[0] == 0.0  # the load puts it all into friction
