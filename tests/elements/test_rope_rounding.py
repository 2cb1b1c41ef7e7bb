"""Ropes and chains that carry nothing beside the machine's other forces hang neither slack nor slip."""

from __future__ import annotations

from typing import Any

import pytest

import dalembert as da


@pytest.mark.parametrize("options", [{}, {"method": "careful"}])
def test_a_rope_without_a_load_beside_others_is_not_slack(options: dict[str, Any]) -> None:
    """A hoist whose block is held by an unknown force, its drum free of torque."""
    tree = da.hoist().to_tree()
    tree["drives"]["D"]["effort"] = "0 N*m"
    for angle in ("90 deg", "200 deg", "250 deg"):
        load = {"type": "force", "on": "block", "at": "B", "value": "unknown", "direction": angle}
        tree["loads"] = {"put": load}
        m = da.mechanism(tree)
        for _ in range(3):  # kept programs too
            r = da.statics(m, **options)
            assert set(r.status) == {"ok"}
            assert abs(r.load_array).min() > 1
    for effort, status in (("-1e-6 N*m", "slack"), ("1e-6 N*m", "ok")):  # small, but not rounding
        tree["drives"]["D"]["effort"] = effort
        assert set(da.statics(da.mechanism(tree)).status) == {status}
