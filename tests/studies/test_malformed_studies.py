"""Hundreds of malformed studies, made from right ones: each is refused at its line, with a remedy."""

from __future__ import annotations

from pathlib import Path

import pytest

import dalembert as da
from dalembert.analysis.batch.tracing.symbolic_model import number_kinds, numbers
from dalembert.studies.study_file import KEYS, load_study
from dalembert.units import KINDS
from tests.studies.test_study_files import MODEL, write

PLAIN = (
    *("stroke", "ratio", "pressure", "density", "speed", "bore"),
    *("links.ground.points.O.0", "joints.cylinder.direction", "links.rod.points.A.1"),
)
"""Numbers of the pump."""

SPREADS = (
    *("{}", "± ", "+- {} {}", "± {} ±", "± -{}", "normal", "normal ± {}", "uniform {}", "uniform"),
    *("{}..", "..{}", "{}..{}", "9 {unit}..1 {unit}", "1..2 {unit} in 0", "1 {unit}..2 {unit} in 99999999"),
    *("[]", "[{}, {}]", "[{}, long]", "[{}, true]", "{a: 1}"),
    *("± 5 furls", "± 1e400 {unit}", "± nan {unit}"),
)
"""Spreads that say nothing, of a quantity."""
WRONG_UNITS = {"number": "mm", "mass": "N"}
"""A unit of another kind, where kg does not serve."""


def malformed() -> list[tuple[dict[str, str | None], str]]:
    """Changed keys of a study, and the key whose line is to be named."""
    m, out = da.load(MODEL), list[tuple[dict[str, str | None], str]]()
    for path, kind in zip(PLAIN, number_kinds(m, numbers(m, PLAIN)), strict=True):
        unit = KINDS[kind].si
        for text in SPREADS:
            said = text.replace("{unit}", unit).replace("{}", f"1 {unit}".strip())
            out.append(
                ({"vary": f"{{{path}: '{said}'}}" if said[:1] not in "[{" else f"{{{path}: {said}}}"}, "vary")
            )
        wrong = WRONG_UNITS.get(kind, "kg")
        out += [
            ({"vary": f"{{{path}: {said} {wrong}}}"}, "vary")
            for said in ("±", "normal 1", "1..2", "uniform ± 1")
        ]
        keys = path.split(".")
        for k, key in enumerate(keys):
            if not key.isdigit():
                bad = ".".join([*keys[:k], key[:-1] + "q", *keys[k + 1 :]])
                out.append(({"vary": f"{{{bad}: ± 5 %}}"}, "vary"))
    for key in KEYS:
        if key not in ("model", "vary", "designs"):
            out.append(({key[:-1] + "q": "1"}, key[:-1] + "q"))
    for key in ("designs", "seed", "positions"):
        out += [
            ({key: text}, key)
            for text in ("-1", "1.5", "many", "true", "[1]", "{a: 1}", "1e30", ".nan", "null")
        ]
    for key in ("static", "keep"):
        out += [({key: text}, key) for text in ("1", "yes please", "[true]", "null")]
    for name in (
        "effort",
        "effort.P",
        "efort.O",
        "reaction.Q.magnitude",
        "effort.O +",
        "3 *",
        "peak effort.O",
    ):
        out.append(({"outputs": f"['{name}']"}, "outputs"))
    return out


@pytest.mark.long
def test_hundreds_of_malformed_studies_name_line_and_remedy(tmp_path: Path) -> None:
    some = malformed()
    assert len(some) >= 300
    wrong = []
    for changed, key in some:
        path = write(tmp_path, **changed)
        line = 1 + [text.partition(":")[0] for text in path.read_text().splitlines()].index(key)
        try:
            load_study(path)
            wrong.append((changed, "accepted"))
        except da.ModelError as error:
            if not (str(error).startswith(f"{path}:{line}: ") and error.remedy):
                wrong.append((changed, str(error)))
    assert not wrong, "\n".join(map(str, wrong))
