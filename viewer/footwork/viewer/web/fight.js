// Two who fight: how they fare, who was struck just now, and where one looks at them from.
import { element, put } from "./card.js";

const LIT_MS = 300; // for how long a blow lights the one who was struck
const ASIDE = 0.6; // radians from behind the first: neither hides the other

export class Fight {
  // parent: of the board; players: all there are, two of them where there is a fight.
  constructor(parent, players) {
    this.board = parent;
    this.players = players;
    this.sides = [0, 1].map((number) => new Side(parent, number));
    this.rounds = element("span", "rounds", parent);
  }

  // Whether two fight; of more than two nobody could tell who fights whom.
  get isOn() {
    return this.players.length === 2 && this.players.every(({ figure }) => figure.shown?.health !== undefined);
  }

  // Yaw from the first to the other.
  get bearing() {
    const [own, other] = this.players.map(({ figure }) => figure.place);
    return Math.atan2(other.x - own.x, other.z - own.z);
  }

  get view() {
    return this.bearing + ASIDE;
  }

  get middle() {
    const [own, other] = this.players.map(({ figure }) => figure.place);
    return own.clone().add(other).multiplyScalar(0.5);
  }

  // What is seen, every frame.
  light(now) {
    for (const [number, { figure }] of this.players.entries()) {
      this.sides[number]?.follow(figure, now);
    }
  }

  // What is told beside the picture.
  tell() {
    this.board.hidden = !this.isOn;
    if (!this.isOn) return;
    const { rounds } = this.players[0].session; // of a session, not of a film
    const titles = rounds ? ["you", this.players[1].title] : this.players.map(({ title }) => title);
    this.players.forEach(({ figure }, number) => this.sides[number].show(titles[number], figure.shown));
    put(this.rounds, rounds ? `${rounds[0]} : ${rounds[1]}` : "");
  }
}

class Side {
  constructor(parent, number) {
    this.root = element("div", number ? "side right" : "side", parent);
    this.name = element("span", "", this.root);
    this.health = element("meter", "", this.root);
    this.stamina = element("meter", "stamina", this.root);
    Object.assign(this.health, { low: 0.3, high: 0.6, optimum: 1 });
    this.struck = -Infinity;
  }

  // A blow is told by health that falls, so that one which is looked back at is seen too.
  follow(figure, now) {
    const health = figure.shown?.health;
    if (health < this.was) this.struck = now;
    this.was = health;
    figure.body?.flash(Math.max(0, 1 - (now - this.struck) / LIT_MS));
    this.root.classList.toggle("struck", now - this.struck < LIT_MS);
  }

  show(title, { health, stamina }) {
    put(this.name, title);
    this.health.value = health;
    this.stamina.hidden = stamina === undefined;
    this.stamina.value = stamina ?? 1;
  }
}
