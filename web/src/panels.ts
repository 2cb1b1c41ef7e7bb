/** Panels beside the drawing: the numbers that can be changed, the results, a free body's equations, the method. */

import type { Data, FreeBody, NumberField, Term } from "./data";
import type { Gate } from "./gate";
import type { Kernel } from "./kernel";
import { figures, html, plain, say } from "./svg";

export interface Numbers { update(): void }

/** Parameters with sliders first, then every other number, grouped by its part. */
export function numbersPanel(parent: Element, data: Data, kernel: Kernel, gate: Gate, changed: (done: boolean) => void): Numbers & { focus(path: string): void } {
  const boxes: { box: HTMLInputElement; slide?: HTMLInputElement; n: number; field: NumberField }[] = [];
  const groups = new Map<string, Element>();
  const group = (name: string): Element => {
    let g = groups.get(name);
    if (!g) {
      const f = html("fieldset", parent);
      html("legend", f, {}, name);
      groups.set(name, (g = f));
    }
    return g;
  };
  const order = data.numbers.map((field, n) => ({ field, n })).sort((a, b) => Number(b.field.parameter ?? false) - Number(a.field.parameter ?? false));
  for (const { field, n } of order) {
    const [owner, rest] = field.parameter ? ["Parameters", field.label] : split(field.label);
    const line = html("label", group(owner), { title: field.about ?? field.path });
    html("span", line, {}, rest);
    const box = html("input", line, { type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", "aria-label": field.label, "data-path": field.path });
    html("span", line, { class: "unit" }, field.unit);
    const wrong = html("span", line, { class: "wrong", role: "alert" }), entry: (typeof boxes)[number] = { box, n, field };
    const say = (sentence: string): void => {
      wrong.textContent = sentence;
      box.toggleAttribute("aria-invalid", !!sentence);
    };
    const typed = () => {
      if (box.value.trim() === "" || box.value === shown(entry)) return say(""), write(entry);
      const sentence = gate.type(n, box.value);
      say(sentence);
      if (sentence) return;
      box.value = shown(entry);
      changed(true);
    };
    box.addEventListener("change", typed);
    box.addEventListener("keydown", (e) => {
      if (e.key !== "Escape") return;
      say("");
      box.value = shown(entry);
      box.blur();
    });
    if (field.parameter) {
      const [low, high] = field.range ?? around(field.value);
      const slide = html("input", line, { type: "range", min: low / field.size, max: high / field.size, step: "any", "aria-label": `${field.label}, slider` });
      entry.slide = slide;
      const slid = (done: boolean) => () => {
        kernel.values[n] = +slide.value * field.size;
        changed(done);
      };
      slide.addEventListener("input", slid(false));
      slide.addEventListener("change", slid(true));
    }
    boxes.push(entry);
  }
  const shown = (e: (typeof boxes)[number]): string => String(+(kernel.values[e.n] / e.field.size).toPrecision(6));
  const write = (e: (typeof boxes)[number]) => {
    const value = kernel.values[e.n] / e.field.size;
    if (document.activeElement !== e.box && !e.box.hasAttribute("aria-invalid")) e.box.value = shown(e);
    if (e.slide && document.activeElement !== e.slide) e.slide.value = String(value);
    e.box.classList.toggle("changed", kernel.values[e.n] !== e.field.value);
  };
  return { update: () => boxes.forEach(write), focus: (path) => boxes.find((b) => b.field.path === path)?.box.focus() };
}

function split(said: string): [string, string] {
  const k = said.indexOf(": ");
  return k < 0 ? ["Others", said] : [said.slice(0, k), said.slice(k + 2)];
}

function around(value: number): [number, number] {
  const reach = 0.5 * Math.abs(value) || 1;
  return [value - reach, value + reach];
}

/** The numbers of this position, with magnitude and direction of vectors. */
export function answersPanel(parent: Element, data: Data, kernel: Kernel): Numbers {
  const table = html("table", parent, { class: "answers" }), body = html("tbody", table);
  const rows = data.views.table.map((r) => {
    const line = html("tr", body), unit = data.units[r.kind];
    html("th", line, { scope: "row" }, plain(r.name));
    return { r, unit, cell: html("td", line) };
  });
  return {
    update() {
      for (const { r, unit, cell } of rows) {
        const v = r.rows.map((n) => kernel.here[n] / unit.size);
        const one = (x: number) => (unit.unit === "°" ? `${figures(x, 5)}°` : `${figures(x)} ${unit.unit}`);
        say(cell, !kernel.solved ? "–" : v.length === 1 ? one(v[0])
          : `${one(Math.hypot(...v))}${v.length === 2 ? ` at ${figures((Math.atan2(v[1], v[0]) * 180) / Math.PI)}°` : ""}  (${v.map((x) => figures(x)).join(", ")})`);
      }
    },
  };
}

/** Sums of forces and moments on a link, in symbols and in numbers. */
export function equations(parent: Element, data: Data, kernel: Kernel, b: FreeBody): Numbers {
  const { terms, about } = b.equations, { force, moment } = data.units, d = terms[0]?.f.length ?? 2;
  const sums = ["x", "y", "z"].slice(0, d).map((x, k) => ({ head: `ΣF${x}`, unit: force, sign: (t: Term) => plain(t.name) + x, row: (t: Term) => t.f[k] }));
  (d === 2 ? [""] : ["x", "y", "z"]).forEach((x, k) =>
    sums.push({ head: `ΣM${x} about ${about}`, unit: moment, sign: (t) => `M${x}(${plain(t.name)})`, row: (t) => t.m[k] }));
  const lines = sums.map((sum) => ({ sum, el: html("p", parent, { class: "equation" }) }));
  return {
    update() {
      for (const { sum, el } of lines) {
        const values = terms.map((t) => kernel.here[sum.row(t)] / sum.unit.size), largest = Math.max(...values.map(Math.abs), 0);
        const some = values.map((v, k) => ({ v, k })).filter((x) => Math.abs(x.v) > 1e-9 * largest);
        if (!kernel.solved || !some.length) {
          el.textContent = `${sum.head}: ${kernel.solved ? "nothing acts" : "no answer here"}`;
          continue;
        }
        const signs = some.map((x) => sum.sign(terms[x.k])).join(" + "), total = some.reduce((t, x) => t + x.v, 0);
        const numbers = some.map((x, k) => (x.v < 0 ? (k ? " − " : "−") : k ? " + " : "") + figures(Math.abs(x.v))).join("");
        el.textContent = `${sum.head}: ${signs} = ${numbers} = ${figures(Math.abs(total) < 1e-9 * largest ? 0 : total)} ${sum.unit.unit}`;
      }
    },
  };
}

export function methodPanel(parent: Element, data: Data): void {
  html("p", parent, {}, "One linear system per position gives forces and motion (D'Alembert's principle); everything shown is recomputed from the numbers beside it, in double precision.");
  const list = html("dl", parent);
  for (const [name, said] of Object.entries(data.assumptions)) {
    html("dt", list, {}, name);
    html("dd", list, {}, said);
  }
  if (data.source) html("p", parent, {}, `Source: ${data.source}`);
  html("p", parent, {}, `Made with dalembert ${data.version}.`);
}
