// One of the characters side by side: its session, its figure on the stage, and its card.
import { Card, put } from "./card.js";
import { Figure } from "./figure.js";
import { Session } from "./session.js";
import { Stepper } from "./stepper.js";

const COLORS = [
  { shirt: 0x5d88a6, trousers: 0x646d78, trail: 0xff9d2e },
  { shirt: 0xa86a5d, trousers: 0x70665e, trail: 0x43b0e8 },
  { shirt: 0x6f9a62, trousers: 0x6b6f5a, trail: 0xd86fd0 },
  { shirt: 0x8a6fb0, trousers: 0x5f6470, trail: 0x7fe08a },
];
const APART = 1.4; // metres between two at the start

export class Player {
  // number: which server of the bridge; hear: called with {lost}, {problem} or {welcome} for people; film: a stand-in
  // for a session, see film.js.
  constructor(stage, cards, title, number, hear, film) {
    this.title = title;
    const colors = COLORS[number % COLORS.length];
    this.figure = new Figure(stage.scene, colors);
    this.card = new Card(cards, title, colors.shirt);
    this.session = film ?? new Session(`/socket/${number}`, -APART * number, (said) => this.#hear(said, hear));
    this.stepper = new Stepper(this.session);
    this.pace = 1;
    this.paused = false;
    if (film) this.#hear(film, hear);
  }

  get welcome() {
    return this.session.welcome;
  }

  #hear(said, hear) {
    if (said.welcome) {
      this.figure.dress(said.welcome);
      put(this.card.title, [this.title, ...said.welcome.attribution].join(" · "));
    }
    hear(said);
  }

  // A world in lock-step goes slowly or stands still itself; of any other one only what is shown does.
  setPace(pace) {
    this.pace = pace;
    if (!this.stepper.isNeeded) this.session.history.setPace(pace);
  }

  pause(paused) {
    this.paused = paused;
    if (!paused || !this.stepper.isNeeded) this.session.history.pause(paused);
  }

  step(frames) {
    this.paused = true;
    const { history } = this.session;
    if (!this.stepper.isNeeded || frames < 0 || history.shown < history.last) {
      history.step(frames);
    } else {
      history.pause(false);
      this.stepper.once();
    }
  }

  // now: ms; seconds: since the last time.
  show(now, seconds) {
    this.stepper.advance(now, this.paused ? 0 : this.pace);
    if (this.welcome) {
      const { history } = this.session;
      this.figure.show(history.advance(seconds, this.welcome.frame_rate), history);
    }
  }

  tell() {
    this.card.root.classList.toggle("absent", !this.figure.isThere);
    if (this.welcome) this.card.show(this.figure, this.session.history, this.welcome);
  }
}
