"""Slider-cranks in closed form, differentiated by Fourier series: shares no code with the product."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
FINE = 512


def turn(count: int = FINE) -> Array:
    """Even angles over one turn."""
    return np.arange(count) * 2 * np.pi / count


def derivative(y: Array) -> Array:
    """dy/dq of values over one turn by the discrete Fourier transform, along the first axis."""
    k = np.fft.fftfreq(len(y), 1 / len(y))
    return np.real(np.fft.ifft((1j * k).reshape(-1, *[1] * (y.ndim - 1)) * np.fft.fft(y, axis=0), axis=0))


def crank_points(
    q: Array, crank: float, rod: float, line: float = 0.0, throw: float = 0.0
) -> tuple[Array, Array]:
    """Crank pin and piston pin (P, 2) of a centric slider-crank on a line at an angle, its throw ahead of the crank."""
    pin = crank * np.exp(1j * (q + throw - line))
    piston = pin.real + np.sqrt(rod**2 - pin.imag**2)
    out = [np.exp(1j * line) * z for z in (pin, piston + 0j)]
    return tuple(np.stack([z.real, z.imag], axis=-1) for z in out)  # type: ignore[return-value]


def shaking_of(masses: list[tuple[float, Array]], speed: float) -> Array:
    """Minus the rate of momentum (P, 2) of point masses on paths over one turn."""
    return -sum((m * speed**2 * derivative(derivative(path)) for m, path in masses), np.zeros(2))
