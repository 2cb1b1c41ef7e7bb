/** What a page and a notebook import. */

import { mount } from "./page";

export { mount };

interface Model { get(name: string): any; set(name: string, value: unknown): void; save_changes(): void; on(event: string, f: () => void): void; off(event: string, f: () => void): void }

/** What anywidget calls in a notebook. */
export default {
  async render({ model, el }: { model: Model; el: HTMLElement }): Promise<() => void> {
    const edited = (changes: Record<string, number>) => {
      model.set("changes", { ...model.get("changes"), ...changes });
      model.save_changes();
    };
    let page = await mount(el, model.get("data"), { edited });
    const again = async () => {
      page.remove();
      page = await mount(el, model.get("data"), { edited });
    };
    model.on("change:data", again);
    return () => (model.off("change:data", again), page.remove());
  },
};
