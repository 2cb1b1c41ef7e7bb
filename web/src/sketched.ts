import type { SketchPageData } from "./data";
import type { AnyData, Inner, Options, Placing } from "./page";
import type { View } from "./view";
export async function sketched(_root: HTMLElement, _data: SketchPageData, _view: View, _options: Options & { taken(next: AnyData, pose: Placing): Promise<void> }): Promise<Inner> {
  throw new Error("not yet");
}
