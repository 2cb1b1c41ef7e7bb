"""Programs are as short as they were: what a position costs, by counts of operations, which no processor changes.

`program_sizes.txt` holds them; `python -m tests.kernel.test_program_sizes` writes it anew. A closed form, an
elimination or a simplification that is no longer found makes a program longer, though its numbers stay right.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.kernel.program import SLOW
from dalembert.model.library import TEMPLATES
from tests.tiers import tiers

KEPT = Path(__file__).with_name("program_sizes.txt")
PART = 0.02
"""How much longer or shorter a program may be: the pivots of equal worth are chosen by rounding."""
FILES = (
    *(
        "seed-002-7a-engine-friction-circles",
        "seed-002-7gb-engine-guide-10-mm",
        "pump",
        "quick_return",
        "engine",
    ),
    *("cam-4-flat-follower-on-an-eccentric", "cam_and_follower"),
    *("gtr-3-compound-epicyclic-train", "truss"),
)
LEFT_OUT = "screw_jack", "stephenson_2", "bevel_differential", "double_cardan", "spherical_four_bar"
NAMES = (*(t for t in TEMPLATES if t not in LEFT_OUT), *FILES)


def counts(name: str) -> dict[str, int]:
    """Operations of a design, of a position, seldom and rarely; slow ones; flags and decisions, with derivatives."""
    m = getattr(da, name)() if name in TEMPLATES else da.load((cases() | examples())[name])
    k = da.compile(
        m, [f"drives.{d}.speed" for d in m.drives if m.drives[d].speed is not None][:1], derivatives=True
    )
    p = k.program(k.flat)
    slow = Counter(n.op for n in (*p.design, *p.position) if SLOW.get(n.op))
    flags = {flag: len(getattr(p.flags, flag)) for flag in p.flags.__dataclass_fields__}
    found = {
        "design": len(p.design),
        "position": len(p.position),
        "seldom": len(p.seldom),
        "rare": len(p.rare),
    }
    found |= {
        **slow,
        **flags,
        "decisions": len(p.graph.decisions),
        "depth": p.depth,
        "size": p.size,
        "waits": int(p.waits),
        "channels": len(p.inputs_in_use("channel")),
    }
    return {key: n for key, n in sorted(found.items()) if n}


def written(name: str) -> str:
    return f"{name}: " + ", ".join(f"{key} {n}" for key, n in counts(name).items())


@pytest.mark.parametrize("name", tiers(NAMES[::2], NAMES[1::2]))
def test_a_program_is_as_short_as_it_was(name: str) -> None:
    row = next(line for line in KEPT.read_text(encoding="utf-8").splitlines() if line.startswith(f"{name}: "))
    kept = {key: int(n) for key, n in (part.split() for part in row.partition(": ")[2].split(", "))}
    assert counts(name) == {key: pytest.approx(n, rel=PART) for key, n in kept.items()}


if __name__ == "__main__":
    KEPT.write_text("".join(f"{written(name)}\n" for name in NAMES), encoding="utf-8")
