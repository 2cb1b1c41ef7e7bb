"""How messages quote values and propose names, and how numbers are tidied."""

from __future__ import annotations

from dalembert.printing import rounded
from dalembert.wording import nearest, shown


def test_values_are_quoted_short() -> None:
    assert shown("x" * 100) == "'" + "x" * 56 + "..."
    assert shown("x" * 58) == "'" + "x" * 58 + "'"
    assert shown(10**20) == shown(-(10**20)) == "a number of 20 digits"
    assert [shown(v) for v in (10**15, -3, 2.5, True, None, [], [1], {})] == [
        "1000000000000000", "-3", "2.5", "true", "nothing", "an empty list", "a list", "a mapping",
    ]  # fmt: skip


def test_of_names_that_differ_in_case_the_first_is_meant() -> None:
    assert nearest("rOd", ["Rod", "ROD"]) == "Rod"
    assert nearest("rOd", ["ROD", "Rod"]) == "ROD"


def test_what_is_nothing_beside_the_largest_is_zero() -> None:
    assert rounded([-3.0, 1e-13, -1e-13]) == [-3.0, 0.0, 0.0]
    assert rounded([3.0, 1e-11]) == [3.0, 1e-11]
    assert rounded([1e-13], beside=1.0) == [0.0]
    assert rounded([float("inf"), 1e-13])[1] == 1e-13
    assert str(rounded([-1e-13, 1.0])[0]) == "0.0"
