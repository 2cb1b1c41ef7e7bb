"""Ropes and chains that carry nothing beside the machine's other forces hang neither slack nor slip."""

from __future__ import annotations

import pytest

import dalembert as da


@pytest.mark.parametrize("method", ["auto", "careful"])
def test_a_rope_without_a_load_beside_others_is_not_slack(method: str) -> None:
    """A hoist whose block is held by an unknown force, its drum free of torque."""
    tree = da.hoist().to_tree()
    tree["drives"]["D"]["effort"] = "0 N*m"
    for angle in ("90 deg", "200 deg", "250 deg"):
        load = {"type": "force", "on": "block", "at": "B", "value": "unknown", "direction": angle}
        tree["loads"] = {"put": load}
        m = da.mechanism(tree)
        for _ in range(3):  # kept programs too
            r = da.statics(m, method=method) if method != "auto" else da.statics(m)
            assert set(r.status) == {"ok"}
            assert abs(r.load_array).min() > 1
    verdicts = []
    for effort in ("-1e-6 N*m", "1e-6 N*m"):  # small, but none of rounding
        tree["drives"]["D"]["effort"] = effort
        verdicts.append(set(da.statics(da.mechanism(tree)).status))
    assert verdicts in ([{"slack"}, {"ok"}], [{"ok"}, {"slack"}])
