"""What a study refuses says why and what to do; what it says of itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import dalembert as da
from dalembert.errors import ModelError
from dalembert.studies.design_study import Study

M = da.four_bar(positions=3)
VARY = {"links.coupler.mass": "± 5 %", "links.crank.mass": "uniform ± 5 %"}
OUTPUTS = ["effort.O2", "reaction.A", "reaction.A.magnitude"]


def study(vary: Any = VARY, outputs: Any = OUTPUTS, **options: Any) -> Study:
    return da.study(M, vary, outputs, **{"designs": 16, **options})


def open_study() -> Study:
    """Hardly a design of it closes."""
    return study({"links.ground.points.O4.0": "10..11 m", "links.crank.mass": "± 1 %"}, ["effort.O2"])


def shares(output: str, **options: Any) -> Any:
    return study().contributions(output, **options)


def along(output: str, of: Study | None = None) -> Any:
    return (of or study()).contributions_along(output, designs=4)


TABLE = {"links.coupler.mass": ["1 kg"]}
CORRELATED = {("links.coupler.mass", "links.crank.mass"): 0.5}
REFUSED: dict[str, Callable[[], Any]] = {
    "no number varies; give path: spread, as stroke: ± 0.1 mm": lambda: study({}),
    "design 16 does not exist; use 0 to 15": lambda: study().design(16),
    "design is -1; give a whole number from 0": lambda: study().design(-1),
    "the study has 16 designs already; ask for more than 16": lambda: study().extended(8),
    "unknown sampling method 'sobbol'": lambda: study(draw="sobbol"),
    "links.coupler.mass: a factorial needs levels; write a list, or 70..90 N in 5": lambda: study(draw="factorial"),
    "a factorial has no correlation; leave it out, or draw at random": lambda: study(
        {"links.coupler.mass": ["1 kg", "2 kg"], "links.crank.mass": ["1 kg", "2 kg"]},
        draw="factorial",
        correlation=CORRELATED,
    ),
    "the correlations contradict each other; make some of them smaller": lambda: study(
        {**VARY, "links.rocker.mass": "± 5 %"},
        correlation={
            ("links.coupler.mass", "links.crank.mass"): 0.9,
            ("links.coupler.mass", "links.rocker.mass"): 0.9,
            ("links.crank.mass", "links.rocker.mass"): -0.9,
        },
    ),
    "shares of correlated numbers are not defined": lambda: study(correlation=CORRELATED).contributions("effort.O2"),
    "the table has no column 'links.rocker.mass'; it has: links.coupler.mass": lambda: study(
        ["links.rocker.mass"], draw={"links.coupler.mass": ["1 kg"]}
    ),
    "'links.crank.points.A' is a vector; give a column of 'links.crank.points.A.0', and so on": lambda: study(
        [], draw={"links.crank.points.A": ["1 m"]}
    ),
    "a table of designs needs columns of one length; give a value of each path for each": lambda: study(
        [], draw={"links.coupler.mass": ["1 kg"], "links.crank.mass": ["1 kg", "2 kg"]}
    ),
    "an output is named twice; leave one of them out": lambda: study(outputs=["effort.O2", "effort.O2"]),
    "unknown method of contributions 'sobbol'; use linear or sobol": lambda: shares("effort.O2", by="sobbol"),
    "'effort.O9' is not an output of the study; the outputs are effort.O2, reaction.A": lambda: shares("effort.O9"),
    "reaction.A has 2 numbers a design; ask for a scalar, as reaction.A.magnitude": lambda: shares("reaction.A"),
    "the number of designs, 100, is not a power of two; use 4096, for example": lambda: shares(
        "effort.O2", by="sobol", designs=100
    ),
    "hardly a design has a value of effort.O2; make the spreads smaller": lambda: open_study().contributions(
        "effort.O2", by="sobol", designs=4
    ),
    "hardly a design has a value of effort.O2; make the spreads": lambda: along("effort.O2", open_study()),
    "reaction.A is a vector; ask for reaction.A.x or reaction.A.magnitude": lambda: along("reaction.A"),
    "no corner has a value of effort.O2; make the spreads smaller": lambda: open_study().worst_case("effort.O2"),
    "a table says no spread; give vary= spreads": lambda: study([], draw=TABLE).worst_case("effort.O2"),
    "'links.rocker.mass' does not vary": lambda: study().response("effort.O2", "links.rocker.mass"),
    "no design has a value of effort.O2; see failed()": lambda: open_study().run().worst("effort.O2"),
}  # fmt: skip


@pytest.mark.parametrize("sentence", REFUSED)
def test_a_study_refuses_with_a_sentence(sentence: str) -> None:
    with pytest.raises(ModelError) as refused:
        REFUSED[sentence]()
    assert str(refused.value).startswith(sentence)


def test_a_study_says_what_it_is() -> None:
    assert repr(study()) == (
        "<Study of 'Four-bar linkage': 2 numbers, 16 designs by random, "
        "effort.O2, reaction.A, reaction.A.magnitude>"
    )


def test_numbers_without_effect_are_found_in_spreads_and_in_tables() -> None:
    """The crank's mass has none on the coupler's angle, nor a rotor's about its own pin on the effort."""
    assert study(outputs=["angle.coupler"]).idle() == ("links.coupler.mass", "links.crank.mass")
    table = {"links.coupler.mass": ["1 kg", "2 kg"], "links.ground.points.O4.0": ["300 mm", "310 mm"]}
    assert study([], ["angle.coupler"], draw=table).idle() == ("links.coupler.mass",)
