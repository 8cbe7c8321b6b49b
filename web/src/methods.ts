// Which methods a device runs, and their parameters: looked at by all, changed by who may.

import { h, say } from "./dom";
import type { DeviceInfo, MethodKind, Parameter } from "./protocol";
import type { Source } from "./source";
import type { Store } from "./store";

type Settings = Record<string, unknown>;
interface Wanted {
  name: string;
  settings: Settings;
}
const MOST = 8;

export class Methods {
  readonly element: HTMLElement;
  private list = h("div", { class: "methods" });
  private answer = h("p", { class: "answer", role: "status", "aria-live": "polite" });
  private shown = "";
  private open = new Set<string>();

  constructor(private store: Store, private source: Source, private id: string) {
    this.element = h("section", { class: "panel", "aria-label": "Methods" }, h("h2", {}, "Methods"), this.list, this.answer);
    this.sync();
  }

  private get wanted(): Wanted[] {
    return (this.store.devices.get(this.id)?.methods ?? []).map(({ name, settings }) => ({ name, settings: JSON.parse(settings) as Settings }));
  }

  sync(): void {
    const device = this.store.devices.get(this.id);
    const { hello } = this.store;
    // what zero means is not shown here; written anew, fields would lose what is being typed
    const running = device?.methods.map(({ number, name, settings }) => [number, name, settings]);
    const key = JSON.stringify([running, hello?.may_write, this.store.tracksOf(this.id).map((t) => t.colour)]);
    if (key === this.shown || !device || !hello) return;
    this.shown = key;
    const focus = document.activeElement?.id;
    const adding = this.adding(hello.methods, device);
    this.list.replaceChildren(...device.methods.map((_, k) => this.row(device, k)), ...(adding ? [adding] : []));
    if (!hello.may_write) this.list.append(h("p", { class: "reason" }, "You may look, not change: this needs a token with the scope “write”."));
    if (focus) document.getElementById(focus)?.focus();
  }

  private row(device: DeviceInfo, k: number): HTMLElement {
    const method = device.methods[k];
    const kind = this.store.hello!.methods.find((each) => each.name === method.name);
    const settings = JSON.parse(method.settings) as Settings;
    const may = this.store.hello!.may_write;
    const colour = this.store.tracksOf(this.id).find((track) => track.method.number === method.number && track.running)?.colour ?? 0;
    const key = h("i", { class: "key" });
    key.style.setProperty("--key", `var(--m${colour})`);
    const changed = Object.keys(settings).length;
    const replace = h(
      "select",
      { id: `method-${k}`, "aria-label": `Method ${k + 1}`, disabled: !may, onchange: () => void this.change(k, { name: replace.value, settings: {} }) },
      ...this.store.hello!.methods.map((each) => h("option", { value: each.name, selected: each.name === method.name }, each.name)),
    );
    const details = h(
      "details",
      { open: this.open.has(method.name) },
      h("summary", {}, `Parameters${changed ? ` (${changed} changed)` : ""}`, k === 0 && device.methods.length > 1 ? h("span", { class: "first" }, "drawn solid") : null),
      kind ? this.parameters(kind, settings, k, may) : null,
    );
    details.addEventListener("toggle", () => this.open[details.open ? "add" : "delete"](method.name));
    return h(
      "div",
      { class: "method" },
      h(
        "div",
        { class: "line" },
        key,
        replace,
        device.methods.length > 1 && may ? h("button", { class: "quiet", "aria-label": `Stop ${method.name}`, title: "Stop this method", onclick: () => void this.ask(this.wanted.filter((_, n) => n !== k)) }, "×") : null,
      ),
      details,
    );
  }

  private adding(kinds: MethodKind[], device: DeviceInfo): HTMLElement | null {
    if (!this.store.hello!.may_write || device.methods.length >= MOST) return null;
    const running = new Set(device.methods.map((method) => method.name));
    const select = h(
      "select",
      {
        id: "method-add",
        "aria-label": "Run another method beside",
        onchange: () => {
          if (select.value) void this.ask([...this.wanted, { name: select.value, settings: {} }]);
          select.value = "";
        },
      },
      h("option", { value: "" }, "Overlay another method …"),
      ...kinds.filter(({ name }) => !running.has(name)).map(({ name }) => h("option", { value: name }, name)),
    );
    return select;
  }

  private parameters(kind: MethodKind, settings: Settings, k: number, may: boolean): HTMLElement {
    const fields = kind.parameters.map((parameter) => field(parameter, settings, `p-${k}-${parameter.name}`, may));
    const form = h("form", { class: "parameters" }, ...fields.map(({ element }) => element));
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const changed: Settings = {};
      for (const { parameter, value } of fields) {
        const found = value();
        if (found !== undefined && JSON.stringify(found) !== JSON.stringify(parameter.default)) changed[parameter.name] = found;
      }
      void this.change(k, { name: kind.name, settings: changed });
    });
    if (may) {
      form.append(
        h("div", { class: "buttons" }, h("button", { type: "submit" }, "Apply"), h("button", { type: "button", class: "quiet", onclick: () => void this.change(k, { name: kind.name, settings: {} }) }, "Defaults")),
      );
    }
    return form;
  }

  private change(k: number, to: Wanted): Promise<void> {
    return this.ask(this.wanted.map((each, n) => (n === k ? to : each)));
  }

  private async ask(methods: Wanted[]): Promise<void> {
    say(this.answer, "Asked; a method is loaded first …");
    this.answer.classList.remove("bad");
    try {
      await this.source.ask({ type: "methods", device: this.id, methods });
      say(this.answer, "");
    } catch (problem) {
      say(this.answer, (problem as Error).message);
      this.answer.classList.add("bad");
      this.shown = "";
      this.sync();
    }
  }
}

interface Field {
  parameter: Parameter;
  element: HTMLElement;
  /** undefined: left empty, so as it is by default */
  value: () => unknown;
}

function field(parameter: Parameter, settings: Settings, id: string, may: boolean): Field {
  const { name, unit, meaning, low, high, choices, kind } = parameter;
  const now = name in settings ? settings[name] : parameter.default;
  const label = h("label", { for: id, title: meaning }, name, unit && kind !== "choice" ? h("span", { class: "unit" }, ` ${unit}`) : null);
  const help = h("small", {}, meaning);
  const number = (which: string, value: unknown) =>
    h("input", { id: which, type: "number", step: kind === "int" ? 1 : "any", min: low, max: high, value: value ?? "", placeholder: value === null ? "none" : null, disabled: !may });
  const read = (input: HTMLInputElement) => (input.value === "" ? undefined : Number(input.value));
  if (kind === "choice") {
    const select = h("select", { id, disabled: !may }, ...choices.map((choice) => h("option", { value: JSON.stringify(choice), selected: choice === now }, String(choice ?? "none"))));
    return { parameter, element: h("div", {}, label, select, help), value: () => JSON.parse(select.value) as unknown };
  }
  if (kind === "bool") {
    const box = h("input", { id, type: "checkbox", checked: now === true, disabled: !may });
    return { parameter, element: h("div", {}, label, box, help), value: () => box.checked };
  }
  if (kind === "interval") {
    const [a, b] = Array.isArray(now) ? now : [null, null];
    const [from, to] = [number(id, a), number(`${id}-to`, b)];
    to.setAttribute("aria-label", `${name}, upper`);
    return { parameter, element: h("div", {}, label, h("span", { class: "two" }, from, to), help), value: () => (from.value === "" || to.value === "" ? undefined : [read(from), read(to)]) };
  }
  const input = kind === "str" ? h("input", { id, type: "text", value: now ?? "", disabled: !may }) : number(id, now);
  return { parameter, element: h("div", {}, label, input, help), value: () => (kind === "str" ? input.value || undefined : read(input)) };
}
