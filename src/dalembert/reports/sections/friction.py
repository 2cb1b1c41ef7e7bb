"""Friction in the worked solution: circles, tangents, guides, what it costs, and both ends at rest."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from dalembert.analysis.compile.contacts import circle as circle_kind
from dalembert.analysis.friction.efficiency import efficiency, supplied
from dalembert.analysis.friction.friction_circles import (
    TwoPins,
    friction_circles,
    pin_center,
    tangent_sides,
    two_pins,
)
from dalembert.analysis.friction.joint_friction import (
    bears_on_faces,
    friction_circle_radius,
    friction_coefficient,
    guide_contact,
    holds_beyond,
    unknown_names,
)
from dalembert.analysis.methods.applied_forces import link_speed
from dalembert.analysis.output.columns import friction_joints
from dalembert.analysis.result.number_kinds import unknown_kinds
from dalembert.model import GROUND
from dalembert.printing import range_text
from dalembert.reports.pictures import friction_pictures
from dalembert.reports.report_context import ReportContext, figure
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.views import both_ends


def friction(sheet: ReportSheet, c: ReportContext) -> None:
    """The section on friction of a solved position; none without friction."""
    if c.r.friction is None or not c.r.friction.known(c.k):
        return
    sheet.heading("Friction")
    sheet.text(
        "Signs follow the relative motion. The reaction of a pin touches its friction circle on the side that turns "
        "the link against that motion; on a guide it is inclined to the normal by phi, against the sliding."
    )
    sheet.figure(*friction_pictures(c))
    for joint in (n for n in c.r.joints if friction_circle_radius(c.r, n)):
        sheet.text(_sense(c, joint))
        sheet.equations(pin_lines(c, joint))
    for two in _two_force_links(c):
        words, lines = tangent_lines(c, two)
        sheet.text(words)
        sheet.equations(lines)
    for joint in (n for n in c.r.joints if bears_on_faces(c.r, n)):
        sheet.equations(guide_lines(c, joint))
    cost(sheet, c)


def pin_lines(c: ReportContext, joint: str) -> list[Working]:
    """Radius of the friction circle and the couple of friction about the pin's centre."""
    r, shown, k = c.r, c.shown, c.k
    described: Any = r.mechanism.joints[joint]
    size = float(friction_circles(r, joint).radii[k])
    radius = shown.number("length", size)
    i, j = described.links
    on = i if j == GROUND else j
    force = float(np.hypot(*r.reaction(joint)[k]))
    couple = float(r.friction_moment(joint, on)[k])
    sign = "−" if couple * c.notation.torque < 0 else ""
    sense = f", {'clockwise' if couple < 0 else 'counter-clockwise'} about {joint}" if couple else ""
    other = i if on == j else j
    product = f"{sign}{radius} cdot {shown.number('force', force)}"
    return [
        circle_radius(c, joint, friction_coefficient(r, joint, k), size),
        Working(
            f"M_{{f{shown.pair(other, on)}}} = {sign}r_{{{joint}}} {shown.reaction(joint, on)}",
            shown.with_factor(product, "moment", "length", "force"),
            figure(shown, "moment", couple, sense),
        ),
    ]


def _sense(c: ReportContext, joint: str) -> str:
    """Sense in which a link turns on the other, and so in which friction turns it."""
    r, k = c.r, c.k
    i, j = r.mechanism.joints[joint].links
    on, other = (i, j) if j == GROUND else (j, i)
    turn = float(link_speed(r, on)[k] - link_speed(r, other)[k])
    couple = float(r.friction_moment(joint, on)[k])
    if not turn or not couple:
        return ""
    ways = ["clockwise" if x < 0 else "counter-clockwise" for x in (turn, couple)]
    return (
        f"{joint}: link {c.shown.heading(on)} turns {ways[0]} on {c.shown.heading(other)}, so friction's couple on it "
        f"is {ways[1]}, and its force touches the circle on the side that makes this couple."
    )


def circle_radius(c: ReportContext, joint: str, mu: float, radius: float) -> Working:
    """Radius of a friction circle (m) of a coefficient: R sin(arctan mu), or mu R."""
    described: Any = c.r.mechanism.joints[joint]
    large = c.shown.number("length", float(described.friction.radius))
    letters, numbers = f"mu_{{{joint}}} R_{{{joint}}}", f"{c.notation.given(mu)} cdot {large}"
    if circle_kind(c.r.mechanism, described) == "sin":
        letters = f"R_{{{joint}}} sin (arctan mu_{{{joint}}})"
        numbers = f"{large} sin {c.notation.degrees(math.atan(mu))} deg"
    return Working(f"r_{{{joint}}} = {letters}", numbers, figure(c.shown, "length", radius))


def _two_force_links(c: ReportContext) -> list[TwoPins]:
    """Links that two pins alone load, with a friction circle in one at least."""
    two_force: dict[str, TwoPins] = {}
    for joint in (n for n in c.r.joints if friction_circle_radius(c.r, n)):
        two = two_pins(c.r, joint) if c.r.mechanism.joints[joint].hinge else None
        if two is not None and abs(two.tension[c.k]) > c.shown.least["force"]:
            two_force[two.link] = two
    return list(two_force.values())


def tangent_lines(c: ReportContext, two: TwoPins) -> tuple[str, list[Working]]:
    """Common tangent of the friction circles along which a two-force link's reactions act, and the direction of that
    line."""
    r, shown, k = c.r, c.shown, c.k
    a, b = two.joints
    span = pin_center(r, b)[k] - pin_center(r, a)[k]
    length, along = float(np.hypot(*span)), math.atan2(span[1], span[0])
    radii = [float(friction_circles(r, n).radii[k]) if friction_circle_radius(r, n) else 0.0 for n in (a, b)]
    sides = [int(s) for s in np.nan_to_num(tangent_sides(r, a, b)[k])]
    sine = (sides[0] * radii[0] - sides[1] * radii[1]) / length
    turn = -math.asin(sine)
    inner = sides[0] * sides[1] < 0
    sign = "+" if inner else "−"
    n, state = shown.link(two.link), two.state(k)
    large, small = ((a, b), radii) if radii[0] >= radii[1] else ((b, a), radii[::-1])
    sizes = [shown.number("length", x) for x in small]
    words = (
        f"Link {shown.heading(two.link)} carries the forces of {a} and {b} alone, so both lie on one line, a common "
        f"tangent of the two friction circles{f', in {state}' if state else ''}. It is "
        + (
            "an internal tangent, as friction turns the link in the same sense at both pins"
            if inner
            else "an external tangent"
        )
        + "; its inclination to the line of the pins:"
    )
    number, degrees = shown.number("length", length), c.notation.degrees
    moved = "+" if turn >= 0 else "−"
    return words, [
        Working(
            f"beta_{{{n}}} = arcsin (frac(r_{{{large[0]}}} {sign} r_{{{large[1]}}}; {a}{b}))",
            f"arcsin (frac({sizes[0]} {sign} {sizes[1]}; {number}))",
            f"{degrees(abs(turn))} deg",
        ),
        Working(
            f"theta_{{{a}{b}}} {moved} beta_{{{n}}}",
            f"{degrees(along)} deg {moved} {degrees(abs(turn))} deg",
            f"{degrees(along + turn)} deg",
        ),
    ]


def guide_lines(c: ReportContext, joint: str) -> list[Working]:
    """Sum of the contact forces of a guide, its corner loads, and the friction they make."""
    r, shown, k = c.r, c.shown, c.k
    contact = guide_contact(r, joint)
    described: Any = r.mechanism.joints[joint]
    i, j = described.links
    normal, couple = float(contact.normal[k]), float(contact.couple[k])
    total = float(contact.lower[k] + contact.upper[k])
    number = shown.number
    name = f"N_{{{shown.pair(i, j)}}}"
    out = []
    if described.friction.guide is None:
        out.append(Working(f"S_{{{joint}}} = |{name}|", "", figure(shown, "force", total)))
    else:
        behind, ahead = described.friction.guide
        tilting = f"frac(|2 M_{{{joint}}} − (l_{{2}} − l_{{1}}) {name}|; l_{{1}} + l_{{2}})"
        size = abs(2 * couple - (ahead - behind) * normal) / (behind + ahead)
        out.append(
            Working(
                f'S_{{{joint}}} = "greater of" |{name}| "and" {tilting}',
                f'"greater of" {number("force", abs(normal))} "and" {number("force", size)}',
                figure(shown, "force", total, f": {contact.mode[k]}"),
            )
        )
        loads = (("lower", "+", float(contact.lower[k])), ("upper", "−", float(contact.upper[k])))
        out += [
            Working(f"N_{{{face}}} = frac(S_{{{joint}}} {sign} {name}; 2)", "", figure(shown, "force", load))
            for face, sign, load in loads
        ]
    mu = friction_coefficient(r, joint, k)
    force = float(np.hypot(*r.friction_force(joint)[k]))
    constant = float(described.friction.force or 0.0)
    letters, more = (" + F_{0}", f" + {number('force', constant)}") if constant else ("", "")
    out.append(
        Working(
            f"F_{{f{shown.pair(i, j)}}} = mu_{{{joint}}} S_{{{joint}}}{letters}",
            f"{c.notation.given(mu)} cdot {number('force', total)}{more}",
            figure(shown, "force", force),
        )
    )
    return out


def cost(sheet: ReportSheet, c: ReportContext) -> None:
    """Power that each joint loses and its share; the efficiency in both senses."""
    r, shown, k = c.r, c.shown, c.k
    lost = {n: float(r.power_lost(n)[k]) for n in friction_joints(r)}
    lost = {n: p if abs(p) > shown.least["power"] else 0.0 for n, p in lost.items()}
    total = sum(lost.values())
    if not total > 0:
        return
    drives = sum(float((r.effort(d) * r.drive_speed(d))[k]) for d in r.drives)
    put_in = supplied(drives, total)
    rows = [
        [n, shown.number("power", p), "–" if r.unknown_loads else c.notation.percent(p / put_in)]
        for n, p in [*lost.items(), ("sum", total)]
    ]
    heads = ["Joint", f"Power lost ({shown.unit('power')})", "of the input power"]
    sheet.table(heads, rows, "Power lost to friction at this position", total=True)
    efficiencies = efficiency(r)
    senses = (
        (float(efficiencies.forward[k]), f"where the drive moves the load{efficiencies.driven(k)}"),
        (float(efficiencies.reverse[k]), f"where the load moves the drive{efficiencies.held(k)}"),
        (efficiencies.cycle if len(r.status) > 1 else math.nan, "over all positions, inertia and all"),
    )
    parts = [f"{c.notation.percent(part)} {words}" for part, words in senses if math.isfinite(part)]
    if parts:
        sheet.text(f"Efficiency, without inertia: {'; '.join(parts)}.")


def at_rest(sheet: ReportSheet, c: ReportContext, answers: Callable[..., object]) -> None:
    """Both ends of every effort or load that friction leaves open: drawing and joint forces of each."""
    r, shown, k = c.r, c.shown, c.k
    sheet.heading("At rest: what friction can hold")
    sheet.text(str(r.reasons[k]))
    sheet.equations(intervals(c))
    for words, end, known in both_ends.ends(r, k, shown):
        sheet.heading(words, 2)
        if known:
            at_end = replace(c, r=end)
            sheet.figure(*friction_pictures(at_end))
            answers(sheet, at_end)


def intervals(c: ReportContext) -> list[Working]:
    """Intervals left open by friction: every effort or unknown load between the two impending motions, and beyond
    them."""
    r, shown, out = c.r, c.shown, []
    for name in unknown_names(r):
        kind = unknown_kinds(r)[name]
        ends = (shown.number(kind, float(v)) if math.isfinite(v) else None for v in r.interval(name)[c.k])
        out.append(Working(f'"{name}: {range_text(ends, shown.unit(kind))}"'))
        held = r.holding(name)[c.k]
        if holds_beyond(r.interval(name)[c.k], held):
            low, high = (shown.number(kind, float(v)) if math.isfinite(v) else "any value" for v in held)
            words = f"after some earlier motions friction can hold {low} to {high} {shown.unit(kind)}"
            out.append(Working(f'"{name}: {words}"'))
    return out
