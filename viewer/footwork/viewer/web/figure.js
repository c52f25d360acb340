// One character on the stage: its body, what its feet do, its trail, and what is told of it.
import { Vector3 } from "./vendor/three.module.js";
import { Body } from "./body.js";
import { Contacts } from "./contacts.js";
import { Footprints } from "./footprints.js";
import { Skeleton } from "./skeleton.js";
import { Trail } from "./trail.js";

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

  show(pose) {
    if (!this.body || !pose || pose === this.shown) return;
    this.skeleton.pose(pose);
    this.body.show(this.skeleton);
    const frames = this.shown ? this.#frame(pose) - this.#frame(this.shown) : 0;
    if (frames !== 0 || !this.shown) this.#move(pose, frames * this.frameSeconds);
    this.shown = pose;
  }

  #frame(pose) {
    return pose.tick * this.framesPerTick + pose.frame;
  }

  #move(pose, seconds) {
    const [x, y, z] = pose.root;
    if (seconds > 0) this.speed += 0.15 * (Math.hypot(x - this.place.x, z - this.place.z) / seconds - this.speed);
    this.place.set(x, y, z);
    this.facing = pose.facing;
    this.standing = this.contacts.follow(this.skeleton, Math.abs(seconds));
    this.body.light(this.standing);
    if (seconds < 0) return; // looking back leaves no traces
    this.prints.follow(this.standing);
    this.trail.follow(this.place, seconds);
  }
}
