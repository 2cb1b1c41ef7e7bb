/** The sign of each branch of the linkage's closed forms, read from its poses, and the kernel's inputs that follow. */

import type { SketchData } from "./data";
import type { Closing } from "./motion";
import { Between } from "./poses";
import type { Program } from "./program";
import type { Pose } from "./sketch";

export class Branches {
  /** Sign of each branch (1 or -1) at every position. */
  readonly of: Float64Array[];
  /** Those used where nothing is reached. */
  model: Float64Array;
  /** The drives at each position. */
  private readonly driven: number[][];
  private readonly channels: { kind: "pose" | "position" | "branch" | "given"; part: keyof Pose; k: number; given: Float64Array }[];

  constructor(private readonly data: SketchData, drives: string[], private readonly kernel: Closing, private readonly shown: Program, private readonly values: Float64Array, private readonly inputs: (name: string) => Float64Array, count: number) {
    this.driven = Array.from({ length: count }, (_, k) => kernel.drives(k));
    this.of = data.branches.map(() => new Float64Array(count).fill(1));
    this.model = new Float64Array(data.branches.length).fill(1);
    this.channels = shown.module.channels.map((name) => {
      const [kind, part, k] = name.split(" "), branch = data.branches.indexOf(name);
      if (kind === "pose") return { kind, part: part as keyof Pose, k: +k, given: values };
      if (kind === "position") return { kind, part: "turn", k: drives.indexOf(name.slice(9)), given: values };
      return { kind: branch < 0 ? "given" : "branch", part: "turn", k: branch, given: branch < 0 ? inputs(name) : values };
    });
  }

  /** The branches of a pose at a place of the cycle, each from the previous ones. */
  read(pose: Pose, t: number): Float64Array {
    const out = new Float64Array(this.of.length).fill(1);
    for (let n = 0; n < out.length; n++) out[n] = this.look(pose, t, out).at(n) < 0 ? -1 : 1;
    return out;
  }

  /** Evaluates the program of a pose's known quantities. */
  look(pose: Pose, t: number, branch: Float64Array): Program {
    const p = this.shown, drives = this.kernel.drives(t);
    p.values.set(this.values);
    this.channels.forEach((c, n) =>
      p.put(n, c.kind === "pose" ? pose[c.part][c.k] : c.kind === "position" ? drives[c.k] : c.kind === "branch" ? branch[c.k] : c.given[0]));
    p.call(1);
    return p;
  }

  /** The kernel's inputs over all positions: branches and known motion of the reached poses, the model's elsewhere. */
  spread(model: Float64Array, reached: (Pose | null)[], spare: Pose): void {
    const p = this.shown, { row } = p, n = reached.length;
    this.model = model;
    p.values.set(this.values);
    const poses = reached.map((q) => q ?? spare), { path } = p;
    this.channels.forEach(({ kind, part, k: place, given }, at) => {
      const from = at * row;
      if (kind === "pose") for (let k = 0; k < n; k++) {
        const q = poses[k];
        path[from + k] = q instanceof Between ? q.value(part, place) : q[part][place];
      }
      else if (kind === "position") for (let k = 0; k < n; k++) path[from + k] = this.driven[k][place];
      else if (kind === "given") path.set(given.subarray(0, n), from);
    });
    // Each branch depends on those before it only: once no sign changes, all are as if read one after the other.
    for (let changed = true, left = this.of.length + 1; changed && left; left--) {
      this.channels.forEach((c, at) => c.kind === "branch" && p.path.set(this.of[c.k], at * row));
      p.call(n);
      changed = false;
      this.of.forEach((of, b) => {
        for (let k = 0; k < n; k++) {
          const sign = !reached[k] ? model[b] : p.at(b, k) < 0 ? -1 : 1;
          changed ||= sign !== of[k];
          of[k] = sign;
        }
      });
    }
    this.of.forEach((of, b) => this.inputs(this.data.branches[b]).set(of));
    this.data.known.forEach((name, i) => {
      const of = this.inputs(name);
      for (let k = 0; k < n; k++) of[k] = reached[k] ? p.at(this.of.length + i, k) : NaN;
    });
  }
}
