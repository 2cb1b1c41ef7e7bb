"""Explanations of sheets of two arms that carry a force each: the one that fits all figures best, in full."""

from __future__ import annotations

from typing import Any

import pytest

import dalembert as da


def arms(lever: float, **loads: tuple[float, float]) -> da.Mechanism:
    """A horizontal arm held by a torque at O, with Q at a lever and, on a tip welded to it at 1 m, F at 2 m."""
    at = {"F": ("tip", "T", (10.0, 20.0)), "Q": ("arm", "E", (10.0, -20.0))}
    forces = {
        name: {"type": "force", "on": on, "at": point, "value": list(loads.get(name, value))}
        for name, (on, point, value) in at.items()
    }
    return da.mechanism(
        {
            "links": {
                "ground": {"points": {"O": [0, 0]}},
                "arm": {"points": {"O": [0, 0], "P": [1, 0], "E": [lever, 0]}},
                "tip": {"points": {"P": [0, 0], "T": [1, 0]}},
            },
            "joints": {
                "O": {"type": "pin", "links": ["ground", "arm"]},
                "P": {"type": "weld", "links": ["arm", "tip"]},
            },
            "drives": {"O": {"position": "0 deg"}},
            "loads": forces,
        }
    )


PARTS = {
    "O": {"quantity": "effort", "of": "O"},
    "Py": {"quantity": "reaction", "of": "P", "on": "tip", "component": "y"},
    "P": {"quantity": "reaction", "of": "P", "on": "tip"},
    "Ox": {"quantity": "reaction", "of": "O", "on": "arm", "component": "x"},
}


def explained(lever: float, **figures: Any) -> list[tuple[str, str]]:
    """Sentence and kind of each wrong figure of a sheet."""
    answers = [da.Answer(**PARTS[name], value=value) for name, value in figures.items()]
    return [(v.mistake, v.kind) for v in da.check_answers(arms(lever), answers) if not v.right]


EXCHANGED = [("loads F and Q are exchanged", "named")] * 2


@pytest.mark.parametrize("lever", [0.4, 0.002, 0.004])
def test_a_seldom_mistake_that_fits_all_figures_is_before_a_usual_one_that_fits_some(lever: float) -> None:
    """F counted clockwise fits the reaction, and where Q has hardly a lever almost the torque, too."""
    torque = 2 * 20 - 20 * lever  # of F and Q exchanged
    assert explained(lever, Py="20 N", O=f"{torque:.6g} N*m") == EXCHANGED
    assert da.statics(arms(lever, F=(10, -20), Q=(10, 20))).effort("O")[0] == pytest.approx(torque)


OPPOSITE = ("the sense is opposite: action mistaken for reaction", "sign")
NONE = ("none of the usual mistakes explains it", "unknown")
AXES = "the angle is counted from the other axis: x and y are exchanged"
OF_F = ("the angle of F is counted from the other axis", "named")
REVERSED = "load F has the wrong sense, or the angle of F is counted clockwise"
TURNED = "the position of O is counted from the other dead centre"
DRAWN = "which a drawing may be: state a tolerance if it is one"
TEN = ("load F is ten times too small", "named")
UNIT = ("a factor of 1000 (mm and m, N and kN)", "unit")
SHEETS: list[tuple[dict[str, Any], list[tuple[str, str]]]] = [
    # one mistake in the problem: the usual ones with the same figures beside it, the seldom ones not
    ({"Py": "20 N", "O": "48 N*m"}, [(REVERSED, "named")] * 2),
    ({"Py": "0 N", "O": "8 N*m"}, [("load F is left out", "named")] * 2),
    ({"P": ["-20 N", "-10 N"], "O": "-12 N*m"}, [OF_F] * 2),
    ({"Py": "-2 N", "O": "4 N*m", "Ox": "-11 N"}, [("load F is ten times too small", "named")] * 3),
    # of one figure alone, with a slip that leads to the same, or perhaps
    ({"P": ["-20.0 N", "-10.0 N"]}, [(f"{AXES}, or {OF_F[0]}", "named")]),
    ({"O": "32 N*m"}, [(f"{OPPOSITE[0]}, or {TURNED}, or {TURNED}, turned by 180 deg", "sign")]),
    (
        {"O": "8 N*m"},
        [("may be: load F is left out, or the moment of F about P has the wrong sign", "may_be")],
    ),
    # right figures speak against a mistake, not against a slip
    ({"P": ["-20 N", "-10 N"], "O": "-32 N*m"}, [(AXES, "named")]),
    ({"Py": "20.0 N", "O": "-32 N*m"}, [OPPOSITE]),
    ({"Py": "20 N", "O": "-32 N*m"}, [(f"may be: {OPPOSITE[0]}", "may_be")]),  # of two digits
    ({"Py": "-2.00 N", "O": "-32 N*m", "Ox": "-20 N"}, [NONE]),
    # slips of several figures, beside what nothing explains only if they are certain
    ({"Py": "20.00 N", "O": "32.00 N*m", "Ox": "20.00 N"}, [OPPOSITE] * 3),
    ({"Py": "20.00 N", "O": "17.77 N*m", "Ox": "17.17 N"}, [OPPOSITE, NONE, NONE]),
    ({"Py": "20.0 N", "O": "17.77 N*m"}, [NONE, NONE]),
    ({"O": "-32000 N*m", "Ox": "-20000 N"}, [("a factor of 1000 (mm and m, N and kN)", "unit")] * 2),
    # a mistake and a slip beside it, or a figure that nothing explains
    ({"P": ["-20.0 N", "-10.0 N"], "Ox": "20.00 N"}, [OF_F, OPPOSITE]),
    (
        {"P": ["-20.0 N", "-10.0 N"], "Ox": "20.00 N", "O": "31.1 N*m"},
        [(AXES, "named"), OPPOSITE, NONE],
    ),
    (
        {"Py": "-2 N", "O": "31.1 N*m", "Ox": "-11 N"},
        [
            ("may be: load F is ten times too small", "may_be"),
            NONE,
            ("may be: load F is ten times too small", "may_be"),
        ],
    ),
    # a slip in what the mistake makes of a figure, where it explains more than that one
    ({"Py": "-2 N", "O": "4 N*m", "Ox": "11.00 N"}, [TEN] * 2 + [OPPOSITE]),
    ({"Py": "-2 N", "O": "4 N*m", "Ox": "-11000 N"}, [TEN] * 2 + [UNIT]),
    ({"P": ["-20 N", "-10 N"], "O": "-12.00 N*m", "Ox": "30.00 N"}, [OF_F] * 2 + [OPPOSITE]),
    ({"Py": "-2.00 N", "Ox": "11.00 N"}, [NONE] * 2),
    # nearly right
    ({"Py": "-19.6 N", "O": "-32.7 N*m"}, [("close: rounded too early, or a small slip", "rounding")] * 2),
    ({"Py": "-19.3 N", "O": "-32 N*m"}, [(f"{NONE[0]}; it is 3.6 % off, {DRAWN}", "unknown")]),
    ({"O": "-30.5 N*m"}, [(f"{NONE[0]}; it is 4.9 % off, {DRAWN}", "unknown")]),
    ({"O": "-30.4 N*m"}, [NONE]),
    ({"Py": "-19.6 N", "O": "17 N*m"}, [(f"{NONE[0]}; it is 2 % off, {DRAWN}", "unknown"), NONE]),
]


@pytest.mark.parametrize(
    ("sheet", "said"), SHEETS, ids=[", ".join(f"{k} {v}" for k, v in s.items()) for s, _ in SHEETS]
)
def test_a_sheet_is_explained_by_what_chance_does_not(
    sheet: dict[str, Any], said: list[tuple[str, str]]
) -> None:
    assert explained(0.4, **sheet) == said
