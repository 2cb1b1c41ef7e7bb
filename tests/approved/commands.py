"""What commands print: standard output, standard error and exit status, each on files of its own folder."""

from __future__ import annotations

import io
import os
import re
import tempfile
from collections.abc import Callable
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path
from unittest import mock

from dalembert.bundled import cases, examples
from dalembert.cli import main
from tests.approved.foreign_files import rounded

BROKEN = """links:
  ground: {points: {A: [0, 0], D: [1 m, 0]}}
  crank: {points: {A: [0, 0], B: [0.3 m, 0]}}
  rod: {points: {B: [0, 0], C: [0.1 m, 0]}, mass: 2 kg, center: [0, 0]}
  lever: {points: {D: [0, 0], C: [0.1 m, 0]}}
joints:
  A: {type: pin, links: [ground, crank]}
  B: {type: pin, links: [crank, rod]}
  C: {type: pin, links: [rod, lever]}
  D: {type: pin, links: [ground, lever]}
drives: {A: {position: 60 deg, speed: 2 rad/s}}
"""
HALF = BROKEN.replace("C: [0.1 m, 0]", "C: [0.6 m, 0]").replace(
    "position: 60 deg", "position: [60 deg, 180 deg]"
)
"""It closes at the first of two positions."""
SHELL = {
    "machines": (
        "cam cam_and_follower.yaml",
        "cam cam_and_follower.yaml --outline cam.csv --tolerance 10um --cutter 5mm",
        "cam cam_and_follower.yaml --outline cam.csv",
        "cam cam_and_follower.yaml --outline x.csv --tolerance 1kg",
        "cam cam_and_follower.yaml --outline x.csv --tolerance 0mm",
        "cam cam_and_follower.yaml --joint F --figures 3",
        "cam four_bar.yaml",
        "shake broken.yaml",
        "shake four_bar.yaml --positions 4",
        "pins four_bar.yaml",
        "shaft four_bar.yaml --static",
        "simulate pendulum.yaml --until 0.2s --count 3 --curves reaction.A.x",
        "simulate pendulum.yaml --until 0.2s --curves reaction.Q",
        "balance four_bar.yaml --on crank:disc=7800kg/m^3/20mm --positions 12",
        "balance four_bar.yaml --on crank:moment=0.1kg*m --of force=1,torque=x --positions 12",
        "balance four_bar.yaml --on crank:moment=0.1kg*m --positions 12",
        "balance four_bar.yaml --on crank:disc=7800kg/m^3/20mm/80mm --of force=1,torque=0.5 --positions 12",
    ),
    "documents": (
        "draw four_bar.yaml --view skeleton -o x.svg",
        "draw four_bar.yaml --view skeleton -o x.dxf",
        "draw rssr.yaml -o x.svg --camera up",
        "draw rssr.yaml -o x.svg --camera 30,up",
        "draw rssr.yaml -o x.svg --camera 30,20",
        "draw rssr.yaml -o x.svg",
        "page four_bar.yaml -o x.txt",
        "page broken.yaml -o x.html",
        "solve four_bar.yaml --at 60deg",
        "solve four_bar.yaml --set links.crank.weight=2 --set links.crank.weight=3",
        "solve four_bar.yaml --set links.crank.weight=2lbf --no-friction --units si",
        "solve broken.yaml",
        "solve missing.yaml",
        "solve four_bar.yaml --method superposition",
        "solve four_bar.yaml --method virtual-work",
        "check empty",
        "check four_bar.yaml",
        "check rssr.yaml",
        "draw broken.yaml -o b.svg",
        "report half.yaml -o h.txt --at 1",
        "draw half.yaml -o h.svg --at 1",
        "draw gear_train.yaml -o g.svg",
        "check four_bar.yaml rssr.yaml --all",
        "check-answers four_bar.yaml",
        "grade --key key.csv answers.csv --columns nothing",
        "variants four_bar.yaml --vary loads.T_4.value=100..140 -o exam --count 2 --seed 1 --marks effort",
        "variants four_bar.yaml --vary loads.T_4.value=100..140 -o exam --count 2 --seed 1 --marks effort=4",
        "nothing four_bar.yaml",
        "study nothing",
        "study extend store --designs many",
    ),
}
"""Commands by the text that keeps them."""
STATUS = {0: "0, done", 1: "1: no answer, or some are missing", 2: "2: wrong input"}
"""In words, as a number that differs by one counts as rounding."""
DONE = re.compile(r": \d[\d,]* of \d")
"""How far something is, which only what takes long says."""


def told(commands: tuple[str, ...]) -> Callable[[], str]:
    def printed() -> str:
        out = []
        with (
            tempfile.TemporaryDirectory() as folder,
            chdir(folder),
            mock.patch.dict(os.environ, COLUMNS="80"),
        ):
            files = {**cases(), **examples()}
            for name in ("four_bar", "rssr", "cam_and_follower", "gear_train"):
                Path(f"{name}.yaml").write_text(files[name].read_text(encoding="utf-8"), encoding="utf-8")
            Path("broken.yaml").write_text(BROKEN, encoding="utf-8")
            Path("half.yaml").write_text(HALF, encoding="utf-8")
            Path("pendulum.yaml").write_text(PENDULUM, encoding="utf-8")
            Path("empty").mkdir()
            for command in commands:
                streams = io.StringIO(), io.StringIO()
                with redirect_stdout(streams[0]), redirect_stderr(streams[1]):
                    status = main(command.split())
                out += [f"$ dalembert {command}", streams[0].getvalue().rstrip()]
                out += [f"! {line}" for line in streams[1].getvalue().splitlines() if not DONE.search(line)]
                out += [f"= {STATUS[status]}", ""]
        return rounded("\n".join(out)) + "\n"

    return printed


PENDULUM = """links:
  ground: {points: {A: [0, 0]}}
  bob: {points: {A: [0, 0]}, mass: 2 kg, center: [0.5 m, 0], inertia: 0.1 kg*m^2}
joints: {A: {type: pin, links: [ground, bob]}}
drives: {A: {position: unknown, effort: 0}}
gravity: [0, -9.81 m/s^2]
start: {A: {position: 30 deg, speed: 0}}
"""
COMMANDS = {f"commands-{name}": told(commands) for name, commands in SHELL.items()}
