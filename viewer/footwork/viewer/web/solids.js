// The solids that a body is made of, in a joint's own frame.
import {
  ExtrudeGeometry,
  LatheGeometry,
  Quaternion,
  Shape,
  SphereGeometry,
  Vector2,
  Vector3,
} from "./vendor/three.module.js";
import { DRAWS_IN_SOFTWARE } from "./drawing_power.js";

const UP = new Vector3(0, 1, 0);
const ROUND = DRAWS_IN_SOFTWARE ? 9 : 18; // sides
const ARC = DRAWS_IN_SOFTWARE ? 2 : 5; // steps of a rounded end

// A capsule from one point to another whose ends have radii of their own.
export function roundCone(from, to, fromRadius, toRadius) {
  const along = to.clone().sub(from);
  const length = along.length();
  const tilt = Math.asin(Math.max(-1, Math.min(1, (fromRadius - toRadius) / Math.max(length, 1e-6))));
  const profile = [];
  for (let k = 0; k <= ARC; k++) profile.push(onArc(-Math.PI / 2 + ((tilt + Math.PI / 2) * k) / ARC, fromRadius, 0));
  for (let k = 0; k <= ARC; k++) profile.push(onArc(tilt + ((Math.PI / 2 - tilt) * k) / ARC, toRadius, length));
  const solid = new LatheGeometry(profile, ROUND);
  if (length > 1e-6) solid.applyQuaternion(new Quaternion().setFromUnitVectors(UP, along.divideScalar(length)));
  return solid.translate(from.x, from.y, from.z);
}

function onArc(angle, radius, height) {
  return new Vector2(Math.max(0, radius * Math.cos(angle)), height + radius * Math.sin(angle));
}

export function ellipsoid(centre, x, y, z) {
  return new SphereGeometry(1, ROUND, 2 * ARC + 2).scale(x, y, z).translate(centre.x, centre.y, centre.z);
}

// A side view, points [z, y] in order, as wide as told, its edges rounded.
export function rounded(outline, width, bevel) {
  const shape = new Shape(outline.map(([z, y]) => new Vector2(-z, y)));
  const options = { depth: width - 2 * bevel, bevelSize: bevel, bevelThickness: bevel, bevelSegments: 2, steps: 1 };
  return new ExtrudeGeometry(shape, { ...options, bevelOffset: -bevel, curveSegments: 4 })
    .translate(0, 0, bevel - width / 2)
    .rotateY(Math.PI / 2);
}

