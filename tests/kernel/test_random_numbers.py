"""Random numbers in machine code: their bits are numpy's, the same in any lanes; normal scores are right to 1e-15."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from dalembert.arrays import Array
from dalembert.kernel.emit.random_numbers import FIELDS, draw, quantiles
from tests.tiers import tiers

LANES = (1, 2, 4, 8, 16)
KEYS = ((7, 1234567890123456789), (2**64 - 1, 2**63 + 5), (0, 0))


def rows(low: float = 0, width: float = 1, a: float = 0, b: float = 1, normal: bool = False) -> Array:
    out = np.zeros((len(KEYS), FIELDS), np.uint64)
    out[:, :2] = KEYS
    out.view(float)[:, 2:7] = low, width, a, b, normal
    return out


def uniforms(key: tuple[int, int], start: int, stop: int) -> Array:
    """By numpy's Philox, which makes four words a count."""
    row = np.random.Philox(key=np.array(key, np.uint64), counter=[start // 4, 0, 0, 0])
    words = row.random_raw(stop - start // 4 * 4)[start % 4 :]
    return np.asarray(((words >> np.uint64(11)) + 0.5) * 2.0**-53)


@pytest.mark.parametrize("lanes", LANES)
def test_the_words_are_those_of_numpy(lanes: int) -> None:
    for start, stop in ((0, 1), (5, 1234), (4 * 10**11 - 3, 4 * 10**11 + 40), (8, 8)):
        expected = np.stack([uniforms(key, start, stop) for key in KEYS], axis=1)
        assert np.array_equal(draw(rows(), start, stop, lanes), expected)
        assert np.array_equal(draw(rows(a=-3, b=0.1), start, stop, lanes), -3 + 0.1 * expected)


@pytest.mark.parametrize("lanes", LANES)
def test_a_normal_number_has_the_same_bits_in_any_lane(lanes: int) -> None:
    given = rows(0.001, 0.998, 5, 0.1, normal=True)
    assert np.array_equal(draw(given, 3, 2000, lanes), draw(given, 0, 9000, 8)[3:2000])
    shares = np.stack([uniforms(key, 3, 2000) for key in KEYS])
    assert np.array_equal(quantiles(given, shares, lanes), draw(given, 3, 2000, 8))


@pytest.mark.parametrize("count", tiers([200], [1000]))
def test_normal_scores_are_those_of_arithmetic_with_forty_digits(count: int) -> None:
    chance = np.random.default_rng(3)
    shares = np.concatenate(
        [
            chance.random(count),
            0.5 + chance.uniform(-1, 1, count) * 10.0 ** -chance.integers(1, 16, count),
            10.0 ** chance.uniform(-16, -2, count),
            1 - 10.0 ** chance.uniform(-15.9, -2, count),
            [2.0**-54, 1 - 2.0**-53, 0.25, 0.75],
        ]
    )
    found = quantiles(rows(normal=True)[:1], shares[None])[:, 0]
    with mpmath.workdps(40):
        exact = [mpmath.sqrt(2) * mpmath.erfinv(2 * mpmath.mpf(u) - 1) for u in shares.tolist()]
        off = [abs(mpmath.mpf(z) - e) / abs(e) for z, e in zip(found.tolist(), exact, strict=True) if e]
    assert max(off) < 1e-15
    ends = quantiles(rows(normal=True)[:1], np.array([[0.0, 0.5, 1.0]]))[:, 0]
    assert ends.tolist() == [-np.inf, 0.0, np.inf]
