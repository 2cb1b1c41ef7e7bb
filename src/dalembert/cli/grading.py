"""`dalembert check-answers`: a student's figures against ours."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from dalembert.errors import ModelError
from dalembert.printing import table

if TYPE_CHECKING:
    from dalembert.analysis.mistakes import Verdict


def graded(file: Path, answers: Path | None, interactive: bool, static: bool, friction: bool = True) -> int:
    """Compare figures with what is computed; 1 where one is not right."""
    from dalembert.analysis.mistakes import check_answers, figures
    from dalembert.cli.loading import loaded
    from dalembert.model.files import read_file

    m = loaded(file, friction)
    if interactive:
        tree: Any = _asked(m, static)
    elif answers is None:
        raise ModelError("check-answers needs a file of answers", "name one, or answer with --interactive")
    else:
        tree, _ = read_file(answers)
    found = check_answers(m, figures(tree), static)
    print(_text(found))
    return 0 if all(v.right for v in found) else 1


def _asked(m: Any, static: bool) -> dict[str, dict[str, Any]]:
    """Ask for every effort and joint force; an empty line skips one."""
    from dalembert.analysis import solve

    r = solve(m, static=static)
    out: dict[str, dict[str, Any]] = {"effort": {}, "unknown_load": {}, "reaction": {}}
    for drive in r.drives:
        out["effort"][drive] = input(
            f"Effort of {drive} (a number, or with its unit; empty to skip): "
        ).strip()
    for name in r.unknown_loads:
        out["unknown_load"][name] = input(f"Load {name}: ").strip()
    for joint in r.joints:
        i, j = m.joints[joint].links
        form = "size @ angle" if m.dimension == 2 else "x, y, z"
        said = input(f"Joint {joint}, force of {i} on {j} ({form}): ").strip()
        out["reaction"][joint] = (
            said if m.dimension == 2 or not said else [part.strip() for part in said.strip("[]").split(",")]
        )
    return {quantity: {n: v for n, v in values.items() if v} for quantity, values in out.items()}


def _text(found: list[Verdict]) -> str:
    rows = [
        [v.quantity, v.given, v.computed, "right" if v.right else f"off by {100 * v.off:.2g} %"]
        for v in found
    ]
    said = [f"{v.quantity}: {v.mistake}." for v in found if not v.right]
    right = sum(v.right for v in found)
    parts = [
        table(["answer", "yours", "computed", "verdict"], rows, left=1),
        *said,
        f"{right} of {len(found)} right.",
    ]
    return "\n\n".join(parts[:1]) + "\n\n" + "\n".join(parts[1:])
