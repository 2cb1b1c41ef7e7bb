/** The head of a page: title, play, place of the cycle, undo, and the sentence of a position without an answer. */

import type { Data } from "./data";
import type { Kernel } from "./kernel";
import type { Reasons } from "./sentences";
import { html, say } from "./svg";
import { standing } from "./tools";
import { SPEEDS, type View } from "./view";

export interface Acts { play(): void; show(t: number): void; go(back: boolean): void; reset(): void; back?: () => void }
export interface Toolbar { update(t: number, can: [boolean, boolean], refused: string): void; playing(on: boolean): void }

export function toolbar(parent: Element, data: Data, kernel: Kernel, reasons: Reasons, view: View, acts: Acts): Toolbar {
  const header = html("header", parent);
  html("h1", header, {}, data.title);
  const bar = html("div", header, { class: "bar", role: "toolbar", "aria-label": "cycle and page" });
  const button = (name: string, said: string, act: () => void): HTMLButtonElement => {
    const b = html("button", bar, { type: "button", title: said, ...(/^\w/.test(name) ? {} : { "aria-label": said }) }, name);
    b.addEventListener("click", act);
    return b;
  };
  const play = button("▶", "play along the cycle (space)", acts.play);
  const slider = html("input", bar, { type: "range", min: 0, max: kernel.end, step: data.only_at_positions ? 1 : "any", "aria-label": "position in the cycle" });
  const readout = html("output", bar, { class: "readout" });
  const speed = html("select", bar, { class: "speed", title: "speed of play; , and . step, with Shift by ten", "aria-label": "speed of play" });
  for (const x of SPEEDS) html("option", speed, { value: x }, `${x}×`);
  speed.value = String(view.speed);
  speed.addEventListener("change", () => (view.speed = +speed.value));
  const undo = button("↶", "undo (Ctrl+Z)", () => acts.go(true)), redo = button("↷", "redo (Ctrl+Y)", () => acts.go(false));
  if (acts.back) button("Back", "back to the sketch: undo the last addition", acts.back);
  button("Reset", "all numbers as in the file", acts.reset);
  const mark = html("p", header, { class: "mark", role: "status" });
  slider.addEventListener("input", () => acts.show(+slider.value));
  for (const x of [play, slider, readout, speed]) x.hidden = kernel.count < 2;
  return {
    playing: (on) => (play.textContent = on ? "❚❚" : "▶"),
    update(t, can, refused) {
      const sentence = [refused, reasons.at(t)].filter(Boolean).join(" ");
      say(mark, sentence);
      slider.value = String(t);
      say(readout, standing(data, kernel, t));
      [undo.disabled, redo.disabled] = can.map((x) => !x);
    },
  };
}
