"""Sentences on friction over arcs of positions: jam, self-locking, undetermined efforts.

Mechanics: docs/theory.md 6.3.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.compile.contacts import friction_on
from dalembert.analysis.friction.joint_friction import NO_END, holds_beyond
from dalembert.analysis.status.closure_failure import drive_text, quantity_text
from dalembert.arrays import Array, Flags, Ints, first_largest
from dalembert.errors import ModelError

if TYPE_CHECKING:
    from dalembert.analysis.compile.compiled_mechanism import Compiled
    from dalembert.analysis.result.force_arrays import SolvedForces
    from dalembert.model import Mechanism


Check = tuple[str, Any, Callable[[Any], str]]
"""A status, where it holds (P,), and the sentence about position k."""


def refuse_friction(m: Mechanism) -> None:
    """Equilibrium positions are points only without friction."""
    if friction_on(m):
        what = "an unknown position with friction is not unique: every position of an arc is an equilibrium"
        remedy = "switch friction off, or give the positions and compute the interval of efforts"
        raise ModelError(what, remedy, ("drives",))


def friction_checks(c: Compiled, f: SolvedForces, solvable: Array) -> list[Check]:
    """Status, positions and sentence of each thing that friction can do; none without friction."""
    if f.friction is None:
        return []
    jammed = np.any([_jams(side) for side in _sides(f)], axis=0)
    return [
        ("redundant", f.friction.blocked & solvable, lambda k: _blocked_sentence(c)),
        ("at_rest", f.friction.open.any(axis=-1) & solvable, lambda k: _open_sentence(c, f, k)),
        ("jammed", jammed & solvable, lambda k: _jam_sentence(c, f, k)),
    ]


def locking_checks(c: Compiled, f: SolvedForces, solvable: Array) -> list[Check]:
    """Positions that lock themselves, whose numbers are known: for after all that leaves a position without numbers."""
    if f.friction is None:
        return []
    locked = np.any([_locks(side) for side in _sides(f)], axis=0)
    return [("self_locking", locked & solvable, lambda k: _locked_sentence(c, f, k))]


def _sides(f: SolvedForces) -> tuple[SolvedForces, ...]:
    """Forces just before reversals, and just after."""
    return (f,) if f.after is None else (f, f.after)


def _jams(f: SolvedForces) -> Array:
    assert f.friction is not None
    return ~np.isnan(f.friction.critical)


def _locks(f: SolvedForces) -> Array:
    assert f.friction is not None
    return f.friction.locked


def alone(f: SolvedForces) -> Flags:
    """Positions (P,) with a separate sentence: contacts reverse, and the status differs before and after, or is good
    on both sides."""
    if f.friction is None or f.after is None:
        return np.zeros(len(f.rcond), bool)
    differs = np.any([ask(f) != ask(f.after) for ask in (_jams, _locks)], axis=0)
    solved = ~_jams(f) & ~_locks(f)
    return np.asarray(f.friction.reversing.any(axis=-1) & (differs | solved))


def _side(f: SolvedForces, ask: Callable[[SolvedForces], Array], k: int) -> tuple[SolvedForces, str]:
    """Side of a position on which a condition holds, and its name where it holds on one of two."""
    flags = [bool(ask(side)[k]) for side in _sides(f)]
    if len(flags) == 1 or flags[0] == flags[1]:
        return f, ""
    side, word = (f, "before") if flags[0] else (_sides(f)[1], "after")
    return side, f", just {word} contacts reverse"


def reversal_checks(c: Compiled, f: SolvedForces) -> list[Check]:
    """Checks for reversing contacts, with a sentence on their effect."""
    if f.friction is None:
        return []
    return [("reversal", f.friction.reversing.any(axis=-1), lambda k: _reversal_sentence(c, f, k))]


def arc(c: Compiled, run: Ints) -> str:
    """' between 0 deg and 9 deg of O2', or ' at O2 = 9 deg'."""
    ends = [(n, *(drive_text(c, int(run[e]), k) for e in (0, -1))) for k, n in enumerate(c.schedule.names)]
    if not ends:
        return ""
    if len(run) == 1:
        return " at " + " and ".join(f"{n} = {a}" for n, a, _ in ends)
    return " between " + ", ".join(f"{a} and {b} of {n}" for n, a, b in ends)


def _unknowns(c: Compiled) -> list[str]:
    names = list(c.schedule.names)
    if c.forcing.turning is not None and c.forcing.turning.driven >= 0:
        names[c.forcing.turning.driven] = "the speed of turning"
    efforts = [n for n, efforts in zip(names, c.known.requested, strict=True) if efforts]
    return [*efforts, *c.unknown_loads]


def _kinds(c: Compiled) -> list[str]:
    """Kinds of the unknowns: forces or moments."""
    turns = c.layout.freedoms.angular[c.layout.driven][c.known.requested]
    return ["moment" if turning else "force" for turning in (*turns, *c.known.couple)]


JAMMED = "Friction jams the mechanism{arc}{side}: no effort moves it in this direction, whatever its size."
FREED = "It would move with less than {scale} times the coefficients of friction."
GRABS = "the brake grabs{arc}: from mu = {least} on it holds any torque (now {now})"
LOCKED = "Self-locking{arc}{side}: the load cannot drive the machine against its friction"
NEEDS = "{name} needs {rubbed} and without friction {bare}"
REVERSAL = "{joints} {verb}{arc}, so friction in it changes sense: {values}."
BOTH_SIDES = "{name} is {before} just before and {after} just after"
REST = "At rest{arc}: any value of {name}{range} holds the machine"
RANGES: dict[tuple[bool, ...], str] = {
    (True, True): " between the two impending motions",
    (True, False): " from the low end on",
    (False, True): " up to the high end",
    (False, False): "",
}
NO_RATE = "No relative motion in {joints}{arc}: {whose} friction may have any value within the limits, and {intervals}."


def _jam_sentence(c: Compiled, f: SolvedForces, run: Ints) -> str:
    f, side = _side(f, _jams, int(run[0]))
    assert f.friction is not None
    scale = float(np.nanmin(f.friction.critical[run]))
    if text := _grabbing(c, scale, run):
        return text
    return f"{JAMMED.format(arc=arc(c, run), side=side)} {FREED.format(scale=f'{scale:.6g}')}"


def _grabbing(c: Compiled, critical: float, run: Ints) -> str | None:
    """Why a mechanism jams whose only rubbing joints are brakes; None where there are others."""
    assert c.contacts is not None
    acting = ~c.contacts.fixed & (c.contacts.coefficient > 0)
    joints = [c.joints[k] for k in c.contacts.joint[acting]]
    if not joints or not all(c.mechanism.joints[name].BRAKES for name in joints):
        return None
    mu = float(c.contacts.coefficient[acting].max())
    text = GRABS.format(arc=arc(c, run), least=f"{critical * mu:.4g}", now=f"{mu:.4g}")
    return (
        f"{joints[0]}: {text}." if len(set(joints)) == 1 else f"{' or '.join(dict.fromkeys(joints))}: {text}."
    )


def _locked_sentence(c: Compiled, f: SolvedForces, run: Ints) -> str:
    f, side = _side(f, _locks, int(run[0]))
    assert f.friction is not None
    names = _unknowns(c)
    with_ = np.concatenate([f.effort[:, c.known.requested], f.load], axis=1)[run]
    bare = np.concatenate([f.friction.bare_effort[:, c.known.requested], f.friction.bare_load], axis=1)[run]
    worst = first_largest(np.abs(with_ - bare).sum(axis=1))
    figures = ", ".join(
        NEEDS.format(name=name, rubbed=quantity_text(c, kind, a), bare=quantity_text(c, kind, b))
        for name, kind, a, b in zip(names, _kinds(c), with_[worst], bare[worst], strict=True)
    )
    where = "" if len(run) == 1 else arc(c, run[[worst]])
    return f"{LOCKED.format(arc=arc(c, run), side=side)};{where} {figures}."


def _reversal_sentence(c: Compiled, f: SolvedForces, run: Ints) -> str:
    assert f.friction is not None
    assert f.after is not None
    assert c.contacts is not None
    k = int(run[0])
    joints = list(dict.fromkeys(c.joints[j] for j in c.contacts.joint[f.friction.reversing[k]]))
    verb = "reverses" if len(joints) == 1 else "reverse"
    before, after = (_values(c, side)[k] for side in (f, f.after))
    values = _and(
        [
            BOTH_SIDES.format(name=name, before=quantity_text(c, kind, a), after=quantity_text(c, kind, b))
            for name, kind, a, b in zip(_unknowns(c), _kinds(c), before, after, strict=True)
        ]
    )
    return REVERSAL.format(joints=_and(joints), verb=verb, arc=arc(c, run), values=values)


def _open_sentence(c: Compiled, f: SolvedForces, run: Ints) -> str:
    assert f.friction is not None
    open_ = f.friction.open[run]
    names = _unknowns(c)
    if not names:
        return (
            "A structure does not move: it holds any load, and friction may carry any part of it within its limits. "
            "Switch friction off for the reactions without it. To compute what friction holds, replace the joint "
            "held by friction by a drive at rest."
        )
    if not c.schedule.speed[run].any():
        return _rest_sentence(c, f, run, names)
    joints = list(dict.fromkeys(c.joints[k] for k in c.contacts.joint[open_.any(axis=0)]))  # type: ignore[union-attr]
    whose = "its" if len(joints) == 1 else "their"
    return NO_RATE.format(
        joints=", ".join(joints), arc=arc(c, run), whose=whose, intervals=_intervals(c, f, run, names)
    )


def _intervals(c: Compiled, f: SolvedForces, run: Ints, names: list[str]) -> str:
    """Sentence: which unknowns lie in an interval, and which have one value whatever the friction."""
    low, high = np.moveaxis(_ends(c, f, run), -1, 0)
    one: Flags = np.all(one_value(low, high), axis=0)
    wide, single = (
        [name for name, x in zip(names, one, strict=True) if x == which] for which in (False, True)
    )
    parts = [f"{_and(wide)} {'lies' if len(wide) == 1 else 'each lie'} in an interval"] if wide else []
    if single:
        parts.append(f"{_and(single)} {'does' if len(single) == 1 else 'do'} not depend on it")
    return "; ".join(parts)


def one_value(low: Array, high: Array) -> Flags:
    """Where both ends of what friction leaves open are one value."""
    return np.asarray(np.isclose(low, high, rtol=1e-12, atol=0.0))


def _values(c: Compiled, f: SolvedForces) -> Array:
    """Unknown efforts and loads (P, unknown)."""
    return np.concatenate([f.effort[:, c.known.requested], f.load], axis=1)


def _ends(c: Compiled, f: SolvedForces, run: Ints) -> Array:
    """Low and high end of each unknown (position, unknown, 2)."""
    every = np.stack([_values(c, end)[run] for end in f.ends], axis=-1)
    return np.stack([every[:, n, 2 * n : 2 * n + 2] for n in range(every.shape[1])], axis=1)


def _rest_sentence(c: Compiled, f: SolvedForces, run: Ints, names: list[str]) -> str:
    """At rest: what holds the machine, and where friction is at its limit."""
    if len(names) == 1:
        held = REST.format(arc=arc(c, run), name=names[0], range=RANGES[tuple(_there(c, f.ends[:2], run))])
        return f"{held}{_limits(c, f.ends[:2], run)}.{_histories(c, f, run, names)}"
    limits = "".join(
        f" For {name}{_limits(c, f.ends[2 * n : 2 * n + 2], run).replace(';', ',', 1)}."
        for n, name in enumerate(names)
    )
    return (
        f"At rest{arc(c, run)}: {_and(names)} each lie in an interval. At the ends of each, the machine is about "
        "to move with the other drives held, and the other unknowns have the values shown for that end; not every "
        f"combination of values within the intervals holds the machine.{limits}{_histories(c, f, run, names)}"
    )


def _histories(c: Compiled, f: SolvedForces, run: Ints, names: list[str]) -> str:
    """Range that friction can hold beyond the ends, depending on the earlier motion; empty where it is not larger."""
    assert f.friction is not None
    ends, held = _ends(c, f, run), f.friction.holding[run]
    beyond = holds_beyond(ends, held)
    if not beyond.any():
        return ""
    if len(run) > 1:
        count, some = int(beyond.any(axis=-1).sum()), np.flatnonzero(beyond.any(axis=0))
        where = f"{count} of these {len(run)}" if count < len(run) else "each of these"
        more = _and([names[n] for n in some])
        return f" After some earlier motions friction can hold values of {more} beyond them at {where} positions."
    return "".join(
        f" Motion impends at {_and([quantity_text(c, kind, v) for v in ends[0, n] if np.isfinite(v)] or ['none'])}; "
        f"with friction as an earlier motion may have left it, {name} can hold "
        f"{_range_text(c, kind, *held[0, n])}."
        for n, (name, kind) in enumerate(zip(names, _kinds(c), strict=True))
        if beyond[0, n]
    )


def _range_text(c: Compiled, kind: str, low: float, high: float) -> str:
    least, most = (quantity_text(c, kind, v) for v in (low, high))
    if np.isinf(low) and np.isinf(high):
        return "any value, its contacts wedged"
    if np.isinf(low):
        return f"any value up to {most}, below it with contacts wedged"
    return f"any value from {least} on, its contacts wedged" if np.isinf(high) else f"from {least} to {most}"


def _and(names: list[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _there(c: Compiled, ends: tuple[SolvedForces, ...], run: Ints) -> list[bool]:
    """True where the ends of an unknown's interval have a value at some of these positions."""
    return [bool(np.isfinite(_values(c, end)[run]).all(axis=1).any()) for end in ends]


def _limits(c: Compiled, ends: tuple[SolvedForces, ...], run: Ints) -> str:
    """Joints that are at their friction limit at the ends of an unknown's interval."""
    assert c.contacts is not None
    parts = []
    for end, name, there in zip(ends, ("low", "high"), _there(c, ends, run), strict=False):
        assert end.friction is not None
        if not there:
            parts.append(f"at the {name} end {NO_END}")
            continue
        at_limit = (end.friction.sense[run] != 0).any(axis=0) & ~c.contacts.fixed
        joints = ", ".join(dict.fromkeys(c.joints[k] for k in c.contacts.joint[at_limit]))
        parts.append(f"at the {name} end friction is at its limit in {joints or 'no joint'}")
    if (
        len(parts) == 2
        and NO_END not in "".join(parts)
        and parts[0].split(" in ")[1] == parts[1].split(" in ")[1]
    ):
        return f"; at both ends friction is at its limit in {parts[0].split(' in ')[1]}"
    return "".join(f"; {part}" for part in parts)


def _blocked_sentence(c: Compiled) -> str:
    return (
        "Friction follows reactions that statics does not determine here: constraints are redundant. "
        "Free a constraint, give the joints a stiffness, or switch friction off."
    )
