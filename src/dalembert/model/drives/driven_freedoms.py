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
    kinds = {name: freedom for name, _, freedom, _ in _drives(_with_started_joints(with_round_slides(tree)))}
    return {name: "slide" if slides(freedom) else "turn" for name, freedom in kinds.items() if freedom}


def with_freedoms(tree: Mapping[str, object]) -> Mapping[str, object]:
    """The tree with the freedom of each drive written out; raises ModelError where a joint has several."""
    tree = _with_started_joints(with_round_slides(tree))
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


def with_round_slides(tree: Mapping[str, object]) -> Mapping[str, object]:
    """The tree with an arm without mass for each circular slot whose slide is driven: from the slot's centre, where it
    is pinned and driven, along the line to the pin, which slides in it. The slide is its angle."""
    drives, joints, links = (tree.get(key) for key in ("drives", "joints", "links"))
    if not (isinstance(drives, Mapping) and isinstance(joints, Mapping) and isinstance(links, Mapping)):
        return tree
    new: dict[str, dict[str, object]] = {"drives": {}, "joints": {}, "links": {}}
    for name, drive in drives.items():
        joint = drive.get("joint", name) if isinstance(drive, Mapping) else name
        slot = joints.get(joint)
        if not (
            isinstance(slot, Mapping) and slot.get("type") == "circular_slot" and isinstance(drive, Mapping)
        ):
            continue
        ends, at = slot.get("links"), slot.get("at", joint)
        if drive.get("freedom") != "slide" or not isinstance(ends, list) or len(ends) != 2:
            continue
        center, pin = at if isinstance(at, list) and len(at) == 2 else (at, at)
        arm, about = f"{joint}_arm", f"{joint}_center"
        new["links"][arm] = {"points": {center: [0, 0]}}
        new["joints"][about] = {"type": "pin", "links": [ends[0], arm], "at": center}
        new["joints"][f"{joint}_line"] = {"type": "slot", "links": [arm, ends[1]], "at": [center, pin]}
        new["drives"][name] = {**drive, "joint": about, "freedom": "turn"}
    if not new["drives"]:
        return tree
    return {**tree, **{key: {**tree[key], **more} for key, more in new.items()}}  # type: ignore[dict-item]


def _with_started_joints(tree: Mapping[str, object]) -> Mapping[str, object]:
    """The tree with a drive without effort for each joint of one freedom that `start` names and no drive has."""
    start, joints, drives = (tree.get(key) for key in ("start", "joints", "drives"))
    if not isinstance(start, Mapping) or not isinstance(joints, Mapping):
        return tree
    known = dict(drives) if isinstance(drives, Mapping) else {}
    new = {
        n: {"effort": 0.0} for n in start if n not in known and n in joints and len(_freedoms(joints[n])) == 1
    }
    return {**tree, "drives": {**known, **new}} if new else tree


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
            else {name: getattr(drive, name, None) for name in ("joint", "freedom", "cylinder")}
        )
        choices = (
            _freedoms(named.get(str(keys.get("joint") or key))) if not keys.get("cylinder") else ("slide",)
        )
        only = choices[0] if len(choices) == 1 else None
        freedom = keys["freedom"] if isinstance(keys.get("freedom"), str) else only
        yield key, drive, freedom, choices


def _freedoms(joint: object) -> tuple[str, ...]:
    if isinstance(joint, JointPart):
        return joint.freedoms
    return freedoms(joint.get("type")) if isinstance(joint, Mapping) else ()
