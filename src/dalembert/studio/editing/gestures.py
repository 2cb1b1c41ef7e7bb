"""All gestures, by their name in ``op``."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, TypeAdapter, ValidationError

from dalembert.errors import ModelError
from dalembert.studio.editing.drawing_gestures import (
    DrawnLink,
    GroundPoint,
    Join,
    LinkPoint,
    Merge,
    Slide,
    Wheels,
)
from dalembert.studio.editing.edit_gestures import (
    Delete,
    Length,
    Move,
    PageChanges,
    PoseLinks,
    Rename,
    SetValue,
)
from dalembert.studio.editing.gesture import Gesture
from dalembert.studio.editing.load_gestures import DriveJoint, LinkCouple, PointForce, Span

AnyGesture = Annotated[
    DrawnLink
    | GroundPoint
    | LinkPoint
    | Merge
    | Slide
    | Wheels
    | Join
    | DriveJoint
    | PointForce
    | LinkCouple
    | Span
    | Move
    | PoseLinks
    | SetValue
    | Length
    | PageChanges
    | Rename
    | Delete,
    Field(discriminator="op"),
]
_ADAPTER: TypeAdapter[Gesture] = TypeAdapter(AnyGesture)


def gesture(message: object) -> Gesture:
    """The gesture of a message; raises ModelError where it is not one.

    >>> gesture({"op": "couple", "link": "crank", "value": "3 N*m"})
    LinkCouple(op='couple', link='crank', value='3 N*m')
    """
    try:
        return _ADAPTER.validate_python(message)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(key) for key in first["loc"]) or "op"
        raise ModelError(f"the gesture cannot be read: {where}: {first['msg']}", "reload the page") from None
