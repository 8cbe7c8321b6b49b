// Recordings as a source: what `poise view` serves, fetched as it is looked at.

import { AT, HEADER, RECORD } from "./protocol";
import type { Command, FilmInfo, Films } from "./protocol";
import { serverGet } from "./socket";
import type { Sink, Source } from "./source";

/** records of a method that are held: a longer film is held around the instant shown */
const MOST = 8000;
/** s beyond what is shown that are fetched with it, at the speed of 1 */
const AHEAD = 20;

interface Held {
  from: number;
  to: number;
  /** s between records */
  step: number;
  asking: boolean;
}

export class FilmSource implements Source {
  readonly live = false;
  readonly films = new Map<string, FilmInfo>();
  private sink!: Sink;
  private held = new Map<string, Held>();
  private loaded: () => void = () => undefined;
  /** settles once the films are known */
  readonly ready = new Promise<void>((settle) => (this.loaded = settle));

  start(sink: Sink): void {
    this.sink = sink;
    void this.load();
  }

  get(path: string): Promise<Response> {
    return serverGet(path);
  }

  identify(): void {
    void this.load();
  }

  ask(_: Command): Promise<never> {
    return Promise.reject(new Error("a recording cannot be changed"));
  }

  /** s, of the longest */
  get duration(): number {
    return Math.max(0.001, ...[...this.films.values()].map((film) => film.end - film.start));
  }

  private async load(): Promise<void> {
    this.sink.connection({ state: "connecting" });
    try {
      const answer = await this.get("/films");
      if (!answer.ok) throw new Error(await answer.text());
      const { server, flags, invalid_flags, films } = (await answer.json()) as Films;
      if (!films.length) return location.replace(location.pathname + location.hash); // a server of `poise live`
      films.forEach((film, k) => this.films.set(films.findIndex((each) => each.id === film.id) === k ? film.id : `${film.id} ${k + 1}`, film));
      this.sink.connection({ state: "open" });
      this.sink.message({ type: "hello", server, flags, invalid_flags, time: Date.now() / 1000, may_write: false, methods: [], offers: [], recording: null });
      this.sink.message({ type: "devices", devices: [...this.films].map(([id, film]) => ({ ...film, id, connected: true })) });
      this.loaded();
      await Promise.all([...this.films].map(([id, film]) => this.fetch(id, film, 0, film.end - film.start)));
    } catch (problem) {
      this.sink.connection({ state: "refused", reason: `The recordings cannot be had: ${(problem as Error).message}` });
    }
  }

  /** Sees to it that *id* is held between two instants, s from its start, as finely as MOST records allow. */
  look(id: string, [from, to]: [number, number], speed: number): void {
    const film = this.films.get(id);
    const held = this.held.get(id);
    if (!film || !held || held.asking) return;
    const length = film.end - film.start;
    const [first, last] = [Math.max(0, from), Math.min(length, to)];
    const ahead = AHEAD * Math.max(1, speed);
    const [wider, further] = [Math.max(0, first - ahead), Math.min(length, last + ahead)];
    const finest = 1 / (film.rate_hz ?? Infinity);
    const wanted = Math.max(finest, (further - wider) / MOST);
    const soon = Math.min(length, last + ahead / 4);
    if (held.from <= first && soon <= held.to && held.step <= 2 * wanted) return;
    void this.fetch(id, film, wider, further);
  }

  private async fetch(id: string, film: FilmInfo, from: number, to: number): Promise<void> {
    const held = { from, to, step: Math.max(1 / (film.rate_hz ?? Infinity), (to - from) / MOST), asking: true };
    this.held.set(id, { ...(this.held.get(id) ?? held), asking: true });
    try {
      const answer = await this.get(`/films/${film.number}/frame?start=${film.start + from}&end=${film.start + to}&most=${MOST}`);
      if (!answer.ok) throw new Error(await answer.text());
      const data = await answer.arrayBuffer();
      fromStart(data, film.start);
      this.sink.cleared(id);
      this.sink.frame(data);
      this.held.set(id, { ...held, asking: false });
    } catch (problem) {
      this.sink.connection({ state: "lost", since: Date.now(), retryAt: Date.now() });
      setTimeout(() => void this.again(id, film, from, to), 1000);
      console.warn(problem);
    }
  }

  private async again(id: string, film: FilmInfo, from: number, to: number): Promise<void> {
    await this.fetch(id, film, from, to);
    if (!this.held.get(id)?.asking) this.sink.connection({ state: "open" });
  }
}

/** The page counts s from the start of each film: its stamps may begin anywhere. */
function fromStart(data: ArrayBuffer, start: number): void {
  const view = new DataView(data);
  for (let at = HEADER + 8 * AT.host; at < data.byteLength; at += RECORD) view.setFloat64(at, view.getFloat64(at, true) - start, true);
}
