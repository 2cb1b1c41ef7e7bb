/** Below the drawing: what dragging does, zoom, and what is shown by class. */

import { html } from "./svg";
import { type Layer, usually, type View } from "./view";
import type { Viewport } from "./viewport";

export interface Switch { said: string; title: string; on: boolean; act(on: boolean): void }
export const TITLES: Record<Layer, [string, string]> = {
  loads: ["loads", "loads, efforts of drives, weights, springs"], reactions: ["reactions", "forces in the joints"],
  inertia: ["inertia", "D'Alembert's inertia forces and couples"], velocities: ["velocities", "velocities of joints and mass centres"],
  accelerations: ["accelerations", "accelerations of joints and mass centres"], names: ["names", "names of joints and links"],
  traces: ["paths", "paths of the joints"], values: ["values", "the value beside each arrow"], digits: ["large digits", "the chosen curve's value, to be read from the last row"],
};

export function toggle(box: Element, s: Switch): void {
  const line = html("label", box, { title: s.title }), check = html("input", line, { type: "checkbox" });
  check.checked = s.on;
  line.append(s.said);
  check.addEventListener("change", () => s.act(check.checked));
}

/** A switch for each layer that the mechanism has. */
export function layers(box: Element, view: View, has: Layer[], many: boolean, again: () => void): void {
  for (const layer of has) {
    const [said, title] = TITLES[layer];
    toggle(box, { said, title, on: view.shown[layer] ?? usually(layer, many), act: (on) => ((view.shown[layer] = on), again()) });
  }
}

/** Buttons of the view, and the two ways of dragging where there are two. */
export function viewButtons(box: Element, v: Viewport, view: View, modes: boolean, again: () => void): void {
  const group = html("span", box, { class: "group", role: "group", "aria-label": "view" });
  const button = (said: string, title: string, act: () => void): HTMLButtonElement => {
    const b = html("button", group, { type: "button", title, ...(/^\w/.test(said) ? {} : { "aria-label": title }) }, said);
    b.addEventListener("click", act);
    return b;
  };
  button("−", "zoom out (-)", () => v.zoom(0.8));
  button("+", "zoom in (+)", () => v.zoom(1.25));
  button("fit", "the whole mechanism (0)", () => v.fit());
  if (!modes) return;
  const ways = html("span", box, { class: "group", role: "group", "aria-label": "dragging" });
  const both = (["shape", "turn"] as const).map((way) => {
    const title = way === "shape" ? "dragging a joint changes the mechanism" : "dragging a joint or a link turns the mechanism";
    const b = html("button", ways, { type: "button", title }, way === "shape" ? "reshape" : "turn");
    b.addEventListener("click", () => {
      view.drag = way;
      press();
      again();
    });
    return { way, b };
  });
  const press = (): void => both.forEach(({ way, b }) => b.setAttribute("aria-pressed", String(view.drag === way)));
  press();
}
