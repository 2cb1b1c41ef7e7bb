/** `mount(element, data)`: the page of one mechanism; the same for a file, a notebook and, later, a studio. */

import { type Board, board } from "./board";
import type { Curve, Data } from "./data";
import { gapMarks } from "./gap";
import { Gate } from "./gate";
import { handles } from "./handles";
import { Kernel } from "./kernel";
import style from "./page.css?inline";
import { methodPanel, numbersPanel, panel } from "./panels";
import { results } from "./results";
import { Reasons } from "./sentences";
import { figures, html, plain } from "./svg";
import { toolbar } from "./toolbar";
import { changes, Cloud, csvText, fileName, fragment, Gradients, History, modelText, restore, save, svgText } from "./tools";

type Changes = Record<string, number>;
/** ``changes``: initial ones, by path; ``edited`` receives all changes after each one. ``address``: they are
 * kept in it. ``full``: the page fills its window and uses its keys. */
export interface Options { changes?: Changes; edited?: (changes: Changes) => void; address?: boolean; full?: boolean }
export interface Page {
  kernel: Kernel; data: Data; times: number[]; set(changes: Changes): void; show(t: number): void; text(): string; remove(): void;
}

/** Least and greatest number of pixels per mm of the drawing: letters are readable in every window. */
const LEAST = 3.6, MOST = 5.2;
/** Elements in which letters are typed, and those that a space presses or opens. */
const TYPED = "input:not([type=range],[type=checkbox]),textarea,[contenteditable]";
const PRESSED = "button,summary,select,a,input[type=checkbox],[role=button]";
/** Seconds per cycle of the animation. */
const CYCLE = 6;

export async function mount(el: HTMLElement, data: Data, options: Options = {}): Promise<Page> {
  if (data.format !== "dalembert-page/1") throw new Error(`this page cannot show data of format ${data.format}`);
  const kernel = await Kernel.create(data), root = document.createElement("div"), times: number[] = [];
  root.className = options.full ? "dalembert full" : "dalembert";
  root.tabIndex = -1;
  const dark = `@media (prefers-color-scheme:dark){${data.style.dark}}@media print{${data.style.light}}`;
  html("style", root).textContent = style + data.style.light + dark;
  const gate = new Gate(data, kernel);
  if (options.changes) gate.change(options.changes);
  let t = options.address ? restore(kernel, gate, location.hash) : 0, asked = 0, whole = true, runs = 0;
  kernel.cycle();
  const history = new History(kernel, gate);
  const curves = data.views.charts.flatMap((c) => c.curves.map((curve) => ({ curve, unit: data.units[c.kind] })));
  let picked = curves.find((c) => data.gradient?.curves.includes(c.curve.row));

  const reasons = new Reasons(data, kernel), bar = toolbar(root, data, kernel, reasons, { play, show, go, reset });
  const main = html("main", root), stage = html("section", main, { class: "stage", "aria-label": "mechanism" });
  const paper = html("div", stage, { class: "paper" });
  const m = board(paper, kernel, data.views.mechanism, null, 170, 119, data.units, "the mechanism");
  const gradients = new Gradients(m, data, kernel);
  const cloud = new Cloud(paper, m, data, kernel, data.handles.flatMap((h) => (h.kind === "joint" || h.kind === "point" ? [h.p] : [])));
  const updateHandles = handles(m, data, kernel, { changed: moved, finished, seek: show, time: () => t });
  const updateGaps = gapMarks(m, data, kernel);
  const side = html("section", main, { class: "side", "aria-label": "results" });
  const pick = (c: Curve) => ((picked = curves.find((x) => x.curve === c)), request(true));
  const shown = results(side, data, kernel, { time: () => t, seek: show, pick, picked: () => picked?.curve }, () => request(true));
  const spread = switches();
  const inputs = numbersPanel(panel(side, "Change numbers", data.numbers.some((n) => n.parameter)), data, kernel, gate, (done) => (done ? finished() : moved()));
  methodPanel(panel(side, "Method and assumptions"), data);
  files();
  m.svg.addEventListener("click", (e) => shown.choose((e.target as Element).closest<SVGElement>("[data-link]")?.dataset.link));

  function switches(): HTMLElement {
    const box = html("div", stage, { class: "switches" });
    const toggle = (said: string, title: string, on: boolean, act: (on: boolean) => void): void => {
      const line = html("label", box, { title }), check = html("input", line, { type: "checkbox" });
      check.checked = on;
      line.append(said);
      check.addEventListener("change", () => (act(check.checked), request(true)));
    };
    toggle("names", "names of joints", m.names, (on) => (m.names = on));
    if (data.gradient) toggle("what lowers the peak", "arrows: moving a joint in this direction lowers the peak of the chosen curve", false, (on) => (gradients.on = on));
    if (data.handles.some((h) => h.kind === "joint")) toggle("tolerances", "a thousand machines with points displaced by up to 0.5 % of the drawing's width", false, (on) => (cloud.on = on));
    if (m.paper.axes.length > 2) {
      html("span", box, {}, "drag to rotate the view");
      orbit([m, ...shown.bodies], () => (fit(), request(true)));
    }
    return html("span", box, { class: "spread" });
  }
  function files(): void {
    const box = panel(side, "Save and share"), name = fileName(data.title);
    const one = (said: string, act: () => void) => html("button", box, { type: "button" }, said).addEventListener("click", act);
    one("Model file", () => save(`${name}.yaml`, modelText(data, kernel), "text/yaml"));
    one("Curves as CSV", () => save(`${name}.csv`, csvText(data, kernel), "text/csv"));
    one("Drawing as SVG", () => save(`${name}.svg`, svgText(m.svg, data.style.light), "image/svg+xml"));
    one("Print", () => window.print());
    if (options.address)
      one("Copy link", () => {
        location.hash = fragment(data, kernel, t);
        void navigator.clipboard?.writeText(location.href);
      });
  }
  function tell(): void {
    request(true);
    inputs.update();
    options.edited?.(changes(data, kernel));
    if (options.address) window.history.replaceState(null, "", "#" + fragment(data, kernel, t));
  }
  function moved(): void {
    gate.pass();
    request(true);
  }
  /** Updates after a change that can be undone. */
  function finished(): void {
    const { sentence } = gate;
    if (gate.pass()) gate.sentence = sentence;
    history.note();
    fit();
    tell();
  }
  function reset(): void {
    gate.change({});
    finished();
  }
  function go(back: boolean): void {
    if (!history.go(back)) return;
    fit();
    tell();
  }
  /** New scales for the drawing and the free bodies. */
  function fit(): void {
    kernel.cycle();
    m.fit();
    shown.fit();
  }
  /** Fits the drawing into its area and the charts into their column. */
  function resize(): void {
    const { width, height } = paper.getBoundingClientRect();
    if (width > 0 && height > 0) {
      const pixels = Math.min(Math.max(Math.min(width / 170, height / 105), LEAST), MOST);
      m.resize(width / pixels, height / pixels);
    }
    if (side.clientWidth > 0) shown.resize(side.clientWidth);
    m.fit();
    request(true);
  }
  function show(place: number): void {
    t = Math.min(Math.max(place, 0), kernel.end);
    if (data.only_at_positions) t = Math.round(t);
    request(false);
  }
  function play(): void {
    bar.playing(!runs);
    if (runs) return stop();
    let before = performance.now(), place = t;
    const step = (now: number) => {
      place += ((now - before) / 1000 / CYCLE) * kernel.end;
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
    asked ||= requestAnimationFrame(() => {
      asked = 0;
      const start = performance.now();
      frame();
      times.push(performance.now() - start);
      if (times.length > 2000) times.shift();
    });
  }
  function frame(): void {
    const all = whole;
    whole = false;
    if (all) kernel.cycle();
    kernel.at(t);
    const refused = reasons.refusal();
    if (refused !== kernel.refused) {
      kernel.refused = refused;
      kernel.cycle();
    }
    root.classList.toggle("unsolved", !kernel.solved);
    m.update(all);
    updateHandles();
    updateGaps();
    gradients.update(picked?.curve);
    const s = cloud.update(picked?.curve.row);
    const peak = gradients.on && picked && gradients.peak(picked.curve);
    const lowers = peak && picked ? `arrows lower the peak of ${plain(picked.curve.name)}, now ${figures(peak.size / picked.unit.size)} ${picked.unit.unit}${peak.where}` : "";
    spread.textContent = [lowers, s && picked ? `${plain(picked.curve.name)}: ${figures(s.mean / picked.unit.size)} ± ${figures(s.sigma / picked.unit.size, 2)} ${picked.unit.unit} (1 σ)` : ""].filter(Boolean).join("; ");
    shown.update(all);
    bar.update(t, history.can, gate.sentence);
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
    } else if (e.key === " " && !e.ctrlKey && !e.metaKey && !on.closest?.(PRESSED) && kernel.count > 1) {
      e.preventDefault();
      play();
    }
  }
  kernel.at(t);
  el.replaceChildren(root);
  fit();
  resize();
  frame();
  inputs.update();
  const sized = new ResizeObserver(resize);
  for (const one of [paper, side]) sized.observe(one);
  return {
    kernel, data, times, show,
    set(to) {
      gate.change(to);
      history.note();
      fit();
      request(true);
      inputs.update();
    },
    text: () => modelText(data, kernel),
    remove() {
      stop();
      sized.disconnect();
      keys.removeEventListener("keydown", key);
      root.remove();
    },
  };
}

/** In space, dragging the background rotates the view. */
function orbit(boards: Board[], again: () => void): void {
  for (const one of boards) {
    one.svg.style.cursor = "move";
    one.svg.addEventListener("pointerdown", (e) => one.svg.setPointerCapture(e.pointerId));
    one.svg.addEventListener("pointermove", (e) => {
      if (!one.svg.hasPointerCapture(e.pointerId)) return;
      for (const b of boards) b.paper.turn(-0.01 * e.movementX, 0.01 * e.movementY);
      again();
    });
  }
}
