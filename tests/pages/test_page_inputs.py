"""What a page may change and where it begins: cycles, handles, limits of rounding, labels, where it may stop."""

from __future__ import annotations

import base64
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import dalembert as da
from dalembert.pages.inputs import label, series
from dalembert.pages.mechanism_items import Items
from dalembert.pages.page_data import page_data
from dalembert.pages.sketch_data import _counted
from dalembert.pages.sweep import with_cycle
from dalembert.views.paper.canvas import Canvas
from dalembert.views.paper.frame import PaperFrame
from dalembert.views.plane.joint_drawings import draw_joint
from tests.pages.test_page_data import FILES, run_page
from tests.tiers import tiers


def positions(m: Any) -> Any:
    drive = next(iter(m.drives.values()))
    return np.atleast_1d(m.schedule().position[:, 0]), drive


@pytest.mark.parametrize("start", [0.3, -1.0, 2.5])
def test_a_crank_goes_a_turn_from_the_position_of_the_file(start: float) -> None:
    m = da.four_bar().with_values({"drives.O2.position": start})
    found, _ = positions(with_cycle(m))
    np.testing.assert_allclose(found, start + np.arange(72) * np.pi / 36)


@pytest.mark.parametrize("start", [-1.05, 0.0, 1.05])
def test_a_rocker_goes_as_far_as_it_closes(start: float) -> None:
    """Both ways from the file's position in steps of 5 degrees, which is one of them: not a step less or more."""
    m = da.four_bar(ground=0.3, crank=0.2, coupler=0.15, rocker=0.12, sweep=(-0.5, 0.5))
    m = m.with_values({"drives.O2.position": start})
    found, _ = positions(with_cycle(m))
    step = np.pi / 36
    np.testing.assert_allclose(np.diff(found), step)
    assert np.abs(found - start).min() < 1e-12
    beyond = (*found, found[0] - step, found[-1] + step)
    status = [da.dynamics(m.with_values({"drives.O2.position": float(q)})).status[0] for q in beyond]
    assert [s == "not_assembled" for s in status] == [False] * len(found) + [True, True]


def test_a_slide_goes_a_quarter_of_the_longest_arm_to_both_sides() -> None:
    text = """
links:
  ground: {points: {O: [0, 0], A: [3, 4]}}
  block: {points: {O: [0, 0]}, mass: 1}
joints: {O: {type: slider, links: [ground, block]}}
drives: {O: {position: 0.2, speed: 1}}
"""
    found, _ = positions(with_cycle(da.loads(text)))
    np.testing.assert_allclose(found, 0.2 + np.linspace(-1.25, 1.25, 41))


def test_what_has_positions_of_its_own_keeps_them() -> None:
    for m in (da.four_bar(), da.load(FILES["truss"]), da.five_bar()):
        assert with_cycle(m) is m


@pytest.mark.parametrize("name", tiers(["four_bar", "rssr"], ["engine", "scissor_lift"]))
def test_a_handle_is_drawn_where_its_numbers_say(name: str) -> None:
    """Origin of the link plus numbers along its axes: the handle's place, at every position, of each of its ends."""
    m = da.load(FILES[name])
    data = page_data(m)
    out = run_page(data)
    size = max(np.abs(out[h["p"]]).max() for h in data["handles"])
    value = [n["value"] for n in data["numbers"]]
    seen = set()
    for handle in data["handles"]:
        seen.add(handle["kind"])
        for end in handle.get("ends", ()):
            along = sum(value[n] * out[axis] for n, axis in zip(end["n"], end["axes"], strict=True))
            assert np.abs(out[end["at"]] + along - out[handle["p"]]).max() < 1e-9 * size, handle["name"]
        axes = [out[axis] for axis in handle.get("axes", ())]
        if handle["kind"] == "direction":
            angle = value[handle["direction"]]
            turned = np.cos(angle) * axes[0] + np.sin(angle) * axes[1]
            np.testing.assert_allclose(turned, out[handle["along"]], atol=1e-12)
            fixed = m.joint_points(handle["name"])[0]
            if m.joints[handle["name"]].links[0] == "ground":
                np.testing.assert_allclose(out[handle["p"]].T, np.tile(fixed, (out.shape[1], 1)), atol=1e-12)
        if "size" in handle and "direction" in handle:
            angle = value[handle["direction"]]
            force = value[handle["size"]] * (np.cos(angle) * axes[0] + np.sin(angle) * axes[1])
            np.testing.assert_allclose(force, out[handle["f"]], rtol=1e-9, atol=1e-9)
        if "components" in handle:
            force = sum(value[n] * axis for n, axis in zip(handle["components"], axes, strict=True))
            np.testing.assert_allclose(force, out[handle["f"]], rtol=1e-9, atol=1e-9)
    kinds = {"four_bar": {"joint", "center", "load"}, "engine": {"joint", "center", "direction"}}
    assert seen >= kinds.get(name, {"joint"})


def test_a_force_in_link_axes_is_dragged_in_these() -> None:
    m = da.four_bar()
    load = {"type": "force", "on": "coupler", "at": "B", "axes": "link", "value": [3.0, -2.0]}
    data = page_data(m.with_values({"loads": {"F": load}}))
    out, value = run_page(data), [n["value"] for n in data["numbers"]]
    (handle,) = (h for h in data["handles"] if h["kind"] == "load")
    assert [data["numbers"][n]["path"] for n in handle["components"]] == [
        f"loads.F.value.{k}" for k in (0, 1)
    ]
    angle = da.dynamics(m).angle("coupler")
    own = np.array(
        [3 * np.cos(angle) + 2 * np.sin(angle), 3 * np.sin(angle) - 2 * np.cos(angle)]
    )  # turned with the link
    np.testing.assert_allclose(out[handle["f"]], own, atol=1e-9)
    assert [value[n] for n in handle["components"]] == [3.0, -2.0]
    along = sum(value[n] * out[axis] for n, axis in zip(handle["components"], handle["axes"], strict=True))
    np.testing.assert_allclose(along, own, atol=1e-9)


def test_rounding_is_a_part_of_the_largest_force_of_the_cycle() -> None:
    m = da.four_bar()
    data, r = page_data(m), da.dynamics(m)
    sizes = [np.abs(r.reaction(joint)).max() for joint in r.joints]
    weights = [m.mass(link) * 9.80665 for link in r.links]
    inertia = [np.abs(m.mass(k) * r.center_acceleration(k)).max() for k in r.links]
    assert 1e-12 * max(sizes) <= data["noise"]["force"] <= 1e-12 * max([*sizes, *weights, *inertia])
    assert data["noise"]["moment"] == data["noise"]["force"] * r.compiled.layout.length


@pytest.mark.parametrize("force", [[50.0, 0.0], [-50.0, 0.0], [0.0, -50.0], [30.0, -50.0]])
def test_rounding_is_told_by_the_largest_component_whatever_its_sense(force: list[float]) -> None:
    m = da.loads("""
gravity: none
links: {ground: {points: {O: [0, 0]}}, arm: {points: {O: [0, 0], A: [0, 0]}}}
joints: {O: {type: pin, links: [ground, arm]}}
drives: {O: {position: [0, 1, 2, 3]}}
loads: {F: {type: force, on: arm, at: A, value: [0, 0]}}
""").with_values({"loads.F.value": force})
    noise = page_data(m)["noise"]
    assert noise["force"] == pytest.approx(1e-12 * 50, rel=1e-9)


@pytest.mark.parametrize(
    ("speed", "only"),
    [(3.0, False), ([3.0] * 6, False), ([3.0, 3.0, 3.0, 3.1, 3.0, 3.0], True)],
)
def test_a_page_stops_only_where_its_inputs_are_known(speed: Any, only: bool) -> None:
    changes = {"drives.O2.position": [0.1 * k for k in range(6)], "drives.O2.speed": speed}
    assert page_data(da.four_bar().with_values(changes))["only_at_positions"] is only


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("links.crank.points.A.0", "crank: point A, x"),
        ("links.crank.points.A.2", "crank: point A, z"),
        ("links.crank.center.1", "crank: mass centre, y"),
        ("links.crank.mass", "crank: mass"),
        ("joints.B.friction.radius", "B: friction, radius"),
        ("loads.F.free_length", "F: free length"),
        ("friction.coefficient", "friction: coefficient"),
    ],
)
def test_a_number_is_named_as_a_reader_says_it(path: str, said: str) -> None:
    assert label(path) == said


@pytest.mark.parametrize("off", [0.0, 1e-15, 1e-9])
def test_even_numbers_are_said_by_their_ends(off: float) -> None:
    values = np.linspace(0.3, 2.1, 10)
    values[4] += off
    found = series(values)
    if off < 1e-12:
        assert found == {"from": 0.3, "to": 2.1, "count": 10}
    else:
        assert np.array_equal(np.frombuffer(base64.b64decode(found), "<f8"), values)
    assert isinstance(series(values[:3]), str)
    assert isinstance(series(values[:4]), dict)


def test_numbers_and_drives_have_the_units_of_the_file() -> None:
    m = da.load(FILES["four_bar"])
    data = page_data(m)
    numbers = {n["path"]: n for n in data["numbers"]}
    for path, unit, size in (
        ("links.crank.points.A.0", "in", 0.0254),
        ("links.crank.weight", "lbf", 4.4482216152605),
        ("drives.O2.speed", "rad/s", 1.0),
    ):
        assert (numbers[path]["unit"], numbers[path]["size"]) == (unit, pytest.approx(size))
    assert numbers["links.crank.points.A.0"]["value"] == pytest.approx(5 * 0.0254)
    (drive,) = data["drives"]
    out = run_page(data)
    assert (drive["name"], drive["link"], drive["turns"]) == ("O2", "crank", True)
    assert np.abs(out[drive["p"]]).max() < 1e-12  # at the crank's fixed pin
    statuses = {s["status"]: s for s in data["statuses"]}
    assert statuses["ok"] == {"status": "ok", "sentence": "", "numbered": True}
    assert not statuses["not_assembled"]["numbered"]
    assert statuses["not_assembled"]["sentence"]


def test_a_page_without_inertia_has_the_forces_of_statics() -> None:
    m = da.four_bar()
    for static, run in ((False, da.dynamics), (True, da.statics)):
        data = page_data(m, static)
        out, exact = run_page(data), run(m).effort("O2")
        (row,) = (
            c["row"] for chart in data["views"]["charts"] for c in chart["curves"] if c["of"] == "effort.O2"
        )
        np.testing.assert_allclose(out[row], exact, rtol=1e-9, atol=1e-9 * np.abs(exact).max())


def test_a_table_goes_to_the_page_by_its_pieces() -> None:
    """Exact between the positions too: their polynomials are those of a spline through the points."""
    table = {
        "against": "O2",
        "x": [0.0, 1.5, 3.0, 4.5, 2 * np.pi],
        "y": [0.0, 1.0, 2.0, 1.5, 0.0],
        "periodic": True,
    }
    load = {"type": "couple", "on": "rocker", "value": table}
    for periodic in (True, False):
        changed = {**load, "value": table | {"periodic": periodic}}
        if not periodic:
            del changed["value"]["periodic"]
        m = da.four_bar().with_values({"loads": {"M": changed}})
        (field,) = (c for c in page_data(m)["channels"] if "table" in c)
        found = field["table"]
        breaks, pieces = (np.frombuffer(base64.b64decode(found[k]), "<f8") for k in ("breaks", "pieces"))
        assert (found["drive"], found["period"]) == ("O2", pytest.approx(2 * np.pi) if periodic else None)
        pieces = pieces.reshape(found["order"], -1)
        q = np.array([0.2, 1.4, 2.2, 4.0, 5.9])
        k = np.searchsorted(breaks, q, side="right") - 1
        own = m.with_values({"drives.O2.position": tuple(q)})
        loads = da.statics(own).compiled.forcing.couples.value[:, 0, 0]
        powers = (q - breaks[k])[None] ** np.arange(found["order"] - 1, -1, -1)[:, None]
        np.testing.assert_allclose((pieces[:, k] * powers).sum(axis=0), loads, atol=1e-9)


def test_a_point_of_parameters_is_dragged_by_those_that_are_no_expression() -> None:
    m = da.loads("""
parameters: {r: 50 mm, long: {value: 200 mm, range: [150 mm, 250 mm], about: the rod}, d: 2*r, half: d/4}
links:
  ground: {points: {O: [0, 0]}}
  crank: {points: {O: [0, 0], A: [half*2, 0]}}
  rod: {points: {A: [0, 0], B: [long, 0]}, mass: 1, inertia: 0.01}
  block: {points: {B: [0, 0]}, mass: 1}
joints:
  O: {type: pin, links: [ground, crank]}
  A: {type: pin, links: [crank, rod]}
  B: {type: pin, links: [rod, block]}
  G: {type: slider, links: [ground, block], at: [O, B], direction: 0 deg}
drives: {O: {position: {from: 0 deg, to: 360 deg, count: 12}, speed: 10 rad/s}}
assembly: {rod: 0 deg}
""")
    data = page_data(m)
    paths = [n["path"] for n in data["numbers"]]
    assert paths[:2] == ["r", "long"]
    r, rod = data["numbers"][:2]
    assert (r["value"], r["unit"], r["size"]) == (pytest.approx(0.05), "mm", pytest.approx(1e-3))
    assert (rod["range"], rod["about"], rod["parameter"]) == ([0.15, 0.25], "the rod", True)
    by = {h["name"]: [paths[k] for k in h["by"]] for h in data["handles"] if "by" in h}
    assert by == {"A": ["r"], "B": ["long"]}


def test_a_law_of_one_of_two_drives_is_computed_in_the_page() -> None:
    m = da.five_bar()
    first, second = m.drives
    link = next(k for k in m.links if k != "ground")
    for law in (f"3*sin({first})", f"3*sin({second}) + {first}"):
        changed = m.with_values({"loads": {"M": {"type": "couple", "on": link, "value": law}}})
        data = page_data(changed)
        assert not [
            c["name"] for c in data["channels"] if not c["name"].startswith(("position ", "known ", "sense "))
        ]
        out, exact = run_page(data), da.dynamics(changed)
        for curve in (c for chart in data["views"]["charts"] for c in chart["curves"]):
            kind, _, of = curve["of"].partition(".")
            if kind == "effort":
                np.testing.assert_allclose(out[curve["row"]], exact.effort(of), rtol=1e-8, atol=1e-8)


def spread(item: Any) -> tuple[float, Any]:
    """Radius and centre of a circle; of other items of a drawing 0 and their points."""
    if hasattr(item, "radius") and not hasattr(item, "start"):
        return item.radius, np.array([item.center])
    return 0.0, np.array(item.points)


SYMBOLS = [
    *(("engine", {"pin", "slider"}), ("two_drives", {"pin"}), ("yoke", {"slot"})),
    *(("gear_train", {"gear"}), ("wheel", {"rolling", "weld"}), ("round", {"circular_slot"})),
]
MADE = {
    "wheel": """
        links:
          ground: {points: {W: [0, 0]}}
          disc: {points: {W: [0, 0], P: [0.05, 0.02]}, mass: 2, center: [0.01, 0], inertia: 0.01}
          tip: {points: {P: [0, 0]}, mass: 1, inertia: 0.001}
        joints:
          W: {type: rolling, links: [ground, disc], radius: 0.1}
          P: {type: weld, links: [disc, tip]}
        drives: {W: {position: [0.3, 0.5, 0.9, 1.2]}}
        """,
    "yoke": """
        links:
          ground: {points: {O: [0, 0], C: [0.02, -0.3]}}
          crank: {points: {O: [0, 0], P: [0.1, 0]}, mass: 1, center: [0.05, 0], inertia: 0.01}
          lever: {points: {C: [0, 0], Q: [0.01, 0.02]}, mass: 1, center: [0.2, 0.03], inertia: 0.01}
        joints:
          O: {type: pin, links: [ground, crank]}
          C: {type: pin, links: [ground, lever]}
          S: {type: slot, links: [lever, crank], at: [Q, P], direction: 5 deg}
        drives: {O: {position: [0.3, 0.5, 0.9, 1.2]}}
        assembly: {lever: 70 deg}
        """,
    "round": """
        links:
          ground: {points: {O: [0, 0], C: [0.2, 0.1]}}
          crank: {points: {O: [0, 0], P: [0.1, 0]}, mass: 1, center: [0.05, 0], inertia: 0.01}
          ring: {points: {C: [0, 0], Q: [0.05, 0.02]}, mass: 1, center: [0.02, 0.03], inertia: 0.01}
        joints:
          O: {type: pin, links: [ground, crank]}
          C: {type: pin, links: [ground, ring]}
          S: {type: circular_slot, links: [ring, crank], at: [Q, P], radius: 0.17}
        drives: {O: {position: [0.3, 0.5, 0.9, 1.2]}}
        assembly: {ring: 20 deg}
        """,
}


@pytest.mark.parametrize(("name", "types"), SYMBOLS, ids=[name for name, _ in SYMBOLS])
def test_symbols_of_a_page_are_those_of_the_drawing(
    name: str, types: set[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Placed by its rows, every point of a joint's symbol on a page is where `da.draw` has it, at each position."""
    m = da.loads(MADE[name]) if name in MADE else da.load(FILES[name])
    if len(m.schedule().position) < 2:
        m = with_cycle(m)
    kept: dict[str, Any] = {}

    def markup(_: Any, items: Any) -> str:
        return kept.setdefault(str(len(kept)), items) and str(len(kept) - 1)

    monkeypatch.setattr(Items, "markup", markup)
    data = page_data(m)
    out, r = run_page(data), da.dynamics(m)
    board = data["views"]["mechanism"]
    frame, seen = PaperFrame(board["per_mm"], tuple(board["middle"])), set[str]()
    symbols = [i for i in board["items"] if i["t"] == "symbol"]
    for k in (0, len(r.status) - 1):
        placed = []
        for s in symbols:
            x, y = out[s["e"]][:, k] if "e" in s else (1.0, 0.0)
            turn = np.array([[x, y], [-y, x]])
            for radius, points in map(spread, kept[s["svg"]]):
                placed.append((radius, points @ turn + frame(out[s["p"]][:, k])))
        for joint in m.joints:
            if m.joints[joint].type not in types:
                continue
            canvas = Canvas()
            draw_joint(canvas, r, joint, k, frame)
            for item in canvas.items:
                radius, points = spread(item)
                same = [p for size, p in placed if abs(size - radius) < 1e-9 and p.shape == points.shape]
                assert min(np.abs(p - points).max() for p in same) < 1e-6, (joint, item)
            seen.add(m.joints[joint].type)
        for link in r.links:
            at = np.array(frame(r.center(link)[k]))
            centers = [p for _, p in placed if np.abs(p.mean(axis=0) - at).max() < 0.5]
            assert centers or not m.mass(link)
    assert seen == types


@pytest.mark.parametrize(
    ("ends", "found"), [((0, 1), ("rod", 4.0)), ((2, 0), ("crank", 4.0)), ((1, 2), ("rod", -4.0))]
)
def test_whole_turns_of_a_torsion_spring_are_its_second_links_or_the_others_backwards(
    ends: tuple[int, int], found: tuple[str, float]
) -> None:
    """Two links, 2 the ground; a spring that counts two turns from the first position on, and one that counts none."""
    turns = np.array([[0.0, 2.0]])
    springs = SimpleNamespace(turns=turns, row=np.array([0, 0]))
    layout = SimpleNamespace(freedoms=SimpleNamespace(ends=tuple(np.array([end]) for end in ends)))
    counts = [SimpleNamespace(place=place) for place in (0, 1)]
    c = SimpleNamespace(
        forcing=SimpleNamespace(resistances=springs), counts=counts, layout=layout, links=("crank", "rod")
    )
    path: Any = SimpleNamespace(counted=c, first=3)
    assert list(_counted(path)) == [(found[0], pytest.approx(found[1] * np.pi))]
