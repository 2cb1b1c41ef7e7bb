"""The oracles in space balance by themselves and agree with each other before they judge anything."""

from __future__ import annotations

import numpy as np
import pytest

from tests.oracles.space import natural, shafts
from tests.oracles.space.agreement import coordinates
from tests.oracles.space.machines import EXAMPLES, hooke
from tests.oracles.space.moving import Pose
from tests.oracles.space.parts import turning
from tests.oracles.space.spinning import Rotor, rotor
from tests.oracles.space.statics import Answer, Body, Hinge

every_example = pytest.mark.parametrize("name", EXAMPLES)
with_and_without_inertia = pytest.mark.parametrize("dynamic", [True, False])


@every_example
@with_and_without_inertia
def test_all_free_bodies_balance_and_the_drives_give_the_power(name: str, dynamic: bool) -> None:
    answer = EXAMPLES[name].answer(dynamic)
    assert answer.residual() < 1e-14
    assert answer.power_gap() < 1e-13


@every_example
@with_and_without_inertia
def test_hand_solution_is_that_of_natural_coordinates(name: str, dynamic: bool) -> None:
    example = EXAMPLES[name]
    answer = example.answer(dynamic)
    m = natural.Machine(example.tree)
    found = natural.solve(m, coordinates(m, answer.poses), dynamic)
    force, length = answer.force_scale(), answer.length()
    for joint, reaction in answer.reactions.items():
        close(found.forces[joint], reaction.force, force, f"force {joint}")
        close(found.moments[joint], reaction.moment, force * length, f"moment {joint}")
    for drive, effort in answer.efforts.items():
        close(found.efforts[drive], effort, np.max(np.abs(effort)), f"effort {drive}")
    for link, pose in answer.poses.items():
        k = 4 * m.links.index(link)
        for part, rate in ((found.q, "x"), (found.v, "v"), (found.a, "a")):
            close(part[:, k : k + 4], rows(pose, rate), np.max(np.abs(part)), f"{rate} of {link}")


def rows(pose: Pose, rate: str) -> np.ndarray:
    """Origin and axes of a link, or their rates, as natural coordinates have them."""
    turned = np.swapaxes(getattr(pose.rotation, rate), -1, -2)
    origin = getattr(pose.origin, rate)
    turned, origin = np.broadcast_arrays(turned, origin[:, None] + 0 * turned[:, :1])
    return np.concatenate([origin[:, :1], turned], 1)


def close(found: np.ndarray, expected: np.ndarray, scale: float, what: str) -> None:
    np.testing.assert_allclose(found, expected, rtol=0, atol=2e-12 * scale, err_msg=what)


@every_example
def test_no_constraint_is_redundant_and_drives_and_idle_spins_are_the_freedoms(name: str) -> None:
    example = EXAMPLES[name]
    answer = example.answer(True)
    m = natural.Machine(example.tree)
    freedoms, redundant, gap = natural.mobility(m, coordinates(m, answer.poses)[3])
    assert (freedoms, redundant) == (len(answer.efforts) + len(answer.free), 0)
    assert gap > 1e6


# what books say


def test_hooke_joint_turns_by_its_formula() -> None:
    """w2/w1 = cos b / (1 - sin^2 b cos^2 t), t from the position with the driving fork in the plane of the shafts."""
    answer = hooke("hooke", False).answer(True)
    n1, n2 = np.array([1.0, 0, 0]), answer.poses["output"].w[0] / np.linalg.norm(answer.poses["output"].w[0])
    normal = np.cross(n1, n2) / np.linalg.norm(np.cross(n1, n2))
    pin = pin_of_input(answer)
    t = np.arctan2(pin @ normal, pin @ np.cross(normal, n1))
    ratio = np.sum(answer.poses["output"].w * n2, -1) / np.sum(answer.poses["input"].w * n1, -1)
    cosine = n1 @ n2
    np.testing.assert_allclose(ratio, cosine / (1 - (1 - cosine**2) * np.cos(t) ** 2), rtol=1e-13)


def pin_of_input(answer: Answer) -> np.ndarray:
    """The couple of a universal joint is across both pins, and the input's pin across the input shaft and it."""
    couple = answer.reactions["U"].moment
    pin = np.cross(couple, [1.0, 0.0, 0.0])
    return pin / np.linalg.norm(pin, axis=-1, keepdims=True)


@pytest.mark.parametrize(("phase", "equal"), [(0.0, True), (np.pi / 2, False)])
def test_double_cardan_keeps_the_speed_in_the_right_phase_only(phase: float, equal: bool) -> None:
    """Parallel shafts and both forks of the middle shaft in one plane: the speeds are the same."""
    x, y, z = np.eye(3)
    middle = shafts.Shaft(z, x, (0, 0, 0), 0.4 * z)
    pin = np.cos(phase) * x + np.sin(phase) * y
    first = Hinge((-0.3, 0, 0), np.stack([y, z, x], -1), (0, 0, 0), np.eye(3))
    bodies = {name: Body(1.0, (0, 0, 0), (0.01, 0.01, 0.02)) for name in ("input", "middle", "output")}
    output = shafts.Shaft(z, x, (0, 0, 0), 0.2 * z)
    m = shafts.DoubleCardan(first, 0.3 * z, x, (1.0, 0.5, 0.2), middle, pin, x, output, bodies)
    answer = shafts.double_cardan(m, turning(0.0, 360.0, 10.0, 0.0))
    speeds = np.sum(answer.poses["output"].w * x, -1)
    assert np.allclose(speeds, 10.0, rtol=1e-13) == equal


def test_disk_set_askew_on_its_shaft_loads_the_bearings_by_its_products_of_inertia() -> None:
    """Bearing couple (C - A) w^2 sin b cos b, C about the disk's own axis; steady speed and no weight."""
    tilt, C, A, w, span = 0.1, 0.02, 0.01, 100.0, 0.5
    near = Hinge((0, 0, 0), np.eye(3), (0, 0, -span / 2), np.eye(3))
    c, s = np.cos(tilt), np.sin(tilt)
    turned = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    body = Body(3.0, (0, 0, 0), turned @ np.diag([A, A, C]) @ turned.T, gravity=(0, 0, 0))
    answer = rotor(Rotor(near, (0, 0, span / 2), body), turning(0.0, 360.0, w, 0.0))
    size = np.linalg.norm(answer.reactions["B"].force, axis=-1)
    np.testing.assert_allclose(size, (C - A) * w**2 * s * c / span, rtol=1e-13)
    np.testing.assert_allclose(answer.efforts["A"], 0.0, atol=1e-12)
