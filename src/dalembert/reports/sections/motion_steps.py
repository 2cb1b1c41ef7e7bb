"""The motion in closed form: positions, then rates, link by link, each line in letters, numbers and result."""

from __future__ import annotations

import re
from collections.abc import Callable

from dalembert.analysis.methods.solved.closed_motion import ClosedMotion
from dalembert.analysis.methods.solved.relative_rates import MotionLine, ShownNumber
from dalembert.reports.formula import bracket_negative
from dalembert.reports.report_context import ReportContext
from dalembert.reports.sheet import ReportSheet, Working
from dalembert.views.notation import Shown

AXES = "Components normal to a line have the index n, along it t; the index AB is the component from A towards B."


def motion_steps(sheet: ReportSheet, c: ReportContext) -> None:
    """Every step that is closed; links that are not are named."""
    closed = ClosedMotion(c.r, c.k)
    if not any(step.lines for step in closed.steps):
        return
    sheet.heading("Motion, link by link")
    sheet.text(AXES)
    for step in closed.steps:
        sheet.text(_named(step.words, c.shown, c.shown.heading))
        lines = [_line(line, c.shown) for line in step.lines]
        sheet.equations(lines)
    if closed.left:
        names = ", ".join(map(c.shown.heading, closed.left))
        sheet.text(f"Not in closed form link by link, but from the loop equations below: {names}.")


def _named(text: str, shown: Shown, name: Callable[[str], str]) -> str:
    """Words with links as the reader names them."""
    return re.sub(r"<(\d+)>", lambda match: name(shown.order[int(match[1])]), text)


def _line(line: MotionLine, shown: Shown) -> Working:
    name = _named(line.name, shown, shown.link)
    value = shown.number(line.result.kind, line.result.value)
    angle = f"{shown.notation.degrees(line.result.value)} deg" if line.result.kind == "angle" else ""
    result = f"{name} = {angle or shown.with_unit(value, line.result.kind)}"
    if not line.letters:
        return Working(result)
    numbers = line.pattern
    for n, number in enumerate(line.numbers):
        numbers = numbers.replace(f"%{n}", _number(number, shown, f"cdot %{n}" in numbers))
    numbers = numbers.replace("+ −", "− ").replace("@", name)
    return Working(_named(line.letters, shown, shown.link), f"{numbers}, quad {result}")


def _number(number: ShownNumber, shown: Shown, factor: bool) -> str:
    """A number; an arm in the unit that makes a speed of an angular speed."""
    of = number.kind.removeprefix("arm of ")
    if of == number.kind:
        angle = number.kind == "angle"
        text = shown.notation.degrees(number.value) if angle else shown.number(number.kind, number.value)
    else:
        plain = "speed" if of == "angular_speed" else "acceleration"
        text = shown.notation.number(number.value * shown.size(of) / shown.size(plain))
    return bracket_negative(text) if factor else text
