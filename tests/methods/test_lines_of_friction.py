"""Lines of friction in a worked solution: circles with their couples, tangents, guides, losses, and ends at rest."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.reports.sections import friction
from dalembert.reports.sheet import Paragraph, ReportSheet, SheetTable
from dalembert.views.notation import Figures, Notation

NAN, INF = math.nan, math.inf


def shown(torque: int = 1) -> Any:
    out: Any = Figures(None, Notation(torque=torque))
    out.least = {"force": 1e-6, "power": 1e-6}
    out.pair = lambda by, on: f"{by[0]}{on[0]}"
    out.reaction = lambda joint, on: f"F_{{{on[0]}}}"
    out.heading = lambda link: f"<{link}>"
    out.link = lambda link: link[0]
    return out


def context(torque: int = 1, links: Any = ("ground", "crank"), couple: float = 0.5, **more: Any) -> Any:
    described = SimpleNamespace(links=links, friction=SimpleNamespace(radius=0.02, guide=None, force=None))
    r = SimpleNamespace(
        mechanism=SimpleNamespace(joints={"A": described}),
        reaction=lambda joint, *on: np.array([[9.0, 9.0], [-30.0, 40.0]]),
        friction_moment=lambda joint, on: np.array([9.0, couple]),
        **more,
    )
    s = shown(torque)
    return SimpleNamespace(r=r, k=1, shown=s, notation=s.notation)


@pytest.mark.parametrize(
    ("torque", "links", "couple", "letters", "sense"),
    [
        (1, ("ground", "crank"), 0.5, "M_{fgc} = r_{A} F_{c}", "0.5000 counter-clockwise"),
        (1, ("ground", "crank"), -0.5, "M_{fgc} = −r_{A} F_{c}", "−0.5000 clockwise"),
        (-1, ("crank", "ground"), -0.5, "M_{fgc} = r_{A} F_{c}", "0.5000 clockwise"),
        (-1, ("rod", "crank"), 0.5, "M_{frc} = −r_{A} F_{c}", "−0.5000 counter-clockwise"),
        (1, ("rod", "crank"), 0.0, "M_{frc} = r_{A} F_{c}", "0 "),
    ],
)
def test_the_couple_of_a_friction_circle_has_its_sign_and_sense(
    torque: int, links: Any, couple: float, letters: str, sense: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        friction, "friction_circles", lambda r, joint: SimpleNamespace(radii=np.array([9.0, 0.004]))
    )
    monkeypatch.setattr(friction, "friction_coefficient", lambda r, joint, k: 0.25)
    monkeypatch.setattr(friction, "circle_kind", lambda m, joint: "sin")
    radius, line = friction.pin_lines(context(torque, links, couple), "A")
    assert radius.letters == "r_{A} = R_{A} sin (arctan mu_{A})"
    assert radius.numbers == "0.02000 sin 14.04 deg"
    assert radius.result == '0.004000 "m"'
    assert line.letters == letters
    minus = "−" if "−" in letters else ""
    assert line.numbers == f"{minus}0.004000 cdot 50.00"
    number, _, words = sense.partition(" ")
    assert line.result == f'{number} "N·m{f", {words} about A" if words else ""}"'
    monkeypatch.setattr(friction, "circle_kind", lambda m, joint: "mu")
    plain = friction.circle_radius(context(), "A", 0.25, 0.005)
    assert (plain.letters, plain.numbers) == ("r_{A} = mu_{A} R_{A}", "0.25 cdot 0.02000")


@pytest.mark.parametrize(
    ("links", "couple", "words"),
    [
        (
            ("ground", "crank"),
            -0.5,
            "A: link <crank> turns counter-clockwise on <ground>, so friction's couple on it is clockwise",
        ),
        (
            ("crank", "ground"),
            0.5,
            "A: link <crank> turns counter-clockwise on <ground>, so friction's couple on it is counter-",
        ),
        (
            ("crank", "rod"),
            0.5,
            "A: link <rod> turns clockwise on <crank>, so friction's couple on it is counter-clockwise, and",
        ),
        (("crank", "rod"), 0.0, ""),
        (("rod", "rod"), 0.5, ""),
    ],
)
def test_the_side_of_a_circle_follows_from_the_sense_of_turning(
    links: Any, couple: float, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    speeds = {"ground": 0.0, "crank": 3.0, "rod": 1.0}
    monkeypatch.setattr(friction, "link_speed", lambda r, link: np.array([0.0, speeds[link]]))
    said = friction._sense(context(links=links, couple=couple), "A")
    assert said.startswith(words)
    assert bool(said) is bool(words)


@pytest.mark.parametrize("radii", [(0.03, 0.01), (0.01, 0.03)])
@pytest.mark.parametrize("sides", [(1, 1), (-1, -1), (1, -1), (-1, 1)])
def test_a_common_tangent_touches_both_circles(
    radii: Any, sides: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Both pins are at the distance of their radii from the line, on their sides."""
    pins = {"A": np.array([[9.0, 9.0], [0.1, 0.2]]), "B": np.array([[9.0, 9.0], [0.5, 0.5]])}
    sizes = dict(zip("AB", radii, strict=True))
    monkeypatch.setattr(friction, "pin_center", lambda r, joint: pins[joint])
    monkeypatch.setattr(friction, "friction_circle_radius", lambda r, joint: sizes[joint])
    monkeypatch.setattr(
        friction, "friction_circles", lambda r, joint: SimpleNamespace(radii=np.array([9.0, sizes[joint]]))
    )
    monkeypatch.setattr(friction, "tangent_sides", lambda r, a, b: np.array([[0, 0], sides]))
    two: Any = SimpleNamespace(joints=("A", "B"), link="rod", state=lambda k: "tension")
    words, (beta, theta) = friction.tangent_lines(context(), two)
    inner = sides[0] != sides[1]
    assert (
        "an internal tangent, as friction turns the link in the same sense at both pins" in words
    ) is inner
    assert ("an external tangent" in words) is not inner
    assert "of A and B alone" in words
    assert "circles, in tension." in words
    sine = (sides[0] * radii[0] - sides[1] * radii[1]) / 0.5
    turn, along = -math.degrees(math.asin(sine)), math.degrees(math.atan2(3, 4))
    large, small = ("AB", radii) if radii[0] >= radii[1] else ("BA", radii[::-1])
    sign, moved = "+" if inner else "−", "+" if turn >= 0 else "−"
    assert beta.letters == f"beta_{{r}} = arcsin (frac(r_{{{large[0]}}} {sign} r_{{{large[1]}}}; AB))"
    assert beta.numbers == f"arcsin (frac({small[0]:.5f} {sign} {small[1]:.5f}; 0.5000))"
    assert beta.result == f"{Notation().degrees(math.radians(abs(turn)))} deg"
    assert theta.letters == f"theta_{{AB}} {moved} beta_{{r}}"
    assert theta.numbers == f"36.87 deg {moved} {beta.result}"
    assert float(theta.result.removesuffix(" deg").replace("−", "-")) == pytest.approx(
        along + turn, abs=0.006
    )


def guide(c: Any, guide_lengths: Any, force: Any, monkeypatch: pytest.MonkeyPatch) -> Any:
    contact = SimpleNamespace(
        normal=np.array([9.0, -60.0]),
        couple=np.array([9.0, 5.0]),
        lower=np.array([9.0, 20.0]),
        upper=np.array([9.0, 80.0]),
        mode=("x", "on both corners"),
    )
    monkeypatch.setattr(friction, "guide_contact", lambda r, joint: contact)
    monkeypatch.setattr(friction, "friction_coefficient", lambda r, joint, k: 0.1)
    c.r.mechanism.joints["A"].friction = SimpleNamespace(radius=0, guide=guide_lengths, force=force)
    c.r.friction_force = lambda joint: np.array([[9.0, 9.0], [-6.0, 8.0]])
    return friction.guide_lines(c, "A")


def test_a_guide_presses_with_its_force_or_with_its_corners(monkeypatch: pytest.MonkeyPatch) -> None:
    sums, friction_of = guide(context(), None, None, monkeypatch)
    assert (sums.letters, sums.numbers, sums.result) == ("S_{A} = |N_{gc}|", "", '100.0 "N"')
    assert (friction_of.letters, friction_of.numbers) == ("F_{fgc} = mu_{A} S_{A}", "0.1 cdot 100.0")
    assert friction_of.result == '10.00 "N"'
    long, lower, upper, friction_of = guide(context(), (0.05, 0.15), 3.0, monkeypatch)
    assert (
        long.letters
        == 'S_{A} = "greater of" |N_{gc}| "and" frac(|2 M_{A} − (l_{2} − l_{1}) N_{gc}|; l_{1} + l_{2})'
    )
    size = abs(2 * 5 - (0.15 - 0.05) * -60) / 0.2
    assert long.numbers == f'"greater of" 60.00 "and" {size:.2f}'
    assert long.result == '100.0 "N: on both corners"'
    assert (lower.letters, lower.result) == ("N_{lower} = frac(S_{A} + N_{gc}; 2)", '20.00 "N"')
    assert (upper.letters, upper.result) == ("N_{upper} = frac(S_{A} − N_{gc}; 2)", '80.00 "N"')
    assert friction_of.letters == "F_{fgc} = mu_{A} S_{A} + F_{0}"
    assert friction_of.numbers == "0.1 cdot 100.0 + 3.000"


def costs(
    lost: Any,
    unknown: Any = (),
    forward: float = 0.8,
    reverse: float = NAN,
    cycle: float = 0.75,
    count: int = 2,
) -> Any:
    r = SimpleNamespace(
        power_lost=lambda n: np.array([9.0, lost[n]]), drives=("O", "P"), unknown_loads=unknown, status=("ok",) * count,
        effort=lambda d: np.array([9.0, {"O": 10.0, "P": -2.0}[d]]), drive_speed=lambda d: np.array([9.0, 3.0]),
    )  # fmt: skip
    eta = SimpleNamespace(
        forward=np.array([9.0, forward]),
        reverse=np.array([9.0, reverse]),
        cycle=cycle,
        driven=lambda k: " (a)",
        held=lambda k: " (b)",
    )
    sheet, s = ReportSheet(""), shown()
    made: Any = friction
    kept = made.friction_joints, made.efficiency
    made.friction_joints, made.efficiency = lambda r: tuple(lost), lambda r: eta
    try:
        friction.cost(sheet, SimpleNamespace(r=r, k=1, shown=s, notation=s.notation))  # type: ignore[arg-type]
    finally:
        made.friction_joints, made.efficiency = kept
    return sheet.blocks


def test_the_cost_of_friction_is_a_share_of_what_is_put_in() -> None:
    table, words = costs({"A": 4.0, "B": 2.0, "C": 0.9e-6})
    assert isinstance(table, SheetTable)
    assert table.heads == ("Joint", "Power lost (W)", "of the input power")
    percent = Notation().percent
    assert table.rows == (
        ("A", "4.000", percent(4 / 24)),
        ("B", "2.000", percent(2 / 24)),
        ("C", "0", percent(0.0)),
        ("sum", "6.000", percent(6 / 24)),
    )
    assert table.total
    said = f"Efficiency, without inertia: {percent(0.8)} where the drive moves the load (a); {percent(0.75)} over all "
    assert words.text.startswith(said)
    table, words = costs({"A": 4.0}, ("U",), NAN, 0.3, 0.75, 1)
    assert [row[2] for row in table.rows] == ["–", "–"]
    assert words == Paragraph(
        f"Efficiency, without inertia: {percent(0.3)} where the load moves the drive (b)."
    )
    assert len(costs({"A": 4.0}, (), NAN, NAN, NAN)) == 1
    assert costs({"A": 0.9e-6, "B": -0.9e-6}) == []


def test_intervals_at_rest_have_two_ends_and_what_holds_beyond(monkeypatch: pytest.MonkeyPatch) -> None:
    ends = {"O": (-2.0, 5.0), "P": (-INF, 3.0)}
    held = {"O": (-4.0, INF), "P": (1.0, 2.0)}
    r = SimpleNamespace(
        interval=lambda n: np.array([(9.0, 9.0), ends[n]]), holding=lambda n: np.array([(9.0, 9.0), held[n]])
    )
    monkeypatch.setattr(friction, "unknown_names", lambda r: ("O", "P"))
    monkeypatch.setattr(friction, "unknown_kinds", lambda r: {"O": "moment", "P": "force"})
    monkeypatch.setattr(friction, "holds_beyond", lambda interval, some: bool(some[0] < interval[0]))
    first, beyond, second = friction.intervals(SimpleNamespace(r=r, k=1, shown=shown()))  # type: ignore[arg-type]
    assert first.letters.startswith('"O: −2.000')
    assert "5.000" in first.letters
    assert beyond.letters == '"O: after some earlier motions friction can hold −4.000 to any value N·m"'
    assert "3.000" in second.letters
    assert second.letters.startswith('"P: ')
