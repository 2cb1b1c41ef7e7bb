/** Entry points that a page and a notebook import. */

import { mount, type Page } from "./page";
import type { PageEvent } from "./stage";
import { firstView } from "./view";
import { inflate } from "./program";
import { html } from "./svg";

/** The page of compressed data in an element; errors are shown in it. */
export async function open(el: HTMLElement, packed: string): Promise<Page> {
  try {
    const data = JSON.parse(new TextDecoder().decode(await inflate(packed)));
    return await mount(el, data, { address: location.protocol !== "about:", full: true });
  } catch (error) {
    el.textContent = String(error);
    throw error;
  }
}

export { mount };

interface Model { get(name: string): any; set(name: string, value: unknown): void; save_changes(): void; on(event: string, f: () => void): void; off(event: string, f: () => void): void }

/** Entry point that anywidget calls in a notebook. */
export default {
  async render({ model, el }: { model: Model; el: HTMLElement }): Promise<() => void> {
    let told = "";
    const view = firstView(); // as it is looked at, whatever is shown
    const edited = (changes: Record<string, number>) => {
      told = JSON.stringify(changes);
      model.set("changes", changes);
      model.save_changes();
    };
    // a sketch, and what it becomes by its offers, is told as the text of its file
    const on = (e: PageEvent): void => {
      if (e.type === "put" || e.type === "pose" || (e.type === "change" && model.get("text"))) {
        model.set("text", page.text());
        model.save_changes();
      }
    };
    const start = async () => {
      const made = await mount(el, model.get("data"), { edited, on, changes: model.get("changes"), view });
      // the page that a notebook keeps for when it is opened without Python stands below; while this one lives it hides
      html("style", el, {}, `[data-dalembert="${model.get("frame")}"]{display:none}`);
      return made;
    };
    let page = await start();
    const again = async () => {
      view.window = null;
      page.remove();
      page = await start();
    };
    const set = () => JSON.stringify(model.get("changes")) !== told && page.set(model.get("changes"));
    model.on("change:data", again);
    model.on("change:changes", set);
    return () => {
      model.off("change:data", again);
      model.off("change:changes", set);
      page.remove();
    };
  },
};
