/** The menu of a place of the drawing. */

import { html, type Point } from "./svg";

export interface Entry { said: string; act(): void }

export function openMenu(root: Element, [x, y]: Point, entries: Entry[]): void {
  root.querySelector(".menu")?.remove();
  if (!entries.length) return;
  const before = document.activeElement as HTMLElement | null, box = html("div", root, { class: "menu", role: "menu", "aria-label": "of this place" });
  const close = (): void => {
    if (!box.isConnected) return;
    box.remove();
    document.removeEventListener("pointerdown", outside, true);
    before?.focus?.();
  };
  const outside = (e: Event): void => {
    if (!e.composedPath().includes(box)) close();
  };
  const all = entries.map(({ said, act }) => {
    const b = html("button", box, { type: "button", role: "menuitem" }, said);
    b.addEventListener("click", () => (close(), act()));
    return b;
  });
  box.addEventListener("keydown", (e) => {
    const k = all.indexOf(document.activeElement as HTMLButtonElement), n = all.length;
    const to = { ArrowDown: (k + 1) % n, ArrowUp: (k + n - 1) % n, Home: 0, End: n - 1 }[e.key];
    if (to !== undefined) all[to].focus();
    else if (e.key === "Escape" || e.key === "Tab") close();
    else return;
    e.preventDefault();
    e.stopPropagation();
  });
  const { width, height } = box.getBoundingClientRect();
  box.style.left = `${Math.max(4, Math.min(x, window.innerWidth - width - 4))}px`;
  box.style.top = `${Math.max(4, Math.min(y, window.innerHeight - height - 4))}px`;
  document.addEventListener("pointerdown", outside, true);
  all[0].focus({ preventScroll: true });
}
