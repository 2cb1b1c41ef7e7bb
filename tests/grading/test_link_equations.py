"""The equations behind follow-through: true figures solve them, own accelerations move them by what they weigh."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.grading.figure import figure
from dalembert.grading.marking.follow_through import LinkEquations, follow_through
from dalembert.grading.marking.key import place

AWAY = (0.7, -0.4)
"""Where the machine stands on the ground."""


def machine(**changes: Any) -> Any:
    m = da.four_bar().with_values({"drives.O2.position": 1.0, "drives.O2.speed": 9.0})
    for point, (x, y) in m.points("ground").items():
        m = m.with_values({f"links.ground.points.{point}": (x + AWAY[0], y + AWAY[1])})
    return m.with_values({"links.coupler.center": (0.09, 0.04), **changes})


def unknown() -> Any:
    load = {"type": "couple", "on": "rocker", "value": "unknown"}
    return machine(**{"loads": {"M": load}, "drives.O2.effort": 3.0})


def given(r: Any, quantity: str, of: str, value: Any, **more: Any) -> Any:
    said = " rad/s^2" if quantity == "acceleration" else ""
    shown = [f"{float(x)!r}" for x in value] if np.ndim(value) else f"{float(value)!r}{said}"
    return figure(r, da.Answer(quantity=quantity, of=of, value=shown, **more))


@pytest.mark.parametrize("make", [machine, unknown])
def test_true_figures_solve_the_equations_of_all_links(make: Any) -> None:
    r = da.dynamics(make())
    e = LinkEquations(r)
    size = e.a.shape[-1]
    x = np.linalg.solve(e.a.reshape(-1, size), -e.w.ravel())
    figures = [given(r, "effort", "O2", r.effort("O2")[0])] if make is machine else []
    figures += [given(r, "unknown_load", name, r.unknown_load(name)[0]) for name in r.unknown_loads]
    for joint in r.joints:
        i, j = r.mechanism.joints[joint].links
        on = {link: r.reaction(joint, on=link)[0] for link in (i, j)}
        figures += [given(r, "reaction", joint, on[j])]
        figures += [given(r, "reaction", joint, on[link], on=link) for link in (i, j)]
        figures += [given(r, "reaction", joint, on[j], by=i), given(r, "reaction", joint, on[i], by=j)]
        figures += [given(r, "reaction", joint, on[i][k], on=i, component="xy"[k]) for k in (0, 1)]
    assert len(figures) == 1 + 7 * len(r.joints)
    for f in figures:
        part = e.part(f)
        assert part is not None
        np.testing.assert_allclose(part.rows @ x, part.value, rtol=1e-9, atol=1e-9)
    size_alone = given(r, "reaction", "A", float(np.hypot(*r.reaction("A")[0])), component="magnitude")
    assert e.part(size_alone) is None
    known = da.dynamics(unknown())
    assert LinkEquations(known).part(given(known, "effort", "O2", 3.0)) is None  # it is no unknown


def test_own_accelerations_weigh_by_mass_and_arm() -> None:
    """-m a at the mass centre, about the link's reference point; -J alpha; nothing in statics."""
    r = da.dynamics(machine())
    e, m = LinkEquations(r), r.mechanism
    off = np.array([3.0, -5.0])
    for link in r.links:
        k = r.links.index(link)
        own = given(r, "center_acceleration", link, r.center_acceleration(link)[0] + off)
        turn = given(r, "acceleration", link, r.acceleration(link)[0] + 70.0)
        changed = (e.with_accelerations([own, turn]) - e.w) / e.scale
        force = -m.mass(link) * off
        angle, at = float(r.angle(link)[0]), r.compiled.layout.reference[k]
        turned = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) @ at
        arm = r.center(link)[0] - (r.position(link)[0] + turned)
        moment = arm[0] * force[1] - arm[1] * force[0] - m.inertia(link) * 70.0
        np.testing.assert_allclose(changed[k], [*force, moment], rtol=1e-9, atol=1e-12)
        assert not np.delete(changed, k, axis=0).any()
    still = LinkEquations(da.statics(machine()))
    assert not (still.with_accelerations([own, turn]) - still.w).any()


def test_links_are_taken_together_few_first() -> None:
    e = LinkEquations(da.dynamics(machine()))
    assert list(e.groups()) == [(), (0,), (1,), (2,), (0, 1), (0, 2), (1, 2), (0, 1, 2)]


@pytest.mark.parametrize(("off", "follows"), [(0.004, True), (-0.004, True), (0.03, False), (-0.03, False)])
def test_what_follows_from_a_wrong_force_is_what_equilibrium_says(off: float, follows: bool) -> None:
    """The crank's effort from a force in A of one's own; a little off is rounding."""
    r = da.dynamics(machine())
    e = LinkEquations(r)
    own = r.reaction("A", on="crank")[0] * 1.5 + 2.0
    extra = own - r.reaction("A", on="crank")[0]
    at = r.position("crank")[0] - r.position("coupler")[0]
    arm = -at if np.hypot(*at) > 0 else at
    effort = float(r.effort("O2")[0]) - (arm[0] * extra[1] - arm[1] * extra[0])
    force = given(r, "reaction", "A", own, on="crank")
    asked = given(r, "effort", "O2", effort * (1 + off))
    found = e.follows(asked, [force], [True])
    assert (found == ("crank",)) is follows
    assert e.follows(asked, [force], [False]) is None  # of right figures alone nothing follows
    ways = follow_through(e, [force, asked], [0, 1])
    assert (ways == {1: "right by the equilibrium of crank"}) is follows


@pytest.mark.parametrize(("apart", "follows"), [(0.005, True), (0.03, False)])
def test_own_figures_that_do_not_agree_settle_nothing(apart: float, follows: bool) -> None:
    """Both bearings of the crank of one's own: apart from balance by a part of the largest of all these numbers."""
    r = da.dynamics(machine())
    e = LinkEquations(r)
    extra = np.array([40.0, -60.0])
    there, here = r.reaction("A", on="crank")[0] + extra, r.reaction("O2", on="crank")[0] - extra
    arm = r.position("coupler")[0] - r.position("crank")[0]
    effort = float(r.effort("O2")[0]) - (arm[0] * extra[1] - arm[1] * extra[0])
    forces = [given(r, "reaction", "A", there, on="crank")]
    off = apart * np.abs([*there, *here]).max() * np.array([1.0, 0.0])
    forces += [given(r, "reaction", "O2", here + 3 * off, on="crank")]
    asked = given(r, "effort", "O2", effort)
    assert (e.follows(asked, forces, [True, True]) == ("crank",)) is follows
    half = given(r, "reaction", "A", there[0], on="crank", component="x")
    assert e.follows(asked, [half], [True]) is None  # it leaves the effort open


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("3", 3),
        ("12345678", 12345678),
        ("123456789", "123456789"),
        ("60 deg", "60 deg"),
        ("", ""),
        (None, None),
        ("²", "²"),
    ],
)
def test_a_place_is_a_number_or_a_drives_value(text: str | None, found: object) -> None:
    assert place(text) == found
    assert type(place(text)) is type(found)
