/** Typed numbers, read like those of a model file: a number with or without a unit; or the message for an error. */

import type { NumberField, Reading } from "./data";

type Unit = { up: number; down: number; dimension: number[] };

/** An error: Python's sentence with its placeholders filled. */
export class Refused extends Error {}

export const fill = (sentence: string, places: Record<string, string>): string =>
  sentence.replace(/\{(\w+)\}/g, (whole, name) => places[name] ?? whole);

/** A text as messages quote it: a bare number unchanged, cut if it is long. */
export function quoted(text: string): string {
  if (/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text)) return text;
  const mark = text.includes("'") && !text.includes('"') ? '"' : "'", said = mark + text.replace(/\\/g, "\\\\") + mark;
  return said.length <= 60 ? said : said.slice(0, 57) + "...";
}

const PLAIN: Record<string, string> = { "²": "^2", "³": "^3", "·": "*", "⋅": "*", "×": "*", "−": "-" };

/** Reads the units of a text: names, products, quotients, whole powers, brackets. */
class UnitText {
  private readonly tokens: string[];
  constructor(private readonly text: string, private readonly reading: Reading, private readonly units: string) {
    let plain = text.replace(/[²³·⋅×−]/g, (c) => PLAIN[c]).replaceAll("**", "^");
    plain = plain.replace(/\b(ft|in)-lb\b/g, "$1*lbf").replace(/\blb-(ft|in)\b/g, "lbf*$1").replace(/(?<=[a-zµμ])[-.](?=[a-zµμ])/gi, "*");
    this.tokens = plain.match(/\d+|[a-zµμ_]+|[°%]|[-*/^()]|\S/gi) ?? [];
  }
  read(): Unit {
    const found = this.product(1);
    if (this.tokens.length) this.refuse(`unexpected ${quoted(this.tokens[0])}`);
    return found;
  }
  private refuse(why: string): never {
    throw new Refused(fill(this.reading.sentences.form, { unit: quoted(this.text), why }));
  }
  private product(depth: number): Unit {
    let found: Unit = { up: 1, down: 1, dimension: [0, 0, 0, 0] };
    if (this.tokens[0] === "1" && this.tokens[1] === "/") this.tokens.shift();
    else found = this.factor(1, found, depth);
    while (this.tokens.length && this.tokens[0] !== ")") {
      const sign = this.tokens[0] === "/" ? -1 : 1;
      if (/[*/]/.test(this.tokens[0])) this.tokens.shift();
      found = this.factor(sign, found, depth);
    }
    return found;
  }
  private factor(sign: number, product: Unit, depth: number): Unit {
    const token = this.tokens.shift();
    let inner: Unit;
    if (token === "(" && depth < 5) {
      inner = this.product(depth + 1);
      if (this.tokens.shift() !== ")") this.refuse("a bracket is not closed");
    } else if (token !== undefined && /^[a-zµμ_°%]/i.test(token)) inner = this.named(token);
    else return this.refuse(token === undefined ? "a name is missing" : `expected a name, not ${quoted(token)}`);
    let power = 1;
    if (this.tokens[0] === "^") {
      this.tokens.shift();
      const minus = (this.tokens[0] as string) === "-" && this.tokens.shift() !== undefined, digits = this.tokens.shift() ?? "";
      if (!/^[1-6]$/.test(digits)) throw new Refused(fill(this.reading.sentences.power, { unit: quoted(this.text) }));
      power = minus ? -digits : +digits;
    }
    const [up, down] = sign * power < 0 ? [inner.down, inner.up] : [inner.up, inner.down];
    return {
      up: product.up * up ** Math.abs(power), down: product.down * down ** Math.abs(power),
      dimension: product.dimension.map((x, k) => x + sign * power * inner.dimension[k]),
    };
  }
  private named(name: string): Unit {
    const known = Object.hasOwn(this.reading.units, name) ? this.reading.units[name] : null;
    if (!known) throw new Refused(fill(this.reading.sentences.no_unit, { unit: quoted(name), units: this.units }));
    const [up, down, ...dimension] = known;
    return { up, down, dimension };
  }
}

/** The SI value of a text; a bare number is in the unit shown beside the field. Throws Refused. */
export function read(text: string, field: NumberField, reading: Reading): number {
  const { kinds, sentences } = reading, kind = kinds[field.kind] ?? kinds.number;
  const said = text.trim(), match = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*)$/is.exec(said.replaceAll("−", "-"));
  const places = { text: quoted(said), phrase: kind.phrase, remedy: kind.remedy };
  const refuse = (sentence: string, more: Record<string, string> = {}): never => {
    throw new Refused(fill(sentence, { ...places, ...more }));
  };
  if (!match) return refuse(sentences.number);
  const [, number, rest] = match;
  if (/^,\s*\d/.test(rest)) return refuse(sentences[/^,\d{3}(?!\d)/.test(rest) ? "thousands" : "comma"], { point: said.replace(",", "."), plain: said.replaceAll(",", "") });
  if (/^[\d/]/.test(rest) && !/^1\/[^\W\d]/.test(rest)) return refuse(sentences.several);
  const finite = (x: number): number => (Number.isFinite(x) ? x : refuse(sentences.finite));
  if (!rest || rest === field.unit) return finite(+number * field.size);
  const unit = new UnitText(rest, reading, kind.units).read(), dimension = [...unit.dimension];
  if (kind.per_radian && dimension[3] === 0) dimension[3] = kind.dimension[3];
  if (dimension.some((x, k) => x !== kind.dimension[k])) {
    const given = Object.values(kinds).find((one) => one.dimension.every((x, k) => x === unit.dimension[k]))?.phrase ?? inWords(unit.dimension);
    if (/\blb\b/.test(rest) && kind.force) return refuse(sentences.dimension, { given, remedy: fill(sentences.pounds.split("; ")[1], { unit: rest.replaceAll("lb", "lbf") }) });
    const turns = field.kind === "angular_speed" && String(unit.dimension) === "0,0,-1,0";
    return refuse(sentences.dimension, { given, ...(turns ? { remedy: sentences.hertz.split("; ").slice(1).join("; ") } : {}) });
  }
  return finite((+number * unit.up) / unit.down);
}

function inWords(dimension: number[]): string {
  const parts = ["m", "kg", "s", "rad"].flatMap((name, k) => (dimension[k] ? [name + (dimension[k] === 1 ? "" : `^${dimension[k]}`)] : []));
  return `in ${parts.join("*")}`;
}
