"""Parts of studies by themselves: engines, sizes of blocks, rows of a ledger, how designs differ, correlations."""

from __future__ import annotations

import zlib
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.batch_result import CODES
from dalembert.errors import ModelError
from dalembert.studies import running, study_result
from dalembert.studies.block_engines import PROBED, CycleEngine, program_print, with_cycle_numbers
from dalembert.studies.design_study import BLOCK_BYTES, MOST_BLOCKS, Study
from dalembert.studies.motion_engines import AT_ONCE, MOST, MotionEngine, end_kinds, ends
from dalembert.studies.sampling import DesignPlan
from dalembert.studies.spreads import Spread
from dalembert.studies.store import FIELDS, checksum, ledger_row
from dalembert.studies.study_result import Difference, StudyResult, _difference, _distance, unsolved

OK, FAILED, OPEN, REST = (CODES.index(x) for x in ("ok", "failed", "undecided", "at_rest"))
NAN = np.nan


class Computed:
    """An engine with fixed arrays."""

    def __init__(
        self, text: str = "", why: str = "", most: int = 7, positions: int = 3, **arrays: Any
    ) -> None:
        self.text, self.why, self.most_at_once, self.positions = text, why, most, positions
        self.arrays = {name: np.array(values) for name, values in arrays.items()}
        self.outputs = tuple(name for name in arrays if name != "status")
        self.asked: list[Any] = []

    def block(self, values: Any) -> Any:
        self.asked.append(len(values))
        return {name: a.copy() for name, a in self.arrays.items()}


def cycle(inner: Computed, other: Computed | None, outputs: tuple[str, ...] = ("span", "e")) -> CycleEngine:
    r = da.statics(da.four_bar(positions=3))
    engine = with_cycle_numbers(
        ["range(effort.O2)" if name == "span" else name for name in outputs],
        "peak", r, lambda names, by: inner if by is None else other,
    )  # fmt: skip
    assert isinstance(engine, CycleEngine)
    return engine


def test_a_number_of_the_cycle_is_of_all_positions_beside_the_other_outputs() -> None:
    """Of designs that are solved; the statuses are those of the other outputs."""
    along = {"effort.O2": [[1.0, 4.0, 2.0], [5.0, -3.0, 0.5], [1.0, 9.0, 3.0]]}
    inner = Computed("all", status=np.array([[OK] * 3, [OK] * 3, [OK, FAILED, OK]], np.uint8), **along)
    other = Computed("peaks", e=[4.0, 5.0, 9.0], status=np.array([OK, OK, FAILED], np.uint8))
    engine = cycle(inner, other)
    found = engine.block(np.zeros((3, 1)))
    assert list(found) == ["range(effort.O2)", "e", "status"]
    assert found["range(effort.O2)"] == pytest.approx([3.0, 8.0, NAN], nan_ok=True)
    assert found["e"].tolist() == [4.0, 5.0, 9.0]
    assert found["status"].tolist() == [OK, OK, FAILED]
    alone = cycle(inner, None, ("span",)).block(np.zeros((3, 1)))
    assert list(alone) == ["range(effort.O2)", "status"]
    assert alone["status"].tolist() == [OK, OK, FAILED]


@pytest.mark.parametrize(
    ("inner", "other", "why", "most"),
    [
        (("", 7), ("", 9), "", 7),
        (("a", 9), ("b", 7), "a", 7),
        (("", 8), ("b", 9), "b", 8),
        (("", 8), None, "", 8),
    ],
)
def test_two_engines_are_as_slow_as_the_slower_one(inner: Any, other: Any, why: str, most: int) -> None:
    one, two = (None if x is None else Computed("xy", x[0], x[1], 5) for x in (inner, other))
    assert one is not None
    engine = cycle(one, two, ("span", "e") if two else ("span",))
    assert (engine.why, engine.most_at_once, engine.positions) == (why, most, 5)
    assert engine.text.startswith("xy {")
    assert engine.text.endswith("}xy" if two else "}")


def test_the_print_of_a_program_is_of_its_text_and_of_what_it_gives_for_some_designs() -> None:
    values = np.arange(200.0).reshape(100, 2)
    engine = Computed("text", a=[1.0, 2.0], b=[3.0], status=np.zeros(2, np.uint8))
    first = program_print(engine, values)
    assert len(first) == 16
    assert (
        program_print(Computed("text", b=[3.0], status=np.zeros(2, np.uint8), a=[1.0, 2.0]), values) == first
    )
    later = values.copy()
    later[PROBED:] = 7.0
    assert program_print(engine, later) == first
    later[PROBED - 1] = 7.0
    assert program_print(engine, later) != first
    assert engine.asked == [PROBED] * 3
    for other in (
        Computed("other", a=[1.0, 2.0], b=[3.0], status=np.zeros(2, np.uint8)),
        Computed("text", a=[1.0, 2.5], b=[3.0], status=np.zeros(2, np.uint8)),
        Computed("text", a=[1.0, 2.0], b=[3.5], status=np.zeros(2, np.uint8)),
        Computed("text", a=[1.0, 2.0], b=[3.0], status=np.ones(2, np.uint8)),
    ):
        assert program_print(other, values) != first
    slow = Computed("text", "why", a=[1.0], status=np.zeros(1, np.uint8))
    program_print(slow, values)
    assert slow.asked == [1]


def sized(count: int, engine: Computed, reduce: str | None = "peak") -> int:
    plan = DesignPlan(("a", "b"), (Spread("uniform", 0, 1),) * 2, "random", count)
    return Study(da.four_bar(positions=1), plan, None, reduce, cache={"engine": engine}).block_size()


@pytest.mark.parametrize(
    ("count", "most", "why", "size"),
    [
        (10**5, 5000, "", 4096),
        (10**5, 4096, "", 4096),
        (10**5, 4095, "", 2048),
        (10**5, 10**9, "", 4096),
        (131_072, 10**9, "", 8192),  # a sixteenth of the designs
        (131_071, 10**9, "", 4096),
        (10, 10**9, "", 4096),
        (10, 64, "why", 16),
        (1000, 64, "why", 32),
        (10, 0, "", 1),
        (4096 * MOST_BLOCKS, 4096, "", 4096),
        (4096 * MOST_BLOCKS + 1, 4096, "", 8192),
        (4 * 4096 * MOST_BLOCKS + 1, 4096, "", 32768),
    ],
)
def test_a_block_has_a_power_of_two_designs(count: int, most: int, why: str, size: int) -> None:
    assert sized(count, Computed("", why, most, x=[0.0])) == size


@pytest.mark.parametrize(
    ("reduce", "positions", "kept"), [("peak", 1000, 1), (None, 1000, 1000), (None, 1001, 1001)]
)
def test_a_block_has_at_most_64_megabytes(reduce: str | None, positions: int, kept: int) -> None:
    """Of two numbers and three values for each of two outputs."""
    found = sized(10**9, Computed("", "", 10**9, positions, x=[0.0], y=[0.0]), reduce)
    room = BLOCK_BYTES // (8 * (2 + 3 * kept * 2))
    blocks = 1 << (room.bit_length() - 1)
    while 10**9 / blocks > MOST_BLOCKS:
        blocks *= 2
    assert found == blocks


def motion(**more: Any) -> Any:
    """Four motions: one as it should be, one stopped, one open, one at rest at last."""
    answer = SimpleNamespace(
        time=np.array([1.0, 2.0, 3.0, 4.0]),
        position=np.array([[0.1], [0.2], [0.3], [0.4]]),
        speed=np.array([[5.0], [6.0], [7.0], [8.0]]),
        arrays={"effort.O2": np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [7.0, NAN]])},
        ended=["time 2 s", "stopped at 2", "time 2 s", "failed to be known"],
        ok=np.array([True, False, False, True]),
    )
    vars(answer).update(more)
    block = SimpleNamespace(instants=more.get("instants", 100), text="program")

    class Kernel:
        mechanism = da.four_bar(positions=1)

        def __call__(self, values: Any, threads: int) -> Any:
            return answer

    kernel: Any = Kernel()
    kernel.block = block
    return kernel


def test_motions_have_the_status_of_how_they_ended() -> None:
    engine = MotionEngine(motion(), ("effort.O2", "O2.speed", "time"))
    found = engine.block(np.zeros((4, 1)))
    assert list(found) == ["effort.O2", "O2.speed", "time", "status"]
    assert found["O2.speed"].tolist() == [5, 6, 7, 8]
    assert found["status"].tolist() == [OK, FAILED, OPEN, FAILED]
    some = motion(ended=["time"] * 4)
    assert MotionEngine(some, ("effort.O2",)).block(np.zeros((4, 1)))["status"].tolist() == [
        OK,
        OPEN,
        OPEN,
        REST,
    ]
    assert MotionEngine(some, ("time",)).block(np.zeros((4, 1)))["status"].tolist() == [OK, OPEN, OPEN, OK]


@pytest.mark.parametrize(
    ("instants", "most"), [(1, MOST), (128, MOST), (129, AT_ONCE // 129), (AT_ONCE, 1), (2 * AT_ONCE, 1)]
)
def test_a_block_of_motions_has_half_a_million_instants(instants: int, most: int) -> None:
    engine = MotionEngine(motion(instants=instants), ())
    assert (engine.most_at_once, engine.positions, engine.text) == (most, instants, "program")


def test_a_motion_ends_with_time_and_position_and_speed_of_each_drive() -> None:
    m = da.four_bar(positions=1)
    assert end_kinds(m) == {"time": "time", "O2.position": "angle", "O2.speed": "angular_speed"}
    slide = da.slider_crank(crank=0.05, rod=0.2).to_tree()
    slide |= {"drives": {"guide": {"position": "0.2 m"}, "O": {"position": "unknown", "effort": 0}}}
    two: Any = SimpleNamespace(drives={"G": SimpleNamespace(turns=False), "O": SimpleNamespace(turns=True)})
    assert end_kinds(two) == {
        "time": "time", "G.position": "length", "G.speed": "speed", "O.position": "angle", "O.speed": "angular_speed",
    }  # fmt: skip
    found = ends(two, np.array([1.0, 2.0]), np.array([[3.0, 4], [5, 6]]), np.array([[7.0, 8], [9, 10]]))
    assert {name: values.tolist() for name, values in found.items()} == {
        "time": [1, 2], "G.position": [3, 5], "G.speed": [7, 9], "O.position": [4, 6], "O.speed": [8, 10],
    }  # fmt: skip


def test_a_row_of_the_ledger_has_the_check_of_all_arrays_and_counts_by_status() -> None:
    block = {
        "b": np.array([1.0, 2.0, 3.0]),
        "status": np.array([OK, FAILED, OK], np.uint8),
        "a": np.array([4.0, 5, 6]),
    }
    total = 0
    for name in ("a", "b", "status"):
        total = zlib.crc32(block[name].tobytes(), total)
    assert checksum(block) == total + 1
    row = ledger_row(block, 12.6)
    assert dict(zip(FIELDS, row.tolist(), strict=True)) == {
        **dict.fromkeys(FIELDS, 0), "check": total + 1, "ms": 13, "ok": 2, "failed": 1,
    }  # fmt: skip
    along = {"status": np.array([[OK, OK], [OK, FAILED], [OPEN, FAILED]], np.uint8)}
    row = ledger_row(along, 0.4)
    assert (row[1], row[2:].sum(), row[FIELDS.index("failed")], row[FIELDS.index("undecided")]) == (
        0,
        3,
        1,
        1,
    )


def test_blocks_are_handed_out_a_few_at_a_time_and_the_last_is_shorter() -> None:
    rest = iter([3, 5, 0, 8])
    assert [running._some(rest, n) for n in (2, 0, 5, 1)] == [[3, 5], [], [0, 8], []]
    s = da.study(da.four_bar(positions=2), {"links.coupler.mass": "± 5 %"}, ["effort.O2"], designs=10)
    assert [running._length(s, 4, b) for b in range(3)] == [4, 4, 2]
    assert [running._length(s, 5, b) for b in range(2)] == [5, 5]


def test_a_study_that_is_too_large_for_the_memory_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    s = da.study(da.four_bar(positions=2), {"links.coupler.mass": "± 5 %"}, ["effort.O2"], designs=10)
    monkeypatch.setattr(running, "IN_MEMORY", 90)  # 10 designs of 8 bytes and a status
    told: list[Any] = []
    r = s.run(progress=lambda done, of: told.append((done, of)))
    assert told == [(10, 10)]
    assert r.done.all()
    monkeypatch.setattr(running, "IN_MEMORY", 89)
    with pytest.raises(
        ModelError, match=r"^the results take 0\.0 GB; give run\(\) the name of a store on disk$"
    ):
        s.run()


@pytest.mark.parametrize(
    ("one", "other", "found"),
    [
        ([1, 2, 3, 4], [5, 6, 7], Difference("x", False, 4.5, 1.0, 0.0)),
        ([5, 6, 7], [1, 2, 3, 4], Difference("x", True, 4.5, 1.0, 0.0)),
        ([1, 2, 3, 8], [4, 5, 6, 7, 9], Difference("x", False, 3.5, 0.75, 0.0)),
        ([7, 8, 9, 2], [1, 3, 4, 5, 6], Difference("x", True, 6.5, 0.75, 0.0)),
        ([1, 1, 2], [1, 2, 2], Difference("x", False, 1.5, 2 / 3, 1 / 3)),
    ],
)
def test_two_samples_differ_most_at_one_place(one: Any, other: Any, found: Difference) -> None:
    assert _distance("x", np.array(one, float), np.array(other, float)) == pytest.approx(found)


@pytest.mark.parametrize(
    ("away", "count", "told"), [(1.0, 12, True), (1.0, 8, False), (0.25, 200, False), (0.32, 200, True)]
)
def test_a_difference_is_told_that_is_large_and_no_coincidence(
    away: float, count: int, told: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of the second number, by a part of it; with n designs of either sort the root of n/2 times the part is 2.2."""
    values = np.linspace(0, 1, count)
    both = {True: np.stack([values, values + away], axis=1), False: np.stack([values, values], axis=1)}
    monkeypatch.setattr(study_result, "_values", lambda _, of: both[bool(of[0])])
    s: Any = SimpleNamespace(paths=("a", "b"))
    found = _difference(s, np.array([1] * count), np.array([0] * count))
    assert (found is not None) is told
    if found is not None:
        assert (found.path, found.above) == ("b", True)
    assert _difference(s, np.array([], int), np.array([0])) is None
    assert _difference(s, np.array([1]), np.array([], int)) is None


def test_designs_without_numbers_are_counted_among_those_computed() -> None:
    numbered = CODES.index("no_derivative")
    assert unsolved(np.array([OK, FAILED, 255, OPEN, numbered, OK], np.uint8)) == (5, 2)


def made(values: list[float], **options: Any) -> StudyResult:
    """A study whose designs have these values of the effort."""
    s = da.study(
        da.four_bar(positions=2),
        {"links.coupler.mass": "± 5 %"},
        ["effort.O2"],
        designs=len(values),
        **options,
    )
    rows = np.zeros((1, len(FIELDS)), np.int64)
    rows[0, 0] = 1
    arrays = {
        "effort.O2": np.array(values, float),
        "status": np.where(np.isnan(values), FAILED, OK).astype(np.uint8),
    }
    return StudyResult(s, arrays, rows, len(values))


def test_capability_is_of_the_nearer_limit_and_of_equal_values_endless() -> None:
    r = made([1.0, 2.0, 3.0, 6.0, NAN])
    sigma = float(np.std([1, 2, 3, 6]))
    assert r.capability("effort.O2", "1..6 N*m") == pytest.approx(2.0 / (3 * sigma))
    assert r.capability("effort.O2", "-4..6 N*m") == pytest.approx(3.0 / (3 * sigma))
    assert r.capability("effort.O2", "> 5 N*m") == pytest.approx(-2.0 / (3 * sigma))
    assert r.capability("effort.O2", "< 5 N*m") == pytest.approx(2.0 / (3 * sigma))
    still = made([2.0, 2.0, 2.0])
    assert (still.capability("effort.O2", "< 3 N*m"), still.capability("effort.O2", "> 3 N*m")) == (
        np.inf,
        -np.inf,
    )
    assert r.share("effort.O2", "> 1.5 N*m") == 0.6
    assert (r.best("effort.O2"), r.worst("effort.O2")) == (0, 3)


def test_a_histogram_of_equal_values_is_one_wide() -> None:
    counts, ends_ = made([2.0, 2.0 + 2e-12, 2.0]).histogram("effort.O2", 5)
    assert (counts.tolist(), ends_) == ([0, 0, 3, 0, 0], pytest.approx([1.5, 1.7, 1.9, 2.1, 2.3, 2.5]))
    counts, ends_ = made([2.0, 2.0 + 1e-11, 2.0]).histogram("effort.O2", 4)
    assert (counts.tolist(), ends_[0], ends_[-1]) == ([2, 0, 0, 1], 2.0, 2.0 + 1e-11)
    counts, ends_ = made([-2.0, -3.0, NAN]).histogram("effort.O2", 2)
    assert (counts.tolist(), ends_.tolist()) == ([1, 1], [-3.0, -2.5, -2.0])
    counts, ends_ = made([NAN, NAN]).histogram("effort.O2", 2)
    assert (counts.tolist(), ends_.tolist()) == ([0, 0], [-0.5, 0.0, 0.5])
    assert np.isnan(made([NAN]).percentiles("effort.O2", (5,))[5])
    assert made([1.0, 2.0, 4.0]).percentiles("effort.O2", (0, 25, 100)) == {0: 1.0, 25: 1.5, 100: 4.0}


@pytest.mark.parametrize(("draw", "count", "said"), [
    ("random", 10**12 + 1, "use 1 to 1000000000000"),
    ("sobol", 2**30 + 1, "use 1 to 1073741824; more can be drawn at random"),
    ("random", 0, "use 1 to 1000000000000"),
    ("latin", -1, "use 1 to 1000000000000"),
])  # fmt: skip
def test_there_may_be_so_many_designs(draw: str, count: int, said: str) -> None:
    spread = (Spread("uniform", 0, 1),)
    with pytest.raises(ModelError) as refused:
        DesignPlan(("a",), spread, draw, count)
    assert str(refused.value) == f"designs={count} is out of range; {said}"
    assert DesignPlan(("a",), spread, "random", 10**12).count == 10**12
    assert DesignPlan(("a",), spread, "sobol", 2**30).extendable
    assert not DesignPlan(("a",), spread, "latin", 1).extendable
