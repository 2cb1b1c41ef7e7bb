/** What the server tells of the document: see `dalembert.studio.session` and `drawing`. Places are in m and rad. */

export type Point = [number, number];
export interface End { link: string; point: string }
/** A place, with the point of a link or the length and angle (in the file's unit, in degrees) that it snapped to. */
export interface Where { at: Point; link?: string; point?: string; polar?: [number, number] }
export interface DrawnLink { name: string; points: Record<string, Point>; pose: [number, number, number]; bar?: boolean; center?: Point; written: any }
export interface DrawnJoint {
  name: string; type: string; links: [string, string]; at: [string, string]; p: Point; q: Point; freedoms: string[]; written: any;
  direction?: number; radii?: [number, number]; radius?: number; here?: Record<string, number>;
}
export interface DrawnLoad { name: string; type: string; written: any; on?: string; p?: Point; vector?: Point | null; between?: [Point, Point]; links?: [string, string]; joint?: string }
export interface DrawnDrive { name: string; joint: string; written: any }
export interface Drawing {
  space?: boolean; title: string; units: Record<string, { unit: string; size: number }>; freedoms: number; closed: boolean;
  links: DrawnLink[]; joints: DrawnJoint[]; loads: DrawnLoad[]; drives: DrawnDrive[];
}
export interface State {
  text: string; hash: string; analysed: string; form: string; file: string; dirty: boolean; undo: boolean; redo: boolean; drawing: Drawing; error: string; line: number;
  static: boolean; friction: boolean; kept: boolean; outside: boolean;
}
export type Kind = "links" | "joints" | "loads" | "drives" | "points";
export interface Picked { kind: Kind; name: string; link?: string }

/** Points of links of the file, for snapping: those of a place in the order ground, then as in the file. */
export function* ends(d: Drawing): Generator<End & { at: Point }> {
  for (const l of d.links ?? []) if (l.written !== null || l.name === "ground") for (const [point, at] of Object.entries(l.points)) yield { link: l.name, point, at };
}
export const dist = (a: Point, b: Point): number => Math.hypot(a[0] - b[0], a[1] - b[1]);
/** Four figures, without an exponent where that is short. */
export const figures = (x: number, digits = 4): string => (Math.abs(x) < 1e-12 ? "0" : String(+x.toPrecision(digits)));
