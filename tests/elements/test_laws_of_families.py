"""Laws that every family of elements keeps, on random machines of each: one table of families and laws."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.methods.applied_forces import Action, actions, state
from dalembert.analysis.methods.belt_tensions import tension_actions
from dalembert.arrays import Array
from tests.elements.random_elements import FAMILIES
from tests.elements.written_machines import Written
from tests.tiers import BLOCK

FACTORS = (1.0, 1.03, 0.98)
"""Of the varied numbers of three designs."""

SEEDS = {"one_way": (0, 3)}
"""Machines of the quick laws, if not the first alone: a clutch that holds, and one that drives turn freely."""


@dataclass(frozen=True)
class Made:
    """A random machine of a family, with its answers."""

    family: str
    seed: int

    @cached_property
    def tree(self) -> dict[str, Any]:
        return FAMILIES[self.family](self.seed, Written())[0]

    @cached_property
    def vary(self) -> list[str]:
        return FAMILIES[self.family](self.seed, Written())[1]

    @cached_property
    def mechanism(self) -> da.Mechanism:
        return da.mechanism(self.tree)

    @cached_property
    def answer(self) -> da.Result:
        return da.dynamics(self.mechanism, method="careful")

    @cached_property
    def kernel(self) -> Any:
        outputs = [f"effort.{n}" for n in self.answer.drives] + [f"reaction.{n}" for n in self.answer.joints]
        return da.compile(self.mechanism, self.vary, outputs, derivatives=True)

    @cached_property
    def designs(self) -> Array:
        return np.array([np.asarray(self.kernel.nominal) * f for f in FACTORS])

    def careful(self, values: Array) -> da.Result:
        """The careful answer of another design."""
        numbers = dict(zip(self.vary, values.tolist(), strict=True))
        return da.dynamics(self.mechanism.with_values(numbers), method="careful")

    @property
    def size(self) -> tuple[float, float]:
        return sizes(self.answer)


def sizes(r: da.Result) -> tuple[float, float]:
    """Largest force and moment of an answer: of what rounding is measured by."""
    turns = [r.mechanism.drives[n].turns for n in r.drives]
    effort = np.abs(np.nan_to_num(r.effort_array))
    force = max(np.abs(np.nan_to_num(r.force_array)).max(), effort[:, ~np.array(turns)].max(initial=0), 1e-9)
    moment = max(np.abs(np.nan_to_num(r.moment_array)).max(), effort[:, turns].max(initial=0), 0.01 * force)
    return float(force), float(moment)


@lru_cache(maxsize=4 * BLOCK)
def made(family: str, seed: int) -> Made:
    return Made(family, seed)


def close(a: Any, b: Any, size: Any, small: float = 1e-9) -> None:
    """Equal numbers, measured by their sizes, and none at the same places."""
    a, b = np.asarray(a), np.asarray(b)
    np.testing.assert_array_equal(np.isnan(a), np.isnan(b))
    assert np.abs(np.nan_to_num((a - b) / size)).max(initial=0.0) < small


def reactions_do_no_work(x: Made) -> None:
    """What drives, loads and inertia put in is what friction takes; a belt's pull, which is given, is such a load."""
    r = x.answer
    assert r.residual[r.ok].max(initial=0.0) < 1e-11
    none = np.zeros(int(r.ok.sum()))
    powers, size = {"joint": none, "friction": none, "other": none}, 0.0
    for a in actions(r):
        kind, of = a.kind if a.kind in powers else "other", power(r, a)
        powers[kind], size = powers[kind] + of, max(size, float(np.abs(of).max(initial=0.0)))
    pull, size = sum((power(r, a) for a in tension_actions(r, state(r))), none), size or 1.0
    close(powers["joint"], pull, size)
    close(powers["other"] + pull, -powers["friction"], size)
    assert powers["friction"].max(initial=0.0) < 1e-9 * size


def power(r: da.Result, a: Action) -> Array:
    """Of an action on its link, by the velocity of its point, where there is an answer."""
    if a.link == "ground":
        return np.zeros(int(r.ok.sum()))
    arm, spin = a.at - r.position(a.link), r.speed(a.link)
    turn = np.cross(spin, arm) if arm.shape[1] == 3 else spin[:, None] * arm[:, ::-1] * [-1, 1]
    return a.power(r.velocity(a.link) + turn, spin)[r.ok]


def every_path_has_one_answer(x: Made) -> None:
    """The kept program, the careful path, and virtual work."""
    r, quick = x.answer, da.dynamics(x.mechanism)
    assert quick.status == r.status
    force, moment = x.size
    close(quick.force_array, r.force_array, force)
    close(quick.moment_array, r.moment_array, moment)
    assert da.virtual_work(r).gap[r.ok].max(initial=0.0) < 1e-9


def steps_find_the_answer(x: Made) -> None:
    """The solution on paper: each number of its steps, and an equation that none has used."""
    r, (force, moment) = x.answer, x.size
    if not r.ok.any():
        return
    for step in r.steps(int(np.argmax(r.ok)) + 1).steps:
        for found, right in zip(step.finds, step.right, strict=True):
            close(found.value, right, moment if found.turning else force)
        terms = [t.value for t in step.terms] if step.kind == "check" else [0.0]
        close(sum(terms), 0.0, max(map(abs, terms)) or 1.0)


def a_kernel_is_the_careful_path(x: Made) -> None:
    """Three designs: status, efforts and reactions."""
    answer = x.kernel(x.designs)
    for k, values in enumerate(x.designs):
        r = x.careful(values)
        force, moment = sizes(r)
        assert tuple(answer.status[k]) == r.status
        for n in r.drives:
            turns = x.mechanism.drives[n].turns
            close(answer[f"effort.{n}"][k], r.effort(n), moment if turns else force)
        for n in r.joints:
            close(answer[f"reaction.{n}"][k], r.reaction(n), force)


def derivatives_are_differences(x: Made) -> None:
    """Of the careful path, where nothing jumps between the designs of a difference."""
    at = x.designs[0]
    answer = x.kernel(at[None])
    for n, path in enumerate(x.vary):
        h = 1e-5 * np.eye(len(at))[n] * (abs(at[n]) or 1.0)
        up, down = x.careful(at + h), x.careful(at - h)
        smooth = x.answer.ok & up.ok & down.ok
        for drive in x.answer.drives:
            found = np.asarray(answer.gradient(f"effort.{drive}"))[0, :, n]
            slope = (up.effort(drive) - down.effort(drive)) / (2 * h[n])
            size = max(
                np.abs(x.answer.effort(drive)[smooth]).max(initial=1e-9) / abs(at[n]),
                np.abs(slope[smooth]).max(initial=0),
            )
            assert np.abs((found - slope)[smooth]).max(initial=0.0) < 1e-6 * size, path


def as_written(x: Made, w: Written) -> None:
    """The same machine, written otherwise, has the same answer."""
    r, size = x.answer, x.size
    other = da.dynamics(da.mechanism(FAMILIES[x.family](x.seed, w)[0]), method="careful")
    assert other.status == r.status
    polar = np.ones(r.force_array.shape[2])
    polar[1] = w.flip
    turning = w.flip * (polar if len(polar) == 3 else 1.0)
    force, moment = w.mass * w.length, w.mass * w.length**2
    written = [
        k for k, n in enumerate(r.joints) if n in x.tree["joints"]
    ]  # strands may be counted the other way
    close(other.force_array[:, written] / force, r.force_array[:, written] * polar, size[0])
    close(other.moment_array[:, written] / moment, r.moment_array[:, written] * turning, size[1])
    for n in r.drives:
        if x.mechanism.drives[n].turns:
            close(other.effort(n) / moment, w.flip * r.effort(n), size[1])
        else:
            close(other.effort(n) / force, r.effort(n), size[0])


def a_mirror_reverses_turns(x: Made) -> None:
    """Opposite turns and couples, reflected forces."""
    as_written(x, Written(flip=-1))


def sizes_have_their_powers(x: Made) -> None:
    """Forces go as mass and length, couples as mass and its square, at the same times."""
    as_written(x, Written(length=37.0, mass=0.043))


def a_hub_changes_nothing(x: Made) -> None:
    """A link is welded, off its axis, to a hub that turns in its place; a cam or band asks for the pin on its own."""
    pins = [(n, j) for n, j in x.tree["joints"].items() if j["type"] == "pin" and j["links"][0] == "ground"]
    if x.family in ("cam", "band"):
        return
    for name, joint in pins[:2]:
        tree, link, at = deepcopy(x.tree), joint["links"][1], joint.get("at", name)
        at = at if isinstance(at, str) else at[1]
        place = tree["links"][link]["points"][at]
        off = [place[0] + 0.11, place[1] - 0.07]
        tree["links"][link]["points"]["W"] = off
        tree["links"]["hub"] = {"points": {at: place, "W": off}}
        tree["joints"][name]["links"] = ["ground", "hub"]
        tree["joints"] = {"W": {"type": "weld", "links": ["hub", link]}, **tree["joints"]}
        other, r, (force, moment) = da.dynamics(da.mechanism(tree), method="careful"), x.answer, x.size
        assert other.status == r.status
        for n in r.joints:
            close(other.reaction(n), r.reaction(n), max(force, moment / 0.1))
        close(other.effort_array, r.effort_array, moment)


LAWS = {
    f.__name__: f
    for f in (
        reactions_do_no_work,
        every_path_has_one_answer,
        steps_find_the_answer,
        a_kernel_is_the_careful_path,
        derivatives_are_differences,
        a_mirror_reverses_turns,
        sizes_have_their_powers,
        a_hub_changes_nothing,
    )
}


PAIRS = [(family, law) for n, family in enumerate(FAMILIES) for law in list(LAWS)[n % 2 :: 2]]
REST = [(family, law) for family in FAMILIES for law in LAWS if (family, law) not in PAIRS]


@pytest.mark.parametrize(
    ("family", "law"), [*PAIRS, *(pytest.param(*pair, marks=pytest.mark.long) for pair in REST)]
)
def test_a_machine_keeps_the_law(family: str, law: str) -> None:
    for seed in SEEDS.get(family, (0,)):
        LAWS[law](made(family, seed))


@pytest.mark.parametrize("seed", range(2))
def test_what_a_brake_holds_moves_as_what_carries_it(seed: int) -> None:
    """The lever of a band is at rest; a shoe on a frame that turns faster and faster turns as the frame does, with the
    acceleration of its point of it."""
    r = made("band", seed).answer
    assert np.abs([r["angle.lever.speed"], r["angle.lever.acceleration"]]).max() < 1e-12
    tree = deepcopy(made("shoe", seed).tree)
    tree["links"]["frame"] = tree["links"]["ground"] | {
        "points": tree["links"]["ground"]["points"] | {"P": [0.3, -0.2]}
    }
    tree["links"]["ground"] = {"points": {"P": [0.3, -0.2]}}
    for joint in tree["joints"].values():
        joint["links"] = ["frame" if link == "ground" else link for link in joint["links"]]
    tree["joints"] = {"P": {"type": "pin", "links": ["ground", "frame"]}, **tree["joints"]}
    tree["drives"]["P"] = Written().spins(0.0, 3.0, 5.0)
    r = da.dynamics(da.mechanism(tree), method="careful")
    assert (r["angle.shoe.speed"][0], r["angle.shoe.acceleration"][0]) == pytest.approx((3, 5), rel=1e-12)
    x, y = r["point.shoe.Q"][0] - [0.3, -0.2]
    assert r["point.shoe.Q.acceleration"][0] == pytest.approx([-9 * x - 5 * y, -9 * y + 5 * x], rel=1e-9)


@pytest.mark.exhaustive
@pytest.mark.parametrize("block", range(200 // BLOCK))
@pytest.mark.parametrize("family", FAMILIES)
def test_two_hundred_machines_keep_the_laws(family: str, block: int) -> None:
    """Most of which have an answer, so that the laws say something."""
    answered = 0
    for seed in range(BLOCK * block, BLOCK * (block + 1)):
        for law in LAWS.values():
            law(made(family, seed))
        answered += bool(made(family, seed).answer.ok.any())
        made.cache_clear()
    assert answered > BLOCK / 2


def test_a_lost_contact_comes_before_self_locking() -> None:
    """A machine with both: its numbers would be those of a pin that its slot pulls."""
    r = made("pushing", 29).answer
    assert "contact_lost" in r.status
    assert "self_locking" not in r.status
    assert "slot would have to pull" in r.text().replace("\n  ", " ")
