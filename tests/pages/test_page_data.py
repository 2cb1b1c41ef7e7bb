"""The numbers of a page are those of the analyses, through its own WebAssembly and nothing else."""

from __future__ import annotations

import base64
import json
import re
import zlib
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.analysis.batch.batch_result import SOLVED
from dalembert.analysis.batch.kernel_export import WasmModule
from dalembert.analysis.methods.applied_forces import full_actions
from dalembert.bundled import cases, examples
from dalembert.model.library import TEMPLATES, template, template_text
from dalembert.pages.html_page import html_text
from dalembert.pages.page_data import page_data
from dalembert.pages.sweep import with_cycle
from dalembert.views.formats.themes import THEMES
from tests.kernel.wasm_runs import run_wasm
from tests.tiers import sampled

FILES = {**cases(), **examples()}
PLANE = sorted(name for name, path in FILES.items() if "space: space" not in path.read_text(encoding="utf-8"))
QUICK = ["four_bar", "fr-01-pulley-on-a-fixed-shaft", "scissor_lift"]
REFUSED = {
    *(
        "balance_position",
        "vw-02-drum-with-spring-and-weight",
        "gov-11-watt-governor",
    ),  # their positions are asked for
    *("brk-1-simple-band-brake", "gov-12-porter-governor-with-friction"),  # a load that only friction settles
}
"""What no page can show, with a sentence that says so."""


def series(given: Any, count: int) -> Any:
    if isinstance(given, dict):
        return np.linspace(given["from"], given["to"], given["count"])
    return np.frombuffer(base64.b64decode(given), "<f8")


def run_page(data: Any) -> Any:
    """Rows (output, position), the marks last, of the page's own numbers and channels."""
    k = data["kernel"]
    code = zlib.decompress(base64.b64decode(k["wasm"]))
    module = WasmModule(code, k["heap"], k["row"], (), tuple(k["channels"]), ("",) * k["outputs"])
    there = {c["name"]: series(c["values"], k["count"]) for c in data["channels"]}
    path = [np.pad(there[name], (0, k["row"] - k["count"]), mode="edge") for name in k["channels"]]
    values = [n["value"] for n in data["numbers"]]
    return run_wasm(module, values, np.array(path))[:, : k["count"]]


@pytest.mark.parametrize("name", sampled(QUICK, set(PLANE) - REFUSED))
def test_every_number_is_that_of_the_analyses(name: str) -> None:
    agrees(da.load(FILES[name]))


def agrees(m: da.Mechanism) -> None:
    """Every force of a page is that of the analysis, at its place."""
    data = json.loads(json.dumps(page_data(m)))
    assert len(html_text(data)) < 220_000
    out = run_page(data)
    swept = with_cycle(m)
    r = da.dynamics(swept) if m.has_speeds else da.statics(swept)
    r = r if r.after is None else r.after  # at a reversal the program by itself has the numbers just after
    right = r.ok & np.isin(out[-1], SOLVED)
    there = {(a.of, a.kind, a.link): [] for a in full_actions(r)}
    for a in full_actions(r):
        there[a.of, a.kind, a.link].append(a)
    sizes = [
        np.abs(x[right]).max(initial=0) for some in there.values() for a in some for x in (a.force, a.couple)
    ]
    largest = max(sizes, default=0)
    reach = max(np.abs(r.point_array[right]).max(initial=0.0), 1e-3)
    seen = 0
    for arrow in data["views"]["mechanism"]["arrows"]:
        some = there[arrow["of"], arrow["kind"], arrow["link"]]
        rows = arrow["f"] if arrow["t"] == "force" else arrow["m"]
        found = out[rows][:, right]
        values = [a.force.T if arrow["t"] == "force" else a.couple[None] for a in some]
        off = min(np.abs(v[:, right] - found).max(initial=0.0) for v in values)
        assert off <= 1e-9 * max(largest, largest * reach, 1e-9)
        arms = [out[arrow["p"]][:, right] - a.at.T[:, right] for a in some]
        if (
            min(np.abs(arm).max(initial=0.0) for arm in arms) > 1e-9 * reach
        ):  # a pin's, on its friction circle
            (a,), ((x, y),) = some, arms
            assert (arrow["kind"], arrow["t"]) == ("joint", "force")
            turning = x * found[1] - y * found[0]
            assert turning == pytest.approx(a.couple[right], rel=1e-9, abs=1e-9 * largest * reach)
        seen += 1
    for chart in data["views"]["charts"]:
        for curve in chart["curves"]:
            kind, of, *_ = curve["of"].split(".")
            exact = {
                "effort": lambda of=of: r.effort(of),
                "load": lambda of=of: r.unknown_load(of),
                "reaction": lambda of=of: np.hypot(*r.reaction(of).T),
            }[kind]()
            assert out[curve["row"]][right] == pytest.approx(
                exact[right], rel=1e-9, abs=1e-9 * max(largest, 1e-6)
            )
    assert seen or not largest
    assert set(out[-1][[s == "ok" for s in r.status]]) <= {0.0, 2.0}


@pytest.mark.parametrize("name", sampled(["slider_crank"], TEMPLATES))
def test_a_file_from_a_template_is_a_page_with_handles(name: str) -> None:
    """Parameters that say where a drive stands are no sliders, and keep no other from being one."""
    m = da.loads(template_text(name))
    data = page_data(m)
    assert data["handles"] or name in ("bevel_differential", "worm_gear")  # whose wheels keep their places
    assert "mass_per_length" in {n["path"] for n in data["numbers"]} or "mass_per_length" not in m.parameters
    assert not {n["path"] for n in data["numbers"]} & {"sweep_start", "sweep_end"}


def test_equations_of_a_free_body_add_up() -> None:
    data = page_data(da.load(FILES["four_bar"]))
    out = run_page(data)
    for body in data["views"]["bodies"]:
        terms = body["equations"]["terms"]
        for rows in ([t["f"][0] for t in terms], [t["f"][1] for t in terms], [t["m"][0] for t in terms]):
            assert np.abs(out[rows].sum(axis=0)).max() < 1e-11 * np.abs(out[rows]).max()


SPACE = sorted(set(FILES) - set(PLANE))


@pytest.mark.parametrize("name", sampled(["rssr"], SPACE))
def test_in_space_too(name: str) -> None:
    """Curves are those of the analysis, and what acts on each link adds up to nothing in six equations."""
    m = da.load(FILES[name])
    data = json.loads(json.dumps(page_data(m)))
    out, swept = run_page(data), with_cycle(m)
    r = da.dynamics(swept) if m.has_speeds else da.statics(swept)
    right = r.ok & np.isin(out[-1], SOLVED)
    assert right.any()
    largest = max(np.abs(r.force_array[right]).max(initial=0), 1e-9)
    for curve in (c for chart in data["views"]["charts"] for c in chart["curves"]):
        kind, of, *_ = curve["of"].split(".")
        exact = r.effort(of) if kind == "effort" else np.linalg.norm(r.reaction(of), axis=-1)
        assert out[curve["row"]][right] == pytest.approx(exact[right], rel=1e-8, abs=1e-8 * largest)
    for body in data["views"]["bodies"]:
        terms = body["equations"]["terms"]
        for k in range(3):
            for rows in ([t["f"][k] for t in terms], [t["m"][k] for t in terms]):
                some = out[rows][:, right]
                assert np.abs(some.sum(axis=0)).max() < 1e-9 * max(np.abs(some).max(initial=0), largest)


def axis_and_angle(rotation: Any) -> list[float]:
    r = np.reshape(rotation, (3, 3))
    axis = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    size = np.hypot(*axis[:2]) if not axis[2] else np.linalg.norm(axis)
    return [*(axis / size if size else (0.0, 0.0, 1.0)), float(np.arctan2(size, np.trace(r) - 1))]


def assembly_numbers(sketch: Any) -> Iterator[float]:
    pose = sketch["pose"]
    for k in range(len(sketch["links"])):
        if sketch["dimension"] == 2:
            yield pose["turn"][k]
        else:
            yield from pose["point"][3 * k : 3 * k + 3]
            yield from axis_and_angle(pose["rotation"][9 * k : 9 * k + 9])


def saved_text(data: Any, changed: bool = True) -> str:
    """The file that the page saves, of its own numbers and its own first pose, as if all of them had changed."""
    values = [*(n["value"] for n in data["numbers"]), *assembly_numbers(data["sketch"])]

    def said(part: Any) -> str:
        if isinstance(part, str):
            return part
        if "was" in part and not changed:
            return str(part["was"])
        return "".join(x if isinstance(x, str) else repr(values[x[0]] / x[1]) for x in part["now"])

    return "".join(map(said, data["template"]))


def turned(arc: Any, ccw: bool) -> float:
    """Angle by which an arc turns: its centre, its start, its end."""
    start, end = (complex(*(p - arc[0])) for p in arc[1:])
    return float(np.angle(end / start) % (2 * np.pi) if ccw else np.angle(start / end) % (2 * np.pi))


@pytest.mark.parametrize(("name", "crossed"), [("belt_drive", False), ("belt_drive", True), ("hoist", False)])
def test_strands_touch_their_wheels_wherever_the_machine_stands(name: str, crossed: bool) -> None:
    """Each end at its wheel's radius and across it; moved with the ground, all that is drawn of them is moved."""
    drawn = []
    for away in ((0.0, 0.0), (0.7, -0.4)):
        tree: Any = template(name).to_tree()
        for point, at in tree["links"]["ground"]["points"].items():
            tree["links"]["ground"]["points"][point] = [
                float(str(x).removesuffix(" m")) + d for x, d in zip(at, away, strict=True)
            ]
        for link, pose in tree.get("assembly", {}).items():
            if isinstance(pose, list):
                near = [float(str(x).removesuffix(" m")) + d for x, d in zip(pose[:2], away, strict=True)]
                tree["assembly"][link] = [*near, pose[2]]
        if crossed:
            tree["joints"]["belt"]["crossed"] = True
        data = page_data(with_cycle(da.mechanism(tree)))
        rows = run_page(data)
        items = [x for x in data["views"]["mechanism"]["items"] if x["t"] in ("path", "arc") and "of" in x]
        drawn.append([np.array([rows[p][:, 0] for p in item["p"]]) - away for item in items])
    kinds = [item["t"] for item in items]
    assert len(kinds) == {"belt_drive": 4, "hoist": 5}[name]
    for one, other in zip(*drawn, strict=True):
        assert other == pytest.approx(one, abs=1e-9)
    if name == "belt_drive":
        swept = [
            turned(points, item["ccw"]) for points, item in zip(drawn[0], items, strict=True) if "ccw" in item
        ]
        assert swept == pytest.approx(da.solve(da.mechanism(tree)).belt("belt").wrap.tolist())
        ends = [p[1:] for p, kind in zip(drawn[0], kinds, strict=True) if kind == "arc"]
        strands = [p for p, kind in zip(drawn[0], kinds, strict=True) if kind == "path"]
        assert np.array(ends)[[0, 0, 1, 1], [0, 1, 1, 0]] == pytest.approx(
            np.array(strands)[[0, 1, 0, 1], [0, 0, 1, 1]]
        )
    wheels = {"belt_drive": [(0, 0, 0.06), (0.5, 0, 0.18)], "hoist": [(0, 0, 0.12), (0.8, 0, 0.06)]}[name]
    for points in (p for p, kind in zip(drawn[0], kinds, strict=True) if kind == "path"):
        along = (points[1] - points[0]) / np.hypot(*(points[1] - points[0]))
        for (x, y, radius), end in (
            zip(wheels, points, strict=True) if name != "hoist" or points[0][1] > 0.1 else ()
        ):
            out = end - (x, y)
            assert np.hypot(*out) == pytest.approx(radius)
            assert out @ along == pytest.approx(0, abs=1e-9)


SCREW = """
links: {ground: {points: {O: [0, 0]}}, nut: {points: {N: [0, 0]}}}
joints: {S: {type: slider, links: [ground, nut], at: [O, N], direction: 30}}
drives: {S: {position: [0 mm, 100 mm], screw: {lead: 8 mm, radius: 15 mm, friction: {coefficient: 0.08}}}}
"""
PARALLEL = """
links: {ground: {points: {O: [0, 0]}}, wheel: {points: {O: [0, 0]}, mass: 1},
  one: {points: {A: [0, 0]}, mass: 8}, two: {points: {B: [0, 0]}, mass: 5}}
joints:
  O: {type: pin, links: [ground, wheel]}
  a: {type: slider, links: [ground, one], at: [O, A], direction: -90}
  b: {type: slider, links: [ground, two], at: [O, B], direction: -90}
  rope: {type: rope, parallel: true, through: [one.A, {round: wheel.O, radius: 0.12, friction: 0.15}, two.B]}
drives: {a: {position: [0.5 m, 0.7 m]}}
"""


def test_a_screw_lies_behind_its_nut_wherever_this_is() -> None:
    data = page_data(da.loads(SCREW))
    rows, items = run_page(data), [i for i in data["views"]["mechanism"]["items"] if i["t"] == "symbol"]
    (end,) = [rows[i["p"]].T for i in items if not i["svg"]]
    (thread,) = [i for i in items if "per_mm" in i]
    nut = rows[thread["p"]].T
    long = float(re.findall(r"M-([\d.]+) ", thread["svg"])[0]) * thread["per_mm"]
    direction = np.array([3**0.5 / 2, 0.5])
    assert nut == pytest.approx(np.outer([0, 0.1], direction))
    assert end == pytest.approx(np.outer([0 - long, 0.1 - long], direction))


def test_parallel_strands_leave_the_wheel_on_the_side_on_which_the_rope_passes() -> None:
    """Up to the wheel on its left, down on its right."""
    data = page_data(da.loads(PARALLEL))
    rows = run_page(data)
    paths = [x for x in data["views"]["mechanism"]["items"] if x["t"] == "path" and "rope" in x["of"][1]]
    up, down = (np.array([rows[p] for p in item["p"]]) for item in paths)
    assert up == pytest.approx(np.array([[[0, 0], [-0.5, -0.7]], [[-0.12, -0.12], [0, 0]]]), abs=1e-12)
    assert down == pytest.approx(np.array([[[0.12, 0.12], [0, 0]], [[0, 0], [0, 0.2]]]), abs=1e-12)


@pytest.mark.long
def test_saved_text_is_the_mechanism() -> None:
    for name in ("four_bar", "engine", "quick_return", "rssr"):
        m = da.load(FILES[name])
        again, swept = da.loads(saved_text(page_data(m))), with_cycle(m)
        a, b = (da.dynamics(x) if m.has_speeds else da.statics(x) for x in (swept, again))
        assert a.effort_array == pytest.approx(b.effort_array, rel=1e-9)


def test_a_gradient_is_that_of_the_kernel() -> None:
    m = with_cycle(da.load(FILES["four_bar"]))
    data = page_data(m)
    g, path = data["gradient"], [n["path"] for n in data["numbers"]]
    code = zlib.decompress(base64.b64decode(g["wasm"]))
    module = WasmModule(code, g["heap"], 2, (), tuple(g["channels"]), ("",) * g["outputs"])
    at = 5
    there = {c["name"]: series(c["values"], data["kernel"]["count"])[at] for c in data["channels"]}
    values = [n["value"] for n in data["numbers"]]
    out = run_wasm(module, values, np.array([[there[n]] * 2 for n in g["channels"]]))[:-1, 0]
    varied = [path[n].rsplit(".", 1)[0] for n in g["numbers"][::2]]
    k = da.compile(m, vary=varied, outputs=["effort.O2"], derivatives=True, lanes=1)
    assert out[: len(g["numbers"])] == pytest.approx(k().gradient("effort.O2")[0, at], rel=1e-9)


PARAMETRIC = """
title: Slider-crank by parameters
parameters: {r: {value: 45 mm, about: crank, range: [20 mm, 60 mm]}, l: 3*r, m1: 2 kg}
links:
  ground: {points: {O: [0, 0], C: [0, 0]}}
  crank: {points: {O: [0, 0], A: [r, 0]}, mass: m1}
  rod: {points: {A: [0, 0], B: [l, 0]}, mass: 1 kg, center: [0.5*l, 0]}
  piston: {points: {B: [0, 0]}, mass: 1 kg}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, piston]}
  C: {type: slider, links: [ground, piston], at: [C, B]}
drives:
  O: {position: {from: 0, to: 360, count: 36}, speed: 10 rad/s}
"""


def test_parameters_come_first_and_set_what_follows_from_them() -> None:
    data = page_data(da.loads(PARAMETRIC))
    r, m1 = data["numbers"][:2]
    assert (r["path"], r["unit"], r["size"], r["range"]) == ("r", "mm", pytest.approx(1e-3), [0.02, 0.06])
    assert m1["path"] == "m1"
    assert not {n["path"] for n in data["numbers"]} & {"links.crank.points.A.0", "links.crank.mass"}
    assert next(h for h in data["handles"] if h["name"] == "A")["by"] == [0]
    r["value"] = 0.05
    effort = run_page(data)[data["views"]["charts"][0]["curves"][0]["row"]]
    exact = da.dynamics(da.loads(PARAMETRIC).with_values({"r": 0.05})).effort("O")
    assert effort == pytest.approx(exact, rel=1e-9, abs=1e-9 * np.abs(exact).max())
    assert da.loads(saved_text(data)).parameters["l"].value == pytest.approx(0.15)


def test_a_page_knows_what_is_counted() -> None:
    """As the model does: where an integer is wanted of a parameter, and in its words."""
    faces = page_data(da.loads(template_text("plate_clutch")))
    sentence = faces["reading"]["sentences"]["count"]
    assert {"counts": "faces", "sign": "positive"}.items() <= next(
        x for x in faces["limits"] if x["path"] == "joints.plates.faces"
    ).items()
    with pytest.raises(da.ModelError) as refused:
        da.loads(template_text("plate_clutch")).with_values({"faces": 2.5})
    assert str(refused.value) == "joints.plates: faces: " + sentence.replace("{what}", "faces")


def roles(tree: Any) -> set[str]:
    """Roles of everything that a page draws."""
    if isinstance(tree, dict):
        return roles(list(tree.values())) | ({tree["role"]} if "role" in tree else set())
    return set().union(*map(roles, tree)) if isinstance(tree, list) else set()


@pytest.mark.parametrize("name", ["seed-002-7a-engine-friction-circles", "rssr"])
def test_every_role_that_is_drawn_has_its_style(name: str) -> None:
    data = page_data(da.load(FILES[name]))
    drawn = roles(json.loads(json.dumps(data["views"]))) & THEMES["light"].keys()
    assert ("friction-circle" in drawn) == (name != "rssr")
    for theme in ("light", "dark"):
        assert {role for role in drawn if f".l-{role}{{" not in data["style"][theme]} == set()


BOUNDED = ["four_bar", "seed-002-7a-engine-friction-circles", "toggle_press", "rssr"]


@pytest.mark.parametrize("name", sampled(BOUNDED, set(FILES) - REFUSED))
def test_a_page_bounds_what_the_model_bounds(name: str) -> None:
    """The sign that a page demands of a number is the one without which the model refuses it, and in its words."""
    m = with_cycle(da.load(FILES[name]))
    data = page_data(m)
    plain = [
        n for n in data["numbers"] if "parameter" not in n
    ]  # what follows from others has rows of its own
    for number in plain:
        sign = number.get("sign", "")
        for value, refused in ((-1.0, bool(sign)), (0.0, sign == "positive")):
            said = ""
            try:
                m.with_values({number["path"]: value})
            except da.ModelError as error:
                said = str(error)
            wanted = data["reading"]["signs"][sign].replace("{text}", repr(value)) if refused else ""
            assert wanted in said
            assert refused or not any(word in said for word in ("is negative", "is not positive"))


@pytest.mark.parametrize(
    ("name", "ends", "answered"),
    [
        ("truss", ["ground.A", "AD.A"], False),
        ("seed-001-cc-collar-150-mm", ["ground.O", "collar.B"], True),
    ],
)
def test_a_spring_that_never_changes_its_length_has_a_page(
    name: str, ends: list[str], answered: bool
) -> None:
    """Between points that coincide a force has no direction once the free length is changed, which a page allows: it
    answers nothing. Of a collar no test decides how far it slides."""
    tree = da.load({**cases(), **examples()}[name]).to_tree()
    tree.setdefault("loads", {})["extra"] = {"type": "spring", "between": ends, "stiffness": 1000}
    m = da.mechanism(tree)
    assert da.statics(m).ok.all()
    marks = run_page(json.loads(json.dumps(page_data(m))))[-1]
    assert np.isin(marks, SOLVED).all() == answered
    if answered:
        agrees(m)
