// Dialogs: a token, a phone, downloads.

import { csv, save } from "./csv";
import { h, say } from "./dom";
import type { Source } from "./source";
import type { Store } from "./store";
import { count } from "./words";

function dialog(title: string, ...content: Node[]): HTMLDialogElement {
  const id = `title-${title.toLowerCase().replaceAll(/\W+/g, "-")}`;
  const found = h("dialog", { "aria-labelledby": id }, h("h2", { id }, title), ...content);
  found.addEventListener("click", (event) => {
    if (event.target === found) found.close();
  });
  document.body.append(found);
  return found;
}

function closing(of: () => HTMLDialogElement): HTMLElement {
  return h("div", { class: "buttons" }, h("button", { onclick: () => of().close() }, "Close"));
}

export class TokenDialog {
  private reason = h("p", { class: "answer bad", role: "alert" });
  private input = h("input", { type: "password", id: "token", autocomplete: "off", spellcheck: "false", required: true });
  private element: HTMLDialogElement;

  constructor(source: Source) {
    const form = h("form", {}, h("label", { for: "token" }, "Token"), this.input, this.reason, h("div", { class: "buttons" }, h("button", { type: "submit", class: "main" }, "Connect")));
    this.element = dialog("This server wants a token", h("p", {}, "It is the one that “poise live” was started with. It is kept until this tab is closed, and is in no address."), form);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.element.close();
      source.identify(this.input.value.trim());
      this.input.value = "";
    });
  }

  ask(reason: string): void {
    say(this.reason, reason);
    if (!this.element.open) this.element.showModal();
    this.input.focus();
  }
}

/** A code for the camera of a phone, where the server has such a page. */
export class PhoneDialog {
  private image = h("div", { class: "qr" });
  private element: HTMLDialogElement;

  constructor(private source: Source) {
    this.element = dialog("Use a phone", h("p", {}, "Point the phone’s camera at this. The page that it opens sends the phone’s motion here."), this.image, h("p", {}, h("a", { href: "/phone" }, "Open that page here")), closing(() => this.element));
  }

  async open(): Promise<void> {
    this.element.showModal();
    const answer = await this.source.get("/phone/qr.svg").catch(() => null);
    if (!answer?.ok) {
      const reason = await answer?.json().catch(() => null);
      return say(this.image, (reason as { error?: string } | null)?.error ?? "The server has no code to show.");
    }
    const picture = h("img", { alt: "QR code of the page for phones", src: URL.createObjectURL(new Blob([await answer.text()], { type: "image/svg+xml" })) });
    this.image.replaceChildren(picture);
  }
}

interface Kept {
  name: string;
  bytes: number;
  url: string;
}

export class DownloadDialog {
  private held = h("div", { class: "held" });
  private recordings = h("div", { class: "held" });
  private element: HTMLDialogElement;

  constructor(private store: Store, private source: Source) {
    this.element = dialog("Download", this.held, this.recordings, closing(() => this.element));
  }

  async open(id: string | null): Promise<void> {
    const ids = id ? [id] : [...this.store.devices.keys()];
    const button = h("button", { id: "save-csv", class: "main", onclick: () => save(`poise-${id ?? "devices"}-${new Date().toISOString().slice(0, 19).replaceAll(":", "-")}.csv`, csv(this.store, ids)) }, "Save as CSV");
    this.held.replaceChildren(h("h3", {}, "What this page holds"), h("p", {}, `The last minutes of ${id ?? `${count(ids.length)} devices`}, 30 rows a second: attitude, sigma, sensors, flags.`), button);
    this.recordings.replaceChildren();
    this.element.showModal();
    if (!this.store.hello?.offers?.includes("/recordings")) return;
    const answer = await this.source.get("/recordings").catch(() => null);
    if (!answer?.ok) return;
    const files = (await answer.json()) as Kept[];
    this.recordings.replaceChildren(h("h3", {}, "Recorded by the server, every sample"), ...files.map((file) => this.file(file)));
    if (!files.length) this.recordings.append(h("p", { class: "none" }, "Nothing is finished yet: files are made when a recording ends."));
  }

  /** A plain link cannot carry a token: the file is fetched with it and saved from here. */
  private file({ name, bytes, url }: Kept): HTMLElement {
    const fetched = async () => {
      const answer = await this.source.get(url);
      if (!answer.ok) return;
      const link = h("a", { href: URL.createObjectURL(await answer.blob()), download: name.split("/").pop() });
      link.click();
    };
    return h("p", { class: "file" }, h("button", { class: "quiet", onclick: () => void fetched() }, name), h("span", {}, bytes >= 1e6 ? `${(bytes / 1e6).toFixed(1)} MB` : `${(bytes / 1e3).toFixed(0)} kB`));
  }
}
