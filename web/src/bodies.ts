// Views on the stage: the body of a device at the instant shown.

import { AT, type Shape } from "./protocol";
import type { Playhead } from "./playhead";
import { Scene, type Pose } from "./scene";
import type { View } from "./stage";
import type { Store, Track } from "./store";

function poseOf(store: Store, track: Track, time: number, following: boolean): Pose {
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
    private rich: boolean,
  ) {
    this.scene = new Scene(shape, rich);
    if (rich) this.turnable();
  }

  update(): void {
    const running = this.store.tracksOf(this.id).filter((track) => track.running);
    const shown = this.rich ? running : running.slice(0, 1);
    this.scene.pose(shown.map((track) => poseOf(this.store, track, this.playhead.time, this.playhead.following)));
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
