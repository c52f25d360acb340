// Where the root went, as a ribbon on the ground that fades.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, MeshBasicMaterial } from "./vendor/three.module.js";

const POINTS = 400;
const APART = 0.05; // metres
const HALF = 0.018; // of its width
const HEIGHT = 0.006;
const FASTEST = 10; // metres a second

export class Trail {
  constructor(color) {
    this.points = [];
    this.color = new Color(color);
    this.geometry = new BufferGeometry();
    this.geometry.setAttribute("position", new BufferAttribute(new Float32Array(6 * POINTS), 3));
    this.geometry.setAttribute("color", new BufferAttribute(new Float32Array(8 * POINTS), 4));
    this.geometry.setIndex(Array.from({ length: POINTS - 1 }, (_, k) => quad(2 * k)).flat());
    const look = { vertexColors: true, transparent: true, depthWrite: false, side: DoubleSide };
    this.mesh = new Mesh(this.geometry, new MeshBasicMaterial(look));
    this.mesh.frustumCulled = false;
  }

  // seconds: since the last time.
  follow(place, seconds) {
    const last = this.points.at(-1);
    const way = last ? Math.hypot(place.x - last[0], place.z - last[1]) : Infinity;
    if (way < APART) return;
    if (way > 1 + FASTEST * seconds) this.points = []; // put elsewhere
    this.points.push([place.x, place.z]);
    if (this.points.length > POINTS) this.points.shift();
    this.changed = true;
  }

  clear() {
    this.points = [];
    this.changed = true;
  }

  draw() {
    if (!this.changed) return;
    this.changed = false;
    const { position, color } = this.geometry.attributes;
    const { r, g, b } = this.color;
    this.points.forEach(([x, z], k) => {
      const [fromX, fromZ] = this.points[Math.max(0, k - 1)];
      const [toX, toZ] = this.points[Math.min(this.points.length - 1, k + 1)];
      const scale = HALF / (Math.hypot(toX - fromX, toZ - fromZ) || 1);
      const [acrossX, acrossZ] = [(toZ - fromZ) * scale, (fromX - toX) * scale];
      position.setXYZ(2 * k, x - acrossX, HEIGHT, z - acrossZ);
      position.setXYZ(2 * k + 1, x + acrossX, HEIGHT, z + acrossZ);
      const shade = (0.9 * (k + 1)) / this.points.length;
      color.setXYZW(2 * k, r, g, b, shade);
      color.setXYZW(2 * k + 1, r, g, b, shade);
    });
    position.needsUpdate = color.needsUpdate = true;
    this.geometry.setDrawRange(0, 6 * Math.max(0, this.points.length - 1));
  }
}

function quad(first) {
  return [first, first + 1, first + 2, first + 1, first + 3, first + 2];
}
