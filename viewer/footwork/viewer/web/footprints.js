// Where feet stand: a ring on the ground that stays where a foot came down, so that a foot that slides leaves it.
import { Group, Mesh, MeshBasicMaterial, RingGeometry } from "./vendor/three.module.js";

const PRINTS = 24;
const HEIGHT = 0.005;
const COLORS = { left: 0x2f6fb0, right: 0xc4552d };

export class Footprints {
  constructor() {
    this.group = new Group();
    this.prints = [];
    this.standing = { left: null, right: null };
    this.ring = new RingGeometry(0.05, 0.066, 28).rotateX(-Math.PI / 2);
  }

  // standing: {left: place or null, right: ...}
  follow(standing) {
    for (const side of ["left", "right"]) {
      if (standing[side] && !this.standing[side]) this.#put(side, standing[side]);
      this.standing[side] = standing[side];
    }
    this.prints.forEach((print, k) => {
      print.material.opacity = (0.75 * (k + 1)) / this.prints.length;
    });
  }

  clear() {
    this.group.clear();
    this.prints = [];
    this.standing = { left: null, right: null };
  }

  #put(side, place) {
    const print = this.prints.length < PRINTS ? this.#another() : this.prints.shift();
    print.material.color.setHex(COLORS[side]);
    print.position.set(place.x, HEIGHT, place.z);
    this.prints.push(print);
  }

  #another() {
    const print = new Mesh(this.ring, new MeshBasicMaterial({ transparent: true, depthWrite: false }));
    this.group.add(print);
    return print;
  }
}
