"""Ready mechanisms: as functions of their dimensions, and as commented files to start from.

In: dimensions. Out: a ``Mechanism``, or its file's text. Imports ``model``.

>>> from dalembert.model.library import TEMPLATES, template
>>> template("scotch_yoke").title
'Scotch yoke'
>>> print(TEMPLATES["five_bar"].description)
two driven cranks and two couplers, the simplest parallel robot
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from dalembert.errors import ModelError
from dalembert.model.library.engines import in_line_engine, radial_engine, v_engine
from dalembert.model.library.from_files import file_text, template_function
from dalembert.model.library.scissor_lift import scissor
from dalembert.model.library.spatial import bennett, rccc, spherical_four_bar

if TYPE_CHECKING:
    from dalembert.model import Mechanism

four_bar = template_function("four_bar")
slider_crank = template_function("slider_crank")
inverted_slider_crank = template_function("inverted_slider_crank")
whitworth = template_function("whitworth")
crank_shaper = template_function("crank_shaper")
watt_1 = template_function("watt_1")
watt_2 = template_function("watt_2")
stephenson_1 = template_function("stephenson_1")
stephenson_2 = template_function("stephenson_2")
stephenson_3 = template_function("stephenson_3")
scotch_yoke = template_function("scotch_yoke")
toggle_press = template_function("toggle_press")
press_with_flywheel = template_function("press_with_flywheel")
five_bar = template_function("five_bar")
bucket = template_function("bucket")
disc_cam = template_function("disc_cam")
block_brake = template_function("block_brake")
band_brake = template_function("band_brake")
plate_clutch = template_function("plate_clutch")
screw_jack = template_function("screw_jack")
wedge = template_function("wedge")
ratchet = template_function("ratchet")
cylinder_boom = template_function("cylinder_boom")
worm_gear = template_function("worm_gear")
belt_drive = template_function("belt_drive")
hoist = template_function("hoist")
hooke_joint = template_function("hooke_joint")
double_cardan = template_function("double_cardan")
bevel_differential = template_function("bevel_differential")
rotating_shaft = template_function("rotating_shaft")
porter_governor = template_function("porter_governor")
hartnell_governor = template_function("hartnell_governor")
planetary_train = template_function("planetary_train")
rssr = template_function("rssr")
rssp = template_function("rssp")

__all__ = [
    "TEMPLATES", "Template", "band_brake", "belt_drive", "bennett", "bevel_differential", "block_brake",
    "bucket", "crank_shaper", "cylinder_boom", "disc_cam", "double_cardan", "five_bar", "four_bar",
    "hartnell_governor", "hoist", "hooke_joint", "in_line_engine", "inverted_slider_crank",
    "planetary_train", "plate_clutch", "porter_governor", "press_with_flywheel", "radial_engine",
    "ratchet", "rccc", "rotating_shaft", "rssp", "rssr", "scissor", "scotch_yoke", "screw_jack",
    "slider_crank", "spherical_four_bar", "stephenson_1", "stephenson_2", "stephenson_3", "template",
    "template_text", "toggle_press", "v_engine", "watt_1", "watt_2", "wedge", "whitworth", "worm_gear",
]  # fmt: skip


class Template(NamedTuple):
    """A function that builds a mechanism from dimensions, and what it builds in one line."""

    function: Callable[..., Mechanism]
    description: str


DESCRIPTIONS = {
    "four_bar": "crank, coupler and rocker",
    "slider_crank": "engine, pump or compressor; with offset if wanted",
    "inverted_slider_crank": "a block on the crank pin slides along a swinging arm",
    "whitworth": "quick return with an arm that goes right round",
    "crank_shaper": "quick return with a swinging lever, as in a shaping machine",
    "watt_1": "six-bar: a second loop on the coupler and rocker of a four-bar",
    "watt_2": "six-bar: two four-bars in series",
    "stephenson_1": "six-bar: a second dyad between crank and rocker",
    "stephenson_2": "six-bar: a floating plate on two couplers drives the rocker",
    "stephenson_3": "six-bar: a coupler point drives an output rocker",
    "scotch_yoke": "the crank pin in a slot moves a yoke as a pure cosine",
    "toggle_press": "a crank straightens two toggle links over a ram",
    "press_with_flywheel": "a motor and a flywheel drive a crank press, with bearings and a rod's section",
    "five_bar": "two driven cranks and two couplers, the simplest parallel robot",
    "scissor": "scissor lift of any number of stages",
    "bucket": "excavator bucket moved by a hydraulic cylinder",
    "belt_drive": "two wheels on fixed axes and a belt, whose tensions and slip are computed",
    "disc_cam": "cam with rise, dwell and return, roller follower and spring",
    "block_brake": "a lever presses a pivoted shoe on a drum",
    "band_brake": "a lever pulls a band tight round a drum",
    "plate_clutch": "two shafts and the plates between them, which slip",
    "screw_jack": "torque on a screw that lifts a load, with thread and collar friction",
    "wedge": "a wedge lifts a block in a guide, with friction on its three faces",
    "ratchet": "a motor's pawl takes a hoist's drum along, which may run ahead",
    "cylinder_boom": "a hydraulic cylinder lifts a boom: force, pressure and flow",
    "hoist": "a drum winds a rope that runs over a fixed and a moving pulley",
    "in_line_engine": "cylinders in line that fire in an order; generated",
    "v_engine": "cylinders in two banks, two rods on each throw; generated",
    "radial_engine": "cylinders in a star on one throw; generated",
    "porter_governor": "balls on arms lift a sleeve in a plane that turns: speed over the height",
    "hartnell_governor": "balls on bell cranks against a spring in a plane that turns",
    "planetary_train": "sun, planet, arm and a held ring, with losses in both directions",
    "rssr": "in space: crank, rod with two balls, rocker about any axis",
    "rssp": "in space: crank, rod with two balls, slider along any line",
    "rccc": "in space: a revolute and three cylindrical joints, the general four-bar",
    "bennett": "in space: four axes that should not move, and do",
    "spherical_four_bar": "in space: four axes through one point",
    "hooke_joint": "in space: a universal joint between two shafts at an angle",
    "double_cardan": "in space: two universal joints that turn evenly",
    "bevel_differential": "in space: a carrier turns by half the sum of two wheels' turns",
    "worm_gear": "in space: a worm drives a wheel, with friction of the teeth",
    "rotating_shaft": "in space: a shaft with masses off its axis on two bearings",
}
TEMPLATES = {name: Template(globals()[name], description) for name, description in DESCRIPTIONS.items()}
"""Name -> function and description, for `dalembert new NAME`."""


def template(name: str) -> Mechanism:
    """The template of that name with its default dimensions.

    >>> from dalembert.model.library import template
    >>> template("four_bar").joints["A"].links
    ('crank', 'coupler')
    """
    return _require_known(name).function()


def template_text(name: str) -> str:
    """The same mechanism as a commented YAML file in millimetres, to be edited.

    >>> from dalembert.model.library import template_text
    >>> template_text("four_bar").splitlines()[1]
    'title: Four-bar linkage'
    """
    function = _require_known(name).function
    if not function.__module__.endswith(".engines"):
        return file_text(name)
    text = (function.__doc__ or "").partition(">>>")[0].replace("`", "").strip().splitlines()
    head, _, rest = str(function()).partition("\n")
    return "\n".join([head, "", *(f"# {line.strip()}".rstrip() for line in text), "", rest])


def _require_known(name: str) -> Template:
    if name not in TEMPLATES:
        from difflib import get_close_matches

        near = get_close_matches(name, TEMPLATES, 1, 0.4)
        hint = f"did you mean {near[0]!r}?" if near else "choose among " + ", ".join(TEMPLATES)
        raise ModelError(f"unknown template {name!r}", hint)
    return TEMPLATES[name]
