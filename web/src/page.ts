/** `mount(element, data)`: the page of one mechanism, solved or a sketch; the same for a file, a notebook and a studio. */

import type { Data, SketchPageData } from "./data";
import type { Kernel } from "./kernel";
import style from "./page.css?inline";
import type { Pulled } from "./pulling";
import { sketched } from "./sketched";
import { solved } from "./solved";
import type { Listener, Stage } from "./stage";
import { html, type Point } from "./svg";
import { firstView, type Identity, type View } from "./view";

type Changes = Record<string, number>;
/** Where links are, by name: origin and angle, in space origin and rotation matrix row by row; metres, radians. */
export type Placing = Record<string, number[]>;
export type AnyData = Data | SketchPageData;

/** ``changes``: initial ones, by path; ``edited`` receives all changes after each one. ``address``: they and the view
 * are kept in it. ``full``: the page fills its window and uses its keys. ``view``: how it is looked at, kept by whoever
 * mounts. ``pose``: where the links are taken from. ``anew``: at the beginning of the cycle. ``on``: what is picked, asked for, changed, released. */
export interface Options { changes?: Changes; edited?: (changes: Changes) => void; address?: boolean; full?: boolean; view?: View; pose?: Placing; anew?: boolean; on?: Listener }

/** One page inside its element. */
export interface Inner {
  kernel?: Kernel; sketch?: Pulled; data: AnyData; times: number[]; stage: Stage; observed: Element[];
  opened(): void; resize(): void; set(changes: Changes): void; show(t: number): void; text(): string; pose(): Placing; redraw(): void; remove(): void;
}
/** ``replace``: other data, seen as the page is, and posed so too unless ``pose`` is another one, or null: as its file. ``hit``: parts at a place of the window, the nearest first.
 * ``overlay``: a group above the drawing, mm of paper; ``metres``, ``paper`` take a place of the window there and a
 * place of the machine onto the paper. */
export interface Page {
  readonly kernel: Kernel; readonly data: Data; readonly times: number[]; readonly view: View; readonly svg: SVGSVGElement; readonly overlay: SVGGElement;
  /** The solver of a sketch; undefined of a solved mechanism. */
  readonly sketch: Pulled | undefined;
  set(changes: Changes): void; show(t: number): void; text(): string; remove(): void; replace(data: AnyData, pose?: Placing | null, anew?: boolean): Promise<void>;
  hit(x: number, y: number): Identity[]; metres(x: number, y: number): Point; paper(place: number[]): Point; choose(chosen: Identity | null): void; pose(): Placing; redraw(): void;
}

export async function mount(el: HTMLElement, data: AnyData, options: Options = {}): Promise<Page> {
  const view = options.view ?? firstView();
  const sized = new ResizeObserver(() => inner.resize());
  const before: AnyData[] = [];
  let inner = await put(data, options);

  /** Other data take the place of the page only once they are ready. */
  async function put(next: AnyData, how: Options): Promise<Inner> {
    const root = document.createElement("div");
    root.className = options.full ? "dalembert full" : "dalembert";
    root.tabIndex = -1;
    const dark = `@media (prefers-color-scheme:dark){${next.style.dark}}@media print{${next.style.light}}`;
    html("style", root).textContent = style + next.style.light + dark;
    const back = before.length ? () => void undone() : undefined;
    const one = next.format === "dalembert-sketch/1" ? await sketched(root, next as SketchPageData, view, { ...how, taken, back })
      : next.format === "dalembert-page/1" ? await solved(root, next as Data, view, { ...how, back }) : null;
    if (!one) throw new Error(`this page cannot show data of format ${next.format}`);
    const focused = focus();
    sized.disconnect();
    el.replaceChildren(root);
    one.opened();
    for (const box of one.observed) sized.observe(box);
    if (focused) root.querySelector<HTMLElement>(focused)?.focus({ preventScroll: true });
    return one;
  }
  /** An offer of a sketch is taken, and taken back. */
  async function taken(next: AnyData, pose: Placing): Promise<void> {
    before.push(inner.data);
    await swap(next, pose);
  }
  async function undone(): Promise<void> {
    const last = before.pop();
    if (last) await swap(last);
  }
  /** How the focused element is found again. */
  function focus(): string {
    const on = el.contains(document.activeElement) ? (document.activeElement as HTMLElement) : null;
    if (!on) return "";
    const known = ["data-path", "data-item", "aria-label"].find((name) => on.hasAttribute(name));
    return known ? `${on.tagName.toLowerCase()}[${known}="${CSS.escape(on.getAttribute(known)!)}"]` : "";
  }
  async function replace(next: AnyData, pose?: Placing | null, anew = false): Promise<void> {
    before.length = 0;
    await swap(next, pose, anew);
  }
  async function swap(next: AnyData, pose: Placing | null = inner.pose(), anew = false): Promise<void> {
    const old = inner;
    inner = await put(next, { ...options, changes: undefined, address: false, pose: pose ?? undefined, anew });
    old.remove();
    options.on?.({ type: "put" });
  }
  return {
    get kernel() { return inner.kernel!; },
    get data() { return inner.data as Data; },
    get times() { return inner.times; },
    get svg() { return inner.stage.m.svg; },
    get overlay() { return inner.stage.overlay; },
    get sketch() { return inner.sketch; },
    view, replace,
    set: (to) => inner.set(to), show: (t) => inner.show(t), text: () => inner.text(), pose: () => inner.pose(), redraw: () => inner.redraw(),
    hit: (x, y) => inner.stage.hit(x, y), metres: (x, y) => inner.stage.metres(x, y), choose: (chosen) => inner.stage.choose(chosen),
    paper: (place) => inner.stage.m.paper.of(...inner.stage.m.paper.project(place)),
    remove() {
      sized.disconnect();
      inner.remove();
      el.replaceChildren();
    },
  };
}
