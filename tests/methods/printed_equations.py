"""A reader of worked solutions as they are printed: every line with an equals sign is worked out again.

It knows nothing of the program but its plain text. A number stands for itself and half a unit of the last of the
figures that were asked for, however many are printed, so that one printed with fewer does not pass. Signs must mean
the same number wherever they stand.
"""

from __future__ import annotations

import math
import re
from functools import reduce
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.output.summary.printed_units import unit_with_power
from dalembert.units import KINDS
from dalembert.views.notation import pretty

TOKEN = re.compile(
    r"\s*(?:(?P<number>\d+(?:\.\d+)?(?:e[−+-]?\d+)?)|(?P<function>(?:cos|sin|tan|arcsin|arctan)\b)"
    r"|(?P<sign>[^\W\d_]\w*(?:,[\w']+)*'*)|(?P<mark>.))"
)
FUNCTIONS = {"cos": math.cos, "sin": math.sin, "tan": math.tan, "arcsin": math.asin, "arctan": math.atan}
SLACK = 1.1

LEADS = {
    r"F\b(?!_)|cos θ|x R_y|e_\d+$": "",
    r"R$|R_[xyz]$": "force",
    r"R · M": "force and moment",
    r"\(?T_1\)?/\(?T_2": "",
    r"[dpr]$": "arm|length",
    r"M$": "moment",
    r"Σ M|[TM]_|J_|ω_\S+' × J_": "moment",
    r"Σ F|[FGWNS]_": "force",
    r"ω_\S+$": "angular_speed",
    r"α_\S+$": "angular_acceleration",
    r"[θβφ]": "angle",
    r"(?!.*(?:cos|sin)).*r_\S+ \(?α_": "rolling_rate",
    r"(?!.*(?:cos|sin)).*r_\S+ \(?ω_": "rolling",
    r".*\b(?:α_|ω_\S+\^2|a_)": "acceleration",
    r".*\b(?:ω_|v_)": "speed",
    r"h_": "arm",
    r".*\b[rR]_": "length",
    r"[xyz]: |0$": "length|speed|acceleration",
    r"[^\W\d]\w*$": "force|moment",  # an unknown load by its own name
}
"""What an equation begins with, and the kind of its result."""

IN_LETTERS = r"[^=]*_[^=]* = 0"
"""A sum of vectors, whose components follow in numbers."""

RATES = {"angular_speed": "rad/s", "angular_acceleration": "rad/s^2"}


def printed_units(units: Any) -> dict[str, str]:
    """By kind, the unit as it is printed: angles of links in degrees, rates without a unit of the file in radians."""
    texts = {kind: RATES[kind] if units.refuses_bare(kind) else units.text(kind) for kind in KINDS}
    signs = (("*", "·"), ("^2", "²"), ("^3", "³"), ("deg", "°"))
    printed = {kind: reduce(lambda t, sign: t.replace(*sign), signs, text) for kind, text in texts.items()}
    force, factors = printed["force"], printed["moment"].split("·")
    printed["force and moment"] = "·".join(f"{unit}²" if unit == force else unit for unit in factors)
    arm = re.sub(rf"{printed['force']}·|·{printed['force']}", "", printed["moment"])
    rolling = f"{printed['length']}/s"  # radii times radians
    own = {"angle": "°", "angle_of_drive": printed["angle"]}
    return printed | own | {"arm": arm, "rolling": rolling, "rolling_rate": f"{rolling}²"}


class Read(NamedTuple):
    """A number or vector, and how far rounding may have taken it."""

    value: Any
    error: Any


class UnreadableError(Exception):
    """Words, or a sign that no line has given a number to."""


class Reader:
    """Reads lines one by one, and counts what it compared."""

    def __init__(self, figures: int = 4, units: Any = None) -> None:
        self.figures, self.known = figures, dict[str, Read]()
        self.large: dict[str, str] = {}
        self.units = None if units is None else printed_units(units)
        self.idle: list[str] = []
        self.turning = self.crossed = (
            1.0  # the unit of angular speeds squared in that of angular accelerations
        )
        if units is not None:
            speed, rate = (1.0 if units.refuses_bare(k) else units.unit(k).si(1.0) for k in RATES)
            self.turning = speed**2 / rate
        self.compared = self.lines = self.same = 0
        self.factors = {"m": 1.0, "I": 1.0, "J": 1.0}  # of products with these, where units are not coherent
        self.learning = True
        self.tokens: list[tuple[str, str]] = []
        self.bare: list[str] = []

    # a printed number

    def half(self, value: float) -> float:
        """Half a unit of the last figure asked for."""
        return 0.5 * 10.0 ** (math.floor(math.log10(abs(value))) + 1 - self.figures) if value else 0.0

    def number(self, text: str, degrees: bool = False) -> Read:
        value = float(text.replace("−", "-"))
        error = self.half(value)
        if degrees:
            return Read(math.radians(value), math.radians(min(error, 0.5 * 10.0 ** (2 - self.figures))))
        return Read(value, error)

    # an expression: sums of products of powers

    def expression(self, text: str) -> Read:
        self.tokens = [
            (str(m.lastgroup), str(m[m.lastgroup])) for m in TOKEN.finditer(text.strip()) if m.lastgroup
        ]
        found = self._sum()
        if self.tokens:
            raise UnreadableError(f"{self.tokens[0][1]!r} is too much in {text!r}")
        return found

    def _next(self, *marks: str) -> bool:
        return bool(self.tokens and self.tokens[0][1] in marks and self.tokens[0][0] == "mark")

    def _take(self) -> str:
        return self.tokens.pop(0)[1]

    def _sum(self) -> Read:
        minus = self._next("−")
        if minus:
            self._take()
        total = self._product()
        total = Read(-total.value, total.error) if minus else total
        while self._next("+", "−"):
            sign = 1 if self._take() == "+" else -1
            other = self._product()
            total = Read(total.value + sign * other.value, total.error + other.error)
        return total

    def _product(self) -> Read:
        total = self._factor()
        while self.tokens and not self._next("+", "−", ")", ",", "|"):
            if self._next("·"):
                self._take()
                total = times(total, self._factor())
            elif self._next("×"):
                self._take()
                other = self._product()
                product = Read(np.cross(total.value, other.value), np.abs(cross_error(total, other)))
                total = times(product, Read(self.crossed, 0.0))
            elif self._next("/"):
                self._take()
                other = self._factor()
                total = times(total, Read(1 / other.value, other.error / other.value**2))
            else:
                total = times(total, self._factor())
        return total

    def _factor(self) -> Read:
        found = self._atom()
        if self._next("^"):
            self._take()
            power = float(self._take())
            if self._next("/") and self.tokens[1][0] == "number":
                self._take()
                power /= float(self._take())
            whole = abs(found.value) + (found.error if found.value != 10 else 0.0)  # a power of ten is exact
            found = Read(found.value**power, abs(whole**power - abs(found.value) ** power))
        return found

    def _atom(self) -> Read:
        if not self.tokens:
            raise UnreadableError("nothing")
        kind, text = self.tokens.pop(0)
        if kind == "number":
            degrees = self._next("°")
            if degrees:
                self._take()
            return self.number(text, degrees)
        if kind == "function":
            of = self._factor()
            low, high = (FUNCTIONS[text](_within(text, of.value + s * of.error)) for s in (-1, 1))
            return Read(FUNCTIONS[text](of.value), 0.5 * abs(high - low) + 0.5 * of.error**2)
        if kind == "sign":
            if text == "π":
                return Read(math.pi, 0.0)
            if text not in self.known:
                raise UnreadableError(text)
            return self.known[text]
        if text in "([":
            return self._bracket()
        if text == "|":
            inside = self._sum()
            assert self._take() == "|"
            return size(inside)
        raise UnreadableError(text)

    def _bracket(self) -> Read:
        parts = [self._sum()]
        while self._next(","):
            self._take()
            parts.append(self._sum())
        if not self._next(")"):
            raise UnreadableError("a bracket that is not closed")
        self._take()
        if len(parts) == 1:
            return parts[0]
        return Read(np.array([p.value for p in parts]), np.array([p.error for p in parts]))

    # a line

    def line(self, text: str) -> None:
        """Work out every part between the equals signs, and compare each with the last."""
        if " = " not in text:
            return
        self.lines += 1
        text = text.strip()
        before = self.compared + self.same
        for part in re.split(r",\s+(?=[^\W\d_][\w,']* = )", text):
            self.result_unit(part)
            self._equation(re.sub(r"^(?:Σ [\w,']+|[xyz]):\s*", "", part))
        if self.compared + self.same == before:
            self.idle.append(text)

    def result_unit(self, text: str) -> None:
        """The unit behind the result is that of what the equation begins with."""
        behind = re.sub(r"^(?:\(.*?\)|−?\d[\d.]*(?:e[−+-]?\d+)?)\s*", "", text.rpartition(" = ")[2])
        letters = text.partition(" = ")[0].lstrip("−|")
        if re.fullmatch(IN_LETTERS, text):
            return
        kinds = next(kinds for lead, kinds in LEADS.items() if re.match(lead, letters))
        nothing = re.match(r"0(?![.\d])", text.rpartition(" = ")[2]) is not None
        self.unit(re.split(r"(?<!10.)[\s,:]", behind)[0], kinds, text, nothing)

    def unit(self, found: str, kinds: str, text: str, nothing: bool = False) -> None:
        """A printed unit is that of one of these kinds; behind a 0 without its power of ten."""
        if self.units is not None:
            kind_units = {kind: self.units[kind] if kind else "" for kind in kinds.split("|")}
            wanted = list(kind_units.values())
            # a large number has a power of ten, one for a kind throughout
            for kind, unit in kind_units.items():
                plain = unit.replace("·", "*").replace("²", "^2")
                large = [pretty(unit_with_power(plain, p)) for p in (3, 6, 9, 12)]
                if nothing and found in [text.partition(" ")[2] for text in large if text.startswith("10")]:
                    return
                if found not in wanted and found in large:
                    wanted = [self.large.setdefault(kind, found)]
            assert found in wanted, f"{text}: the unit is {found!r}, and should be {' or '.join(wanted)}"

    def _equation(self, text: str) -> None:
        parts = [p.strip() for p in re.split(r" = ", text)]
        read: list[Read] = []
        for n, part in enumerate(parts):
            heavy = re.search(r"\b([mIJ])_", part)
            letters = heavy is not None and not re.search(r"(?<![\w,])\d", part)
            self.crossed = self.turning if letters else 1.0
            try:
                found = self._part(part, last=n == len(parts) - 1 and n > 0)
                read.append(times(found, Read(self.factors[heavy[1]], 0.0)) if heavy and letters else found)
            except UnreadableError:
                continue
        assert read, f"nothing of {text!r} is read"
        for one in read[:-1]:
            self.agree(one, read[-1], text)
        if re.fullmatch(r"[^\W\d_][\w,']*'*", parts[0]) and len(parts) > 1:
            self.learn(parts[0], read[-1], text)
        elif (sign := re.fullmatch(r"\|([^\W\d_][\w,']*'*)\|", parts[0])) and len(parts) > 1:
            self.learn(f"|{sign[1]}|", read[-1], text)
        if len(parts) > 2:
            self.bind(parts[0].rpartition("=")[2], parts[-2])

    def _part(self, text: str, last: bool) -> Read:
        if both := re.fullmatch(r"greater of (.+) and (.+)", text):
            one, other = (self.expression(t) for t in both.groups())
            return one if one.value >= other.value else other
        if not last:
            return self.expression(text)
        found = re.match(r"(?P<vector>\([^()]*, [^()]*\))|(?P<number>−?\d[\d.]*(?:e[−+-]?\d+)?)", text)
        if found is None:
            raise UnreadableError(text)
        rest = text[found.end() :].strip()
        if found["vector"]:
            result = self.expression(found["vector"])
            if length := re.search(r", size (\S+)", rest):
                self.agree(size(result), self.number(length[1]), text)
            return result
        result = self.number(found["number"], rest.startswith("°"))
        self.angle = float(a[1].replace("−", "-")) if (a := re.search(r"∠ (−?[\d.]+)", rest)) else None
        return result

    def agree(self, one: Read, result: Read, text: str) -> None:
        """Two readings of one thing."""
        if np.ndim(one.value) and not np.ndim(result.value):
            if getattr(self, "angle", None) is not None:
                x, y = one.value
                off = math.remainder(math.degrees(math.atan2(y, x)) - self.angle, 360)
                allowed = math.degrees(math.hypot(*one.error) / math.hypot(x, y)) + 0.51 * 10.0 ** (
                    2 - self.figures
                )
                assert abs(off) <= allowed, (text, off)
            one = size(one)
        off = np.abs(one.value - result.value)
        allowed = SLACK * (one.error + result.error) + 1e-9 * np.abs(result.value)
        assert (off <= allowed).all(), f"{text}: {one.value} for {result.value}, {off} beyond {allowed}"
        self.compared += 1

    def learn(self, sign: str, found: Read, text: str) -> None:
        """What a sign stands for; the same as before where it was read before."""
        if not self.learning:
            return
        if sign in self.known and np.shape(self.known[sign].value) == np.shape(found.value):
            off = (
                np.abs(np.abs(self.known[sign].value) - np.abs(found.value))
                if sign.startswith("|")
                else np.abs(self.known[sign].value - found.value)
            )
            assert (off <= SLACK * (self.known[sign].error + found.error)).all(), (
                f"{sign} is two things: {text}"
            )
            self.same += 1
        self.known[sign] = found

    def bind(self, letters: str, numbers: str) -> None:
        """Signs of a product or sum beside the numbers in the same places."""
        left, right = terms(letters), terms(numbers)
        if len(left) != len(right):
            return
        for (minus, a), (negative, b) in zip(left, right, strict=True):
            signs, figures = factors(a), factors(b)
            if len(signs) != len(figures):
                continue
            for n, (sign, figure) in enumerate(zip(signs, figures, strict=True)):
                if not re.fullmatch(r"[^\W\d_][\w,']*'*", sign) or not re.fullmatch(
                    r"−?[\d.]+(?:e[−+-]?\d+)?", figure
                ):
                    continue
                found = self.number(figure)
                flip = minus != negative and n == 0 and len(signs) == 1
                self.learn(
                    sign, Read(-found.value if flip else found.value, found.error), f"{letters}: {numbers}"
                )


def _within(function: str, x: float) -> float:
    return min(max(x, -1.0), 1.0) if function == "arcsin" else x


def terms(text: str) -> list[tuple[bool, str]]:
    """Terms of a sum with their signs; what stands in brackets is one."""
    out, depth, minus, now = [], 0, False, ""
    for c in text.strip():
        depth += (c in "([") - (c in ")]")
        if c in "+−" and not depth and (not now.strip() or now.endswith(" ")):
            if now.strip():
                out.append((minus, now.strip()))
            minus, now = c == "−", ""
        else:
            now += c
    return [*out, (minus, now.strip())]


def factors(text: str) -> list[str]:
    """Factors of a product: what spaces, dots and brackets part."""
    return [a or b for a, b in re.findall(r"\(([^()]*)\)|([^\s·()]+)", text)]


def times(a: Read, b: Read) -> Read:
    """A product; of a matrix and a vector too."""
    if np.ndim(a.value) == 2:
        return Read(a.value @ b.value, a.error @ np.abs(b.value) + np.abs(a.value) @ b.error)
    error = np.abs(a.value) * b.error + np.abs(b.value) * a.error
    return Read(a.value * b.value, error)


def cross_error(a: Read, b: Read) -> Any:
    x, y, dx, dy = (np.abs(v) for v in (a.value, b.value, a.error, b.error))
    turn = [(1, 2), (2, 0), (0, 1)]
    return np.array([x[i] * dy[j] + dx[i] * y[j] + x[j] * dy[i] + dx[j] * y[i] for i, j in turn])


def size(v: Read) -> Read:
    """Length of a vector, absolute value of a number."""
    if not np.ndim(v.value):
        return Read(abs(v.value), v.error)
    return Read(float(np.linalg.norm(v.value)), float(np.linalg.norm(v.error)))
