// Draws less finely, and less often, where the machine cannot keep up: keys and poses go first.
const SHARES = [1, 0.75, 0.5, 0.35];
const SLOW_MS = 30;
const FRAMES = 40; // that are looked at before anything changes
const SOFTWARE_MS = 60; // between pictures that the machine's own processor draws

export class Quality {
  constructor(stage) {
    this.stage = stage;
    this.level = stage.software ? 2 : 0;
    this.aim = stage.software ? SOFTWARE_MS + 1000 / 60 : 1000 / 60; // ms from picture to picture
    this.frames = [];
    this.drawn = -Infinity;
    stage.detail(SHARES[this.level]);
  }

  // Whether it is time for another picture.
  allows(now) {
    const due = !this.stage.software || now - this.drawn > SOFTWARE_MS;
    if (due) this.#note(now - this.drawn);
    if (due) this.drawn = now;
    return due;
  }

  #note(milliseconds) {
    this.frames.push(milliseconds);
    if (this.frames.length < FRAMES) return;
    const middle = this.frames.sort((a, b) => a - b)[FRAMES / 2];
    this.frames = [];
    const slow = this.stage.software ? SOFTWARE_MS + SLOW_MS : SLOW_MS;
    if (middle > slow && this.level < SHARES.length - 1) this.stage.detail(SHARES[++this.level]);
  }
}
