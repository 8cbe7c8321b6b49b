// Which instant is shown: now, or one of the last minutes.

import type { Store } from "./store";

export class Playhead {
  /** s since 1970; null: now */
  private stopped: number | null = null;
  /** s that plots reach back */
  window = 30;
  private told: (() => void)[] = [];

  constructor(private store: Store) {}

  get following(): boolean {
    return this.stopped === null;
  }

  get time(): number {
    return this.stopped ?? this.store.edge();
  }

  onChange(told: () => void): void {
    this.told.push(told);
  }

  pause(): void {
    this.seek(this.store.lastSeen());
  }

  follow(): void {
    this.stopped = null;
    this.changed();
  }

  toggle(): void {
    if (this.following) this.pause();
    else this.follow();
  }

  seek(time: number): void {
    this.stopped = Math.min(this.store.edge(), time);
    this.changed();
  }

  setWindow(seconds: number): void {
    this.window = seconds;
    this.changed();
  }

  /** From when to when plots show. */
  range(): [number, number] {
    return [this.time - this.window, this.time];
  }

  protected changed(): void {
    this.store.version++;
    for (const each of this.told) each();
  }
}
