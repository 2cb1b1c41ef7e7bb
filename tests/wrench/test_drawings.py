"""Drawings of force systems as data: to the stated scale, the polygon's gap is the resultant, texts cover nothing."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.views.force_system import (
    clip_line,
    force_system_polygon_scene,
    force_system_scene,
    reduced_scene,
)
from dalembert.views.space.camera import CAMERAS, Camera
from dalembert.wrench import Couple, Force, System
from tests.methods.readable import text_over_lines, text_overlaps
from tests.wrench.random_systems import DIMENSIONS, SEEDS, random_system

both = pytest.mark.parametrize("d", DIMENSIONS)
each = pytest.mark.parametrize("seed", SEEDS)


def check(scene: Any) -> None:
    assert text_overlaps(scene) == []
    assert text_over_lines(scene) == []
    json.dumps(scene.to_dict())
    for arrow in scene.arrows():
        if arrow.kind in ("force", "force-seen", "moment-seen"):
            assert arrow.length * scene.scales[arrow.kind] == pytest.approx(arrow.value, rel=1e-9)


@both
@each
def test_texts_cover_nothing_and_arrows_are_to_scale(seed: int, d: int) -> None:
    s = random_system(seed, d)
    check(force_system_scene(s))
    check(reduced_scene(s, np.zeros(d)))
    check(force_system_scene(s + System(*s.equilibrant())))


@each
def test_the_polygons_gap_is_the_resultant(seed: int) -> None:
    s = random_system(seed, 2)
    scene = force_system_polygon_scene(s)
    check(scene)
    heads = {a.of: np.subtract(a.head, a.tail) for a in scene.arrows()}
    whole = heads.pop("R")
    assert whole == pytest.approx(sum(heads.values()), abs=1e-9)
    assert whole * scene.scales["force"] == pytest.approx(s.resultant)
    closed = force_system_polygon_scene(s + System(*s.equilibrant()))
    assert "R" not in {a.of for a in closed.arrows()}
    assert closed.numbers["gap"] <= 1e-12 * closed.numbers["largest"]


@each
def test_the_resultant_stands_on_its_line(seed: int) -> None:
    """Back from paper to metres: the arrow's tail has no moment left, in the plane to a rounding."""
    s = random_system(seed, 2)
    scene = force_system_scene(s)
    arrows = [a for a in scene.arrows() if a.of == "R"]
    assert bool(arrows) != any("off this drawing" in t.text for t in scene.texts())
    if arrows:
        first = next(a for a in scene.arrows() if a.of == "F0")
        metres = np.subtract(arrows[0].tail, first.tail) * scene.scales["length"] + s.forces[0].at
        assert s.moment(metres) == pytest.approx(0.0, abs=1e-9)


def test_what_is_said() -> None:
    plate = System(Force([40, 0], at=[-7, 0]), Force("80 @ 30 N"), Couple(140))
    texts = " ".join(t.text for t in da.draw.force_system(plate, at=[0, 0]).texts())
    assert "The system is a single force: R = (109.3, 40.00) N, 116.4 N ∠ 20.10°." in texts
    assert "d = 1.203 m" in texts
    assert "Force and couple at (0, 0) m" in texts
    assert "R = (109.3, 40.00) N, M = 140.0 N·m." in texts
    couple = System(Force([5, 0]), Force([-5, 0], at=[0, 2]))
    assert "The system is a couple: 10.00 N·m." in " ".join(
        t.text for t in force_system_scene(couple).texts()
    )


def test_a_free_body_of_a_result() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]))
    scene = da.draw.force_system(da.wrench.on(r, "coupler"))
    texts = [t.text for t in scene.texts()]
    assert "F_{A} = 154.8 lbf" in texts
    assert any(t.startswith("The system is in equilibrium") for t in texts)
    assert "The polygon is closed: the forces balance." in texts


@pytest.mark.parametrize("name", list(CAMERAS))
def test_space_from_every_side(name: str) -> None:
    s = random_system(3, 3)
    check(da.draw.force_system(s, camera=name))
    check(da.draw.force_system(s, camera=Camera(1.0, -0.3)))


def test_no_such_view() -> None:
    with pytest.raises(da.ModelError, match="there is no view 'isometrc'; did you mean 'isometric'"):
        da.draw.force_system(random_system(1, 3), camera="isometrc")


@pytest.mark.parametrize("seed", range(5))
def test_cameras(seed: int) -> None:
    """Right, up and eye are a right-handed triad; seen size and depth make up the whole."""
    rng = np.random.default_rng(seed)
    camera = Camera(float(rng.uniform(-4, 4)), float(rng.uniform(-1.5, 1.5)))
    triad = np.stack([camera.right, camera.up, camera.eye])
    assert triad @ triad.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(triad) == pytest.approx(1.0)
    assert camera.up[2] >= 0
    v = rng.normal(size=(6, 3))
    seen = np.linalg.norm(camera(v), axis=-1)
    assert np.hypot(seen, camera.depth(v)) == pytest.approx(np.linalg.norm(v, axis=-1))
    assert camera.order(v) == list(np.argsort(camera.depth(v)))


def test_named_views() -> None:
    x, y, z = CAMERAS["isometric"](np.eye(3))
    assert [math.hypot(*a) for a in (x, y, z)] == pytest.approx([math.sqrt(2 / 3)] * 3)
    assert [float(x @ y), float(y @ z)] == pytest.approx([-1 / 3] * 2)
    for name, (right, up) in {"front": "xz", "side": "yz", "top": "xy"}.items():
        seen = dict(zip("xyz", CAMERAS[name](np.eye(3)), strict=True))
        assert seen[right] == pytest.approx([1, 0], abs=1e-15)
        assert seen[up] == pytest.approx([0, 1], abs=1e-15)


def test_lines_in_a_box() -> None:
    assert clip_line((0, 20), (1, 0), (-10, 0, 10, 8)) is None
    assert clip_line((0, 0), (1, 1), (-2, -1, 2, 3)) == ((-1, -1), (2, 2))
