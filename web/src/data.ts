/** The data of a page, as `dalembert.pages.page_data` writes it. A row is an index into the kernel's outputs; a
 * number is an index into the numbers of the description. SI and radians. */

/** Rows of a point or vector: two in the plane, three in space. */
export type Rows = number[];
export type Pair = [number, number];
/** Values along the positions: even steps, or the bytes of 64-bit numbers. */
export type Series = string | { from: number; to: number; count: number };
export interface Table { drive: string; breaks: string; pieces: string; order: number; period: number | null }
export interface Channel { name: string; values: Series; table?: Table }
export interface Module { wasm: string; heap: number; row: number; count: number; outputs: number; channels: string[] }
export interface NumberField extends Required {
  path: string; label: string; value: number; unit: string; size: number;
  parameter?: boolean; about?: string; range?: Rows; kind: string;
}
/** Requirements of the model on a number: its sign; an integer where it counts things. */
export interface Required { sign?: Sign; counts?: string }
/** Sign that the model requires of a number. */
export type Sign = "positive" | "not negative";
/** How numbers are read: units by name (SI value = number * first / second, then powers), kinds, Python's sentences. */
export interface Reading {
  units: Record<string, number[]>; sentences: Record<string, string>; signs: Record<Sign, string>;
  kinds: Record<string, { phrase: string; dimension: number[]; remedy: string; units: string; per_radian?: boolean; force?: boolean }>;
}
/** A placeholder in the saved text: the former text, the numbers it depends on, and its replacement once one has
 * changed: text, or a number with the size of its unit. Those after the numbers belong to the assembly. */
export interface Place { was?: string; of?: number[]; now: (string | Pair)[] }
export interface Drive { name: string; unit: string; size: number; position: Series; turns: boolean; along?: Rows; p: Rows; link: string }

/** A drawn item: a symbol at a point, a stretched symbol between two, a hull, a path, a trace, a circle, an arc about its
 * first point from the second to the third; ``of``: what it is part of, by kind and name. ``size``: radius and half length in metres of a wheel or a worm; without it a pair of
 * links has the size of a symbol. */
export type Item = { of?: [string, string] } & (
  | { t: "symbol"; svg: string; p: Rows; e?: Rows; per_mm?: number }
  | { t: "pair"; shape: "round" | "block" | "ball"; p: Rows; e: Rows; fixed: boolean; size?: Pair }
  | { t: "span"; svg: string; length: number; p: [Rows, Rows] }
  | { t: "hull"; role: string; p: Rows[]; link: string }
  | { t: "path"; role: string; p: Rows[] }
  | { t: "arc"; role: string; p: Rows[]; ccw: boolean }
  | { t: "trace"; role: string; p: [Rows] }
  | { t: "circle"; role: string; p: Rows; r: number });
/** Velocity and acceleration of a joint's point or a mass centre. */
export interface Rate { of: [string, string]; p: Rows; v: Rows; a: Rows }
interface Acting { role: string; of: string; kind: string; link: string; name: string; p: Rows }
export interface Force extends Acting { t: "force"; f: Rows }
/** In the plane a curved arrow, in space one with two heads along its axis. */
export interface Couple extends Acting { t: "couple" | "moment"; m: Rows }
export type Action = Force | Couple;
export interface Label { text: string; p: Rows; q?: Rows; role: string; kind: string; link?: string }
export interface Term { name: string; f: Rows; m: Rows }
export interface Drawing { per_mm: number; items: Item[]; labels: Label[]; arrows: Action[]; force: number }
export interface FreeBody extends Drawing {
  link: string; title: string; member: string; about: Rows[]; equations: { about: string; terms: Term[] };
}
export interface Curve { row: number; name: string; role: string; of: string; f?: Pair }
export interface Chart { title: string; kind: string; curves: Curve[] }
export interface Polygon { link: string; title: string; sides: Force[] }
export interface TableRow { name: string; kind: string; rows: number[] }

/** Numbers of a point in axes whose origin and unit vectors are rows. */
export interface End { n: number[]; at: Rows; axes: Rows[] }
export type Handle =
  | { kind: "joint" | "point" | "center"; name: string; p: Rows; ends: End[]; by?: number[]; about?: Rows }
  | { kind: "load"; name: string; p: Rows; f: Rows; axes: Rows[]; components?: number[]; size?: number; direction?: number }
  | { kind: "direction"; name: string; p: Rows; along: Rows; direction: number; axes: Rows[] };

/** A row that is held, between links i and j (the ground's number is that of the moving links): a constraint, a
 * phase of meshing wheels, a freedom; outputs of the closure program. */
export interface SketchRow { kind: "constraint" | "phase" | "freedom"; joint: string; ends: Pair; angular: boolean; value: number; period?: number; count?: number }
/** Closing of the linkage and its motion: see `pages/sketch_data.py`. */
export interface SketchData {
  dimension: 2 | 3; length: number; links: string[]; order: number[];
  rows: SketchRow[]; entries: number[]; turns: number[]; drives: number[]; closure: Module;
  pose: { point: number[]; rotation: number[]; turn: number[] }; place: number;
  course: number[]; places: number[]; cycle?: number[]; counted: Record<string, number>; assembly: string[];
  shown: Module; branches: string[]; known: string[]; drawn: number[];
  gaps: { joint: string; p: number[]; q: number[] }[]; poses: number[][];
}

/** Sentences of the analyses, with the rows that fill them: see `pages/messages/position_sentences.py`. */
export interface Sentences {
  templates: Record<string, string>; words: { [name: string]: any; kinds: Record<"length" | "angle", { what: string; how: string }> };
  limits: { shut: number; alike: number }; units: Record<string, { unit: string; size: number }>; joints: string[];
  overflow: Record<string, [string, ...number[]][]>; unknowns: { name: string; kind: string; row: number; single?: boolean }[];
  contacts: { joint: string; row: number }[]; gears: { sentence: string; rows: number[]; error: number }[];
}

export interface Data {
  format: string; version: string; title: string; source: string;
  units: Record<string, { unit: string; size: number }>;
  noise: { force: number; moment: number };
  kernel: Module; channels: Channel[]; only_at_positions: boolean;
  /** Place of the cycle with which the file begins. */
  start: number;
  gradient?: Module & { curves: number[]; numbers: number[] };
  numbers: NumberField[]; limits: ({ row: number; path: string } & Required)[]; reading: Reading; template: (string | Place)[]; drives: Drive[]; handles: Handle[]; sketch: SketchData;
  views: {
    mechanism: Drawing & { middle?: Pair }; bodies: FreeBody[];
    polygons: { links: Polygon[]; chain: number[] }; charts: Chart[]; table: TableRow[]; rates: Rate[];
  };
  sentences: Sentences;
  statuses: { status: string; sentence: string; numbered: boolean }[];
  assumptions: Record<string, string>;
  style: { light: string; dark: string };
}

/** A mechanism that is not finished: its links and joints can be pulled. See `pages/unfinished/sketch_page.py`. */
export interface Offer { kind: string; said: string; text: string; page?: string }
export interface SketchPageData {
  format: string; version: string; title: string; units: Data["units"]; style: Data["style"];
  sketch: Pick<SketchData, "dimension" | "length" | "links" | "order" | "rows" | "entries" | "turns" | "drives" | "closure" | "pose">;
  shown: Module; poses: Rows[]; points: { link: string; point: string; p: Rows }[]; gaps: { joint: string; p: Rows; q: Rows }[];
  views: { mechanism: Drawing & { middle?: Pair } };
  missing: { sentence: string; offers: Offer[] }; text: string;
}
