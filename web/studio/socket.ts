/** The socket to the studio's server: messages with a number, answers by it. */

import type { State } from "./state";

type Answer = Record<string, any>;
export interface Told { state(s: State): void; forces(a: Answer): void; refused(sentence: string): void; ended(sentence: string): void }

export class Socket {
  private readonly ws: WebSocket;
  private n = 0;
  private waiting = new Map<number, (a: Answer) => void>();
  private last = "";

  constructor(told: Told) {
    this.ws = new WebSocket(`ws://${location.host}/tab`);
    this.ws.onopen = () => this.ws.send(JSON.stringify({ token: location.hash.slice(1) }));
    this.ws.onmessage = (e) => {
      const a: Answer = JSON.parse(e.data);
      if (a.n !== undefined && this.waiting.has(a.n)) {
        this.waiting.get(a.n)!(a);
        this.waiting.delete(a.n);
      }
      if (a.refused) told.refused((this.last = a.refused));
      else if (a.text !== undefined) told.state(a as State);
      else if (a.data || a.missing !== undefined) told.forces(a);
    };
    this.ws.onclose = (e) =>
      told.ended(e.code === 4403 ? this.last : "The studio's server has stopped. Start it again with `dalembert studio` and the file's name: what was typed here is kept in a file beside it.");
  }
  /** True if nothing waits for an answer. */
  get idle(): boolean {
    return !this.waiting.size;
  }
  /** Sends a message; the answer to it, which comes after the state that follows from it. */
  send(message: Record<string, unknown>): Promise<Answer> {
    const n = ++this.n;
    return new Promise((done) => {
      this.waiting.set(n, done);
      if (this.ws.readyState === WebSocket.OPEN) this.ws.send(JSON.stringify({ n, ...message }));
    });
  }
  gesture(asked: Record<string, unknown>): Promise<Answer> {
    return this.send({ do: asked });
  }
}
