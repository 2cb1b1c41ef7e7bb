/** The data of a page, as `dalembert.pages.page_data` writes it. A row is a place among the kernel's outputs; a number
 * is a place among the numbers of the description. SI and radians. */

/** Rows of a point or vector: two in the plane, three in space. */
export type Rows = number[];
export type Pair = [number, number];
/** Values along the positions: even steps, or the bytes of 64-bit numbers. */
export type Series = string | { from: number; to: number; count: number };
export interface Table { drive: string; breaks: string; pieces: string; order: number; period: number | null }
export interface Channel { name: string; values: Series; table?: Table }
export interface Module { wasm: string; heap: number; row: number; count: number; outputs: number; channels: string[] }
export interface NumberField {
  path: string; label: string; value: number; unit: string; size: number;
  parameter?: boolean; about?: string; range?: Rows;
}
export interface Drive { name: string; unit: string; size: number; position: Series; turns: boolean; along?: Rows; p: Rows; link: string }

/** Something drawn: a symbol at a point, a stretched symbol between two, a hull, a path, a trace, a circle. */
export type Item =
  | { t: "symbol"; svg: string; p: Rows; e?: Rows; per_mm?: number }
  | { t: "pair"; shape: "round" | "block" | "ball"; p: Rows; e: Rows; fixed: boolean }
  | { t: "span"; svg: string; length: number; p: [Rows, Rows]; load: string }
  | { t: "hull"; role: string; p: Rows[]; link: string }
  | { t: "path"; role: string; p: Rows[] }
  | { t: "trace"; role: string; p: [Rows]; joint: string }
  | { t: "circle"; role: string; p: Rows; r: number };
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
  | { kind: "joint" | "point" | "center"; name: string; p: Rows; ends: End[]; by?: number[] }
  | { kind: "load"; name: string; p: Rows; f: Rows; axes: Rows[]; components?: number[]; size?: number; direction?: number }
  | { kind: "direction"; name: string; p: Rows; along: Rows; direction: number; axes: Rows[] };

export interface Data {
  format: string; version: string; title: string; source: string;
  units: Record<string, { unit: string; size: number }>;
  noise: { force: number; moment: number };
  kernel: Module; channels: Channel[]; only_at_positions: boolean;
  gradient?: Module & { curves: number[]; numbers: number[] };
  numbers: NumberField[]; template: string[]; drives: Drive[]; handles: Handle[];
  views: {
    mechanism: Drawing & { middle?: Pair }; bodies: FreeBody[];
    polygons: { links: Polygon[]; chain: number[] }; charts: Chart[]; table: TableRow[];
  };
  statuses: { status: string; sentence: string; numbered: boolean }[];
  assumptions: Record<string, string>;
  style: { light: string; dark: string };
}
