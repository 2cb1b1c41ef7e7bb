"""What friction does, as a person reads it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dalembert.analysis.columns import rubbing_joints, unknown_kinds
from dalembert.analysis.friction import bears_on_faces, friction_text, guide_contact
from dalembert.cli.text import number, tables

if TYPE_CHECKING:
    from dalembert.analysis import Result


def ends_text(result: Result, name: str, to: Any, position: int = 0) -> str:
    """'-7304 to -4522 N*m'; a dash where no value holds."""
    kind = unknown_kinds(result)[name]
    low, high = (number(float(v)) for v in to(kind, result.interval(name)[position]))
    return f"{low} to {high} {to.text(kind)}"


def friction_table(result: Result, to: Any) -> str:
    """Friction force, couple and lost power of each joint at the first position, and how guides bear."""
    heads = ["friction", "on j", f"force\n{to.text('force')}", f"couple\n{to.text('moment')}"]
    heads += [f"power lost\n{to.text('power')}", "law"]
    rows = []
    for joint in rubbing_joints(result):
        part = result.mechanism.joints[joint]
        force = float(to("force", np.hypot(*result.friction_force(joint)[0])))
        couple, lost = (
            float(to("moment", result.friction_moment(joint)[0])),
            float(to("power", result.power_lost(joint)[0])),
        )
        law = friction_text(result, joint)
        if bears_on_faces(result, joint):
            law += f", {guide_contact(result, joint).mode[0]}"
        rows.append([joint, part.links[1], number(force), number(couple), number(lost), law])
    return tables(heads, rows, 2)
