/** What a drawing reads: rows of numbers over the positions and at one place. The kernel of a page, or a sketch. */

export interface Source {
  /** Outputs at the place that is shown, by row. */
  readonly here: Float64Array;
  readonly count: number;
  /** True while numbers are dragged: the place that is shown is of the present ones, the cycle follows some frames later,
   * and long curves are drawn with fewer points. */
  readonly coarse?: boolean;
  /** 1 at each position that has numbers. */
  readonly good: Uint8Array;
  /** True if the cycle continues from its last position to its first. */
  readonly cyclic: boolean;
  /** True if everything that is drawn is a number at the place; true if its forces are answers too. */
  readonly finite: boolean;
  readonly solved: boolean;
  value(row: number, k: number): number;
  reverses(k: number): boolean;
  onceAfter<T>(of: () => T): T;
  largest(of: (k: number) => number): number;
}
