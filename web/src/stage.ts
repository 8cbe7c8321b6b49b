// One WebGL canvas over all views, no larger than they are together; every view draws into the rectangles of its elements.

import * as THREE from "three";
import { byId } from "./dom";
import { paint } from "./paint";

/** Where the canvas is, CSS pixels of the window. */
export interface Area {
  left: number;
  top: number;
  width: number;
  height: number;
}

export interface View {
  /** what it draws into */
  elements: Iterable<HTMLElement>;
  /** Takes the instant shown. */
  update(): void;
  /** Draws into those elements that have a box: the others are not in sight. */
  draw(renderer: THREE.WebGLRenderer, boxes: Map<HTMLElement, DOMRect>, area: Area): void;
}

/** Whether the processor does the drawing: smooth edges would cost it a third more. */
function software(): boolean {
  const probe = document.createElement("canvas").getContext("webgl2");
  const name = probe?.getParameter(probe.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL ?? probe.RENDERER) as string | undefined;
  return /swiftshader|llvmpipe|softpipe|basic render/i.test(name ?? "");
}

const MANY = 12; // bodies; more are drawn at one pixel a pixel

export class Stage {
  redraws = 0;
  private renderer: THREE.WebGLRenderer | null = null;
  private canvas = byId("stage") as HTMLCanvasElement;
  private views = new Set<View>();
  private size = "";
  private place = "";
  dirty = true;

  constructor() {
    try {
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, alpha: true, antialias: !software(), powerPreference: "low-power" });
      this.renderer.setScissorTest(true);
      this.renderer.setClearColor(0, 0);
      paint.refresh();
    } catch {
      this.canvas.hidden = true; // no WebGL: the numbers and plots go on
    }
    const again = () => (this.dirty = true);
    addEventListener("resize", again);
    addEventListener("scroll", again, { passive: true, capture: true });
    const moved = new ResizeObserver(again); // an alarm pushes all below it down
    for (const id of ["bar", "alarm", "banner", "main", "transport"]) moved.observe(byId(id));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      paint.refresh();
      this.dirty = true;
    });
  }

  get works(): boolean {
    return this.renderer !== null;
  }

  add(view: View): void {
    this.views.add(view);
    this.dirty = true;
  }

  remove(view: View): void {
    this.views.delete(view);
    this.dirty = true;
  }

  draw(): void {
    const { renderer } = this;
    for (const view of this.views) view.update();
    this.dirty = false;
    this.redraws++;
    if (!renderer) return;
    const top = byId("bar").getBoundingClientRect().bottom;
    const bottom = byId("transport").getBoundingClientRect().top;
    const boxes = new Map<HTMLElement, DOMRect>();
    for (const view of this.views) {
      for (const element of view.elements) {
        const box = element.getBoundingClientRect();
        if (box.width > 0 && box.bottom > top && box.top < bottom) boxes.set(element, box);
      }
    }
    this.canvas.hidden = boxes.size === 0;
    if (!boxes.size) return;
    this.fit(renderer, [...boxes.values()], top, bottom);
    for (const view of this.views) view.draw(renderer, boxes, this.area);
  }

  private area: Area = { left: 0, top: 0, width: 0, height: 0 };

  /** Puts the canvas over *boxes*, between the lines at the top and the bottom of the page, and empties it. */
  private fit(renderer: THREE.WebGLRenderer, boxes: DOMRect[], above: number, below: number): void {
    const left = Math.floor(Math.min(...boxes.map((box) => box.left)));
    const top = Math.floor(Math.max(above, Math.min(...boxes.map((box) => box.top))));
    const width = Math.ceil(Math.max(...boxes.map((box) => box.right))) - left;
    const height = Math.ceil(Math.min(below, Math.max(...boxes.map((box) => box.bottom)))) - top;
    this.area = { left, top, width, height };
    const ratio = Math.min(devicePixelRatio, boxes.length > MANY ? 1 : 2);
    const size = `${width} ${height} ${ratio}`;
    if (size !== this.size) {
      this.size = size;
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, height);
    }
    const place = `translate(${left}px, ${top}px)`;
    if (place !== this.place) this.canvas.style.transform = this.place = place;
    renderer.setScissor(0, 0, width, height);
    renderer.clear();
  }
}
