/** What is worked out when it is asked for: other assemblies by picture, equilibrium positions, the share of each load. */

import { html } from "../src/svg";
import type { Socket } from "./socket";
import { figures } from "./state";

interface Mode { svg: Record<"light" | "dark", string>; links: object; here: boolean }
interface Rest { position: number; shown: string; stability: string; links: object }
interface Share { name: string; unit: string; values: number[]; sum: number }

export class Answers {
  private readonly out: HTMLElement;
  /** Of which text and options the answer is that is shown; number of the last question; what asks it again, and
   * the same after a choice in its answer. */
  private of = "";
  private last = 0;
  private asks: (() => void) | null = null;
  private again: (() => void) | null = null;

  constructor(el: HTMLElement, private readonly socket: Socket, private readonly flushed: () => Promise<void>, private readonly now: () => string) {
    const line = html("div", el, { class: "asks" });
    this.out = html("div", el, { class: "answer", "aria-live": "polite" });
    const ask = (said: string, what: string, show: (a: any) => void): void => {
      html("button", line, { type: "button" }, said).addEventListener("click", () => void this.ask(what, show));
    };
    ask("Other assemblies", "modes", (a) => this.modes(a.modes));
    ask("Equilibrium positions", "equilibria", (a) => this.rests(a.rows, a.drive, a.sentence));
    ask("Share of each load", "superposition", (a) => this.shares(a.rows, a.sources));
    html("p", this.out, { class: "hint" }, "Other assemblies of the same links, equilibrium positions without a drive effort, and the share of each load in each force.");
  }
  private async ask(what: string, show: (a: any) => void): Promise<void> {
    const number = ++this.last;
    [this.of, this.again] = ["", null];
    this.out.replaceChildren(html("p", this.out, { class: "hint" }, "Computing …"));
    await this.flushed();
    const a = await this.socket.send({ ask: what });
    if (number !== this.last) return;
    this.of = a.of ?? this.now();
    this.out.replaceChildren();
    if (a.error || a.refused) html("p", this.out, { class: "off" }, a.error ?? a.refused);
    else show(a);
    this.asks = () => void this.ask(what, show);
    this.update();
  }
  /** An answer of another text or other options is taken away; after a choice in it, it is asked anew. */
  update(): void {
    if (!this.of || this.of === this.now()) return;
    if (this.again) return this.again();
    this.of = "";
    this.out.replaceChildren(html("p", this.out, { class: "hint" }, "The mechanism has changed: ask again."));
  }
  private taken(parent: HTMLElement, title: string, links: object, drives: object = {}): HTMLElement {
    const b = html("button", parent, { type: "button", title });
    b.addEventListener("click", () => {
      this.again = this.asks;
      void this.socket.gesture({ op: "pose", links, drives });
    });
    return b;
  }
  private modes(modes: Mode[]): void {
    html("p", this.out, { class: "hint" }, modes.length > 1 ? "The links can be assembled in these ways at the first position; click one to use it." : "There is only this assembly at the first position.");
    const all = html("div", this.out, { class: "modes" }), theme = matchMedia("(prefers-color-scheme:dark)").matches ? "dark" : "light";
    modes.forEach((m, k) => {
      const b = this.taken(all, m.here ? "as drawn" : "use this assembly", m.links);
      html("img", b, { src: `data:image/svg+xml,${encodeURIComponent(m.svg[theme])}`, alt: `assembly ${k + 1}` });
      html("span", b, {}, m.here ? "as drawn" : String(k + 1));
      (b as HTMLButtonElement).disabled = m.here;
    });
  }
  private rests(rows: Rest[], drive: string, sentence: string): void {
    if (!rows.length) html("p", this.out, {}, sentence || "There is no equilibrium position.");
    else html("p", this.out, { class: "hint" }, `Without an effort at ${drive} it is in equilibrium at:`);
    for (const r of rows) this.taken(html("p", this.out), "show it in the drawing", r.links, { [drive]: r.position }).textContent = `${drive} = ${r.shown}, ${r.stability}`;
  }
  private shares(rows: Share[], sources: string[]): void {
    const table = html("table", html("div", this.out, { class: "wide" })), head = html("tr", table);
    for (const name of ["", ...sources, "sum", ""]) html("th", head, {}, name);
    for (const r of rows) {
      const line = html("tr", table);
      html("th", line, {}, r.name);
      for (const x of [...r.values, r.sum]) html("td", line, {}, figures(Math.abs(x) < 1e-9 * Math.max(...r.values.map(Math.abs)) ? 0 : x, 5));
      html("td", line, {}, r.unit);
    }
  }
}
