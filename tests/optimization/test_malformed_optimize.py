"""Malformed optimize files, made from a right one: each is refused at its line, with what would be right."""

from __future__ import annotations

from pathlib import Path

import pytest

import dalembert as da
from dalembert.optimization.optimize_file import optimize_file
from tests.tiers import tiers

FILE = """\
optimize: 1
model: four_bar.yaml
vary:
  links.ground.points.O4.0: [280 mm, 360 mm]
  links.rocker.points.B: ["[200 mm, 0]", "[280 mm, 0]"]
least: peak effort.O2
where:
  - transmission.B >= 33 deg
  - peak reaction.O4.magnitude <= 900 N
starts: 5
seed: 1
positions: 24
static: false
"""
PLACE = "links.ground.points.O4.0"
BOUNDS = (
    *("280 mm", "[280 mm]", "[1, 2, 3, 4]", "{low: 1}", "null", "'[280 mm, 360 mm]'", "[[1, 2], [2, 3]]"),
    *("[280 kg, 360 mm]", "[280 mm, 360 kg]", "[280 mm, 360 mm, 5 kg]", "[280 furls, 360 mm]", "[a, b]"),
    *("[360 mm, 280 mm]", "[280 mm, 360 mm, 0]", "[280 mm, 360 mm, -5 mm]"),
    *("[.nan, 1]", "[0, .inf]", "[true, 1]", "[null, 1]", "[1e400, 2e400]"),
)
PATHS = (
    *("links.ground.points.O9.0", "links.grund.points.O4.0", "links.ground.points.O4.7", "joints", "title"),
    *("stroke", "3", "links.crank.weight", "drives.O2.position", "drives.O2", "joints.A.type"),
)
AIMS = (
    *("3", "", "[effort.O2]", "''", "peak", "peek effort.O2", "max effort.O2", "envelope effort.O2"),
    *("peak efort.O2", "effort.O9", "peak effort", "load.F", "peak reaction.A.w", "reaction.A", "peak 3"),
    *("peak effort.O2 +", "rms (effort.O2", "sin(", "foo(effort.O2)", "peak __import__('os')"),
    *("peak effort.O2 <= 3", "peak effort.O2 ** 1e9", "effort.O2 + 3 kg", "peak max(effort.O2, 3 mm)"),
)
CONDITIONS = (
    *("3", "{a: 1}", "null", "[a]", "transmission.B", "effort.O2 <=", "'>= 3'", "effort.O2 <= peak"),
    *("transmission.B = 33 deg", "transmission.B => 33 deg", "effort.O2 == 3", "effort.O2 != 3"),
    *("transmission.B >= 33 deg >= 3", "transmission.B > > 3", "effort.O2 <= 3 and effort.O2 >= 0"),
    *("transmission.B >= 33 kg", "transmission.B >= 33 N", "transmission.B >= 33 furlongs"),
    *("33 mm <= transmission.B", "abs(effort.O2) <= 2*3 N", "peak reaction.O4.magnitude <= 3 kg"),
    *("transmision.B >= 33 deg", "transmission.Q >= 33 deg", "peak magnitud.O4 <= 3 N"),
    *("reaction.A <= 3 N", "rms effort.O2 <= 3 N", "peek effort.O2 <= 3 N*m", "mean(effort.O2 <= 3 N*m"),
    *("3 N <= peak(effort.O2)", "peak effort.O2 + range(effort.O2) >= 3", "range(effort.O9) <= 3"),
)
NO_NUMBERS = ("-1", "many", "1.5", "null", "true", "[1]", "1e30", ".nan")


def malformed() -> list[tuple[str, str, int]]:
    """A piece of the file, what stands in its place, and the line that is wrong then."""
    vary = FILE[FILE.index("vary:") : FILE.index("least")]
    where = FILE[FILE.index("where:") : FILE.index("starts")]
    out = [("optimize: 1", f"optimize: {x}", 1) for x in ("2", "one", "true")]
    out += [("model: four_bar.yaml", f"model: {x}", 2) for x in ("none.yaml", "", "3", "[a]")]
    out += [(f"{PLACE}: [280 mm, 360 mm]", f"{PLACE}: {x}", 4) for x in BOUNDS]
    out += [(f"{PLACE}:", f"{x}:", 4) for x in PATHS]
    out += [(f"{PLACE}: [280 mm, 360 mm]", "links.coupler.mass: [-5 kg, -1 kg]", 4)]
    out += [(PLACE, "links.rocker.points.B.0", 5), (f"  {PLACE}", f"  {PLACE}: [1, 2]\n  {PLACE}", 5)]
    out += [("[280 mm, 360 mm]", "[1 m, 2 m]", 3)]
    out += [(vary, f"vary: {x}\n", 3) for x in ("3", "{}", "[a, b]")] + [(vary, "", 1)]
    out += [("least: peak effort.O2", f"least: {x}", 6) for x in AIMS]
    out += [("- transmission.B >= 33 deg", f"- {x}", 8) for x in CONDITIONS]
    out += [("- peak reaction.O4.magnitude <= 900 N", f"- {x}", 9) for x in CONDITIONS[-3:]]
    out += [(where, f"where: {x}\n", 7) for x in ("3", "{a: 1}", "transmission.Q >= 3 deg")]
    keys = (("starts: 5", 10), ("seed: 1", 11), ("positions: 24", 12))
    out += [(old, f"{old.split(':')[0]}: {x}", line) for old, line in keys for x in NO_NUMBERS]
    out += [("starts: 5", f"starts: {x}", 10) for x in ("0", "2000000")]
    out += [("positions: 24", f"positions: {x}", 12) for x in ("0", "1e12")]
    out += [("static: false", f"static: {x}", 13) for x in ("1", "maybe", "[true]", "null")]
    for k, line in enumerate(FILE.splitlines(), 1):
        if not line.startswith(" "):
            out.append((line, "q" + line, k))
    out += [("starts: 5", f"method: {x}", 10) for x in ("3", "null", "slsqp", "nlopt.slsq", "pymoo.nsga2")]
    return [*out, ("starts: 5", "links: {}", 10)]


@pytest.mark.parametrize("part", tiers([0], range(1, 20)))
def test_malformed_files_name_line_and_remedy(tmp_path: Path, part: int) -> None:
    """The quick part is every twentieth file."""
    da.four_bar().save(tmp_path / "four_bar.yaml")
    path, wrong = tmp_path / "optimize.yaml", []
    some = malformed()
    assert len(some) >= 130
    for old, new, line in some[part::20]:
        assert old in FILE
        path.write_text(FILE.replace(old, new, 1), encoding="utf-8")
        try:
            optimize_file(path)
            wrong.append((new, "accepted"))
        except da.ModelError as error:
            if not (str(error).startswith(f"{path}:{line}: ") and error.remedy):
                wrong.append((new, str(error)))
    assert not wrong, "\n".join(map(str, wrong))
