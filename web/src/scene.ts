// The scene of one device: bodies over an east-north-up ground with north marked.

import * as THREE from "three";
import { css } from "./dom";
import { paint } from "./paint";
import type { Shape } from "./protocol";
import { looks } from "./shapes";

export const GROUND = -1.35;
export const RADIUS = 1.9;
export const AZIMUTH = 0.42;
export const ELEVATION = 0.5;
export const LIGHT = { sun: 1.9, from: new THREE.Vector3(-1.5, -2.5, 4), around: 1.7, sky: new THREE.Color(0xffffff), earth: new THREE.Color(0x8890a0) };
const WEDGE = 24;
type Sign = readonly [string, number, number];
const EARTH: Sign[] = [["N", 0, 1], ["E", 1, 0], ["S", 0, -1], ["W", -1, 0]];
const BASE: Sign[] = [["y", 0, 1], ["x", 1, 0]];

function rose(sides: number, marks: number): THREE.BufferGeometry {
  const points: number[] = [];
  const at = (share: number, radius: number) => [radius * Math.sin(2 * Math.PI * share), radius * Math.cos(2 * Math.PI * share), 0];
  for (let k = 0; k < sides; k++) points.push(...at(k / sides, RADIUS), ...at((k + 1) / sides, RADIUS));
  for (let k = 0; k < marks; k++) points.push(...at(k / marks, RADIUS - (k % 9 === 0 ? 0.22 : 0.1)), ...at(k / marks, RADIUS));
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

export const shared = { rose: rose(72, 36), plain: rose(28, 0), north: northMark() };

/** One body, as one method has it. */
class Body {
  readonly group = new THREE.Group();
  sequence = -1;
  valid = true;
  private face: THREE.Mesh;
  private edge: THREE.LineSegments;

  constructor(shape: Shape, private ghost: number | null) {
    const { solid, edges } = looks(shape, true);
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

/** Where the body's y points, clockwise from north, rad; null where it stands steeply or is not known. */
export function headingOf(pose: Pose | undefined): number | null {
  if (!pose?.valid) return null;
  const [w, x, y, z] = pose.quat;
  const [east, north] = [2 * (x * y - w * z), 1 - 2 * (x * x + z * z)];
  return Math.hypot(east, north) > 0.2 ? Math.atan2(east, north) : null;
}

function sunlight(): THREE.Light[] {
  const sun = new THREE.DirectionalLight(0xffffff, LIGHT.sun);
  sun.position.copy(LIGHT.from);
  const sky = new THREE.HemisphereLight(LIGHT.sky, LIGHT.earth, LIGHT.around);
  sky.position.set(0, 0, 1);
  return [sky, sun];
}

/** Looks at the body from *azimuth* and *elevation*, rad, so that all of it is in a picture of that *aspect*. */
export function look(camera: THREE.PerspectiveCamera, azimuth: number, elevation: number, aspect: number): void {
  const distance = 8.4 / Math.min(1, Math.max(0.5, aspect));
  const level = Math.cos(elevation);
  camera.up.set(0, 0, 1);
  camera.position.set(Math.sin(azimuth) * level, -Math.cos(azimuth) * level, Math.sin(elevation)).multiplyScalar(distance);
  camera.position.z -= 0.5;
  camera.lookAt(0, 0, -0.5);
  camera.aspect = aspect;
  camera.updateProjectionMatrix();
}

export class Scene {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(30, 1, 0.5, 40);
  azimuth = AZIMUTH;
  elevation = ELEVATION;
  private bodies: Body[] = [];
  private needle: THREE.Line;
  private wedge: THREE.Mesh;
  private ghosts = "";

  constructor(private shape: Shape) {
    this.scene.add(...sunlight());
    const ground = new THREE.Group();
    ground.position.z = GROUND;
    ground.add(new THREE.LineSegments(shared.rose, paint.grid));
    const joint = shape === "joint"; // seen from its base: there is no north
    if (!joint) ground.add(new THREE.Mesh(shared.north, paint.north));
    for (const [text, x, y] of joint ? BASE : EARTH) {
      const sign = new THREE.Sprite(paint.sign(text));
      sign.position.set(x * (RADIUS + 0.3), y * (RADIUS + 0.3), 0);
      sign.scale.setScalar(0.44);
      sign.renderOrder = 3;
      ground.add(sign);
    }
    this.needle = new THREE.Line(new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute([0, 0, 0.01, 0, 0, 0.01], 3)), paint.needle);
    this.needle.frustumCulled = false;
    ground.add(this.needle);
    const fan = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(new Float32Array(3 * (WEDGE + 2)), 3));
    fan.setIndex(Array.from({ length: WEDGE }, (_, k) => [0, k + 1, k + 2]).flat());
    this.wedge = new THREE.Mesh(fan, paint.wedge);
    this.wedge.frustumCulled = false;
    ground.add(this.wedge);
    this.scene.add(ground);
    this.rebuild([]);
  }

  private rebuild(poses: Pose[]): void {
    for (const body of this.bodies) this.scene.remove(body.group);
    this.bodies = [new Body(this.shape, null), ...poses.slice(1).map((pose) => new Body(this.shape, pose.colour))];
    const axes = new THREE.LineSegments(axesGeometry(), paint.axes);
    axes.renderOrder = 2;
    this.bodies[0].group.add(axes);
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
    const heading = headingOf(pose);
    this.needle.visible = heading !== null;
    this.wedge.visible = heading !== null && pose!.sigmaHeading > 0.002;
    if (heading === null) return;
    const points = this.needle.geometry.getAttribute("position") as THREE.BufferAttribute;
    points.setXYZ(1, RADIUS * Math.sin(heading), RADIUS * Math.cos(heading), 0.01);
    points.needsUpdate = true;
    if (!this.wedge.visible) return;
    const fan = this.wedge.geometry.getAttribute("position") as THREE.BufferAttribute;
    const half = Math.min(Math.PI, pose!.sigmaHeading);
    for (let k = 0; k <= WEDGE; k++) {
      const angle = heading + half * ((2 * k) / WEDGE - 1);
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
    look(this.camera, this.azimuth, this.elevation, aspect);
  }
}
