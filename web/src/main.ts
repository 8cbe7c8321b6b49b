// The page: a source of frames, what it holds, and what is drawn of it.

import { Alarm, Banner } from "./alarm";
import { Bar } from "./bar";
import { Crowd } from "./crowd";
import type { Quantity } from "./curves";
import { Detail } from "./detail";
import { DownloadDialog, PhoneDialog, TokenDialog } from "./dialogs";
import { byId, h } from "./dom";
import { Events } from "./events";
import { Grid } from "./grid";
import { Latched } from "./latched";
import { FilmSource } from "./film";
import { Playhead } from "./playhead";
import { Reel, ReelBar } from "./reel";
import { SocketSource, tokenFromAddress } from "./socket";
import type { Source } from "./source";
import { Stage } from "./stage";
import { Store } from "./store";
import { Transport } from "./transport";

const LEAST_BETWEEN = 20; // ms between two redraws: 30 a second on a screen of 60, and no frame of a slow one left out

declare global {
  interface Window {
    poise: unknown;
  }
}

class Page {
  private store = new Store();
  private playhead: Playhead;
  private stage = new Stage();
  private crowd = new Crowd();
  private shown: Grid | Detail | null = null;
  private all: Events | null = null;
  private key = "";
  private version = -1;
  private last = 0;
  private transport: { update(now: number): void };
  private bar: Bar;
  private alarm = new Alarm(this.store);
  private latched: Latched;
  private banner = new Banner(this.store);

  constructor(private source: Source) {
    this.playhead = source instanceof FilmSource ? new Reel(this.store, source) : new Playhead(this.store);
    this.latched = new Latched(this.store, source);
    const token = new TokenDialog(source);
    this.bar = new Bar(this.store, new PhoneDialog(source), new DownloadDialog(this.store, source), () => this.chosen);
    this.transport = this.playhead instanceof Reel ? new ReelBar(this.playhead) : new Transport(this.store, this.playhead);
    this.store.on(["hello", "devices"], () => this.show());
    this.store.on(["connection"], () => {
      if (this.store.link.state === "refused") token.ask(this.store.link.reason);
      else if (this.store.link.state === "open") token.close();
      this.slow();
    });
    addEventListener("hashchange", () => {
      const token = tokenFromAddress();
      if (token) source.identify(token);
      this.show();
    });
    addEventListener("keydown", (key) => {
      if (key.key === "Escape" && this.chosen && this.store.devices.size > 1 && !document.querySelector("dialog[open]")) location.hash = "#/";
    });
    setInterval(() => this.slow(), 250);
    this.show();
    this.source.start(this.store);
    requestAnimationFrame((now) => this.frame(now));
    this.expose();
  }

  /** The device of the address; the only one there is where the address names none. */
  private get chosen(): string | null {
    const named = deviceOf(location.hash);
    if (this.store.devices.has(named)) return named;
    return this.store.devices.size === 1 ? [...this.store.devices.keys()][0] : null;
  }

  private show(): void {
    const { devices, hello } = this.store;
    const { chosen } = this;
    if (hello?.films && this.source.live) return location.replace(`?view${location.hash}`); // a server of `poise view`
    const device = chosen === null ? undefined : devices.get(chosen);
    const key = !hello ? "nothing" : !devices.size ? "empty" : device ? `device ${chosen} ${device.shape} ${device.segment}/${device.base}` : "all";
    if (key !== this.key) {
      this.key = key;
      this.shown?.destroy();
      this.shown = this.all = null;
      const main = byId("main");
      main.className = key.split(" ")[0];
      if (key === "nothing") main.replaceChildren();
      else if (key === "empty") main.replaceChildren(empty());
      else if (device) this.shown = new Detail(this.store, this.playhead, this.stage, this.source, device);
      else this.shown = new Grid(this.store, this.playhead, this.stage, this.crowd);
      if (this.shown) main.replaceChildren(this.shown.element);
      if (this.shown instanceof Grid && this.source.live) main.append((this.all = new Events(this.store, null)).element);
      scrollTo(0, 0);
    }
    this.shown?.sync();
    this.slow();
  }

  private slow(): void {
    this.bar.update();
    this.alarm.update();
    this.latched.update();
    this.banner.update();
    if (this.source instanceof FilmSource && this.playhead instanceof Reel) {
      for (const id of this.chosen ? [this.chosen] : this.store.devices.keys()) this.source.look(id, this.playhead.range(), this.playhead.speed);
    }
  }

  private frame(now: number): void {
    requestAnimationFrame((next) => this.frame(next));
    if (now - this.last < LEAST_BETWEEN) return;
    this.last = now;
    if (this.playhead instanceof Reel) this.playhead.advance(now);
    this.shown?.update(now);
    this.all?.update(now);
    this.transport.update(now);
    if (this.version === this.store.version && !this.stage.dirty) return;
    this.version = this.store.version;
    this.stage.draw();
  }

  /** For tests and for the curious: what is drawn, and how often. */
  private expose(): void {
    window.poise = {
      drawn: (id: string, method = 0) => (this.shown instanceof Detail && this.shown.device.id === id ? this.shown.drawn(method) : this.shown instanceof Grid ? this.shown.drawn(id) : null),
      ends: (quantity: Quantity) => (this.shown instanceof Detail ? this.shown.ends(quantity) : null),
      redraws: () => this.stage.redraws,
      painted: () => this.version,
      store: this.store,
      playhead: this.playhead,
    };
  }
}

function empty(): HTMLElement {
  const address = `${location.origin.replace(/^http/, "ws")}/ws/device/NAME`;
  return h(
    "section",
    { class: "empty" },
    h("h2", {}, "No device yet"),
    h("p", {}, "A device appears here with its first sample. It pushes to"),
    h("p", {}, h("code", {}, address)),
    h("p", {}, "or is named when the server is started:"),
    h("p", {}, h("code", {}, "poise live serial:/dev/ttyUSB0"), h("code", {}, "poise live udp::9000"), h("code", {}, "poise live replay:walk.csv"), h("code", {}, "poise live sim:balance")),
  );
}

/** The device that an address names; the address may be anything. */
function deviceOf(hash: string): string {
  if (!hash.startsWith("#/")) return "";
  try {
    return decodeURIComponent(hash.slice(2));
  } catch {
    return "";
  }
}

tokenFromAddress();
new Page(new URLSearchParams(location.search).has("view") ? new FilmSource() : new SocketSource());
