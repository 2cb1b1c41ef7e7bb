"""Free bodies of solved mechanisms are force systems in equilibrium, each link alone and some taken together."""

from __future__ import annotations

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.errors import AnalysisError, ModelError
from tests.friction.test_reversals import DEAD_CENTRE
from tests.random_mechanisms import random_case

BUNDLED = {
    **examples(),
    **{name: path for name, path in cases().items() if name.startswith(("seed-003", "st-"))},
}


@pytest.mark.parametrize("name", list(BUNDLED))
def test_every_link_is_in_equilibrium(name: str) -> None:
    r = da.solve(da.load(BUNDLED[name]))
    good = np.flatnonzero(r.ok)
    assert good.size
    for k in good[np.unique(np.linspace(0, good.size - 1, 3).astype(int))]:
        for link in r.links:
            found = da.wrench.on(r, link, at=int(k) + 1).equilibrium(length=r.compiled.layout.length)
            assert found.holds, (link, found.sentence)


@pytest.mark.parametrize("seed", range(10))
def test_links_of_random_mechanisms(seed: int) -> None:
    """Each link, and all together with the joints between them left out."""
    r = da.solve(da.mechanism(random_case(seed)[1]))
    assert r.status[0] == "ok"
    length = r.compiled.layout.length
    largest = max(f.size for link in r.links for f in da.wrench.on(r, link).forces)
    for link in r.links:
        s = da.wrench.on(r, link)
        assert np.linalg.norm(s.resultant) <= 1e-9 * largest
        assert abs(s.moment(s.middle)) <= 1e-9 * largest * length
    together = da.wrench.on(r, *r.links)
    between = {n for n, j in r.mechanism.joints.items() if "ground" not in j.links}
    assert not {f"F_{n}" for n in between} & {f.name for f in together.forces}
    assert abs(together.moment(together.middle)) <= 1e-9 * largest * length


def test_a_reaction_is_the_results() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]))
    rod = da.wrench.on(r, "coupler", at="60 deg")
    assert rod["F_A"].vector.tolist() == r.reaction("A", on="coupler")[0].tolist()
    assert rod["F_A"].kind == "joint"
    assert da.wrench.on(r, "crank")["effort of O2"].moment == pytest.approx(float(r.effort("O2")[0]))
    assert da.wrench.arrangement(da.wrench.on(da.statics(r.mechanism), "crank")) == "parallel"


def test_a_title_has_the_position_where_there_are_several() -> None:
    m = da.load(examples()["four_bar"])
    one, two = da.dynamics(m), da.dynamics(m, positions=2)
    assert da.wrench.on(one, "coupler", "crank").title == "coupler and crank"
    assert da.wrench.on(two, "coupler", at=2).title == "coupler, position 2"


def test_what_cannot_be_asked() -> None:
    r = da.dynamics(da.load(examples()["four_bar"]))
    with pytest.raises(da.ModelError, match="unknown link 'cuopler'; did you mean 'coupler'"):
        da.wrench.on(r, "cuopler")
    with pytest.raises(da.ModelError, match="no link is named"):
        da.wrench.on(r)
    broken = da.kinematics(r.mechanism.with_values({"links.coupler.points.B": ["1 in", 0]}))
    assert broken.status == ("not_assembled",)
    with pytest.raises(da.AnalysisError) as error:
        da.wrench.on(broken, "crank")
    assert str(error.value) == f"position 1: {broken.reasons[0]}"


def test_a_free_body_says_which_it_is_or_why_it_is_none() -> None:
    m = da.load(BUNDLED["four_bar"])
    r = da.statics(m.with_values({"links.coupler.points.B": [0.0, 0.14]}), positions=24)
    k = r.ok.argmax()
    assert da.wrench.on(r, "coupler", "rocker").title == f"coupler and rocker, position {k + 1}"
    with pytest.raises(AnalysisError) as caught:
        da.wrench.on(r, "coupler", at=1)
    assert str(caught.value) == f"position 1: {r.reasons[0]}"
    wrong: list[tuple[da.Result, tuple[str, ...], str]] = [
        (r, ("couplr",), "unknown link 'couplr'; did you mean 'coupler'?"),
        (r, (), "no link is named; name some of crank, coupler, rocker"),
        (
            da.kinematics(m),
            ("coupler",),
            "this result is a motion without forces; take one of da.dynamics or da.statics",
        ),
    ]
    for result, links, said in wrong:
        with pytest.raises(ModelError) as refused:
            da.wrench.on(result, *links)
        assert str(refused.value) == said


def test_the_title_of_a_free_body_says_what_is_not_unique() -> None:
    """At the dead centre of a slider-crank friction reverses."""
    s = da.statics(da.loads(DEAD_CENTRE.format(way=1, couple=0, force=100)))
    assert [da.wrench.on(side, "rod", at=1).title for side in (s, s.after)] == [
        "rod, position 1, just before contacts reverse",
        "rod, position 1",
    ]
    assert da.wrench.on(s, "rod", at=2).title == "rod, position 2"
