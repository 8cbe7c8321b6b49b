// The last minutes of one device by one method: the records as they came, in one buffer.

import { AT, RECORD } from "./protocol";

const FIRST = 256;
const WORDS = RECORD / 4;
const DOUBLES = RECORD / 8;
const SAME = 48; // bytes that tell records of a device apart: flags, times, number, quaternion

export class Ring {
  private bytes = new Uint8Array(0);
  private floats = new Float32Array(0);
  private words = new Uint32Array(0);
  private doubles = new Float64Array(0);
  private stamps = new Float64Array(0);
  private capacity = 0;
  private first = 0;
  length = 0;

  /** Appends the record at *offset* of *data*, seen at *at* (s since 1970); never more than *most* are kept. */
  push(data: Uint8Array, offset: number, at: number, most: number): void {
    if (this.length && this.same(this.slot(this.length - 1), data, offset)) return;
    if (this.length === this.capacity && this.capacity < most) this.grow(Math.min(most, Math.max(FIRST, 2 * this.capacity)));
    if (this.length === this.capacity) {
      this.first = (this.first + 1) % this.capacity;
      this.length--;
    }
    const slot = (this.first + this.length) % this.capacity;
    this.bytes.set(data.subarray(offset, offset + RECORD), slot * RECORD);
    this.stamps[slot] = this.length ? Math.max(at, this.stamps[this.slot(this.length - 1)]) : at;
    this.length++;
  }

  /** Whether the record in *slot* is this one: a server that is asked again sends its newest again. */
  private same(slot: number, data: Uint8Array, offset: number): boolean {
    for (let k = 0; k < SAME; k++) if (this.bytes[slot * RECORD + k] !== data[offset + k]) return false;
    return true;
  }

  clear(): void {
    this.first = this.length = 0;
  }

  private grow(capacity: number): void {
    const bytes = new Uint8Array(capacity * RECORD);
    const stamps = new Float64Array(capacity);
    for (let k = 0; k < this.length; k++) {
      const slot = this.slot(k);
      bytes.set(this.bytes.subarray(slot * RECORD, (slot + 1) * RECORD), k * RECORD);
      stamps[k] = this.stamps[slot];
    }
    this.bytes = bytes;
    this.stamps = stamps;
    this.floats = new Float32Array(bytes.buffer);
    this.words = new Uint32Array(bytes.buffer);
    this.doubles = new Float64Array(bytes.buffer);
    this.capacity = capacity;
    this.first = 0;
  }

  private slot(k: number): number {
    return (this.first + k) % this.capacity;
  }

  /** s since 1970 */
  at(k: number): number {
    return this.stamps[this.slot(k)];
  }

  /** One of the record's f32; *field* is one of AT, plus the index of the component. */
  value(k: number, field: number): number {
    return this.floats[this.slot(k) * WORDS + field];
  }

  deviceTime(k: number): number {
    return this.doubles[this.slot(k) * DOUBLES + AT.time];
  }

  hostTime(k: number): number {
    return this.doubles[this.slot(k) * DOUBLES + AT.host];
  }

  sequence(k: number): number {
    const word = this.slot(k) * WORDS + 2 * AT.sequence;
    return this.words[word] + 2 ** 32 * this.words[word + 1];
  }

  flags(k: number): number {
    return this.words[this.slot(k) * WORDS + AT.flags];
  }

  /** Flags of this row and of those since the record before that were not sent. */
  allFlags(k: number): number {
    const word = this.slot(k) * WORDS;
    return (this.words[word + AT.flags] | this.words[word + AT.flagsSince]) >>> 0;
  }

  valid(k: number): boolean {
    return this.bytes[this.slot(k) * RECORD + AT.valid] === 1;
  }

  tip(k: number): number {
    return this.bytes[this.slot(k) * RECORD + AT.tip];
  }

  /** The last record at or before *time*, −1 where there is none. */
  find(time: number): number {
    let low = 0;
    let high = this.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.at(middle) <= time) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }
}
