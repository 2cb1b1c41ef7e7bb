/** `mount(element, data)`: the page of one mechanism; the same for a file, a notebook and, later, a studio. */

import { board, heightFor } from "./board";
import { chart, figures, polar, polygon } from "./charts";
import type { Curve, Data } from "./data";
import { handles } from "./handles";
import { Kernel } from "./kernel";
import { answersPanel, equations, methodPanel, numbersPanel, panel } from "./panels";
import style from "./page.css?inline";
import { html, plain } from "./svg";
import { Cloud, csvText, fileName, fragment, Gradients, History, modelText, restore, save, svgText } from "./tools";

export interface Options { edited?: (changes: Record<string, number>) => void; address?: boolean }
export interface Page {
  kernel: Kernel; data: Data; set(path: string, value: number): void; show(t: number): void; text(): string; times: number[]; remove(): void;
}

export async function mount(el: HTMLElement, data: Data, options: Options = {}): Promise<Page> {
  if (data.format !== "dalembert-page/1") throw new Error(`this page cannot show data of the form ${data.format}`);
  const kernel = await Kernel.create(data), root = document.createElement("div");
  root.className = "dalembert";
  kernel.cycle();
  const css = html("style", root);
  css.textContent = style + data.style.light + `@media (prefers-color-scheme:dark){${data.style.dark}}` + "@media print{" + data.style.light + "}";
  const history = new History(kernel), times: number[] = [];
  let t = options.address ? restore(data, kernel, location.hash) : 0;
  history.note();
  const header = html("header", root), main = html("main", root);
  html("h1", header, {}, data.title);
  const bar = html("div", header, { class: "bar", role: "toolbar", "aria-label": "cycle and page" });
  const button = (name: string, said: string, act: () => void): HTMLButtonElement => {
    const b = html("button", bar, { type: "button", title: said, ...(/^\w/.test(name) ? {} : { "aria-label": said }) }, name);
    b.addEventListener("click", act);
    return b;
  };
  const playing = button("▶", "play along the cycle (space)", () => play());
  const slider = html("input", bar, { type: "range", min: 0, max: kernel.end, step: data.only_at_positions ? 1 : "any", "aria-label": "place of the cycle" });
  const readout = html("output", bar, { class: "readout" });
  const undo = button("↶", "undo (Ctrl+Z)", () => go(true)), redo = button("↷", "redo (Ctrl+Y)", () => go(false));
  button("Reset", "all numbers as in the file", () => {
    kernel.values.set(data.numbers.map((n) => n.value));
    finished([]);
    changed();
  });
  const mark = html("p", header, { class: "mark", role: "status" });
  for (const x of [playing, slider, readout]) x.hidden = kernel.count < 2;

  const stage = html("section", main, { class: "stage", "aria-label": "mechanism" });
  const m = board(stage, kernel, data.views.mechanism, null, 170, heightFor(kernel, data.views.mechanism, 170), data.units, "the mechanism");
  let picked: Curve | undefined = data.views.charts.flatMap((c) => c.curves).find((c) => data.gradient?.curves.includes(c.row));
  const gradients = new Gradients(m, data, kernel);
  const cloud = new Cloud(stage, m, data, kernel, data.handles.flatMap((h) => (h.kind === "joint" || h.kind === "point" ? [h.p] : [])));
  const updateHandles = handles(m, data, kernel, { changed: () => changed(), finished, seek: (x) => show(x), time: () => t }, () => m.force());
  const switches = html("div", stage, { class: "switches" });
  const toggle = (said: string, title: string, on: boolean, act: (on: boolean) => void): HTMLInputElement => {
    const line = html("label", switches, { title }), box = html("input", line, { type: "checkbox" });
    box.checked = on;
    line.append(said);
    box.addEventListener("change", () => (act(box.checked), request(true)));
    return box;
  };
  toggle("names", "names of joints", m.names, (on) => (m.names = on));
  if (data.gradient) toggle("what lowers the peak", "arrows: moving a joint this way lowers the peak of the chosen curve", false, (on) => (gradients.on = on));
  if (data.handles.some((h) => h.kind === "joint")) toggle("tolerances", "a thousand machines with points up to 0.5 % of the drawing's width off", false, (on) => (cloud.on = on));
  const spread = html("span", switches, { class: "spread" });

  const side = html("section", main, { class: "side", "aria-label": "results" });
  const seek = (x: number) => show(x), pick = (c: Curve) => ((picked = c), request(true));
  const views = [...(kernel.count > 1 ? data.views.charts.map((c) => chart(side, data, kernel, c, () => t, seek, pick, () => picked)) : [])];
  const select = html("select", panelOf("Free body", true), { "aria-label": "link" });
  data.views.bodies.forEach((b, k) => (html("option", select, { value: k }, `${b.title}${b.member && `, ${b.member} member`}`)));
  const bodyBox = html("div", select.parentElement!);
  const bodies = data.views.bodies.map((b) => {
    const box = html("div", bodyBox, { class: "body" });
    const drawn = board(box, kernel, b, b.about, 110, 100, data.units, `free body of ${b.title}`);
    return { box, drawn, sums: equations(box, data, kernel, b) };
  });
  const polygonBox = data.views.polygons.links.length ? panelOf("Force polygon") : html("div", null);
  const polygons = data.views.polygons.links.map((p) => polygon(polygonBox, data, kernel, p));
  const polars = kernel.count > 2 ? data.views.charts.flatMap((c) => c.curves).filter((c) => c.f) : [];
  const polarBox = polars.length ? panelOf("Polar diagrams") : null;
  const polarViews = polarBox ? polars.map((c) => polar(polarBox, kernel, c, data.units.force)) : [];
  const answers = answersPanel(panelOf("Numbers of this position"), data, kernel);
  const inputs = numbersPanel(panelOf("Change numbers", data.numbers.some((n) => n.parameter)), data, kernel, (n, done) => {
    changed();
    if (done) finished([n]);
  });
  methodPanel(panelOf("Method and assumptions"), data);
  files();

  function panelOf(title: string, open = false): HTMLElement {
    return panel(side, title, open);
  }
  function files(): void {
    const box = panelOf("Save and share"), name = fileName(data.title);
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
  select.addEventListener("change", () => request(false));
  m.svg.addEventListener("click", (e) => {
    const link = (e.target as Element).closest<SVGElement>("[data-link]")?.dataset.link;
    const k = data.views.bodies.findIndex((b) => b.link === link);
    if (k >= 0) (select.value = String(k)), request(false);
  });
  slider.addEventListener("input", () => show(+slider.value));
  if (data.views.mechanism.arrows.concat(...data.views.bodies.map((b) => b.arrows)).some((a) => a.p.length > 2)) orbit();

  /** In space the background is dragged to look from elsewhere. */
  function orbit(): void {
    const papers = [m, ...bodies.map((b) => b.drawn)];
    html("span", switches, {}, "drag to look from elsewhere");
    for (const one of papers) {
      one.svg.style.cursor = "move";
      one.svg.addEventListener("pointerdown", (e) => one.svg.setPointerCapture(e.pointerId));
      one.svg.addEventListener("pointermove", (e) => {
        if (!one.svg.hasPointerCapture(e.pointerId)) return;
        for (const p of papers) {
          p.paper.azimuth -= 0.01 * e.movementX;
          p.paper.elevation = Math.min(Math.max(p.paper.elevation + 0.01 * e.movementY, -1.55), 1.55);
          p.fit();
        }
        request(true);
      });
    }
  }

  let asked = 0, whole = true, runs = 0;
  function changed(): void {
    request(true);
  }
  function finished(numbers: number[]): void {
    history.note();
    m.fit();
    request(true);
    inputs.update();
    if (options.edited && numbers.length) options.edited(Object.fromEntries(numbers.map((n) => [data.numbers[n].path, kernel.values[n]])));
    if (options.address) window.history.replaceState(null, "", "#" + fragment(data, kernel, t));
  }
  function go(back: boolean): void {
    if (!history.go(back)) return;
    request(true);
    inputs.update();
    options.edited?.(Object.fromEntries(data.numbers.map((n, k) => [n.path, kernel.values[k]])));
  }
  function show(place: number): void {
    t = Math.min(Math.max(place, 0), kernel.end);
    if (data.only_at_positions) t = Math.round(t);
    request(false);
  }
  function play(): void {
    if (runs) return stop();
    playing.textContent = "❚❚";
    let before = performance.now();
    const seconds = 6;
    const step = (now: number) => {
      const next = t + ((now - before) / 1000 / seconds) * kernel.end;
      before = now;
      show(next >= kernel.end ? 0 : next);
      if (!data.only_at_positions || next >= 1) runs = requestAnimationFrame(step);
    };
    runs = requestAnimationFrame(step);
  }
  function stop(): void {
    cancelAnimationFrame(runs);
    runs = 0;
    playing.textContent = "▶";
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
    const solved = kernel.solved, said = data.statuses[String(kernel.mark)];
    root.classList.toggle("unsolved", !solved);
    mark.textContent = said && kernel.mark ? said.sentence : "";
    m.update(all);
    updateHandles();
    gradients.update(picked);
    const s = cloud.update(picked?.row);
    spread.textContent = s && picked ? spreadText(s, picked) : "";
    views.forEach((v) => v.update(all));
    const k = +select.value;
    bodies.forEach((b, n) => {
      b.box.hidden = n !== k;
      if (n === k && open(b.box)) b.drawn.update(all), b.sums.update();
    });
    polygons.forEach((p, n) => {
      p.figure.hidden = n !== k;
      if (n === k && open(p.figure)) p.update(all);
    });
    polarViews.forEach((p) => p.update(all));
    if (open(polygonBox) || true) answers.update();
    slider.value = String(t);
    readout.textContent = data.drives.map((d) => `${d.name} = ${figures(kernel.position(d.name, t) / d.size, 5)}${d.unit === "°" ? "" : " "}${d.unit}`).join(", ");
    [undo.disabled, redo.disabled] = history.can.map((x) => !x);
  }
  const open = (e: Element): boolean => e.closest("details")?.open ?? true;
  function spreadText(s: { mean: number; sigma: number }, c: Curve): string {
    const kind = data.views.charts.find((x) => x.curves.includes(c))!.kind, unit = data.units[kind] ?? { unit: "", size: 1 };
    return `${plain(c.name)}: ${figures(s.mean / unit.size)} ± ${figures(s.sigma / unit.size, 2)} ${unit.unit} (1 σ)`;
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
  root.tabIndex = -1;
  kernel.cycle();
  kernel.at(t);
  el.replaceChildren(root);
  m.fit();
  frame();
  inputs.update();
  return {
    kernel, data, times, show,
    set(path, value) {
      const n = data.numbers.findIndex((x) => x.path === path);
      if (n < 0) throw new Error(`there is no number ${path}`);
      kernel.values[n] = value;
      finished([]);
    },
    text: () => modelText(data, kernel),
    remove: () => (stop(), root.remove()),
  };
}
