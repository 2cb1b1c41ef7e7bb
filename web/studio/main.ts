/** The studio: tools, drawing, forces, file. Everything it shows of mechanics comes from the server and from `mount`. */

import { mount, type Page } from "../src/page";
import { html } from "../src/svg";
import { Answers } from "./answers";
import { Canvas, make } from "./canvas";
import { Editor } from "./editor";
import { Hand, type Tool, TOOLS } from "./hand";
import { Inspector } from "./inspector";
import { Socket } from "./socket";
import type { Drawing, Picked, State } from "./state";
import { figures } from "./state";
import style from "./studio.css?inline";

const root = document.getElementById("studio")!;
html("style", document.head).textContent = style;
const bar = html("header", root), banner = html("div", root, { class: "banners", role: "status" }), main = html("main", root);
const rail = html("nav", main, { "aria-label": "tools" }), left = html("section", main, { class: "left" }), right = html("section", main, { class: "right" });
const paper = html("div", left, { class: "paper" }), hint = html("p", paper, { class: "hint", role: "status" }), foot = html("div", left, { class: "foot" }), verdict = html("p", foot, { class: "verdict", role: "status" });
const tabs = html("div", right, { class: "tabs", role: "tablist" }), panes = new Map<string, HTMLElement>();

let state: State | null = null, picked: Picked | null = null, page: Page | null = null, mounted = false, fitted = false;
let said = 0;

const socket = new Socket({ state: update, forces, refused: say, ended });
const canvas = new Canvas(paper);
make(canvas.svg, "defs").innerHTML = ["driven", "acting"].map((id) => `<marker id="${id}" class="${id}" viewBox="0 0 10 10" refX="8" refY="5" markerWidth="5" markerHeight="5" orient="auto-start-reverse"><path d="M0 0L10 5L0 10Z"/></marker>`).join("");
const hand = new Hand(canvas, socket, { drawing, pick, picked: () => picked, said: (text) => (hint.textContent = text), again: draw, tool: chosen, step, now: () => state!.drawing });
const pane = (name: string): HTMLElement => {
  const el = html("div", right, { class: `pane ${name.toLowerCase()}`, role: "tabpanel", "aria-label": name });
  html("button", tabs, { type: "button", role: "tab", "data-pane": name }, name).addEventListener("click", () => open(name));
  panes.set(name, el);
  return el;
};
const partPane = pane("Part"), forcePane = pane("Forces"), filePane = pane("File"), answerPane = pane("Answers"), openPane = pane("Problems");
const inspector = new Inspector(partPane, socket, pick);
const editor = new Editor(filePane, socket, step);
const answers = new Answers(answerPane, socket, () => editor.flush(), () => state!.analysed);
open("Part");

const button = (parent: HTMLElement, text: string, title: string, act: () => void): HTMLButtonElement => {
  const b = html("button", parent, { type: "button", title }, text);
  b.addEventListener("click", act);
  return b;
};
const name = html("strong", bar), undo = button(bar, "↶", "Undo (Ctrl+Z)", () => step(true)), redo = button(bar, "↷", "Redo (Ctrl+Shift+Z)", () => step(false));
undo.setAttribute("aria-label", "undo");
redo.setAttribute("aria-label", "redo");
button(bar, "Save", "Save (Ctrl+S)", () => void save());
button(bar, "Save as", "Save under another name in the same folder", () => {
  const other = window.prompt("Name of the new file, in the same folder", state?.file);
  if (other) void save(other);
});
const more = html("span", bar, { class: "more" });
const dynamics = check(more, "dynamics", "with inertia, where a drive has a speed", (on) => ({ static: !on, friction: friction.checked })), friction = check(more, "friction", "with the friction that the file gives", (on) => ({ static: !dynamics.checked, friction: on }));
button(more, "Report", "Worked solution as HTML", () => void download("report"));
button(more, "Design", "Design report of the machine as HTML", () => void download("design"));
button(more, "Page", "Live page as one HTML file", () => void download("page"));
for (const tool of TOOLS) {
  const b = button(rail, "", `${tool.title} (${tool.key.toUpperCase()})`, () => hand.choose(tool));
  b.dataset.tool = tool.name;
  b.setAttribute("aria-label", tool.name);
  b.innerHTML = `<span class="${tool.name}">${tool.name.replace("_", " ")}</span><kbd>${tool.key.toUpperCase()}</kbd>`;
}
button(rail, "fit", "Show everything (0)", () => (canvas.window.fit(drawing()), draw()));
chosen(TOOLS[0]);
document.addEventListener("keydown", (e) => {
  if ((e.ctrlKey || e.metaKey) && e.key.toLowerCase() === "s") {
    e.preventDefault();
    void save();
  }
});
new ResizeObserver(draw).observe(paper);
window.addEventListener("beforeunload", (e) => {
  void editor.flush();
  if (state?.dirty) e.preventDefault();
});

/** One step back or forward, from all that was typed. */
function step(back: boolean): void {
  void editor.flush().then(() => socket.send(back ? { undo: true } : { redo: true }));
}
function check(parent: HTMLElement, text: string, title: string, options: (on: boolean) => object): HTMLInputElement {
  const line = html("label", parent, { title }), input = html("input", line, { type: "checkbox" });
  input.checked = true;
  line.append(text);
  input.addEventListener("change", () => void socket.send({ options: options(input.checked) }));
  return input;
}
function drawing(): Drawing {
  return hand?.shadow ?? state?.drawing ?? ({ links: [], joints: [], loads: [], drives: [], freedoms: 0, closed: true, title: "", units: { length: { unit: "mm", size: 1e-3 } } } as unknown as Drawing);
}
function draw(): void {
  if (state) canvas.draw(drawing(), picked);
}
function pick(p: Picked | null): void {
  picked = p;
  draw();
  if (state) inspector.update(state.drawing, picked, state.text);
  if (p && matchMedia("(min-width:761px)").matches && current() !== "Forces") open("Part");
}
function chosen(tool: Tool): void {
  for (const b of rail.querySelectorAll("button")) b.setAttribute("aria-pressed", String(b.dataset.tool === tool.name));
  canvas.svg.dataset.tool = tool.name;
  hint.textContent = tool.title;
}
const current = (): string => tabs.querySelector<HTMLElement>("[aria-selected=true]")?.dataset.pane ?? "";
function open(which: string): void {
  for (const b of tabs.querySelectorAll<HTMLElement>("button")) b.setAttribute("aria-selected", String(b.dataset.pane === which));
  for (const [one, el] of panes) el.hidden = one !== which;
  right.dataset.pane = which;
  if (which === "Forces") page?.redraw();
  if (which === "Problems") openPane.childElementCount ? void ticks() : void problems();
}
function update(s: State): void {
  const first = !state;
  state = s;
  if (hand.shadow && s.drawing.links) hand.shadow = null;
  if (picked && !exists(s.drawing, picked)) picked = null;
  name.textContent = `${s.file}${s.dirty ? " •" : ""}`;
  document.title = `${s.dirty ? "• " : ""}${s.file} – dalembert studio`;
  [undo.disabled, redo.disabled, dynamics.checked, friction.checked] = [!s.undo, !s.redo, !s.static, s.friction];
  editor.update(s.text, s.hash, s.error, s.line);
  inspector.update(s.drawing, picked, s.text);
  if (first || (!fitted && s.drawing.links?.length > 1)) {
    fitted = (s.drawing.links?.length ?? 0) > 1;
    if (first) canvas.window.fit(s.drawing);
  }
  banners(s);
  if (shown?.of === s.analysed && last !== "{}") void forces(shown); // what was changed in the page was taken back
  speak();
  draw();
}
function exists(d: Drawing, p: Picked): boolean {
  if (p.kind === "points") return !!d.links?.find((l) => l.name === p.link && p.name in l.points);
  return !!(d[p.kind] as { name: string }[] | undefined)?.some((one) => one.name === p.name);
}
function verdictIs(text: string, wrong: boolean): void {
  verdict.textContent = text.charAt(0).toUpperCase() + text.slice(1);
  verdict.classList.toggle("wrong", wrong);
}
/** The forces of the last text, or the sentence of what is missing. */
async function forces(a: Forces): Promise<void> {
  waiting = a;
  if (mounting) return; // one page at a time is put in; the last one stays
  mounting = true;
  try {
    while (waiting) {
      const next: Forces = waiting;
      waiting = null;
      if (next.data) await put(next);
      answer = next;
    }
  } finally {
    mounting = false;
  }
  speak();
}
async function put(a: Forces): Promise<void> {
  if (mounted && page) {
    const anew = a.data.start !== page.data.start || a.data.kernel.count !== page.data.kernel.count;
    await page.replace(a.data, null, anew); // the text is the truth, also of the assembly
  } else {
    mounted = true;
    page = await mount(forcePane, a.data, { edited: (values) => void edited(values) });
  }
  [shown, last] = [a, "{}"];
}
/** What the verdict speaks of, the forces that are shown, and those that are not yet shown; `of`: of which text and options. */
interface Forces { of: string; missing?: string; data?: any }
let answer: Forces | null = null, shown: Forces | null = null, waiting: Forces | null = null, mounting = false, spoken = "", last = "{}";
/** What is known of the present text: its fault, what is missing with what would add it, or the efforts; nothing of another one. */
function speak(): void {
  if (!state) return;
  const now = answer?.of === state.analysed ? answer : null, what = JSON.stringify([state.analysed, state.error, state.line, now?.of, now?.missing]);
  forcePane.classList.toggle("stale", shown?.of !== state.analysed);
  answers.update();
  if (now) void ticks();
  if (spoken === what) return;
  spoken = what;
  if (state.error) verdictIs(`Line ${state.line}: ${state.error}`, true);
  else if (!now) verdictIs("…", false);
  else if (now.missing === undefined) numbers();
  else {
    verdictIs(now.missing, false);
    offers(now.missing);
  }
}
/** True if the state is that after all that was done. */
function answered(): boolean {
  return !!state && socket.idle && editor.idle;
}
/** True if all that was done is answered, and shown as far as it has an answer. */
function settled(): boolean {
  return answered() && !mounting && answer?.of === state!.analysed;
}
/** Numbers that were changed in the page go into the text; the page has those of the text again where they do not. */
async function edited(values: Record<string, number>): Promise<void> {
  const text = JSON.stringify(values), of = shown;
  if (text === last) return;
  last = text;
  if (text !== "{}") await socket.gesture({ op: "changes", values });
  if (of && of === shown && of.of === state!.analysed && text === last) void forces(of);
}
/** The efforts of the drives where the file begins, as it is drawn. */
function numbers(): void {
  if (!page || page.sketch) return;
  const { kernel, data } = page, at = Math.round(data.start), efforts = data.views.table.filter((row) => row.name.startsWith("effort"));
  const of = efforts.map((row) => `${row.name.replace(/[_{}]/g, "")} (${row.kind === "moment" ? "torque" : "force"}): ${figures(kernel.rows[row.rows[0] * kernel.row + at] / data.units[row.kind].size, 5).replace("-", "−")} ${data.units[row.kind].unit}`);
  const solved = kernel.good[at] === 1, drives = state!.drawing.drives;
  verdictIs(solved ? `${of.join("; ") || "In equilibrium"}${of.length ? " as drawn" : ""}. All forces: tab Forces.` : "No forces at the drawn position: see tab Forces", !solved);
  for (const { joint, written } of drives.length === 1 ? drives : [])
    if (solved && typeof written?.position === "number" && state!.drawing.joints.some((j) => j.name === joint && j.type === "pin")) button(verdict, "Whole turn", "Drive it through a full turn", () => void socket.gesture({ op: "drive", joint, whole_turn: true }));
}
function offers(missing: string): void {
  const d = drawing();
  if (d.space || !missing.includes("drive") || d.freedoms <= d.drives.length) return;
  const free = d.joints.filter((j) => j.freedoms.length === 1 && !d.drives.some((v) => v.joint === j.name));
  const best = free.filter((j) => j.links.includes("ground")).concat(free).filter((j, k, all) => all.indexOf(j) === k).slice(0, 3);
  for (const j of best) button(verdict, `Drive ${j.name}`, "", () => void socket.gesture({ op: "drive", joint: j.name, here: Object.values(j.here ?? { turn: 0 })[0] ?? 0 }));
}
function say(sentence: string): void {
  const line = html("p", banner, { class: "refusal", role: "alert" }, sentence);
  clearTimeout(said);
  for (const other of [...banner.querySelectorAll(".refusal")].slice(0, -1)) other.remove();
  said = window.setTimeout(() => line.remove(), 9000);
}
function ended(sentence: string): void {
  for (const old of banner.querySelectorAll(".ended")) old.remove();
  html("p", banner, { class: "ended", role: "alert" }, sentence);
}
function banners(s: State): void {
  banner.querySelectorAll(".choice").forEach((x) => x.remove());
  const choice = (sentence: string, ...acts: [string, string][]): void => {
    const line = html("p", banner, { class: "choice" }, sentence);
    for (const [text, which] of acts) button(line, text, "", () => void socket.send({ choose: which }));
  };
  if (s.kept) choice("This is what was not saved when the studio last ended. ", ["Keep it", "kept"], ["Go back to the saved file", "forget"]);
  if (s.outside) choice(`${s.file} was changed by another program. `, ["Load it (undo brings this back)", "disk"], ["Keep this one", "mine"]);
}
async function save(as: string | true = true): Promise<void> {
  await editor.flush();
  const a = await socket.send({ save: as });
  if (a.said) hint.textContent = a.said;
}
async function download(ask: string): Promise<void> {
  await editor.flush();
  hint.textContent = "Computing …";
  const a = await socket.send({ ask });
  hint.textContent = "";
  if (!a.file) return a.error && say(a.error);
  const bytes = Uint8Array.from(atob(a.file), (c) => c.charCodeAt(0)), link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes], { type: "text/html" }));
  link.download = `${state!.file.replace(/\.\w+$/, "")}${ask === "page" ? "" : `_${ask}`}.${a.ending}`;
  link.click();
  hint.textContent = `${link.download} is in your downloads${a.of === state!.analysed ? "" : "; the mechanism has changed since"}`;
}
async function problems(): Promise<void> {
  const all: { kind: string; name: string; title: string }[] = (await socket.send({ problems: true })).problems;
  const find = html("input", openPane, { type: "search", placeholder: "search", "aria-label": "search problems" }), list = html("div", openPane, { class: "list" });
  const one = (said: string, asked: unknown, title = ""): HTMLElement =>
    button(list, said, title, () => void socket.send({ open: asked }).then(() => {
      canvas.window.fit(drawing());
      draw();
    }));
  one("Empty drawing", "empty");
  for (const kind of ["template", "example", "problem"]) {
    html("h3", list, {}, { template: "Templates", example: "Examples", problem: "Published problems, with their answers" }[kind]!);
    for (const p of all.filter((x) => x.kind === kind)) one(kind === "template" ? `${p.name.replaceAll("_", " ")}: ${p.title}` : p.title, { kind, name: p.name }, p.name);
  }
  find.addEventListener("input", () => list.querySelectorAll("button").forEach((b) => (b.hidden = !b.textContent!.toLowerCase().includes(find.value.toLowerCase()))));
  find.after(ticked);
  void ticks();
}
const ticked = html("div", null, { class: "answers" });
let tickedOf = "", ticking = false;
/** The answers that the file prints, each with a tick where the computed one agrees; asked anew of each text while they are in sight. */
async function ticks(): Promise<void> {
  if (!state || tickedOf === state.analysed) return;
  ticked.replaceChildren();
  if (ticking || current() !== "Problems" || answer?.of !== state.analysed) return;
  ticking = true;
  const a = /answers/.test(state.text) ? await socket.send({ ask: "check" }) : { of: state.analysed };
  ticking = false;
  if (a.refused) return void setTimeout(() => void ticks(), 1000); // other questions come first
  if (a.of !== state.analysed) return void ticks();
  tickedOf = a.of;
  ticked.replaceChildren();
  for (const row of a.rows ?? []) html("p", ticked, { class: row.ok ? "ok" : "off", title: row.why }, `${row.ok ? "✓" : "✗"} ${row.quantity}: printed ${row.published}, computed ${row.computed}`);
  if (a.error) html("p", ticked, { class: "off" }, a.error);
}
Object.assign(window, { studio: { state: () => state, page: () => page, answered, settled, solved: () => settled() && !!answer!.data, pick, canvas, hand, socket, editor } });
