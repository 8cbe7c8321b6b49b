// Dialogs: a token, a phone, downloads.

import { csv, save, saveFile } from "./csv";
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

  /** It is no longer needed. */
  close(): void {
    this.element.close();
  }

  ask(reason: string): void {
    say(this.reason, reason);
    if (!this.element.open) this.element.showModal();
    this.input.focus();
  }
}

/** A code for the camera of a phone, where the server has such a page. */
export class PhoneDialog {
  private what = h("p");
  private image = h("div", { class: "qr" });
  private element: HTMLDialogElement;

  constructor(private source: Source) {
    this.element = dialog("Use a phone", this.what, this.image, h("p", {}, h("a", { href: "/phone" }, "Open that page here")), closing(() => this.element));
  }

  async open(): Promise<void> {
    this.image.replaceChildren();
    say(this.what, "");
    this.element.showModal();
    const answer = await this.source.get("/phone/qr.svg").catch(() => null);
    if (!answer?.ok) return say(this.what, !answer ? "The server cannot be reached." : answer.status === 401 ? "The code holds a token, which is shown to whoever has one with the scope “write”." : await reason(answer));
    say(this.what, "Point the phone’s camera at this. The page that it opens sends the phone’s motion here.");
    const picture = h("img", { alt: "QR code of the page for phones", src: URL.createObjectURL(new Blob([await answer.text()], { type: "image/svg+xml" })) });
    this.image.replaceChildren(picture);
  }
}

interface Kept {
  name: string;
  /** null: it is being recorded */
  bytes: number | null;
  url: string;
}

export class DownloadDialog {
  private held = h("div", { class: "held" });
  private recordings = h("div", { class: "held" });
  private answer = h("p", { class: "answer", role: "status", "aria-live": "polite" });
  private element: HTMLDialogElement;

  constructor(private store: Store, private source: Source) {
    this.element = dialog("Download", this.held, this.recordings, this.answer, closing(() => this.element));
  }

  async open(id: string | null): Promise<void> {
    const ids = id ? [id] : [...this.store.devices.keys()];
    const button = h("button", { id: "save-csv", class: "main", onclick: () => save(`poise-${id ?? "devices"}-${new Date().toISOString().slice(0, 19).replaceAll(":", "-")}.csv`, csv(this.store, ids)) }, "Save as CSV");
    this.held.replaceChildren(h("h3", {}, "What this page holds"), h("p", {}, `The last minutes of ${id ?? `${count(ids.length)} devices`}, 30 rows a second: attitude, sigma, sensors, flags.`), button);
    this.recordings.replaceChildren();
    say(this.answer, "");
    this.element.showModal();
    if (!this.store.hello?.recording || !this.store.hello.offers.includes("/recordings")) return;
    try {
      const files = (await (await this.fetched("/recordings")).json()) as Kept[];
      files.sort((a, b) => sessionOf(b).localeCompare(sessionOf(a), "en")); // what is being recorded, then the newest
      const rows = files.length ? files.map((file) => this.file(file)) : [h("p", { class: "none" }, "Nothing yet.")];
      this.recordings.replaceChildren(h("h3", {}, "Recorded by the server, every sample"), h("div", { class: "files" }, ...rows));
    } catch (problem) {
      this.tell(`What was recorded cannot be listed: ${(problem as Error).message}`, true);
    }
  }

  /** A plain link can neither carry a token nor say why there is no file: it is fetched, and saved from here. */
  private file({ name, bytes, url }: Kept): HTMLElement {
    const fetch = async () => {
      button.disabled = true;
      this.tell(`Fetching ${name} …`);
      try {
        const file = await (await this.fetched(url)).blob();
        saveFile(name.split("/").pop()!, file);
        this.tell(`${name}: ${size(file.size)}`);
      } catch (problem) {
        this.tell((problem as Error).message, true);
      }
      button.disabled = false;
    };
    const button = h("button", { class: "quiet", onclick: () => void fetch() }, name);
    return h("p", { class: "file" }, button, h("span", {}, bytes === null ? "being recorded" : size(bytes)));
  }

  /** The server's answer; rejects with its reason where it has none. */
  private async fetched(path: string): Promise<Response> {
    const answer = await this.source.get(path).catch(() => {
      throw new Error("the server cannot be reached");
    });
    if (answer.ok) return answer;
    throw new Error(await reason(answer));
  }

  private tell(text: string, bad = false): void {
    say(this.answer, text);
    this.answer.classList.toggle("bad", bad);
  }
}

function sessionOf({ name }: Kept): string {
  return name.split("/")[0];
}

function size(bytes: number): string {
  return bytes >= 1e6 ? `${(bytes / 1e6).toFixed(1)} MB` : `${Math.ceil(bytes / 1e3)} kB`;
}

/** Why the server does not do it: of JSON its `error`, else its text. */
async function reason(answer: Response): Promise<string> {
  const text = await answer.text().catch(() => "");
  try {
    return (JSON.parse(text) as { error: string }).error;
  } catch {
    return text.trim() || `the server answers ${answer.status}`;
  }
}
