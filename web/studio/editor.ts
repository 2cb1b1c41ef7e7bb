/** The file beside the drawing: typed edits go to the server as splices, its text comes back as splices. */

import { Annotation, EditorState } from "@codemirror/state";
import { EditorView, keymap, lineNumbers, highlightActiveLine, drawSelection } from "@codemirror/view";
import { defaultKeymap, indentWithTab } from "@codemirror/commands";
import { yaml } from "@codemirror/lang-yaml";
import { bracketMatching, HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import type { Socket } from "./socket";

const FromServer = Annotation.define<boolean>();
/** Pause after which what was typed is sent, ms. */
const PAUSE = 250;
/** Edits that are tried while others change the text. */
const TRIES = 5;
const colours = HighlightStyle.define([
  { tag: [tags.propertyName, tags.definition(tags.propertyName)], color: "var(--key)" },
  { tag: tags.comment, color: "var(--grey)", fontStyle: "italic" },
  { tag: [tags.string, tags.number], color: "var(--value)" },
]);

export class Editor {
  readonly view: EditorView;
  private base = "";
  private sent = "";
  private timer = 0;
  /** The text of an edit that was sent and has not come back, and its answer. */
  private flying: string | null = null;
  private flight: Promise<void> | null = null;
  private crlf = false;

  constructor(el: HTMLElement, private readonly socket: Socket, undo: (back: boolean) => void) {
    const history = [
      { key: "Mod-z", run: () => (undo(true), true) },
      { key: "Mod-y", run: () => (undo(false), true) },
      { key: "Mod-Shift-z", run: () => (undo(false), true) },
    ];
    this.view = new EditorView({
      parent: el,
      state: EditorState.create({
        extensions: [
          lineNumbers(), lintGutter(), drawSelection(), highlightActiveLine(), bracketMatching(), yaml(), syntaxHighlighting(colours),
          keymap.of([...history, ...defaultKeymap, indentWithTab]),
          EditorView.contentAttributes.of({ "aria-label": "model file" }),
          EditorView.updateListener.of((u) => {
            if (!u.docChanged || u.transactions.some((t) => t.annotation(FromServer))) return;
            this.later();
          }),
        ],
      }),
    });
  }
  /** Sends what was typed since the last message; done once the server has all of it. */
  async flush(): Promise<void> {
    clearTimeout(this.timer);
    for (let tries = 0; tries < TRIES; tries++) {
      await this.flight;
      if (this.idle || !this.base) return;
      await (this.flight ??= this.fly().finally(() => (this.flight = null)));
    }
  }
  private async fly(): Promise<void> {
    const text = (this.flying = this.text);
    const [start, end, insert] = difference(this.sent, text), place = (k: number): number => units(this.sent, k) + (this.crlf ? this.sent.slice(0, k).split("\n").length - 1 : 0);
    const a = await this.socket.send({ edit: [[place(start), place(end), this.crlf ? insert.replaceAll("\n", "\r\n") : insert]], base: this.base });
    this.flying = null; // the state that has come before has what was sent
    if (a.refused && !/meanwhile/.test(a.refused)) this.put(this.sent);
  }
  /** True if the server has all that was typed. */
  get idle(): boolean {
    return !this.flight && this.text === this.sent;
  }
  private later(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.flush(), PAUSE);
  }
  private put(text: string): void {
    if (text === this.text) return;
    const [from, to, insert] = difference(this.text, text);
    this.view.dispatch({ changes: { from, to, insert }, annotations: FromServer.of(true) });
  }
  private get text(): string {
    return this.view.state.doc.toString();
  }
  /** The server's text and its error; what is typed meanwhile stays. */
  update(text: string, hash: string, error: string, line: number): void {
    const plain = text.replaceAll("\r\n", "\n"), arrived = plain === this.flying;
    const before = arrived ? this.flying! : this.sent, typed = this.text !== before;
    if (arrived) this.flying = null;
    this.base = hash;
    this.crlf = plain !== text;
    this.sent = plain;
    this.put(!typed ? plain : plain === before ? this.text : merged(before, this.text, plain));
    if (this.text !== plain) this.later();
    const doc = this.view.state.doc;
    const at = doc.line(Math.min(Math.max(line, 1), doc.lines));
    this.view.dispatch(setDiagnostics(this.view.state, error ? [{ from: at.from, to: at.to, severity: "error", message: error }] : []));
  }
  /** Shows a line. */
  show(text: string): void {
    const at = this.text.indexOf(text);
    if (at >= 0) this.view.dispatch({ selection: { anchor: at }, scrollIntoView: true });
  }
}

/** Start and end of what differs in a text, and what takes its place. */
function difference(a: string, b: string): [number, number, string] {
  let start = 0, tail = 0;
  while (start < a.length && start < b.length && a[start] === b[start]) start++;
  while (tail < a.length - start && tail < b.length - start && a[a.length - 1 - tail] === b[b.length - 1 - tail]) tail++;
  return [start, a.length - tail, b.slice(start, b.length - tail)];
}

/** Both changes of a text, one's own and the server's; the server's alone where they overlap. */
function merged(before: string, own: string, server: string): string {
  const [s, e, insert] = difference(before, own), [from, to, other] = difference(before, server);
  if (e <= from) return server.slice(0, s) + insert + server.slice(e);
  if (s < to) return server;
  const shift = other.length - (to - from);
  return server.slice(0, s + shift) + insert + server.slice(e + shift);
}

/** A place in characters, as Python counts them. */
const units = (text: string, place: number): number => [...text.slice(0, place)].length;
