// Which feet stand, as far as shown poses tell: a point that is low and slow, until it is high or fast.
// Bounds: docs/conventions.md 3. A point is the ball of the foot or its ankle.
import { Vector3 } from "./vendor/three.module.js";

const ON = { height: 0.025, speed: 0.2 };
const OFF = { height: 0.04, speed: 0.35 };
const POINTS = { foot: 0.08, toes: 0.02 }; // rest height above the floor, metres

export class Contacts {
  constructor(skeleton) {
    this.points = [];
    for (const side of ["left", "right"]) {
      for (const [part, rest] of Object.entries(POINTS)) {
        const joint = skeleton.index(`${side}_${part}`);
        if (joint >= 0) this.points.push({ side, joint, rest, stands: false, last: null });
      }
    }
  }

  // seconds: since the pose before. Gives which side stands, and where it stands: {left: Vector3 | null, right: ...}
  follow(skeleton, seconds) {
    const standing = { left: null, right: null };
    for (const point of this.points) {
      const place = skeleton.places[point.joint];
      const speed = point.last && seconds > 0 ? place.distanceTo(point.last) / seconds : 0;
      const bound = point.stands ? OFF : ON;
      point.stands = place.y - point.rest < bound.height && speed < bound.speed;
      point.last = (point.last ?? new Vector3()).copy(place);
      if (point.stands) standing[point.side] = point.last;
    }
    return standing;
  }
}
