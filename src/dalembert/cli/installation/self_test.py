"""A quick self-test of the installation: bundled problems by independent routes of the program, in about a second."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.util import find_spec

TOLERANCE = 1e-9
"""Relative difference from which on two routes to one number disagree."""


def outcomes() -> Iterator[tuple[str, str]]:
    """Each check that this installation can make and what is wrong, "" where nothing is; an error of any kind is the
    check's failure."""
    for name, check in CHECKS.items():
        if check is _machine_code and find_spec("llvmlite") is None:
            continue
        try:
            yield name, check()
        except Exception as error:
            yield name, f"{type(error).__name__}: {error}"


def compared(name: str, first: float, second: float) -> str:
    """Sentence if two values of one quantity differ, else "".

    >>> compared("effort", -100.0, -100.0 + 5e-8), compared("effort", 1.0, float("nan"))
    ('', 'effort: 1.0 by one route, nan by the other')
    >>> compared("effort", 1.0, -1.0)
    'effort: 1.0 by one route, -1.0 by the other'
    """
    same = abs(first - second) <= TOLERANCE * abs(first)
    return "" if same else f"{name}: {first!r} by one route, {second!r} by the other"


def _virtual_work() -> str:
    import dalembert as da
    from dalembert.bundled import examples

    r = da.dynamics(da.load(examples()["four_bar"]))
    return compared("effort", float(r.effort("O2")[0]), float(da.virtual_work(r).effort.ravel()[0]))


def _published() -> str:
    import dalembert as da
    from dalembert.bundled import cases
    from dalembert.grading.file_answers import check

    rows = check(da.load(cases()["seed-002-7g-engine-guide-100-mm"]))
    wrong = [row.quantity for row in rows if not row.ok]
    if not rows:
        return "the bundled problem has no answers"
    return f"{', '.join(wrong)} differ from the published answers" if wrong else ""


def _machine_code() -> str:
    import dalembert as da
    from dalembert.bundled import examples

    m = da.load(examples()["four_bar"])
    k = da.compile(m, vary=["links.coupler.weight"])
    coded = k([[float(m.links["coupler"].weight or 0)]])["effort.O2"]
    return compared("effort", float(da.dynamics(m).effort("O2")[0]), float(coded.ravel()[0]))


CHECKS: dict[str, Callable[[], str]] = {
    "forces of a four-bar by equilibrium and by virtual work": _virtual_work,
    "published answers of an engine with friction": _published,
    "machine code against the analysis": _machine_code,
}
"""Name of a check -> the check: a sentence if something is wrong."""
