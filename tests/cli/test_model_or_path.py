"""Every function that starts from a mechanism takes the path of its model file too; a missing file has one message."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from inspect import signature
from typing import Any

import pytest

import dalembert as da
from dalembert.bundled import examples
from dalembert.errors import MissingFileError
from tests.cli.conftest import Run

FILE = examples()["four_bar"]
MASS = "links.coupler.weight"
START = {"O2": {"position": "30 deg", "speed": 0}}
SOME = [da.Answer(quantity="effort.O2", value="243.2 lbf*in")]


def sentence(call: Callable[[], object]) -> str:
    """The sentence of a model that is refused."""
    with pytest.raises(da.ModelError) as refused:
        call()
    if isinstance(refused.value, FileNotFoundError):
        raise refused.value
    return str(refused.value)


ENTRIES: dict[str, Callable[[Any], Any]] = {
    "kinematics": da.kinematics,
    "statics": da.statics,
    "dynamics": da.dynamics,
    "solve": da.solve,
    "mobility": da.mobility,
    "lifted": da.lifted,
    "sweep": lambda m: da.sweep(m, MASS, [20.0, 30.0]),
    "compile": lambda m: da.compile(m, [MASS], ["effort.O2"])([[20.0]]),
    "compile_motion": lambda m: da.compile_motion(m, "0.01 s", [], ["effort.O2"], "peak", START).outputs,
    "simulate": lambda m: da.simulate(m, "0.01 s", START, count=3),
    "balance": lambda m: da.balance(m, ["crank"], positions=12),
    "optimize": lambda m: da.optimize(m, {MASS: (20, 30)}, "peak effort.O2", starts=2),
    "pareto": lambda m: da.pareto(
        m, {MASS: (20, 30)}, ["effort.O2", "reaction.A.magnitude"], points=2, starts=2
    ),
    "synthesize": lambda m: da.synthesize(
        m, {"links.crank.points.A.0": (0.06, 0.12)}, {"angle.rocker": [1.5, 1.6]}, [0.3, 0.6], starts=2
    ),
    "study": lambda m: da.study(m, {MASS: "± 1 %"}, ["effort.O2"], designs=4).run(),
    "variants": lambda m: [v.key for v in da.variants(m, {MASS: "[20, 30]"}, 1, seed=1, ask=["effort.O2"])],
    "check_answers": lambda m: da.check_answers(m, SOME),
    "law": lambda m: sentence(lambda: da.law(m, "O2")),
    "cam": lambda m: sentence(lambda: da.cam(m, "O2")),
    "governor": lambda m: sentence(lambda: da.governor(m)),
    "turning_range": lambda m: sentence(lambda: da.turning_range(m)),
    "page": da.page,
}


@pytest.mark.parametrize("name", ENTRIES)
def test_a_path_is_as_good_as_the_mechanism(name: str) -> None:
    entry = ENTRIES[name]
    assert entry(str(FILE)) == entry(da.load(FILE))
    with pytest.raises(FileNotFoundError, match=r"none\.yaml: file not found"):
        entry("none.yaml")


def test_no_entry_is_left_out() -> None:
    """Whatever is given a mechanism first is one of the above."""
    first = {
        name: str(next(iter(signature(f).parameters.values())).annotation)
        for name in da.__all__
        if callable(f := getattr(da, name)) and not isinstance(f, type) and signature(f).parameters
    }
    found = {name for name, of in first.items() if of.split(" |")[0] in ("Mechanism", "ModelOrPath")}
    assert found == {*ENTRIES, "balance_rotor", "widget"}


def test_something_else_is_refused() -> None:
    with pytest.raises(
        da.ModelError, match="a dict is not a mechanism; give a Mechanism or the path of a model file"
    ):
        da.dynamics({})  # type: ignore[arg-type]


def test_a_missing_file_is_an_error_of_files_and_of_models() -> None:
    with pytest.raises(FileNotFoundError) as caught:
        da.load("none.yaml")
    error = caught.value
    assert isinstance(error, da.ModelError)
    assert (str(error), error.filename) == ("none.yaml: file not found", "none.yaml")
    assert str(pickle.loads(pickle.dumps(error))) == str(error)
    assert str(MissingFileError("a.yaml").at_source(None)) == "a.yaml: file not found"


COMMANDS = [
    "solve none.yaml",
    "draw none.yaml -o a.svg",
    "report none.yaml -o a.html",
    "page none.yaml -o a.html",
    "convert none.yaml -o a.json",
    "check none.yaml",
    "wrench none.yaml",
    "optimize none.yaml",
    "study run none.yaml",
    "study show none.yaml",
    "flywheel none.yaml",
    "simulate none.yaml --until 1s",
    "balance none.yaml",
    "variants none.yaml --vary r=[1] -o a",
    "check-answers none.yaml a.yaml",
    "check-answers four_bar.yaml none.yaml",
    "grade four_bar.yaml --key none.yaml",
]


@pytest.mark.parametrize("command", COMMANDS)
def test_commands_say_it_in_the_same_words(command: str, run: Run) -> None:
    status, _, said = run(*command.split())
    assert status == 2
    assert said.startswith("none.yaml: file not found")
