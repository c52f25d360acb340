// Draws less finely where the machine cannot keep up.
const SHARES = [1, 0.75, 0.5, 0.35];
const SLOW_MS = 30;
const FRAMES = 40; // that are looked at before anything changes

export class Quality {
  constructor(stage) {
    this.stage = stage;
    this.level = stage.software ? 2 : 0;
    this.frames = [];
    stage.detail(SHARES[this.level]);
  }

  note(milliseconds) {
    this.frames.push(milliseconds);
    if (this.frames.length < FRAMES) return;
    const middle = this.frames.sort((a, b) => a - b)[FRAMES / 2];
    this.frames = [];
    if (middle > SLOW_MS && this.level < SHARES.length - 1) this.stage.detail(SHARES[++this.level]);
  }
}
