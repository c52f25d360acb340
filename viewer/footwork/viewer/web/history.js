// The poses of the last minute, or all those of a film, and which of them is shown: the newest, or one before.
import { between } from "./pose.js";

const SECONDS = 60;

export class History {
  constructor(seconds = SECONDS) {
    this.seconds = seconds;
    this.goesOn = seconds < Infinity; // there will be more, and one may want to see the newest
    this.poses = [];
    this.shown = 0; // index, a fraction while it is shown slowly
    this.live = true;
    this.pace = 1;
    this.paused = false;
  }

  add(pose, now) {
    pose.at = now;
    this.poses.push(pose);
    while (now - this.poses[0].at > 1000 * this.seconds) {
      this.poses.shift();
      this.shown = Math.max(0, this.shown - 1);
    }
  }

  get newest() {
    return this.poses.at(-1);
  }

  get last() {
    return this.poses.length - 1;
  }

  // The pose to show after so many seconds more, undefined while there is none.
  advance(seconds, frameRate) {
    if (!this.live && !this.paused) this.#play(seconds * this.pace * frameRate);
    if (this.live) this.shown = this.last;
    const before = Math.floor(this.shown);
    const share = this.shown - before;
    return share > 0 ? between(this.poses[before], this.poses[before + 1], share) : this.poses[before];
  }

  // The poses before the shown one, so many at most, oldest first.
  before(most) {
    const shown = Math.floor(this.shown);
    return this.poses.slice(Math.max(0, shown - most), shown);
  }

  #play(frames) {
    if (this.shown >= this.last && !this.goesOn) this.shown = -frames; // a film begins anew
    this.shown = Math.min(this.last, this.shown + frames);
    this.live = this.pace >= 1 && this.shown >= this.last && this.goesOn;
  }

  pause(paused) {
    this.paused = paused;
    this.live = this.live && !paused;
    if (!paused && this.pace >= 1) this.live = this.goesOn;
  }

  setPace(pace) {
    this.pace = pace;
    this.live = pace >= 1 && !this.paused && this.goesOn;
  }

  // Frames forth or back from where it is.
  step(frames) {
    this.pause(true);
    this.shown = Math.min(this.last, Math.max(0, Math.floor(this.shown) + frames));
  }

  // share: 0 the oldest, 1 the newest.
  seek(share) {
    this.live = share >= 1 && !this.paused && this.pace >= 1 && this.goesOn;
    this.shown = Math.max(0, share * this.last);
  }

  get share() {
    return this.last > 0 ? this.shown / this.last : 1;
  }

  // Where in time the shown pose is: seconds of a film, or before the newest.
  get told() {
    const shown = this.poses[Math.floor(this.shown)];
    if (this.live || !shown) return "live";
    if (!this.goesOn) return `${seconds(shown)} of ${seconds(this.newest)} s`;
    return `−${((this.newest.at - shown.at) / 1000).toFixed(2)} s`;
  }
}

function seconds({ at }) {
  return (at / 1000).toFixed(2);
}
