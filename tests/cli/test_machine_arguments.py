"""Commands of machine design and their arguments: what is handed on, in which units, and what is refused."""

from __future__ import annotations

import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.cli.machine import machine_commands
from dalembert.cli.machine.counterweight_argument import bounds_of, sum_of, two_planes
from dalembert.cli.machine.element_commands import _length
from dalembert.errors import ArgumentError, ModelError
from dalembert.machine.elements import cam_design, pin_table
from dalembert.machine.motion import simulation
from tests.cli.conftest import Run

MM = da.mechanism(
    {
        "units": {"length": "mm", "mass": "g"},
        "links": {"ground": {"points": {"O": [0, 0]}}, "rod": {"points": {"O": [0, 0]}, "mass": 1}},
        "joints": {"O": {"type": "pin", "links": ["ground", "rod"]}},
    }
)


@pytest.mark.parametrize(
    ("text", "link", "bounds"),
    [
        ("crank", "crank", {}),
        ("crank:", "crank", {}),
        ("crank:radius=80,mass=2kg", "crank", {"radius": 0.08, "mass": 2.0}),
        ("crank:radius=0.3m,mass=250", "crank", {"radius": 0.3, "mass": 0.25}),
        ("a:disc=7800kg/m^3/20/80mm", "a", {"disc": (7800.0, 0.02, 0.08)}),
        ("a:place=12/-0.5m", "a", {"place": (0.012, -0.5)}),
        ("a:x=-3g*20mm/0.3kg*m", "a", {"x": (-6e-5, 0.3)}),
        ("a:y=5g*mm/7g*mm,z=2kg*3/4kg*5", "a", {"y": (5e-6, 7e-6), "z": (0.006, 0.02)}),
        ("a:moment=2kg*80mm,at=P", "a", {"moment": 0.16, "at": "P"}),
    ],
)
def test_bounds_of_a_counterweight_are_read_in_the_units_of_the_file(
    text: str, link: str, bounds: dict[str, Any]
) -> None:
    name, found = bounds_of(MM, text)
    assert name == link
    assert list(found) == list(bounds)
    for key, value in bounds.items():
        assert found[key] == (value if isinstance(value, str) else pytest.approx(value, rel=1e-12))


def test_bounds_that_are_none_are_refused_with_an_example() -> None:
    with pytest.raises(ModelError) as refused:
        bounds_of(MM, "crank:radius=80,heavy")
    said = "--on crank:radius=80,heavy: 'heavy' is not a bound; write --on crank:radius=80mm,mass=2kg"
    assert str(refused.value) == said
    with pytest.raises(ModelError) as refused:
        bounds_of(MM, "crank:disc=7800/20")
    said = "--on crank:disc=7800/20: a disc is density/thickness/radius; write disc=7800kg/m^3/20mm/80mm"
    assert str(refused.value) == said


def test_planes_of_a_rotor_have_one_radius_or_two() -> None:
    for radii, both in (("40", (0.04, 0.04)), ("40, 0.06 m", (0.04, 0.06)), ("40,", (0.04, 0.04))):
        places, sizes = two_planes(MM, "50,0.45m", radii, None)
        assert places == pytest.approx((0.05, 0.45))
        assert sizes == pytest.approx(both)
    for planes, radii, option, count in (
        ("50", "40", "planes", 1),
        ("50,60", "", "radii", 0),
        ("50,60", "1,2,3", "radii", 3),
    ):
        with pytest.raises(ModelError) as refused:
            two_planes(MM, planes, radii, [])
        said = f"--{option} has {count} lengths, not two; write --{option} 50mm,450mm"
        assert str(refused.value) == said
    with pytest.raises(
        ModelError, match="--planes puts masses on a rotor, --on counterweights on links; ask for"
    ):
        two_planes(MM, "50,60", "40", ["rod"])


def test_an_aim_is_a_word_or_a_sum_of_parts_with_weights() -> None:
    assert sum_of("moment") == "moment"
    assert sum_of("force=1,torque=0.5") == {"force": 1.0, "torque": 0.5}
    for text in ("force=much", "force=1,torque"):
        with pytest.raises(ModelError) as refused:
            sum_of(text)
        assert str(refused.value) == f"--of {text} is not a sum; write --of force=1,torque=0.5"


def test_a_length_of_an_option_is_positive_and_in_the_units_of_the_file() -> None:
    assert _length(MM, "6", "cutter") == pytest.approx(0.006)
    assert _length(MM, "2um", "tolerance") == pytest.approx(2e-6)
    for text in ("0", "-3mm"):
        with pytest.raises(ArgumentError, match=f"--cutter is {text}; give a positive length"):
            _length(MM, text, "cutter")
    with pytest.raises(ArgumentError, match=r"^--tolerance: '2 kg' "):
        _length(MM, "2 kg", "tolerance")


# commands with the work replaced


class Made(SimpleNamespace):
    """An answer that prints one line and keeps how it was saved."""

    def text(self, units: str = "file", **choice: Any) -> str:
        return f"printed in {units} with {choice}"

    def save(self, path: Path, **how: Any) -> None:
        self.saved.append((str(path), how))


@pytest.fixture
def cams(monkeypatch: pytest.MonkeyPatch) -> Made:
    made = Made(saved=[], asked=[])

    def cam(m: da.Mechanism, name: str) -> Made:
        made.asked.append((m.title, name))
        return made

    monkeypatch.setattr(cam_design, "cam", cam)
    return made


def test_the_cam_of_a_file_is_its_first_unless_one_is_named(run: Run, folder: Path, cams: Made) -> None:
    da.disc_cam().save(folder / "cam.yaml")
    m = da.load(folder / "cam.yaml")
    (first,) = (n for n, j in m.joints.items() if j.type == "cam")
    assert run("cam", "cam.yaml") == (0, "printed in file with {}\n", "")
    assert run("cam", "cam.yaml", "--joint", "K", "--units", "si") == (0, "printed in SI with {}\n", "")
    assert cams.asked == [(m.title, first), (m.title, "K")]
    assert cams.saved == []
    ran = run("cam", "four_bar.yaml")
    assert (ran.status, ran.out) == (2, "")
    assert ran.err == "four_bar.yaml:1: the mechanism has no cam; add a joint of type: cam\n"


def test_the_outline_of_a_cam_has_a_tolerance_and_the_radius_of_a_cutter(
    run: Run, folder: Path, cams: Made
) -> None:
    da.disc_cam().save(folder / "cam.yaml")
    run("cam", "cam.yaml", "--outline", "a.dxf")
    run("cam", "cam.yaml", "--outline", "b.csv", "--tolerance", "3um", "--cutter", "0.006", "--force")
    (a, plain), (b, cut) = cams.saved
    assert (a, b) == ("a.dxf", "b.csv")
    assert plain == {"tolerance": pytest.approx(1e-6), "cutter": None, "overwrite": False}
    assert cut == {"tolerance": pytest.approx(3e-6), "cutter": pytest.approx(6e-3), "overwrite": True}
    ran = run("cam", "cam.yaml", "--outline", "a.dxf", "--cutter", "-1mm")
    assert (ran.status, ran.err) == (2, "--cutter is -1mm; give a positive length\n")


@pytest.mark.parametrize(("ended", "status"), [("ended", 0), ("interrupted", 130), ("stuck", 1)])
def test_a_simulation_is_asked_for_as_the_options_say(
    ended: str, status: int, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked, read = [], []

    def simulate(
        m: Any, until: Any, start: Any, event: Any, count: Any, small: Any, steps: Any, tell: Any
    ) -> str:
        asked.append((until, start, [*event], count, small, steps))
        tell(3, 7)
        return "made"

    made = Made(status=ended, result="its result", curves=())
    monkeypatch.setattr(simulation, "simulate", simulate)
    monkeypatch.setattr(
        machine_commands, "replace", lambda what, curves: setattr(made, "curves", curves) or made
    )
    monkeypatch.setattr(
        "dalembert.analysis.result.named_quantities.quantity", lambda r, name: read.append((r, name))
    )
    ran = run("simulate", "four_bar.yaml", "--until", "2s")
    assert (ran.status, ran.out) == (status, "printed in file with {}\n")
    assert (asked, read, made.curves) == ([(["2s"], None, [], 201, simulation.TOLERANCE, 10_000)], [], ())
    more = ["--event", "O2.position = 90 deg", "--curves", "reaction.A", "reaction.B", "--count", "11"]
    run(
        "simulate",
        "four_bar.yaml",
        "--until",
        "2s",
        "O2.speed = 0 rad/s",
        *more,
        "--tolerance",
        "1e-6",
        "--steps",
        "50",
    )
    assert asked[1] == (["2s", "O2.speed = 0 rad/s"], None, ["O2.position = 90 deg"], 11, 1e-6, 50)
    assert made.curves == ("reaction.A", "reaction.B")
    assert read == [("its result", "reaction.A"), ("its result", "reaction.B")]


def test_pins_are_those_named_over_a_whole_turn(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []

    def pins(r: da.Result, joints: Any) -> Made:
        asked.append((len(r.status), joints))
        return Made()

    monkeypatch.setattr(pin_table, "pins", pins)
    assert run("pins", "four_bar.yaml", "--positions", "5").status == 0
    assert (
        run("pins", "four_bar.yaml", "--joints", "A", "B", "--positions", "3").out
        == "printed in file with {}\n"
    )
    assert asked == [(5, None), (3, ["A", "B"])]


def test_shaking_that_is_not_known_everywhere_ends_with_the_positions_that_fail(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    force = np.array([[1.0, 2.0], [3.0, 4.0]])
    monkeypatch.setattr("dalembert.machine.shaking.shaking", lambda r, about, links: Made(force=force))
    monkeypatch.setattr(
        "dalembert.analysis.output.summary.printed_answer.problems_text",
        lambda r, to: f"{len(r.status)} fail",
    )
    ran = run("shake", "four_bar.yaml", "--positions", "2", "--orders", "6")
    assert ran == (0, "printed in file with {'orders': 6}\n", "")
    force[1, 0] = np.nan
    ran = run("shake", "four_bar.yaml", "--positions", "2")
    assert ran == (1, "printed in file with {'orders': 4}\n", "2 fail\n")


def test_a_shaft_needs_a_section_with_elasticity(run: Run) -> None:
    ran = run("shaft", "four_bar.yaml")
    said = "four_bar.yaml:1: no link has a section with elasticity; add section: {circle: 50 mm, elasticity: 210 GPa}"
    assert (ran.status, ran.out) == (2, "")
    assert re.sub(r"\s+", " ", ran.err).startswith(said)
