/** Check of every number, typed, dragged or from an address: finite, within the model's bounds and its range. */

import type { Data, NumberField, Required } from "./data";
import type { Kernel } from "./kernel";
import { fill, quoted, read, Refused } from "./reading";
import { figures } from "./svg";

export class Gate {
  /** Sentence of the last refusal, with the number's name; empty if nothing was refused. */
  sentence = "";
  private readonly accepted: Float64Array;
  private readonly out: Float64Array;
  constructor(private readonly data: Data, private readonly kernel: Kernel) {
    this.accepted = kernel.values.slice();
    this.out = new Float64Array(kernel.here.length);
    if (data.limits.length) kernel.at(0);
  }

  /** Sets a number from typed text; returns the message if it is invalid, and then the number is unchanged. */
  type(n: number, text: string): string {
    const field = this.data.numbers[n];
    try {
      const value = read(text, field, this.data.reading);
      this.check(field, value, quoted(text.trim()));
      this.kernel.values[n] = value;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      return error.message;
    }
    const said = this.pass() ? "" : this.sentence;
    this.sentence = ""; // it stands beside the field
    return said;
  }

  /** Accepts the numbers as they are, those of a parameter within its range; if any is invalid, all are restored. */
  pass(): boolean {
    const { numbers } = this.data, u = this.kernel.values;
    this.sentence = "";
    numbers.forEach((field, n) => {
      if (u[n] === this.accepted[n]) return;
      if (field.range && Number.isFinite(u[n])) u[n] = Math.min(Math.max(u[n], Math.min(field.range[0], field.value)), Math.max(field.range[1], field.value));
      try {
        this.check(field, u[n], this.words(field, u[n]));
      } catch (error) {
        this.sentence ||= `${field.label}: ${(error as Error).message}`;
      }
    });
    this.sentence ||= this.following();
    if (this.sentence) u.set(this.accepted);
    else this.accepted.set(u);
    return !this.sentence;
  }

  /** The file's numbers with some replaced, one at a time, in the assembly that they give; refused ones are left
   * out. */
  change(to: Record<string, number>): void {
    const u = this.kernel.values, { numbers } = this.data;
    let said = "";
    this.accept(Float64Array.from(numbers, (f) => f.value));
    numbers.forEach((f, n) => {
      if (to[f.path] === undefined || Number.isNaN(to[f.path])) return;
      u[n] = to[f.path];
      if (!this.pass()) said ||= this.sentence;
    });
    const pose = this.data.sketch.assembly.map((path) => to[path]);
    this.kernel.motion.assume(pose.length && pose.every(Number.isFinite) ? pose : null);
    this.sentence = said;
  }

  /** Restores numbers that were accepted before. */
  accept(values: Float64Array): void {
    this.kernel.values.set(values);
    this.accepted.set(values);
    this.sentence = "";
  }

  private check(field: NumberField, value: number, text: string): void {
    const { sentences } = this.data.reading, range = field.range;
    if (!Number.isFinite(value)) throw new Refused(fill(sentences.finite, { text }));
    const problem = this.unmet(field, value, text);
    if (problem) throw new Refused(problem);
    if (range && value !== field.value && (value < range[0] || value > range[1]))
      throw new Refused(fill(sentences.range, { text, low: this.words(field, range[0]), high: this.words(field, range[1]) }));
  }

  /** Message for an invalid value that depends on parameters. */
  private following(): string {
    const { limits } = this.data, u = this.kernel.values;
    if (!limits.length || u.every((x, n) => x === this.accepted[n])) return "";
    this.kernel.other(u, this.out);
    for (const { row, path, ...required } of limits) {
      const value = this.out[row], place = path.lastIndexOf(".");
      const problem = this.unmet(required, value, Number.isInteger(value) ? value.toFixed(1) : String(value));
      if (problem) return `${path.slice(0, place)}: ${path.slice(place + 1)}: ${problem}`;
    }
    return "";
  }

  /** Message for a value whose sign is wrong, or that counts things and is no integer. */
  private unmet({ sign, counts }: Required, value: number, text: string): string {
    const { sentences, signs } = this.data.reading;
    if (sign && (value < 0 || (sign === "positive" && value === 0))) return fill(signs[sign], { text });
    return counts && !Number.isInteger(value) ? fill(sentences.count, { what: counts }) : "";
  }

  private words(field: NumberField, value: number): string {
    return `${figures(value / field.size, 6).replace("–", String(value))}${field.unit === "°" ? "" : " "}${field.unit}`.trim();
  }
}
