"""`dalembert draw` and `report`: a file analysed, drawn and worked out on paper."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any, Literal

from dalembert.errors import ModelError
from dalembert.saving import check_new

OK, SOME_NOT_OK = 0, 1
PICTURES = (".svg", ".pdf", ".png", ".dxf", ".gif", ".webp")


def drawn(
    file: Path,
    output: Path,
    view: Any,
    at: str | None,
    positions: int | None,
    static: bool,
    theme: Literal["light", "dark", "print"],
    names: bool,
    force: bool,
    friction: bool = True,
) -> int:
    """Draw a file; 1 where some position has a status other than ok."""
    from dalembert.analysis import solve
    from dalembert.cli.rubbing import loaded
    from dalembert.views import draw

    if output.suffix.lower() not in PICTURES:
        raise ModelError(
            f"{output.name}: the ending names no kind of drawing", f"use one of {' '.join(PICTURES)}"
        )
    check_new(output, force)
    if positions is None and (view == "charts" or _moves(view, output)):
        positions = _enough(file, 36 if _moves(view, output) else 72)
    result = solve(loaded(file, friction), static=static, positions=positions)
    notation = draw.Notation(links="name" if names else "number")
    if _moves(view, output):
        draw.animation(result, notation).save(output, force, theme)
    else:
        draw.view(result, view, at, notation).save(output, force, theme)
    print(f"Written: {output}", file=sys.stderr)
    return OK if result.ok.all() else SOME_NOT_OK


def reported(
    file: Path,
    output: Path,
    at: str | None,
    positions: int | None,
    static: bool,
    methods: Any,
    notation: Any,
    about: str,
    force: bool,
    friction: bool = True,
) -> int:
    """Write the worked solution; 1 where some position has a status other than ok."""
    from dalembert.analysis import solve
    from dalembert.cli.rubbing import loaded
    from dalembert.report import report

    check_new(output, force)
    result = solve(loaded(file, friction), static=static, positions=positions)
    report(result, at, methods, notation, about).save(output, force)
    print(f"Written: {output}", file=sys.stderr)
    return OK if result.ok.all() else SOME_NOT_OK


def _moves(view: str, output: Path) -> bool:
    """Whether an animation is asked for."""
    return view == "animation" or output.suffix.lower() in (".gif", ".webp")


def _enough(file: Path, count: int) -> int | None:
    """Charts and animations of a file with one position show a whole turn."""
    from dalembert.model import load

    m = load(file)
    return count if len(m.schedule().position) == 1 and m.drives else None
