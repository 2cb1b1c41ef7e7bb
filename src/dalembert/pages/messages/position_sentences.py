"""Sentences of a page on a position without an answer: those of the analyses, with the rows that fill them.

``{arc}``, ``{span}`` and ``{at}`` are the location, worded as in the analyses; ``{gap}`` is the remaining gap.
"""

from __future__ import annotations

import numpy as np

from dalembert.analysis.batch.compiled_kernel import Kernel
from dalembert.analysis.degree_of_freedom import ADD, COUNTS
from dalembert.analysis.friction import friction_status as friction
from dalembert.analysis.positions import GEAR, GEAR_REMEDY, MESH
from dalembert.analysis.result.result import Result
from dalembert.analysis.status import closure_failure as closure
from dalembert.analysis.status import overflow
from dalembert.analysis.status.statuses import SINGULAR, no_balance_sentence
from dalembert.arrays import Tree
from dalembert.core.layout import BeltMesh, Mesh
from dalembert.kernel.graph import trace_array
from dalembert.pages.rows import NodeRows
from dalembert.units import file_units


def position_sentences(known: Result, k: Kernel, rows: NodeRows) -> Tree:
    """Templates by status, and the rows and units that they are filled with."""
    c = known.compiled
    resting = not c.schedule.speed.any()
    unit = {kind: _unit(known, kind) for kind in ("length", "angle", "force", "moment")}
    return {
        "templates": {
            "not_assembled": closure.open_template(c),
            "singular": SINGULAR,
            "no_balance": no_balance_sentence(c, np.arange(len(c.schedule.position))),
            "overflow": overflow.OVERFLOW,
            "jammed": friction.JAMMED,
            "self_locking": friction.LOCKED + "{figures}.",
            "at_rest": friction.REST + "." if resting else friction.NO_RATE,
            "reversal": friction.REVERSAL,
        },
        "words": {
            "unfollowed": closure.UNFOLLOWED,
            "one": closure.ONE,
            "several": closure.SEVERAL,
            "alike": closure.ALL_ALIKE,
            "most": closure.MOST,
            "kinds": closure.WORDS,
            "described": closure.AS_DESCRIBED,
            "of": overflow.OF,
            "checks": overflow.CHECKS,
            "sides": friction.BOTH_SIDES,
            "needs": friction.NEEDS,
            "counts": COUNTS,
            "add": ADD,
        },
        "limits": {"shut": closure.SHUT, "alike": closure.ALIKE},
        "units": unit,
        "joints": list(known.joints),
        "overflow": {
            overflow.RATES: [
                [link, *rows.vector(rows.r.twist_array[0, n]), *rows.vector(rows.r.acceleration_array[0, n])]
                for n, link in enumerate(known.links)
            ],
            overflow.FORCES: [
                [
                    joint,
                    *rows.vector(rows.r.force_array[0, n]),
                    *rows.vector(np.ravel(rows.r.moment_array[0, n])),
                ]
                for n, joint in enumerate(known.joints)
            ],
        },
        "unknowns": _unknowns(known, rows),
        "contacts": _contacts(known, k, rows),
        "gears": _gears(k, rows),
    }


def _unit(known: Result, kind: str) -> Tree:
    """A unit as messages write it, with its size."""
    units = file_units(known.mechanism.units)
    return {"unit": units.text(kind), "size": units.unit(kind).si(1.0)}


def _unknowns(known: Result, rows: NodeRows) -> list[Tree]:
    """Unknown efforts and loads, in the order of the analyses."""
    c, s = known.compiled, rows.r
    efforts = [
        (name, "moment" if c.layout.freedoms.angular[c.layout.driven[n]] else "force", s.effort(name)[0])
        for n, name in enumerate(known.drives)
        if c.known.requested[n]
    ]
    loads = [
        (name, "moment" if couple else "force", s.unknown_load(name)[0])
        for name, couple in zip(known.unknown_loads, c.known.couple, strict=True)
    ]
    return [
        {"name": name, "kind": kind, "row": rows.of(value)}
        | ({"single": True} if _single(known, name) else {})
        for name, kind, value in (*efforts, *loads)
    ]


def _single(known: Result, name: str) -> bool:
    """True where contacts at rest leave an unknown one value."""
    rest = np.array(known.status) == "at_rest"
    return bool(rest.any() and friction.one_value(*known.interval(name)[rest].T).all())


def _contacts(known: Result, k: Kernel, rows: NodeRows) -> list[Tree]:
    """The sense of each contact with friction, with its joint."""
    slip, contacts = k.trace.catalogue.traced.friction.slip, known.compiled.contacts
    if slip is None or contacts is None:
        return []
    senses = trace_array(rows.graph, slip.state.sense)
    return [
        {"joint": known.joints[joint], "row": rows.of(sense)}
        for joint, sense, fixed in zip(contacts.joint, senses, contacts.fixed, strict=True)
        if not fixed
    ]


def _gears(k: Kernel, rows: NodeRows) -> list[Tree]:
    """Centre distances of planar meshing wheels, their radii, and the distances that these need."""
    c, pose = k.trace.catalogue.compiled, k.trace.catalogue.traced.pose
    g, out = c.layout.algebra, list[Tree]()
    for f in c.layout.constraints.families:
        if not isinstance(f, Mesh) or isinstance(f, BeltMesh):
            continue
        between = pose.point[f.j] + g.rotate(pose.rotation[f.j], f.uj)
        between = between - pose.point[f.i] - g.rotate(pose.rotation[f.i], f.ui)
        for n, (x, y) in enumerate(between):
            ri, rj = (trace_array(rows.graph, r)[n] for r in (f.ri, f.rj))
            numbers = ((x * x + y * y).sqrt(), ri, rj)
            name = c.joints[c.layout.constraints.joint[f.row[n]]]
            sentence = f"{GEAR.format(repr(name), '{found}', '{ri}', '{rj}', '{wanted}')}; {GEAR_REMEDY}"
            out.append({"sentence": sentence, "rows": rows.vector(numbers), "error": MESH})
    return out
