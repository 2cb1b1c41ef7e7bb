/** `mount(element, data)`: the page of one mechanism; the same for a file, a notebook and, later, a studio. */

import { type Board, board, heightFor } from "./board";
import { figures } from "./charts";
import type { Curve, Data } from "./data";
import { handles } from "./handles";
import { Kernel } from "./kernel";
import style from "./page.css?inline";
import { methodPanel, numbersPanel, panel } from "./panels";
import { results } from "./results";
import { html, plain } from "./svg";
import { toolbar } from "./toolbar";
import { change, changes, Cloud, csvText, fileName, fragment, Gradients, History, modelText, restore, save, svgText } from "./tools";

type Changes = Record<string, number>;
/** ``changes``: to begin with, by path; ``edited`` is told all there are after each. ``address``: they stand there. */
export interface Options { changes?: Changes; edited?: (changes: Changes) => void; address?: boolean }
export interface Page {
  kernel: Kernel; data: Data; times: number[]; set(changes: Changes): void; show(t: number): void; text(): string; remove(): void;
}

/** Width in mm of the drawing, on a screen and on a phone, where letters must not shrink with it. */
const WIDE = 170, NARROW = 105;
/** Seconds of a cycle that is played. */
const CYCLE = 6;

export async function mount(el: HTMLElement, data: Data, options: Options = {}): Promise<Page> {
  if (data.format !== "dalembert-page/1") throw new Error(`this page cannot show data of the form ${data.format}`);
  const kernel = await Kernel.create(data), root = document.createElement("div"), times: number[] = [];
  const narrow = (el.clientWidth || window.innerWidth) < 560, wide = narrow ? NARROW : WIDE;
  root.className = "dalembert";
  root.tabIndex = -1;
  const dark = `@media (prefers-color-scheme:dark){${data.style.dark}}@media print{${data.style.light}}`;
  html("style", root).textContent = style + data.style.light + dark;
  if (options.changes) change(data, kernel, options.changes);
  let t = options.address ? restore(data, kernel, location.hash) : 0, asked = 0, whole = true, runs = 0;
  kernel.cycle();
  const history = new History(kernel);
  const curves = data.views.charts.flatMap((c) => c.curves.map((curve) => ({ curve, unit: data.units[c.kind] })));
  let picked = curves.find((c) => data.gradient?.curves.includes(c.curve.row));

  const bar = toolbar(root, data, kernel, { play, show, go, reset });
  const main = html("main", root), stage = html("section", main, { class: "stage", "aria-label": "mechanism" });
  const drawing = data.views.mechanism;
  const m = board(stage, kernel, drawing, null, wide, heightFor(kernel, drawing, wide), data.units, "the mechanism");
  const gradients = new Gradients(m, data, kernel);
  const cloud = new Cloud(stage, m, data, kernel, data.handles.flatMap((h) => (h.kind === "joint" || h.kind === "point" ? [h.p] : [])));
  const updateHandles = handles(m, data, kernel, { changed: () => request(true), finished, seek: show, time: () => t });
  const side = html("section", main, { class: "side", "aria-label": "results" });
  const pick = (c: Curve) => ((picked = curves.find((x) => x.curve === c)), request(true));
  const shown = results(side, data, kernel, { time: () => t, seek: show, pick, picked: () => picked?.curve }, () => request(true), narrow);
  const spread = switches();
  const inputs = numbersPanel(panel(side, "Change numbers", data.numbers.some((n) => n.parameter)), data, kernel, (done) => (done ? finished() : request(true)));
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
    if (data.gradient) toggle("what lowers the peak", "arrows: moving a joint this way lowers the peak of the chosen curve", false, (on) => (gradients.on = on));
    if (data.handles.some((h) => h.kind === "joint")) toggle("tolerances", "a thousand machines with points up to 0.5 % of the drawing's width off", false, (on) => (cloud.on = on));
    if (m.paper.axes.length > 2) {
      html("span", box, {}, "drag to look from elsewhere");
      orbit([m, ...shown.bodies], () => request(true));
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
  /** After a change that can be undone. */
  function finished(): void {
    history.note();
    m.fit();
    tell();
  }
  function reset(): void {
    change(data, kernel, {});
    finished();
  }
  function go(back: boolean): void {
    if (history.go(back)) tell();
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
    root.classList.toggle("unsolved", !kernel.solved);
    m.update(all);
    updateHandles();
    gradients.update(picked?.curve);
    const s = cloud.update(picked?.curve.row);
    spread.textContent = s && picked ? `${plain(picked.curve.name)}: ${figures(s.mean / picked.unit.size)} ± ${figures(s.sigma / picked.unit.size, 2)} ${picked.unit.unit} (1 σ)` : "";
    shown.update(all);
    bar.update(t, history.can);
  }
  root.querySelectorAll("details").forEach((d) => d.addEventListener("toggle", () => request(true)));
  root.addEventListener("keydown", (e) => {
    const typing = /INPUT|SELECT|TEXTAREA/.test((e.target as Element).tagName);
    if ((e.ctrlKey || e.metaKey) && !typing && /^[zy]$/i.test(e.key)) {
      e.preventDefault();
      go(e.key.toLowerCase() === "z" && !e.shiftKey);
    } else if (e.key === " " && !typing && (e.target as Element).tagName !== "BUTTON" && kernel.count > 1) {
      e.preventDefault();
      play();
    }
  });
  kernel.at(t);
  el.replaceChildren(root);
  m.fit();
  frame();
  inputs.update();
  return {
    kernel, data, times, show,
    set(to) {
      change(data, kernel, to);
      history.note();
      m.fit();
      request(true);
      inputs.update();
    },
    text: () => modelText(data, kernel),
    remove: () => (stop(), root.remove()),
  };
}

/** In space the background is dragged to look from elsewhere. */
function orbit(boards: Board[], again: () => void): void {
  for (const one of boards) {
    one.svg.style.cursor = "move";
    one.svg.addEventListener("pointerdown", (e) => one.svg.setPointerCapture(e.pointerId));
    one.svg.addEventListener("pointermove", (e) => {
      if (!one.svg.hasPointerCapture(e.pointerId)) return;
      for (const b of boards) {
        b.paper.turn(-0.01 * e.movementX, 0.01 * e.movementY);
        b.fit();
      }
      again();
    });
  }
}
