"""The start-up of a design report: what is simulated, from where, until when, and what is said of its end."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.reports.design import start_up
from dalembert.reports.design.start_up import start_up_part


class Ran:
    """Runs instead of simulations: each call is kept, each gives the next of some ends."""

    def __init__(self, *ends: tuple[float, float], forces: Any = None, doubt: str = "") -> None:
        self.ends, self.calls, self.doubt = list(ends), [], doubt  # type: ignore[var-annotated]
        self.forces = {"A": [[3.0, 4.0], [6.0, -8.0]]} if forces is None else forces

    def __call__(self, m: Any, until: Any, start: Any, count: int, tolerance: float) -> Any:
        self.calls.append((until, start, count, tolerance))
        time, speed = self.ends[min(len(self.calls), len(self.ends)) - 1]
        result = SimpleNamespace(
            joints=tuple(self.forces), reaction=lambda j: np.array(self.forces[j], float)
        )
        return SimpleNamespace(
            time=np.array([0.0, time / 2, time]),
            speed=lambda drive: np.array([0.0, 2 * speed, speed]),
            result=result,
            doubt=self.doubt,
        )


def machine(*speeds: float, turns: bool = True, start: Any = None, motors: str = "-M") -> Any:
    """A context of a machine whose drives D0, D1, ... have a motor where ``motors`` has an M."""
    motor = SimpleNamespace(at_drive=SimpleNamespace(fastest=70.0))
    drives = {
        f"D{k}": SimpleNamespace(motor=motor if letter == "M" else None, turns=turns)
        for k, letter in enumerate(motors)
    }
    r = SimpleNamespace(
        drives=tuple(drives),
        mechanism=SimpleNamespace(drives=drives, start=start),
        drive_speed=lambda d: np.array(speeds) * (1 if d == "D1" else 100),
        drive_position=lambda d: np.array([0.25, 0.5, 0.75]) * (1 if d == "D1" else 100),
    )
    return SimpleNamespace(r=r, text=lambda kind, value: f"{value:.9g} {kind}")


def started(c: Any, ran: Ran, monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    monkeypatch.setattr(start_up, "simulate", ran)
    monkeypatch.setattr(start_up, "put_answer", lambda sheet, s, c: sheet.text(f"ends at {s.time[-1]:g} s"))
    parts = list(start_up_part(c))
    assert [p.title for p in parts] == ["Start-up"] * len(parts)
    return parts


def test_a_machine_starts_at_its_first_position_until_nine_tenths_of_its_largest_speed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ran = Ran((2.0, -18.0))
    (part,) = started(machine(-12.0, -20.0, 4.0), ran, monkeypatch)
    assert ran.calls == [
        ([5.0, "D1.speed = -18.0 rad/s"], {"D1": {"position": 0.25, "speed": 0.0}}, 101, 1e-8)
    ]
    reached, force = part.verdicts
    assert (reached.item, reached.state, reached.value) == ("D1 reaches 18 angular_speed", "ok", "in 2 time")
    assert (force.item, force.state, force.value) == ("largest joint force, A", "not judged", "10 force")
    assert force.remark == "compare with the joint forces of the cycle"
    assert [b.text for b in part.sheet.blocks] == ["ends at 2 s"]


def test_a_start_in_the_file_stands_and_a_slide_has_a_speed_in_metres(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ran = Ran((1.5, 0.27))
    (part,) = started(machine(0.1, math.nan, 0.3, turns=False, start="given"), ran, monkeypatch)
    assert [call[:2] for call in ran.calls] == [([5.0, "D1.speed = 0.27 m/s"], None)]
    assert part.verdicts[0].item == "D1 reaches 0.27 speed"


@pytest.mark.parametrize(("time", "runs"), [(1.2499, 2), (1.25, 1), (1.2501, 1), (0.3, 2)])
def test_a_short_start_is_run_again_over_its_own_time(
    time: float, runs: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A quarter of five seconds; the second run may end a millionth later than the first."""
    ran = Ran((time, 9.0), (time / 2, 9.0))
    (part,) = started(machine(10.0, 5.0), ran, monkeypatch)
    assert len(ran.calls) == runs
    assert part.verdicts[0].value == f"in {time / runs:.9g} time"
    until, start, count, tolerance = ran.calls[-1]
    assert until == [5.0 if runs == 1 else pytest.approx(time * 1.000001, rel=1e-12), "D1.speed = 9.0 rad/s"]
    assert (start, count, tolerance) == ({"D1": {"position": 0.25, "speed": 0.0}}, 101, 1e-8)


@pytest.mark.parametrize(
    ("last", "state"), [(8.9999920, "ok"), (8.9999905, "exceeded"), (-9.5, "ok"), (-8.99, "exceeded")]
)
def test_a_speed_is_reached_within_a_millionth(
    last: float, state: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    (part,) = started(machine(10.0, 5.0), Ran((4.0, last)), monkeypatch)
    reached = part.verdicts[0]
    assert reached.state == state
    assert reached.remark == ("" if state == "ok" else f"it has {last:.9g} angular_speed after 4 time")
    assert reached.value == ("in 4 time" if state == "ok" else "")


def test_a_machine_that_stands_is_brought_near_the_free_speed_of_its_motor(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ran = Ran((4.0, 63.0))
    (part,) = started(machine(0.0, 0.0), ran, monkeypatch)
    assert ran.calls[0][0][1] == "D1.speed = 63.0 rad/s"
    assert part.verdicts[0].state == "ok"
    ran = Ran((4.0, 63.0))
    started(machine(-1.0 / 3, -1.0 / 7), ran, monkeypatch)
    assert ran.calls[0][0][1] == "D1.speed = -0.3 rad/s"
    ran = Ran((4.0, 63.0))
    started(machine(2.0 / 3, -2.0 / 7), ran, monkeypatch)
    assert ran.calls[0][0][1] == "D1.speed = 0.6 rad/s"
    ran = Ran((4.0, 63.0))
    started(machine(1.0 / 7), ran, monkeypatch)
    assert ran.calls[0][0][1] == "D1.speed = 0.128571 rad/s"


def test_the_largest_known_joint_force_and_a_doubt_are_said(monkeypatch: pytest.MonkeyPatch) -> None:
    nan = math.nan
    forces = {"A": [[3, 4]], "B": [[nan, nan]], "C": [[5, 12]], "D": [[-8, 6]]}
    (part,) = started(machine(10.0), Ran((4.0, 9.0), forces=forces, doubt="It drifts"), monkeypatch)
    _, force, doubt = part.verdicts
    assert (force.item, force.value) == ("largest joint force, C", "13 force")
    assert (doubt.item, doubt.state, doubt.remark) == ("check of the motion", "exceeded", "It drifts")
    (part,) = started(machine(10.0), Ran((4.0, 9.0), forces={"B": [[nan, nan]]}), monkeypatch)
    assert [v.item for v in part.verdicts] == ["D1 reaches 9 angular_speed"]


def test_a_machine_without_a_motor_has_no_start_up(monkeypatch: pytest.MonkeyPatch) -> None:
    ran = Ran((4.0, 9.0))
    (part,) = started(machine(10.0, motors="--"), ran, monkeypatch)
    (verdict,) = part.verdicts
    assert (verdict.item, verdict.state, verdict.remark) == (
        "Start-up", "not judged", "no drive of the file has a motor",
    )  # fmt: skip
    assert started(machine(10.0, motors=""), ran, monkeypatch) == []
    assert ran.calls == []
    started(machine(10.0, motors="-MM"), ran, monkeypatch)
    assert ran.calls[0][0][1].startswith("D1.")
