"""Exceptions that say where and what to do, and the table of statuses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from errno import ENOENT
from typing import NamedTuple, Protocol


class Locator(Protocol):
    """Knows the file a description came from and the line of each of its keys."""

    @property
    def name(self) -> str: ...

    def line(self, path: Sequence[str | int]) -> int: ...


class DalembertError(Exception):
    """Base of every exception this package raises on purpose.

    >>> import dalembert as da
    >>> issubclass(da.AnalysisError, DalembertError), issubclass(da.ModelError, DalembertError)
    (True, True)
    """


class ModelError(DalembertError, ValueError):
    """A description, file or request that is wrong: what is wrong, what would be right.

    >>> print(ModelError("joint 'A' names the link 'rodd'", "did you mean 'rod'?"))
    joint 'A' names the link 'rodd'; did you mean 'rod'?
    """

    def __init__(
        self, what: str, remedy: str = "", path: Sequence[str | int] = (), file: str = "", line: int = 0
    ) -> None:
        self.what, self.remedy, self.path = what, remedy, tuple(path)
        self.file, self.line = file, line
        super().__init__(what, remedy)

    def __str__(self) -> str:
        where = f"{self.file}:{self.line}: " if self.line else f"{self.file}: " if self.file else ""
        return where + (f"{self.what}; {self.remedy}" if self.remedy else self.what)

    def at_source(self, source: Locator | None) -> ModelError:
        """The same error with file and line, if the description came from a file."""
        if source is None or self.file:
            return self
        return self.at_line(source.name, source.line(self.path))

    def at_line(self, file: str, line: int) -> ModelError:
        """The same error at a line of a file."""
        return ModelError(self.what, self.remedy, self.path, file, line)


class ArgumentError(ModelError):
    """A number given to a function or an option that is out of its bounds: no line of a model file is wrong."""

    def at_source(self, source: Locator | None) -> ModelError:
        """The same error; only one with keys belongs to a file."""
        return super().at_source(source) if self.path else self


class MissingFileError(ModelError, FileNotFoundError):
    """A file, or a folder, that does not exist.

    >>> print(MissingFileError("engin.yaml", "did you mean 'engine.yaml'?"))
    engin.yaml: file not found; did you mean 'engine.yaml'?
    """

    __new__ = FileNotFoundError.__new__  # type: ignore[assignment]  # ValueError's, which comes first, cannot

    def __init__(self, name: str, remedy: str = "") -> None:
        super().__init__("file not found", remedy, file=name)
        self.errno, self.filename = ENOENT, name


@contextmanager
def errors_at(*path: str | int, file: str = "", line: int = 0) -> Iterator[None]:
    """Adds the keys, and the file and line if any, to errors of a description that are raised inside.

    >>> with errors_at("answers", 2):
    ...     raise ModelError("this is wrong")
    Traceback (most recent call last):
    dalembert.errors.ModelError: this is wrong
    """
    try:
        yield
    except ModelError as e:
        raise ModelError(e.what, e.remedy, (*path, *e.path), file or e.file, line or e.line) from None


class AnalysisError(DalembertError):
    """A position has no answer and the caller asked to be strict: the sentence of its status.

    >>> import dalembert as da
    >>> m = da.four_bar().with_values({"links.coupler.points.B.0": 0.01})
    >>> try:
    ...     da.statics(m, strict=True)
    ... except AnalysisError as error:
    ...     print(str(error).split(":")[0])
    position 1-7
    """


class Status(NamedTuple):
    """Meaning of a status code, and the remedy."""

    sentence: str
    remedy: str


STATUSES: dict[str, Status] = {
    "ok": Status("Solved.", ""),
    "not_assembled": Status(
        "The linkage does not close at this position, or the solver did not reach a closed pose.",
        "Change a length, the assembly or the range of the drive.",
    ),
    "singular": Status(
        "A dead centre or change point: the drive cannot hold or move the mechanism here.",
        "Drive another joint, or step over this position.",
    ),
    "redundant": Status(
        "More constraints than needed: some reactions depend on the elasticity of the links.",
        "Read the unique components; free a constraint, or give the joints a stiffness, to get the others.",
    ),
    "undefined_load": Status(
        "A preloaded spring, or one of constant force, has zero length here: its force has no direction.",
        "Step over this position, move an end of the spring, or remove the free length of a preloaded one.",
    ),
    "overflow": Status(
        "A number is too large for the arithmetic: beyond 1.8e308 in SI, or joints of a link more than 1e150 m apart.",
        "Check units: some speed, mass, length or load is wrong by many orders of magnitude.",
    ),
    "no_balance": Status(
        "No equilibrium with the known efforts and loads.",
        "Leave an effort or a load unknown, or widen the range.",
    ),
    "jammed": Status(
        "Friction holds the mechanism: no effort moves it in this direction.",
        "Reduce friction or change the geometry.",
    ),
    "self_locking": Status(
        "Friction reverses the sense of the drive's effort.",
        "Reduce friction if the load is to drive the machine.",
    ),
    "reversal": Status(
        "Friction reverses here: the numbers jump from those just before to those just after.",
        "",
    ),
    "outside_table": Status(
        "The table of a load ends before this position: its end value was used.",
        "Give the table more points, make it periodic, or write outside: hold or outside: zero.",
    ),
    "contact_lost": Status(
        "A contact that only pushes would have to pull, or the reverse: it is lost.",
        "Load or preload the contact, move more slowly, or write contact: holds if it carries forces in both "
        "directions.",
    ),
    "slips": Status(
        "A belt, a rope, a wheel or a clutch needs more friction than is available: it slips.",
        "Raise the tension, the force or the coefficient, or lower the load.",
    ),
    "slack": Status(
        "A rope, a band or a chain would have to push: it hangs slack.",
        "Raise its tension or the load that keeps it taut, or move more slowly.",
    ),
    "freewheels": Status(
        "A one-way clutch or a ratchet turns freely here and carries no couple.",
        "",
    ),
    "out_of_stroke": Status(
        "A cylinder is shorter or longer than its stroke allows.",
        "Change its closed length or its stroke, or the range of the motion.",
    ),
    "jump": Status(
        "The acceleration of a prescribed motion jumps here: forces are given just before and just after the jump.",
        "",
    ),
    "at_rest": Status(
        "With friction and no motion the efforts are an interval, not a number.",
        "Give a speed to choose the sense.",
    ),
}
"""Code of a status -> its sentence and remedy; the codes are those of the JSON answer."""

SOLVED = ("ok", "reversal", "freewheels", "jump")
"""Statuses of a position that is solved; at a reversal or a jump twice, just before and just after."""

NUMBERED = (*SOLVED, "self_locking", "outside_table")
"""Statuses of a position whose every number is known."""

FORCED = (*NUMBERED, "redundant")
"""Statuses of a position that has forces, all of them or those that are unique."""
