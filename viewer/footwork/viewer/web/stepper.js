// Asks a server in lock-step for its ticks, at the pace that the player chose: there the world itself can stand still.
export class Stepper {
  constructor(session) {
    this.session = session;
    this.due = 0;
    this.asked = false;
    session.stepped = () => (this.asked = false);
  }

  get isNeeded() {
    return Boolean(this.session.welcome?.lockstep);
  }

  // now: ms; pace: share of real time, 0 while paused.
  advance(now, pace) {
    if (!this.isNeeded || pace === 0) return;
    const every = 1000 / this.session.welcome.tick_rate / pace;
    if (now < this.due || !this.#ask(now)) return;
    this.due = Math.max(this.due + every, now - every);
  }

  // One tick, now.
  once() {
    if (this.isNeeded) this.#ask(performance.now());
  }

  // Whether it asked: a server answers one step at a time. One that is away for a second is asked anew.
  #ask(now) {
    if (this.asked && now - this.askedAt < 1000) return false;
    this.asked = true;
    this.askedAt = now;
    this.session.step(1);
    return true;
  }
}
