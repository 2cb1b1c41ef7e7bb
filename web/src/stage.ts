/** The drawing with what a hand does to it: zoom, pan, pick, menu. The same for a solved mechanism and for a sketch. */

import { type Board, board } from "./board";
import type { Data, Drawing, Pair, Rate } from "./data";
import { FINGER, hits, identity, mark, NEAR, same } from "./hits";
import { type Entry, openMenu } from "./menu";
import type { Source } from "./source";
import { html, make, type Point, pointer } from "./svg";
import type { Identity, View } from "./view";
import { type Viewport, viewport } from "./viewport";

/** What a page tells whoever mounted it; true as an answer: it is dealt with. ``point``: metres in the plane of the
 * picture; ``at``: pixels of the window. */
export type PageEvent =
  | { type: "select" | "menu"; items: Identity[]; at: Point; point: Point }
  | { type: "change"; changes: Record<string, number> }
  | { type: "pose"; pose: Record<string, number[]>; closed: boolean }
  | { type: "offer"; offer: { kind: string; said: string; text: string } }
  | { type: "view"; view: View }
  /** Other data took the place of the page: an offer was taken, or taken back. */
  | { type: "put" };
export type Listener = (e: PageEvent) => boolean | void;

export interface Stage {
  m: Board; paper: HTMLElement; view: Viewport; overlay: SVGGElement;
  hit(x: number, y: number): Identity[]; metres(x: number, y: number): Point; choose(chosen: Identity | null): void;
  /** Fits the drawing into its area; false where it has none yet. */
  resize(): void;
}
export interface Setting {
  full?: boolean; rates?: Rate[]; on?: Listener;
  /** True where a drag on a part is a drag of the part. */
  held(item: Identity): boolean;
  entries(items: Identity[], point: Point): Entry[];
  chosen(item: Identity | null): void;
  again(all: boolean): void;
}

/** Least and greatest number of pixels per mm of the drawing: letters are readable in every window. */
const LEAST = 3.6, MOST = 5.2;
/** Milliseconds of a long press, and pixels that a finger may tremble. */
const PRESS = 550, TREMBLE = 8;

export function stage(parent: Element, source: Source, d: Drawing & { middle?: Pair }, units: Data["units"], view: View, s: Setting): Stage {
  const paper = html("div", parent, { class: "paper" }), m = board(paper, source, d, null, 170, 119, units, "the mechanism", view, s.rates ?? []);
  const { svg } = m, overlay = make("g", svg, { class: "overlay" }), space = m.paper.axes.length > 2;
  const itemOf = (e: Event): Identity | null => {
    const item = (e.target as Element).closest<SVGElement>("[data-item]")?.dataset.item;
    return item ? identity(item) : null;
  };
  const free = (e: PointerEvent): boolean => !hit(e.clientX, e.clientY, e.pointerType === "touch" ? FINGER : NEAR).some(s.held);
  const seen = (): void => {
    s.on?.({ type: "view", view });
    s.again(true);
  };
  const turn = space ? (by: Point): void => (m.paper.turn(-0.045 * by[0], 0.045 * by[1]), seen()) : null;
  const hit = (x: number, y: number, reach = NEAR): Identity[] => hits(svg, x, y, reach);
  const v = viewport(m, view, !!s.full, free, turn, seen);
  if (space) svg.style.cursor = "move";
  const metres = (x: number, y: number): Point => m.paper.metres(pointer(svg, { clientX: x, clientY: y }));
  const choose = (chosen: Identity | null): void => {
    view.chosen = chosen;
    mark(svg, chosen);
    s.chosen(chosen);
  };
  const at = (e: { clientX: number; clientY: number }): Point => [e.clientX, e.clientY];
  svg.addEventListener("click", (e) => {
    const found = hit(e.clientX, e.clientY, (e as PointerEvent).pointerType === "touch" ? FINGER : NEAR);
    const items = found.length ? found : itemOf(e) ? [itemOf(e)!] : [];
    if (s.on?.({ type: "select", items, at: at(e), point: metres(e.clientX, e.clientY) })) return;
    choose(items[0] && !same(items[0], view.chosen) ? items[0] : null);
  });
  const menu = (items: Identity[], p: Point): void => {
    const point = metres(...p);
    if (items[0]) choose(items[0]);
    if (s.on?.({ type: "menu", items, at: p, point })) return;
    openMenu(parent.closest(".dalembert") ?? document.body, p, s.entries(items, point));
  };
  svg.addEventListener("contextmenu", (e) => {
    e.preventDefault();
    const focused = e.button < 0 || (e.clientX === 0 && e.clientY === 0) ? itemOf(e) : null;
    if (!focused) return menu(hit(e.clientX, e.clientY), at(e));
    const box = (e.target as Element).getBoundingClientRect();
    menu([focused], [box.left + box.width / 2, box.top + box.height / 2]);
  });
  svg.addEventListener("keydown", (e) => {
    if (e.key !== "ContextMenu" && !(e.key === "F10" && e.shiftKey)) return;
    e.preventDefault();
    const box = (e.target as Element).getBoundingClientRect(), item = itemOf(e);
    menu(item ? [item] : [], [box.left + box.width / 2, box.top + box.height / 2]);
  });
  let waiting = 0, from: Point = [0, 0];
  svg.addEventListener("pointerdown", (e) => {
    clearTimeout(waiting);
    if (e.pointerType !== "touch" || !e.isPrimary) return;
    from = at(e);
    waiting = window.setTimeout(() => menu(hit(e.clientX, e.clientY, FINGER), from), PRESS);
  }, { capture: true });
  const stop = (): void => clearTimeout(waiting);
  svg.addEventListener("pointermove", (e) => Math.hypot(e.clientX - from[0], e.clientY - from[1]) > TREMBLE && stop(), { capture: true });
  for (const end of ["pointerup", "pointercancel"] as const) svg.addEventListener(end, stop, { capture: true });
  return {
    m, paper, view: v, overlay, hit, metres, choose,
    resize() {
      const { width, height } = paper.getBoundingClientRect();
      if (!(width > 0 && height > 0)) return;
      const pixels = Math.min(Math.max(Math.min(width / 170, height / 105), LEAST), MOST);
      m.resize(width / pixels, height / pixels);
    },
  };
}
