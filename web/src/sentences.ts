/** Reasons why a place has no answer, in the sentences of the analyses: location, range, remaining gap. */

import type { Data, Sentences } from "./data";
import type { Kernel } from "./kernel";
import { fill } from "./reading";
import type { Pose } from "./sketch";

/** A number to some figures as Python writes it: `.6g`. */
export function general(x: number, figures = 6): string {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? "nan" : x > 0 ? "inf" : "-inf";
  const [digits, power] = x.toExponential(figures - 1).split("e"), e = +power, bare = (s: string) => (s.includes(".") ? s.replace(/\.?0+$/, "") : s);
  if (e < -4 || e >= figures) return `${bare(digits)}e${e < 0 ? "-" : "+"}${String(Math.abs(e)).padStart(2, "0")}`;
  return bare(x.toFixed(Math.max(figures - 1 - e, 0)));
}

const listed = (names: string[]): string => (names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`);

export class Reasons {
  private readonly s: Sentences;
  /** The last sentence, and its place: gaps are measured once. */
  private said = { key: "", text: "" };
  constructor(private readonly data: Data, private readonly kernel: Kernel) {
    this.s = data.sentences;
  }

  /** Reason why the analyses would refuse the present mechanism; empty if they do not. */
  refusal(): string {
    for (const { sentence, rows, error } of this.s.gears) {
      const [found, ri, rj] = rows.map((r) => this.kernel.here[r]), wanted = ri + rj;
      if (Math.abs(found - wanted) > error * wanted)
        return fill(sentence, { found: general(found), ri: general(Math.abs(ri)), rj: general(Math.abs(rj)), wanted: general(wanted) });
    }
    return "";
  }

  /** The sentence of a place of the cycle; empty where it is solved. */
  at(t: number): string {
    const { kernel, s } = this, { status, sentence } = this.data.statuses[kernel.mark];
    if (kernel.refused) return kernel.refused;
    const template = s.templates[status];
    if (!template || status === "ok") return sentence;
    const run = this.run(t), key = [status, run, kernel.values].join();
    if (this.said.key !== key) this.said = { key, text: status === "not_assembled" ? this.open(template, run) : fill(template, this.places(status, run, t)) };
    return this.said.text;
  }

  /** The first and last positions of the run about a place with its status code; or the place itself if no
   * position has it. */
  private run(t: number): [number, number] {
    const { kernel } = this, same = (k: number): boolean => k >= 0 && k < kernel.count && kernel.markAt(k) === kernel.mark;
    const k = [Math.round(t), Math.floor(t), Math.ceil(t)].find(same);
    if (k === undefined || this.data.statuses[kernel.mark].status === "reversal") return [t, t];
    let [low, high] = [k, k];
    while (same(low - 1)) low--;
    while (same(high + 1)) high++;
    return [low, high];
  }

  private places(status: string, run: [number, number], t: number): Record<string, string> {
    const arc = this.arc(run), at = this.arc([run[0], run[0]]), one = { arc, at, side: "", span: arc.trim() || this.s.words.described };
    if (status === "overflow") return { ...one, whose: this.whose() };
    if (status === "self_locking") return { ...one, figures: this.figures(run, t) };
    const { kernel, s } = this, names = s.unknowns.map((u) => u.name), moved = s.contacts.filter((c) =>
      status === "reversal" ? kernel.here[c.row] !== kernel.hereAfter[c.row] : kernel.here[c.row] === 0);
    const joints = [...new Set(moved.map((c) => c.joint))];
    const values = s.unknowns.map((u) =>
      fill(s.words.sides, { name: u.name, before: this.quantity(kernel.here[u.row], u.kind), after: this.quantity(kernel.hereAfter[u.row], u.kind) }));
    const verb = joints.length === 1 ? "reverses" : "reverse", whose = joints.length === 1 ? "its" : "their";
    return { ...one, joints: status === "reversal" ? listed(joints) : joints.join(", "), verb, whose, values: listed(values), name: names[0] ?? "", intervals: this.intervals() };
  }

  /** Which unknowns lie in an interval at rest, and which have one value whatever the friction. */
  private intervals(): string {
    const of = (single: boolean): string[] => this.s.unknowns.filter((u) => !!u.single === single).map((u) => u.name);
    const wide = of(false), single = of(true);
    return [
      ...(wide.length ? [`${listed(wide)} ${wide.length === 1 ? "lies" : "each lie"} in an interval`] : []),
      ...(single.length ? [`${listed(single)} ${single.length === 1 ? "does" : "do"} not depend on it`] : []),
    ].join("; ");
  }

  /** The unknowns with and without friction at their largest difference; nothing if coefficients depend on other
   * numbers. */
  private figures(run: [number, number], t: number): string {
    const { kernel, s, data } = this, bare = kernel.values.slice(), out = new Float64Array(kernel.here.length);
    const coefficients = data.numbers.flatMap((n, k) => (/(^|\.)friction\.coefficient$/.test(n.path) ? [k] : []));
    if (!coefficients.length || data.numbers.some((n) => n.parameter)) return "";
    for (const k of coefficients) bare[k] = 0;
    let most = -1, at = run[0], figures = "";
    for (let k = run[0]; k <= run[1]; k++) {
      kernel.at(k);
      kernel.other(bare, out);
      const off = s.unknowns.reduce((sum, { row }) => sum + Math.abs(kernel.here[row] - out[row]), 0);
      if (!(off > most)) continue;
      [most, at] = [off, k];
      figures = s.unknowns.map(({ name, kind, row }) =>
        fill(s.words.needs, { name, rubbed: this.quantity(kernel.here[row], kind), bare: this.quantity(out[row], kind) })).join(", ");
    }
    kernel.at(t);
    return `;${run[0] === run[1] ? "" : this.arc([at, at])} ${figures}`;
  }

  private quantity(value: number, kind: string, figures = 6): string {
    const { unit, size } = this.s.units[kind];
    return `${general(value / size, figures)} ${unit}`;
  }

  private drive(d: Data["drives"][number], t: number): string {
    return this.quantity(this.kernel.position(d.name, t), d.turns ? "angle" : "length");
  }

  /** ' between 0 deg and 9 deg of O2', or ' at O2 = 9 deg'. */
  private arc([from, to]: [number, number]): string {
    const { drives } = this.data;
    if (!drives.length) return "";
    if (from === to) return ` at ${drives.map((d) => `${d.name} = ${this.drive(d, from)}`).join(" and ")}`;
    return ` between ${drives.map((d) => `${this.drive(d, from)} and ${this.drive(d, to)} of ${d.name}`).join(", ")}`;
  }

  /** Least remaining gap in the middle of a run; if it is zero, the reason why the motion does not get there. */
  private open(template: string, [from, to]: [number, number]): string {
    const middle = from === to ? from : from + ((to - from + 1) >> 1), { pose, gaps } = this.kernel.motion.open(middle);
    const order = (name: string): number => this.s.joints.indexOf(name), span = this.arc([from, to]).trim() || this.s.words.described;
    gaps.sort((a, b) => order(a.joint) - order(b.joint));
    const lengths = this.most(gaps.map((g) => [g.joint, g.length]), "length", this.data.sketch.length);
    const parts = [lengths, this.most(gaps.map((g) => [g.joint, g.angle]), "angle", 1)].filter(Boolean);
    if (!parts.length) return this.loose(pose) || fill(this.s.words.unfollowed, { span });
    const there = from !== to && this.data.drives.length ? `${this.arc([middle, middle]).trim()} ` : "";
    return fill(template, { span, gap: `: ${there}${parts.join(" and ")}`, datum: lengths ? "a length" : "a direction" });
  }

  /** Links that still move with all drives at rest; empty if none. In the plane. */
  private loose(pose: Pose): string {
    const { drives, sketch } = this.data, found = this.kernel.motion.sketch.mobility(pose), missing = found.freedoms - drives.length;
    if (sketch.dimension !== 2 || missing <= 0) return "";
    const free = found.joints.slice(0, 6).map((r) => `${r.joint} (${r.angular ? "turn" : "slide"})`);
    const where = free.length ? ` at ${missing === 1 ? "one" : "some"} of ${free.join(", ")}` : "";
    const count = (k: number, noun: string, more = `${noun}s`): string => (k ? `${k} ${k > 1 ? more : noun}` : `no ${noun}`);
    const counts = fill(this.s.words.counts, { freedoms: count(found.freedoms, "degree of freedom", "degrees of freedom"), drives: count(drives.length, "drive") });
    return `${counts}; ${fill(this.s.words.add, { drives: count(missing, "drive"), where, loose: found.links.join(", ") })}`;
  }

  /** 'the points of joint B stay 12 mm apart', or for several the sum and the widest. */
  private most(open: [string, number][], kind: "length" | "angle", size: number): string {
    const { words, limits } = this.s, wide = open.filter(([, x]) => x > limits.shut * size);
    if (!wide.length) return "";
    const [joint, largest] = wide.reduce((a, b) => (b[1] > a[1] ? b : a)), figure = this.quantity(largest, kind, 3);
    if (wide.length === 1) return fill(words.one, { ...words.kinds[kind], joint, figure });
    const alike = Math.min(...wide.map(([, x]) => x)) > limits.alike * largest;
    const where = alike ? fill(words.alike, { joints: wide.map(([name]) => name).join(", ") }) : fill(words.most, { joint, figure });
    return fill(words.several, { ...words.kinds[kind], total: this.quantity(open.reduce((t, [, x]) => t + x, 0), kind, 3), where });
  }

  /** Quantities that overflow: rates of links, else forces of joints. */
  private whose(): string {
    const { overflow, words } = this.s, value = (r: number): number => this.kernel.here[r];
    let said = "";
    for (const [what, of] of Object.entries(overflow)) {
      const names = of.filter(([, ...rows]) => !rows.every((r) => Number.isFinite(value(r) * value(r)) || Number.isFinite(value(r)) && what !== Object.keys(overflow)[0])).map(([name]) => name);
      if (names.length) return fill(words.of, { what, names: names.join(", ") });
      said = fill(words.checks, { what });
    }
    return said;
  }
}
