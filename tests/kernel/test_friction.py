"""Friction in the kernel: the answers of the general executor, its statuses, exact figures, and derivatives."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.batch_result import CODES, first_mark
from dalembert.analysis.batch.kernel_export import plain
from tests.friction.engines import engine, engine_by_hand, guided, pushed_slider
from tests.friction.rough import cycle, rough_tree
from tests.kernel.comparing import changed, difference, every_number, frictional, general
from tests.kernel.machines import ROUGH
from tests.kernel.test_derivatives import checked, differences
from tests.kernel.test_running import pointer, shared
from tests.tiers import tiers

TOLERANCE = 1e-10


def compared(m: Any, seed: int, shape: float, rest: float = 0.3) -> Any:
    """The answer for the description's own numbers and others, compared with the general executor's."""
    k = da.compile(m, vary=every_number(m))
    r = k(np.stack([k.nominal, changed(k, seed, shape, rest)]))
    for d in range(2):
        g = general(m, k, r.values[d])
        assert list(r.status[d]) == list(g.status)
        assert difference(k, r, d, g) < TOLERANCE
    return r


@pytest.mark.parametrize("seed", tiers([1], [0, *range(2, 12)], range(12, 1000)))
def test_random_mechanisms(seed: int) -> None:
    compared(da.mechanism(rough_tree(seed)), seed, shape=1e-5)


@pytest.mark.parametrize("name", tiers(list(ROUGH)[::2], list(ROUGH)[1::2]))
def test_whole_cycles(name: str) -> None:
    """With every number changed, friction's by up to a third; the general executor is not needed."""
    assert compared(ROUGH[name](), 1, shape=0.02).redone == 0


@pytest.mark.parametrize("circle", ["tan", "sin"])
def test_the_engine(circle: str) -> None:
    """One program for all coefficients, compiled without friction in the pins."""
    k = da.compile(
        engine(0.0, circle),
        vary=["friction.coefficient"],
        outputs=["effort.O", "reaction.A.magnitude"],
        static=True,
    )
    r, hand = k([[0.4], [0.05]]), [engine_by_hand(1, mu, circle) for mu in (0.4, 0.05)]
    assert r.effort("O")[:, 0] == pytest.approx([h.effort for h in hand], rel=1e-10)
    assert r.magnitude("A")[:, 0] == pytest.approx([h.rod for h in hand], rel=1e-10)
    assert r.ok.all()
    assert r.redone == 0


def test_the_engine_with_guides_of_finite_length() -> None:
    """Compiled with a long guide, where one face bears; the last ones bear on two corners."""
    k = da.compile(engine(guide=0.2), vary=["joints.guide.friction.guide"], static=True)
    half = np.array([0.2, 0.11, 0.1, 0.08, 0.05, 0.02, 0.01])
    exact = [engine_by_hand(half=h).effort for h in half]
    r = k(np.stack([half, half], axis=1))
    assert r.effort("O")[:, 0] == pytest.approx(exact, rel=1e-10)
    assert r.redone == 0


def test_a_rod_at_45_degrees() -> None:
    """With more friction than 1 it jams, which the kernel proves."""
    mu = np.array([0.0, 0.3, 0.9, 0.999, 1.001, 2.0])
    r = da.compile(pushed_slider(0.5), vary=["joints.guide.friction.coefficient"], static=True)(mu)
    assert r.unknown_load("rod")[:4, 0] == pytest.approx(
        100 / (math.cos(math.pi / 4) * (1 - mu[:4])), rel=1e-9
    )
    assert list(r.status[:, 0]) == ["ok"] * 4 + ["jammed"] * 2
    assert np.isnan(r.unknown_load("rod")[4:]).all()
    assert r.redone == 0


def test_all_contacts_of_a_guide() -> None:
    """Both faces and both diagonals, with faces that have a height, from one program."""
    m = guided(100.0, 3.0, 0.05, 0.08, 0.02)
    k = da.compile(m, vary=["loads.N.value", "loads.M.value"], static=True)
    values = k.nominal * np.array([[1, s, t] for s in (-1, 1) for t in (-8, -1, 0, 1, 8)])
    r = k(values)
    worst = max(difference(k, r, d, general(m, k, v)) for d, v in enumerate(values))
    assert worst < TOLERANCE
    assert r.redone == 0


def test_dead_centres_and_rest() -> None:
    """A slide reverses at its dead centre; a machine without speed is at rest."""
    tree = cycle("slider_crank", 12).to_tree()
    tree["drives"]["O2"]["position"] = [0, 30, 180, 300]
    m = da.mechanism(tree)
    k, g = da.compile(m, vary=["drives.O2.speed"]), da.dynamics(m)
    r = k([k.nominal, [0.0]])
    assert list(r.status[0]) == list(g.status) == ["reversal", "ok", "reversal", "ok"]
    assert list(r.status[1]) == ["at_rest"] * 4
    assert np.isnan(r.effort("O2")[1]).all()
    assert r.ok[0].all()
    assert difference(k, r, 0, g) < TOLERANCE
    assert difference(k, r.after, 0, g.after) < TOLERANCE
    assert (r.effort("O2")[0] != r.after.effort("O2")[0]).tolist() == [True, False, True, False]


def test_no_rate_where_nothing_is_carried() -> None:
    """A slide that carries nothing at its dead centre leaves nothing open."""
    m = engine(position=[0, 90, 180], gas=0.0)
    r = da.compile(m, static=True)()
    assert list(r.status[0]) == list(da.statics(m).status) == ["ok"] * 3


def test_self_locking_has_numbers() -> None:
    """Also of a moving mass: where power is turned round, the verdict without inertia is asked for."""
    m = cycle("slider_crank", 180).with_values({"friction.coefficient": 0.3})
    k, g = da.compile(m, vary=["friction.coefficient"]), da.dynamics(m)
    r = k()
    assert "self_locking" in g.status
    assert list(r.status[0]) == list(g.status)
    assert np.isfinite(r.effort("O2")).all()
    assert r.redone == 0
    peak = da.compile(m, outputs=["effort.O2"], reduce="peak")()
    assert list(peak.status) == ["self_locking"]
    assert peak.effort("O2")[0] == pytest.approx(np.abs(g.effort("O2")).max(), rel=1e-12)


@pytest.mark.parametrize(
    ("name", "mu", "doubt"),
    [
        ("slider_crank", 0.9, False),
        ("scotch_yoke", 0.5, False),
        ("scotch_yoke", 0.9, True),
        ("toggle_press", 1.5, True),
    ],
)
def test_strong_friction(name: str, mu: float, doubt: bool) -> None:
    """Where the rows' sums do not show that there is one solution, a power of the fixed point's matrix may."""
    m = cycle(name, 24).with_values({"friction.coefficient": mu})
    k, g = da.compile(m), da.dynamics(m)
    r = k()
    assert (r.redone > 0) is doubt
    assert list(r.status[0]) == list(g.status)
    assert difference(k, r, 0, g) < TOLERANCE


def test_a_reduction_over_a_dead_centre() -> None:
    """Both sides count: in extremes each, in means both with half the weight of the position."""
    m = engine(position=[0, 45, 90])
    sides = np.array([side.effort("O") for side in da.statics(m).sides])
    expected = {
        "peak": np.abs(sides).max(),
        "mean": sides.mean(),
        "rms": np.sqrt((sides**2).mean()),
        "norm8": (sides**8).mean() ** 0.125,
        "envelope": [sides.min(), sides.max()],
        "argpeak": np.abs(sides).max(axis=0).argmax(),
    }
    for reduce, value in expected.items():
        r = da.compile(m, outputs=["effort.O"], reduce=reduce, static=True)()
        assert r.status[0] in ("reversal", "self_locking")
        assert np.allclose(r.effort("O")[0], value, rtol=1e-11)
    still = da.compile(
        m.with_values({"drives.O.speed": 0.0}), outputs=["effort.O"], reduce="peak", static=True
    )()
    assert still.problems()[0][:2] == (0, "at_rest")
    assert np.isnan(still.effort("O")).all()


def test_the_mark_of_many_positions() -> None:
    locked, rest = CODES.index("self_locking"), CODES.index("at_rest")
    marks = np.array([[0, 0, 0], [0, locked, 0], [locked, rest, 0]], np.uint8)
    assert list(first_mark(marks)) == [0, locked, rest]


def slopes_are_differences(m: Any, vary: list[str], sizes: tuple[float, ...]) -> None:
    """Each position at the best of several steps: a large one may pass a kink, where a guide bears otherwise, a small
    one is rounding. Positions that are the general executor's are left out."""
    output = f"effort.{next(iter(m.drives))}"
    exact = da.compile(m, vary=vary, outputs=[output], derivatives=True)(redo=False)
    k = da.compile(m, vary=vary, outputs=[output])
    sure = np.isfinite(exact.value(output)[0])
    slopes = exact.gradient(output)[0][sure]
    for n, name in enumerate(k.numbers if sure.any() else ()):
        found = [differences(k, output, n, size) for size in sizes]
        off = [np.abs(slope[sure] - slopes[:, n]) - 10 * rounding for slope, rounding in found]
        assert np.nanmin(off, axis=0).max() < 1e-7 * np.abs(slopes[:, n]).max(), name


@pytest.mark.parametrize("name", tiers(["four_bar", "slider_crank"], ["whitworth"]))
def test_derivatives(name: str) -> None:
    m = ROUGH[name]()
    slopes_are_differences(m, every_number(m), (1e-3, 1e-4))


@pytest.mark.parametrize("reduce", tiers(["norm8"], ["peak", "mean", "rms", "envelope"]))
def test_derivatives_of_reductions(reduce: str) -> None:
    m = ROUGH["slider_crank"]()
    checked(m, ["effort.O2", "reaction.A.magnitude"], reduce, tolerance=1e-6)


@pytest.mark.parametrize("seed", tiers((), range(6), range(6, 40)))
def test_derivatives_of_random_mechanisms(seed: int) -> None:
    m = da.mechanism(rough_tree(seed, most=0.3))
    slopes_are_differences(m, frictional(m), (1e-2, 1e-3, 1e-4, 1e-5))


@pytest.mark.parametrize(
    ("name", "mu"),
    [
        ("slider_crank", 0.3),
        *(
            pytest.param(name, mu, marks=pytest.mark.long)
            for name, mu in (("toggle_press", 1.5), ("scotch_yoke", 0.5), ("scotch_yoke", 0.9))
        ),
    ],
)
def test_c_function_and_casadi(name: str, mu: float, tmp_path: Path) -> None:
    """Marks and numbers of the exports, self-locking, at rest, jammed and in doubt too."""
    tree = cycle(name).to_tree()
    tree["drives"]["O2"]["position"] = {"from": 0, "to": 360, "count": 181}
    m = da.mechanism(tree).with_values({"friction.coefficient": mu})
    k = da.compile(m, vary=["friction.coefficient", "joints.A.friction.radius"], outputs=["effort.O2"])
    program, r, course = plain(k), k(redo=False), k.trace.course
    columns = [k.trace.inputs.sources[n](course) for n in program.inputs_in_use("channel")]
    library, out = shared(tmp_path, k.to_c("machine"), "alone"), np.zeros(1)
    function = pytest.importorskip("casadi") and k.to_casadi()
    for p in range(len(course.schedule.position)):
        given = np.array([float(column[p]) for column in columns])
        mark = library.machine(pointer(k.nominal.copy()), pointer(given), pointer(out))
        effort, other = function(k.nominal, given)
        assert mark == float(other)
        assert mark == r.code[0, p] or (CODES[mark], r.status[0, p]) == ("at_rest", "reversal")
        if CODES[mark] in ("ok", "self_locking"):
            assert out[0] == pytest.approx(r.effort("O2")[0, p], rel=1e-10)
            assert float(effort) == pytest.approx(r.effort("O2")[0, p], rel=1e-10)
    assert {"ok", "self_locking", "jammed"} & set(r.status[0])
