/** Zoom and pan: wheel, pinch, drag, keys. In space a drag turns the view, with Shift or two fingers it moves it. */

import type { Board } from "./board";
import { type Point, pointer } from "./svg";
import type { View } from "./view";

export interface Viewport { zoom(factor: number, about?: Point): void; fit(): void; pan(by: Point): void }

const LARGEST = 1e4;
/** Shares of the drawing by which a key pans, and the factor by which it zooms. */
const STEP = 12, ZOOM = 1.25;

/** ``free``: true where a drag begins on nothing that is dragged itself; ``greedy``: the wheel zooms without a key. */
export function viewport(b: Board, view: View, greedy: boolean, free: (e: PointerEvent) => boolean, turn: ((by: Point) => void) | null, again: () => void): Viewport {
  const { svg, paper } = b, fingers = new Map<number, Point>();
  let moved = false;
  const put = (perMm: number, middle: Point): void => {
    const usual = b.fitted();
    if (!(perMm > usual / LARGEST && perMm < usual * LARGEST) || !middle.every(Number.isFinite)) return;
    view.window = { perMm, middle };
    b.look();
    again();
  };
  const pan = ([dx, dy]: Point): void => put(paper.perMm, [paper.middle[0] - dx * paper.perMm, paper.middle[1] + dy * paper.perMm]);
  const zoom = (factor: number, about: Point = [0, 0]): void => {
    const [x, y] = paper.metres(about), perMm = paper.perMm / factor;
    put(perMm, [x - about[0] * perMm, y + about[1] * perMm]);
  };
  const fit = (): void => {
    view.window = null;
    b.look();
    again();
  };
  svg.addEventListener("wheel", (e) => {
    if (!greedy && !e.ctrlKey && !e.metaKey) return;
    e.preventDefault();
    const lines = e.deltaMode === 1 ? 16 : 1;
    zoom(Math.exp(-e.deltaY * lines * (e.ctrlKey ? 0.01 : 0.0015)), pointer(svg, e));
  }, { passive: false });
  svg.addEventListener("pointerdown", (e) => {
    if (e.pointerType === "mouse" && e.button > 1) return;
    if (!fingers.size && e.button !== 1 && !free(e)) return;
    if (e.button === 1) e.preventDefault();
    svg.setPointerCapture(e.pointerId);
    fingers.set(e.pointerId, pointer(svg, e));
    moved = false;
  });
  svg.addEventListener("pointermove", (e) => {
    const from = fingers.get(e.pointerId);
    if (!from) return;
    const to = pointer(svg, e), by: Point = [to[0] - from[0], to[1] - from[1]];
    moved = true;
    const other = [...fingers].find(([id]) => id !== e.pointerId)?.[1];
    fingers.set(e.pointerId, to);
    if (other) {
      const size = (p: Point): number => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      zoom(size(to) / size(from), other);
    } else if (turn && !e.shiftKey && e.buttons !== 4) turn(by);
    else pan(by);
  });
  const up = (e: PointerEvent): void => void fingers.delete(e.pointerId);
  svg.addEventListener("pointerup", up);
  svg.addEventListener("pointercancel", up);
  svg.addEventListener("lostpointercapture", up);
  svg.addEventListener("dblclick", (e) => {
    if (free(e as unknown as PointerEvent)) fit();
  });
  // a click that ends a drag chooses nothing
  svg.addEventListener("click", (e) => moved && e.stopImmediatePropagation(), { capture: true });
  svg.tabIndex = 0;
  svg.addEventListener("keydown", (e) => {
    if (e.target !== svg || e.ctrlKey || e.metaKey || e.altKey) return;
    const way: Record<string, Point> = { ArrowLeft: [STEP, 0], ArrowRight: [-STEP, 0], ArrowUp: [0, STEP], ArrowDown: [0, -STEP] };
    if (way[e.key]) pan(way[e.key]);
    else if (e.key === "+" || e.key === "=") zoom(ZOOM);
    else if (e.key === "-") zoom(1 / ZOOM);
    else if (e.key === "0") fit();
    else return;
    e.preventDefault();
    e.stopPropagation();
  });
  return { zoom, fit, pan };
}
