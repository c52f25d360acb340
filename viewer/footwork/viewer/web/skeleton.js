// Where the joints are: protocol/SPEC.md, "Units and axes". Parents come before their children.
import { Quaternion, Vector3 } from "./vendor/three.module.js";

export class Skeleton {
  constructor(welcome) {
    this.names = welcome.joints;
    this.parents = welcome.parents;
    this.offsets = welcome.offsets.map((offset) => new Vector3(...offset));
    this.ends = welcome.ends.map((end) => new Vector3(...end));
    this.places = this.names.map(() => new Vector3());
    this.turns = this.names.map(() => new Quaternion());
  }

  // Puts places and turns, in the world, where a pose has them.
  pose({ root, rotations }) {
    this.names.forEach((_, joint) => {
      const parent = this.parents[joint];
      const turn = this.turns[joint].fromArray(rotations, 4 * joint);
      const place = this.places[joint];
      if (parent < 0) {
        place.fromArray(root);
      } else {
        turn.premultiply(this.turns[parent]);
        place.copy(this.offsets[joint]).applyQuaternion(this.turns[parent]).add(this.places[parent]);
      }
    });
  }

  index(name) {
    return this.names.indexOf(name);
  }

  children(joint) {
    return this.names.flatMap((_, other) => (this.parents[other] === joint ? [other] : []));
  }
}
