"""Every equation, table and matrix of a worked solution, read as it is printed, gives what is printed behind it."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.cli.method_text import superposition_text, virtual_work_answer
from dalembert.reports.sections import friction, given
from dalembert.reports.sections.force_system_solution import force_system_sheet
from dalembert.reports.sheet import Equations, Matrix, ReportSheet, SheetTable
from dalembert.reports.working import working
from dalembert.units import Units
from dalembert.views import draw
from dalembert.views.notation import Notation
from dalembert.views.paper.scene import Scene
from tests.methods.printed_equations import Reader
from tests.methods.printed_tables import read_sheet
from tests.random_mechanisms import random_case
from tests.random_space import random_case as random_space_case
from tests.space.test_laws import solved as solved_in_space
from tests.tiers import over, sampled, tiers
from tests.wrench.random_systems import DIMENSIONS, random_system

SYSTEMS = {
    "SI": Units(),
    "mm N kg": Units(length="mm"),
    "in lbf blob": Units(length="in", force="lbf", mass="blob"),
    "ft kip slug": Units(length="ft", force="kip", mass="slug"),
    "mm N t": Units(length="mm", mass="t"),
    "cm kgf kg": Units(length="cm", force="kgf"),
    "in ozf lbm": Units(length="in", force="ozf", mass="lbm", time="min", angle="rad"),
    "mm N, rpm": Units(length="mm", derived=(("angular_speed", "rpm"), ("angular_acceleration", "rpm/s"))),
    "mm N, N m": Units(length="mm", derived=(("moment", "N*m"), ("acceleration", "m/s^2"))),
}
PRINTED = {
    name: replace(u, derived=(*u.derived, ("power", "W"), ("energy", "J"))) if u.force == "N" else u
    for name, u in SYSTEMS.items()
}
"""Powers and energies of metric files are printed in W and J."""
QUICK = (
    "four_bar",
    "rssr",
    "seed-002-7a-engine-friction-circles",
    "gear_train",
    "quick_return",
    "seed-001-da-guide-lower-face",
    "sp-04-spinning-disk-on-a-turning-arm",
    "ba-07-partly-balanced-slider-crank",
)
DRAWN = [
    "free_body",
    "velocity_polygon",
    "acceleration_polygon",
    "displaced_inertia",
    "force_chain",
    "force_system",
]
BUNDLED = sorted(cases() | examples())


@cache
def mechanism(name: str) -> Any:
    return da.load((cases() | examples())[name])


@pytest.fixture(autouse=True)
def no_drawings(monkeypatch: pytest.MonkeyPatch) -> None:
    """Drawings have no equations, and take most of the time."""
    for name in DRAWN:
        monkeypatch.setattr(draw, name, lambda *_, **__: Scene(()))
    monkeypatch.setattr(given, "stated_picture", lambda *_: Scene(()))
    monkeypatch.setattr(friction, "friction_pictures", lambda *_: ())


def in_units(m: Any, system: str) -> Any:
    """The same mechanism, its numbers in other units."""
    return m.model_copy(update={"units": SYSTEMS[system]})


ALONE = (
    r"[^=]* = [^=]*",  # a number by itself, used by the lines that follow
    r"ω_\S+ = [^=]*, α_\S+ = [^=]*",  # rates in a link's own axes, likewise
    r"S_\S+ = \|N_\S+\| = [^=]*",  # the normal force has no line of its own
    r"θ \(tan .*|x R_y − .*|[rM] = R .*",  # the line of action of a resultant, by its unread letters
    r"N_\S+ = \(S_\S+ [+−] N_\S+\)/\(2\) = [^=]*",
)
"""Equations with nothing to be compared with."""


def read(sheet: ReportSheet, figures: int = 4, units: Units | None = None) -> Reader:
    """Read all of it; none of its equations is left out, and each but those of `ALONE` is compared with something."""
    reader = read_sheet(sheet, figures, units)
    lines = [w for b in sheet.blocks if isinstance(b, Equations) for w in b.lines]
    assert reader.lines == sum("=" in f"{w.letters}{w.numbers}" or bool(w.result) for w in lines)
    assert [text for text in reader.idle if not any(re.fullmatch(alone, text) for alone in ALONE)] == []
    return reader


def worked(m: Any, **notation: Any) -> ReportSheet:
    """Without drawings of the graphical method, which have no equations."""
    r = da.solve(m, positions=2) if any("count" in str(d) for d in m.drives.values()) else da.solve(m)
    return working(
        r, 2 if len(r.status) > 1 else 1, ("matrix", "superposition", "virtual-work"), Notation(**notation)
    )


NOW = [(n, s) for n in QUICK for s in SYSTEMS if n in QUICK[:3] or s == "mm N kg"]
LATER = [(n, s) for n in BUNDLED for s in SYSTEMS if (n, s) not in NOW]
TURNS = {(n, list(SYSTEMS)[k % len(SYSTEMS)]) for k, n in enumerate(BUNDLED)}
"""Every file in one of the systems, all of which have their turn."""


@pytest.mark.parametrize(
    "which",
    tiers(NOW, [w for w in LATER if w in TURNS], [w for w in LATER if w not in TURNS]),
    ids=str,
)
def test_everything_adds_up_as_printed(which: tuple[str, str]) -> None:
    name, system = which
    read(worked(in_units(mechanism(name), system)), units=PRINTED[system])


def test_how_much_is_read() -> None:
    """Equations, comparisons, and signs that mean the same number in two places."""
    found = {name: read(worked(mechanism(name))) for name in ("four_bar", "rssr")}
    assert {n: r.lines for n, r in found.items()} == {"four_bar": 26, "rssr": 47}
    assert found["four_bar"].compared >= 70
    assert found["four_bar"].same >= 40
    assert found["rssr"].compared >= 100
    assert found["rssr"].same >= 60


EVERY = *QUICK[2:4], "4b-01-norton-11-3-rounded-masses"
REST = [n for n in BUNDLED if n not in QUICK[2:4]]
LONG = [n for n in REST[::4] if n not in EVERY]


@pytest.mark.parametrize(
    "notation",
    [{"figures": 9}, {"torque": -1}, {"axes": "link"}, {"order": "on-by", "letter": "G", "links": "name"}],
    ids=str,
)
@pytest.mark.parametrize("name", tiers(EVERY, LONG, [n for n in REST if n not in (*EVERY, *LONG)]))
def test_in_every_notation(name: str, notation: dict[str, Any]) -> None:
    m = mechanism(name)
    if m.dimension == 3:
        notation = {
            key: value for key, value in notation.items() if key != "torque"
        }  # its sign is the plane's
    read(worked(m, **notation), notation.get("figures", 4))


@over(0, 50)
def test_of_random_mechanisms(seed: int) -> None:
    system = list(SYSTEMS)[seed % len(SYSTEMS)]
    read(worked(in_units(da.mechanism(random_case(seed).tree), system)), units=PRINTED[system])
    r = solved_in_space(random_space_case(seed), inertia=seed % 3 > 0)
    read(
        working(da.solve(in_units(r.mechanism, system)), 1, ("matrix", "virtual-work")), units=PRINTED[system]
    )


@pytest.mark.parametrize("dimension", DIMENSIONS)
@pytest.mark.parametrize("seed", tiers(range(2), range(2, 12), range(12, 60)))
def test_of_force_systems(seed: int, dimension: int) -> None:
    for system in SYSTEMS.values():
        s = random_system(seed, dimension)
        sheet = force_system_sheet(da.wrench.System(*s.parts, units=system))
        reader = read(sheet, units=system)
        assert reader.compared >= 3
        assert any(isinstance(b, SheetTable) for b in sheet.blocks)


NOISY = ("balance_position", "ba-01-rotor-with-four-masses", "sp-05-hooke-joint-greatest-acceleration")


@pytest.mark.parametrize("name", sampled(NOISY, BUNDLED))
def test_rounding_is_printed_as_0(name: str) -> None:
    """In the answer, both methods and the worked solution; only what is left of a sum that should be 0 is said."""
    r = da.solve(mechanism(name))
    texts = [str(r), str(da.report(r))]
    for method in (superposition_text, virtual_work_answer):
        with suppress(da.ModelError):
            found = method(r, "file")
            texts.append(found if isinstance(found, str) else found[1])
    checks = "Residual|Out-of-balance|gap|parts sum|sum to the total|agree|polygons over|forces over"
    said = rf"(?si)\n[^\n]*(?:{checks})[^\n]*(?:\n[^\n]+)*"
    for text in texts:
        assert not re.search(r"\d[eE][-−](?:0[89]|[1-9]\d)", re.sub(said, "", text))


@pytest.mark.parametrize(
    "line",
    [
        "F_I2 = −m_2 a_G2 = −2.000 (−10000, 4000) = (20.00, −8.000) = 21.54 N ∠ −21.80 °",
        "r_O = R_O sin (arctan μ_O) = 20.00 sin 0.09 ° = 0.03000 mm",
        "F_I2 = −m_2 a_G2 = −2.000 (−10.00, 4.000) = (20.00, −8.000) = 21.54 N ∠ −111.80 °",
        "Σ F_x: F_12x + F_32x = −117.6 + 118.0 = 0 lbf",
        "h_2 = (|T_I2|)/(F_I2) = (200.0)/(21.54) = 9.385 mm",
        "T_I3' = −((1.000, 2.000, 3.000) + (0, 0, 1.000)) = (−1.000, −2.000, 4.000) N·m, link axes",
    ],
)
def test_the_reader_finds_what_is_wrong(line: str) -> None:
    reader = Reader()
    with pytest.raises(AssertionError):
        reader.line(line)


def test_a_sign_is_one_number() -> None:
    reader = Reader()
    reader.line("T_12 = 243.2 N·m")
    with pytest.raises(AssertionError, match="T_12 is two things"):
        reader.line("Σ M_O: R_Ax F_32y + T_12 = (2.000)(121.6) − 243.2 = 0 N·m")


def test_matrices_are_read() -> None:
    sheet = worked(mechanism("four_bar"))
    (k,) = (k for k, b in enumerate(sheet.blocks) if isinstance(b, Matrix))
    matrix = sheet.blocks[k]
    assert isinstance(matrix, Matrix)
    sheet.blocks[k] = Matrix(matrix.rows, matrix.unknowns, ("1.000", *matrix.right[1:]), matrix.values)
    with pytest.raises(AssertionError):
        read_sheet(sheet)


@pytest.mark.parametrize("column", [1, 2, 6, 7, 8])
def test_laws_are_read(column: int) -> None:
    """A length, a way or a peak of a rise that is 1 % off is found."""
    sheet = worked(mechanism("cam_and_follower"))
    (k,) = (k for k, b in enumerate(sheet.blocks) if isinstance(b, SheetTable) and b.heads[0] == "Curve")
    table = sheet.blocks[k]
    assert isinstance(table, SheetTable)
    *others, row = table.rows
    off = f"{1.01 * float(row[column].replace('−', '-')):.6g}".replace("-", "−")
    sheet.blocks[k] = replace(table, rows=(*others, (*row[:column], off, *row[column + 1 :])))
    with pytest.raises(AssertionError, match=re.escape(str([*row[:column], off, *row[column + 1 :]]))):
        read_sheet(sheet)
