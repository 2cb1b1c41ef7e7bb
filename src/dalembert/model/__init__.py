"""What the user and the file write: a frozen description, in SI and radians inside.

In: a file, or Python's own values. Out: a ``Mechanism``. Imports ``units`` and messages only, never ``core``.

>>> from dalembert.model import loads
>>> loads("{links: {ground: {}, bar: {mass: 2 lbm}}}").mass("bar")
0.90718474
"""

from dalembert.model.description import Mechanism, mechanism
from dalembert.model.drives.drives import Drive, Range
from dalembert.model.drives.laws import Rise, TimeTable
from dalembert.model.drives.schedule import Schedule
from dalembert.model.files.conversion import convert
from dalembert.model.files.json_schema import json_schema
from dalembert.model.files.messages import ModelErrors
from dalembert.model.files.model_files import load, loads, read_file, read_text, save_tree, tree_text
from dalembert.model.joints.bearing_keys import Bearing
from dalembert.model.joints.friction_keys import (
    FrictionDefaults,
    GearFriction,
    GuideFriction,
    PinFriction,
    SlotFriction,
)
from dalembert.model.joints.plane_joints import CircularSlot, Gear, Joint, Pin, Rolling, Slider, Slot, Weld
from dalembert.model.joints.space_joints import SpaceJoint
from dalembert.model.links.link import GROUND, Link, Offset
from dalembert.model.links.sections import Section
from dalembert.model.links.shapes import Box, Cylinder, SlenderBar, Sphere, StlMesh, Tube
from dalembert.model.load_types import (
    ConstantForceSpring,
    Couple,
    Damper,
    ForceLoad,
    Load,
    Spring,
    TorsionDamper,
    TorsionSpring,
)
from dalembert.model.quantities.expressions import Expression
from dalembert.model.quantities.tables import Table
from dalembert.model.quantities.varying import Varying, value_at
from dalembert.model.stated_answers import Answer

__all__ = [
    "GROUND",
    "Answer",
    "Bearing",
    "Box",
    "CircularSlot",
    "ConstantForceSpring",
    "Couple",
    "Cylinder",
    "Damper",
    "Drive",
    "Expression",
    "ForceLoad",
    "FrictionDefaults",
    "Gear",
    "GearFriction",
    "GuideFriction",
    "Joint",
    "Link",
    "Load",
    "Mechanism",
    "ModelErrors",
    "Offset",
    "Pin",
    "PinFriction",
    "Range",
    "Rise",
    "Rolling",
    "Schedule",
    "Section",
    "SlenderBar",
    "Slider",
    "Slot",
    "SlotFriction",
    "SpaceJoint",
    "Sphere",
    "Spring",
    "StlMesh",
    "Table",
    "TimeTable",
    "TorsionDamper",
    "TorsionSpring",
    "Tube",
    "Varying",
    "Weld",
    "convert",
    "json_schema",
    "load",
    "loads",
    "mechanism",
    "read_file",
    "read_text",
    "save_tree",
    "tree_text",
    "value_at",
]
