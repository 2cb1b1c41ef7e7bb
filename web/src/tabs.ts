/** Tabs beside the drawing: one panel is seen, in print all. */

import { html } from "./svg";
import type { View } from "./view";

export interface Tabs { add(name: string, title?: string): HTMLElement; show(name: string): void }

let made = 0;

/** ``changed``: another panel is seen. */
export function tabs(parent: Element, view: View, changed: () => void): Tabs {
  const list = html("div", parent, { class: "tabs", role: "tablist", "aria-label": "results" }), body = html("div", parent, { class: "panels" });
  const all: { name: string; tab: HTMLButtonElement; panel: HTMLElement }[] = [];
  const show = (name: string, focus = false): void => {
    const on = all.find((x) => x.name === name) ?? all[0];
    if (!on) return;
    for (const { tab, panel } of all) {
      const seen = panel === on.panel;
      tab.setAttribute("aria-selected", String(seen));
      tab.tabIndex = seen ? 0 : -1;
      panel.hidden = !seen;
    }
    if (focus) on.tab.focus();
    body.scrollTop = 0;
  };
  const pick = (name: string, focus = false): void => {
    view.tab = name === all[0].name ? "" : name;
    show(name, focus);
    changed();
  };
  list.addEventListener("keydown", (e) => {
    const k = all.findIndex((x) => x.tab === document.activeElement || x.tab === e.target), n = all.length;
    const to = { ArrowRight: (k + 1) % n, ArrowLeft: (k + n - 1) % n, Home: 0, End: n - 1 }[e.key];
    if (k < 0 || to === undefined) return;
    e.preventDefault();
    e.stopPropagation();
    pick(all[to].name, true);
  });
  return {
    add(name, title = name) {
      const id = `dalembert-tab-${++made}`, tab = html("button", list, { type: "button", role: "tab", id, title, "aria-controls": `${id}-panel` }, name);
      const panel = html("section", body, { role: "tabpanel", id: `${id}-panel`, "aria-labelledby": id, "data-tab": name, tabindex: 0 });
      all.push({ name, tab, panel });
      tab.addEventListener("click", () => pick(name));
      show(view.tab);
      return panel;
    },
    show: (name) => pick(name),
  };
}
