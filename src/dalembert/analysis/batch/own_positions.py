"""A kernel's outputs of many designs, each at separate positions, with derivatives by the drive's position too.

Mechanics: docs/theory.md 8.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.batch.batch_result import NUMBERED, among
from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.arrays import Array, Flags
from dalembert.errors import ModelError
from dalembert.kernel.derivatives import gradients
from dalembert.kernel.graph import Node

OF_DRIVE = ("position", "cos", "sin")
"""Inputs of a program for a drive's position."""
OF_MOTION = ("known", "way", "counted")
"""First words of the names of inputs of the known motion: its branch, the start of Newton's steps, full turns."""


class BatchOutputs(NamedTuple):
    """Outputs (design, position, component) side by side, their derivatives by numbers and position (..., number + 1),
    and where there is an answer (design, position)."""

    value: Array
    slope: Array
    ok: Flags


@dataclass(frozen=True)
class OwnPositions:
    """A kernel of one drive, whose known motion is that of the nearest of some stations (S,)."""

    kernel: Kernel
    stations: Array

    @cached_property
    def drive(self) -> str:
        (name,) = self.kernel.trace.course.schedule.names
        return name

    @cached_property
    def nodes(self) -> list[Node]:
        """Every component of every output, then its derivatives by the numbers and by the position."""
        k = self.kernel
        graph, named = k.trace.catalogue.graph, k.trace.inputs.named
        flat = [n for nodes in k.nodes.values() for n in nodes]
        q, cos, sin = (named.get(("channel", f"{what} {self.drive}"), graph.zero) for what in OF_DRIVE)
        numbers = [row for rows in k.rates.values() for row in rows]
        slopes = list[Node]()
        for row, (by_q, by_cos, by_sin) in zip(numbers, gradients(graph, flat, [q, cos, sin]), strict=True):
            slopes += [*row, by_q + by_sin * cos - by_cos * sin]
        return [*flat, *slopes]

    @cached_property
    def machine(self) -> Any:
        """Program and machine code of pairs of a design and a position."""
        return self.kernel.runner.pairs(self.kernel.program(self.nodes, len(self.nodes)))

    @cached_property
    def columns(self) -> tuple[Array, Array, list[str]]:
        """The program's inputs at the stations (S, channel), common ones, and the channels' names."""
        k, program = self.kernel, self.machine[0]
        columns, common = k.runner.inputs(program, k.course(self.stations[:, None]))
        names = {node.index: name for (_, name), node in k.trace.inputs.named.items()}
        used = [names[n.index] for n in program.inputs_in_use("channel")]
        mine = [f"{what} {self.drive}" for what in OF_DRIVE]
        other = next((n for n in used if n not in mine and not n.startswith(OF_MOTION)), None)
        if other is not None:
            raise ModelError(
                f"{', '.join(k.outputs)} depend on {other}, which depends on the drive",
                "at separate positions, use outputs of the motion only",
            )
        return columns, common, used

    def __call__(self, values: Array, positions: Array) -> BatchOutputs:
        """Outputs of designs (D, number) at positions (D, P) of the drive."""
        columns, common, used = self.columns
        order = np.argsort(self.stations)
        middles = (self.stations[order][1:] + self.stations[order][:-1]) / 2
        q = positions.ravel()
        channels = columns[order[np.searchsorted(middles, q)]]
        for what, column in zip(OF_DRIVE, (q, np.cos(q), np.sin(q)), strict=True):
            if f"{what} {self.drive}" in used:
                channels[:, used.index(f"{what} {self.drive}")] = column
        count = positions.shape[1]
        out, code = self.kernel.runner.at_pairs(
            *self.machine[:2], np.repeat(values, count, axis=0), channels, common, None
        )
        flat = sum(len(nodes) for nodes in self.kernel.nodes.values())
        out = out.reshape(*positions.shape, -1)
        ok = among(code, NUMBERED).reshape(positions.shape)
        other = self.kernel.may_change_branch(values)
        ok = ok & np.isfinite(out).all(axis=2) & (True if other is None else ~other[:, None])
        return BatchOutputs(out[..., :flat], out[..., flat:].reshape(*positions.shape, flat, -1), ok)
