"""Answers about the machine elements of a result by name: contacts, belts, ropes, brakes, cylinders, screws."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from dalembert.analysis.methods.belt_forces import BeltForces
    from dalembert.analysis.methods.contact_force import ContactHistory
    from dalembert.analysis.methods.elements.clutch_couples import OneWayAnswer
    from dalembert.analysis.methods.elements.screw_torques import ScrewAnswer
    from dalembert.analysis.methods.power_flow import PowerFlow
    from dalembert.analysis.methods.rope_forces import RopeForces
    from dalembert.arrays import Array
    from dalembert.machine.elements.cylinder_answer import CylinderAnswer


class ElementAnswers:
    """Answers of machine elements, each computed on request."""

    def contact(self, joint: str) -> ContactHistory:
        """Normal force of a contact that only pushes, and the speed at which it is lost: `contact_force.py`."""
        from dalembert.analysis.methods.contact_force import contact_force

        return contact_force(self, joint)  # type: ignore[arg-type]

    def belt(self, joint: str) -> BeltForces:
        """Tensions of a belt or a chain, the friction it needs, and its limit: `belt_forces.py`."""
        from dalembert.analysis.methods.belt_forces import belt_forces

        return belt_forces(self, joint)  # type: ignore[arg-type]

    def rope(self, joint: str) -> RopeForces:
        """Tensions of a rope's strands, and the friction that it needs: `rope_forces.py`."""
        from dalembert.analysis.methods.rope_forces import rope_forces

        return rope_forces(self, joint)  # type: ignore[arg-type]

    def brake(self, joint: str) -> Any:
        """Torque, force, pressure and locking coefficient of a brake or clutch: `brake_answer.py`."""
        from dalembert.analysis.friction.brake_answer import brake

        return brake(self, joint)  # type: ignore[arg-type]

    shoe = brake
    band = brake

    def power_flow(self) -> PowerFlow:
        """Power through every joint, link and mesh, and what of it circulates: `power_flow.py`."""
        from dalembert.analysis.methods.power_flow import power_flow

        return power_flow(self)  # type: ignore[arg-type]

    @property
    def turning_speed(self) -> Array:
        """Angular speed (P,) of the turning plane, rad/s: given, or solved; at rest with friction that without it.

        Raises ModelError if the plane does not turn.
        """
        from dalembert.analysis.methods.turning_motion import turning_speed

        return turning_speed(self)  # type: ignore[arg-type]

    @property
    def turning_interval(self) -> Array:
        """Low and high (P, 2) of the speeds at which friction holds the machine, rad/s; else one number twice."""
        from dalembert.analysis.methods.turning_motion import turning_interval

        return turning_interval(self)  # type: ignore[arg-type]

    @property
    def turning_torque(self) -> Array:
        """Torque (P,) of the shaft that turns the plane, N m: the rate of its moment of momentum."""
        from dalembert.analysis.methods.turning_motion import turning_torque

        return turning_torque(self)  # type: ignore[arg-type]

    def cylinder(self, drive: str) -> CylinderAnswer:
        """Pressures, flows and the column of a drive that is a cylinder: `cylinder_answer.py`."""
        from dalembert.machine.elements.cylinder_answer import cylinder

        return cylinder(self, drive)  # type: ignore[arg-type]

    def screw(self, drive: str) -> ScrewAnswer:
        """Torque, efficiency and locking of the screw of a drive: `screw_torques.py`."""
        from dalembert.analysis.methods.elements.screw_torques import screw

        return screw(self, drive)  # type: ignore[arg-type]

    def one_way(self, joint: str) -> OneWayAnswer:
        """Couple and inner forces of a one-way clutch or a ratchet: `clutch_couples.py`."""
        from dalembert.analysis.methods.elements.clutch_couples import one_way

        return one_way(self, joint)  # type: ignore[arg-type]
