// One WebGL canvas over all views, no larger than they are together; every view draws into the rectangle of its element.

import * as THREE from "three";
import { byId } from "./dom";
import { paint, type Scene } from "./scene";

export interface View {
  element: HTMLElement;
  scene: Scene;
  /** Sets the scene to the instant shown; false where it is as it was. */
  update(): void;
}

/** Whether the processor does the drawing: smooth edges would cost it a third more. */
function software(): boolean {
  const probe = document.createElement("canvas").getContext("webgl2");
  const name = probe?.getParameter(probe.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL ?? probe.RENDERER) as string | undefined;
  return /swiftshader|llvmpipe|softpipe|basic render/i.test(name ?? "");
}

const MANY = 12; // views; more are drawn at one pixel a pixel

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
    const seen = [...this.views]
      .map(({ element, scene }) => ({ scene, box: element.getBoundingClientRect() }))
      .filter(({ box }) => box.width > 0 && box.bottom > top && box.top < bottom);
    this.fit(renderer, seen.map(({ box }) => box), top, bottom);
    for (const { scene, box } of seen) {
      const [left, up] = [box.left - this.left, box.top - this.top];
      const [from, to] = [Math.max(0, up), Math.min(this.height, up + box.height)];
      if (to <= from) continue;
      scene.look(box.width / box.height);
      renderer.setViewport(left, this.height - up - box.height, box.width, box.height);
      renderer.setScissor(left, this.height - to, box.width, to - from);
      renderer.render(scene.scene, scene.camera);
    }
  }

  private left = 0;
  private top = 0;
  private height = 0;

  /** Puts the canvas over *boxes*, between the lines at the top and the bottom of the page, and empties it. */
  private fit(renderer: THREE.WebGLRenderer, boxes: DOMRect[], top: number, bottom: number): void {
    this.canvas.hidden = boxes.length === 0;
    if (!boxes.length) return;
    this.left = Math.floor(Math.min(...boxes.map((box) => box.left)));
    this.top = Math.floor(Math.max(top, Math.min(...boxes.map((box) => box.top))));
    const width = Math.ceil(Math.max(...boxes.map((box) => box.right))) - this.left;
    this.height = Math.ceil(Math.min(bottom, Math.max(...boxes.map((box) => box.bottom)))) - this.top;
    const ratio = Math.min(devicePixelRatio, this.views.size > MANY ? 1 : 2);
    const size = `${width} ${this.height} ${ratio}`;
    if (size !== this.size) {
      this.size = size;
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, this.height);
    }
    const place = `translate(${this.left}px, ${this.top}px)`;
    if (place !== this.place) this.canvas.style.transform = this.place = place;
    renderer.setScissor(0, 0, width, this.height);
    renderer.clear();
  }
}
