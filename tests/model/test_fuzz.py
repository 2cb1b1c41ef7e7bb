"""Whatever stands in a file, it is a mechanism or a ModelError with a line, and soon."""

from __future__ import annotations

import random
import string

import pytest

from dalembert.errors import ModelError
from dalembert.model import Mechanism, loads, tree_text
from tests.model.parts import FOUR_BAR
from tests.tiers import tiers

PIECES = (
    "null true 1e999 -0 .nan {} [] [1] {a:1} 3@4 3@ @ lb mm rad/s Hz 1/s 60deg unknown ground center O2 A [O2,A] "
    "sin(O2) 9**9 *a &a !x <<: --- ? | > % \t \x00 \ufeff \u2028 é 😀 -- 1,5 1_000 0x1F '' \"\" # : , { } [ ] "
    "type: pin slider slot gear teeth: module: law: position: range: effort: friction: radius: damping: spring "
    "between: stiffness: against: x: y: periodic: true interpolate: cubic answers: quantity: space: weight: g: 1"
)
WORDS = PIECES.split(" ")
TREE = loads(FOUR_BAR).to_tree()
SEEDS = {"yaml": FOUR_BAR, "json": tree_text(TREE, "json"), "toml": tree_text(TREE, "toml")}


def mutated(text: str, draw: random.Random) -> str:
    """The text with a few pieces cut, doubled, moved or replaced."""
    for _ in range(draw.randint(1, 4)):
        a = draw.randrange(len(text) + 1)
        b = min(len(text), a + draw.choice((0, 1, 1, 3, 10, 60)))
        piece = draw.choice(
            (
                "",
                text[a:b] * 2,
                draw.choice(WORDS),
                draw.choice(WORDS),
                " " + draw.choice(WORDS),
                draw.choice(string.printable),
                chr(draw.randrange(0x11000)),
                text[(c := draw.randrange(len(text) + 1)) : c + 20],
            )
        )
        text = text[:a] + piece + text[b:]
    return text


def loaded(text: str, form: str) -> Mechanism | ModelError:
    try:
        return loads(text, form, "file")
    except ModelError as error:
        return error


def attempt(seed: int) -> None:
    draw = random.Random(seed)
    form = draw.choice(sorted(SEEDS))
    found = loaded(mutated(SEEDS[form], draw), form)
    if isinstance(found, ModelError):
        assert str(found).startswith("file:")
        assert found.line > 0
    else:
        assert loads(tree_text(found.to_tree())) == found


def test_a_mutated_file_is_a_mechanism_or_a_model_error() -> None:
    for seed in range(300):
        attempt(seed)


@pytest.mark.parametrize("block", tiers((), range(4), range(4, 100)))
def test_a_hundred_thousand_mutated_files(block: int) -> None:
    for seed in range(1000 * block, 1000 * (block + 1)):
        attempt(seed)
