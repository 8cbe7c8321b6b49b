// What a device looks like: one merged mesh a shape, x right, y forward, z up, about two units long.

import * as THREE from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { Shape } from "./protocol";

type Part = { geometry: THREE.BufferGeometry; tone: number };

/** How finely round things are made. Among many devices coarsely: where the processor draws, every corner costs it 0.7 µs. */
let fine = true;
const corners = (least: number, most: number): number => (fine ? most : least);

function box(x: number, y: number, z: number, at: [number, number, number], tone: number): Part {
  return { geometry: new THREE.BoxGeometry(x, y, z).translate(...at).toNonIndexed(), tone };
}

function cylinder(radius: number, length: number, axis: "x" | "y" | "z", at: [number, number, number], tone: number, top = radius): Part {
  const geometry = new THREE.CylinderGeometry(top, radius, length, corners(8, 28)); // along y
  if (axis === "x") geometry.rotateZ(-Math.PI / 2);
  if (axis === "z") geometry.rotateX(Math.PI / 2);
  return { geometry: geometry.translate(...at).toNonIndexed(), tone };
}

function ring(outer: number, inner: number, length: number, at: [number, number, number], tone: number): Part {
  const shape = new THREE.Shape().absarc(0, 0, outer, 0, 2 * Math.PI, false);
  shape.holes.push(new THREE.Path().absarc(0, 0, inner, 0, 2 * Math.PI, true));
  const geometry = new THREE.ExtrudeGeometry(shape, { depth: length, bevelEnabled: false, curveSegments: corners(8, 24) });
  geometry.translate(0, 0, -length / 2).rotateX(Math.PI / 2).translate(...at);
  return { geometry: geometry.index ? geometry.toNonIndexed() : geometry, tone };
}

function slab(width: number, length: number, height: number, corner: number, at: [number, number, number], tone: number): Part {
  const [a, b, r] = [width / 2, length / 2, corner];
  const shape = new THREE.Shape();
  shape.absarc(a - r, b - r, r, 0, Math.PI / 2, false);
  shape.absarc(-a + r, b - r, r, Math.PI / 2, Math.PI, false);
  shape.absarc(-a + r, -b + r, r, Math.PI, 1.5 * Math.PI, false);
  shape.absarc(a - r, -b + r, r, 1.5 * Math.PI, 2 * Math.PI, false);
  const geometry = new THREE.ExtrudeGeometry(shape, { depth: height, bevelEnabled: false, curveSegments: corners(1, 6) });
  geometry.translate(at[0], at[1], at[2] - height / 2);
  return { geometry: geometry.index ? geometry.toNonIndexed() : geometry, tone };
}

/** The nose that says which way is forward. */
const nose = (y: number, z: number, size = 0.16): Part => {
  const geometry = new THREE.ConeGeometry(size, 1.5 * size, 3).rotateY(Math.PI).scale(1, 1, 0.3).translate(0, y, z);
  return { geometry: geometry.toNonIndexed(), tone: 2 };
};

const PARTS: Record<Shape, () => Part[]> = {
  board: () => [
    slab(1.3, 1.9, 0.12, 0.14, [0, 0, 0], 0),
    box(0.5, 0.5, 0.12, [0, 0.05, 0.12], 1),
    box(0.34, 0.2, 0.12, [0, -0.86, 0.1], 1),
    box(0.12, 0.26, 0.08, [-0.42, 0.3, 0.1], 1),
    box(0.12, 0.26, 0.08, [0.42, 0.3, 0.1], 1),
    nose(0.68, 0.09, 0.15),
  ],
  phone: () => [
    slab(1.0, 2.1, 0.14, 0.16, [0, 0, 0], 0),
    slab(0.92, 2.0, 0.02, 0.12, [0, 0, 0.08], 1),
    nose(0.7, 0.1, 0.14),
  ],
  band: () => [
    cylinder(0.3, 2.3, "y", [0, -0.05, 0], 3, 0.26), // the forearm, towards the hand
    ring(0.46, 0.36, 0.55, [0, 0, 0], 0),
    slab(0.62, 0.7, 0.2, 0.1, [0, 0, 0.48], 1),
    nose(0.16, 0.59, 0.13),
  ],
  handle: () => [
    cylinder(0.24, 1.9, "y", [0, -0.2, 0], 0, 0.21),
    ring(0.3, 0.2, 0.12, [0, 0.72, 0], 1),
    cylinder(0.2, 0.4, "y", [0, 0.95, 0], 1, 0.1),
    box(0.16, 0.4, 0.1, [0, 0.2, 0.22], 1),
    nose(0.52, 0.24, 0.11),
  ],
  robot: () => [
    box(0.9, 0.5, 0.5, [0, 0, -0.55], 1),
    box(0.72, 0.36, 1.25, [0, 0, 0.3], 0),
    box(0.9, 0.46, 0.26, [0, 0, 0.98], 1),
    cylinder(0.5, 0.2, "x", [-0.62, 0, -0.7], 3),
    cylinder(0.5, 0.2, "x", [0.62, 0, -0.7], 3),
    { geometry: new THREE.ConeGeometry(0.15, 0.3, 3).rotateY(Math.PI).translate(0, 0.36, 0.98).toNonIndexed(), tone: 2 },
  ],
  joint: () => [
    cylinder(0.2, 1.1, "y", [0, 0.6, 0], 0, 0.16),
    cylinder(0.3, 0.44, "x", [0, 0, 0], 1),
    cylinder(0.17, 0.36, "y", [0, -0.4, 0], 3),
    nose(1.2, 0, 0.14),
  ],
};

/** light, dark, accent and muted; the theme tints them all */
const TONES = [0.93, 0.42, -1, 0.62];
const ACCENT = new THREE.Color(0x3d6df2);

export interface Looks {
  solid: THREE.BufferGeometry;
  edges: THREE.BufferGeometry;
}

const made = new Map<string, Looks>();

/** *detailed*: for a large picture of it. */
export function looks(shape: Shape, detailed: boolean): Looks {
  const key = `${shape} ${detailed}`;
  let found = made.get(key);
  if (!found) {
    fine = detailed;
    const parts = (PARTS[shape] ?? PARTS.board)().map(({ geometry, tone }) => {
      const count = geometry.getAttribute("position").count;
      const value = TONES[tone];
      const colour = value < 0 ? ACCENT : new THREE.Color().setRGB(value, value, value, THREE.SRGBColorSpace);
      const colours = new Float32Array(3 * count);
      for (let k = 0; k < count; k++) colour.toArray(colours, 3 * k);
      geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
      geometry.deleteAttribute("uv");
      return geometry;
    });
    const solid = mergeGeometries(parts)!;
    found = { solid, edges: new THREE.EdgesGeometry(solid, 35) };
    made.set(key, found);
  }
  return found;
}
