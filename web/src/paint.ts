// Materials in the colours of the theme.

import * as THREE from "three";
import { css } from "./dom";

/** Materials of a theme. */
class Paint {
  solid = new THREE.MeshLambertMaterial({ vertexColors: true });
  /** a body whose vertices are lit already */
  lit = new THREE.MeshBasicMaterial({ vertexColors: true });
  /** a body whose attitude is not to be acted on */
  hollow = new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.12, depthWrite: false });
  hollowEdge = new THREE.LineBasicMaterial();
  edge = new THREE.LineBasicMaterial();
  grid = new THREE.LineBasicMaterial();
  north = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide });
  /** a letter, seen through what stands before it */
  letter = new THREE.MeshBasicMaterial({ depthTest: false, transparent: true });
  needle = new THREE.LineBasicMaterial();
  wedge = new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.16, depthWrite: false, side: THREE.DoubleSide });
  axes = new THREE.LineBasicMaterial({ vertexColors: true, depthTest: false, transparent: true });
  private letters = new Map<string, THREE.SpriteMaterial>();
  private ghosts = new Map<number, { face: THREE.MeshBasicMaterial; edge: THREE.LineBasicMaterial }>();

  refresh(): void {
    this.hollow.color.set(css("--warn"));
    this.hollowEdge.color.set(css("--warn"));
    this.edge.color.set(css("--body-edge"));
    this.solid.color.set(css("--body"));
    this.lit.color.set(css("--body"));
    this.grid.color.set(css("--grid"));
    this.north.color.set(css("--north"));
    this.letter.color.set(css("--north"));
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
