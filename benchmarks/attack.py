"""Models of this repository are changed at random, and everything that can be asked of them is asked.

Method. Each number is a model: a file and up to four changes (`changed_models.py`), the same for the same number. What
is refused must be refused by a sentence; what is answered must be finite where it has numbers and NaN elsewhere, and
the same by every way: asked again (kept programs), by the careful path, by a kernel, by a kernel with other numbers,
written and read again, saved in each form, lifted into space, with its positions backwards, in a sweep. Everything that
a person can read or draw of it is made, of a share of the models. What takes too long is a finding too. Findings are
printed, and kept in build/attack. Not every one is a fault: where two joints do the work of one, or a law has its
corner, two ways may differ.

    python benchmarks/attack.py [--seconds 600] [--processes 2] [--from 0]
    python benchmarks/attack.py --at 4711          # one model: its tree, and what is found
"""

from __future__ import annotations

import os

os.environ |= {"OPENBLAS_NUM_THREADS": "1"}

import argparse
import contextlib
import io
import json
import multiprocessing
import random
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from changed_models import ROOT, changed_model
from tests.kernel.comparing import changed, difference, every_number

import dalembert as da
from dalembert.analysis.batch.tracing.symbolic_model import with_numbers
from dalembert.analysis.output.rounding import sizes
from dalembert.errors import FORCED, NUMBERED, DalembertError

BUILD = ROOT / "build" / "attack"
SECONDS = 60
"""Of the processor, for all that is asked of one model at one time."""
AGREES, NEAR, DEAD_CENTRE, FAR = 1e-6, 1e-5, 300, 0.5
"""Differences of two ways, over the largest force of the machine; how many times the usual force is that of a dead
centre, beside which two ways may go on differently; and the angle, rad, from which on a mode is another one."""
Findings = Iterator[str]


class LateError(BaseException):
    """A model took too long; nothing in between catches it."""


def _late(*_: object) -> None:
    raise LateError


@contextlib.contextmanager
def timed(seconds: float) -> Iterator[None]:
    """Raises LateError after so many seconds of the processor."""
    before = signal.signal(signal.SIGPROF, _late)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def run(m: da.Mechanism, **options: Any) -> da.Result:
    """Dynamics where it moves, else statics."""
    return (da.dynamics if m.has_speeds else da.statics)(m, **options)


def honest(r: da.Result) -> Findings:
    """Numbers where there is an answer, NaN elsewhere, and a reason there."""
    for k, status in enumerate(r.status):
        values = np.concatenate(
            [r.effort_array[k].ravel(), r.load_array[k].ravel(), r.force_array[k].ravel()]
        )
        if status in NUMBERED:
            if not np.isfinite(values).all():
                yield f"{status} and not finite at {k}"
            if not r.residual[k] < AGREES or not abs(r.power_balance[k]) < AGREES:
                yield f"{status} and residual {r.residual[k]:.1e}, power {r.power_balance[k]:.1e} at {k}"
        elif np.isfinite(r.force_array[k]).any() and status not in FORCED:
            yield f"{status} with numbers at {k}"
        if status not in NUMBERED and not r.reasons[k]:
            yield f"{status} without a sentence at {k}"


def alike(a: da.Result, b: da.Result, what: str, near: float = AGREES) -> Findings:
    """Two answers of one model."""
    if a.status != b.status:
        pairs = {(x, y) for x, y in zip(a.status, b.status, strict=False) if x != y}
        yield f"{what}: statuses {sorted(pairs)[:4]}"
        return
    for name in ("force_array", "moment_array", "effort_array", "load_array"):
        x, y = getattr(a, name), getattr(b, name)
        if x.shape != y.shape or (np.isnan(x) != np.isnan(y)).any():
            yield f"{what}: {name} has numbers in other places"
            continue
        size = max(np.nanmax(np.abs(y), initial=0.0), np.nanmax(np.abs(b.force_array), initial=0.0), 1e-6)
        off = np.nanmax(np.abs(x - y), initial=0.0)
        if off > near * size:
            yield f"{what}: {name} differs by {off / size:.1e}"


def asked_again(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    for _ in range(4):
        yield from alike(run(m), r, "asked again")


def careful(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    yield from alike(r, run(m, method="careful"), "careful path")


def written(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    yield from alike(run(da.mechanism(m.to_tree())), r, "written and read")


def saved(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    """Saved as JSON, TOML and YAML."""
    with tempfile.TemporaryDirectory() as folder:
        for form in ("json", "toml", "yaml"):
            path = Path(folder, f"m.{form}")
            m.save(path)
            yield from alike(run(da.load(path)), r, f"saved as {form}")


def backwards(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    """Positions in the other order: forces of a position do not depend on the list."""
    if m.assembly or len(r.status) < 2 or r.mechanism.dimension == 3 or r.compiled.counts:
        return
    listed = any(isinstance(x, tuple) for d in m.drives.values() for x in (d.speed, d.acceleration))
    if listed or not all(d.law is None for d in m.drives.values()) or len(m.drives) != 1:
        return
    (name,) = m.drives
    tree = m.to_tree()
    unit = "rad" if r.drive_position(name).size and m.drives[name].turns else "m"
    listed = [f"{x!r} {unit}" for x in r.drive_position(name).tolist()]
    tree["drives"][name]["position"] = listed[::-1]
    other = run(da.mechanism(tree))
    if all(s in ("ok", "reversal") for s in (*r.status, *other.status)) and np.allclose(
        other.turn_array[::-1], r.turn_array, atol=1e-6
    ):
        off = np.abs(other.force_array[::-1] - r.force_array)
        if off.max(initial=0) > NEAR * np.abs(r.force_array).max(initial=1e-9) and not r.reverses.any():
            yield f"backwards: forces differ by {off.max():.1e}"


def lifted(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    """A plane machine in space."""
    if m.dimension == 3 or r.friction is not None or len(r.status) > 80:
        return
    try:
        space = run(da.lifted(m))
    except DalembertError:
        return
    if set(r.status) != {"ok"} or not set(space.status) <= {"ok", "redundant"}:
        return
    for name in r.drives:
        size = max(np.abs(r.effort_array).max(), np.abs(r.force_array).max(initial=0), 1e-6)
        off = np.abs(space.effort(name) - r.effort(name)).max()
        if off > NEAR * size:
            yield f"in space: effort of {name} differs by {off / size:.1e}"


def kernel(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    """A kernel without numbers that vary, and one with some, at other values of them."""
    same = {"redundant": "ok"}
    answer = da.compile(m, lanes=1)()
    g = run(m, method="careful")
    mine, theirs = (tuple(same.get(s, s) for s in x) for x in (answer.status[0], g.status))
    if mine != theirs:
        yield f"kernel: statuses {sorted({(x, y) for x, y in zip(mine, theirs, strict=False) if x != y})[:4]}"
    names = every_number(m)
    if not names:
        return
    k = da.compile(m, rng.sample(names, min(len(names), 6)), lanes=1)
    values = np.array([changed(k, rng.randrange(10**6), 0.02, 0.3) for _ in range(3)])
    b = k(values)
    for d in range(3):
        try:
            design = k.trace.course.in_mode(with_numbers(m, k.trace.numbers, values[d].tolist()))
            g = (da.dynamics if k.trace.inertia else da.statics)(design, method="careful")
        except DalembertError:
            continue
        mine, theirs = (tuple(same.get(s, s) for s in x) for x in (b.status[d], g.status))
        if mine != theirs:
            pairs = {(x, y) for x, y in zip(mine, theirs, strict=False) if x != y}
            if pairs == {("not_assembled", "ok")} and np.abs(g.turn_array[0] - r.turn_array[0]).max() > FAR:
                continue  # it closes in another mode, far from that of the file, which a kernel keeps
            yield f"kernel of {names_of(k)}: statuses {sorted(pairs)[:4]}"
        elif np.nanmax(np.abs(g.force_array), initial=0) > 1e-6 and difference(k, b, d, g) > NEAR:
            if _two_modes(k, design, g) or _given_at_rest(g):
                continue
            yield f"kernel of {names_of(k)}: differs by {difference(k, b, d, g):.1e}"


def _given_at_rest(g: da.Result) -> bool:
    """True where an effort is given at a position without forces: a kernel has no numbers there at all."""
    given = any(d.effort is not None for d in g.mechanism.drives.values())
    return given and any(status not in FORCED for status in g.status)


def _two_modes(k: da.Kernel, design: da.Mechanism, g: da.Result) -> bool:
    """True where the mode is open: the file's angles are as near to another one, or it begins beside a dead centre."""
    sizes = np.abs(g.force_array).reshape(len(g.status), -1).max(axis=1, initial=0.0)
    if np.nanmax(sizes) > DEAD_CENTRE * np.nanmedian(sizes):
        return True
    free = k.trace.course.in_mode(design.model_copy(update={"assembly": {}}))
    other = (da.dynamics if k.trace.inertia else da.statics)(free, method="careful")
    return bool(np.nanmax(np.abs(other.turn_array - g.turn_array), initial=0.0) > 1e-6)


def names_of(k: da.Kernel) -> str:
    return " ".join(k.numbers)


def texts(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    """What is printed and saved."""
    said = [r.text(), str(r), json.dumps(r.to_dict(), allow_nan=False)]
    for text in said:
        yield from no_nan(text, "text")
    with tempfile.TemporaryDirectory() as folder:
        for form in ("csv", "json", "xlsx", "npz", "nc"):
            try:
                r.save(Path(folder, f"r.{form}"))
            except DalembertError as error:
                yield from sentence(error)


def sentence(error: DalembertError) -> Findings:
    text = str(error)
    if len(text) < 10 or "Traceback" in text or " nan" in text:
        yield f"odd sentence: {text[:200]}"


def no_nan(text: str, what: str) -> Findings:
    """No "nan" or "inf" in words that a person reads."""
    if "Check failed" in text:
        yield f"{what}: {text[text.index('Check failed') :][:200]}"
    words = set(text.replace(",", " ").replace("(", " ").replace(")", " ").split())
    if words & {"inf", "-inf", "None", "np.float64"}:
        yield f"{what} has {sorted(words & {'inf', '-inf', 'None', 'np.float64'})}"


def refusing(what: str, make: Callable[[], Any]) -> Findings:
    """It answers, or refuses with a sentence; its text can be printed."""
    try:
        answer = make()
        if callable(said := getattr(answer, "text", None)):
            yield from no_nan(said(), what)
    except DalembertError as error:
        yield from sentence(error)
    except LateError:
        raise
    except Exception as error:
        yield f"{what}: {where(error)}"


def where(error: BaseException) -> str:
    frames = traceback.extract_tb(error.__traceback__)
    last = [f for f in frames if "dalembert" in f.filename] or frames
    return f"{type(error).__name__} {str(error)[:80]!r} at {Path(last[-1].filename).name}:{last[-1].lineno}"


def reports(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    at = rng.randrange(len(r.status)) if r.status else None
    yield from refusing("report", lambda: str(da.report(r)))
    yield from refusing("report at", lambda: str(da.report(r, at=at, design=True)))
    yield from refusing("report methods", lambda: str(da.report(r, at=at, methods="all")))


DRAWN = (
    *("acceleration_polygon", "velocity_polygon", "force_polygons", "force_chain", "free_bodies", "friction"),
    *(
        "instant_centers",
        "mechanism",
        "motion",
        "question",
        "superposition",
        "teeth",
        "charts",
        "view",
        "skeleton",
    ),
    *("solid_model", "animation"),
)
OF_LINKS = ("components", "displaced_inertia", "force_polygon", "free_body", "lines_of_action")


def drawings(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    at = rng.randrange(len(r.status)) if r.status else None
    for name in DRAWN:
        more = {} if name in ("charts", "animation", "solid_model") else {"at": at}
        yield from refusing(f"draw {name}", lambda n=name, k=more: drawn(getattr(da.draw, n)(r, **k)))
    for name in OF_LINKS:
        for link in r.links:
            yield from refusing(f"draw {name}", lambda n=name, k=link: drawn(getattr(da.draw, n)(r, k, at)))


def drawn(scene: Any) -> Any:
    if hasattr(scene, "svg"):
        text = scene.svg() if callable(scene.svg) else scene.svg
        if "nan" in text.lower().replace("nano", ""):
            raise AssertionError("nan in a drawing")
    return None


def machines(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    """What forces are found for."""
    asked: list[tuple[str, Callable[[], Any]]] = [
        ("shaking", lambda: da.shaking(r)),
        ("flywheel", lambda: da.flywheel(r, Cs=0.02)),
        ("bearings", lambda: da.bearings(r, hours=1000)),
        ("pins", lambda: da.pins(r)),
        ("motor", lambda: da.motor(r, inertia=1e-3)),
        ("virtual work", lambda: da.virtual_work(r)),
        ("superposition", lambda: da.superposition(r)),
        ("solution", lambda: da.solution(r)),
        ("members", lambda: da.order_of_solution(r, da.members(r))),
        ("efficiency", lambda: da.efficiency(r)),
        ("other solutions", lambda: da.other_solutions(r)),
        ("fixed point", lambda: da.fixed_point(r)),
        ("small swings", lambda: da.small_swings(r)),
        ("turning range", lambda: da.turning_range(m, count=37)),
        ("governor", lambda: da.governor(m, count=11)),
        ("mobility", lambda: da.mobility(m)),
    ]
    for link in r.links:
        asked.append((f"member forces {link}", lambda k=link: da.member_forces(r, k)))
        asked.append((f"forces on {link}", lambda k=link: da.forces_on(r, k)))
        asked.append((f"critical speeds {link}", lambda k=link: da.critical_speeds(r, k)))
        asked.append((f"gyroscopic {link}", lambda k=link: da.gyroscopic(r, k)))
        asked.append((f"balance {link}", lambda k=link: da.balance(r, [k])))
    for joint in r.joints:
        asked.append((f"circle {joint}", lambda k=joint: da.friction_circles(r, k)))
        asked.append((f"cam {joint}", lambda k=joint: da.cam(m, k, count=61)))
    for drive in r.drives:
        asked.append((f"law {drive}", lambda k=drive: da.law(m, k)))
    for what, make in asked:
        yield from refusing(what, make)
    scenes = ("shaking", "flywheel", "bearings", "motor")
    for what, make in asked:
        if what in scenes or what.startswith("cam "):
            yield from refusing(f"drawing of {what}", lambda f=make: drawn(da.draw.machine(f())))


def quantities(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    """Every quantity by its name, by a kernel, a sweep and a study."""
    names = r.keys()
    for name in names:
        yield from refusing(f"quantity {name}", lambda n=name: r[n])
    numbers = every_number(m)
    if not numbers:
        return
    vary, outputs = rng.choice(numbers), rng.sample(names, min(3, len(names)))
    nominal = float(np.ravel(da.compile(m, [vary], lanes=1).nominal)[0])
    values = [nominal, nominal * 1.01]
    try:
        swept = da.sweep(m, vary, values, outputs=outputs)
        b = da.compile(m, [vary], outputs, lanes=1)([[x] for x in values])
    except DalembertError as error:
        yield from sentence(error)
        return
    for name in outputs:
        mine, theirs = np.asarray(b[name]), np.asarray(swept[name])
        if mine.dtype.kind != "f":
            continue
        mine = mine.reshape(theirs.shape)
        size = np.nanmax(np.abs(theirs), initial=1e-4)
        if "acceleration" in name:  # beside the squares of the speeds
            size = max(size, 1e-6 * np.max(sizes(r)["angular_acceleration"], initial=0.0))
        same = np.isnan(mine) == np.isnan(theirs)
        if not same.all() or np.nanmax(np.abs(mine - theirs), initial=0) > NEAR * size:
            yield f"sweep of {vary}: {name} is not as of the kernel"
    yield from refusing("study", lambda: da.study(m, {vary: "± 1 %"}, outputs[:1], designs=40).run())


def motions(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    """Motions under forces: the energy balance, the forces of the computed motion, and a compiled motion."""

    def begun() -> Any:
        s = da.simulate(m, "0.05 s", count=11, steps=400)
        return (
            s if s.status != "stopped" else None
        )  # at a dead centre its last instant is uncertain, and said to be

    yield from refusing("simulate", begun)
    start: dict[str, Any] = {}
    for name in r.drives[:1]:
        turns = m.drives[name].turns
        start[name] = {
            "position": float(r.drive_position(name)[0]),
            "speed": "2 rad/s" if turns else "0.1 m/s",
        }
    s = da.simulate(m, "0.05 s", start=start, count=11, steps=2000)
    if s.status != "stopped":
        yield from no_nan(s.text(), "simulate")
    if s.doubt:
        return
    if not s.energy_residual < AGREES or not s.law_residual < AGREES:
        yield f"simulate: energy {s.energy_residual:.1e}, law {s.law_residual:.1e} without a doubt"
    many = da.compile_motion(m, "0.05 s", start=start, count=11, tolerance=1e-12)()
    if many.ok[0] and s.status == "ended":
        ends = np.array([s.position(name)[-1] for name in s.drives])
        if np.abs(ends - many.position[0]).max(initial=0) > NEAR * max(1e-3, np.abs(ends).max(initial=0)):
            yield f"compiled motion ends at {many.position[0]}, the simulation at {ends}"


def balanced(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    """Counterweights leave what they are said to leave, in a description that has them."""
    if r.friction is not None:
        return  # taken as it was without them, and said so
    b = da.balance(r, [rng.choice(r.links)], least=rng.choice(("rms", "max")))
    if not b.residual < AGREES:
        yield f"balance: analysed again it differs by {b.residual:.1e}"


def pages(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    yield from refusing("page", lambda: da.page(m))


def exchanged(m: da.Mechanism, r: da.Result, rng: random.Random) -> Findings:
    """Files of other programs."""
    with tempfile.TemporaryDirectory() as folder:
        for form in ("m.xml", "m.urdf", "m.adm", "m.svg", "m.glb", "m.tex", "m.py", "m.c"):
            yield from refusing(f"convert to {form}", lambda f=form: convert(m, Path(folder), f))


def convert(m: da.Mechanism, folder: Path, name: str) -> None:
    path = folder / "in.yaml"
    if not path.exists():
        m.save(path)
    da.convert(path, folder / name)


CHECKS: dict[str, Callable[[da.Mechanism, da.Result, random.Random], Findings]] = {
    f.__name__: f
    for f in (
        *(
            asked_again,
            careful,
            written,
            saved,
            backwards,
            lifted,
            kernel,
            texts,
            reports,
            drawings,
            machines,
        ),
        *(quantities, motions, balanced, pages, exchanged),
    )
}


SOME, SHARE = ("texts", "reports", "drawings", "machines", "motions", "pages", "exchanged"), 0.35
"""What takes long is asked of a share of the models."""


def attacked(number: int) -> tuple[str, str, list[str]]:
    """Name of the file, "refused" or the statuses, and what is found."""
    rng = random.Random(number)
    name, tree = changed_model(rng)
    found: list[str] = []
    try:
        with timed(SECONDS):
            m = da.mechanism(tree)
            r = run(m)
        found += honest(r)
    except LateError:
        return name, "late", ["solve: late"]
    except DalembertError as error:
        return name, "refused", list(sentence(error))
    except Exception as error:
        return name, "crashed", [f"solve: {where(error)}"]
    for what, check in CHECKS.items():
        if what in SOME and len(CHECKS) > 1 and rng.random() > SHARE:
            continue
        began = time.process_time()
        try:
            with timed(SECONDS):
                found += check(m, r, random.Random(number))
        except LateError:
            found.append(f"{what}: late ({time.process_time() - began:.0f} s)")
        except DalembertError as error:
            found += sentence(error)
        except Exception as error:
            found.append(f"{what}: {where(error)}")
    return name, " ".join(sorted(set(r.status))), found


def work(first: int, step: int, seconds: float) -> Counter[str]:
    """Numbers from ``first`` on, every step-th, until time is over."""
    warnings.simplefilter("ignore")
    met: Counter[str] = Counter()
    ends, number = time.monotonic() + seconds, first
    while time.monotonic() < ends:
        with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
            name, answer, found = attacked(number)
        met["refused" if answer == "refused" else "answered"] += 1
        for line in found:
            met["findings"] += 1
            text = f"{number} {name} [{answer}] {line}"
            print(text, flush=True)
            with (BUILD / "findings.txt").open("a", encoding="utf-8") as file:
                file.write(text + "\n")
        number += step
    met["last"] = number
    return met


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--from", type=int, default=0, dest="first")
    parser.add_argument("--at", type=int)
    parser.add_argument("--only", nargs="*", choices=CHECKS)
    options = parser.parse_args()
    for name in [n for n in CHECKS if options.only and n not in options.only]:
        del CHECKS[name]
    BUILD.mkdir(parents=True, exist_ok=True)
    if options.at is not None:
        print(json.dumps(changed_model(random.Random(options.at)), indent=1, default=str))
        print(*attacked(options.at), sep="\n")
        return 0
    starts = [(options.first + k, options.processes, options.seconds) for k in range(options.processes)]
    with multiprocessing.get_context("spawn").Pool(options.processes) as pool:
        for met in pool.starmap(work, starts):
            print(dict(met))
    return 0


if __name__ == "__main__":
    sys.exit(main())
