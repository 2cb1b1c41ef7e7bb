"""Drawings and worked solutions of bundled problems: `make gallery` writes them to build/gallery with an index page.

`python docs/gallery.py figures` writes the pictures that the documentation shows.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from html import escape
from pathlib import Path

import dalembert as da
from dalembert.bundled import cases, examples
from dalembert.cli.describe_commands import JOINT_HEADS, joint_rows
from dalembert.machine.members.member_table import member_table
from dalembert.model.joints.pairs import PAIRS
from dalembert.saving import new_file

ROOT = Path(__file__).resolve().parents[1]
OUT = ROOT / "build" / "gallery"
FIGURES = ROOT / "docs" / "figures"
VIEWS = ("mechanism", "free-bodies", "force-polygons", "motion")

PAGE = """<!DOCTYPE html><html lang="en"><meta charset="utf-8"><title>dalembert: gallery</title>
<style>body{{font:16px/1.4 sans-serif;max-width:75rem;margin:2rem auto;padding:0 1rem}}
img{{max-width:100%;max-height:24rem;margin:0 1rem 1rem 0;vertical-align:top}}</style>
<h1>Gallery</h1>{body}</html>
"""


def shown() -> dict[str, Path]:
    """The examples of the source documents, and the bundled examples."""
    seeds = {name: path for name, path in cases().items() if name.startswith("seed-")}
    return seeds | {f"example-{name}": path for name, path in examples().items()}


def built(name: str, path: Path) -> Iterator[str]:
    """Write one problem's files; yields its part of the index."""
    r = da.solve(da.load(path))
    plane = r.mechanism.dimension == 2
    yield f"<h2>{escape(name)}</h2><p>{escape(r.mechanism.title)}: "
    report = da.report(r)
    for kind in ("pdf", "html", "tex", "txt"):
        report.save(OUT / f"{name}.{kind}", overwrite=True)
        yield f'<a href="{name}.{kind}">{kind}</a> '
    da.draw.solid_model(r).save(OUT / f"{name}.glb", overwrite=True)
    yield f'<a href="{name}.glb">glb</a></p>'
    views = [*(VIEWS if plane else VIEWS[:2]), *(["charts"] if len(r.status) > 7 else [])]
    for view in views if r.drives else [v for v in views if v != "motion"]:
        da.draw.view(r, view).save(OUT / f"{name}-{view}.svg", overwrite=True)
        yield f'<img src="{name}-{view}.svg" alt="{view}">'


def gallery() -> None:
    """All of them, and the index."""
    OUT.mkdir(parents=True, exist_ok=True)
    parts = []
    for name, path in shown().items():
        try:
            parts += list(built(name, path))
            print(f"{name}: written")
        except da.ModelError as error:
            print(f"{name}: {error}")
    parts.append("<h2>Joints in space</h2>")
    for kind in PAIRS:
        da.draw.joint(kind).save(OUT / f"joint-{kind}.svg", overwrite=True)
        parts.append(f'<img src="joint-{kind}.svg" alt="{kind}">')
    with new_file(OUT / "index.html", overwrite=True) as temporary:
        temporary.write_text(PAGE.format(body="".join(parts)), encoding="utf-8")
    print(f"{OUT / 'index.html'}")


JOINTS = """# Joints in space

Freedoms of link j relative to link i for each joint, and the reactions it carries along its local axes.
`dalembert joints` prints this table, `dalembert joints -o pictures` draws it. The part on i is blue, the part on j
yellow; forces have one head, moments two.
[Space](space.md) says how the axes are given and which freedoms can be driven.

| {heads} |
| {rule} |
{rows}

A screw slides with its turn.

![All joints in space with their reactions](figures/joints.svg)
"""


def joints_page() -> str:
    """The page of the joints in space, from the table that the program computes with."""
    rows = ["| " + " | ".join([f"`{kind}`", *rest]) + " |" for kind, *rest in joint_rows()]
    return JOINTS.format(
        heads=" | ".join(JOINT_HEADS), rule=" | ".join(["---"] * len(JOINT_HEADS)), rows="\n".join(rows)
    )


def space_figures() -> None:
    """The page of the joints in space, and pictures of a mechanism."""
    (FIGURES.parent / "joints.md").write_text(joints_page(), encoding="utf-8")
    da.draw.joints().save(FIGURES / "joints.svg", overwrite=True)
    r = da.dynamics(da.load(examples()["rssr"]), positions=36)
    both = [da.draw.mechanism(r, at=4, forces=True), da.draw.free_body(r, r.links[-1], at=4)]
    da.draw.beside(both, title=r.mechanism.title).save(FIGURES / "space.svg", overwrite=True)


def figures() -> None:
    """The pictures of the documentation."""
    FIGURES.mkdir(parents=True, exist_ok=True)
    r = da.dynamics(da.load(examples()["four_bar"]))
    both = da.draw.beside([da.draw.mechanism(r), da.draw.force_chain(r)], title="Four-bar linkage: forces")
    both.save(FIGURES / "four_bar.svg", overwrite=True)
    slider = da.statics(da.load(cases()["seed-002-5-slider-crank-force-on-rod"]))
    da.draw.free_bodies(slider).save(FIGURES / "free_bodies.svg", overwrite=True)
    da.draw.lines_of_action(slider, "rod").save(FIGURES / "lines_of_action.svg", overwrite=True)
    da.draw.motion(r).save(FIGURES / "motion.svg", overwrite=True)
    rubbing = da.statics(da.load(cases()["seed-002-7g-engine-guide-100-mm"]))
    da.draw.mechanism(rubbing).save(FIGURES / "friction.svg", overwrite=True)
    force_systems()
    space_figures()
    machine_figures()


def machine_figures() -> None:
    """The pictures of the worked machines; the four-bar and the crane stand on their page."""
    page = (FIGURES.parent / "machine-examples.md").read_text(encoding="utf-8")
    bar = da.loads(
        "\n".join(line[4:] for line in page.partition('loads("""\n')[2].partition('\n... """')[0].split("\n"))
    )
    crane = da.dynamics(da.loads(page.partition("```yaml\n")[2].partition("```")[0]))
    engine = da.dynamics(da.in_line_engine(cylinders=4))
    run_up = da.simulate(da.load(FIGURES.parent / "press.yaml"), "8 s", tolerance=1e-9, count=801)
    drawn = {
        "press": run_up.drawings(),
        "engine": [*da.shaking(engine).drawings()[1:], *da.flywheel(engine, Cs=0.01).drawings()[:2]],
        "balance": da.balance(bar, ["crank", "rocker"]).drawings(),
        "crane": [da.draw.mechanism(crane, at=1), *member_table(crane, ["boom"]).drawings()[4:6]],
    }
    for name, scenes in (drawn | part_figures()).items():
        da.draw.beside(scenes).save(FIGURES / f"machine_{name}.svg", overwrite=True)


def part_figures() -> dict[str, list[da.draw.Scene]]:
    """A picture for each part of the page on the machine, of its own example."""
    engine = da.load(examples()["engine"])
    linkage = da.four_bar(ground=0.4, crank=0.1, coupler=0.35, rocker=0.3)
    bounds = {"crank": {"radius": 0.06, "mass": 0.5}, "rocker": {"mass": 1.0}}
    bar = da.load(examples()["four_bar"]).with_values({"links.coupler.section": {"circle": "30 mm"}})
    pin = {"rating": "60 kN", "diameter": "40 mm", "length": "25 mm"}
    journal = engine.with_values({"joints.A.bearing": pin})
    slider = da.slider_crank(crank=0.05, rod=0.2).with_values({"drives.O2.acceleration": 50.0})
    parts: dict[str, tuple[list[da.draw.Scene], tuple[int, ...]]] = {
        "shaking": (da.shaking(da.dynamics(engine), about="O2").drawings(), (2, 3)),
        "counterweights": (da.balance(linkage, bounds, least="max", of="force").drawings(), (0, 3)),
        "flywheel": (da.flywheel(da.dynamics(engine, positions=144), Cs=0.02).drawings(), (0, 1)),
        "hammer": (da.simulate(da.load(FIGURES.parent / "drop-hammer.yaml"), "2 s").drawings(), (0,)),
        "members": (member_table(da.dynamics(bar), ["coupler"]).drawings(), (2, 5)),
        "bearings": (da.bearings(da.dynamics(journal), hours=2000).drawings(), (2, 8)),
        "motor": (da.motor(da.dynamics(slider), inertia=1e-4).drawings(), (0, 4)),
    }
    return {name: [scenes[k] for k in chosen] for name, (scenes, chosen) in parts.items()}


def force_systems() -> None:
    """The pictures of the page on force systems."""
    w = da.wrench
    forces = [
        w.Force([40, 0], at=[-7, 0]),
        w.Force([0, 50], at=[-5, 4]),
        w.Force("60 @ 135", at=[-7, 4]),
        w.Force("80 @ 30", at=[0, 0]),
    ]
    plate = w.System(*forces, w.Couple(140), title="A plate with four forces and a couple")
    da.draw.force_system(plate).save(FIGURES / "force_system.svg", overwrite=True)
    box = w.System(
        w.Force.along("20 kN", [0, 0, 0], [8, 4, 4]),
        w.Force.along("10 kN", [8, 0, 0], [8, 4, 0]),
        w.Force([0, 0, "30 kN"], at=[0, 4, 0]),
        title="Forces on the edges of a box",
        units={"force": "kN"},
    )
    da.draw.force_system(box, at=[0, 0, 0]).save(FIGURES / "wrench.svg", overwrite=True)


if __name__ == "__main__":
    figures() if sys.argv[1:] == ["figures"] else gallery()
