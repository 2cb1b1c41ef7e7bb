/** What is chosen, with every value that the file gives of it, to be typed anew. */

import type { Socket } from "./socket";
import { type Drawing, figures, type Picked } from "./state";
import { html } from "../src/svg";

/** Keys that are shown of every part, empty where the file has none; the others are offered. */
const MORE: Record<string, string[]> = { links: ["mass", "center", "inertia"], drives: ["position", "speed", "acceleration"] };
/** Keys that are changed by drawing. */
const DRAWN = ["points", "type", "on", "at", "between", "links", "joint"];
const ABOUT: Record<string, string> = {
  position: "position, such as 60, or {from: 0, to: 360, count: 72}", speed: "speed, such as 10 rad/s", mass: "mass, such as 2 kg", center: "centre, such as [20, 0] or 20 @ 0",
  inertia: "inertia about the centre, such as 2e-4 kg*m^2", value: "value, such as 100 N @ -90 or 12 N*m", stiffness: "stiffness, such as 2 N/mm", free_length: "length without load",
};
/** Section -> type of a part -> its keys -> what they mean. */
type Keys = Record<string, Record<string, Record<string, string>>>;

export class Inspector {
  private shownAs = "";
  private building = false;
  private keys: Promise<Keys> | null = null;
  constructor(private readonly el: HTMLElement, private readonly socket: Socket, private readonly pick: (p: Picked | null) => void) {}

  update(d: Drawing, picked: Picked | null, text: string): void {
    const now = JSON.stringify(picked);
    if (this.shownAs === now + text) return; // a refusal stays beside its value
    const on = document.activeElement, typing = this.shownAs.startsWith(now) && on instanceof HTMLInputElement && this.el.contains(on) ? on : null;
    this.shownAs = now + text;
    this.building = true;
    this.el.replaceChildren();
    if (!d.space && d.links) this.build(d, picked, text);
    if (typing) this.goOn(typing);
    this.building = false;
  }
  /** What is being typed is typed on, beside the values of the new text. */
  private goOn(was: HTMLInputElement): void {
    const [from, to] = [was.selectionStart, was.selectionEnd], here = [...this.el.querySelectorAll("input")].find((x) => x.ariaLabel === was.ariaLabel);
    if (!here) this.el.append(was.parentElement!); // a value that the file does not have yet
    else if (was.value !== was.defaultValue) here.value = was.value;
    (here ?? was).focus({ preventScroll: true });
    (here ?? was).setSelectionRange(from, to);
  }
  private build(d: Drawing, picked: Picked | null, text: string): void {
    if (!picked) this.machine(d, text);
    else if (picked.kind === "links") this.link(d, picked.name);
    else if (picked.kind === "joints") this.joint(d, picked.name);
    else if (picked.kind === "loads") this.part("loads", picked.name, d.loads.find((l) => l.name === picked.name)?.written, d.loads.find((l) => l.name === picked.name)?.type ?? "");
    else this.point(d, picked);
  }

  private machine(d: Drawing, text: string): void {
    const gravity = /^gravity: *(\S+)/m.exec(text)?.[1] ?? "none";
    html("h2", this.el, {}, d.title || "Mechanism");
    this.field("title", d.title, (value) => ({ op: "set", path: ["title"], value }));
    this.field("gravity", gravity, (value) => ({ op: "set", path: ["gravity"], value }), "none, standard, or [0, -9.81 m/s^2]");
    const list = html("div", this.el, { class: "parts" });
    const add = (kind: Picked["kind"], name: string, what: string): void => {
      html("button", list, { type: "button", title: what, "data-kind": kind }, name).addEventListener("click", () => this.pick({ kind, name }));
    };
    for (const l of d.links) if (l.name !== "ground") add("links", l.name, "link");
    for (const j of d.joints) add("joints", j.name, j.type);
    for (const l of d.loads) add("loads", l.name, l.type);
    if (d.links.length < 2) html("p", this.el, { class: "hint" }, "Begin with a ground point (X) and a link from it (B); the keys are on the buttons. Or open a template.");
    else html("p", this.el, { class: "hint" }, `${d.freedoms} ${d.freedoms === 1 ? "degree" : "degrees"} of freedom, ${d.drives.length} ${d.drives.length === 1 ? "drive" : "drives"}`);
  }
  private link(d: Drawing, name: string): void {
    const l = d.links.find((one) => one.name === name);
    if (!l) return;
    const u = d.units.length, points = Object.values(l.points);
    this.head("links", name, "link");
    if (l.bar) this.field("length", figures(Math.hypot(points[1][0] - points[0][0], points[1][1] - points[0][1]) / u.size, 8), (value) => ({ op: "length", link: name, value }), `in ${u.unit}, or with a unit`);
    this.values("links", name, l.written);
    for (const point of Object.keys(l.points)) html("button", this.el, { type: "button" }, `point ${point}`).addEventListener("click", () => this.pick({ kind: "points", name: point, link: name }));
  }
  private joint(d: Drawing, name: string): void {
    const j = d.joints.find((one) => one.name === name), drive = d.drives.find((v) => v.joint === name);
    if (!j) return;
    this.head("joints", name, j.type);
    html("p", this.el, { class: "hint" }, `${j.links[0]} and ${j.links[1]}`);
    this.values("joints", name, j.written, j.type);
    if (drive) {
      html("h3", this.el, {}, "drive");
      this.values("drives", drive.name, drive.written);
      if (j.type !== "slider") this.button("Whole turn", { op: "drive", joint: name, whole_turn: true });
      this.button("No drive", { op: "delete", kind: "drives", name: drive.name });
    } else
      for (const freedom of j.freedoms) {
        const one = j.freedoms.length === 1;
        this.button(one ? "Drive it" : `Drive its ${freedom}`, { op: "drive", joint: name, here: j.here?.[freedom] ?? 0, freedom: one ? "" : freedom });
      }
  }
  private point(d: Drawing, p: Picked): void {
    const written = d.links.find((l) => l.name === p.link)?.written?.points?.[p.name];
    this.head("points", p.name, `point of ${p.link}`, p.link);
    if (written !== undefined) this.field("place", text(written), (value) => ({ op: "set", path: ["links", p.link, "points", p.name], value }), "in the link's axes, such as [120, 0]");
  }
  private part(kind: Picked["kind"], name: string, written: any, what: string): void {
    if (!written) return;
    this.head(kind, name, what);
    this.values(kind, name, written, what);
  }

  private head(kind: Picked["kind"], name: string, what: string, link?: string): void {
    html("h2", this.el, {}, what);
    this.field("name", name, (to) => ({ op: "rename", kind, name, to, ...(link ? { link } : {}) }), "", (to) => this.pick({ kind, name: to, link }));
    html("button", this.el, { type: "button", class: "delete" }, "Delete").addEventListener("click", () => {
      void this.socket.gesture({ op: "delete", kind, name, ...(link ? { link } : {}) });
      this.pick(null);
    });
  }
  private values(kind: string, name: string, written: any, type = ""): void {
    const has = written ?? {}, keys = [...new Set([...Object.keys(has), ...(MORE[kind] ?? []).filter((k) => !/inertia|center/.test(k) || "mass" in has || "weight" in has)])].filter((k) => !DRAWN.includes(k));
    const line = (key: string, value: unknown, about = ABOUT[key]): HTMLInputElement =>
      this.field(key, value === undefined ? "" : text(value), (typed) => ({ op: "set", path: [kind, name, key], value: typed }), about);
    for (const key of keys) line(key, has[key]);
    const more = html("select", this.el, { "aria-label": `another value of ${name}` });
    html("option", more, { value: "" }, "another value …");
    this.keys ??= this.socket.send({ keys: true }).then((a) => a.keys);
    void this.keys.then((all) => {
      const about = all[kind]?.[type] ?? all[kind]?.[""] ?? {};
      for (const key of Object.keys(about)) if (!keys.includes(key)) html("option", more, { value: key, title: about[key] }, key.replaceAll("_", " "));
      more.addEventListener("change", () => {
        const input = line(more.value, undefined, about[more.value]);
        more.before(input.parentElement!);
        more.selectedOptions[0].remove();
        more.value = "";
        input.focus();
      });
    });
  }
  private field(label: string, value: string, asked: (typed: string) => Record<string, unknown>, about = "", then?: (typed: string) => void): HTMLInputElement {
    const line = html("label", this.el, { title: about }), input = html("input", line, { value, placeholder: about, "aria-label": label, spellcheck: "false" });
    line.prepend(html("span", line, {}, label.replaceAll("_", " ")));
    const said = html("em", line, { class: "refused" });
    let tried = value;
    const give = async (): Promise<void> => {
      if (input.value === tried || this.building) return;
      const typed = (tried = input.value), a = await this.socket.gesture(asked(typed));
      said.textContent = a.refused ?? "";
      if (a.refused) return;
      value = typed;
      then?.(typed);
    };
    for (const done of ["change", "blur"]) input.addEventListener(done, () => void give());
    input.addEventListener("keydown", (e) => {
      if (e.key === "Escape") [input.value = tried = value, input.blur()];
      if (e.key === "Enter") input.blur();
    });
    return input;
  }
  private button(said: string, asked: Record<string, unknown>): void {
    html("button", this.el, { type: "button" }, said).addEventListener("click", () => void this.socket.gesture(asked));
  }
}

/** A value as the file writes it. */
function text(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(text).join(", ")}]`;
  if (value && typeof value === "object") return `{${Object.entries(value).map(([k, v]) => `${k}: ${text(v)}`).join(", ")}}`;
  return String(value ?? "");
}
