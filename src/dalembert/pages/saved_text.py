"""Text of the model file that the page saves: the author's text, with placeholders for the numbers that change.

A part is text, or a placeholder: the author's text (``was``), the numbers on which it depends (``of``), and its
replacement once one of them has changed (``now``): text and pairs of a number and the size of its unit. Numbers of the
assembly come after the others; they have changed where any other has.
"""

from __future__ import annotations

import random
import re
from collections.abc import Mapping
from typing import Any

from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.batch.tracing.symbolic_model import number_kinds
from dalembert.arrays import Tree
from dalembert.errors import ModelError
from dalembert.model import Mechanism
from dalembert.model.files.model_files import loads, tree_text
from dalembert.model.files.rewriting import text_changes
from dalembert.model.files.splicing import Change, with_changes
from dalembert.model.quantities.dimensions import si_unit
from dalembert.pages.sketch_data import assembly_paths
from dalembert.units import KINDS, NUMBER, quantity

Part = str | Tree

ROUNDS = 2
"""Number of attempts at random numbers: those whose text in the file's units is not short are drawn again."""

SAME = 1e-9
"""Relative difference below which two ratios belong to the same number."""


def template(m: Mechanism, k: Kernel) -> list[Part]:
    """The parts of the text."""
    return _file_template(m, k) or _si_template(m, k)


def _file_template(m: Mechanism, k: Kernel) -> list[Part] | None:
    """The author's text with placeholders; None where the places of the numbers cannot be determined.

    Two mechanisms with other numbers are written, and the differences between the texts show the place of each number.
    """
    if m.source is None or m.source.form != "yaml" or not m.source.text or m.source.copied:
        return None
    text, rough = m.source.text.removeprefix("\ufeff"), set[int]()
    for _ in range(ROUNDS):
        both = _other_numbers(m, k, rough)
        written = [_written(m, k, text, values) for values in both]
        if written[0] is None or written[1] is None:
            return None
        parts, missing = _parts(text, written[0], written[1], *both)
        if parts is None or not missing:
            return parts
        rough |= missing
    return None


def _written(m: Mechanism, k: Kernel, text: str, values: list[float]) -> list[Change] | None:
    """Changes in the text with other numbers; None where it is not read as the same mechanism."""
    paths = [*(n.path for n in k.trace.numbers), *assembly_paths(k)]
    try:
        other = with_changed_numbers(m, dict(zip(paths, values, strict=True)))
        changes = text_changes(other, text, "yaml")
        same = changes is not None and loads(with_changes(text, changes)) == other
    except ModelError:
        return None
    return changes if same else None


def _other_numbers(m: Mechanism, k: Kernel, rough: set[int]) -> tuple[list[float], list[float]]:
    """Two lists of numbers near the file's, each number with a different ratio; short in the file's units, the
    ``rough`` ones in SI."""
    nominals = [n.value for n in k.trace.numbers]
    kinds = [*number_kinds(m, k.trace.numbers), *(_pose_kind(path) for path in assembly_paths(k))]
    draw, ratios, out = random.Random(1), set[float](), list[tuple[float, float]]()
    for n, kind in enumerate(kinds):
        plain = n in rough or n >= len(nominals) or m.units.refuses_bare(kind)
        size = 1.0 if plain else quantity(1.0, kind, m.units)
        nominal = (nominals[n] if n < len(nominals) else 0.5) / size or 1.0
        while True:
            pair = [float(f"{nominal * draw.uniform(1.01, 1.3):.4g}") for _ in range(2)]
            one, two = pair if plain else [quantity(x, kind, m.units) for x in pair]
            if one != two and round(one / two, 8) not in ratios:
                break
        ratios.add(round(one / two, 8))
        out.append((one, two))
    return [one for one, _ in out], [two for _, two in out]


def _pose_kind(path: str) -> str:
    return "length" if ".position." in path else "number" if ".axis." in path else "angle"


def _parts(
    text: str, first: list[Change], second: list[Change], a: list[float], b: list[float]
) -> tuple[list[Part] | None, set[int]]:
    """Text and placeholders in turn, None where the changes are not the same; numbers that do not appear in them."""
    if [c[:2] for c in first] != [c[:2] for c in second]:
        return None, set()
    out, end, seen = list[Part](), 0, set[int]()
    for one, two in zip(first, second, strict=True):
        now = _pieces(one.text, two.text, a, b)
        of = [piece[0] for piece in now if not isinstance(piece, str)]
        was: Tree = {"was": text[one.start : one.end], "of": of} if of else {}  # else the page's cycle
        out += [text[end : one.start], was | {"now": now}]
        seen.update(of)
        end = one.end
    return [*out, text[end:]], set(range(len(a))) - seen


def _pieces(one: str, two: str, a: list[float], b: list[float]) -> list[Any]:
    """Pieces of a text: characters, and indices of numbers with the sizes of their units; empty where some difference
    between the two is not explained by a number."""
    tokens = [re.split(rf"({NUMBER})", text) for text in (one, two)]
    out = list[Any]()
    for x, y in zip(*tokens, strict=False):
        if x == y:
            out.append(x)
            continue
        which = _number(x, y, a, b)
        if which is None:
            return []
        out.append([which, float(f"{a[which] / float(x):.15g}")])
    return out if len(tokens[0]) == len(tokens[1]) else []


def _number(x: str, y: str, a: list[float], b: list[float]) -> int | None:
    """The number that two texts represent, by their ratio."""
    try:
        ratio = float(x) / float(y)
    except (ValueError, ZeroDivisionError):
        return None
    matches = [n for n, (p, q) in enumerate(zip(a, b, strict=True)) if abs(p - ratio * q) < SAME * abs(p)]
    return matches[0] if len(matches) == 1 else None


def _si_template(m: Mechanism, k: Kernel) -> list[Part]:
    """The text of a model file for a mechanism without one, in SI."""
    tree, kinds = m.to_tree(), number_kinds(m, k.trace.numbers)
    for i, n in enumerate(k.trace.numbers):
        if n.path in m.parameters:
            _put_parameter(
                tree["parameters"], n.path, f"@@{i}@@ {si_unit(m.parameters[n.path].dimension)}".strip()
            )
        else:
            _put(tree, n.keys, f"@@{i}@@ {KINDS[kinds[i]].si}".strip(), m)
    tree["assembly"] = _assembly(k)
    parts = tree_text(tree).split("@@")
    return [part if i % 2 == 0 else {"now": [[int(part), 1.0]]} for i, part in enumerate(parts)]


def _assembly(k: Kernel) -> Tree:
    """Places of the numbers of each link's pose, with their units."""
    out: Tree = {}
    for i, path in enumerate(assembly_paths(k), len(k.trace.numbers)):
        _, link, *keys = path.split(".")
        text = f"@@{i}@@ {'m' if keys[:1] == ['position'] else 'rad'}"
        if not keys:
            out[link] = text
        elif keys[1:]:
            vector = out.setdefault(link, {}).setdefault(keys[0], [])
            vector.append(text if keys[0] == "position" else f"@@{i}@@")
        else:
            out[link][keys[0]] = text
    return out


def _put_parameter(parameters: Tree, name: str, text: str) -> None:
    if isinstance(parameters[name], dict):
        parameters[name]["value"] = text
    else:
        parameters[name] = text


def _put(tree: Any, keys: list[str], text: str, m: Mechanism) -> None:
    *holder_keys, last = keys
    if last.isdigit() and not isinstance(_at(tree, holder_keys), list):
        _put(tree, holder_keys, [0, 0], m)  # type: ignore[arg-type]
    holder = _at(tree, holder_keys)
    holder[int(last) if isinstance(holder, list) else last] = text


def _at(tree: Any, keys: list[str]) -> Any:
    for key in keys:
        tree = tree[int(key) if isinstance(tree, list) else key]
    return tree


def with_changed_numbers(m: Mechanism, changes: Mapping[str, float]) -> Mechanism:
    """The mechanism with the numbers that a page has changed, and in the assembly mode that it shows.

    >>> import dalembert as da
    >>> with_changed_numbers(da.four_bar(), {"assembly.rocker": 1.8}).assembly
    {'rocker': 1.8}
    """
    numbers = {path: x for path, x in changes.items() if not path.startswith("assembly.")}
    poses: Tree = {}
    for path, x in changes.items():
        if path not in numbers:
            _, link, *keys = path.split(".")
            if len(keys) == 2:  # a vector, in the order of its components
                poses.setdefault(link, {}).setdefault(keys[0], []).append(x)
            elif keys:
                poses[link][keys[0]] = x
            else:
                poses[link] = x
    return m.with_values(numbers | ({"assembly": poses} if poses else {}))
