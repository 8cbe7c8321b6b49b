// The scene of one device: bodies over an east-north-up ground with north marked.

import * as THREE from "three";
import { css } from "./dom";
import type { Shape } from "./protocol";
import { looks } from "./shapes";

const GROUND = -1.35;
const RADIUS = 1.9;
const WEDGE = 24;
type Sign = readonly [string, number, number];
const EARTH: Sign[] = [["N", 0, 1], ["E", 1, 0], ["S", 0, -1], ["W", -1, 0]];
const BASE: Sign[] = [["y", 0, 1], ["x", 1, 0]];

/** Materials of a theme, shared by all scenes. */
class Paint {
  solid = new THREE.MeshLambertMaterial({ vertexColors: true });
  /** a body whose attitude is not to be acted on */
  hollow = new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.12, depthWrite: false });
  hollowEdge = new THREE.LineBasicMaterial();
  edge = new THREE.LineBasicMaterial();
  grid = new THREE.LineBasicMaterial();
  north = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide });
  needle = new THREE.LineBasicMaterial();
  wedge = new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.16, depthWrite: false, side: THREE.DoubleSide });
  axes = new THREE.LineBasicMaterial({ vertexColors: true, depthTest: false, transparent: true });
  letters = new Map<string, THREE.SpriteMaterial>();
  private ghosts = new Map<number, { face: THREE.MeshBasicMaterial; edge: THREE.LineBasicMaterial }>();

  refresh(): void {
    this.hollow.color.set(css("--warn"));
    this.hollowEdge.color.set(css("--warn"));
    this.edge.color.set(css("--body-edge"));
    this.solid.color.set(css("--body"));
    this.grid.color.set(css("--grid"));
    this.north.color.set(css("--north"));
    this.needle.color.set(css("--accent"));
    this.wedge.color.set(css("--accent"));
    for (const [text, material] of this.letters) {
      material.map?.dispose();
      material.map = letter(text, css(text === "N" ? "--north" : "--muted"));
    }
    for (const [colour, { face, edge }] of this.ghosts) {
      face.color.set(css(`--m${colour}`));
      edge.color.set(css(`--m${colour}`));
    }
  }

  ghost(colour: number): { face: THREE.MeshBasicMaterial; edge: THREE.LineBasicMaterial } {
    let found = this.ghosts.get(colour);
    if (!found) {
      const shade = css(`--m${colour}`);
      found = {
        face: new THREE.MeshBasicMaterial({ color: shade, transparent: true, opacity: 0.14, depthWrite: false }),
        edge: new THREE.LineBasicMaterial({ color: shade, transparent: true, opacity: 0.85 }),
      };
      this.ghosts.set(colour, found);
    }
    return found;
  }

  sign(text: string): THREE.SpriteMaterial {
    let found = this.letters.get(text);
    if (!found) {
      found = new THREE.SpriteMaterial({ map: letter(text, css(text === "N" ? "--north" : "--muted")), depthWrite: false, depthTest: false });
      this.letters.set(text, found);
    }
    return found;
  }
}

function letter(text: string, colour: string): THREE.Texture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const context = canvas.getContext("2d")!;
  context.fillStyle = colour;
  context.font = "600 44px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(text, 32, 34);
  return new THREE.CanvasTexture(canvas);
}

export const paint = new Paint();

function rose(): THREE.BufferGeometry {
  const points: number[] = [];
  const circle = (radius: number) => {
    for (let k = 0; k < 72; k++) {
      for (const angle of [k, k + 1]) points.push(radius * Math.sin((angle * Math.PI) / 36), radius * Math.cos((angle * Math.PI) / 36), 0);
    }
  };
  circle(RADIUS);
  for (let k = 0; k < 36; k++) {
    const [s, c] = [Math.sin((k * Math.PI) / 18), Math.cos((k * Math.PI) / 18)];
    const inner = RADIUS - (k % 9 === 0 ? 0.22 : 0.1);
    points.push(inner * s, inner * c, 0, RADIUS * s, RADIUS * c, 0);
  }
  points.push(-0.9 * RADIUS, 0, 0, 0.9 * RADIUS, 0, 0, 0, -0.9 * RADIUS, 0, 0, 0.9 * RADIUS, 0);
  return new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
}

function northMark(): THREE.BufferGeometry {
  const [tip, base] = [RADIUS + 0.02, RADIUS - 0.3];
  const points = [0, tip, 0.01, -0.13, base, 0.01, 0.13, base, 0.01];
  return new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
}

function axesGeometry(): THREE.BufferGeometry {
  const points = [0, 0, 0, 1.25, 0, 0, 0, 0, 0, 0, 1.55, 0, 0, 0, 0, 0, 0, 1.1];
  const colours = ["--x", "--y", "--z"].flatMap((name) => {
    const [r, g, b] = new THREE.Color(css(name)).toArray();
    return [r, g, b, r, g, b];
  });
  return new THREE.BufferGeometry()
    .setAttribute("position", new THREE.Float32BufferAttribute(points, 3))
    .setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
}

const shared = { rose: rose(), north: northMark() };

/** One body, as one method has it. */
class Body {
  readonly group = new THREE.Group();
  sequence = -1;
  valid = true;
  private face: THREE.Mesh;
  private edge: THREE.LineSegments;

  constructor(shape: Shape, private ghost: number | null) {
    const { solid, edges } = looks(shape);
    this.face = new THREE.Mesh(solid, paint.solid);
    this.edge = new THREE.LineSegments(edges, paint.edge);
    this.group.add(this.face, this.edge);
    this.setValid(true);
  }

  setValid(valid: boolean): void {
    this.valid = valid;
    const ghost = this.ghost === null ? null : paint.ghost(this.ghost);
    this.face.material = ghost ? ghost.face : valid ? paint.solid : paint.hollow;
    this.edge.material = ghost ? ghost.edge : valid ? paint.edge : paint.hollowEdge;
  }
}

export interface Drawn {
  quat: number[];
  sequence: number;
  valid: boolean;
}

export interface Pose {
  /** w x y z; NaN: unknown */
  quat: [number, number, number, number];
  /** number of the sample; −1: none */
  sequence: number;
  valid: boolean;
  /** rad; NaN: not known */
  sigmaHeading: number;
  colour: number;
}

export class Scene {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(30, 1, 0.5, 40);
  azimuth = 0.42;
  elevation = 0.5;
  private bodies: Body[] = [];
  private needle: THREE.Line;
  private wedge: THREE.Mesh | null = null;
  private ghosts = "";

  constructor(private shape: Shape, private rich: boolean) {
    this.camera.up.set(0, 0, 1);
    const sun = new THREE.DirectionalLight(0xffffff, 1.9);
    sun.position.set(-1.5, -2.5, 4);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8890a0, 1.7), sun);
    const ground = new THREE.Group();
    ground.position.z = GROUND;
    ground.add(new THREE.LineSegments(shared.rose, paint.grid));
    const joint = shape === "joint"; // seen from its base: there is no north
    if (!joint) ground.add(new THREE.Mesh(shared.north, paint.north));
    for (const [text, x, y] of joint ? BASE : EARTH) {
      if (!rich && text !== "N") continue;
      const sign = new THREE.Sprite(paint.sign(text));
      sign.position.set(x * (RADIUS + 0.3), y * (RADIUS + 0.3), 0);
      sign.scale.setScalar(rich ? 0.44 : 0.62);
      sign.renderOrder = 3;
      ground.add(sign);
    }
    this.needle = new THREE.Line(new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute([0, 0, 0.01, 0, 0, 0.01], 3)), paint.needle);
    this.needle.frustumCulled = false;
    ground.add(this.needle);
    if (rich) {
      const fan = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(new Float32Array(3 * (WEDGE + 2)), 3));
      fan.setIndex(Array.from({ length: WEDGE }, (_, k) => [0, k + 1, k + 2]).flat());
      this.wedge = new THREE.Mesh(fan, paint.wedge);
      this.wedge.frustumCulled = false;
      ground.add(this.wedge);
    }
    this.scene.add(ground);
    this.rebuild([]);
  }

  private rebuild(poses: Pose[]): void {
    for (const body of this.bodies) this.scene.remove(body.group);
    this.bodies = [new Body(this.shape, null), ...poses.slice(1).map((pose) => new Body(this.shape, pose.colour))];
    if (this.rich) {
      const axes = new THREE.LineSegments(axesGeometry(), paint.axes);
      axes.renderOrder = 2;
      this.bodies[0].group.add(axes);
    }
    for (const body of this.bodies) this.scene.add(body.group);
  }

  /** The first pose is drawn as the body, others as its ghosts. */
  pose(poses: Pose[]): void {
    const ghosts = poses.slice(1).map((pose) => pose.colour).join();
    if (ghosts !== this.ghosts) {
      this.ghosts = ghosts;
      this.rebuild(poses);
    }
    this.bodies.forEach((body, k) => {
      const pose = poses[k];
      const known = pose !== undefined && pose.quat.every(Number.isFinite);
      body.group.visible = known || k === 0;
      if (known) body.group.quaternion.set(pose.quat[1], pose.quat[2], pose.quat[3], pose.quat[0]);
      body.sequence = pose?.sequence ?? -1;
      body.setValid(known && pose.valid);
    });
    this.point(poses[0]);
  }

  /** On the ground: which way the body's y points, and how far off that may be. */
  private point(pose: Pose | undefined): void {
    const [w, x, y, z] = pose?.quat ?? [NaN, NaN, NaN, NaN];
    const [east, north] = [2 * (x * y - w * z), 1 - 2 * (x * x + z * z)];
    const level = Math.hypot(east, north);
    this.needle.visible = level > 0.2 && pose!.valid;
    if (this.wedge) this.wedge.visible = this.needle.visible && pose!.sigmaHeading > 0.002;
    if (!this.needle.visible) return;
    const points = this.needle.geometry.getAttribute("position") as THREE.BufferAttribute;
    points.setXYZ(1, (RADIUS * east) / level, (RADIUS * north) / level, 0.01);
    points.needsUpdate = true;
    if (!this.wedge?.visible) return;
    const fan = this.wedge.geometry.getAttribute("position") as THREE.BufferAttribute;
    const [middle, half] = [Math.atan2(east, north), Math.min(Math.PI, pose!.sigmaHeading)];
    for (let k = 0; k <= WEDGE; k++) {
      const angle = middle + half * ((2 * k) / WEDGE - 1);
      fan.setXYZ(k + 1, RADIUS * Math.sin(angle), RADIUS * Math.cos(angle), 0.005);
    }
    fan.needsUpdate = true;
  }

  /** What the scene's objects hold now: the quaternion (w x y z) of a body and the number of its sample. */
  drawn(k = 0): Drawn | null {
    const body = this.bodies[k];
    if (!body) return null;
    const { x, y, z, w } = body.group.quaternion;
    return { quat: [w, x, y, z], sequence: body.sequence, valid: body.valid };
  }

  look(aspect: number): void {
    const distance = 8.4 / Math.min(1, Math.max(0.5, aspect));
    const level = Math.cos(this.elevation);
    this.camera.position.set(Math.sin(this.azimuth) * level, -Math.cos(this.azimuth) * level, Math.sin(this.elevation)).multiplyScalar(distance);
    this.camera.position.z -= 0.5;
    this.camera.lookAt(0, 0, -0.5);
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }
}
