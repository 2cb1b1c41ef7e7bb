"""Positions of traced mechanisms: rigid parts joined one after the other in closed form, Newton for the rest.

A *part* is a set of links whose relative positions are known. Two parts with three conditions between them, or three
parts joined pairwise by pins and sliders (all five kinds of two-link groups), become one part, until all are joined to
the ground. Such a group has two branches; the one of the mechanism's known motion is used.

Mechanics: docs/theory.md 8.
"""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np

from dalembert.kernel.graph import Scalar
from dalembert.kernel.position import plane_vectors as v
from dalembert.kernel.position.plane_vectors import Pair
from dalembert.kernel.position.relations import Relation
from dalembert.kernel.position.rigid_parts import DEAD, Parts, Place, PlacedPose, TracePlan
from dalembert.kernel.position.unrolled_newton import newton


class Groups(Parts):
    """Parts that are joined group by group."""

    def grow(self) -> PlacedPose:
        """Joins parts until one is left."""
        while len(self.part) > 1:
            if not (self.pairs() or self.triples() or self.pinned_twice()):
                self.general()
        self.out.pose = self.pose()
        return self.out

    def pairs(self) -> bool:
        several = [(relations, parts) for parts, relations in self.between.items() if len(relations) > 1]
        for relations, parts in sorted(several, key=lambda entry: self.order[id(entry[0][0])]):
            x, y = self.base(*parts)
            pose = self.pair(x, y, relations)
            if pose is not None:
                self.merge(x, y, pose)
                return True
        return False

    def pair(self, x: int, y: int, relations: list[Relation]) -> Place | None:
        turns = [r for r in relations if r.kind == "turn"]
        meets = [r for r in relations if r.kind == "meet"]
        along = [r for r in relations if r.kind == "along"]
        if turns and (meets or len(along) >= 2):
            rotation = self.rotation(turns[0], y)
            return rotation, self.translation(rotation, y, meets, along)
        if meets and along:
            return self.pin_and_slot(x, y, meets[0], along[0])
        if meets and any(r.kind == "mesh" for r in relations) and x == self.owner[self.ground]:
            return self.wheel(y, meets[0], next(r for r in relations if r.kind == "mesh"))
        return None

    def pin_and_slot(self, x: int, y: int, pin: Relation, slot: Relation) -> Place:
        """A part pinned to another, and a point of one on a line of the other."""
        (lx, ux), (ly, uy) = self.ends(pin, y)
        px, py = self.point(lx, ux), self.point(ly, uy)
        axis = v.rotate(self.part[self.owner[slot.i]][slot.i][0], slot.axis)
        pi, pj = self.point(slot.i, slot.ui), self.point(slot.j, slot.uj)
        on_y = self.owner[slot.j] == y

        def rotation(sign: Scalar) -> Pair:
            if on_y:  # the line on x, the point on y
                arm = v.minus(pj, py)
                k = slot.target - v.dot(axis, v.minus(px, pi))
                length2 = v.dot(arm, arm)
                h = self.root(length2 - k * k, length2)
                w = v.plus(v.times(k, axis), v.times(sign * h, v.across(axis)))
                return self.onto(arm, length2, w)
            d = v.minus(pj, px)
            k = slot.target + v.dot(axis, v.minus(pi, py))
            d2 = v.dot(d, d)
            h = self.root(d2 - k * k, d2)
            e = v.times(1.0 / d2, v.plus(v.times(k, d), v.times(sign * h, v.across(d))))
            return v.rotate_back(axis, e)

        r = self.choose_rotation(rotation, x, y)
        return r, v.minus(px, v.rotate(r, py))

    def wheel(self, y: int, pin: Relation, mesh: Relation) -> Place | None:
        """A wheel pinned at its centre, in mesh with one whose angle is known (ground axes)."""
        wheel, other = (mesh.j, mesh.i) if self.owner[mesh.j] == y else (mesh.i, mesh.j)
        (lx, ux), (ly, uy) = self.ends(pin, y)
        centre = mesh.uj if wheel == mesh.j else mesh.ui
        if ly != wheel or not all(a is b or a == b for a, b in zip(uy, centre, strict=True)):
            return None
        px = self.point(lx, ux)
        u = mesh.ui if wheel == mesh.j else mesh.uj
        line = v.minus(px, self.point(other, u))
        ri, rj = mesh.radii
        if wheel == mesh.i:
            line, (ri, rj) = v.times(-1.0, line), (rj, ri)
        phi = self.angle_near(line, "line", mesh.rows[0])
        theta = (mesh.target + (ri + rj) * phi - ri * self.turn_of(other)) / rj
        self.turn[wheel] = theta
        r = v.rotate_back(self.part[y][wheel][0], (theta.cos(), theta.sin()))
        return r, v.minus(px, v.rotate(r, self.point(ly, uy)))

    def triples(self) -> bool:
        for a in sorted(self.part, key=lambda k: k != self.owner[self.ground]):
            for b, c in combinations(sorted(self.near[a]), 2):
                if c in self.near[b] and self.triple(a, b, c):
                    return True
        return False

    def triple(self, a: int, b: int, c: int) -> bool:
        sides = [(min(p), max(p)) for p in combinations((a, b, c), 2)]
        kinds = {pair: _kind(self.between[pair]) for pair in sides}
        slides = [pair for pair, kind in kinds.items() if kind == "slide"]
        if None in kinds.values() or len(slides) > 2:
            return False
        if len(slides) == 2:
            self.two_slides(slides, next(p for p in kinds if p not in slides))
        elif slides:
            self.one_slide(slides[0], next(k for k in (a, b, c) if k not in slides[0]))
        else:
            x, y, z = self.base(a, b, c)
            self.three_pins(x, y, z)
        return True

    def three_pins(self, x: int, y: int, z: int) -> None:
        (a, ya), (b, zb), (yc, zc) = self.pins(x, y), self.pins(x, z), self.pins(y, z)
        d, p, q = v.minus(b, a), v.minus(yc, ya), v.minus(zc, zb)
        d2, p2, q2 = v.dot(d, d), v.dot(p, p), v.dot(q, q)
        if self.longer(p2, q2):
            self.three_pins(x, z, y)
            return
        foot = 0.5 * d2 + 0.5 * (p2 - q2)
        area = self.root(p2 * d2 - foot * foot, p2 * d2)  # twice that of the triangle of d, p and q
        self.add_doubt(
            area * area - DEAD * p2 * q2
        )  # of a short d neither angle at its ends is that between p and q
        over = 1.0 / d2
        along, aside = over * foot, over * area

        def legs(sign: Scalar) -> tuple[Pair, Pair]:
            e = v.plus(v.times(along, d), v.times(sign * aside, v.across(d)))
            return e, v.minus(e, d)

        def sides(sign: Scalar) -> tuple[Pair, Pair]:
            e, s = legs(sign)
            return self.onto(p, p2, e), self.onto(q, q2, s)

        self.choose_rotation(lambda sign: sides(sign)[0], x, y)
        self.set_cross_product(*legs(self.sign), self.sign * area)
        ry, rz = sides(self.sign)
        self.join(x, (y, (ry, v.minus(a, v.rotate(ry, ya)))), (z, (rz, v.minus(b, v.rotate(rz, zb)))))

    def one_slide(self, slide: tuple[int, int], y: int) -> None:
        """Parts x and z slide on each other; y has a pin on each."""
        x, z = self.base(*slide)
        turn = next(r for r in self.between[slide] if r.kind == "turn")
        along = next(r for r in self.between[slide] if r.kind == "along")
        rz = self.rotation(turn, z)
        n, c = self.line(along, z, rz)
        (a, ya), (b, yb) = self.pins(x, y), self.pins(z, y)
        p = v.minus(yb, ya)
        k = c + v.dot(n, v.minus(v.rotate(rz, b), a))
        p2 = v.dot(p, p)
        h = self.root(p2 - k * k, p2)

        def side(sign: Scalar) -> Pair:
            return v.plus(v.times(k, n), v.times(sign * h, v.across(n)))

        def rotation(sign: Scalar) -> Pair:
            return self.onto(p, p2, side(sign))

        ry = self.choose_rotation(rotation, x, y)
        at = v.plus(a, side(self.sign))
        self.join(x, (z, (rz, v.minus(at, v.rotate(rz, b)))), (y, (ry, v.minus(a, v.rotate(ry, ya)))))

    def two_slides(self, slides: list[tuple[int, int]], pin: tuple[int, int]) -> None:
        """Part x slides on y and on z, which are pinned together: all angles are known, the rest is linear."""
        x = next(k for k in slides[0] if k in slides[1])
        y, z = (next(k for k in pair if k != x) for pair in slides)
        rotations, lines = [], []
        for k, pair in ((y, slides[0]), (z, slides[1])):
            rotations.append(self.rotation(next(r for r in self.between[pair] if r.kind == "turn"), k))
            lines.append(
                self.line(next(r for r in self.between[pair] if r.kind == "along"), k, rotations[-1])
            )
        yc, zc = self.pins(y, z)
        (n1, c1), (n2, c2) = lines  # of the translations; of the common pin:
        c1 = c1 + v.dot(n1, v.rotate(rotations[0], yc))
        c2 = c2 + v.dot(n2, v.rotate(rotations[1], zc))
        det = v.cross(n1, n2)
        self.regular(det)
        at = (c1 * n2[1] - c2 * n1[1]) / det, (n1[0] * c2 - n2[0] * c1) / det
        first = rotations[0], v.minus(at, v.rotate(rotations[0], yc))
        second = rotations[1], v.minus(at, v.rotate(rotations[1], zc))
        self.join(x, (y, first), (z, second))

    def pinned_twice(self) -> bool:
        """Joins a part with two pins on the ground's part, other joints of which repeat a condition."""
        ground = self.owner[self.ground]
        for y in self.part.keys() - {ground} if self.m.dependent else ():
            pins = [
                r for r in self.todo if r.kind == "meet" and {self.owner[r.i], self.owner[r.j]} == {ground, y}
            ]
            if len(pins) < 2 or self.tied & self.part[y].keys():
                continue
            (a, ya), (b, yb) = ([self.point(*end) for end in self.ends(r, y)] for r in pins[:2])
            line, span = v.minus(yb, ya), v.minus(b, a)
            length2 = v.dot(line, line)
            if self.longer(length2, 0.0):
                # equality of their lengths is not yet checked
                size: Any = np.sqrt(length2 * v.dot(span, span))  # type: ignore[arg-type]  # of nodes too
                rotation = v.rotate_back(v.times(1.0 / size, line), span)
                self.merge(ground, y, (rotation, v.minus(a, v.rotate(rotation, ya))))
                return True
        return False

    def general(self) -> None:
        """Newton for the fewest links that can be placed together."""
        links = self.smallest()
        ground = self.owner[self.ground]
        self.m.placed = set(self.part[ground])
        solution = newton(self.m, self.pose(partial=True), links)
        self.out.doubt += solution.doubt
        for link in links:
            self.part.pop(self.owner[link], None)
        for link in links:
            self.owner[link] = ground
            point, rotation = solution.pose.point[link], solution.pose.rotation[link]
            self.part[ground][link] = ((rotation[0], rotation[1]), (point[0], point[1]))
            self.turn[link] = solution.pose.turn[link]
        self.find_between()

    def smallest(self) -> list[int]:
        """Links of the first block of parts that depends on nothing unplaced."""
        return sorted(link for p in self.blocks()[0] for link in self.part[p])


def _kind(relations: list[Relation]) -> str | None:
    """pin, slide, or None for any other connection of the two parts."""
    kinds = sorted(r.kind for r in relations)
    if "meet" in kinds:
        return "pin"
    return "slide" if "turn" in kinds and "along" in kinds else None


def positions(motion: TracePlan) -> PlacedPose:
    """Poses of all links from the drives' positions."""
    return Groups(motion).grow()


def newton_correction(motion: TracePlan) -> PlacedPose:
    """Poses of all links where the known motion is the solution: a last step of Newton carries the derivatives."""
    parts = Parts(motion)
    motion.placed = {parts.ground}
    solution = newton(motion, parts.pose(partial=True), list(range(parts.ground)), steps=0)
    return PlacedPose(solution.pose, doubt=solution.doubt)
