/** What the mouse, a finger and typed digits do to the drawing: one tool at a time. */

import { Canvas, make } from "./canvas";
import { Cursor, NEAR } from "./cursor";
import type { Socket } from "./socket";
import { dist, type DrawnJoint, type Drawing, ends, figures, type Picked, type Point, type Where } from "./state";

export interface Tool { key: string; name: string; title: string; shape: "select" | "line" | "click"; fields?: string[] }
export const TOOLS: Tool[] = [
  { key: "v", name: "select", title: "Select, drag points, pull links", shape: "select" },
  { key: "b", name: "bar", title: "Link: drag from end to end, or type its length and angle", shape: "line", fields: ["length", "angle"] },
  { key: "x", name: "ground", title: "Ground: click a place or a point of a link, or type x, Tab, y, Enter", shape: "click", fields: ["x", "y"] },
  { key: "p", name: "point", title: "Point on a link: click it there, or type x, Tab, y in its axes and click the link", shape: "click", fields: ["x", "y"] },
  { key: "s", name: "slider", title: "Slider: drag from a point along the guide (over a link: the link guides it)", shape: "line", fields: ["angle"] },
  { key: "l", name: "slide", title: "Sliding link: drag from its point along the guide; the whole link slides and does not turn", shape: "line", fields: ["angle"] },
  { key: "o", name: "slot", title: "Slot: drag from the pin along the slot (over a link: the slot is in it)", shape: "line", fields: ["angle"] },
  { key: "a", name: "circular_slot", title: "Circular slot: drag from the pin to the slot's centre on another link", shape: "line" },
  { key: "i", name: "pin", title: "Pin: click where points of two links lie, or drag from one to the other", shape: "line" },
  { key: "w", name: "weld", title: "Weld: click a pin, or drag from a point to one of another link", shape: "line" },
  { key: "g", name: "gear", title: "Gears: drag from one axis to the other", shape: "line" },
  { key: "r", name: "rolling", title: "Rolling wheel: drag from its axis to the point of the track below it", shape: "line" },
  { key: "e", name: "belt", title: "Belt: drag from one axis to the other", shape: "line" },
  { key: "j", name: "cam", title: "Cam: drag from its axis to the follower's roller", shape: "line" },
  { key: "d", name: "drive", title: "Drive: click a joint", shape: "click", fields: ["position"] },
  { key: "f", name: "force", title: "Force: drag from a point, or type its size and angle", shape: "line", fields: ["value", "angle"] },
  { key: "m", name: "couple", title: "Couple: click a link", shape: "click", fields: ["value"] },
  { key: "k", name: "spring", title: "Spring: drag from point to point", shape: "line", fields: ["value"] },
  { key: "n", name: "damper", title: "Damper: drag from point to point", shape: "line", fields: ["value"] },
  { key: "c", name: "cylinder", title: "Cylinder: drag from point to point", shape: "line", fields: ["value"] },
];
/** Pixels within which a press is a click. */
const CLICK = 4;
/** Degrees of the directions that bars snap to, and how near they have to be. */
const DIRECTIONS = 15, TURN = 3;

export interface Shown { drawing(): Drawing; pick(p: Picked | null): void; picked(): Picked | null; said(text: string): void; again(): void; tool(t: Tool): void; step(back: boolean): void; now(): Drawing }

/** Something that is dragged. A pulled link is held at a place `hold` of its axes; `path`: where the hand has been since
 * the last question to the server, `led`: that question, `dropped`: by Esc. */
interface Drag { kind: "move" | "pull" | "pan"; picked: Picked | null; x: number; y: number; moved: boolean; hold: Point; path: Point[]; pose?: any; led?: Promise<void>; dropped?: boolean }

export class Hand {
  tool = TOOLS[0];
  private from: { where: Where; x: number; y: number } | null = null;
  private place: Where = { at: [0, 0] };
  private typed: string[] = [];
  private field = 0;
  private drag: Drag | null = null;
  private pointers = new Map<number, Point>();
  private readonly cursor: Cursor;
  /** The drawing while something is dragged. */
  shadow: Drawing | null = null;

  constructor(private readonly canvas: Canvas, private readonly socket: Socket, private readonly shown: Shown) {
    const { svg } = canvas;
    this.cursor = new Cursor(canvas, (text) => shown.said(text));
    svg.addEventListener("pointerdown", (e) => this.down(e));
    svg.addEventListener("pointermove", (e) => this.move(e));
    svg.addEventListener("pointerup", (e) => this.up(e));
    svg.addEventListener("pointercancel", () => this.cancel());
    svg.addEventListener("wheel", (e) => {
      e.preventDefault();
      this.canvas.window.zoom(Math.exp(-e.deltaY / 400), ...this.xy(e));
      this.shown.again();
    }, { passive: false });
    document.addEventListener("keydown", (e) => this.key(e));
  }

  choose(tool: Tool): void {
    this.cancel();
    this.tool = tool;
    this.canvas.svg.focus({ preventScroll: true }); // keys are now for the drawing
    this.shown.tool(tool);
  }
  cancel(): void {
    if (this.drag) this.drag.dropped = true;
    this.from = this.drag = null;
    this.shadow = null;
    this.typed = [];
    this.field = 0;
    this.pointers.clear();
    this.canvas.preview.replaceChildren();
    this.shown.said(this.tool.title);
    this.shown.again();
  }
  private xy(e: { clientX: number; clientY: number }): Point {
    const box = this.canvas.svg.getBoundingClientRect();
    return [e.clientX - box.left, e.clientY - box.top];
  }
  private part(e: PointerEvent): { kind: Picked["kind"]; name: string; link?: string; point?: string } | null {
    const el = document.elementsFromPoint(e.clientX, e.clientY).find((x) => (x as SVGElement).dataset?.kind) as SVGElement | undefined;
    return el ? { kind: el.dataset.kind as Picked["kind"], name: el.dataset.name!, link: el.dataset.link, point: el.dataset.point } : null;
  }
  private linkAt(e: { clientX: number; clientY: number }): string {
    const at = document.elementsFromPoint(e.clientX, e.clientY).map((x) => (x as SVGElement).dataset ?? {}), block = at.find((x) => x.kind === "joints" && !x.point)?.name;
    return at.find((x) => x.kind === "links")?.name ?? this.shown.drawing().joints.find((j) => j.name === block)?.links[1] ?? at.find((x) => x.point && x.link !== "ground")?.link ?? "";
  }
  /** The place of the pointer: on a point that is near, else on the grid. */
  private snap(e: PointerEvent): Where {
    const [x, y] = this.xy(e), at = this.canvas.window.metres(x, y), d = this.shown.drawing();
    if (e.ctrlKey) return { at };
    let best: Where | null = null, least = NEAR;
    for (const end of ends(d)) {
      const far = dist(this.canvas.window.px(end.at), [x, y]);
      const loaded = this.tool.name === "force" && best?.link === "ground" && far < least + 0.01; // the ground bears no load
      if (far < least - 0.01 || loaded) [best, least] = [{ at: end.at, link: end.link, point: end.point }, far];
    }
    const meant = best && [...ends(d)].find((one) => one.link === this.cursor.end?.link && one.point === this.cursor.end.point);
    if (best && meant && dist(best.at, meant.at) * this.canvas.window.scale < 1) best = meant;
    if (best) return best;
    const a = this.from?.where.at;
    if (a && this.tool.name !== "gear") {
      const turn = (Math.atan2(at[1] - a[1], at[0] - a[0]) * 180) / Math.PI, near = Math.round(turn / DIRECTIONS) * DIRECTIONS, far = dist(a, at);
      if (Math.abs(turn - near) < TURN) {
        const step = this.canvas.window.step(d.units.length.size, 7), long = Math.round(far / step) * step, r = (near * Math.PI) / 180;
        return { at: [a[0] + long * Math.cos(r), a[1] + long * Math.sin(r)], polar: [long / d.units.length.size, near] };
      }
    }
    const step = this.canvas.window.step(d.units.length.size, 7);
    return { at: [Math.round(at[0] / step) * step, Math.round(at[1] / step) * step] };
  }

  private down(e: PointerEvent): void {
    if (e.isTrusted) this.canvas.svg.setPointerCapture(e.pointerId);
    this.canvas.svg.focus({ preventScroll: true });
    this.pointers.set(e.pointerId, this.xy(e));
    const [x, y] = this.xy(e);
    if (this.pointers.size === 2 || e.button === 1) {
      this.drag = { ...this.begun("pan", null, x, y), moved: true };
      return;
    }
    if (e.button) return;
    if (this.tool.shape === "line") {
      if (this.from) this.place = this.snap(e);
      else this.from = { where: (this.place = this.snap(e)), x, y };
      this.show();
    } else if (this.tool.shape === "click") this.clicked(e);
    else this.grab(e, x, y);
  }
  private grab(e: PointerEvent, x: number, y: number): void {
    const part = this.part(e);
    if (!part) {
      this.drag = this.begun("pan", null, x, y);
      return;
    }
    const picked: Picked = { kind: part.kind, name: part.name, link: part.link };
    this.shown.pick(picked);
    if (part.point) this.drag = this.begun("move", { kind: "points", name: part.point, link: part.link }, x, y);
    else if (part.kind === "links") this.drag = this.begun("pull", picked, x, y);
  }
  private begun(kind: Drag["kind"], picked: Picked | null, x: number, y: number): Drag {
    const pose = kind === "pull" && this.shown.drawing().links.find((l) => l.name === picked!.name)?.pose, [px, py, angle] = pose || [0, 0, 0];
    const at = this.canvas.window.metres(x, y), dx = at[0] - px, dy = at[1] - py, c = Math.cos(angle), s = Math.sin(angle);
    return { kind, picked, x, y, moved: false, hold: [dx * c + dy * s, dy * c - dx * s], path: [] };
  }
  private move(e: PointerEvent): void {
    const [x, y] = this.xy(e), before = this.pointers.get(e.pointerId);
    if (this.pointers.size === 2 && before) {
      const other = [...this.pointers].find(([id]) => id !== e.pointerId)![1], was = dist(before, other), now = dist([x, y], other);
      this.canvas.window.zoom(now / Math.max(was, 1), ...other);
      this.pointers.set(e.pointerId, [x, y]);
      this.shown.again();
      return;
    }
    this.pointers.set(e.pointerId, [x, y]);
    if (this.from) {
      this.place = this.snap(e);
      this.show();
    } else if (this.drag) this.dragged(e, x, y, before ?? [x, y]);
    else if (this.tool.shape !== "select") {
      this.canvas.preview.replaceChildren();
      const at = this.snap(e), [u, v] = this.canvas.window.px(at.at), unit = this.shown.drawing().units.length;
      if (this.tool.name === "ground") make(this.canvas.preview, "text", { x: u + 14, y: v - 14, class: "label" }, `${at.at.map((q) => figures(q / unit.size)).join(", ")} ${unit.unit}`);
      if (at.point) make(this.canvas.preview, "circle", { class: "snap", cx: this.canvas.window.px(at.at)[0], cy: this.canvas.window.px(at.at)[1], r: 10 });
    }
    if (!e.buttons) this.pointers.delete(e.pointerId);
  }
  private dragged(e: PointerEvent, x: number, y: number, before: Point): void {
    const g = this.drag!;
    if (!g.moved && Math.hypot(x - g.x, y - g.y) < CLICK) return;
    g.moved = true;
    if (g.kind === "pan") {
      this.canvas.window.pan(x - before[0], y - before[1]);
      this.shown.again();
    } else if (g.kind === "move") {
      if (!pointOf(this.shown.drawing(), g.picked!)) { // an undo or a deletion has taken it away meanwhile
        this.drag = null;
        return this.settle();
      }
      this.place = this.snapAway(e, g.picked!);
      this.shadow = moved(this.shown.drawing(), g.picked!, this.place.at);
      this.shown.again();
    } else {
      g.path.push(this.canvas.window.metres(x, y));
      g.led ??= this.lead(g).finally(() => (g.led = undefined));
    }
  }
  /** Snaps to points other than those at the place that is dragged. */
  private snapAway(e: PointerEvent, picked: Picked): Where {
    const old = pointOf(this.shown.drawing(), picked)!, to = this.snap(e);
    if (!to.point || dist(to.at, old) * this.canvas.window.scale > 3) return to;
    return { at: this.canvas.window.metres(...this.xy(e)) };
  }
  /** Lead a link along its path, question by question; each goes on from the pose of the one before. */
  private async lead(g: Drag): Promise<void> {
    while (g.path.length && !g.dropped) {
      const path = g.path.splice(0).slice(-4), a = await this.socket.send({ pull: { link: g.picked!.name, at: g.hold, path, on: !!g.pose } });
      if (!a.pose || g.dropped) return;
      g.pose = { links: a.pose, drives: a.drives };
      this.shadow = posed(this.shown.now(), a.pose);
      this.shown.again();
    }
  }
  private async released(g: Drag): Promise<void> {
    await g.led;
    const d = this.shown.now(), listed = d.drives.find(({ written: w }) => w?.law || (w?.position && typeof w.position === "object")); // its first position is drawn
    const held = listed && d.freedoms <= d.drives.length;
    if (g.pose && !held) await this.socket.gesture({ op: "pose", ...g.pose });
    this.settle();
    if (held) this.shown.said(`The drawing is at the first position of drive ${listed.name}: give it one position to have it elsewhere`);
  }
  private up(e: PointerEvent): void {
    this.pointers.delete(e.pointerId);
    const g = this.drag, [x, y] = this.xy(e);
    if (this.from) {
      const met = this.met(this.from.where);
      if (met.length === 1 && Math.hypot(x - this.from.x, y - this.from.y) < CLICK) this.place = met[0];
      if (Math.hypot(x - this.from.x, y - this.from.y) >= CLICK || (this.place.point && this.place.link !== this.from.where.link)) void this.finish(e);
      else this.show();
      return;
    }
    this.drag = null;
    if (!g) return;
    if (!g.moved) {
      if (g.kind === "pan") this.shown.pick(null);
      return;
    }
    if (g.kind === "move") void this.dropped(g.picked!);
    else if (g.kind === "pull") void this.released(g);
  }
  private async dropped(p: Picked): Promise<void> {
    const to = this.place;
    if (to.point && to.link !== p.link) await this.socket.gesture({ op: "merge", first: { at: to.at, link: p.link, point: p.name }, second: to });
    else await this.socket.gesture({ op: "move", link: p.link, point: p.name, to: to.at });
    this.settle();
  }
  private settle(): void {
    this.shadow = null;
    this.shown.again();
  }

  private clicked(e: PointerEvent): void {
    this.placed(this.snap(e), this.linkAt(e), this.part(e)?.kind === "joints" ? this.part(e)!.name : "");
  }
  /** A click tool at a place, on a link or joint. */
  private placed(where: Where, link: string, named: string): void {
    const [value, second] = this.typed, joint = this.joint(where, named), typed = { ...(value && { x: value }), ...(second && { y: second }) };
    const asked =
      this.tool.name === "ground" ? { op: "ground", where: value || second ? { at: where.at } : where, ...typed }
      : this.tool.name === "point" ? link && { op: "point", link, at: where.at, ...typed }
      : this.tool.name === "couple" ? link && { op: "couple", link, ...(value ? { value } : {}) }
      : joint && { op: "drive", joint: joint.name, ...(value ? { position: value } : { here: Object.values(joint.here ?? { turn: 0 })[0] ?? 0 }), freedom: joint.type === "slot" ? "turn" : "" };
    if (!asked) return this.shown.said(this.tool.title);
    void this.socket.gesture(asked).then((a) => {
      [this.typed, this.field] = [[], 0];
      if (!a.refused && joint && this.tool.name === "drive") this.shown.pick({ kind: "joints", name: joint.name });
      if (!a.refused && this.tool.name !== "ground" && this.tool.name !== "point") this.choose(TOOLS[0]);
    });
  }
  /** The joint at a place that a drive can move: with the ground first. */
  private joint(where: Where, named: string): DrawnJoint | undefined {
    const d = this.shown.drawing(), some = d.joints.filter((j) => j.name === named || (where.point && (dist(j.q, where.at) < 1e-9 + 2 / this.canvas.window.scale)));
    const free = some.filter((j) => j.freedoms.length);
    return free.find((j) => j.links.includes("ground")) ?? free[0];
  }

  /** The line as it would be drawn, with its numbers. */
  private show(): void {
    const { preview, window } = this.canvas, u = this.shown.drawing().units.length;
    preview.replaceChildren();
    if (!this.from) return;
    const a = window.px(this.from.where.at), end = this.end(), b = window.px(end);
    make(preview, "path", { class: `line ${this.tool.name}`, d: `M${a}L${b}` });
    for (const [p, where] of [[a, this.from.where], [b, this.place]] as const) make(preview, "circle", { class: where.point ? "snap" : "end", cx: p[0], cy: p[1], r: where.point ? 10 : 4 });
    const long = dist(this.from.where.at, end) / u.size, turn = (Math.atan2(end[1] - this.from.where.at[1], end[0] - this.from.where.at[0]) * 180) / Math.PI;
    const now: Record<string, string> = { length: `${figures(long)} ${u.unit}`, angle: `${figures(turn)}°`, value: this.tool.name === "force" ? `${figures(this.force(end))} ${this.shown.drawing().units.force.unit}` : "" };
    const said = (this.tool.fields ?? []).map((f, k) => `${f} ${this.typed[k] ? `[${this.typed[k]}]` : now[f]}`).join("   ");
    make(preview, "text", { x: b[0] + 14, y: b[1] - 14, class: "label" }, said);
    this.shown.said(this.tool.fields ? `Type ${this.tool.fields.join(", Tab, ")}, then Enter; Esc cancels` : "");
  }
  /** Newtons, or the file's unit of force: ten for each 12 pixels, rounded. */
  private force(end: Point): number {
    return Math.max(10, Math.round((dist(this.from!.where.at, end) * this.canvas.window.scale) / 12) * 10);
  }
  private end(): Point {
    const a = this.from!.where.at, b = this.place.at, u = this.shown.drawing().units;
    const number = (name: string, size: number): number | null => {
      const text = this.typed[(this.tool.fields ?? []).indexOf(name)], m = text && /^[-+]?[\d.,]+$/.test(text) ? +text.replace(",", ".") : NaN;
      return Number.isFinite(m) ? m * size : null;
    };
    const long = number("length", u.length.size) ?? dist(a, b), turn = number("angle", u.angle.size) ?? Math.atan2(b[1] - a[1], b[0] - a[0]);
    return [a[0] + long * Math.cos(turn), a[1] + long * Math.sin(turn)];
  }
  private async finish(e: { clientX: number; clientY: number } | null): Promise<void> {
    const first = this.from!.where, end = this.end(), fields = this.tool.fields ?? [], typed = (name: string): string => this.typed[fields.indexOf(name)] ?? "";
    const any = this.typed.some(Boolean), there = this.place.point && dist(this.place.at, first.at) > 0, second: Where = there || !any ? this.place : { at: end };
    const turn = Math.atan2(end[1] - first.at[1], end[0] - first.at[0]), over = e && !this.place.point ? this.linkAt(e) : this.place.link ?? "";
    const unit = this.shown.drawing().units.force.size, size = this.force(end) * unit;
    const value = typed("value") ? { value: typed("value") } : {}, polar = this.place.polar?.map((x) => figures(x, 9)) ?? ["", ""];
    const asked: Record<string, unknown> =
      this.tool.name === "bar" ? { op: "bar", ends: [first, second].map(plain), length: typed("length") || polar[0], angle: typed("angle") || `${polar[1]}${polar[1] && " deg"}` }
      : ["slider", "slot", "slide"].includes(this.tool.name) ? { op: this.tool.name, where: plain(first), guide: over && over !== first.link ? over : "ground", direction: turn, angle: typed("angle") }
      : this.tool.name === "force" ? { op: "force", where: plain(first), vector: [size * Math.cos(turn), size * Math.sin(turn)], angle: typed("angle"), ...value }
      : { op: this.tool.name === "pin" ? "merge" : this.tool.name, first: plain(first), second: plain(second), ...value };
    const goesOn = this.tool.name === "bar" && !(first.point && second.point); // a bar from point to point closes what is drawn
    this.cancel();
    const a = await this.socket.gesture(asked);
    if (!a.refused && !goesOn) this.choose(TOOLS[0]);
  }

  /** Points of other links at a place, which a click of the pin or weld tool joins to its own. */
  private met(w: Where): Where[] {
    const d = this.shown.drawing(), type = this.tool.name;
    if (!w.point || !/pin|weld/.test(type)) return [];
    const joined = (link: string): boolean => d.joints.some((j) => j.type === type && j.links.includes(w.link!) && j.links.includes(link));
    return [...ends(d)].filter((one) => one.link !== w.link && dist(one.at, w.at) * this.canvas.window.scale < 2 && !joined(one.link));
  }

  private key(e: KeyboardEvent): void {
    const on = e.target as HTMLElement;
    if (on.closest?.("input,textarea,select,.cm-editor,.dalembert")) return;
    const back = (e.ctrlKey || e.metaKey) && /^[zy]$/i.test(e.key);
    if (back) {
      e.preventDefault();
      this.shown.step(e.key.toLowerCase() === "z" && !e.shiftKey);
      return;
    }
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    if (e.key === "Escape") this.from || this.typed.length ? this.cancel() : this.choose(TOOLS[0]);
    else if (this.tool.fields && (this.from || this.tool.shape === "click") && this.type(e)) e.preventDefault();
    else if ((e.key === "Delete" || e.key === "Backspace") && this.shown.picked()) {
      const p = this.shown.picked()!;
      void this.socket.gesture({ op: "delete", kind: p.kind, name: p.name, ...(p.kind === "points" ? { link: p.link } : {}) });
      this.shown.pick(null);
    } else if (e.key === "0") {
      this.canvas.window.fit(this.shown.drawing());
      this.shown.again();
    } else if (e.target instanceof HTMLButtonElement && /^(Enter| )$/.test(e.key)) return;
    else if (this.cursor.key(e, this.shown.drawing(), !!this.drag || !!this.from)) e.preventDefault();
    else {
      const tool = TOOLS.find((t) => t.key === e.key.toLowerCase());
      if (tool) this.choose(tool);
    }
  }
  /** Digits, units, Tab and Enter while something is drawn; true if the key was one of them. */
  private type(e: KeyboardEvent): boolean {
    const now = this.typed[this.field] ?? "", fields = this.tool.fields!;
    if (e.key === "Enter" && this.from) return void this.finish(null), true;
    if (e.key === "Enter" && this.typed.filter(Boolean).length === fields.length && this.enter()) return true;
    else if (e.key === "Tab" && (this.from || this.typed.length)) this.field = (this.field + 1) % fields.length;
    else if (e.key === "Backspace" && now) this.typed[this.field] = now.slice(0, -1);
    else if (/^[-\d.,]$/.test(e.key) || (now && /^[a-z*/^ °]$/i.test(e.key))) this.typed[this.field] = now + e.key;
    else return false;
    if (this.from) this.show();
    else this.shown.said(`${fields.map((f, k) => `${f} ${k === this.field ? `[${this.typed[k] ?? ""}]` : this.typed[k] ?? "…"}`).join("   ")}: then ${this.tool.name === "ground" ? "Enter" : "click"}`);
    return true;
  }
  /** Typed values of a click tool that need no click: a place, or a part that is chosen. */
  private enter(): boolean {
    const p = this.shown.picked(), name = this.tool.name;
    if (name !== "ground" && p?.kind !== (name === "drive" ? "joints" : "links")) return false;
    this.placed({ at: [0, 0] }, p?.name ?? "", p?.name ?? "");
    return true;
  }
}

/** A place as the server takes it. */
const plain = ({ at, link, point }: Where): Where => (point ? { at, link, point } : { at });

/** The place of a picked point, if it is there. */
const pointOf = (d: Drawing, p: Picked): Point | undefined => d.links.find((l) => l.name === p.link)?.points[p.name];

/** The drawing with all points at one place moved. */
function moved(d: Drawing, p: Picked, to: Point): Drawing {
  const old = pointOf(d, p)!, there = (q: Point): Point => (dist(q, old) < 1e-9 ? to : q);
  return {
    ...d,
    links: d.links.map((l) => ({ ...l, center: undefined, points: Object.fromEntries(Object.entries(l.points).map(([n, q]) => [n, there(q)])) })),
    joints: d.joints.map((j) => ({ ...j, p: there(j.p), q: there(j.q) })),
    loads: d.loads.map((l) => ({ ...l, p: l.p && there(l.p), between: l.between && [there(l.between[0]), there(l.between[1])] })),
  };
}

/** The drawing at another pose of its links. */
function posed(d: Drawing, pose: Record<string, [number, number, number]>): Drawing {
  const of = (link: string): ((p: Point) => Point) => {
    const was = d.links.find((l) => l.name === link)?.pose ?? [0, 0, 0], now = pose[link] ?? was, turn = now[2] - was[2], c = Math.cos(turn), s = Math.sin(turn);
    return (p) => [now[0] + c * (p[0] - was[0]) - s * (p[1] - was[1]), now[1] + s * (p[0] - was[0]) + c * (p[1] - was[1])];
  };
  const turned = (link: string): number => (pose[link]?.[2] ?? 0) - (d.links.find((l) => l.name === link)?.pose[2] ?? 0);
  return {
    ...d,
    links: d.links.map((l) => ({ ...l, pose: pose[l.name] ?? l.pose, center: l.center && of(l.name)(l.center), points: Object.fromEntries(Object.entries(l.points).map(([n, p]) => [n, of(l.name)(p)])) })),
    joints: d.joints.map((j) => ({ ...j, p: of(j.links[0])(j.p), q: of(j.links[1])(j.q), direction: j.direction === undefined ? undefined : j.direction + turned(j.links[0]) })),
    loads: d.loads.map((l) => ({ ...l, p: l.p && l.on ? of(l.on)(l.p) : l.p, between: l.between && l.links && [of(l.links[0])(l.between[0]), of(l.links[1])(l.between[1])] })),
  };
}
