"""Model of a mechanism as the user or the file writes it: a frozen description, in SI and radians inside.

In: a file, or Python values. Out: a ``Mechanism``. Imports ``units`` and messages only, never ``core``.

>>> from dalembert.model import loads
>>> loads("{links: {ground: {}, bar: {mass: 2 lbm}}}").mass("bar")
0.90718474
"""

from dalembert.model.description import Mechanism as Mechanism
from dalembert.model.description import mechanism as mechanism
from dalembert.model.drives.cylinders import FluidCylinder as FluidCylinder
from dalembert.model.drives.drive_screws import DriveScrew as DriveScrew
from dalembert.model.drives.drives import Drive as Drive
from dalembert.model.drives.drives import Range as Range
from dalembert.model.drives.laws import Rise as Rise
from dalembert.model.drives.laws import TimeTable as TimeTable
from dalembert.model.drives.schedule import AtPositions as AtPositions
from dalembert.model.drives.schedule import Schedule as Schedule
from dalembert.model.files.conversion import convert as convert
from dalembert.model.files.json_schema import json_schema as json_schema
from dalembert.model.files.messages import ModelErrors as ModelErrors
from dalembert.model.files.model_files import ModelOrPath as ModelOrPath
from dalembert.model.files.model_files import as_mechanism as as_mechanism
from dalembert.model.files.model_files import load as load
from dalembert.model.files.model_files import loads as loads
from dalembert.model.files.model_files import read_file as read_file
from dalembert.model.files.model_files import read_text as read_text
from dalembert.model.files.model_files import save_tree as save_tree
from dalembert.model.files.model_files import tree_text as tree_text
from dalembert.model.joints.bearing_keys import Bearing as Bearing
from dalembert.model.joints.elements.belts import Belt as Belt
from dalembert.model.joints.elements.brakes import Band as Band
from dalembert.model.joints.elements.brakes import Shoe as Shoe
from dalembert.model.joints.elements.cams import Cam as Cam
from dalembert.model.joints.elements.clutches import Cone as Cone
from dalembert.model.joints.elements.clutches import Disc as Disc
from dalembert.model.joints.elements.one_way_joints import OneWay as OneWay
from dalembert.model.joints.elements.one_way_joints import Ratchet as Ratchet
from dalembert.model.joints.elements.ropes import Rope as Rope
from dalembert.model.joints.friction_keys import FrictionDefaults as FrictionDefaults
from dalembert.model.joints.friction_keys import GearFriction as GearFriction
from dalembert.model.joints.friction_keys import GuideFriction as GuideFriction
from dalembert.model.joints.friction_keys import PinFriction as PinFriction
from dalembert.model.joints.friction_keys import SlotFriction as SlotFriction
from dalembert.model.joints.plane_joints import CircularSlot as CircularSlot
from dalembert.model.joints.plane_joints import Gear as Gear
from dalembert.model.joints.plane_joints import Joint as Joint
from dalembert.model.joints.plane_joints import Pin as Pin
from dalembert.model.joints.plane_joints import Rolling as Rolling
from dalembert.model.joints.plane_joints import Slider as Slider
from dalembert.model.joints.plane_joints import Slot as Slot
from dalembert.model.joints.plane_joints import Weld as Weld
from dalembert.model.joints.space_joints import SpaceJoint as SpaceJoint
from dalembert.model.joints.turn_loads import TorsionDamper as TorsionDamper
from dalembert.model.joints.turn_loads import TorsionSpring as TorsionSpring
from dalembert.model.links.link import GROUND as GROUND
from dalembert.model.links.link import Link as Link
from dalembert.model.links.link import Offset as Offset
from dalembert.model.links.sections import Section as Section
from dalembert.model.links.shapes import Box as Box
from dalembert.model.links.shapes import Cylinder as Cylinder
from dalembert.model.links.shapes import SlenderBar as SlenderBar
from dalembert.model.links.shapes import Sphere as Sphere
from dalembert.model.links.shapes import StlMesh as StlMesh
from dalembert.model.links.shapes import Tube as Tube
from dalembert.model.load_types import ConstantForceSpring as ConstantForceSpring
from dalembert.model.load_types import Couple as Couple
from dalembert.model.load_types import Damper as Damper
from dalembert.model.load_types import ForceLoad as ForceLoad
from dalembert.model.load_types import GasSpring as GasSpring
from dalembert.model.load_types import Load as Load
from dalembert.model.load_types import Spring as Spring
from dalembert.model.quantities.expressions import Expression as Expression
from dalembert.model.quantities.tables import Table as Table
from dalembert.model.quantities.varying import Varying as Varying
from dalembert.model.quantities.varying import value_at as value_at
from dalembert.model.stated_answers import StatedAnswer as StatedAnswer

Answer = StatedAnswer
"""Public name of the answer to a question, beside the answers of analyses."""
