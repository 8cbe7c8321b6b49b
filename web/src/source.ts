// Where what the page shows comes from. The page knows only this: a server today, a file for `poise view`.

import type { Command, Done, Message } from "./protocol";

export type Connection =
  | { state: "connecting" }
  | { state: "open" }
  | { state: "lost"; since: number; retryAt: number }
  | { state: "refused"; reason: string };

/** What a source tells. */
export interface Sink {
  message(message: Message): void;
  /** A binary frame of attitudes, header included; whether all that they are of was known already. */
  frame(data: ArrayBuffer): boolean;
  connection(now: Connection): void;
  /** What is held of a device is no more: other rows of it follow. */
  cleared(device: string): void;
}

export interface Source {
  /** Whether time goes on by itself: there is a "now" that the page follows. A file has an end instead. */
  readonly live: boolean;
  start(sink: Sink): void;
  /** Asks for a change; the answer, or rejects with the reason why not. */
  ask(command: Command): Promise<Done>;
  /** GET of the same server, with its token where there is one. */
  get(path: string): Promise<Response>;
  /** Shows a token to a server that wants one. */
  identify(token: string): void;
}
