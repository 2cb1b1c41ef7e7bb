"""Force analysis of mechanisms: motion, reactions, driving efforts, and how they were found.

>>> import dalembert as da
>>> m = da.slider_crank(crank=0.05, rod=0.2)
>>> r = da.dynamics(m)
>>> r.effort(r.drives[0]).shape == r.drive_position(r.drives[0]).shape
True
"""

from __future__ import annotations

from importlib import import_module

TYPE_CHECKING = False
"""Here and in `cli` not typing's own: importing `typing` would be a third of the time of `dalembert --version`."""
if TYPE_CHECKING:
    from typing import Any

    from dalembert import wrench
    from dalembert.analysis import (
        Mobility,
        Result,
        dynamics,
        kinematics,
        mobility,
        solve,
        statics,
    )
    from dalembert.analysis.batch import BatchResult, Kernel, compile  # noqa: A004
    from dalembert.analysis.batch.design_sweep import Sweep, sweep
    from dalembert.analysis.friction.efficiency import efficiency
    from dalembert.analysis.friction.fixed_point import fixed_point
    from dalembert.analysis.friction.friction_circles import friction_circles
    from dalembert.analysis.friction.joint_friction import guide_contact
    from dalembert.analysis.friction.other_solutions import other_solutions
    from dalembert.analysis.lift import lifted
    from dalembert.analysis.methods.applied_forces import forces_on
    from dalembert.analysis.methods.members import (
        displaced_inertia,
        inertia_shares,
        members,
        order_of_solution,
    )
    from dalembert.analysis.methods.superposition import superposition
    from dalembert.analysis.methods.virtual_work import virtual_work
    from dalembert.errors import STATUSES, AnalysisError, DalembertError, ModelError
    from dalembert.exams.variants import variants
    from dalembert.grading.file_answers import check_file
    from dalembert.grading.marking.grade import grade
    from dalembert.grading.mistakes import check_answers
    from dalembert.machine.balance.balancing import balance
    from dalembert.machine.balance.counterweights import Counterweight
    from dalembert.machine.balance.engine_series import EngineSeries, engine_series
    from dalembert.machine.balance.rotors import RotorBalance, balance_rotor
    from dalembert.machine.bearings.bearing_load import BearingLoad, bearing
    from dalembert.machine.bearings.bearing_table import BearingTable, bearings
    from dalembert.machine.flywheel.flywheel_size import FlywheelSize, flywheel_size
    from dalembert.machine.flywheel.flywheels import flywheel
    from dalembert.machine.gyroscopes import Gyroscopic, gyroscopic
    from dalembert.machine.harmonics import harmonics
    from dalembert.machine.members.member_forces import MemberForces, member_forces
    from dalembert.machine.motion.simulation import Simulation, simulate
    from dalembert.machine.motors.motor_choice import MotorChoice, motor
    from dalembert.machine.shaking import shaking
    from dalembert.model import (
        Answer,
        Bearing,
        Box,
        CircularSlot,
        ConstantForceSpring,
        Couple,
        Cylinder,
        Damper,
        Drive,
        Expression,
        ForceLoad,
        FrictionDefaults,
        Gear,
        GearFriction,
        GuideFriction,
        Link,
        Mechanism,
        Offset,
        Pin,
        PinFriction,
        Range,
        Rise,
        Rolling,
        Section,
        SlenderBar,
        Slider,
        Slot,
        SlotFriction,
        SpaceJoint,
        Sphere,
        Spring,
        StlMesh,
        Table,
        TimeTable,
        TorsionDamper,
        TorsionSpring,
        Tube,
        Weld,
        convert,
        json_schema,
        load,
        loads,
        mechanism,
    )
    from dalembert.model.library import (
        bennett,
        bevel_differential,
        bucket,
        crank_shaper,
        double_cardan,
        five_bar,
        four_bar,
        hooke_joint,
        in_line_engine,
        inverted_slider_crank,
        press_with_flywheel,
        radial_engine,
        rccc,
        rotating_shaft,
        rssp,
        rssr,
        scissor,
        scotch_yoke,
        slider_crank,
        spherical_four_bar,
        stephenson_1,
        stephenson_2,
        stephenson_3,
        toggle_press,
        v_engine,
        watt_1,
        watt_2,
        whitworth,
    )
    from dalembert.optimization.optimizing import optimize
    from dalembert.optimization.optimum import Optimum
    from dalembert.optimization.pareto_front import Front, pareto
    from dalembert.optimization.synthesis import Synthesis, synthesize
    from dalembert.pages.html_page import page
    from dalembert.pages.widget import widget
    from dalembert.reports import report
    from dalembert.studies import Study, StudyResult, study
    from dalembert.views import draw
    from dalembert.views.notation import Notation
    from dalembert.views.paper.scene import Scene

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
    "analysis.methods.superposition": "superposition",
    "analysis.methods.virtual_work": "virtual_work",
    "errors": "STATUSES AnalysisError DalembertError ModelError",
    "exams.variants": "variants",
    "grading.file_answers": "check_file",
    "grading.marking.grade": "grade",
    "grading.mistakes": "check_answers",
    "model": (
        "Answer Bearing Box CircularSlot ConstantForceSpring Couple Cylinder Damper Drive Expression ForceLoad "
        "FrictionDefaults Gear GearFriction GuideFriction Link Mechanism Offset Pin PinFriction Range "
        "Rise Rolling Section SlenderBar Slider Slot SlotFriction SpaceJoint Sphere Spring StlMesh Table "
        "TimeTable TorsionDamper TorsionSpring Tube Weld convert json_schema load loads mechanism"
    ),
    "machine.balance.balancing": "balance",
    "machine.balance.counterweights": "Counterweight",
    "machine.balance.engine_series": "EngineSeries engine_series",
    "machine.balance.rotors": "RotorBalance balance_rotor",
    "machine.bearings.bearing_load": "BearingLoad bearing",
    "machine.bearings.bearing_table": "BearingTable bearings",
    "machine.flywheel.flywheel_size": "FlywheelSize flywheel_size",
    "machine.flywheel.flywheels": "flywheel",
    "machine.gyroscopes": "Gyroscopic gyroscopic",
    "machine.harmonics": "harmonics",
    "machine.motors.motor_choice": "MotorChoice motor",
    "machine.motion.simulation": "Simulation simulate",
    "machine.members.member_forces": "MemberForces member_forces",
    "machine.shaking": "shaking",
    "model.library": (
        "bennett bevel_differential bucket crank_shaper double_cardan five_bar four_bar hooke_joint in_line_engine "
        "inverted_slider_crank press_with_flywheel radial_engine rccc rotating_shaft rssp rssr scissor scotch_yoke "
        "slider_crank spherical_four_bar stephenson_1 stephenson_2 stephenson_3 toggle_press v_engine watt_1 watt_2 "
        "whitworth"
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

__all__ = [
    "STATUSES",
    "AnalysisError",
    "Answer",
    "BatchResult",
    "Bearing",
    "BearingLoad",
    "BearingTable",
    "Box",
    "CircularSlot",
    "ConstantForceSpring",
    "Counterweight",
    "Couple",
    "Cylinder",
    "DalembertError",
    "Damper",
    "Drive",
    "EngineSeries",
    "Expression",
    "FlywheelSize",
    "ForceLoad",
    "FrictionDefaults",
    "Front",
    "Gear",
    "GearFriction",
    "GuideFriction",
    "Gyroscopic",
    "Kernel",
    "Link",
    "Mechanism",
    "MemberForces",
    "Mobility",
    "ModelError",
    "MotorChoice",
    "Notation",
    "Offset",
    "Optimum",
    "Pin",
    "PinFriction",
    "Range",
    "Result",
    "Rise",
    "Rolling",
    "RotorBalance",
    "Scene",
    "Section",
    "Simulation",
    "SlenderBar",
    "Slider",
    "Slot",
    "SlotFriction",
    "SpaceJoint",
    "Sphere",
    "Spring",
    "StlMesh",
    "Study",
    "StudyResult",
    "Sweep",
    "Synthesis",
    "Table",
    "TimeTable",
    "TorsionDamper",
    "TorsionSpring",
    "Tube",
    "Weld",
    "__version__",
    "balance",
    "balance_rotor",
    "bearing",
    "bearings",
    "bennett",
    "bevel_differential",
    "bucket",
    "check_answers",
    "check_file",
    "compile",
    "convert",
    "crank_shaper",
    "displaced_inertia",
    "double_cardan",
    "draw",
    "dynamics",
    "efficiency",
    "engine_series",
    "five_bar",
    "fixed_point",
    "flywheel",
    "flywheel_size",
    "forces_on",
    "four_bar",
    "friction_circles",
    "grade",
    "guide_contact",
    "gyroscopic",
    "harmonics",
    "hooke_joint",
    "in_line_engine",
    "inertia_shares",
    "inverted_slider_crank",
    "json_schema",
    "kinematics",
    "lifted",
    "load",
    "loads",
    "mechanism",
    "member_forces",
    "members",
    "mobility",
    "motor",
    "optimize",
    "order_of_solution",
    "other_solutions",
    "page",
    "pareto",
    "press_with_flywheel",
    "radial_engine",
    "rccc",
    "report",
    "rotating_shaft",
    "rssp",
    "rssr",
    "scissor",
    "scotch_yoke",
    "shaking",
    "simulate",
    "slider_crank",
    "solve",
    "spherical_four_bar",
    "statics",
    "stephenson_1",
    "stephenson_2",
    "stephenson_3",
    "study",
    "superposition",
    "sweep",
    "synthesize",
    "toggle_press",
    "v_engine",
    "variants",
    "virtual_work",
    "watt_1",
    "watt_2",
    "whitworth",
    "widget",
    "wrench",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    home = import_module(f"{__name__}.{_HOME[name]}")
    value = home if name in _PACKAGES else getattr(home, name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
