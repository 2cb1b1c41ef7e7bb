/** Points fixed in links: from a place on paper to the axes of a link, and their places along the cycle. */

import type { Rows } from "./data";
import type { Paper } from "./items";
import type { Source } from "./source";
import type { Point } from "./svg";

export class Material {
  /** ``poses``: by link the rows of the origin and of the unit vectors of its axes. */
  constructor(readonly links: string[], private readonly poses: Rows[], private readonly source: Source) {}

  private axes(link: number, value: (row: number) => number): { at: number[]; axes: number[][] } {
    const rows = this.poses[link].map(value), d = rows.length === 12 ? 3 : 2;
    return { at: rows.slice(0, d), axes: Array.from({ length: d }, (_, k) => rows.slice(d + d * k, d + d * k + d)) };
  }

  /** The place of a point, metres; values of rows at the place that is shown, or by a function. */
  place(link: number, u: number[], value = (row: number): number => this.source.here[row]): number[] {
    const { at, axes } = this.axes(link, value);
    return at.map((x, c) => axes.reduce((sum, axis, k) => sum + (u[k] ?? 0) * axis[c], x));
  }

  /** On paper at position k. */
  on(paper: Paper, link: number, u: number[], k: number): Point {
    return paper.of(...paper.project(this.place(link, u, (row) => this.source.value(row, k))));
  }

  /** The point of a link, in its axes, at a place on paper; in space in the plane of the picture through its origin. */
  local(paper: Paper, link: number, [x, y]: Point): number[] {
    const { at, axes } = this.axes(link, (row) => this.source.here[row]), [ox, oy] = paper.of(...paper.project(at));
    const arm = paper.vector([x - ox, y - oy]);
    return axes.map((axis) => axis.reduce((sum, a, c) => sum + a * arm[c], 0));
  }
}
