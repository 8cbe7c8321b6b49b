// The bodies of many devices in one scene. They are turned, lit and seen in perspective here: on a machine whose processor does the graphics' work, too,
// that took fifty bodies from 65 to 30 ms. Of triangles only those that face the viewer go to the graphics, and all of a kind in one call.

import * as THREE from "three";
import { paint } from "./paint";
import type { Shape } from "./protocol";
import { AZIMUTH, ELEVATION, GROUND, headingOf, LIGHT, look, RADIUS, shared, type Drawn, type Pose } from "./scene";
import { looks } from "./shapes";
import type { Area, View } from "./stage";

type Quaternion = [x: number, y: number, z: number, w: number];
const LEVEL: Quaternion = [0, 0, 0, 1];

/** A square of the canvas, which goes from −1 to 1: its middle and half its sides. */
interface Place {
  x: number;
  y: number;
  width: number;
  height: number;
}

const sun = LIGHT.from.clone().normalize();
const turned = new THREE.Matrix4();
const seen = new THREE.Matrix4();
const quaternion = new THREE.Quaternion();

/** What of a geometry is put where, as one object: lines, triangles of one colour, or triangles that are lit. */
class Part {
  readonly object: THREE.Mesh | THREE.LineSegments;
  private points: Float32Array;
  private normals: Float32Array | null;
  private colours: Float32Array | null;
  private room = 0;
  private length = 0; // vertices
  private at!: THREE.BufferAttribute;
  private shade!: THREE.BufferAttribute;

  constructor(base: THREE.BufferGeometry, material: THREE.Material, private kind: "lines" | "flat" | "lit") {
    this.object = kind === "lines" ? new THREE.LineSegments(undefined, material) : new THREE.Mesh(undefined, material);
    this.object.frustumCulled = false;
    const array = (name: string) => base.getAttribute(name).array as Float32Array;
    this.points = array("position");
    this.normals = kind === "lit" ? array("normal") : null;
    this.colours = kind === "lit" ? array("color") : null;
  }

  empty(): void {
    this.length = 0;
  }

  /** Sees it from *camera*, turned, in a square of the canvas. */
  put(turn: Quaternion, place: Place, camera: THREE.Camera): void {
    const { points, kind } = this;
    const vertices = points.length / 3;
    if (this.length + vertices > this.room) this.grow(2 * (this.length + vertices));
    turned.makeRotationFromQuaternion(quaternion.set(...turn));
    const m = seen.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).multiply(turned).elements;
    const out = this.at.array as Float32Array;
    const corners = kind === "lines" ? 2 : 3;
    for (let k = 0; k < vertices; k += corners) {
      let to = 3 * this.length;
      for (let c = k; c < k + corners; c++, to += 3) {
        const [x, y, z] = [points[3 * c], points[3 * c + 1], points[3 * c + 2]];
        const w = m[3] * x + m[7] * y + m[11] * z + m[15];
        out[to] = place.x + (place.width * (m[0] * x + m[4] * y + m[8] * z + m[12])) / w;
        out[to + 1] = place.y + (place.height * (m[1] * x + m[5] * y + m[9] * z + m[13])) / w;
        out[to + 2] = -(m[2] * x + m[6] * y + m[10] * z + m[14]) / w;
      }
      if (corners === 3 && !facing(out, to - 9)) continue;
      if (this.colours) this.light(k);
      this.length += corners;
    }
  }

  /** The colours of the triangle from vertex *k*, as the last one put. */
  private light(k: number): void {
    const e = turned.elements;
    const [normals, colours, shade] = [this.normals!, this.colours!, this.shade.array as Float32Array];
    for (let c = 0; c < 3; c++) {
      const [from, to] = [3 * (k + c), 3 * (this.length + c)];
      const [x, y, z] = [normals[from], normals[from + 1], normals[from + 2]];
      const [east, north, up] = [e[0] * x + e[4] * y + e[8] * z, e[1] * x + e[5] * y + e[9] * z, e[2] * x + e[6] * y + e[10] * z];
      const direct = LIGHT.sun * Math.max(0, east * sun.x + north * sun.y + up * sun.z);
      const [above, below] = [(LIGHT.around * (1 + up)) / 2, (LIGHT.around * (1 - up)) / 2];
      shade[to] = (colours[from] * (direct + above * LIGHT.sky.r + below * LIGHT.earth.r)) / Math.PI;
      shade[to + 1] = (colours[from + 1] * (direct + above * LIGHT.sky.g + below * LIGHT.earth.g)) / Math.PI;
      shade[to + 2] = (colours[from + 2] * (direct + above * LIGHT.sky.b + below * LIGHT.earth.b)) / Math.PI;
    }
  }

  /** To be called when all is put. */
  finish(): void {
    this.object.visible = this.length > 0;
    this.object.geometry.setDrawRange(0, this.length);
    for (const attribute of this.colours ? [this.at, this.shade] : [this.at]) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, 3 * this.length);
      attribute.needsUpdate = true;
    }
  }

  private grow(room: number): void {
    this.room = room;
    const geometry = new THREE.BufferGeometry();
    const attribute = (name: string, before?: THREE.BufferAttribute) => {
      const made = new THREE.BufferAttribute(new Float32Array(3 * room), 3).setUsage(THREE.DynamicDrawUsage);
      if (before) made.set(before.array);
      geometry.setAttribute(name, made);
      return made;
    };
    this.at = attribute("position", this.at);
    if (this.colours) this.shade = attribute("color", this.shade);
    this.object.geometry.dispose();
    this.object.geometry = geometry;
  }
}

/** Whether a triangle's corners go round against the clock. */
function facing(points: Float32Array, at: number): boolean {
  const [x, y] = [points[at], points[at + 1]];
  return (points[at + 3] - x) * (points[at + 7] - y) > (points[at + 6] - x) * (points[at + 4] - y);
}

interface Member {
  shape: Shape;
  pose: () => Pose | undefined;
  quat: Quaternion;
  shown: Pose | undefined;
}

const isSure = ({ shown }: Member): boolean => Boolean(shown?.valid && shown.quat.every(Number.isFinite));

/** Bodies of devices, from the same side each. */
export class Crowd implements View {
  private scene = new THREE.Scene();
  private canvas = new THREE.OrthographicCamera(-1, 1, 1, -1, -1, 1); // all is put where it is seen
  private eye = new THREE.PerspectiveCamera(30, 1, 0.5, 40);
  private members = new Map<HTMLElement, Member>();
  private parts = new Map<string, Part>();

  constructor() {
    look(this.eye, AZIMUTH, ELEVATION, 1);
    this.eye.updateMatrixWorld();
  }

  get elements(): Iterable<HTMLElement> {
    return this.members.keys();
  }

  /** The body of a device, which *pose* tells, in the middle of *element*. */
  add(element: HTMLElement, shape: Shape, pose: () => Pose | undefined): void {
    this.members.set(element, { shape, pose, quat: LEVEL, shown: undefined });
  }

  remove(element: HTMLElement): void {
    this.members.delete(element);
  }

  clear(): void {
    this.members.clear();
  }

  update(): void {
    for (const member of this.members.values()) {
      const pose = (member.shown = member.pose());
      if (!pose?.quat.every(Number.isFinite)) continue; // it stays as it was, hollow
      const [w, x, y, z] = pose.quat;
      member.quat = [x, y, z, w];
    }
  }

  drawn(element: HTMLElement): Drawn | null {
    const member = this.members.get(element);
    if (!member) return null;
    const [x, y, z, w] = member.quat;
    return { quat: [w, x, y, z], sequence: member.shown?.sequence ?? -1, valid: isSure(member) };
  }

  draw(renderer: THREE.WebGLRenderer, boxes: Map<HTMLElement, DOMRect>, area: Area): void {
    for (const part of this.parts.values()) part.empty();
    for (const [element, member] of this.members) {
      const box = boxes.get(element);
      if (box) this.put(member, middle(box, area));
    }
    for (const part of this.parts.values()) part.finish();
    renderer.setViewport(0, 0, area.width, area.height);
    renderer.setScissor(0, 0, area.width, area.height);
    renderer.render(this.scene, this.canvas);
  }

  private put(member: Member, place: Place): void {
    const { shape, quat, shown } = member;
    const put = (name: string, make: () => Part, turn = LEVEL) => {
      let part = this.parts.get(name);
      if (!part) {
        this.parts.set(name, (part = make()));
        this.scene.add(part.object);
      }
      part.put(turn, place, this.eye);
    };
    put("rose", () => new Part(onGround(shared.plain), paint.grid, "lines"));
    if (shape !== "joint") { // which is seen from its base: there is no north
      put("mark", () => new Part(onGround(shared.north), paint.north, "flat"));
      put("letter", () => new Part(letterN(this.eye.quaternion), paint.letter, "flat"));
    }
    const heading = headingOf(shown);
    if (heading !== null) put("needle", () => new Part(needle(), paint.needle, "lines"), [0, 0, Math.sin(-heading / 2), Math.cos(heading / 2)]);
    const { solid, edges } = looks(shape, false);
    if (isSure(member)) {
      put(`${shape} face`, () => new Part(solid, paint.lit, "lit"), quat);
      put(`${shape} edge`, () => new Part(edges, paint.edge, "lines"), quat);
    } else {
      put(`${shape} hollow face`, () => new Part(solid, paint.hollow, "flat"), quat);
      put(`${shape} hollow edge`, () => new Part(edges, paint.hollowEdge, "lines"), quat);
    }
  }
}

/** The largest square in the middle of *box*. */
function middle(box: DOMRect, area: Area): Place {
  const side = Math.min(box.width, box.height);
  const [x, y] = [box.left + box.width / 2 - area.left, box.top + box.height / 2 - area.top];
  return { x: (2 * x) / area.width - 1, y: 1 - (2 * y) / area.height, width: side / area.width, height: side / area.height };
}

const onGround = (geometry: THREE.BufferGeometry): THREE.BufferGeometry => geometry.clone().translate(0, 0, GROUND);

/** To the north; it is turned where it is put. */
function needle(): THREE.BufferGeometry {
  return onGround(new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute([0, 0, 0.03, 0, RADIUS, 0.03], 3)));
}

/** At the edge of the ground, facing the viewer. */
function letterN(viewer: THREE.Quaternion): THREE.BufferGeometry {
  const [x, y, bar] = [0.16, 0.22, 0.1]; // half its width and height, and the width of its strokes
  const stroke = (...[a, b, c, d]: [number, number][]) => [a, b, c, a, c, d].flatMap(([right, up]) => [right, up, 0]);
  const points = [
    ...stroke([-x, -y], [bar - x, -y], [bar - x, y], [-x, y]),
    ...stroke([x - bar, -y], [x, -y], [x, y], [x - bar, y]),
    ...stroke([x - bar, -y], [x, -y], [bar - x, y], [-x, y]),
  ];
  const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  return geometry.applyQuaternion(viewer).translate(0, RADIUS + 0.3, GROUND);
}
