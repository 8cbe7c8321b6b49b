// All devices, a tile each.

import { angles, fixed } from "./attitude";
import { poseOf } from "./bodies";
import type { Crowd } from "./crowd";
import { h, say } from "./dom";
import type { Playhead } from "./playhead";
import { ALARMING } from "./protocol";
import type { DeviceInfo } from "./protocol";
import type { Drawn, Pose } from "./scene";
import type { Stage } from "./stage";
import type { Store } from "./store";
import { STATES, tipWord } from "./words";

const TEXT_EVERY = 200; // ms

interface Tile {
  element: HTMLAnchorElement;
  body: HTMLElement;
  device: DeviceInfo;
  /** heading and tilt, or of a joint angle and turn */
  first: HTMLElement;
  second: HTMLElement;
  state: HTMLElement;
}

export function route(id: string): string {
  return `#/${encodeURIComponent(id)}`;
}

export class Grid {
  readonly element = h("div", { class: "grid", role: "list", "aria-label": "Devices" });
  private tiles = new Map<string, Tile>();
  private written = 0;
  private visible = new Set<Element>();
  private watcher = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const tile = [...this.tiles.values()].find((each) => each.element === target);
      if (isIntersecting) this.visible.add(target);
      else this.visible.delete(target);
      if (!tile) continue;
      if (isIntersecting) this.crowd.add(tile.body, tile.device.shape, () => this.pose(tile));
      else this.crowd.remove(tile.body);
      this.stage.dirty = true;
    }
  }, { rootMargin: "80px" });

  constructor(private store: Store, private playhead: Playhead, private stage: Stage, private crowd: Crowd) {
    stage.add(this.crowd);
    this.sync();
  }

  destroy(): void {
    this.watcher.disconnect();
    this.stage.remove(this.crowd);
    this.crowd.clear();
  }

  /** Tiles for the devices that there are now. */
  sync(): void {
    const devices = [...this.store.devices.values()].sort((a, b) => a.id.localeCompare(b.id, "en", { numeric: true }));
    this.element.classList.toggle("many", devices.length > 8);
    for (const [id, tile] of this.tiles) {
      if (this.store.devices.get(id)?.shape === tile.device.shape) continue;
      this.watcher.unobserve(tile.element);
      this.crowd.remove(tile.body);
      tile.element.parentElement?.remove();
      this.tiles.delete(id);
    }
    devices.forEach((device, k) => {
      if (!this.tiles.has(device.id)) this.tiles.set(device.id, this.tile(device));
      const holder = this.tiles.get(device.id)!.element.parentElement!;
      if (this.element.children[k] !== holder) this.element.insertBefore(holder, this.element.children[k] ?? null);
    });
  }

  private tile(device: DeviceInfo): Tile {
    const body = h("div", { class: "body" });
    const [first, second, state] = [h("b"), h("b"), h("span", { class: "chip" })];
    const names = device.shape === "joint" ? ["Angle", "Turn"] : ["Heading", "Tilt"];
    const element = h(
      "a",
      { class: "tile", href: route(device.id) },
      body,
      h("div", { class: "name" }, device.id),
      h("dl", {}, ...names.map((name, k) => h("div", {}, h("dt", {}, name), h("dd", {}, [first, second][k], "°")))),
      state,
    );
    h("div", { role: "listitem" }, element);
    this.watcher.observe(element);
    return { element, body, device, first, second, state };
  }

  private pose({ device }: Tile): Pose | undefined {
    const track = this.store.tracksOf(device.id).find((each) => each.running);
    return track && poseOf(this.store, track, this.playhead.time, this.playhead.following);
  }

  drawn(id: string): Drawn | null {
    const tile = this.tiles.get(id);
    return tile ? this.crowd.drawn(tile.body) : null;
  }

  update(now: number): void {
    if (now - this.written < TEXT_EVERY) return;
    this.written = now;
    for (const [id, tile] of this.tiles) if (this.visible.has(tile.element)) this.write(id, tile);
  }

  private write(id: string, tile: Tile): void {
    const track = this.store.mainTrack(id);
    const following = this.playhead.following;
    const k = track ? (following ? track.ring.length - 1 : track.ring.find(this.playhead.time)) : -1;
    const invalid = track ? (following ? this.store.whyInvalid(track, k) : k < 0 || !track.ring.valid(k) ? "not valid" : "") : "no method";
    const tip = this.store.tipOf(id);
    const a = track && k >= 0 ? angles(track.ring, k) : null;
    const joint = tile.device.shape === "joint";
    const [first, second] = a ? (joint ? [a.angle, a.turn] : [a.heading, a.tilt]) : [NaN, NaN];
    say(tile.first, fixed(first, 0));
    say(tile.second, fixed(second, 0));
    const alarming = tip !== null && ALARMING.has(tip);
    const condition = this.store.conditions.get(id)?.state ?? "waiting";
    const word = alarming ? tipWord(tip) : invalid ? (condition === "live" ? "not valid" : STATES[condition]) : tip !== null ? tipWord(tip) : "valid";
    say(tile.state, word);
    tile.element.classList.toggle("alarming", alarming);
    tile.element.classList.toggle("invalid", !alarming && invalid !== "");
    tile.element.title = invalid;
    tile.element.setAttribute("aria-label", `${id}: ${word}${a ? `, ${joint ? "angle" : "heading"} ${fixed(first, 0)} degrees, ${joint ? "turn" : "tilt"} ${fixed(second, 0)} degrees` : ""}`);
  }
}
