"""Loads in the turn of a joint: springs and dampers (docs/theory.md 4)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from dalembert.model.part import LoadPart
from dalembert.model.quantities.values import Name, Scalar


class TurnLoad(LoadPart):
    """A load in the turn of a joint."""

    ON: ClassVar = "turn"
    type: str
    joint: Name = Field(description="the joint it turns with")
    freedom: Literal["turn", "turn1", "turn2"] | None = Field(
        None, description="in space: which turn of the joint; needed where it has several"
    )


class TorsionSpring(TurnLoad):
    """A spring in the turn of a joint.

    >>> TorsionSpring(joint="A", stiffness="5 N*m/rad").stiffness
    5.0
    """

    FORCE: ClassVar = "spring"
    type: Literal["torsion_spring"] = "torsion_spring"
    stiffness: Annotated[float, Scalar("torsion_stiffness", "not negative")] = Field(
        description="moment per angle; a bare number is one per radian"
    )
    free_angle: Annotated[float, Scalar("angle")] = Field(
        0.0,
        description="the joint's angle without moment; default 0. A driven turn counts full turns "
        "with its drive. Another turn is, with the drives at their assembly values (else at 0), within half a turn of "
        "the assembly's value, the angle of j less that of i as written (460 deg is a turn more than 100 deg), else "
        "of 0; it is followed continuously from that value",
    )


class TorsionDamper(TurnLoad):
    """A viscous damper in the turn of a joint.

    >>> TorsionDamper(joint="A", damping="0.1 N*m*s/rad").damping
    0.1
    """

    FORCE: ClassVar = "damper"
    type: Literal["torsion_damper"] = "torsion_damper"
    damping: Annotated[float, Scalar("torsion_damping", "not negative")] = Field(
        description="moment per angular speed; a bare number is one per radian"
    )
