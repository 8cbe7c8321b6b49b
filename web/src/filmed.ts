// What there is to say of a recording: its methods' errors, and every flagged stretch.

import { fixed } from "./attitude";
import { h } from "./dom";
import type { FilmInfo } from "./protocol";
import type { Playhead } from "./playhead";
import type { Store } from "./store";
import { count, ZERO } from "./words";

const SHOWN = 200;

export class Filmed {
  readonly element: HTMLElement;

  constructor(store: Store, playhead: Playhead, id: string, film: FilmInfo) {
    const colours = new Map(store.tracksOf(id).map((track) => [track.method.number, track.colour]));
    const key = (number: number) => {
      const mark = h("i", { class: "key" });
      mark.style.setProperty("--key", `var(--m${colours.get(number) ?? 0})`);
      return mark;
    };
    const judged = film.methods.some((method) => method.error_deg);
    const head = h("tr", {}, h("th", { scope: "col" }, "Method"), ...(judged ? ["Total", "Heading", "Incl."].map((text) => h("th", { scope: "col" }, text)) : []));
    const rows = film.methods.map((method) => {
      const errors = method.error_deg;
      const cells = errors ? [errors.total, errors.heading, errors.inclination].map((value) => h("td", {}, value === null ? "–" : `${fixed(value, 2)}°`)) : judged ? [h("td", { colspan: 3 }, method.reference ? "" : "–")] : [];
      const name = h("th", { scope: "row" }, key(method.number), method.name);
      name.title = method.settings === "{}" ? ZERO[method.heading] : `${method.settings}; ${ZERO[method.heading]}`;
      return h("tr", {}, name, ...cells);
    });
    const caption = judged ? "RMSE against the reference, where it moves" : `${count(film.rows)} rows, ${fixed(film.end - film.start, 1)} s`;
    const table = h("table", { class: "errors" }, h("caption", {}, caption), h("thead", {}, head), h("tbody", {}, ...rows));
    const stretches = film.methods.flatMap((method) => method.stretches.map((stretch) => ({ ...stretch, method })));
    stretches.sort((a, b) => a.start - b.start);
    const list = stretches.slice(0, SHOWN).map(({ method, flag, start, end, text }) => {
      const [from, to] = [start - film.start, end - film.start];
      const go = h("button", { class: "stretch", onclick: () => playhead.seek(from) }, key(method.number), h("b", {}, method.reference ? "no reference" : flag.toLowerCase().replaceAll("_", " ")), h("time", {}, `${fixed(from, 2)}–${fixed(to, 2)} s`));
      go.title = `${method.name}: ${text}`;
      return h("li", {}, go);
    });
    if (stretches.length > SHOWN) list.push(h("li", { class: "none" }, `and ${count(stretches.length - SHOWN)} more`));
    if (!stretches.length) list.push(h("li", { class: "none" }, "No flags"));
    this.element = h("div", { class: "filmed" }, h("section", { class: "panel", "aria-label": "Methods" }, h("h2", {}, "Methods"), table), h("section", { class: "panel", "aria-label": "Flags" }, h("h2", {}, "Flags"), h("ol", { class: "events stretches" }, ...list)));
  }
}
