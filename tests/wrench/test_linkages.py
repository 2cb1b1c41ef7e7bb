"""Free bodies of solved mechanisms are force systems in equilibrium, each link alone and some taken together."""

from __future__ import annotations

import numpy as np
import pytest

import dalembert as da
from dalembert.bundled import cases, examples
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
