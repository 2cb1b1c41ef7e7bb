"""What the numbers of a result rest on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dalembert.analysis import friction

if TYPE_CHECKING:
    from dalembert.analysis.result import Result


def assumptions(result: Result) -> dict[str, str]:
    """Gravity, inertia, friction, and how reactions beyond statics were found, each as a phrase.

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
    return found
