// Which solids stand for which joint of a body. Joints of unknown names get capsules, so that any skeleton shows.
import { Vector3 } from "./vendor/three.module.js";
import { ellipsoid, roundCone, rounded } from "./solids.js";

const ORIGIN = new Vector3();
const SOLE = 0.02; // of the ball of the foot above the floor, metres
const SHOE = 0.092; // width
const HEEL = 0.065; // behind the ankle

// [radius at the joint, radius at its child], metres
const RADII = {
  neck: [0.055, 0.05],
  upper_arm: [0.054, 0.042],
  forearm: [0.0395, 0.03],
  thigh: [0.086, 0.06],
  shank: [0.058, 0.04],
};
const OTHER = [0.045, 0.04];

// Solids of one joint, in its frame.
export function limb(skeleton, joint) {
  const name = skeleton.names[joint];
  const make = SHAPES[kind(name)];
  return make ? make(skeleton, joint) : capsules(skeleton, joint, RADII[kind(name)] ?? OTHER);
}

function kind(name) {
  return name.replace(/^(left|right)_/, "");
}

function capsules(skeleton, joint, [near, far]) {
  const ends = skeleton.children(joint).map((child) => skeleton.offsets[child]);
  if (skeleton.ends[joint].length() > 0) ends.push(skeleton.ends[joint]);
  return ends.map((end) => roundCone(ORIGIN, end, near, far));
}

const SHAPES = {
  hips: (skeleton) => {
    const sockets = ["left_thigh", "right_thigh"].map((name) => offset(skeleton, name));
    const belt = roundCone(sockets[0], sockets[1], 0.093, 0.093).scale(1, 1, 0.95);
    return [belt, roundCone(ORIGIN, offset(skeleton, "spine"), 0.122, 0.108).scale(1.12, 1, 0.86)];
  },
  spine: (skeleton) => [roundCone(ORIGIN, offset(skeleton, "chest"), 0.118, 0.13).scale(1.12, 1, 0.84)],
  chest: (skeleton) => {
    const top = offset(skeleton, "neck");
    const ribs = ellipsoid(top.clone().multiplyScalar(0.42), 0.172, 0.168, 0.118);
    const shoulders = ["left_clavicle", "right_clavicle"].map((name) =>
      roundCone(top.clone().multiplyScalar(0.72), offset(skeleton, name).setY(top.y * 0.74), 0.09, 0.085)
    );
    return [ribs, ...shoulders, roundCone(top.clone().multiplyScalar(0.8), top, 0.075, 0.055)];
  },
  clavicle: (skeleton, joint) => {
    const [child] = skeleton.children(joint).map((other) => skeleton.offsets[other]);
    return [roundCone(ORIGIN, child, 0.068, 0.06)];
  },
  head: (skeleton, joint) => {
    const top = skeleton.ends[joint];
    const middle = top.clone().multiplyScalar(0.52);
    return [
      ellipsoid(middle, 0.078, 0.118, 0.096),
      ellipsoid(middle.clone().add(new Vector3(0, -0.03, 0.088)), 0.014, 0.022, 0.022),
    ];
  },
  hand: (skeleton, joint) => {
    const tip = skeleton.ends[joint];
    return [roundCone(ORIGIN, tip.clone().multiplyScalar(0.75), 0.034, 0.026).scale(1, 0.72, 1.15)];
  },
  foot: (skeleton, joint) => {
    const ball = skeleton.offsets[skeleton.children(joint)[0]];
    return [shoe(ball), roundCone(ORIGIN, new Vector3(0, 0.05, 0), 0.047, 0.043)];
  },
  toes: (skeleton, joint) => [toecap(skeleton.ends[joint].z)],
};

function offset(skeleton, name) {
  const joint = skeleton.index(name);
  return joint < 0 ? ORIGIN.clone() : skeleton.offsets[joint].clone();
}

// From the heel to the ball, its sole where the floor is when the foot stands flat.
function shoe(ball) {
  const floor = ball.y - SOLE;
  const outline = [
    [-HEEL, floor],
    [ball.z, floor],
    [ball.z + 0.012, floor + 0.052],
    [ball.z * 0.55, floor + 0.088],
    [0.035, 0.035],
    [-HEEL + 0.012, 0.035],
    [-HEEL - 0.004, floor + 0.05],
  ];
  return rounded(outline, SHOE, 0.014);
}

function toecap(length) {
  const outline = [
    [-0.02, -SOLE],
    [length, -SOLE],
    [length + 0.012, -SOLE + 0.018],
    [length * 0.75, -SOLE + 0.038],
    [-0.02, -SOLE + 0.054],
  ];
  return rounded(outline, SHOE - 0.002, 0.013);
}
