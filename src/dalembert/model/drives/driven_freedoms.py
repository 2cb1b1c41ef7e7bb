"""Finds the freedom that each drive prescribes, from the description before its values are read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from dalembert.errors import ModelError
from dalembert.model.drives.drives import Drive, slides
from dalembert.model.files.messages import place, together
from dalembert.model.joints.joint_part import JointPart
from dalembert.model.joints.plane_joints import freedoms

SECTIONS = ("joints", "drives", "loads", "assembly", "answers", "title", "source")
"""Keys of a file that may be left blank."""


def refuse_empty(tree: object, path: tuple[str | int, ...] = ()) -> None:
    """Raise ModelError for the first value that is left blank."""
    inner = tree.items() if isinstance(tree, Mapping) else enumerate(tree) if isinstance(tree, list) else ()
    for key, value in inner:
        if value is None and (path or key not in SECTIONS):
            what = f"{place((*path, key))} has no value"
            raise ModelError(what, "write one, or leave it out", (*path, key))
        if isinstance(value, (Mapping, list)):
            refuse_empty(value, (*path, key))


def drive_freedoms(tree: Mapping[str, object]) -> dict[str, str]:
    """Drive -> `turn` or `slide`, where it is known."""
    kinds = {name: freedom for name, _, freedom, _ in _drives(tree)}
    return {name: "slide" if slides(freedom) else "turn" for name, freedom in kinds.items() if freedom}


def with_freedoms(tree: Mapping[str, object]) -> Mapping[str, object]:
    """The tree with the freedom of each drive written out; raises ModelError where a joint has several."""
    drives: dict[str, object] = {}
    problems: list[ModelError] = []
    for key, drive, freedom, choices in _drives(tree):
        drives[key] = drive
        if freedom is None and len(choices) > 1:
            problems.append(
                ModelError(
                    f"drive {key!r} does not say which freedom of its joint it prescribes: {' or '.join(choices)}",
                    f"write freedom: {choices[0]}",
                    ("drives", key),
                )
            )
        elif isinstance(drive, Mapping):
            drives[key] = {**drive, "freedom": freedom}
        elif isinstance(drive, Drive) and drive.freedom is None:
            drives[key] = drive.model_copy(update={"freedom": freedom})
    if problems:
        raise together(problems)
    return {**tree, "drives": drives} if isinstance(tree.get("drives"), Mapping) else tree


def _drives(tree: Mapping[str, object]) -> Iterator[tuple[str, object, str | None, tuple[str, ...]]]:
    """Name, drive, the freedom it prescribes, and those its joint has."""
    drives, joints = tree.get("drives"), tree.get("joints")
    if not isinstance(drives, Mapping):
        return
    named = {str(key): joint for key, joint in joints.items()} if isinstance(joints, Mapping) else {}
    for key, drive in drives.items():
        keys = (
            drive
            if isinstance(drive, Mapping)
            else {name: getattr(drive, name, None) for name in ("joint", "freedom")}
        )
        choices = _freedoms(named.get(str(keys.get("joint") or key)))
        only = choices[0] if len(choices) == 1 else None
        freedom = keys["freedom"] if isinstance(keys.get("freedom"), str) else only
        yield key, drive, freedom, choices


def _freedoms(joint: object) -> tuple[str, ...]:
    if isinstance(joint, JointPart):
        return joint.freedoms
    return freedoms(joint.get("type")) if isinstance(joint, Mapping) else ()
