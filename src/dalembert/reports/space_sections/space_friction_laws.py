"""Friction in space: the law of each joint in figures, the force and couple it makes, what it costs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from dalembert.analysis.compile.contacts import circle as circle_kind
from dalembert.analysis.friction.joint_friction import ContactForce, contact_forces
from dalembert.analysis.output.rounding import PART
from dalembert.arrays import Array
from dalembert.reports.report_context import ReportContext, figure
from dalembert.reports.sections.friction import circle_radius, cost
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.views.notation import along

LAWS = {
    "revolute": "the couple about z' is the radius of the friction circle times S, the force across the axis; that of "
    "a collar its radius times the force along the axis",
    "prismatic": "the force along x' is the coefficient times S, the force across the slide",
    "cylindrical": "the coefficient times S, the force across the axis, lies along the slip, which is made of the "
    "slide and of the radius times the turn; p is the part of its direction along x', and around it; with k for the "
    "coefficient S is without the friction around the axis",
    "spherical": "the couple is the radius times the force S, against the relative angular velocity",
    "screw": "the coefficient times the thread's normal force, and times the force across the axis, lies along the "
    "helix at the mean radius",
    "gear": "the coefficient times the normal force of the teeth lies against their sliding; teeth that roll on each "
    "other at the pitch point rub at an arm from it, or lose a share of their tangential force: a couple between the "
    "wheels",
}
"""Law of the friction of a joint, by its type."""


def space_friction(sheet: ReportSheet, c: ReportContext) -> None:
    """The section on friction of a solved position; none without friction."""
    if c.r.friction is None or not c.r.friction.known(c.k):
        return
    sheet.heading("Friction")
    sheet.text(
        "On the second link of a joint friction is against its motion relative to the first. It follows the joint's "
        "normal forces, which are those of the solution below."
    )
    for joint in c.r.joints:
        contacts = contact_forces(c.r, joint, c.k)
        if contacts:
            kind = c.r.mechanism.joints[joint].type
            sheet.text(f"Joint {joint}, {kind}: {LAWS[kind]}.")
            sheet.equations(_Joint(c, joint, contacts).lines())
    cost(sheet, c)


class _Joint:
    """The lines of one joint."""

    def __init__(self, c: ReportContext, joint: str, contacts: tuple[ContactForce, ...]) -> None:
        self.c, self.joint, self.contacts = c, joint, contacts
        self.described: Any = c.r.mechanism.joints[joint]
        self.j = self.described.links[1]
        self.sign = c.shown.reaction(joint, self.j)
        if c.r.friction_force(joint)[c.k].any():
            self.sign = f"N{self.sign.removeprefix(c.notation.letter)}"
        index = c.shown.between(joint, self.j)
        self.force_sign, self.couple_sign = f"{c.notation.letter}_{{f{index}}}", f"M_{{f{index}}}"

    def lines(self) -> list[Working]:
        kind = self.described.type
        return getattr(self, f"_{kind}")()  # type: ignore[no-any-return]

    def _of_kind(self, kind: str) -> list[ContactForce]:
        return [contact for contact in self.contacts if contact.kind == kind]

    def _amounts(self) -> list[float]:
        return [contact.amount for contact in self.contacts]

    # figures

    def _number(self, kind: str, value: float) -> str:
        return self.c.shown.number(kind, value)

    def _text(self, kind: str, value: float) -> str:
        return figure(self.c.shown, kind, value)

    def _bearings(self, contacts: list[ContactForce], axes: str) -> list[Working]:
        """N of one contact of the components that make it; of both ends of a bearing that has them."""
        if len(contacts) > 1:
            return [
                Working(
                    f"S_{{{self.joint},{n}}}",
                    "",
                    f'{self._text("force", contact.bearing)} "at the end {end}"',
                )
                for n, (contact, end) in enumerate(zip(contacts, ("behind", "ahead"), strict=True), 1)
            ]
        return [self._bearing(contact, axes) for contact in contacts]

    def _bearing(self, contact: ContactForce, axes: str) -> Working:
        name = f"S_{{{self.joint}}}"
        inside = " + ".join(f"{along(self.sign, a + chr(39))}^{{2}}" for a in axes)
        return Working(name, f"({inside})^{{1/2}}", self._text("force", contact.bearing))

    def _radius(self, contact: ContactForce) -> Working:
        return circle_radius(self.c, self.joint, contact.coefficient, contact.strength)

    def _sum(self, sign: str, kind: str, parts: list[tuple[str, str]], amounts: list[float]) -> Working:
        """Letters and numbers of products, all with the sign of the friction."""
        minus = "−" if sum(amounts) < 0 else ""
        letters, numbers = (" + ".join(p[n] for p in parts) for n in (0, 1))
        if len(parts) > 1:
            letters, numbers = f"({letters})", f"({numbers})"
        total, numbers = self._text(kind, sum(amounts)), f"{minus}{numbers}"
        return Working(
            f"{sign} = {minus}{letters}", self._couple(numbers) if kind == "moment" else numbers, total
        )

    def _couple(self, numbers: str) -> str:
        """A product of a length and a force as a moment."""
        return self.c.shown.with_factor(numbers, "moment", "length", "force")

    def _product(self, factor: str, number: str, contact: ContactForce, n: int, of: int) -> tuple[str, str]:
        name = f"S_{{{self.joint}{f',{n + 1}' if of > 1 else ''}}}"
        return f"{factor} {name}", f"{number} cdot {self._number('force', contact.bearing)}"

    # laws

    def _revolute(self) -> list[Working]:
        pins = self._of_kind("pin")
        collars = self._of_kind("collar")
        out = [self._radius(pins[0])] if pins else []  # none of a collar alone
        out += self._bearings(pins, "xy")
        parts = [
            self._product(f"r_{{{self.joint}}}", self._number("length", pin.strength), pin, n, len(pins))
            for n, pin in enumerate(pins)
        ]
        for contact in collars:
            mu, arm = self._mu(contact), self._number("length", self.described.friction.thrust_radius)
            size = f"|{along(self.sign, 'z' + chr(39))}|"
            letters = f"mu_{{{self.joint}}} R_{{t}} {size}"
            parts.append((letters, f"{mu} cdot {arm} cdot {self._number('force', contact.bearing)}"))
        sign = along(self.couple_sign, "z'")
        return [*out, self._sum(sign, "moment", parts, self._amounts())]

    def _prismatic(self) -> list[Working]:
        of, mu = len(self.contacts), f"mu_{{{self.joint}}}"
        out = self._bearings(list(self.contacts), "yz")
        parts = [self._product(mu, self._mu(end), end, n, of) for n, end in enumerate(self.contacts)]
        return [*out, self._sum(along(self.force_sign, "x'"), "force", parts, self._amounts())]

    def _cylindrical(self) -> list[Working]:
        guides = self._of_kind("guide")
        pins = self._of_kind("pin")
        contact, name = guides[0], self.joint
        out = self._bearings(guides, "yz")
        parts = [("p_{x'}", contact.part), *([("p_{t}", pins[0].part)] if pins else [])]
        out.append(Working(", quad ".join(f"{sign} = {self._figure(part)}" for sign, part in parts)))
        factor, figured = f"mu_{{{name}}}", self._mu(contact)
        if pins and circle_kind(self.c.r.mechanism, self.described) == "sin":
            below = f"(1 + ({figured} cdot {self._figure(abs(pins[0].part))})^{{2}})^{{1/2}}"
            letters = f"k_{{{name}}} = frac(mu_{{{name}}}; (1 + (mu_{{{name}}} p_{{t}})^{{2}})^{{1/2}})"
            factor, figured = f"k_{{{name}}}", self._figure(contact.strength)
            out.append(Working(letters, f"frac({self._mu(contact)}; {below})", figured))
        sizes = [self._figure(abs(p[0].part)) for p in (guides, pins) if p]
        out.append(self._share("force", f"{factor} |p_{{x'}}|", f"{figured} cdot {sizes[0]}", guides))
        if pins:
            arm = self._number("length", self.described.friction.radius)
            letters, numbers = f"{factor} R_{{{name}}} |p_{{t}}|", f"{figured} cdot {arm} cdot {sizes[1]}"
            out.append(self._share("moment", letters, numbers, pins))
        return out

    def _share(self, kind: str, factor: str, figure: str, contacts: list[ContactForce]) -> Working:
        """The part of the friction along x', or around it."""
        parts = [
            self._product(factor, figure, contact, n, len(contacts)) for n, contact in enumerate(contacts)
        ]
        sign = along(self.couple_sign if kind == "moment" else self.force_sign, "x'")
        return self._sum(sign, kind, parts, [contact.amount for contact in contacts])

    def _figure(self, x: float) -> str:
        return self.c.shown.number("number", x)

    def _mu(self, contact: ContactForce) -> str:
        return self.c.notation.given(contact.coefficient)

    def _spherical(self) -> list[Working]:
        contact = self.contacts[0]
        couple = self.c.r.friction_moment(self.joint)[self.c.k]
        size = self._text("moment", float(np.linalg.norm(couple)))
        return [
            self._radius(contact),
            self._bearing(contact, "xyz"),
            Working(
                f"|{self.couple_sign}| = r_{{{self.joint}}} S_{{{self.joint}}}",
                self._couple(
                    f"{self._number('length', contact.strength)} cdot {self._number('force', contact.bearing)}"
                ),
                size,
            ),
            self._vector(self.couple_sign, "moment", couple),
        ]

    def _screw(self) -> list[Working]:
        thread, pin = self.contacts
        f, joint = self.described.friction, self.joint
        climb = math.atan(abs(self.described.lead) / (2 * math.pi * f.radius))
        flank = f.thread_angle or 0.0
        axial = thread.bearing * math.cos(climb) * math.cos(flank)
        friction = (thread.amount + pin.amount) / math.sin(climb)
        mu, degrees = self._mu(thread), self.c.notation.degrees(climb)
        both = f"({self._number('force', thread.bearing)} + {self._number('force', pin.bearing)})"
        lead = self._number("length", abs(self.described.lead))
        radius = self._number("length", f.radius)
        out = [
            Working(
                "beta = arctan (frac(l; 2 pi R))",
                f"arctan (frac({lead}; 2 pi cdot {radius}))",
                f"{degrees} deg",
            ),
            Working(
                f"S_{{{joint},t}} = frac(|{along(self.sign, 'x' + chr(39))}|; cos beta cos gamma)",
                f"frac({self._number('force', axial)}; cos {degrees} deg cos {self.c.notation.degrees(flank)} deg)",
                self._text("force", thread.bearing),
            ),
            self._bearing(pin, "yz"),
            Working(
                f"|{self.force_sign}| = mu_{{{joint}}} (S_{{{joint},t}} + S_{{{joint}}})",
                f"{mu} cdot {both}",
                self._text("force", abs(friction)),
            ),
        ]
        force, couple = (float(v @ self._axis()) for v in self._law())
        size, minus = self._number("force", abs(friction)), "−" if force < 0 else ""
        turned = "−" if couple < 0 else ""
        return [
            *out,
            Working(
                f"{along(self.force_sign, 'x' + chr(39))} = {minus}|{self.force_sign}| sin beta",
                f"{minus}{size} sin {degrees} deg",
                self._text("force", force),
            ),
            Working(
                f"{along(self.couple_sign, 'x' + chr(39))} = {turned}|{self.force_sign}| R cos beta",
                self._couple(f"{turned}{size} cdot {radius} cos {degrees} deg"),
                self._text("moment", couple),
            ),
        ]

    def _gear(self) -> list[Working]:
        """The teeth's force, the friction against their sliding, the couple where they roll or have an efficiency."""
        name, teeth, rubs = self.joint, self.contacts[-1], self.described.friction is not None
        letter, mu = (
            (f"S_{{{name}}}", f"mu_{{{name}}}") if rubs else (f"F_{{t,{name}}}", f"(1 − eta_{{{name}}})")
        )
        lost, size = self._mu(teeth), self._number("force", teeth.bearing)
        words = "" if rubs else ", mean of the moments on both wheels over their radii"
        out = [Working(letter, "", figure(self.c.shown, "force", teeth.bearing, words))]
        force, couple = self._law()
        if self.contacts[0].kind == "mesh" and rubs and self.contacts[0].strength:
            amount = self._text("force", abs(self.contacts[0].amount))
            out.append(Working(f"|{self.force_sign}| = {mu} {letter}", f"{lost} cdot {size}", amount))
            out.append(self._vector(self.force_sign, "force", force))
        if teeth.strength:
            arm = self._number("length", teeth.strength / teeth.coefficient)
            numbers, amount = f"{lost} cdot {arm} cdot {size}", self._text("moment", abs(teeth.amount))
            out.append(
                Working(f"|{self.couple_sign}| = {mu} e_{{{name}}} {letter}", self._couple(numbers), amount)
            )
            out.append(self._vector(self.couple_sign, "moment", couple))
        return out

    def _vector(self, sign: str, kind: str, v: Array) -> Working:
        """A force or couple by its components in ground axes."""
        least = PART * float(np.abs(v).max())
        numbers = ", ".join(self.c.shown.number(kind, float(x), least) for x in v)
        return Working(sign, "", f'({numbers}) "{self.c.shown.unit(kind)}, ground axes"')

    def _axis(self) -> Array:
        return np.asarray(self.c.r.joint_axes(self.joint)[self.c.k, 0])

    def _law(self) -> tuple[Array, Array]:
        r, k = self.c.r, self.c.k
        return r.friction_force(self.joint)[k], r.friction_moment(self.joint)[k]
