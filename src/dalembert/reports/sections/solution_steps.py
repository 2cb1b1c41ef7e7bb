"""The solution as on paper: each step in letters, in numbers, and its result, with the free body beside it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np

from dalembert.analysis.methods.applied_forces import other_actions
from dalembert.analysis.methods.members import members
from dalembert.analysis.methods.solved.carried_out import ForceNumber, ForceSteps, SolvedStep, StepTerm
from dalembert.analysis.methods.solved.paper_equations import PaperEquation
from dalembert.analysis.methods.solved.relative_rates import distance
from dalembert.analysis.methods.solved.unknown_forces import UnknownForce
from dalembert.arrays import Array
from dalembert.printing import remainder
from dalembert.reports.report_context import ReportContext
from dalembert.reports.sections.terms import join_signed
from dalembert.reports.sheet import Equations, Paragraph, ReportSheet, Text, Working
from dalembert.views import draw
from dalembert.views.notation import along, load_sign

SHORT = 2
"""Letters of a joint's name up to which a distance between two joints is written AB."""

STRAIGHT = 1e-7
"""Sine below which a force is at right angles to a line."""


class _Written(NamedTuple):
    """A term in letters and in numbers, each with its sign."""

    letters: tuple[bool, str]
    numbers: tuple[bool, str]


def solution_steps(sheet: ReportSheet, c: ReportContext, solved: ForceSteps, drawn: bool = True) -> None:
    """All steps, those on one free body together and beside its figure where it comes first."""
    writer, shown_links = StepWriter(c, solved), set[str]()
    sheet.text(
        "$h(F)$ is the distance of a force's line of action from the point of the moments; known forces enter "
        "with their magnitudes, and the sign of a term is that of its sense; $c$ is the cosine of the angle between an "
        "unknown force and the direction of a sum."
        if c.r.mechanism.dimension == 2
        else "$M(F)$ is the moment of a force about the line of the step, $h$ the arm of the unknown."
    )
    sheet.text(_rounds(solved, c.notation.letter))
    for links, lot in groupby(solved.steps, key=lambda s: (s.links, s.kind == "check")):
        texts = [block for step in writer.together(list(lot)) for block in step]
        fresh = drawn and len(links[0]) == 1 and not links[1] and links[0][0] not in shown_links
        if fresh:
            shown_links.add(links[0][0])
            sheet.beside(draw.free_body(c.r, links[0][0], c.k + 1, c.notation), texts)
        else:
            sheet.blocks += texts
    if solved.open:
        names = ", ".join(u.name for u in solved.open)
        sheet.text(
            f"Equilibrium does not determine the forces {names}: they depend on the elasticity of the links."
        )


def _rounds(solved: ForceSteps, letter: str) -> str:
    """The joints whose tangent points, or senses, are those of the last round of the iteration."""
    two_force = [m.link for m in members(solved.equations.r).values() if m.kind.startswith("two-force")]
    rods = {u.name for u in solved.equations.unknowns if set(two_force) & set(u.links)}
    circles = [u.name for u in solved.equations.unknowns if u.turned == "circle" and u.name not in rods]
    leaning = [
        u.name
        for u in solved.equations.unknowns
        if u.turned == "angle" and u.name not in solved.equations.unpaired
    ]
    parts = []
    if circles:
        parts.append(
            f"With friction in {', '.join(circles)} the point where the force touches the circle depends on the "
            "force: the forces act at the tangent points of the last round of the iteration."
        )
    if leaning:
        parts.append(
            f"The force in {', '.join(leaning)} is inclined to the normal, by friction or by the pressure angle."
        )
    parts += [
        f"{name} has an end on the ground, so its forces on its two links are not opposite: both are in the ratio of "
        "its tensions, which the coefficient of friction and the wrap give."
        for name in solved.equations.unpaired
    ]
    joints = solved.equations.r.mechanism.joints
    known = dict.fromkeys(a.of for a in solved.equations.friction)
    if belts := [n for n in known if hasattr(joints[n], "stated_tension")]:
        parts.append(
            f"${letter}_{{0}}$ of {', '.join(belts)} is the part of the force that comes from the given tension alone."
        )
    return " ".join(parts)


class StepWriter:
    """Steps as paragraphs and equations in the reader's notation."""

    def __init__(self, c: ReportContext, solved: ForceSteps) -> None:
        self.c, self.shown, self.solved, self.e = c, c.shown, solved, solved.equations
        self.by_step = {(f.of, f.step): f for s in solved.steps for f in s.finds}

    def together(self, steps: list[SolvedStep]) -> Iterator[list[Text]]:
        """Each step; the two directions of one two-force link in one sentence."""
        rods = [s for s in steps if s.kind == "rod"]
        if rods:
            yield [Paragraph(self._rod(rods))]
        for s in steps:
            if s.kind == "single":
                yield self._single(s)
            elif s.kind == "block":
                yield self._block(s)
            elif s.kind == "check":
                yield self._check(s)

    # sentences

    def _head(self, s: SolvedStep) -> str:
        sources = sorted({f.step for t in s.terms if t.of is not None and not t.sought for f in t.numbers})
        known = f" (with step{'s' * (len(sources) > 1)} {_listed(sources)})" if sources else ""
        return f"{s.number}. {self._links(s.links)}, {self._said(s.equation)}{known}:"

    def _links(self, links: Sequence[str]) -> str:
        if len(links) == len(self.e.links) > 1:
            return "All links together"
        names = " and ".join(self.shown.heading(n) for n in links)
        return f"Link {names}" if len(links) == 1 else f"Links {names} together"

    def _said(self, q: PaperEquation) -> str:
        """An equation in words."""
        if q.kind == "forces":
            if q.name:
                return f"forces along {q.name}"
            return f"forces along the direction {self._direction(q)}, normal to the other unknown force"
        if q.kind == "screw":
            return f"forces and moments for a screw along {self._direction(q)}, without any other unknown"
        if not q.name:
            where = "the point I" if self.e.d == 2 else f"the line along {self._direction(q)} through"
            return f"moments about {where} {self._point(q.point)}, which the other unknown forces meet"
        joint, _, axis = q.name.partition(" ") if self.e.d == 3 else (q.name, "", "")
        of = next((u for u in self.e.unknowns if u.name == joint and u.kind == "joint"), None)
        turned = "the tangent point of the circle at " if of is not None and of.turned == "circle" else ""
        if self.e.d == 2 or axis:
            return f"moments about {turned}{joint}" + (f", about {axis}" if axis else "")
        return f"moments about the line {q.name}"

    def _point(self, point: Array | None) -> str:
        return (
            "("
            + ", ".join(
                self.shown.number("length", float(x), 1e-12 * self.e.length)
                for x in (() if point is None else point)
            )
            + ")"
        )

    def _direction(self, q: PaperEquation) -> str:
        assert q.direction is not None
        if self.e.d == 2:
            return f"{self.c.notation.direction(*map(float, q.direction))}°"
        return "(" + ", ".join(self.c.notation.number(round(float(x), 12)) for x in q.direction) + ")"

    def _rod(self, rods: list[SolvedStep]) -> str:
        numbers = _listed([s.number for s in rods])
        unknowns = [u for s in rods for u in s.unknowns]
        line = list(dict.fromkeys([*(u.name for u in unknowns), rods[0].equation.name]))
        where = f"the line through {' and '.join(line)}"
        if any(u.turned == "circle" for u in unknowns):
            where = "the common tangent of the friction circles"
        return (
            f"{numbers}. {self._links(rods[0].links)} is a two-force member: no more than two joint forces act on it, "
            f"so both lie along {where}."
        )

    # steps

    def _single(self, s: SolvedStep) -> list[Text]:
        terms = [w for t in s.terms for w in self._term(t, s)]
        letters = join_signed([w.letters for w in terms])
        numbers = join_signed([w.numbers for w in terms])
        lines = [Working(f"{letters} = 0", f"{numbers} = 0")]
        marked = bool(s.finds[0].mark)
        lines.append(Working(self._result(s.finds[0], s) + ("" if marked else self._way(s))))
        if s.whole is not None and marked:
            lines.append(self._whole(s))
        return [Paragraph(self._head(s)), Equations(tuple(lines))]

    def _block(self, s: SolvedStep) -> list[Text]:
        names = ", ".join(dict.fromkeys(u.name for u in s.unknowns))
        words = "; ".join(
            f"{self._links(tuple(self.e.links[n] for n in q.links))}: {self._said(q)}" for q in s.equations
        )
        count = f"{len(s.equations)} equations, as none has one unknown"
        head = f"{s.number}. {names} together: {count}. {words}."
        return [Paragraph(head), Equations(tuple(Working(self._result(f, s)) for f in s.finds))]

    def _check(self, s: SolvedStep) -> list[Text]:
        terms = [w for t in s.terms for w in self._term(t, s)]
        left = abs(sum(t.value for t in s.terms)) / max(abs(t.value) for t in s.terms)
        head = f"Check by an equation that no step has used. {self._head(s).partition('. ')[2]}"
        letters = join_signed([w.letters for w in terms])
        numbers = join_signed([w.numbers for w in terms])
        words = f'= 0 quad "which agrees within {remainder(left)} of the largest term"'
        return [Paragraph(head), Equations((Working(f"{letters} = 0", f"{numbers} {words}"),))]

    def _result(self, f: ForceNumber, s: SolvedStep) -> str:
        kind = self._kind(f)
        largest = self.e.largest_force * (1.0 if kind == "force" else self.e.length)
        value = 0.0 if abs(f.value) < 1e-10 * largest else f.value
        result = f"{self._sign(f, s)} = {self.shown.with_unit(self.shown.number(kind, value), kind)}"
        if self.e.d == 2 or f.mark not in "abcdef" or not f.mark:
            return result
        sense = 1.0 if self._on(self.e.unknowns[f.of], s.links) == self.e.unknowns[f.of].links[-1] else -1.0
        way = ", ".join(self.c.notation.number(round(float(sense * x), 12)) for x in f.direction)
        return f'{result} quad "along ({way})"'

    def _way(self, s: SolvedStep) -> str:
        """Direction of a two-force member's force."""
        if s.whole is None or self.e.d == 3 or np.linalg.norm(s.whole) <= self.shown.least["force"]:
            return ""
        return f', quad "it acts at" {self.c.notation.direction(*map(float, s.whole))} deg'

    def _whole(self, s: SolvedStep) -> Working:
        """Size and direction of a force whose components are known."""
        assert s.whole is not None
        f, k = s.finds[0], s.finds[0].of
        marks = [
            self._sign(g, s)
            for (of, _), g in self.by_step.items()
            if of == k and not g.turning and g.step <= s.number and g.mark
        ]
        size = float(np.linalg.norm(s.whole))
        sign = self._of(self.e.unknowns[k], s.terms[0].link, f.turning)
        result = self.shown.with_unit(self.shown.number("force", size), "force")
        if self.e.d == 2 and size > self.shown.least["force"]:
            result += f" angle {self.c.notation.direction(*map(float, s.whole))} deg"
        squares = " + ".join(f"{m}^{{2}}" for m in marks)
        return Working(f"{sign} = sqrt({squares})", "", result) if marks else Working(f"{sign} = {result}")

    def _kind(self, f: ForceNumber) -> str:
        return "moment" if f.turning else "force"

    # signs

    def _sign(self, f: ForceNumber, s: SolvedStep) -> str:
        """Sign of a solved number, on the free body of a step."""
        u = self.e.unknowns[f.of]
        sign = self._of(u, self._on(u, s.links), f.turning)
        return along(sign, f.mark) if f.mark else sign

    def _on(self, u: UnknownForce, links: Sequence[str]) -> str:
        ends = [n for n in u.links if n in links]
        return ends[-1] if ends else u.links[-1]

    def _of(self, u: UnknownForce, on: str, turning: bool) -> str:
        if u.kind == "load":
            return load_sign(u.name)
        if u.kind == "effort":
            a = next(
                a for a in other_actions(self.c.r) if a.kind == "effort" and a.of == u.name and a.link == on
            )
            return self.shown.effort(a)
        return self.shown.joint_moment(u.name, on) if turning else self.shown.reaction(u.name, on)

    def _named(self, t: StepTerm, turning: bool) -> str:
        """Sign of a term's force or couple."""
        if t.action is not None:
            forced = turning and np.nan_to_num(t.action.force).any()
            return self.shown.turning_symbol(t.action) if forced else self.shown.symbol(t.action)
        assert t.of is not None
        mine = [f for f in t.numbers if f.turning == turning]
        sign = self._of(t.of, t.link, turning)
        return along(sign, mine[0].mark) if len(mine) == 1 and mine[0].mark else sign

    # terms

    def _term(self, t: StepTerm, s: SolvedStep) -> Iterator[_Written]:
        """Contribution of a term to an equation: its force with its arm or component, and its couple."""
        q, d = s.equation, self.e.d
        if t.sought:
            yield self._unknown(t, s)
            return
        forced = float(q.twist @ np.concatenate([t.force, self._moment(t)]))
        turned = float(q.twist[d:] @ t.couple)
        size = 1e-9 * max(abs(forced), abs(turned))
        if abs(forced) > size:
            yield self._forced(t, q, forced)
        if abs(turned) > size:
            sign = self._named(t, True)
            yield self._signed(
                sign if d == 2 else f"M({sign})", turned * (q.twist[2] if d == 2 else 1.0), "moment", False
            )

    def _moment(self, t: StepTerm) -> Array:
        if self.e.d == 3:
            return np.cross(t.at, t.force)
        return np.array([t.at[0] * t.force[1] - t.at[1] * t.force[0]])

    def _forced(self, t: StepTerm, q: PaperEquation, value: float) -> _Written:
        sign = self._named(t, False)
        if q.kind == "forces":
            mark = t.numbers[0].mark if len(t.numbers) == 1 else ""
            if mark == q.name and mark:
                return self._signed(sign, value, "force", False)
            return self._signed(
                along(sign, q.name.rstrip("'") + "'" * q.name.count("'") or "u"), value, "force", False
            )
        if self.e.d == 3:
            return self._signed(f"M({sign})", value, "moment", False)
        size = float(np.linalg.norm(t.force))
        arm, minus = abs(value) / size, (value < 0) == (self.c.notation.torque > 0)
        number = f"{self.shown.number('force', size)} cdot {self._arm(arm)}"
        return _Written((minus, f"{sign} {self._arm_letters(t, q, sign)}"), (minus, number))

    def _arm_letters(self, t: StepTerm, q: PaperEquation, sign: str) -> str:
        """AB where a joint's force is at right angles to the line from the moment point, h otherwise."""
        if t.of is not None and t.of.kind == "joint" and q.name and q.point is not None and not t.of.turned:
            line, short = t.at - q.point, max(len(q.name), len(t.of.name)) <= SHORT
            if short and abs(float(line @ t.force)) <= STRAIGHT * float(
                np.linalg.norm(line) * np.linalg.norm(t.force)
            ):
                return distance(*sorted((q.name, t.of.name)))
        return f"h({sign})"

    def _arm(self, arm: float) -> str:
        return self.c.notation.number(arm / self.shown.arm)

    def _signed(self, letters: str, value: float, kind: str, minus: bool) -> _Written:
        number = self.shown.number(kind, value)
        return _Written((minus, letters), (number.startswith("−"), number.removeprefix("−")))

    def _unknown(self, t: StepTerm, s: SolvedStep) -> _Written:
        """The unknown with its arm or cosine."""
        f, q, c = s.finds[0], s.equation, s.coefficient
        sign, minus = self._sign(f, s), c < 0
        if abs(abs(c) - 1) < STRAIGHT and (q.kind == "forces" or f.turning):
            return _Written((minus, sign), (minus, sign))
        if q.kind == "forces" or f.turning:
            return _Written((minus, f"{sign} c"), (minus, f"{sign} cdot {self.c.notation.number(abs(c))}"))
        minus = minus == (self.c.notation.torque > 0 or self.e.d == 3)
        arm = replace_force(t, f)
        letters = self._arm_letters(arm, q, sign) if self.e.d == 2 else "h"
        return _Written((minus, f"{sign} {letters}"), (minus, f"{sign} cdot {self._arm(abs(c))}"))


def replace_force(t: StepTerm, f: ForceNumber) -> StepTerm:
    """The term with a force of size 1 where the solved number is zero."""
    return StepTerm(t.link, f.direction, t.at, t.couple, t.value, None, t.of, t.numbers, True)


def _listed(numbers: list[int]) -> str:
    """1, 2 and 5."""
    texts = list(map(str, numbers))
    return " and ".join(filter(None, [", ".join(texts[:-1]), texts[-1]]))
