"""What the numbers of a result rest on, each as a phrase."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dalembert.analysis import friction

if TYPE_CHECKING:
    from dalembert.analysis.result import Result
    from dalembert.model import Mechanism


def assumptions(result: Result) -> dict[str, str]:
    """Gravity, inertia, friction, how reactions beyond statics were found, inertias that no real body has.

    >>> import dalembert as da
    >>> da.statics(da.four_bar()).assumptions["inertia"]
    'off (static)'
    """
    gravity = result.mechanism.gravity_vector
    shown = "none" if not any(gravity) else "[" + ", ".join(f"{c:.6g}" for c in gravity) + "] m/s2"
    found = {
        "gravity": shown,
        "inertia": "on (D'Alembert)" if result.inertia else "off (static)",
        "friction": friction.assumption(result),
    }
    if result.compiled.layout.compliance is not None and result.unique_array is not None:
        found["redundant reactions"] = "by the joints' stiffness, links rigid, free of stress without load"
    return found | (_doubts(result.mechanism) if result.inertia else {})


def _doubts(m: Mechanism) -> dict[str, str]:
    """In space: inertias that no real body has, which can be analysed all the same."""
    from dalembert.model.space_checks import impossible

    found = [name for name in m.links if m.dimension == 3 and impossible(m.inertia(name))]
    if not found:
        return {}
    said = "of no real body: one principal value exceeds the sum of the others"
    return {f"inertia of {' and '.join(found)}": said}
