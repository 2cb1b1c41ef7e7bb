"""Mechanisms in space: the kernel gives the answers of the general executor, whatever numbers of the file vary."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.careful_path import quantity
from dalembert.analysis.batch.tracing.symbolic_model import geometric
from dalembert.analysis.compile.compiled_mechanism import compile_mechanism
from dalembert.analysis.result.named_quantities import names_of
from dalembert.core.layout import Gearing, Idle
from dalembert.model import library
from tests.kernel.comparing import changed, difference, every_number, general
from tests.kernel.test_redone import both
from tests.random_space import random_drawing, tree
from tests.space.machines import oracle
from tests.space.rough import rough
from tests.space.test_gears import Z, pair, wheel
from tests.tiers import nth, over_seeds, tiers

TOLERANCE = 1e-10


def helical_wheels() -> Any:
    """Two wheels on parallel axes, whose teeth push them apart and along."""
    return pair(wheel([0, 0, 0], Z, 0.05), wheel([0.15, 0, 0], Z, 0.1), [0, 0, -10.0], helix_angle=15.0)


MACHINES: dict[str, Callable[[], Any]] = {
    "rssr": lambda: library.rssr(positions=6),
    "rccc": lambda: library.rccc(positions=6),
    "rssp": lambda: library.rssp(positions=6),
    "bennett": lambda: library.bennett(positions=6),
    "spherical_four_bar": lambda: library.spherical_four_bar(positions=6),
    "helical wheels": helical_wheels,
    **{name: lambda name=name: oracle(name) for name in ("rsup", "double_cardan", "gyroscope")},  # type: ignore[misc]
}


def compiled(m: Any) -> Any:
    """A kernel with every number free but those that would bring a rod's centre off the line of its two balls, which
    nothing holds it about; and the geometry, where that may not vary."""
    c = compile_mechanism(m, m.schedule())
    paths = [path for path in every_number(m) if path.split(".")[1:2] not in [[rod] for rod in c.passive]]
    kinds = c.layout.constraints.families
    stuck = any(isinstance(f, Gearing) or (isinstance(f, Idle) and not f.stands.all()) for f in kinds)
    return da.compile(m, vary=[path for path in paths if not (stuck and geometric(m, path))], lanes=1)


def agrees(m: Any, seed: int = 1) -> Any:
    """The file's numbers and changed ones have the general executor's answers, which is not asked."""
    k = compiled(m)
    r = k(np.stack([k.nominal, changed(k, seed, shape=1e-3)]))
    for d in range(2):
        g = general(m, k, r.values[d])
        assert list(r.status[d]) == list(g.status)
        assert difference(k, r, d, g) < TOLERANCE
    return r


QUICK = ["rssp", "spherical_four_bar", "helical wheels"]


@pytest.mark.parametrize("name", tiers(QUICK, sorted(set(MACHINES) - set(QUICK))))
def test_machines(name: str) -> None:
    assert agrees(MACHINES[name]()).redone == 0


@over_seeds([14], range(300), block=5)
def test_random_mechanisms(seed: int) -> None:
    """Of spatial mechanisms without redundant constraints."""
    agrees(da.mechanism(tree(random_drawing(seed, redundant=False))), seed)


FEW = [42, 43]
"""With a thread and a pin, and with a ball, pins and a collar."""


def spun(seed: int) -> bool:
    """Whether friction decides the spin of a rod between balls, which the kernel leaves to the analyses."""
    m = rough(seed, most=0.3)
    c = compile_mechanism(m, m.schedule())
    families = c.contacts.rows.families if c.contacts is not None else ()
    ends = {int(end) for f in families for end in (*f.i, *f.j)}
    return any(c.links.index(rod) in ends for rod in c.passive)


@pytest.mark.parametrize("seed", FEW)
def test_friction(seed: int) -> None:
    assert not spun(seed)
    assert agrees(rough(seed, most=0.3), seed).redone == 0


@pytest.mark.parametrize("start", tiers((), range(0, 10, 10), range(10, 200, 10)))
def test_friction_of_many(start: int) -> None:
    """Of journals, collars, guides, balls and threads."""
    for seed in [seed for seed in range(start, start + 10) if not spun(seed)]:
        agrees(rough(seed, most=0.3), seed)


def test_spins_that_friction_decides_are_refused() -> None:
    with pytest.raises(da.ModelError, match="spins in its balls follows from their friction"):
        compiled(rough(nth(0, spun), most=0.3))


def test_every_output() -> None:
    m = MACHINES["rssr"]()
    things = (
        "effort.O",
        "reaction.A",
        "reaction_moment.A",
        "point.rod.B",
        "point.rod.origin",
        "angle.rod",
        "power.O",
    )
    words = (*things, "rotation.rod", "drive.O", "turn", "slide", "shaking_force", "residual")
    every = names_of(da.dynamics(m), compiled=True)
    names = [n for n in every if n.startswith(words) and not n.startswith("shaking_moment")]
    k = da.compile(m, vary=["links.rocker.points.B"], outputs=names, lanes=1)
    r = k(k.nominal + 0.001)
    g = general(m, k, r.values[0])
    for name in names:
        value = quantity(g, name).reshape(r.value(name)[0].shape)
        size = np.abs(g.force_array).max() if name == "reaction_moment.A" else max(np.abs(value).max(), 1e-3)
        assert np.abs(r.value(name)[0] - value).max() < 1e-11 * size, name
    assert r.reaction("A", axes="link")[0] == pytest.approx(
        g.reaction("A", axes="link"), rel=1e-10, abs=1e-10
    )


def test_derivatives_and_those_from_a_solution(monkeypatch: pytest.MonkeyPatch) -> None:
    vary = ["links.crank.points.A", "joints.C.axis"]
    both(library.rssr(positions=4), monkeypatch, vary=vary)


@pytest.mark.parametrize(
    ("machine", "path", "says"),
    [
        (
            helical_wheels(),
            "links.b.points.B",
            "'links.b.points.B.0' places joints, and the wheels of gear 'G' in space are fitted to each other at the "
            "first position: so it cannot vary; leave it out, or use da.dynamics or da.statics",
        ),
        (
            rough(0),
            "gravity",
            "how fast rod 'L3' spins in its balls follows from their friction, so it cannot be compiled; leave that "
            "friction out, or use da.dynamics or da.statics",
        ),
    ],
)
def test_what_is_refused(machine: Any, path: str, says: str) -> None:
    with pytest.raises(da.ModelError, match=re.escape(says)):
        da.compile(machine, vary=[path])


def test_where_a_rod_does_not_reach() -> None:
    """Told by the closed form, where the rod is shorter than the way from the crank to the line of the slide."""
    k = da.compile(library.rssp(positions=24), vary=["links.crank.points.A"], outputs=["effort.O"], lanes=1)
    r = k([[0.25, 0.0, 0.0]])
    turn = r.positions[:, 0]
    way = np.stack([0.25 * np.cos(turn), 0.25 * np.sin(turn), 0 * turn], axis=1) - [0.1, 0.05, 0.03]
    line = np.array([1.0, 0.2, 0.3])
    far = np.linalg.norm(np.cross(way, line), axis=1) / np.linalg.norm(line) > 0.25
    assert 0 < far.sum() < 24
    assert list(r.status[0]) == ["not_assembled" if out else "ok" for out in far]
    assert r.redone == 0
