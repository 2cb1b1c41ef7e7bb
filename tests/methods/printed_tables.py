"""The tables of a worked solution, worked out again from what is printed: sums, sizes, directions, products."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np

from dalembert import unit_names
from dalembert.reports.formula import plain, write_mixed
from dalembert.reports.sheet import Equations, Heading, Matrix, Paragraph, ReportSheet, SheetTable
from dalembert.reports.writers.plain_writer import _equation
from tests.methods.printed_equations import Read, Reader, size, times

Cells = list[list[str]]
EVERYWHERE = re.compile(r"[FGMTWNmIJ]_|a_G|\||work|[ωα]_(?!c)")
"""Signs that mean one number in the whole solution; arms, radii, springs and dampers are those of the link at hand."""


def read_sheet(sheet: ReportSheet, figures: int = 4, units: Any = None) -> Reader:
    """Every equation, table and matrix of a worked solution."""
    reader = Reader(figures, units)
    for b in sheet.blocks:
        if isinstance(b, Heading) and " end of " in b.text:
            reader.known.clear()  # another solution begins
        if isinstance(b, Paragraph):
            _said(reader, "".join(write_mixed(b.text, plain, str)))
        if isinstance(b, Equations):
            for w in b.lines:
                reader.line(re.sub(r" = 0 = ", " = ", " = ".join(t.strip() for t in _equation(w)), count=1))
        if isinstance(b, SheetTable):
            rows = [["".join(write_mixed(cell, plain, str)) for cell in row] for row in (b.heads, *b.rows)]
            reader.learning = "ground axes" not in b.caption
            _units(reader, b.caption, rows[0])
            _table(reader, rows[0], rows[1:])
        if isinstance(b, Matrix):
            reader.learning = "ground axes" not in b.caption
            _matrix(reader, b)
        reader.learning = True
    return reader


def _said(reader: Reader, words: str) -> None:
    """Arms and radii are those of the link or mesh that follows; what words say of a rate is read."""
    if re.match(r"Link |Mesh |Loop |Joint ", words):
        for sign in [s for s in reader.known if not EVERYWHERE.match(s)]:
            del reader.known[sign]
    for sign, rate in re.findall(r"([ωα]_c) = (−?[\d.]+)", words):
        reader.known[sign] = reader.number(rate)
    conversion = (
        r"As 1 [^,]+? is ([\d.]+[⁰¹²³⁴-⁹]*) [^,]+, ((?:masses|moments) [^.]*) are (divided|multiplied) by"
    )
    for figure, of, how in re.findall(conversion, words):
        base, power = re.fullmatch(r"([\d.]+)(.*)", figure).groups()  # type: ignore[union-attr]
        whole = float(base) ** int(power.translate(RAISED) or 1)
        factor = whole ** (-1 if how == "divided" else 1)
        signs = "m" * ("masses" in of) + "IJ" * ("moments" in of)
        reader.factors |= dict.fromkeys(signs, factor)


def number(reader: Reader, cell: str) -> Read | None:
    """A cell that begins with a number, in brackets or not."""
    found = re.match(r"\(?(−?\d[\d.]*(?:e[−+-]?\d+)?)", cell)
    return reader.number(found[1]) if found else None


def vector(reader: Reader, cells: list[str]) -> Read | None:
    found = [number(reader, c) for c in cells]
    known = [f for f in found if f is not None]
    if len(known) < len(found):
        return None
    return Read(np.array([f.value for f in known]), np.array([f.error for f in known]))


def _table(reader: Reader, heads: list[str], rows: Cells) -> None:
    starts = "|".join(heads)
    for start, read in TABLES.items():
        if starts.startswith(start):
            read(reader, heads, rows)
            return
    assert starts.startswith(WORDS), f"no reader of the table {starts}"


def _units(reader: Reader, caption: str, heads: list[str]) -> None:
    """Units in heads and captions are those of what the heads say."""
    for head in heads:
        if (found := re.search(r" \(((?:10\S+ )?\S*)\)$", head)) is not None:
            kinds = next(kinds for sign, kinds in HEADS.items() if re.match(sign, head))
            reader.unit(found[1], kinds, head)
    for words, kind in (("[Ff]orces in", "force"), ("(?:couple|moment)s in", "moment")):
        for unit in re.findall(rf"{words} ((?:10\S+ )?[^\s,;]+)", caption):
            reader.unit(unit, kind, caption)
    for unit in re.findall(r"Inertia \((\S+)\)", caption):
        reader.unit(unit, "inertia", caption)


def _links(reader: Reader, heads: list[str], rows: Cells) -> None:
    for row in rows:
        n = row[0].partition(" ")[0]
        for sign, head in (("m", "Mass"), ("I", "Inertia")):
            if head in heads and (found := number(reader, row[heads.index(head)])):
                reader.known[f"{sign}_{n}"] = found


def _inertias(reader: Reader, heads: list[str], rows: Cells) -> None:
    for row in rows:
        cells = [number(reader, c) or Read(0.0, 0.0) for c in [*row[1:], *["0"] * 3][:6]]
        order = [(0, 3, 4), (3, 1, 5), (4, 5, 2)]
        parts = [np.array([[cells[n][p] for n in line] for line in order]) for p in (0, 1)]
        reader.known[f"J_{row[0].partition(' ')[0]}"] = Read(*parts)


def _motion(reader: Reader, heads: list[str], rows: Cells) -> None:
    """Rates of the links: in the plane a number and two of the acceleration, in space vectors of three."""
    signs = [h.partition(" ")[0] for h in heads]
    for row in rows:
        n = row[0].partition(" ")[0]
        for letter in ("ω", "α", "a_G"):
            of = [k for k, s in enumerate(signs) if s == letter or re.fullmatch(f"{letter}_?[xyz]", s)]
            found = vector(reader, [row[k] for k in of]) if of else None
            if found is not None and len(of) == 1:
                found = Read(found.value[0], found.error[0])
            if found is not None:
                reader.known[f"{letter}{n}" if letter == "a_G" else f"{letter}_{n}"] = found


def _forces(reader: Reader, heads: list[str], rows: Cells) -> None:
    """Components with their size and direction, and the same along and across the link."""
    for row in rows:
        xy, whole = vector(reader, row[2:4]), number(reader, row[4])
        if xy is None or whole is None:
            continue
        reader.angle = float(row[5].replace("−", "-")) if row[5] != "–" else None
        reader.agree(xy, whole, str(row))
        reader.angle = None
        if (across := vector(reader, row[6:8])) is not None:
            reader.agree(size(across), whole, str(row))
        for axis, k in (("x", 2), ("y", 3)):
            sign = row[1] + ("," if "," in row[1] else "") + axis
            found = number(reader, row[k])
            assert found is not None
            if f"N{sign[1:]}" not in reader.known:
                reader.learn(sign, found, str(row))


def _reactions(reader: Reader, heads: list[str], rows: Cells) -> None:
    """In space: forces and moments with their sizes."""
    for row in rows:
        for start in (2, 7):
            cells = ["0" if c == "–" else c for c in row[start : start + 3]]
            whole = number(reader, row[start + 3])
            if whole is not None and (found := vector(reader, cells)) is not None:
                reader.agree(size(found), whole, str(row))


def _sums(reader: Reader, heads: list[str], rows: Cells, columns: slice = slice(1, None)) -> None:
    """The last row is the sum of those above."""
    assert rows[-1][0] == "sum"
    for k in range(len(heads))[columns]:
        found = [f for row in rows[:-1] if (f := number(reader, row[k]))]
        total = number(reader, rows[-1][k])
        if total is None or not found:
            continue
        whole = Read(math.fsum(f.value for f in found), math.fsum(f.error for f in found))
        reader.agree(whole, total, f"{heads[k]}: {[row[k] for row in rows]}")


def _arms(reader: Reader, heads: list[str], rows: Cells) -> None:
    """F times h, with the own moment of a source, is its torque; the last row is the sum."""
    for row in rows[:-1]:
        force, arm, product, own, torque = (number(reader, cell) for cell in row[1:])
        if force is not None and arm is not None and product is not None:
            reader.agree(times(force, arm), size(product), f"F h: {row}")
        parts = [p for p in (product, own) if p is not None]
        assert torque is not None
        whole = Read(math.fsum(p.value for p in parts), math.fsum(p.error for p in parts))
        reader.agree(whole, torque, f"T: {row}")
    _sums(reader, heads, rows, slice(5, None))


def _superposition(reader: Reader, heads: list[str], rows: Cells) -> None:
    """Numbers sum up; the components of a force have the size and direction beside them."""
    sizes = [k for k, head in enumerate(heads) if head.startswith("|")]
    added = [k for k in range(1, len(heads)) if k not in sizes and heads[k] != "angle °"]
    for k in added:
        _sums(reader, heads, rows, slice(k, k + 1))
        found = number(reader, rows[-1][k])
        assert found is not None
        if heads[k] in reader.known:
            reader.learn(heads[k], found, f"sum of the superposition: {heads[k]} = {rows[-1][k]}")
    for k in sizes:
        d = 2 if heads[k + 1 : k + 2] == ["angle °"] else 3
        for row in rows:
            force, whole = vector(reader, row[k - d : k]), number(reader, row[k])
            assert force is not None
            assert whole is not None
            reader.angle = float(row[k + 1].replace("−", "-")) if d == 2 and row[k + 1] != "–" else None
            reader.agree(force, whole, str(row))
            reader.angle = None


def _work(reader: Reader, heads: list[str], rows: Cells) -> None:
    """Force times displacement and couple times turn are the work."""
    for row in rows[:-1]:
        total = Read(0.0, 0.0)
        for acts, moves in zip(row[1].split(" and "), row[2].split(" and "), strict=True):
            product = times(reader.expression(acts), reader.expression(moves))
            total = Read(total.value + np.sum(product.value), total.error + np.sum(product.error))
        work = number(reader, row[3])
        assert work is not None
        reader.agree(total, work, str(row))
    _sums(reader, heads, rows, slice(3, 4))
    total = number(reader, rows[-1][3])
    assert total is not None
    reader.known["work"] = total


def _matrix(reader: Reader, b: Matrix) -> None:
    """Each row times the unknowns is the right side; each unknown is what it is elsewhere."""
    x = [reader.number(plain(v)) for v in b.values]
    for row, right in zip(b.rows, b.right, strict=True):
        parts = [times(reader.number(plain(c)), v) for c, v in zip(row, x, strict=True)]
        left = Read(math.fsum(p.value for p in parts), math.fsum(p.error for p in parts))
        reader.agree(left, reader.number(plain(right)), f"{row} = {right}")
    for sign, value in zip(b.unknowns, x, strict=True):
        if plain(sign) in reader.known:
            reader.learn(plain(sign), value, f"matrix: {sign}")


def _system_forces(reader: Reader, heads: list[str], rows: Cells) -> None:
    """Given forces of a force system: components, size, direction."""
    d = 2 if "angle °" in heads else 3
    for row in rows:
        found, whole = vector(reader, row[1 : 1 + d]), number(reader, row[1 + d])
        assert found is not None
        assert whole is not None
        if d == 2 and row[4] != "–":
            reader.angle = float(row[4].replace("−", "-"))
        reader.agree(found, whole, str(row))
        reader.angle = None
        for k in range(3 if d == 3 and row[5] != "–" else 0):
            cosine = number(reader, row[5 + k])
            assert cosine is not None
            product = times(cosine, whole)
            reader.agree(Read(found.value[k], found.error[k]), product, str(row))


def _system_moments(reader: Reader, heads: list[str], rows: Cells) -> None:
    """Moments of the forces of a system by their arms, and the sums."""
    d = 2 if len(heads) == 6 else 3
    for row in rows[:-1]:
        if row[1] == "–":
            continue
        arm, force = (vector(reader, row[s : s + d]) for s in (1, 1 + d))
        assert arm is not None
        assert force is not None
        for k in range(1 if d == 2 else 3):
            i, j = (0, 1) if d == 2 else ((1, 2), (2, 0), (0, 1))[k]
            one, other = (
                times(Read(arm.value[p], arm.error[p]), Read(force.value[q], force.error[q]))
                for p, q in ((i, j), (j, i))
            )
            found = number(reader, row[1 + 2 * d + k])
            assert found is not None
            reader.agree(Read(one.value - other.value, one.error + other.error), found, str(row))
    _sums(reader, heads, rows, slice(1 + 2 * d, None))


def _counts(reader: Reader, heads: list[str], rows: Cells) -> None:
    assert sum(int(row[-1]) for row in rows[:-1]) == int(rows[-1][-1])


def _parameters(reader: Reader, heads: list[str], rows: Cells) -> None:
    """Values in their own units, which follow from one another as is printed; their names are those of this table."""
    outside, reader.known = reader.known, {"pi": Read(math.pi, 0.0)}
    for name, cell, _ in rows:
        follows, _, stated = cell.rpartition(" = ")
        figure, _, unit = stated.partition(" ")
        size = unit_names.unit(unit.translate(AS_TYPED)).si(1.0) if unit else 1.0
        found = times(reader.number(figure), Read(size, 0.0))
        if follows:
            for word in re.findall(r"\d ([^\W\d]\w*)", follows):  # a quantity is a number times its unit
                reader.known[word] = Read(unit_names.unit(word).si(1.0), 0.0)
            text = re.sub(r"(\w+)\^(\d+)", r"(\1^\2)", follows).replace("*", "·").replace("-", "−")
            reader.agree(reader.expression(text), found, f"{name}: {cell}")
        reader.known[name] = found
    reader.known = outside


def _laws(reader: Reader, heads: list[str], rows: Cells) -> None:
    """Of every rise v = C_v h/b, a = C_a h/b^2 and j = C_j h/b^3; over a drive with a speed w, b/w for b."""
    timed, speed = heads[1] in ("b (s)", "b (min)"), Read(1.0, 0.0)
    for k, row in enumerate(rows):
        b, h, *others = (_in_si(reader, *cell) for cell in zip(row[1:], heads[1:], strict=True))
        assert b is not None
        assert h is not None
        for n, (factor, rate) in enumerate(zip(others[:3], others[3:], strict=True), 1):
            assert (factor is None) == (rate is None), f"one of them is infinite: {row}"
            if factor is None or rate is None:
                continue
            right, left = times(factor, h), rate
            for _ in range(n):
                left = times(left, b)
            if not timed and (k, n) == (0, 1):
                inverse = Read(1 / right.value, right.error / right.value**2)
                speed = times(left, inverse)
                continue
            for _ in range(n):
                right = times(right, speed)
            reader.agree(right, left, f"{heads[n + 5]}: {row}")


def _in_si(reader: Reader, cell: str, head: str) -> Read | None:
    """The size of what a cell says in the unit of its head; None where it is infinite."""
    found, unit = number(reader, cell), re.search(r" \((?:10([⁰¹²³⁴-⁹]+) )?(.*)\)$", head)
    if found is None or unit is None:
        return found
    one = unit_names.unit(unit[2].translate(AS_TYPED)).si(10.0 ** int((unit[1] or "0").translate(RAISED)))
    least = 0.5 * 10.0 ** (2 - reader.figures) if unit[2] == "°" else 0.0
    return size(times(Read(found.value, max(found.error, least)), Read(one, 0.0)))


RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")
AS_TYPED = str.maketrans({"·": "*", "°": "deg", "²": "^2", "³": "^3", "⁴": "^4"})


HEADS = {
    "Points|Centre|[xyz] |G_": "length",
    "θ": "angle",
    "ω": "angular_speed",
    "α": "angular_acceleration",
    "a_G": "acceleration",
    "v_G": "speed",
    "couple|F h |direct |T ": "moment",
    "F ": "force",
    "Work": "force|moment",
    "Power": "power",
    r"b \(": "time|angle_of_drive|length",
    r"h \(": "angle_of_drive|length",
    r"v \(": "angular_speed|speed",
    r"a \(": "angular_acceleration|acceleration",
    r"j \(": "angular_jerk|jerk",
}
"""What a head with a unit begins with, and of which kind it is."""

WORDS = (
    "Joint or drive|Type",
    "Load|Type|Value",
    "Couple|M",
    "Joint|x'|y'|z'",
    "Joint|Freedom|Value",
    "Joint|x (",
    "Link|Turned by",
    "Largest|Value",
)
"""Tables that say what the equations below them use, or nothing that can be worked out again."""


def _unknowns(reader: Reader, heads: list[str], rows: Cells) -> None:
    """Unknowns of a large matrix beside their values, which are what they are elsewhere."""
    for row in rows:
        for sign, cell in zip(row[::2], row[1::2], strict=True):
            found = number(reader, cell)
            if found is not None and sign in reader.known:
                reader.learn(sign, found, str(row))


TABLES: dict[str, Any] = {
    "Parameter|Value|Meaning": _parameters,
    "Curve|b": _laws,
    "Unknown|Value": _unknowns,
    "Link|Points": _links,
    "Link|J_xx": _inertias,
    "Link|θ (°)": _motion,
    "Link|ω_x": _motion,
    "Link|v_Gx": _motion,
    "Joint|Type|Links|Reactions": _counts,
    "Joint|Power lost": _sums,
    "Joint|Force|x|y|size|angle °": _forces,
    "Joint|Force|x|y|z": _reactions,
    "Joint|Force|x'": _reactions,
    "Load|Force or couple": _work,
    "Source|F (": _arms,
    "Source": _superposition,
    "Power put in by": _sums,
    "Part|x|y": _system_moments,
    "Force|F_x|F_y": _system_forces,
}
"""By the heads of a table, separated by strokes, how it is read."""
