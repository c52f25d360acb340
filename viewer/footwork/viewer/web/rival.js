// The opponent of a session's character: in place of a session, as nobody steers it from here.
import { History } from "./history.js";
import { Series } from "./series.js";

export class Rival {
  // welcome: of the session that it came with.
  constructor(welcome) {
    this.history = new History();
    this.latency = new Series(1);
    this.gaps = new Series(1);
    this.poses = 0;
    this.meet(welcome);
  }

  meet(welcome) {
    this.title = `${welcome.opponent} opponent`;
    this.welcome = { ...welcome, lockstep: false, attribution: [] }; // whose ticks the session asks for
  }

  add(pose, now) {
    this.poses += 1;
    this.history.add(pose, now);
  }

  ask() {} // it decides for itself
}
