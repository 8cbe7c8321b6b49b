// One WebGL canvas over the page; every view draws into the rectangle of its element.

import * as THREE from "three";
import { byId } from "./dom";
import { paint, type Scene } from "./scene";

export interface View {
  element: HTMLElement;
  scene: Scene;
  /** Sets the scene to the instant shown; false where it is as it was. */
  update(): void;
}

const MANY = 12; // views; more are drawn at one pixel a pixel

export class Stage {
  redraws = 0;
  private renderer: THREE.WebGLRenderer | null = null;
  private canvas = byId("stage") as HTMLCanvasElement;
  private views = new Set<View>();
  private size = "";
  dirty = true;

  constructor() {
    try {
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, alpha: true, antialias: true, powerPreference: "low-power" });
      this.renderer.setScissorTest(true);
      this.renderer.setClearColor(0, 0);
      paint.refresh();
    } catch {
      this.canvas.hidden = true; // no WebGL: the numbers and plots go on
    }
    const again = () => (this.dirty = true);
    addEventListener("resize", again);
    addEventListener("scroll", again, { passive: true, capture: true });
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
    const [width, height] = [document.documentElement.clientWidth, innerHeight];
    const ratio = Math.min(devicePixelRatio, this.views.size > MANY ? 1 : 2);
    const size = `${width} ${height} ${ratio}`;
    if (size !== this.size) {
      this.size = size;
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, height);
    }
    renderer.setScissor(0, 0, width, height);
    renderer.clear();
    const top = byId("bar").getBoundingClientRect().bottom;
    const bottom = byId("transport").getBoundingClientRect().top;
    for (const { element, scene } of this.views) {
      const box = element.getBoundingClientRect();
      const [from, to] = [Math.max(box.top, top), Math.min(box.bottom, bottom)];
      if (to <= from || box.width === 0) continue;
      scene.look(box.width / box.height);
      renderer.setViewport(box.left, height - box.bottom, box.width, box.height);
      renderer.setScissor(box.left, height - to, box.width, to - from);
      renderer.render(scene.scene, scene.camera);
    }
  }
}
