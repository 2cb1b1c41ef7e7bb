"""Printed answers of machines of every kind: a position in full and every column of it, several in a table."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

import dalembert as da
from dalembert.answer.column import WORD
from dalembert.model.library import TEMPLATES, template
from tests.approved.read_out import AGREES, ELEMENTS, model, number, read_out
from tests.friction.engines import engine
from tests.friction.test_unpowered_loads import brake
from tests.laws.test_contacts import crate
from tests.laws.test_scale import crank
from tests.laws.test_springs import block

CLOSED = re.compile(r"\s*\bresidual\s[^\s,]+(,\s+power\s+balance\s\S+)?", re.IGNORECASE)
"""How well equilibrium holds: rounding."""
PLAIN = (
    *("whitworth", "crank_shaper", "watt_1", "watt_2", "stephenson_1", "stephenson_2", "stephenson_3"),
    *("v_engine", "radial_engine", "press_with_flywheel"),
)
"""Templates that print no other tables than those with fewer links."""
CASES = {
    "at rest": (
        *("fr-01-pulley-on-a-fixed-shaft", "fr-03-wedge-under-a-block", "fr-05-clamp-tightened"),
        *("fr-06-turnbuckle", "seed-001-ea-block-at-rest", "gov-12-porter-governor-with-friction"),
    ),
    "guides": (
        *("seed-001-ca-collar-0-mm", "seed-001-cd-collar-250-mm", "seed-001-da-guide-lower-face"),
        *("seed-001-dd-guide-lower-behind-and-upper-ahead", "seed-001-eb-block-sliding"),
        *("seed-f-2a-rod-at-45-deg-03", "seed-f-2d-rod-at-45-deg-12"),
    ),
    "friction": (
        *("fri-1-eccentric-with-friction-circles", "sc-08-horizontal-engine-with-given-friction"),
        *("seed-002-7g-engine-guide-100-mm", "seed-002-7b-engine-friction-circles-sine"),
    ),
    "brakes": ("brk-1-simple-band-brake", "brk-4-pivoted-block-brake", "clu-4-centrifugal-clutch"),
    "turning": ("gov-11-watt-governor", "gov-14-hartnell-governor", "dk-05-unbalanced-flywheel"),
    "several positions": (
        *("seed-002-1-four-link-open", "vw-02-drum-with-spring-and-weight", "balance_position"),
        *("st-01-slider-crank-4kn", "su-01-engine-inertia-and-weight", "two_drives"),
    ),
    "space": (
        *("sp-01-swinging-body-on-an-inclined-revolute", "sp-04-spinning-disk-on-a-turning-arm"),
        *("sp-06a-hooke-joint-with-flywheel", "sp-11-ladder-on-two-rails", "sp-12-spatial-slider-crank"),
    ),
    "held": ("st-12-a-frame-18-kn", "truss", "vw-01-hydraulic-lift", "st-09-beam-on-a-strut", "gear_train"),
}
WRITTEN = {
    "element_cases": (1, 2, 3, 5, 6, 8, 9, 10, 11, 13, 14, 15),
    "brake_cases": (2, 3, 9, 10, 11, 12, 13),
    "belt_cases": (1, 3),
    "cam_cases": (3, 4),
}
"""Files of machines with elements: which of their cases."""
RISE = {"segments": [{"to": 0.02, "in": 0.1, "by": "parabolic"}], "count": 5}


def rubs(count: int = 7) -> da.Mechanism:
    """An engine whose contacts reverse twice a turn."""
    m = model("seed-002-7g-engine-guide-100-mm")
    turn = {"from": 0, "to": "270 deg", "count": count}
    return m.with_values({"drives.O.position": turn, "drives.O.speed": 10.0})


def jumps() -> da.Mechanism:
    """A ram whose acceleration jumps in the middle of its stroke."""
    links = {
        "ground": {"points": {"O": [0, 0]}},
        "ram": {"points": {"F": [0, 0]}, "mass": 3, "center": [0, 0]},
    }
    slide = {"S": {"type": "slider", "links": ["ground", "ram"], "at": ["O", "F"]}}
    return da.mechanism({"title": "Ram", "links": links, "joints": slide, "drives": {"S": {"law": RISE}}})


def changed(name: str, **values: Any) -> Callable[[], da.Mechanism]:
    """A template at four positions of its drive."""

    def made() -> da.Mechanism:
        m = template(name)
        start, end = m.schedule(2).position[:, 0]
        some = [float(start + part * (end - start)) for part in (0.03, 0.2, 0.45, 0.7)]
        places = {f"drives.{m.schedule().names[0]}.position": some}
        return m.with_values(places | {k.replace("__", "."): v for k, v in values.items()})

    return made


TROUBLED: dict[str, Callable[[], da.Mechanism]] = {
    "does not close everywhere": changed("four_bar", links__coupler__points__B__0=0.1),
    "slips": changed("belt_drive", loads__work__value=-150),
    "out of stroke": changed("cylinder_boom", drives__C__cylinder__stroke=0.3),
    "slack": changed("hoist", drives__D__acceleration=-1e4),
    "too large": changed("four_bar", links__coupler__mass=1e308, links__rocker__mass=1e308),
    "lifts off": lambda: crate(-5),
    "without a direction": lambda: block([-0.001, 0, 0.001]),
    "redundant": lambda: crank(1.0, True, twin=True),
    "without a balance": lambda: brake(0.385, -83),
    "reverses": rubs,
    "locks itself": lambda: engine(position=[1, 2, 3, 12]),
    "jumps": jumps,
}
"""Machines that some or all positions trouble."""


def printed(m: da.Mechanism, axes: str) -> str:
    """The second of four positions in full, with its columns, and the table of the four."""
    one = da.solve(m, positions=m.schedule(4).position[1:2])
    return "\n\n".join([full(one, axes=axes), "\n".join(numbers(one)), full(da.solve(m, positions=4))])


def full(r: da.Result, **choice: Any) -> str:
    return AGREES.sub("~", CLOSED.sub(" ~", r.text(**choice)))


def numbers(r: da.Result, **choice: Any) -> Iterator[str]:
    """A line for each column that is neither 0 nor unknown throughout."""
    for c in r.columns(**choice):
        values = c.values[:]
        if c.kind == WORD:
            yield f"{c.name}: {' | '.join(map(str, values))}"
            continue
        size = float(np.abs(values[np.isfinite(values)]).max(initial=1.0))
        shown = [number(x, size) for x in np.ravel(values)]
        if not set(shown) <= {"0", "nan"}:
            yield f"{c.name} [{c.kind}]: {' '.join(shown)}"


def kind(name: str) -> str:
    """Templates with elements are printed apart from linkages."""
    linkage = {"pin", "slider", "slot", "revolute", "prismatic", "cylindrical", "spherical", "universal"}
    return "printed" if {j.type for j in template(name).joints.values()} <= linkage else "element"


def of_template(name: str) -> Callable[[], str]:
    m = template(name)
    return lambda: printed(m, "joint" if "space" in m.to_tree() else "link")


def of_cases(names: tuple[str, ...]) -> Callable[[], str]:
    """Their printed texts, in the units of the file, and the record of their first position."""

    def text(name: str) -> str:
        r = da.solve(model(name))
        return "\n\n".join([full(r), "\n".join(read_out(next(iter(r.records("file"))), "record"))])

    return lambda: "\n\n\n".join(map(text, names))


def of_written(name: str, which: tuple[int, ...]) -> Callable[[], str]:
    """Their printed texts, in SI."""
    cases = json.loads((ELEMENTS / f"{name}.json").read_text(encoding="utf-8"))
    return lambda: "\n\n\n".join(full(da.solve(da.loads(cases[k]["file"])), units="SI") for k in which)


def troubled(name: str) -> Callable[[], str]:
    def text() -> str:
        r = da.solve(TROUBLED[name]())
        problems = [" | ".join(words) for words in r.problems()]
        return "\n\n".join([full(r), *problems, "\n".join(numbers(r))])

    return text


PRINTED: dict[str, Callable[[], str]] = {
    **{f"{kind(name)}-{name}": of_template(name) for name in TEMPLATES if name not in PLAIN},
    **{f"cases-{name.replace(' ', '-')}": of_cases(some) for name, some in CASES.items()},
    **{f"element-{name.replace('_', '-')}": of_written(name, some) for name, some in WRITTEN.items()},
    **{f"troubled-{name.replace(' ', '-')}": troubled(name) for name in TROUBLED},
}
