/** The page of a mechanism that is not finished: its links are pulled, and what is missing stands beside them. */

import type { Offer, Rows, SketchPageData } from "./data";
import { gapMarks } from "./gap";
import { Material } from "./material";
import type { Entry } from "./menu";
import { placedPose } from "./poses";
import type { AnyData, Inner, Options, Placing } from "./page";
import { inflate, Program } from "./program";
import { heldLink, linkOf } from "./pull";
import { type Grip, Pulled, type Where } from "./pulling";
import { copied, type Pose } from "./sketch";
import type { Source } from "./source";
import { stage } from "./stage";
import { figures, html, make, path, type Point, pointer, set, short, text } from "./svg";
import { layers, viewButtons } from "./switches";
import { fileName, pngOf, save, svgText } from "./tools";
import type { Identity, View } from "./view";

/** The drawn rows of a pose. */
class Shown implements Source {
  readonly here: Float64Array;
  readonly count = 1;
  readonly good = new Uint8Array([1]);
  readonly cyclic = false;
  finite = true;
  open: { joint: string; p: number[]; q: number[] }[] = [];
  private readonly inputs: [keyof Pose, number][];
  constructor(private readonly data: SketchPageData, private readonly program: Program) {
    this.here = new Float64Array(data.shown.outputs);
    this.inputs = program.module.channels.map((name) => {
      const [, part, k] = name.split(" ");
      return [part as keyof Pose, +k];
    });
  }
  get solved(): boolean {
    return this.finite;
  }
  show(q: Pose): void {
    this.inputs.forEach(([part, k], channel) => this.program.put(channel, q[part][k]));
    this.program.call(1);
    for (let r = 0; r < this.here.length; r++) this.here[r] = this.program.at(r);
    this.finite = this.here.every(Number.isFinite);
    const at = (rows: Rows): number[] => rows.map((r) => this.here[r]);
    const gaps = this.data.gaps.map((g) => ({ joint: g.joint, p: at(g.p), q: at(g.q) }));
    this.open = gaps.filter((g) => Math.hypot(...g.p.map((x, k) => x - g.q[k])) > 1e-6 * this.data.sketch.length);
  }
  value(row: number): number {
    return this.here[row];
  }
  reverses(): boolean {
    return false;
  }
  onceAfter<T>(of: () => T): T {
    return of();
  }
  largest(of: (k: number) => number): number {
    return of(0);
  }
}

/** A distance that is not seen, mm of paper; steps of a key; undone poses that are kept. */
const FINE = 0.02, KEYS = 2, KEPT = 500;

export async function sketched(root: HTMLElement, data: SketchPageData, view: View, options: Options & { taken(next: AnyData, pose: Placing): Promise<void>; back?: () => void }): Promise<Inner> {
  const [closure, drawn] = await Promise.all([Program.create(data.sketch.closure, 1), Program.create(data.shown, 1)]);
  const s = data.sketch, own: Pose = { point: Float64Array.from(s.pose.point), rotation: Float64Array.from(s.pose.rotation), turn: Float64Array.from(s.pose.turn) };
  const source = new Shown(data, drawn), sketch = new Pulled(s, closure, placedPose(s, own, options.pose ?? {})), times: number[] = [];
  const material = new Material(s.links, data.poses, source), past: Pose[] = [], future: Pose[] = [];
  let grip: Grip | null = null, target: number[] = [], where: Where = "there", asked = 0, from: Pose = sketch.pose;
  source.show(sketch.pose);

  const header = html("header", root);
  html("h1", header, {}, data.title);
  const bar = html("div", header, { class: "bar", role: "toolbar", "aria-label": "sketch" });
  const button = (box: Element, said: string, title: string, act: () => void): HTMLButtonElement => {
    const b = html("button", box, { type: "button", title, ...(/^\w/.test(said) ? {} : { "aria-label": title }) }, said);
    b.addEventListener("click", act);
    return b;
  };
  html("output", bar, { class: "readout" }, "Sketch: drag the links.").style.flex = "1";
  if (options.back) button(bar, "Back", "undo the last addition", options.back);
  const undo = button(bar, "↶", "undo (Ctrl+Z)", () => go(past, future)), redo = button(bar, "↷", "redo (Ctrl+Y)", () => go(future, past));
  button(bar, "Reset", "as in the file", () => moved(() => sketch.placed(copied(own))));
  const main = html("main", root, { class: "one" }), area = html("section", main, { class: "stage", "aria-label": "sketch" });
  const st = stage(area, source, data.views.mechanism, data.units, view, {
    full: options.full, on: options.on, entries, chosen: () => request(), again: () => request(),
    held: (item) => carrier(`${item.kind}:${item.name}`) >= 0,
  });
  const { m, paper } = st, updateGaps = gapMarks(m, data, source);
  const layer = make("g", m.svg, { class: "handles" }), rope = make("g", m.svg, { class: "gaps", "pointer-events": "none" });
  const knobs = points().map(({ link, point, p }) => {
    const knob = make("circle", layer, { class: "handle joint", r: 2.2, tabindex: 0, role: "slider", "aria-label": `pull ${point} of ${link}`, "aria-valuetext": `${point} of ${link}`, "aria-valuenow": 0, "data-item": `point:${link}.${point}` });
    make("title", knob).textContent = `drag ${point} of ${link}`;
    knob.addEventListener("keydown", (e) => {
      const way: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }, by = way[e.key];
      if (!by) return;
      e.preventDefault();
      e.stopPropagation();
      const k = KEYS * (e.shiftKey ? 5 : 1), at = m.paper.point(p);
      moved(() => {
        const held = { link: s.links.indexOf(link), u: material.local(m.paper, s.links.indexOf(link), at) };
        sketch.frame(held, m.paper.metres([at[0] + k * by[0], at[1] + k * by[1]]), fine());
      });
    });
    return { knob, p };
  });
  const missing = html("div", null, { class: "missing", role: "status" });
  paper.before(missing);
  html("p", missing, {}, data.missing.sentence[0].toUpperCase() + data.missing.sentence.slice(1) + ".");
  for (const offer of data.missing.offers) button(missing, `+ ${offer.said}`, offer.page ? offer.said : "add it and save the model file", () => void take(offer));
  switches();

  /** The moving link of a part, by number; -1 of the ground. */
  function carrier(item: string): number {
    return item.startsWith("point:") ? s.links.indexOf(item.slice(6, item.lastIndexOf("."))) : linkOf(data, item);
  }
  /** Points that can be taken hold of, each place once. */
  function points(): SketchPageData["points"] {
    const seen = new Set<string>();
    return data.points.filter(({ p }) => {
      const key = p.map((r) => source.here[r].toFixed(9)).join();
      return !seen.has(key) && seen.add(key);
    });
  }
  function switches(): void {
    const box = html("div", area, { class: "switches" }), name = fileName(data.title);
    viewButtons(box, st.view, view, false, () => request());
    layers(box, view, data.views.mechanism.arrows.length ? ["names", "loads"] : ["names"], false, () => request());
    const files = html("span", box, { class: "group", role: "group", "aria-label": "save" });
    button(files, "Model file", "the file with the pose that is drawn", () => save(`${name}.yaml`, textOf(), "text/yaml"));
    button(files, "SVG", "the drawing", () => save(`${name}.svg`, svgText(m.svg, data.style.light), "image/svg+xml"));
    button(files, "PNG", "the drawing", () => void pngOf(m.svg, data.style.light).then((blob) => save(`${name}.png`, blob, "image/png")));
  }
  function entries(items: Identity[]): Entry[] {
    return items.flatMap(({ kind, name }) => s.rows.flatMap((r, row) => (kind === "joint" && r.joint === name && r.kind === "freedom"
      ? [{ said: `${sketch.locked(row) ? "Release" : "Lock"} the ${r.angular ? "turn" : "slide"} of ${name}`, act: () => sketch.lock(row, !sketch.locked(row)) }] : [])));
  }
  async function take(offer: Offer): Promise<void> {
    if (options.on?.({ type: "offer", offer })) return;
    if (!offer.page) return save(`${fileName(data.title)}.yaml`, offer.text, "text/yaml");
    await options.taken(JSON.parse(new TextDecoder().decode(await inflate(offer.page))), placing());
  }
  /** The file's text with the pose that is drawn. */
  function textOf(): string {
    const all = s.links.flatMap((_, k) => [sketch.pose.point[2 * k], sketch.pose.point[2 * k + 1], sketch.pose.turn[k]]);
    return data.text.replace(/@@(\d+)@@/g, (_, k) => String(all[+k]));
  }
  function placing(): Placing {
    return Object.fromEntries(s.links.map((name, k) => [name, [sketch.pose.point[2 * k], sketch.pose.point[2 * k + 1], sketch.pose.turn[k]]]));
  }
  const fine = (): number => (FINE * m.paper.perMm) / s.length;

  /** A change of pose that can be undone. */
  function moved(act: () => void): void {
    from = sketch.pose;
    act();
    note();
  }
  function note(): void {
    if (from !== sketch.pose) {
      past.push(from);
      if (past.length > KEPT) past.shift();
      future.length = 0;
    }
    options.on?.({ type: "pose", pose: placing(), closed: sketch.closed });
    request();
  }
  function go(back: Pose[], ahead: Pose[]): void {
    const q = back.pop();
    if (!q) return;
    ahead.push(sketch.pose);
    sketch.placed(q);
    request();
  }
  m.svg.addEventListener("pointerdown", (e) => {
    const link = e.button === 0 ? heldLink(m.svg, e, carrier) : -1;
    if (link < 0) return;
    m.svg.setPointerCapture(e.pointerId);
    const p = pointer(m.svg, e);
    [grip, target, from] = [{ link, u: material.local(m.paper, link, p) }, m.paper.metres(p), sketch.pose];
  });
  m.svg.addEventListener("pointermove", (e) => {
    if (!grip || !m.svg.hasPointerCapture(e.pointerId)) return;
    target = m.paper.metres(pointer(m.svg, e));
    where = "on the way";
    request();
  });
  const up = (): void => {
    if (!grip) return;
    grip = null;
    where = "there";
    note();
  };
  m.svg.addEventListener("pointerup", up);
  m.svg.addEventListener("pointercancel", up);

  function request(): void {
    asked ||= requestAnimationFrame(() => {
      asked = 0;
      const start = performance.now();
      frame();
      times.push(performance.now() - start);
      if (times.length > 2000) times.shift();
    });
  }
  function frame(): void {
    if (grip || !sketch.closed) {
      const before = sketch.pose;
      if (where === "on the way" || !sketch.closed) where = sketch.frame(grip, target, fine());
      if (where === "on the way" || (where === "apart" && before !== sketch.pose)) request();
    }
    source.show(sketch.pose);
    m.update(true);
    for (const { knob, p } of knobs) {
      const [x, y] = m.paper.point(p);
      set(knob, { cx: short(x), cy: short(y) });
    }
    updateGaps();
    stretched();
    [undo.disabled, redo.disabled] = [!past.length, !future.length];
  }
  /** From the held point to where the pointer would have it. */
  function stretched(): void {
    rope.replaceChildren();
    if (!grip || where !== "nearest" || sketch.away < 3 * fine()) return;
    const [p, q] = [sketch.at(grip), target].map((x) => m.paper.of(...m.paper.project(x))), { unit, size } = data.units.length;
    make("path", rope, { class: "l-gap", d: path([p, q]), style: "fill:none" });
    set(text(rope, "gap", `${figures((sketch.away * s.length) / size, 3)} ${unit} too far`, 3.3, q[0] < p[0] === q[1] < p[1] ? "start" : "end"), { x: short((p[0] + q[0]) / 2 + (q[0] < p[0] === q[1] < p[1] ? 2.5 : -2.5)), y: short((p[1] + q[1]) / 2 - 1.5) });
  }
  const keys: Document | HTMLElement = options.full ? document : root;
  const key = (event: Event): void => {
    const e = event as KeyboardEvent;
    if (!(e.ctrlKey || e.metaKey) || e.altKey || !/^[zy]$/i.test(e.key)) return;
    e.preventDefault();
    e.key.toLowerCase() === "z" && !e.shiftKey ? go(past, future) : go(future, past);
  };
  keys.addEventListener("keydown", key);
  const resize = (): void => {
    st.resize();
    m.fit();
    request();
  };
  return {
    data, times, stage: st, observed: [paper], resize, redraw: request,
    opened() {
      resize();
      frame();
      st.choose(view.chosen);
    },
    set: () => undefined, show: () => undefined,
    text: textOf, pose: placing, sketch,
    remove: () => keys.removeEventListener("keydown", key),
  };
}
