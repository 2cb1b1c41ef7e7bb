"""Every field and property of an answer as lines of text, so that a number that no other test reads is read here."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache, cached_property
from inspect import getattr_static
from pathlib import Path
from typing import Any

import numpy as np

import dalembert as da
from dalembert.analysis.result.result import Result
from dalembert.answer.answer import Answer
from dalembert.answer.column import WORD
from dalembert.bundled import cases, examples
from dalembert.errors import DalembertError
from dalembert.grading.mistakes import SolvedProblem
from dalembert.grading.wrong.wrong_problems import WrongProblems
from tests.answers.every_answer import MADE, ROCKER, made

ELEMENTS = Path(__file__).parents[1] / "elements"
LONG, DEEP, NOISE = 8, 2, 1e-9
"""Items of a list that are shown, objects inside objects, and the part of the largest number (at least 1) below which
a number is rounding."""
CHECKS = {
    "residual",
    "power_balance",
    "closure",
    "energy_residual",
    "law_residual",
    "gap",
    "seconds",
    "doubt",
    "rcond",
    "change",
    "phase",
}
"""Rounding, time, and the angle of what may be 0: tested elsewhere, with wrong answers."""

AGREES = re.compile(r"(?<![\w.])\de-0\d\b|Checks?:.*?(?=\n\n|\Z)", re.DOTALL)
"""How well something agrees, in printed texts."""
PLACES = "place", "file"
"""Columns that are chance: where a value that is 0 throughout is extreme, a folder."""


def model(name: str) -> da.Mechanism:
    return da.load((cases() | examples())[name])


def read_out(x: Any, name: str, deep: int = DEEP) -> Iterator[str]:
    """A line for each number, text or list; of an object one for each field and property."""
    if (said := short(x)) is not None:
        yield f"{name}: {said}"
    elif isinstance(x, Mapping):
        for key in (k for k in x if k not in CHECKS):
            yield from read_out(x[key], f"{name} {key}", deep)
    elif isinstance(x, tuple | list):
        for k, value in enumerate(x[:LONG]):
            yield from read_out(value, f"{name} {k + 1}", deep)
    elif deep and type(x).__module__.startswith("dalembert") and not isinstance(x, Result | da.Mechanism):
        for key in sorted(names(x) - CHECKS):
            try:
                value = getattr(x, key)
            except DalembertError as error:
                value = f"refused: {error}"
            yield from read_out(value, f"{name}.{key}", deep - 1)


def names(x: object) -> set[str]:
    """Public fields and properties; of an answer those that a record is made of are in its own text."""
    own = {*getattr(x, "__dataclass_fields__", {}), *getattr(type(x), "_fields", ())}
    found = {k for c in type(x).__mro__ for k in vars(c) if c is not Answer}
    own |= {k for k in found if isinstance(getattr_static(type(x), k), property | cached_property)}
    return {k for k in own if not k.startswith("_")}


def short(x: Any) -> str | None:
    """A plain value, or an array by its shape, first values, least, greatest and sum; None of what has parts."""
    if x is None or isinstance(x, bool | int | str | np.bool_):
        return str(x)
    if isinstance(x, float | complex | np.number):
        return number(x)
    if isinstance(x, tuple | list) and x and all(isinstance(v, float | int) for v in x):
        x = np.array(x, float)
    if not isinstance(x, np.ndarray) or x.dtype.kind not in "bifc":
        return (
            " | ".join(map(str, x))
            if isinstance(x, tuple | list) and all(isinstance(v, str) for v in x)
            else None
        )
    x = x.astype(float) if x.dtype.kind != "c" else x
    size = max(1.0, float(np.abs(x[np.isfinite(x)]).max(initial=0.0)))
    first = " ".join(number(v, size) for v in x.ravel()[:LONG])
    some = x[np.isfinite(x)]
    ends = (
        f"; {number(some.min(), size)} to {number(some.max(), size)}"
        if some.size and x.dtype.kind == "f"
        else ""
    )
    return f"{x.shape} {first}{ends}; sum {number(some.sum(), size * max(1, some.size))}"


def number(x: Any, size: float = 1.0) -> str:
    """Five digits; what is rounding beside a size is 0.

    >>> number(3.14159265), number(1e-12), number(1e-12j), number(np.nan)
    ('3.1416', '0', '0', 'nan')
    """
    if isinstance(x, complex | np.complexfloating):
        parts = number(x.real, size), number(x.imag, size)
        return parts[0] if parts[1] == "0" else " + j ".join(parts)
    return "0" if abs(x) < NOISE * size else f"{x:.5g}"


def told(x: Any) -> str:
    """All that an answer says: its printed text, the numbers of its record, its columns; of others their fields."""
    if not isinstance(x, Answer):
        return "\n".join(read_out(x, type(x).__name__))
    some = [c for c in x.columns() if not c.name.endswith(PLACES)]
    columns = {c.name: c.values[:] if c.kind != WORD else [*map(str, c.values[:])] for c in some}
    head = {k: v for k, v in x.to_dict().items() if k != x.ROWS}
    fields = read_out(x, type(x).__name__) if type(x).__name__ not in MADE else ()
    text = AGREES.sub("~", str(x))
    return "\n".join([text, "", *read_out(head, "record"), "", *read_out(columns, "column"), *fields])


@cache
def solved(name: str, positions: int | None = None) -> Any:
    return da.solve(model(name), positions=positions) if positions else da.solve(model(name))


def of(template: str, **sizes: Any) -> Any:
    return da.solve(getattr(da, template)(**sizes))


def kind(r: Any, *types: str) -> str:
    """The first joint of one of some types."""
    return next(n for n, j in r.mechanism.joints.items() if j.type in types)


def brakes() -> Any:
    r = da.solve(da.load(ELEMENTS / "brakes.yaml"))
    return {
        n: r.brake(n) for n, j in r.mechanism.joints.items() if j.type in ("shoe", "band", "disc", "cone")
    }


def cam() -> Any:
    """Without its least base, which is sought for seconds."""
    c: Any = made("CamDesign")
    read = "pressure_angle_peak", "pressure_angle_return", "least_convex_radius", "force", "changes", "jumps"
    return {k: getattr(c, k) for k in read} | {column.name: column.values for column in c.columns()}


def rubbing(name: str) -> Any:
    """What friction adds to an answer, joint by joint; both sides where a motion reverses, both ends at rest."""
    r = solved(name)
    read = "friction_force", "friction_moment", "power_lost", "least_norm", "reaction_moment", "unique"
    found: dict[str, Any] = {f"{k} {j}": getattr(r, k)(j) for j in r.joints for k in read}
    found |= {f"interval {n}": r.interval(n) for n in (*r.drives, *r.unknown_loads)}
    found |= {f"holding {n}": r.holding(n) for n in r.drives}
    return found | {"problems": [" ".join(map(str, p)) for p in r.problems()], "efficiency": da.efficiency(r)}


def engines() -> dict[str, da.Mechanism]:
    return {"in line": da.in_line_engine(), "v": da.v_engine(), "radial": da.radial_engine()}


@cache
def solved_crank() -> Any:
    return da.dynamics(da.slider_crank(crank=0.05, rod=0.2), positions=12)


def made_result(path: str, value: object) -> Any:
    return da.dynamics(solved_crank().mechanism.with_values({path: value}), positions=12)


def gyroscope(name: str) -> Any:
    r = solved(name)
    return [da.gyroscopic(r, link) for link in r.links if spins(r, link)]


def spins(r: Any, link: str) -> bool:
    try:
        return link != "ground" and bool(da.gyroscopic(r, link))
    except DalembertError:
        return False


def pinned() -> Any:
    size = {"diameter": "20 mm", "eye": "30 mm", "cheeks": "15 mm", "yield_stress": "300 MPa"}
    m = da.slider_crank(crank=0.05, rod=0.2).with_values({"joints.A.pin": size})
    return da.pin(da.dynamics(m, positions=8), "A")


def mistakes(name: str) -> Any:
    """What is said of each known mistake, its figures as a student rounds them."""
    problem, found = SolvedProblem(model(name)), {}
    r = problem.result
    for k, wrong in enumerate(WrongProblems(r, [0]).usual()):
        if (other := wrong.solution()) is not None and other.ok[0]:
            force, effort = other.reaction(r.joints[-2])[0], other.effort(r.drives[0])[0]
            answers = [
                da.Answer(quantity="effort", of=r.drives[0], value=f"{effort:.4g} N*m"),
                da.Answer(quantity="reaction", of=r.joints[-2], value=[f"{x:.4g} N" for x in force]),
            ]
            found[f"{k + 1}, {wrong.sentence}"] = [" | ".join(map(str, v)) for v in problem.verdicts(answers)]
    return found


WRONG = {
    "four-bar": ("seed-003-norton-11-3-gravity", 0),
    "quick return": ("quick_return", 8),
    "engine with friction": ("seed-002-7a-engine-friction-circles", 0),
    "teeth": ("gear_train", 3),
    "space": ("sp-11-ladder-on-two-rails", 0),
    "lever": ("st-08-two-levers", 0),
}
"""Machines and a position of each at which every wrong problem is solved."""


def wrongs(name: str) -> str:
    """A line for every wrong problem: how usual it is, its extent, its words, what it gives for the first unknown and
    two of the joints."""
    case, place = WRONG[name]
    r = solved(case)
    lines = []
    for wrong in WrongProblems(r, [place]):
        other = wrong.solution()
        if other is None or not other.ok[0]:
            lines.append(f"{wrong.order} {wrong.weight} {wrong.sentence}: {other and other.status[0]}")
            continue
        some = [*(other.effort(d)[0] for d in r.drives), *(other.unknown_load(n)[0] for n in r.unknown_loads)]
        some += [x for j in (r.joints[0], r.joints[-2]) for x in other.reaction(j)[0]]
        size = max(1.0, float(np.nanmax(np.abs(some))))
        numbers = " ".join(number(x, size) for x in some)
        lines.append(f"{wrong.order} {wrong.weight} {wrong.sentence}: {numbers}")
    return "\n".join(lines)


def studied() -> Any:
    s = da.study(
        da.four_bar(), {"links.coupler.mass": "± 5 %", ROCKER: "± 1 mm"}, ["effort.O2"], designs=64, seed=5
    )
    return {"contributions": s.contributions("effort.O2"), "worst case": s.worst_case("effort.O2")}


CALLS: dict[str, Callable[[], Any]] = {
    "belt": lambda: of("belt_drive").belt("belt"),
    "brakes": brakes,
    "cam": cam,
    "clutch": lambda: (r := of("plate_clutch")).brake(kind(r, "disc")),
    "rope": lambda: (r := of("hoist")).rope(next(iter(r.mechanism.ropes))),
    "cylinder": lambda: (r := solved("excavator")).cylinder(r.drives[0]),
    "screw": lambda: (r := of("screw_jack")).screw(r.drives[0]),
    "ratchet": lambda: (r := of("ratchet")).one_way(kind(r, "ratchet", "one_way")),
    "power flow": lambda: of("planetary_train").power_flow(),
    "porter governor": lambda: da.governor(da.porter_governor()),
    "hartnell governor": lambda: da.governor(da.hartnell_governor()),
    "governor with friction": lambda: da.governor(model("gov-12-porter-governor-with-friction")),
    "isochronous governor": lambda: da.governor(
        da.hartnell_governor(preload="1400 N", sweep=("30 deg", "-40 deg"), positions=15)
    ),
    "engine series": lambda: {
        n: da.engine_series(da.dynamics(m, positions=24)) for n, m in engines().items()
    },
    "bearing": lambda: da.bearing(
        made_result("joints.A.bearing", {"rating": "12 kN", "static_rating": "9 kN"}), "A"
    ),
    "member": lambda: da.member_forces(solved("four_bar"), "coupler"),
    "pin": pinned,
    "flywheel size": lambda: da.flywheel_size(56e3, 12.5, inertia=21060),
    "harmonics": lambda: [
        da.dynamics(da.slider_crank(), positions=24).harmonics(q) for q in ("effort.O2", "reaction.A")
    ],
    "friction at rest": lambda: rubbing("seed-002-7d-engine-at-rest"),
    "friction in motion": lambda: rubbing("seed-002-7gb-engine-guide-10-mm"),
    "friction circle": lambda: da.friction_circles(solved("seed-002-7a-engine-friction-circles"), "A"),
    "guide": lambda: (
        (r := solved("seed-002-7gb-engine-guide-10-mm")) and da.guide_contact(r, kind(r, "slider"))
    ),
    "superposition": lambda: da.superposition(solved("four_bar")),
    "virtual work": lambda: da.virtual_work(solved("four_bar")),
    "order": lambda: {n: da.order_of_solution(solved(n)) for n in ("four_bar", "pump", "truss")},
    "shares of inertia": lambda: da.inertia_shares(solved("four_bar")),
    "mobility": lambda: {
        n: da.mobility(m) for n, m in (("bennett", da.bennett()), ("truss", model("truss")))
    },
    "paper": lambda: da.solution(solved("pump")),
    "motor": lambda: da.motor(da.dynamics(model("engine"), positions=24), inertia=1e-3),
    "clearance": lambda: da.clearance_error(solved_crank(), "piston", "B", {"A": 1e-5, "B": 2e-5}),
    "gyroscope": lambda: gyroscope("sp-04-spinning-disk-on-a-turning-arm"),
    "study": studied,
    "sweep together": lambda: da.sweep(
        da.four_bar(), {"links.coupler.mass": [1.0, 2.0], ROCKER: [0.2, 0.25]}, together=True
    ),
    "variants": lambda: da.variants(
        model("four_bar"), {"loads.T_4.value": "100..140 step 10"}, count=3, seed=7, ask=["effort.O2"]
    ),
    "mistakes": lambda: mistakes("four_bar"),
}
"""A call of each kind that has no class of an answer, or one whose fields its record leaves out."""
SOUGHT = "CamDesign", "Front"
"""A least base that is sought for seconds, and designs as near to the best as their search ends: tested elsewhere."""
READ: dict[str, Callable[[], str]] = {
    **{f"answer-{n}": lambda n=n: told(made(n)) for n in MADE if n not in SOUGHT},  # type: ignore[misc]
    **{f"wrong-{n.replace(' ', '-')}": lambda n=n: wrongs(n) for n in WRONG},  # type: ignore[misc]
    **{f"fields-{n.replace(' ', '-')}": lambda call=call: told(call()) for n, call in CALLS.items()},  # type: ignore[misc]
}
