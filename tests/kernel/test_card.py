"""Programs on a graphics card, with a stand-in for cupy that runs each thread in Python: parts, counts, progress."""

from __future__ import annotations

import sys
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from dalembert.arrays import Array
from dalembert.kernel.emit import c_text, cuda
from dalembert.kernel.graph import Graph
from dalembert.kernel.program import Program


class FailedError(Exception):
    """What cupy raises without a driver."""


class Card:
    """A card that computes 100 n0 + 10 c + m + k for output k, and marks a position by n1."""

    def __init__(self, devices: int | FailedError = 1) -> None:
        self.devices, self.launches, self.entry = devices, list[tuple[Any, ...]](), ""
        runtime = SimpleNamespace(getDeviceCount=self.count, CUDARuntimeError=FailedError)
        self.cuda = SimpleNamespace(runtime=runtime)
        self.asarray = self.asnumpy = np.asarray
        self.empty = lambda shape, kind=float: np.full(shape, 99, kind)
        self.uint8 = np.uint8

    def count(self) -> int:
        if isinstance(self.devices, FailedError):
            raise self.devices
        return self.devices

    def RawModule(self, code: str) -> Any:
        self.code = code
        return SimpleNamespace(get_function=self.function)

    def function(self, name: str) -> Any:
        self.entry = name
        return self.launch

    def launch(self, blocks: tuple[int], threads: tuple[int], data: tuple[Any, ...]) -> None:
        values, path, extra, results, flags, numbers, channels, designs, positions = data
        self.launches.append((blocks, threads, int(numbers), int(channels), int(designs), int(positions)))
        assert (values.shape, path.shape) == ((designs, numbers), (positions, channels))
        for d in range(len(values)):
            for k in range(results.shape[1]):
                at = 100 * values[d, 0] + 10 * path[:, 0] + extra[0] + k
                results[d, k] = at if results.ndim == 3 else at.max()
            flags[d] = values[d, 1]


VALUES = np.array([[1.0, 3], [2.0, 5], [3.0, 7], [4.0, 1], [5.0, 2]])
COLUMNS = np.array([[0.1], [0.2], [0.4]])


def program() -> Program:
    g = Graph()
    n, x = g.input("number", "n", 1.0), g.input("channel", "x", 1.0)
    return Program(g, (n * x, n + x))


def on_card(
    monkeypatch: pytest.MonkeyPatch, part: int, slots: Any = (), columns: Array = COLUMNS
) -> tuple[Card, Array, Array, list[Any]]:
    card, told = Card(), list[Any]()
    monkeypatch.setitem(sys.modules, "cupy", card)
    monkeypatch.setattr(cuda, "PART", part)
    out, code = cuda.run(
        program(), slots, VALUES, columns, np.array([0.5]), lambda done, of: told.append((done, of))
    )
    return card, out, code, told


@pytest.mark.parametrize(("part", "sizes"), [(1, [1] * 5), (12, [2, 2, 1]), (18, [3, 2]), (1 << 24, [5])])
def test_designs_go_to_the_card_in_parts(
    part: int, sizes: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    card, out, code, told = on_card(monkeypatch, part)
    expected = [
        [[100 * v + 10 * c + 0.5 + k for c in (0.1, 0.2, 0.4)] for k in (0, 1)] for v in (1, 2, 3, 4, 5)
    ]
    assert out == pytest.approx(np.array(expected))
    assert code.tolist() == [[n] * 3 for n in (3, 5, 7, 1, 2)]
    assert code.dtype == np.uint8
    assert [launch[2:] for launch in card.launches] == [(2, 1, size, 3) for size in sizes]
    assert {launch[1] for launch in card.launches} == {(128,)}
    assert told == [(sum(sizes[: k + 1]), 5) for k in range(len(sizes))]
    assert card.entry == "grid"
    assert card.code == c_text.grid(program())


def test_threads_of_the_card_are_in_blocks_of_128(monkeypatch: pytest.MonkeyPatch) -> None:
    for positions, blocks in ((25, 1), (26, 2), (51, 2), (52, 3)):  # times 5 designs
        columns = np.linspace(0, 1, positions)[:, None]
        card = on_card(monkeypatch, 1 << 24, columns=columns)[0]
        assert card.launches[0][0] == (blocks,)


def test_reductions_have_one_thread_a_design(monkeypatch: pytest.MonkeyPatch) -> None:
    slots = ((0, "peak"), (1, "argmax"))
    card, out, code, _ = on_card(monkeypatch, 6, slots)
    expected = [[100 * v + 4.5 + k for k in range(3)] for v in (1, 2, 3, 4, 5)]  # a place takes two
    assert out == pytest.approx(np.array(expected))
    assert code.tolist() == [3, 5, 7, 1, 2]
    assert [launch[0] for launch in card.launches] == [(1,)] * 3
    assert [launch[4] for launch in card.launches] == [2, 2, 1]
    assert card.entry == "reduced"
    assert card.code == c_text.emit_reduced(program(), slots)


@pytest.mark.parametrize(
    ("card", "sentence"),
    [
        (None, "cupy is not installed (pip install cupy-cuda12x)"),
        (Card(0), "no CUDA device is available"),
        (Card(FailedError("no driver")), "no CUDA device is available (no driver)"),
    ],
)
def test_a_machine_without_a_card_says_what_is_lacking(
    card: Card | None, sentence: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "cupy", card)
    with pytest.raises(RuntimeError) as raised:
        cuda.card()
    assert str(raised.value) == sentence


def test_a_card_is_used_if_there_is_one(monkeypatch: pytest.MonkeyPatch) -> None:
    for card in (Card(1), Card(2)):
        monkeypatch.setitem(sys.modules, "cupy", card)
        assert cuda.card() is card
