"""Force analysis of mechanisms: motion, reactions and driving efforts, with the methods behind them.

>>> import dalembert as da
>>> m = da.slider_crank(crank=0.05, rod=0.2)
>>> r = da.dynamics(m)
>>> r.effort(r.drives[0]).shape == r.drive_position(r.drives[0]).shape
True
"""

from __future__ import annotations

from importlib import import_module

TYPE_CHECKING = False
"""Defined here and in `cli` instead of imported: importing `typing` would be a third of the time of `dalembert
--version`. Names imported as themselves are public to type checkers (PEP 484)."""
if TYPE_CHECKING:
    from typing import Any

    from dalembert import wrench as wrench
    from dalembert.analysis import Mobility as Mobility
    from dalembert.analysis import Result as Result
    from dalembert.analysis import dynamics as dynamics
    from dalembert.analysis import kinematics as kinematics
    from dalembert.analysis import mobility as mobility
    from dalembert.analysis import solve as solve
    from dalembert.analysis import statics as statics
    from dalembert.analysis.batch import BatchResult as BatchResult
    from dalembert.analysis.batch import Kernel as Kernel
    from dalembert.analysis.batch import compile as compile  # noqa: A004
    from dalembert.analysis.batch.design_sweep import Sweep as Sweep
    from dalembert.analysis.batch.design_sweep import sweep as sweep
    from dalembert.analysis.friction.efficiency import efficiency as efficiency
    from dalembert.analysis.friction.fixed_point import fixed_point as fixed_point
    from dalembert.analysis.friction.friction_circles import friction_circles as friction_circles
    from dalembert.analysis.friction.joint_friction import guide_contact as guide_contact
    from dalembert.analysis.friction.other_solutions import other_solutions as other_solutions
    from dalembert.analysis.lift import lifted as lifted
    from dalembert.analysis.methods.applied_forces import forces_on as forces_on
    from dalembert.analysis.methods.members import displaced_inertia as displaced_inertia
    from dalembert.analysis.methods.members import inertia_shares as inertia_shares
    from dalembert.analysis.methods.members import members as members
    from dalembert.analysis.methods.members import order_of_solution as order_of_solution
    from dalembert.analysis.methods.solved.solution_by_steps import PaperSolution as PaperSolution
    from dalembert.analysis.methods.solved.solution_by_steps import solution as solution
    from dalembert.analysis.methods.superposition import superposition as superposition
    from dalembert.analysis.methods.virtual_work import virtual_work as virtual_work
    from dalembert.errors import STATUSES as STATUSES
    from dalembert.errors import AnalysisError as AnalysisError
    from dalembert.errors import DalembertError as DalembertError
    from dalembert.errors import ModelError as ModelError
    from dalembert.exams.variants import variants as variants
    from dalembert.grading.file_answers import check_file as check_file
    from dalembert.grading.marking.grade import grade as grade
    from dalembert.grading.mistakes import check_answers as check_answers
    from dalembert.machine.balance.balancing import balance as balance
    from dalembert.machine.balance.counterweights import Counterweight as Counterweight
    from dalembert.machine.balance.engine_series import EngineSeries as EngineSeries
    from dalembert.machine.balance.engine_series import engine_series as engine_series
    from dalembert.machine.balance.rotors import RotorBalance as RotorBalance
    from dalembert.machine.balance.rotors import balance_rotor as balance_rotor
    from dalembert.machine.bearings.bearing_load import BearingLoad as BearingLoad
    from dalembert.machine.bearings.bearing_load import bearing as bearing
    from dalembert.machine.bearings.bearing_table import BearingTable as BearingTable
    from dalembert.machine.bearings.bearing_table import bearings as bearings
    from dalembert.machine.elements.cam_design import CamDesign as CamDesign
    from dalembert.machine.elements.cam_design import cam as cam
    from dalembert.machine.elements.clearances import ClearanceError as ClearanceError
    from dalembert.machine.elements.clearances import clearance_error as clearance_error
    from dalembert.machine.elements.governors import Governor as Governor
    from dalembert.machine.elements.governors import governor as governor
    from dalembert.machine.elements.hertz_contact import hertz_line as hertz_line
    from dalembert.machine.elements.pin_stresses import PinStresses as PinStresses
    from dalembert.machine.elements.pin_stresses import pin as pin
    from dalembert.machine.elements.pin_table import PinTable as PinTable
    from dalembert.machine.elements.pin_table import pins as pins
    from dalembert.machine.elements.turning_equilibria import TurningRange as TurningRange
    from dalembert.machine.elements.turning_equilibria import small_swings as small_swings
    from dalembert.machine.elements.turning_equilibria import turning_range as turning_range
    from dalembert.machine.flywheel.flywheel_size import FlywheelSize as FlywheelSize
    from dalembert.machine.flywheel.flywheel_size import flywheel_size as flywheel_size
    from dalembert.machine.flywheel.flywheels import flywheel as flywheel
    from dalembert.machine.gyroscopes import Gyroscopic as Gyroscopic
    from dalembert.machine.gyroscopes import gyroscopic as gyroscopic
    from dalembert.machine.harmonics import harmonics as harmonics
    from dalembert.machine.members.member_forces import MemberForces as MemberForces
    from dalembert.machine.members.member_forces import member_forces as member_forces
    from dalembert.machine.motion.compiled_motion import compile_motion as compile_motion
    from dalembert.machine.motion.many.motion_kernel import MotionBatch as MotionBatch
    from dalembert.machine.motion.many.motion_kernel import MotionKernel as MotionKernel
    from dalembert.machine.motion.simulation import Simulation as Simulation
    from dalembert.machine.motion.simulation import simulate as simulate
    from dalembert.machine.motion_law import MotionLaw as MotionLaw
    from dalembert.machine.motion_law import law as law
    from dalembert.machine.motors.motor_choice import MotorChoice as MotorChoice
    from dalembert.machine.motors.motor_choice import motor as motor
    from dalembert.machine.shafts.critical_speeds import CriticalSpeeds as CriticalSpeeds
    from dalembert.machine.shafts.critical_speeds import critical_speeds as critical_speeds
    from dalembert.machine.shaking import shaking as shaking
    from dalembert.model import Answer as Answer
    from dalembert.model import Band as Band
    from dalembert.model import Bearing as Bearing
    from dalembert.model import Box as Box
    from dalembert.model import Cam as Cam
    from dalembert.model import CircularSlot as CircularSlot
    from dalembert.model import Cone as Cone
    from dalembert.model import ConstantForceSpring as ConstantForceSpring
    from dalembert.model import Couple as Couple
    from dalembert.model import Cylinder as Cylinder
    from dalembert.model import Damper as Damper
    from dalembert.model import Disc as Disc
    from dalembert.model import Drive as Drive
    from dalembert.model import DriveScrew as DriveScrew
    from dalembert.model import Expression as Expression
    from dalembert.model import FluidCylinder as FluidCylinder
    from dalembert.model import ForceLoad as ForceLoad
    from dalembert.model import FrictionDefaults as FrictionDefaults
    from dalembert.model import GasSpring as GasSpring
    from dalembert.model import Gear as Gear
    from dalembert.model import GearFriction as GearFriction
    from dalembert.model import GuideFriction as GuideFriction
    from dalembert.model import Link as Link
    from dalembert.model import Mechanism as Mechanism
    from dalembert.model import Offset as Offset
    from dalembert.model import OneWay as OneWay
    from dalembert.model import Pin as Pin
    from dalembert.model import PinFriction as PinFriction
    from dalembert.model import Range as Range
    from dalembert.model import Ratchet as Ratchet
    from dalembert.model import Rise as Rise
    from dalembert.model import Rolling as Rolling
    from dalembert.model import Section as Section
    from dalembert.model import Shoe as Shoe
    from dalembert.model import SlenderBar as SlenderBar
    from dalembert.model import Slider as Slider
    from dalembert.model import Slot as Slot
    from dalembert.model import SlotFriction as SlotFriction
    from dalembert.model import SpaceJoint as SpaceJoint
    from dalembert.model import Sphere as Sphere
    from dalembert.model import Spring as Spring
    from dalembert.model import StlMesh as StlMesh
    from dalembert.model import Table as Table
    from dalembert.model import TimeTable as TimeTable
    from dalembert.model import TorsionDamper as TorsionDamper
    from dalembert.model import TorsionSpring as TorsionSpring
    from dalembert.model import Tube as Tube
    from dalembert.model import Weld as Weld
    from dalembert.model import convert as convert
    from dalembert.model import json_schema as json_schema
    from dalembert.model import load as load
    from dalembert.model import loads as loads
    from dalembert.model import mechanism as mechanism
    from dalembert.model.library import band_brake as band_brake
    from dalembert.model.library import belt_drive as belt_drive
    from dalembert.model.library import bennett as bennett
    from dalembert.model.library import bevel_differential as bevel_differential
    from dalembert.model.library import block_brake as block_brake
    from dalembert.model.library import bucket as bucket
    from dalembert.model.library import crank_shaper as crank_shaper
    from dalembert.model.library import cylinder_boom as cylinder_boom
    from dalembert.model.library import disc_cam as disc_cam
    from dalembert.model.library import double_cardan as double_cardan
    from dalembert.model.library import five_bar as five_bar
    from dalembert.model.library import four_bar as four_bar
    from dalembert.model.library import hartnell_governor as hartnell_governor
    from dalembert.model.library import hoist as hoist
    from dalembert.model.library import hooke_joint as hooke_joint
    from dalembert.model.library import in_line_engine as in_line_engine
    from dalembert.model.library import inverted_slider_crank as inverted_slider_crank
    from dalembert.model.library import planetary_train as planetary_train
    from dalembert.model.library import plate_clutch as plate_clutch
    from dalembert.model.library import porter_governor as porter_governor
    from dalembert.model.library import press_with_flywheel as press_with_flywheel
    from dalembert.model.library import radial_engine as radial_engine
    from dalembert.model.library import ratchet as ratchet
    from dalembert.model.library import rccc as rccc
    from dalembert.model.library import rotating_shaft as rotating_shaft
    from dalembert.model.library import rssp as rssp
    from dalembert.model.library import rssr as rssr
    from dalembert.model.library import scissor as scissor
    from dalembert.model.library import scotch_yoke as scotch_yoke
    from dalembert.model.library import screw_jack as screw_jack
    from dalembert.model.library import slider_crank as slider_crank
    from dalembert.model.library import spherical_four_bar as spherical_four_bar
    from dalembert.model.library import stephenson_1 as stephenson_1
    from dalembert.model.library import stephenson_2 as stephenson_2
    from dalembert.model.library import stephenson_3 as stephenson_3
    from dalembert.model.library import toggle_press as toggle_press
    from dalembert.model.library import v_engine as v_engine
    from dalembert.model.library import watt_1 as watt_1
    from dalembert.model.library import watt_2 as watt_2
    from dalembert.model.library import wedge as wedge
    from dalembert.model.library import whitworth as whitworth
    from dalembert.model.library import worm_gear as worm_gear
    from dalembert.optimization.optimizing import optimize as optimize
    from dalembert.optimization.optimum import Optimum as Optimum
    from dalembert.optimization.pareto_front import Front as Front
    from dalembert.optimization.pareto_front import pareto as pareto
    from dalembert.optimization.synthesis import Synthesis as Synthesis
    from dalembert.optimization.synthesis import synthesize as synthesize
    from dalembert.pages.html_page import page as page
    from dalembert.pages.widget import widget as widget
    from dalembert.reports import report as report
    from dalembert.studies import Study as Study
    from dalembert.studies import StudyResult as StudyResult
    from dalembert.studies import study as study
    from dalembert.views import draw as draw
    from dalembert.views.notation import Notation as Notation
    from dalembert.views.paper.scene import Scene as Scene

__version__ = "0.1.0"

_NAMES = {
    "analysis": "Mobility Result dynamics kinematics mobility solve statics",
    "analysis.batch": "BatchResult Kernel compile",
    "analysis.batch.design_sweep": "Sweep sweep",
    "analysis.friction.efficiency": "efficiency",
    "analysis.friction.fixed_point": "fixed_point",
    "analysis.friction.friction_circles": "friction_circles",
    "analysis.friction.joint_friction": "guide_contact",
    "analysis.friction.other_solutions": "other_solutions",
    "analysis.lift": "lifted",
    "analysis.methods.applied_forces": "forces_on",
    "analysis.methods.members": "displaced_inertia inertia_shares members order_of_solution",
    "analysis.methods.solved.solution_by_steps": "PaperSolution solution",
    "analysis.methods.superposition": "superposition",
    "analysis.methods.virtual_work": "virtual_work",
    "errors": "STATUSES AnalysisError DalembertError ModelError",
    "exams.variants": "variants",
    "grading.file_answers": "check_file",
    "grading.marking.grade": "grade",
    "grading.mistakes": "check_answers",
    "model": (
        "Answer Band Bearing Belt Box Cam CircularSlot Cone ConstantForceSpring Couple Cylinder Damper Disc Drive "
        "DriveScrew Expression FluidCylinder ForceLoad FrictionDefaults GasSpring Gear GearFriction GuideFriction Link "
        "Mechanism Offset OneWay Pin PinFriction Range Ratchet Rise Rolling Section Shoe SlenderBar Slider Slot "
        "SlotFriction SpaceJoint Sphere Spring StlMesh Table TimeTable TorsionDamper TorsionSpring Tube Weld convert "
        "json_schema load loads mechanism"
    ),
    "machine.balance.balancing": "balance",
    "machine.balance.counterweights": "Counterweight",
    "machine.balance.engine_series": "EngineSeries engine_series",
    "machine.balance.rotors": "RotorBalance balance_rotor",
    "machine.bearings.bearing_load": "BearingLoad bearing",
    "machine.bearings.bearing_table": "BearingTable bearings",
    "machine.elements.clearances": "ClearanceError clearance_error",
    "machine.elements.governors": "Governor governor",
    "machine.elements.pin_stresses": "PinStresses pin",
    "machine.elements.pin_table": "PinTable pins",
    "machine.elements.turning_equilibria": "TurningRange small_swings turning_range",
    "machine.flywheel.flywheel_size": "FlywheelSize flywheel_size",
    "machine.flywheel.flywheels": "flywheel",
    "machine.gyroscopes": "Gyroscopic gyroscopic",
    "machine.harmonics": "harmonics",
    "machine.motors.motor_choice": "MotorChoice motor",
    "machine.motion.compiled_motion": "compile_motion",
    "machine.motion.many.motion_kernel": "MotionBatch MotionKernel",
    "machine.motion.simulation": "Simulation simulate",
    "machine.elements.cam_design": "CamDesign cam",
    "machine.elements.hertz_contact": "hertz_line",
    "machine.motion_law": "MotionLaw law",
    "machine.members.member_forces": "MemberForces member_forces",
    "machine.shafts.critical_speeds": "CriticalSpeeds critical_speeds",
    "machine.shaking": "shaking",
    "model.library": (
        "band_brake belt_drive bennett bevel_differential block_brake bucket crank_shaper cylinder_boom "
        "disc_cam double_cardan five_bar four_bar hartnell_governor hoist hooke_joint in_line_engine "
        "inverted_slider_crank planetary_train plate_clutch porter_governor press_with_flywheel "
        "radial_engine ratchet rccc rotating_shaft rssp rssr scissor scotch_yoke screw_jack slider_crank "
        "spherical_four_bar stephenson_1 stephenson_2 stephenson_3 toggle_press v_engine watt_1 watt_2 "
        "wedge whitworth worm_gear"
    ),
    "optimization.optimizing": "optimize",
    "optimization.optimum": "Optimum",
    "optimization.pareto_front": "Front pareto",
    "optimization.synthesis": "Synthesis synthesize",
    "pages.html_page": "page",
    "pages.widget": "widget",
    "reports": "report",
    "studies": "Study StudyResult study",
    "views": "draw",
    "views.notation": "Notation",
    "views.paper.scene": "Scene",
    "wrench": "wrench",
}
"""Package -> public names that are imported from it when they are first asked for."""

_HOME = {name: package for package, names in _NAMES.items() for name in names.split()}

_PACKAGES = ("wrench",)
"""Public names that are packages themselves."""

__all__ = sorted(["__version__", *_HOME])


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    home = import_module(f"{__name__}.{_HOME[name]}")
    value = home if name in _PACKAGES else getattr(home, name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
