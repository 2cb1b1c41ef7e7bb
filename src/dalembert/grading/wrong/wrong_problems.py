"""The same problem solved with one thing wrong: parts of the superposition changed, or a datum.

Mechanics: docs/theory.md 12.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cache, cached_property, partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dalembert.analysis.compile.compiled_mechanism import Compiled, compile_mechanism
from dalembert.analysis.methods.applied_forces import known_actions
from dalembert.analysis.methods.superposition import changed_by, refuse_nonlinear
from dalembert.analysis.one_pass import at_poses
from dalembert.arrays import Array, Tree
from dalembert.errors import DalembertError, ModelError
from dalembert.grading.wrong.misread_geometry import Misread, misread_geometry
from dalembert.grading.wrong.wrong_data import Change, Mistake, change_numbers, changes, times
from dalembert.grading.wrong.wrong_wrenches import FACTORS, wrench_changes
from dalembert.units import file_units

if TYPE_CHECKING:
    from dalembert.analysis.result.result import Result

CONCEPTS = (
    "gravity is",
    "weights act",
    "inertia is",
    "inertia forces",
    "inertia couples",
    "moments of inertia",
    "weight is mistaken",
    "g is in",
    "rpm",
    "speed",
    "position",
    "assembly mode",
    "degrees",
    "friction is left out",
)
"""Words of mistakes that concern the complete problem, not one of its data."""

STATIC: Tree = {}
"""The change that leaves all inertia out."""


class WrongProblem(NamedTuple):
    """The problem with one mistake, in words; order: how usual it is, from 1 (parts of the loads) to 3; solved when
    asked.

    ``weight``: ``concept`` of what runs through the complete problem (all gravity, all inertia, the speed's unit, the
    position), ``datum`` of one load, link, mass or length.
    """

    order: int
    sentence: str
    solution: Callable[[], Result | None]

    @property
    def weight(self) -> str:
        """Extent of the mistake in the problem."""
        return "concept" if any(words in self.sentence for words in CONCEPTS) else "datum"


class WrongProblems:
    """The problem at some positions, right and with one mistake each. None where the position itself is unknown: a
    mistake would change it."""

    def __init__(self, result: Result, which: Sequence[int] | None = None) -> None:
        self.full = result
        self.which = np.arange(len(result.status)) if which is None else np.array(which, np.intp)
        self.result = result if which is None else self._at(result.compiled, result)

    def __iter__(self) -> Iterator[WrongProblem]:
        yield from self.usual()
        if self.full.schedule.unknown is None:
            yield from self._of_wrenches
            yield from self._misread

    def linear(self) -> list[WrongProblem]:
        """The usual mistakes whose changes of the answer add up: none with friction, or at an unknown position."""
        try:
            refuse_nonlinear(self.result)
        except ModelError:
            return []
        if self.full.schedule.unknown is not None:
            return []
        return [*self._linear, *(p for p in self._of_wrenches if p.order < 3)]

    def usual(self) -> Iterator[WrongProblem]:
        """The mistakes that every variant of an exam must show: parts of the superposition, and single data."""
        if self.full.schedule.unknown is None:
            yield from self._linear
            yield from self._changed

    @cached_property
    def _linear(self) -> list[WrongProblem]:
        """Loads, weights and inertia left out, reversed or scaled."""
        try:
            variants = _with_factor(self.result)
            return [WrongProblem(1, words, partial(_same, result)) for words, result in variants]
        except ModelError:  # with friction parts do not add
            return self._each(1, _scaled(self.result))

    @cached_property
    def _changed(self) -> list[WrongProblem]:
        """One datum changed."""
        modes = _other_modes(self.full) if self.full.mechanism.dimension == 2 else ()
        other: list[Mistake] = [("this is the other assembly mode", {"assembly": m}) for m in modes]
        return self._each(2, [*changes(self.full), *other])

    @cached_property
    def _of_wrenches(self) -> list[WrongProblem]:
        """Forces and couples of one mistake more on the links; with friction loads alone, by factors."""
        r = self.result
        try:
            refuse_nonlinear(r)
        except ModelError:
            loads = dict.fromkeys(a.of for a in known_actions(r) if a.kind == "load")
            scaled = [
                (f"load {name} {words}", change)
                for name in loads
                for factor, words in FACTORS
                if (change := _scaling(r, [name], factor)) is not None
            ]
            return self._each(3, scaled)
        with np.errstate(all="ignore"):  # where points fall together a mistake has no number
            out = list(wrench_changes(r))
        return [WrongProblem(c.order, c.sentence, cache(partial(changed_by, r, c.added))) for c in out]

    @cached_property
    def _misread(self) -> list[WrongProblem]:
        """Geometry misread, each assembled and solved again."""
        return [
            WrongProblem(c.order, c.sentence, cache(partial(self._solve, c)))
            for c in misread_geometry(self.full)
        ]

    def _each(self, order: int, mistakes: Iterable[Mistake]) -> list[WrongProblem]:
        return [WrongProblem(order, words, cache(partial(self._solve, change))) for words, change in mistakes]

    def _solve(self, change: Change | Misread) -> Result | None:
        """The answer after a change, in the same poses where the change leaves them."""
        from dalembert.analysis.solution import dynamics, statics

        r = self.full
        try:
            if callable(change):
                return self._at(change(r.compiled), r)
            if change is STATIC:
                return self._at(r.compiled, r, inertia=False)
            anew = isinstance(change, Misread) or "assembly" in change
            m = r.mechanism.with_values(change.values if isinstance(change, Misread) else change)
            if anew:
                result = (dynamics if r.inertia else statics)(m)
                return self._at(result.compiled, result)
            return self._at(compile_mechanism(m, m.schedule(), r.compiled.layout.redundant), r)
        except DalembertError:
            return None

    def _at(self, c: Compiled, like: Result, inertia: bool = True) -> Result:
        """At the positions asked for, in the poses of another result."""
        turns = like.compiled.forcing.resistances.turns
        resistances = replace(c.forcing.resistances, turns=turns)
        c = replace(c, forcing=replace(c.forcing, resistances=resistances), counts=like.compiled.counts)
        return at_poses(c, like, self.which, like.inertia and inertia)


def _same(result: Result) -> Result:
    return result


def _with_factor(r: Result) -> Iterator[tuple[str, Result]]:
    from dalembert.analysis.methods.superposition import superposition

    parts = superposition(r)

    def with_weights(factor: dict[str, float]) -> Result:
        w = np.array([factor.get(s, 1.0) for s in parts.sources])

        def total(a: Array) -> Array:
            return np.asarray(np.tensordot(w, a, axes=1))

        return replace(
            r,
            force_array=total(parts.force),
            moment_array=total(parts.moment),
            effort_array=total(parts.efforts),
            load_array=total(parts.loads),
        )

    for sentence, some, factor in _weightings(r, parts.sources):
        yield sentence, with_weights(dict.fromkeys(some, factor))


def _scaled(r: Result) -> Iterator[Mistake]:
    """The same as changes of the compiled numbers; none for values that are not separate among them."""
    sources = tuple(dict.fromkeys(a.source for a in known_actions(r)))
    inertia = {s for s in sources if s.startswith("inertia")}
    for sentence, some, factor in _weightings(r, sources):
        if set(some) == inertia and not factor:
            yield sentence, STATIC
        elif (change := _scaling(r, some, factor)) is not None:
            yield sentence, change


def _scaling(r: Result, sources: Sequence[str], factor: float) -> Change | None:
    """Numbers of some sources times a factor."""
    m = r.mechanism
    weights = (
        {f"weight of {link}" for link in r.links if m.mass(link)} if any(m.gravity_vector) else set[str]()
    )
    mass, inertia = np.ones(len(r.links)), np.ones(len(r.links))
    names = [[name for name, load in m.loads_on(on).items() if not load.unknown] for on in ("point", "link")]
    loads = [np.ones(len(some)) for some in names]
    pull = factor if weights and weights <= set(sources) else 1.0
    for source in sources:
        kind, _, link = source.rpartition(" of ")
        if kind == "weight" and pull == factor:
            continue
        if kind == "inertia couple":
            inertia[r.links.index(link)] = factor
        elif kind == "inertia force" and not weights:
            mass[r.links.index(link)] = factor
        elif source in names[0] or source in names[1]:
            which = int(source not in names[0])
            loads[which][names[which].index(source)] = factor
        else:
            return None

    def change(c: Compiled) -> Compiled:
        for part, new in (
            ("inertia", {"mass": mass, "inertia": inertia[:, None], "gravity": pull}),
            ("forces", {"value": loads[0][:, None]}),
            ("couples", {"value": loads[1][:, None]}),
        ):
            c = change_numbers(f"forcing.{part}", **{name: times(f) for name, f in new.items()})(c)  # type: ignore[arg-type, operator]
        return c

    return change


def _weightings(r: Result, sources: Sequence[str]) -> Iterator[tuple[str, list[str], float]]:
    """Mistakes with the sources that they scale, and by how much."""
    forces = [s for s in sources if s.startswith("inertia force")]
    couples = [s for s in sources if s.startswith("inertia couple")]
    weights = [s for s in sources if s.startswith("weight of")]
    for sentence, some, factor in _of_kinds(r, forces, couples, weights):
        if some:
            yield sentence, some, factor
    links = [link for link in r.links if f"inertia force of {link}" in forces]
    for link in links if len(links) > 1 else ():
        some = [s for s in (*forces, *couples) if s.endswith(f" of {link}")]
        if len(some) > 1:
            yield f"the inertia of {link} is left out", some, 0.0
    for source in sources:
        words = f"the {source}" if " of " in source else f"load {source}"
        yield f"{words} is left out", [source], 0.0
        yield f"{words} has the wrong sense", [source], -1.0


def _of_kinds(
    r: Result, forces: list[str], couples: list[str], weights: list[str]
) -> Iterator[tuple[str, list[str], float]]:
    both = [*forces, *couples]
    if both:
        yield "inertia is left out: this is the static answer", both, 0.0
        yield "the inertia couples are left out", couples, 0.0
        yield "the inertia forces are left out", forces, 0.0
        yield "inertia forces and couples act along the accelerations, not against them", both, -1.0
        yield "the inertia couples have the sense of the accelerations, not against them", couples, -1.0
        yield "the inertia forces have the sense of the accelerations, not against them", forces, -1.0
        for g, unit in _gravities(r):
            yield (
                f"weight is mistaken for mass: inertia forces are too large by g = {g:.5g} {unit}",
                forces,
                g,
            )
            yield f"weight is mistaken for mass: inertia is too large by g = {g:.5g} {unit}", both, g
        yield "g is in ft/s2 where lengths are inches: the masses are too large by 12", forces, 12.0
        yield "g is in in/s2 where lengths are feet: the masses are too small by 12", forces, 1 / 12
        yield "the moments of inertia are in the wrong unit of length: a factor of 12", couples, 12.0
        yield "the moments of inertia are in the wrong unit of length: a factor of 12", couples, 1 / 12
        yield "the moments of inertia are in the wrong unit of length: a factor of 144", couples, 1 / 144
    yield "gravity is left out", weights, 0.0
    yield "the weights act upwards", weights, -1.0


def _gravities(r: Result) -> list[tuple[float, str]]:
    """g as a number in the file's units, and 9.81."""
    units = file_units(r.mechanism.units)
    in_file = units.unit("acceleration").of_si(r.mechanism.g)
    out = [(in_file, units.text("acceleration"))]
    return out if abs(in_file - 9.80665) < 0.1 else [*out, (9.80665, "m/s2")]


def _other_modes(r: Result) -> Iterator[dict[str, float]]:
    """Angles of the links in the other assembly modes of the first position."""
    from dalembert.core.position.first_pose_plane import Guess

    c = r.compiled
    shape = np.shape(c.layout.reference)
    modes = Guess(np.full(shape[0], np.nan), np.full(shape, np.nan)).modes(c.layout, c.targets[0])
    if modes is None:
        return
    for turn in modes.pose.turn[:, :-1]:
        if np.abs(np.angle(np.exp(1j * (turn - r.turn_array[0])))).max() > 1e-6:
            yield dict(zip(r.links, map(float, turn), strict=True))
