"""Dormand and Prince's method of order 8 with step control, as LLVM text: one motion with separate steps per lane.

The rates are a program of the state and of numbers. Hairer, Norsett, Wanner, Solving ODEs I, II.5 (DOP853).
"""

from __future__ import annotations

from collections.abc import Callable

from dalembert.kernel.emit.llvm_builder import ModuleText, operations
from dalembert.kernel.emit.llvm_text import WIDE, head, module
from dalembert.kernel.program import Program

STAGES, EXTRA, WIDTH = 12, 3, 17
"""Stages of a step, additional stages for interpolation, and the columns of the table of weights: for the rates before
each stage, and its place in the step. Rows: 0 unused, then the stages, the two errors, four for interpolation."""
SELDOM = "noinline optnone"
"""Attributes of functions called a few times per step: optimizing them would take LLVM longer than all else together.
"""
ERRORS = STAGES + EXTRA + 1
SAFETY, LEAST, MOST, STILL = 0.9, 0.2, 10.0, 2e-15
"""Factors of the step control; a rejected step below ``STILL`` times the duration ends the motion: its next step is 0.
"""


def state_size(n: int, watched: int = 0) -> int:
    """Size of a motion: state, its rates, smallest relevant errors, time, next step, end, relative tolerance, largest
    growth of steps, attempts made, quantities that are watched."""
    return 3 * n + 6 + watched


def record_size(n: int, watched: int = 0) -> int:
    """Size of an attempt: time, step (0 if rejected), states before and after, their rates, four to interpolate, and
    what is watched after it."""
    return 2 + 8 * n + watched


class _Integrator(ModuleText):
    """LLVM text of the steps for a state of n numbers, whose rates have ``watched`` quantities behind them; offsets
    into memory count vectors."""

    def __init__(self, lanes: int, n: int, watched: int) -> None:
        super().__init__(lanes)
        self.n, self.watched, self.row = n, watched, n + watched

    def at(self, base: str, offset: str | int) -> str:
        """Address of one vector."""
        return self.let(f"getelementptr inbounds {self.kind}, ptr {base}, i64 {offset}")

    def get(self, base: str, offset: str | int) -> str:
        return self.let(f"load {self.kind}, ptr {self.at(base, offset)}, align 8")

    def set(self, value: str, base: str, offset: str | int) -> None:
        self.put(f"store {self.kind} {value}, ptr {self.at(base, offset)}, align 8")

    def sum(self, a: str, b: str | int) -> str:
        return self.let(f"add i64 {a}, {b}")

    def product(self, a: str, b: str | int) -> str:
        return self.let(f"mul i64 {a}, {b}")

    def loop(
        self, count: str | int, turn: Callable[..., list[str]], start: tuple[str, ...] = (), go: str = ""
    ) -> list[str]:
        """Loop around code that depends on a counter and on values handed on, until ``go`` is 0, too."""
        self.count += 1
        name, i = f"l{self.count}", f"%i{self.count}"
        self.put(f"br label %{name}pre")
        self.lines += [f"{name}pre:", f"  br label %{name}", f"{name}:"]
        self.put(f"{i} = phi i64 [ 0, %{name}pre ], [ {i}n, %{name}end ]")
        place, old = len(self.lines), [f"%{name}v{k}" for k in range(len(start))]
        new = turn(i, *old)
        self.lines[place:place] = [
            f"  {v} = phi {self.kind} [ {a}, %{name}pre ], [ {b}, %{name}end ]"
            for v, a, b in zip(old, start, new, strict=True)
        ]
        self.put(f"br label %{name}end")
        self.lines.append(f"{name}end:")
        self.put(f"{i}n = add nuw i64 {i}, 1")
        more = self.let(f"icmp ult i64 {i}n, {count}")
        if go:
            more = self.let(f"and i1 {more}, {self.let(f'load i1, ptr {go}')}")
        self.put(f"br i1 {more}, label %{name}, label %{name}out")
        self.lines.append(f"{name}out:")
        return new

    def combined(self, row: str, rows: str | int, i: str) -> str:
        """Component i of the rates computed so far, combined with the weights of a row."""
        weights = self.let(f"getelementptr inbounds double, ptr %table, i64 {self.product(row, WIDTH)}")
        return self.let(f"call {self.kind} @combined(ptr %k, ptr {weights}, i64 {rows}, i64 {i})")

    def stage(self, s: str, t: str, h: str) -> list[str]:
        """The rates of one stage, at a state that is left in z."""
        arguments = ", ".join(f"ptr %{name}" for name in ("y", "given", "k", "z", "table"))
        self.put(f"call void @next({arguments}, i64 {s}, {self.kind} {t}, {self.kind} {h})")
        return []

    def error(self, h: str, tolerance: str) -> str:
        """Estimated error of a step over the tolerance."""

        def one(i: str, fifth: str, third: str) -> list[str]:
            off = [self.combined(str(ERRORS + k), STAGES + 1, i) for k in range(2)]
            ends = [self.intrinsic("fabs", self.get(base, i)) for base in ("%y", "%w")]
            size = self.select(self.compare("ogt", *ends), *ends)
            least = self.get("%y", self.sum(i, 2 * self.n))
            scale = self.intrinsic("fmuladd", tolerance, size, least)
            parts = [self.let(f"fdiv {self.kind} {x}, {scale}") for x in off]
            return [
                self.intrinsic("fmuladd", x, x, acc) for x, acc in zip(parts, (fifth, third), strict=True)
            ]

        fifth, third = self.loop(self.n, one, (self.splat(0.0),) * 2)
        below = self.intrinsic("fmuladd", self.splat(0.01), third, fifth)
        root = self.intrinsic("sqrt", self.let(f"fmul {self.kind} {below}, {self.splat(float(self.n))}"))
        above = self.let(f"fmul {self.kind} {h}, {fifth}")
        ratio = self.let(f"fdiv {self.kind} {above}, {root}")
        return self.select(self.compare("oeq", below, self.splat(0.0)), self.splat(0.0), ratio)

    def both(self, a: str, b: str) -> str:
        return self.let(f"and {self.bit} {a}, {b}")


def integrator(rate: Program, n: int, lanes: int) -> str:
    """Function of values (block, numbers, lane), motions (block, ``state_size``, lane), records (block, most,
    ``record_size``, lane), the table of weights; then the count of numbers, the largest count of attempts, a flag for
    interpolation, the count of blocks. With no attempts it gives the rates at the states. Outputs of the program behind
    the n rates are watched: recorded, not integrated."""
    t = _Integrator(lanes, n, len(rate.outputs) - n)
    names = head(t, rate)
    t.lines.append(
        f"define internal void @stage(ptr noalias %y, ptr noalias %given, ptr noalias %k) {WIDE} {{"
    )
    for x in rate.inputs:
        names[x.index] = t.get("%y" if x.op == "channel" else "%given", rate.places[x.index])
    operations(t, [x for x in rate.order if x.a is not None], names)
    for k, node in enumerate(rate.outputs):
        t.set(names[node.index], "%k", k)
    t.lines += ["  ret void", "}"]
    _combined(t)
    _next(t)
    t.lines.append(
        "define void @run(ptr noalias readonly %values, ptr noalias %state, ptr noalias %out, "
        f"ptr noalias readonly %table, i64 %numbers, i64 %most, i64 %between, i64 %blocks) {SELDOM} {WIDE} {{"
    )
    for name, size in (("k", (STAGES + EXTRA + 1) * t.row), ("z", n + 1), ("w", n), ("live", 1)):
        t.put(f"%{name} = alloca {t.kind}, i64 {size}, align 64")
    t.loop("%blocks", lambda b: _motion(t, b))
    t.lines += ["  ret void", "}"]
    three = ", ".join([t.kind] * 3)
    return module(t, rate, [f"declare {t.kind} @llvm.fmuladd.{t.suffix}({three})"])


def _combined(t: _Integrator) -> None:
    """Function for the weighted sum of component i of several rates."""
    arguments = "ptr noalias readonly %k, ptr noalias readonly %weights, i64 %rows, i64 %i"
    t.lines.append(f"define internal {t.kind} @combined({arguments}) {WIDE} {{")

    def one(j: str, sum_: str) -> list[str]:
        k = t.get("%k", t.sum(t.product(j, t.row), "%i"))
        return [t.intrinsic("fmuladd", t.broadcast(t.load("%weights", j, vector=False)), k, sum_)]

    total = t.loop("%rows", one, (t.splat(0.0),))
    t.lines += [f"  ret {t.kind} {total[0]}", "}"]


def _next(t: _Integrator) -> None:
    """One stage of a step."""
    arguments = "ptr %y, ptr %given, ptr %k, ptr %z, ptr %table, i64 %s"
    t.lines.append(f"define internal void @next({arguments}, {t.kind} %t, {t.kind} %h) {WIDE} {{")

    def one(i: str) -> list[str]:
        t.set(t.intrinsic("fmuladd", "%h", t.combined("%s", "%s", i), t.get("%y", i)), "%z", i)
        return []

    t.loop(t.n, one)
    place = t.sum(t.product("%s", WIDTH), WIDTH - 1)
    weight = t.broadcast(t.load("%table", place, vector=False))
    t.set(t.intrinsic("fmuladd", "%h", weight, "%t"), "%z", t.n)
    t.put(f"call void @stage(ptr %z, ptr %given, ptr {t.at('%k', t.product('%s', t.row))})")
    t.lines += ["  ret void", "}"]


def _motion(t: _Integrator, b: str) -> list[str]:
    """Integration of a block of motions: rates at the start, then attempted steps until all have ended."""
    n = t.n
    t.put(f"%given = getelementptr inbounds {t.kind}, ptr %values, i64 {t.product(b, '%numbers')}")
    t.put(f"%y = getelementptr inbounds {t.kind}, ptr %state, i64 {t.product(b, state_size(n, t.watched))}")
    t.put(f"%f = getelementptr inbounds {t.kind}, ptr %y, i64 {n}")
    _copy(t, ("%y", 0, "%z"))
    t.set(t.get("%y", 3 * n), "%z", n)
    t.put("call void @stage(ptr %z, ptr %given, ptr %k)")
    _copy(t, ("%k", 0, "%f"))
    if t.watched:
        t.loop(t.watched, lambda i: _keep(t, t.get("%k", t.sum(i, n)), ("%y", t.sum(i, state_size(n)))))
    t.set(t.splat(0.0), "%y", 3 * n + 5)
    t.put(f"%pages = mul i64 {b}, %most")
    t.put("%some = icmp ugt i64 %most, 0")
    t.put("br i1 %some, label %attempts, label %done")
    t.lines.append("attempts:")
    t.loop("%most", lambda j: _attempt(t, j), go="%live")
    t.put("br label %done")
    t.lines.append("done:")
    return []


def _keep(t: _Integrator, value: str, place: tuple[str, str]) -> list[str]:
    """Store a value, as the turn of a loop."""
    t.set(value, *place)
    return []


def _copy(t: _Integrator, *moves: tuple[str, str | int, str]) -> None:
    """Copies vectors of n, from an offset at one place to another place."""

    def one(i: str) -> list[str]:
        for source, offset, goal in moves:
            t.set(t.get(source, t.sum(i, offset)), goal, i)
        return []

    t.loop(t.n, one)


def _attempt(t: _Integrator, j: str) -> list[str]:
    """One attempt of a step of every lane: those that have ended, or cannot advance, stay."""
    n, zero = t.n, t.splat(0.0)
    time, wish, end, tolerance, growth, made = (t.get("%y", 3 * n + k) for k in range(6))
    room = t.let(f"fsub {t.kind} {end}, {time}")
    last = t.compare("oge", wish, room)
    h = t.select(last, room, wish)
    _copy(t, ("%f", 0, "%k"))

    t.loop(STAGES, lambda s: t.stage(t.sum(s, 1), time, h))
    _copy(t, ("%z", 0, "%w"))
    error = t.error(h, tolerance)
    moves, small = t.compare("ogt", h, zero), t.compare("olt", error, t.splat(1.0))
    taken = t.both(moves, small)
    root = error
    for _ in range(3):
        root = t.intrinsic("sqrt", root)
    factor = t.let(f"fdiv {t.kind} {t.splat(SAFETY)}, {root}")
    grown = t.select(t.compare("olt", factor, growth), factor, growth)
    shrunk = t.select(t.compare("ogt", factor, t.splat(LEAST)), factor, t.splat(LEAST))
    step = t.let(f"fmul {t.kind} {h}, {t.select(small, grown, shrunk)}")
    tiny = t.compare("olt", step, t.let(f"fmul {t.kind} {t.splat(STILL)}, {t.intrinsic('fabs', time)}"))
    step = t.select(small, step, t.select(tiny, zero, step))
    t.put(f"%page = add i64 %pages, {j}")
    t.put(
        f"%record = getelementptr inbounds {t.kind}, ptr %out, i64 {t.product('%page', record_size(n, t.watched))}"
    )
    t.put("%wanted = icmp ugt i64 %between, 0")
    t.put("br i1 %wanted, label %more, label %kept")
    t.lines.append("more:")
    _between(t, time, h)
    t.put("br label %kept")
    t.lines.append("kept:")
    _record(t, time, h, taken)
    new = t.select(taken, t.select(last, end, t.let(f"fadd {t.kind} {time}, {h}")), time)
    wish = t.select(moves, step, wish)
    refused = t.both(moves, t.compare("uge", error, t.splat(1.0)))
    growth = t.select(refused, t.splat(1.0), t.splat(MOST))
    made = t.let(f"fadd {t.kind} {made}, {t.splat(1.0)}")
    for k, value in ((0, new), (1, wish), (4, growth), (5, made)):
        t.set(value, "%y", 3 * n + k)
    live = t.both(t.compare("olt", new, end), t.compare("ogt", wish, zero))
    if t.lanes > 1:
        live = t.let(f"call i1 @llvm.vector.reduce.or.v{t.lanes}i1({t.bit} {live})")
    t.put(f"store i1 {live}, ptr %live")
    return []


def _record(t: _Integrator, time: str, h: str, taken: str) -> None:
    """Record an attempt, and take its state where it is taken."""
    n = t.n
    t.set(time, "%record", 0)
    t.set(t.select(taken, h, t.splat(0.0)), "%record", 1)

    def advance(i: str) -> list[str]:
        newest = t.sum(i, STAGES * t.row)
        for place, base, old, new in (
            (2, "%y", i, t.get("%w", i)),
            (2 + 2 * n, "%f", i, t.get("%k", newest)),
        ):
            before = t.get(base, old)
            t.set(before, "%record", t.sum(i, place))
            t.set(new, "%record", t.sum(i, place + n))
            t.set(t.select(taken, new, before), base, i)
        return []

    t.loop(n, advance)
    if t.watched:
        place = STAGES * t.row + n
        t.loop(
            t.watched, lambda i: _keep(t, t.get("%k", t.sum(i, place)), ("%record", t.sum(i, record_size(n))))
        )


def _between(t: _Integrator, time: str, h: str) -> None:
    """Additional stages, and their interpolant of the state within the step."""
    n = t.n

    t.loop(EXTRA, lambda s: t.stage(t.sum(s, STAGES + 1), time, h))

    def row(r: str) -> list[str]:
        def one(i: str) -> list[str]:
            total = t.combined(t.sum(r, ERRORS + 2), STAGES + EXTRA + 1, i)
            place = t.sum(t.sum(t.product(r, n), i), 2 + 4 * n)
            t.set(t.let(f"fmul {t.kind} {h}, {total}"), "%record", place)
            return []

        t.loop(n, one)
        return []

    t.loop(4, row)
