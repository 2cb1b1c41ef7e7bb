/** The page of a mechanism that is solved: drawing, curves, free bodies, numbers that change. */

import type { Curve, Data } from "./data";
import { gapMarks } from "./gap";
import { Gate } from "./gate";
import { handles } from "./handles";
import { Kernel } from "./kernel";
import { Material } from "./material";
import type { Entry } from "./menu";
import type { Inner, Options } from "./page";
import { methodPanel, numbersPanel } from "./panels";
import { linkOf, pull } from "./pull";
import { results } from "./results";
import { Reasons } from "./sentences";
import { stage } from "./stage";
import { figures, html, plain, type Point, say } from "./svg";
import { layers, toggle, viewButtons } from "./switches";
import { tabs } from "./tabs";
import { toolbar } from "./toolbar";
import { changes, Cloud, csvText, fileName, fragment, Gradients, History, modelText, pngOf, restore, save, svgText } from "./tools";
import { tracers } from "./tracers";
import type { Identity, Layer, View } from "./view";

/** Elements in which letters are typed, and those that a space presses or opens. */
const TYPED = "input:not([type=range],[type=checkbox]),textarea,[contenteditable]";
const PRESSED = "button,summary,select,a,input[type=checkbox],[role=button],[role=tab]";
/** Seconds per cycle of the animation, and positions that a step with Shift passes. */
const CYCLE = 6, STRIDE = 10;
/** Milliseconds of a frame in which numbers are dragged for the cycle and its curves. */
const SHARE = 1;
/** Joints of which all names would hide the drawing. */
const MANY = 8;
/** Parts of a place that its menu names. */
const NAMED = 4;

export async function solved(root: HTMLElement, data: Data, view: View, options: Options & { back?: () => void }): Promise<Inner> {
  const kernel = await Kernel.create(data), times: number[] = [], gate = new Gate(data, kernel);
  if (options.changes) gate.change(options.changes);
  if (options.address) restore(kernel, gate, view, location.hash);
  const placed = options.pose && kernel.motion.take(options.pose);
  if (placed !== undefined && placed !== null) view.t = placed;
  view.t = Math.min(Math.max(Number.isFinite(view.t) && !options.anew ? view.t : data.start, 0), kernel.end);
  let asked = 0, whole = true, runs = 0, stale = false, gone = false, later: Generator<void> | null = null;
  kernel.cycle();
  const history = new History(kernel, gate);
  const curves = data.views.charts.flatMap((c) => c.curves.map((curve) => ({ curve, unit: data.units[c.kind] })));
  let picked = curves.find((c) => c.curve.of === view.curve) ?? curves.find((c) => data.gradient?.curves.includes(c.curve.row)) ?? curves[0];

  const reasons = new Reasons(data, kernel), bar = toolbar(root, data, kernel, reasons, view, { play, show, go, reset, back: options.back });
  const main = html("main", root), area = html("section", main, { class: "stage", "aria-label": "mechanism" });
  const material = new Material(data.sketch.links, data.sketch.poses, kernel);
  const s = stage(area, kernel, data.views.mechanism, data.units, view, {
    full: options.full, rates: data.views.rates, on: options.on, entries, chosen, again: request,
    held: (item) => kernel.count > 1 && linkOf(data, `${item.kind}:${item.name}`) >= 0,
  });
  const { m, paper } = s, digits = html("output", paper, { class: "digits", "aria-label": "value of the chosen curve" });
  const gradients = new Gradients(m, data, kernel), traced = tracers(m, material, kernel, view);
  const cloud = new Cloud(paper, m, data, kernel, data.handles.flatMap((h) => (h.kind === "joint" || h.kind === "point" ? [h.p] : [])));
  const updateHandles = handles(m, data, kernel, { changed: moved, finished });
  pull(m, data, kernel, material, { seek: show, time: () => view.t });
  const updateGaps = gapMarks(m, data, kernel);
  const side = html("section", main, { class: "side", "aria-label": "results" }), tab = tabs(side, view, () => request(true));
  const pick = (c: Curve) => ((picked = curves.find((x) => x.curve === c)!), (view.curve = c.of), request(true));
  const shown = results(tab, data, kernel, { time: () => view.t, seek: show, pick, picked: () => picked?.curve }, view, () => request(true));
  const spread = switches();
  const inputs = numbersPanel(tab.add("Change", "every number of the file"), data, kernel, gate, (done) => (done ? finished() : moved()));
  files();
  methodPanel(tab.add("About", "method and assumptions"), data);

  function switches(): HTMLElement {
    const box = html("div", area, { class: "switches" }), { arrows, labels } = data.views.mechanism;
    viewButtons(box, s.view, view, kernel.count > 1, () => request(true));
    const has = (kinds: string[]): boolean => arrows.some((a) => kinds.includes(a.kind));
    const moving = data.views.rates.length > 0;
    const all: [Layer, boolean][] = [
      ["values", true], ["digits", curves.length > 0], ["loads", has(["load", "effort", "weight", "spring", "damper"])], ["reactions", has(["joint", "friction"])], ["inertia", has(["inertia"])],
      ["velocities", moving], ["accelerations", moving], ["names", true], ["traces", data.views.mechanism.items.some((i) => i.t === "trace")]];
    if (data.gradient) toggle(box, { said: "what lowers the peak", title: "arrows: moving a joint in this direction lowers the peak of the chosen curve", on: false, act: (on) => ((gradients.on = on), request(true)) });
    layers(box, view, all.flatMap(([layer, there]) => (there ? [layer] : [])), labels.filter((l) => l.kind === "joint").length > MANY, () => (told(), request(true)));
    if (data.handles.some((h) => h.kind === "joint")) toggle(box, { said: "tolerances", title: "a thousand machines with points displaced by up to 0.5 % of the drawing's width", on: false, act: (on) => ((cloud.on = on), request(true)) });
    if (m.paper.axes.length > 2) html("span", box, {}, "drag to rotate the view");
    return html("span", box, { class: "spread" });
  }
  /** The link that a part is on, or that an arrow acts on. */
  function owner({ kind, name }: Identity): string | undefined {
    return data.sketch.links[linkOf(data, `${kind}:${name}`)] ?? data.views.mechanism.arrows.find((a) => a.of === name && a.kind === kind)?.link;
  }
  /** Where a joint, a mass centre or a named point is on paper. */
  function exact({ kind, name }: Identity): Point | null {
    const of = data.handles.find((h) => h.kind === kind && (h.name === name || h.name.startsWith(`${name}:`)));
    return of ? m.paper.point(of.p) : null;
  }
  /** What can be done with the parts of a place. */
  function entries(items: Identity[], point: Point): Entry[] {
    const out: Entry[] = [], links = new Set<string>();
    for (const item of items.slice(0, NAMED)) {
      const { kind, name } = item, link = linkOf(data, `${kind}:${name}`), owner = link < 0 ? undefined : data.sketch.links[link];
      const curve = kind === "joint" || kind === "reaction" ? curves.find((c) => c.curve.of === `reaction.${name}.magnitude`) : curves.find((c) => c.curve.of.startsWith(`${kind}.${name}.`));
      if (curve) out.push({ said: `Curve of ${plain(curve.curve.name)}`, act: () => (pick(curve.curve), tab.show("Curves")) });
      const path = data.numbers.find((n) => n.path.split(".")[1] === name && n.path.startsWith(kind === "center" ? "link" : kind));
      if (path) out.push({ said: `Numbers of ${name}`, act: () => (tab.show("Change"), inputs.focus(path.path)) });
      if (kind === "tracer") out.push({ said: "Remove this path", act: () => (view.tracers.splice(+name, 1), told(), request(true)) });
      if (!owner || links.has(owner)) continue;
      links.add(owner);
      out.push({ said: `Free body of ${owner}`, act: () => (shown.choose(owner), tab.show("Forces")) });
      if (kernel.count > 1) out.push({ said: `Path of this point of ${owner}`, act: () => {
        view.tracers.push({ link: owner, u: material.local(m.paper, link, exact(item) ?? m.paper.of(...point)) });
        told();
        request(true);
      } });
    }
    if (view.window) out.push({ said: "Fit the whole mechanism", act: s.view.fit });
    return out.filter((one, k) => out.findIndex((x) => x.said === one.said) === k);
  }
  function chosen(item: Identity | null): void {
    if (item && item.kind !== "joint") shown.choose(owner(item));
    request(true);
  }
  function files(): void {
    const box = tab.add("Save", "files to save, print, share"), name = fileName(data.title);
    const one = (said: string, act: () => void) => html("button", box, { type: "button" }, said).addEventListener("click", act);
    if (data.template.length) one("Model file", () => save(`${name}.yaml`, modelText(data, kernel), "text/yaml"));
    one("Curves as CSV", () => save(`${name}.csv`, csvText(data, kernel), "text/csv"));
    one("Drawing as SVG", () => save(`${name}.svg`, svgText(m.svg, data.style.light), "image/svg+xml"));
    one("Drawing as PNG", () => void pngOf(m.svg, data.style.light).then((blob) => save(`${name}.png`, blob, "image/png")));
    one("Print", () => window.print());
    if (options.address)
      one("Copy link", () => {
        location.hash = fragment(data, kernel, view);
        void navigator.clipboard?.writeText(location.href);
      });
  }
  /** The address as the page is. */
  function told(): void {
    if (options.address) window.history.replaceState(null, "", "#" + fragment(data, kernel, view));
    options.on?.({ type: "view", view });
  }
  function tell(): void {
    request(true);
    inputs.update();
    const now = changes(data, kernel);
    options.edited?.(now);
    options.on?.({ type: "change", changes: now });
    told();
  }
  function moved(): void {
    kernel.coarse = true;
    gate.pass();
    request(true);
  }
  /** Updates after a change that can be undone. */
  function finished(): void {
    kernel.coarse = false;
    const { sentence } = gate;
    if (gate.pass()) gate.sentence = sentence;
    history.note();
    fit(true);
    tell();
  }
  function reset(): void {
    gate.change({});
    finished();
    fit();
  }
  function go(back: boolean): void {
    if (!history.go(back)) return;
    fit(true);
    tell();
  }
  /** New scales for the drawing and the free bodies; ``keep``: the drawing stays where it still fits. */
  function fit(keep = false): void {
    kernel.cycle();
    m.fit(undefined, keep);
    shown.fit();
  }
  /** Fits the drawing into its area and the charts into their column. */
  function resize(): void {
    s.resize();
    const width = side.querySelector<HTMLElement>(".panels")!.clientWidth;
    if (width > 0) shown.resize(width - 12);
    m.fit();
    request(true);
  }
  function show(place: number): void {
    view.t = Math.min(Math.max(place, 0), kernel.end);
    if (data.only_at_positions) view.t = Math.round(view.t);
    request(false);
  }
  /** From position to position, around where the cycle goes on. */
  function step(by: number): void {
    const next = by > 0 ? Math.floor(view.t + 1e-9) + by : Math.ceil(view.t - 1e-9) + by;
    show(kernel.cyclic ? ((next % kernel.count) + kernel.count) % kernel.count : next);
  }
  function play(): void {
    bar.playing(!runs);
    if (runs) return stop();
    let before = performance.now(), place = view.t;
    const step = (now: number) => {
      place += ((now - before) / 1000 / CYCLE) * view.speed * kernel.end;
      before = now;
      if (place >= kernel.end) place = 0;
      show(place);
      runs = requestAnimationFrame(step);
    };
    runs = requestAnimationFrame(step);
  }
  function stop(): void {
    cancelAnimationFrame(runs);
    runs = 0;
  }
  function request(all: boolean): void {
    whole ||= all;
    if (gone) return; // other data have taken its place
    asked ||= requestAnimationFrame(() => {
      asked = 0;
      const start = performance.now();
      frame();
      times.push(performance.now() - start);
      if (times.length > 2000) times.shift();
    });
  }
  function frame(): void {
    const dragged = kernel.coarse && !gradients.on, all = whole && !dragged;
    stale = whole && dragged || stale && !all;
    if (all) {
      later = null;
      kernel.cycle();
    }
    whole = false;
    kernel.at(view.t);
    const refused = reasons.refusal();
    if (refused !== kernel.refused) {
      kernel.refused = refused;
      kernel.cycle();
    }
    root.classList.toggle("unsolved", !kernel.solved);
    root.classList.toggle("turning", view.drag === "turn");
    m.update(all);
    traced.update(all);
    updateHandles();
    updateGaps();
    gradients.update(picked?.curve);
    const spreads = cloud.update(picked?.curve.row);
    const peak = gradients.on && picked && gradients.peak(picked.curve);
    const lowers = peak && picked ? `arrows lower the peak of ${plain(picked.curve.name)}, now ${figures(peak.size / picked.unit.size)} ${picked.unit.unit}${peak.where}` : "";
    say(spread, [lowers, spreads && picked ? `${plain(picked.curve.name)}: ${figures(spreads.mean / picked.unit.size)} ± ${figures(spreads.sigma / picked.unit.size, 2)} ${picked.unit.unit} (1 σ)` : ""].filter(Boolean).join("; "));
    digits.hidden = !picked || !m.on("digits");
    if (picked && !digits.hidden) say(digits, `${plain(picked.curve.name)} ${kernel.solved ? figures(kernel.here[picked.curve.row] / picked.unit.size) : "–"} ${picked.unit.unit}`);
    shown.update(all);
    bar.update(view.t, history.can, gate.sentence);
    if (dragged) follow();
  }
  /** The cycle of numbers that are dragged and its curves, a part at a time. */
  function* cycle(): Generator<void> {
    yield* kernel.parts();
    yield* m.parts();
    yield* traced.parts();
    yield* shown.parts();
  }
  /** As many parts as a frame has time for; the rest in the next ones. */
  function follow(): void {
    const end = performance.now() + SHARE;
    do {
      if (!later && !stale) return;
      if (!later) [later, stale] = [cycle(), false];
      if (later.next().done) later = null;
    } while (performance.now() < end);
    request(false);
  }
  root.querySelectorAll("details").forEach((d) => d.addEventListener("toggle", () => request(true)));
  const keys: Document | HTMLElement = options.full ? document : root;
  const key = (e: Event): void => press(e as KeyboardEvent);
  keys.addEventListener("keydown", key);
  function press(e: KeyboardEvent): void {
    const on = e.target as Element;
    if (e.defaultPrevented || on.closest?.(TYPED)) return;
    if ((e.ctrlKey || e.metaKey) && !e.altKey && /^[zy]$/i.test(e.key)) {
      e.preventDefault();
      go(e.key.toLowerCase() === "z" && !e.shiftKey);
    } else if (e.ctrlKey || e.metaKey || e.altKey || kernel.count < 2) return;
    else if (e.key === " " && !on.closest?.(PRESSED)) {
      e.preventDefault();
      play();
    } else if (".,><:;".includes(e.key)) step((".>:".includes(e.key) ? 1 : -1) * (".,".includes(e.key) ? 1 : STRIDE)); // with Shift, by keyboard
  }
  kernel.at(view.t);
  fit();
  return {
    kernel, data, times, show, stage: s,
    opened() {
      resize();
      frame();
      inputs.update();
      s.choose(view.chosen);
    },
    set(to) {
      gate.change(to);
      history.note();
      fit(true);
      request(true);
      inputs.update();
    },
    text: () => modelText(data, kernel),
    pose: () => kernel.motion.placed(),
    redraw: () => request(true),
    observed: [paper, side], resize,
    remove() {
      stop();
      gone = true;
      cancelAnimationFrame(asked);
      keys.removeEventListener("keydown", key);
    },
  };
}
