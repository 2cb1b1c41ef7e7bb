"""Random descriptions for the tests of the model: every kind of joint, drive, load and value."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hypothesis import strategies as st

from dalembert.model import (
    Answer,
    Box,
    Couple,
    Cylinder,
    Damper,
    Drive,
    Expression,
    ForceLoad,
    FrictionDefaults,
    Gear,
    GuideFriction,
    Link,
    Mechanism,
    Offset,
    Pin,
    PinFriction,
    Range,
    Rise,
    Rolling,
    SlenderBar,
    Slider,
    Slot,
    SlotFriction,
    Sphere,
    Spring,
    Table,
    TimeTable,
    TorsionDamper,
    TorsionSpring,
    Tube,
    Weld,
)

FOUR_BAR = (Path(__file__).parent / "four_bar.yaml").read_text(encoding="utf-8")
"""The whole file of the contract."""

numbers = st.floats(-1e9, 1e9, allow_nan=False)
positive = st.floats(1e-9, 1e9)
vectors = st.tuples(numbers, numbers)
texts = st.text(st.characters(exclude_categories=("Cs", "Cn")), max_size=20)
names = st.text(st.characters(categories=("L", "N", "S", "P", "Zs")), min_size=1, max_size=8).filter(
    lambda name: name == name.strip() and name.isprintable() and "." not in name and "@" not in name
)
TEXTS = ("500*sin(O)", "-O^2 + 3*cos(O/2)", "max(O, S)*1e-3", "(2)")


@st.composite
def tables(draw: st.DrawFn, against: str = "O", of: str = "") -> Table:
    """A table that a file can carry; `of` is the kind of y, which its factor makes another of."""
    x = sorted(draw(st.sets(st.floats(-3.0, 3.0), min_size=2, max_size=5)))
    y = draw(st.lists(numbers, min_size=len(x), max_size=len(x)))
    kind = draw(st.sampled_from(["linear", "cubic"]))
    period = draw(st.sampled_from([None, 6.283185307179586, 7.5]))
    times, of = draw(st.sampled_from([(1.0, ""), (0.3, ""), (-0.005, of)]))
    return Table(against, tuple(x), tuple(y), kind, period, times=times, shift=draw(st.floats(-7, 7)), of=of)


def varying(of: str, *units: str) -> st.SearchStrategy[Any]:
    """A number, an expression in one of the units, or a table."""
    return numbers | st.builds(Expression, st.sampled_from(TEXTS), st.sampled_from(units)) | tables(of=of)


forces, moments = varying("pressure", "N", "lbf", "kN"), varying("force", "N*m", "lbf*in")


@st.composite
def links(draw: st.DrawFn) -> Link:
    """A link with points P, Q and R."""
    weighed = draw(st.sampled_from(["mass", "weight", "none"]))
    keys: dict[str, Any] = {} if weighed == "none" else {weighed: draw(positive)}
    start = draw(st.sampled_from(["P", "center"]))
    points = {"P": draw(vectors), "Q": Offset(start, draw(vectors)), "R": Offset("Q", draw(vectors))}
    center = draw(st.none() | vectors)
    if draw(st.booleans()):
        placed = {"P": draw(vectors), "Q": Offset("P", draw(vectors))}
        return Link(
            points=placed | {"R": Offset("center", draw(vectors))}, shape=draw(shapes(bool(keys))), **keys
        )
    return Link(points=points, center=center, inertia=draw(positive), **keys)


@st.composite
def shapes(draw: st.DrawFn, weighed: bool) -> Any:
    """One shape, or several."""
    size = st.floats(1e-6, 1e3)
    density = {} if weighed else {"density": draw(size)}
    box = Box(size=(draw(size), draw(size), draw(size)), center=draw(st.none() | vectors), **density)
    long = {"length": draw(size), "axis": (draw(size), draw(size)), **density}
    inner = draw(size)
    others = (
        Sphere(radius=draw(size), **density),
        Cylinder(radius=draw(size), **long),
        Tube(radii=(inner, inner + draw(size)), **long),
        SlenderBar(area=draw(size), **long),
    )
    return draw(st.sampled_from((box, *others, (box, *others))))


@st.composite
def joints(draw: st.DrawFn) -> dict[str, Any]:
    """One of each kind."""
    ends: dict[str, Any] = {"links": ("ground", "a"), "at": draw(st.sampled_from(["P", ("P", "Q")]))}
    angle = draw(numbers)
    return {
        "O": Pin(friction=draw(st.none() | st.just(PinFriction(radius=0.1))), damping=draw(positive), **ends),
        "S": Slider(
            direction=angle, angle=draw(numbers), friction=GuideFriction(guide=(0.1, draw(positive))), **ends
        ),
        "T": Slot(
            direction=angle, friction=SlotFriction(coefficient=0.2), damping=(draw(positive), 0.5), **ends
        ),
        "W": Weld(angle=angle, **ends),
        "G": Gear(radii=(draw(positive), 3.0), **ends),
        "H": Gear(teeth=(20, 41), module=draw(positive), internal=True, pressure_angle=0.3, **ends),
        "R": Rolling(radius=draw(positive), direction=angle, **ends),
        "C": Rolling(radii=(5.0, draw(positive)), **ends),
    }


@st.composite
def drives(draw: st.DrawFn) -> dict[str, Any]:
    """A turn, two slides, and a turn by its own name."""
    law = draw(
        st.sampled_from(["harmonic", "cycloidal", "polynomial345"]).flatmap(
            lambda kind: st.builds(Rise, st.just(kind), numbers, numbers, positive, st.integers(2, 99))
        )
        | st.builds(TimeTable, st.just((0.0, 1.0, 2.5, 3.0)), st.tuples(*[numbers] * 4), st.integers(1, 99))
    )
    start = draw(numbers)
    return {
        "O": Drive(
            position=draw(numbers | st.lists(numbers, min_size=3, max_size=3)),
            effort=draw(st.none() | moments),
        ),
        "S": Drive(position=Range(start, draw(numbers), 3), speed=draw(numbers), freedom="slide"),
        "turn of T": Drive(joint="T", freedom="turn", law=law),
        "R": Drive(position="unknown", effort=draw(moments), range=(start, start + 1e3)),
    }


@st.composite
def loads(draw: st.DrawFn) -> dict[str, Any]:
    """One of each kind."""
    return {
        "F": ForceLoad(on="a", at="center", value=draw(forces), direction=draw(numbers), axes="link"),
        "V": ForceLoad(on="b", at=draw(vectors), value=(draw(forces), draw(forces))),
        "U": ForceLoad(on="b", at="R", value="unknown", direction=draw(numbers)),
        "M": Couple(on="a", value=draw(moments | st.just("unknown"))),
        "spring": Spring(between=["ground.P", "a.Q"], stiffness=draw(positive), free_length=draw(positive)),
        "damper": Damper(between=["b.center", "a.Q"], damping=draw(positive)),
        "coil": TorsionSpring(joint="O", stiffness=draw(positive), free_angle=draw(numbers)),
        "rotary": TorsionDamper(joint="T", damping=draw(positive)),
    }


@st.composite
def mechanisms(draw: st.DrawFn) -> Mechanism:
    """Any description that is right."""
    answer = Answer(quantity="effort", of="O", value=draw(numbers | texts), why=draw(st.none() | texts))
    return Mechanism(
        title=draw(texts),
        source=draw(texts),
        units={"length": draw(st.sampled_from(["m", "in"])), "angle": draw(st.sampled_from(["deg", "rad"]))},
        gravity=draw(st.sampled_from([None, "standard"]) | vectors),
        g=draw(st.none() | positive),
        links={draw(names): Link()}
        | {"ground": Link(points={"P": draw(vectors)}), "a": draw(links()), "b": draw(links())},
        joints=draw(joints()),
        drives=draw(drives()),
        loads=draw(loads()),
        friction=FrictionDefaults(coefficient=draw(positive), circle="tan", enabled=draw(st.booleans())),
        assembly={"a": draw(numbers), "b": draw(st.tuples(numbers, numbers, numbers))},
        answers=(answer,),
    )
