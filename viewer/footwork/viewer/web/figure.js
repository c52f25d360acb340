// One character on the stage: its body, what its feet do, its trail, and what is told of it.
import { Vector3 } from "./vendor/three.module.js";
import { Body } from "./body.js";
import { Contacts } from "./contacts.js";
import { Footprints } from "./footprints.js";
import { Skeleton } from "./skeleton.js";
import { Trail } from "./trail.js";

const JUMP_SECONDS = 0.5; // from one shown pose to the next: more than that was not watched
const TRACED_SECONDS = 10;

export class Figure {
  constructor(scene, colors) {
    this.scene = scene;
    this.colors = colors;
    this.trail = new Trail(colors.trail);
    this.prints = new Footprints();
    this.place = new Vector3();
    this.facing = 0;
    this.speed = 0;
    this.standing = { left: null, right: null };
    scene.add(this.trail.mesh, this.prints.group);
  }

  // Once there is a welcome, and again where the body is another one.
  dress(welcome) {
    this.body?.dispose();
    this.skeleton = new Skeleton(welcome);
    this.contacts = new Contacts(this.skeleton);
    this.body = new Body(this.skeleton, this.colors);
    this.scene.add(this.body.group);
    this.frameSeconds = 1 / welcome.frame_rate;
    this.framesPerTick = welcome.frame_rate / welcome.tick_rate;
    this.shown = null;
  }

  get isThere() {
    return Boolean(this.shown) && !this.shown.absent;
  }

  // history: what was before the pose, for the traces of what one did not watch.
  show(pose, history) {
    if (!this.body || !pose || pose === this.shown) return;
    for (const part of [this.body.group, this.trail.mesh, this.prints.group]) part.visible = !pose.absent;
    if (!pose.absent) this.#pose(pose, history);
    this.shown = pose;
  }

  #pose(pose, history) {
    const seconds = this.isThere ? this.#between(this.shown, pose) : NaN;
    if (seconds === 0) this.skeleton.pose(pose); // between two poses
    else if (seconds > 0 && seconds < JUMP_SECONDS) this.#move(pose, seconds);
    else this.#arrive(pose, history);
    this.body.show(this.skeleton);
    this.body.light(this.standing);
    this.trail.draw();
  }

  // Seconds from one pose to another.
  #between(from, to) {
    const frames = this.framesPerTick * (to.tick - from.tick) + to.frame - from.frame;
    return frames * this.frameSeconds;
  }

  // Another time than the next is shown: feet, trail and prints come from what was just before it.
  #arrive(pose, history) {
    this.prints.clear();
    this.trail.clear();
    this.contacts = new Contacts(this.skeleton);
    this.place.fromArray(pose.root);
    const past = history.before(Math.round(TRACED_SECONDS / this.frameSeconds));
    const led = past.filter((one) => !one.absent && this.#between(one, pose) > 0);
    [...led, pose].forEach((one, k) => this.#move(one, k > 0 ? this.#between(led[k - 1], one) : 0));
  }

  #move(pose, seconds) {
    this.skeleton.pose(pose);
    const [x, y, z] = pose.root;
    if (seconds > 0) this.speed += 0.15 * (Math.hypot(x - this.place.x, z - this.place.z) / seconds - this.speed);
    this.place.set(x, y, z);
    this.facing = pose.facing;
    this.standing = this.contacts.follow(this.skeleton, seconds);
    this.prints.follow(this.standing);
    this.trail.follow(this.place, seconds);
  }
}
