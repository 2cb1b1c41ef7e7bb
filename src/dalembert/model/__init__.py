"""What the user, the file and the web page write: a frozen description, in SI and radians inside.

>>> from dalembert.model import loads
>>> loads("{links: {ground: {}, bar: {mass: 2 lbm}}}").mass("bar")
0.90718474
"""

from dalembert.model.answers import Answer
from dalembert.model.description import Mechanism, mechanism
from dalembert.model.drives import Drive, Range
from dalembert.model.expressions import Expression
from dalembert.model.files import convert, load, loads, read_file, read_text, save_tree, tree_text
from dalembert.model.forces import Couple, Damper, ForceLoad, Load, Spring, TorsionDamper, TorsionSpring
from dalembert.model.friction import FrictionDefaults, GearFriction, GuideFriction, PinFriction, SlotFriction
from dalembert.model.joints import Gear, Joint, Pin, Rolling, Slider, Slot, Weld
from dalembert.model.laws import Rise, TimeTable
from dalembert.model.link import Link, Offset
from dalembert.model.messages import ModelErrors
from dalembert.model.schedule import Schedule
from dalembert.model.schema import json_schema
from dalembert.model.shapes import Box, Cylinder, SlenderBar, Sphere, StlMesh, Tube
from dalembert.model.space_joints import SpaceJoint
from dalembert.model.tables import Table
from dalembert.model.varying import Varying, value_at

__all__ = [
    "Answer",
    "Box",
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
