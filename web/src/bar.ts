// The line at the top: what this is, whether it is connected, what can be done with all of it.

import { byId, h, say } from "./dom";
import type { DownloadDialog, PhoneDialog } from "./dialogs";
import type { Store } from "./store";

export class Bar {
  private crumb = h("nav", { "aria-label": "Where you are" });
  private state = h("span", { class: "link" });
  private recording = h("span", { class: "recording" });
  private phone: HTMLButtonElement;
  private download: HTMLButtonElement;
  private shown: string | null | undefined;

  constructor(private store: Store, phone: PhoneDialog, download: DownloadDialog, private chosen: () => string | null) {
    this.phone = h("button", { id: "phone", hidden: true, onclick: () => void phone.open() }, h("span", { class: "wide" }, "Use a "), "phone");
    this.download = h("button", { id: "download", onclick: () => void download.open(this.chosen()) }, "Download");
    byId("bar").append(h("a", { class: "mark", href: "#/", "aria-label": "poise, all devices" }, "poise"), this.crumb, this.recording, this.state, this.phone, this.download);
  }

  update(): void {
    const { link, hello, devices, health } = this.store;
    const chosen = this.chosen();
    const many = devices.size > 1;
    const joints = [...devices.values()].filter((device) => device.shape === "joint").length;
    const counted = (count: number, name: string) => `${count} ${name}${count === 1 ? "" : "s"}`;
    const all = counted(devices.size - joints, this.store.instant ? "recording" : "device") + (joints ? `, ${counted(joints, "joint")}` : "");
    const key = `${chosen} ${all}`;
    if (key !== this.shown) {
      this.shown = key;
      this.crumb.replaceChildren(
        ...(many ? [chosen ? h("a", { class: "back", href: "#/", "aria-label": all }, h("span", { class: "wide" }, all)) : h("span", {}, all)] : []),
        ...(chosen ? [h("h1", {}, chosen)] : []),
      );
      document.title = chosen ? `${chosen} – poise` : "poise";
      this.download.hidden = devices.size === 0 || this.store.instant !== null;
    }
    const words = { connecting: "Connecting", open: "Live", lost: "Connection lost", refused: "Token needed" };
    say(this.state, this.store.instant && link.state === "open" ? "From file" : words[link.state]);
    this.state.dataset.state = link.state;
    this.state.title = hello?.server ?? "";
    const condition = health?.recording ?? hello?.recording ?? null;
    say(this.recording, condition && link.state === "open" ? (condition.reason ? "Not recording" : "Recording") : "");
    this.recording.classList.toggle("bad", Boolean(condition?.reason));
    this.recording.title = condition?.reason ?? "";
    this.phone.hidden = !hello?.offers?.includes("/phone");
  }
}
