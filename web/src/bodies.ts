// The body of one device at the instant shown, large.

import type * as THREE from "three";
import { AT, type Shape } from "./protocol";
import type { Playhead } from "./playhead";
import { Scene, type Pose } from "./scene";
import type { Area, View } from "./stage";
import type { Store, Track } from "./store";

export function poseOf(store: Store, track: Track, time: number, following: boolean): Pose {
  const { ring } = track;
  const k = following ? ring.length - 1 : ring.find(time);
  if (k < 0) return { quat: [NaN, NaN, NaN, NaN], sequence: -1, valid: false, sigmaHeading: NaN, colour: track.colour };
  return {
    quat: [0, 1, 2, 3].map((c) => ring.value(k, AT.quat + c)) as Pose["quat"],
    sequence: ring.sequence(k),
    valid: !store.whyInvalid(track, k) || (!following && ring.valid(k)),
    sigmaHeading: ring.value(k, AT.sigma + 2),
    colour: track.colour,
  };
}

export class BodyView implements View {
  readonly scene: Scene;

  constructor(
    private store: Store,
    private playhead: Playhead,
    readonly id: string,
    readonly element: HTMLElement,
    shape: Shape,
  ) {
    this.scene = new Scene(shape);
    this.turnable();
  }

  get elements(): Iterable<HTMLElement> {
    return [this.element];
  }

  update(): void {
    const shown = this.store.tracksOf(this.id).filter((track) => track.running);
    this.scene.pose(shown.map((track) => poseOf(this.store, track, this.playhead.time, this.playhead.following)));
  }

  draw(renderer: THREE.WebGLRenderer, boxes: Map<HTMLElement, DOMRect>, { left, top, height }: Area): void {
    const box = boxes.get(this.element);
    if (!box) return;
    const [x, y] = [box.left - left, box.top - top];
    const [from, to] = [Math.max(0, y), Math.min(height, y + box.height)];
    if (to <= from) return;
    this.scene.look(box.width / box.height);
    renderer.setViewport(x, height - y - box.height, box.width, box.height);
    renderer.setScissor(x, height - to, box.width, to - from);
    renderer.render(this.scene.scene, this.scene.camera);
  }

  /** Drag or arrow keys turn the view; the body stays where it is. */
  private turnable(): void {
    const { element, scene } = this;
    const turn = (azimuth: number, elevation: number) => {
      scene.azimuth += azimuth;
      scene.elevation = Math.min(1.5, Math.max(0.05, scene.elevation + elevation));
      this.store.version++;
    };
    element.addEventListener("pointerdown", (down) => element.setPointerCapture(down.pointerId));
    element.addEventListener("pointermove", (move) => {
      if (element.hasPointerCapture(move.pointerId)) turn(-0.008 * move.movementX, 0.008 * move.movementY);
    });
    element.addEventListener("keydown", (key) => {
      const step = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[key.key];
      if (!step) return;
      key.preventDefault();
      turn(step[0], step[1]);
    });
  }
}
