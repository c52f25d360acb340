// One character: a session with a server through the bridge, what comes of it, and how long that takes.
import { Connection } from "./connection.js";
import { History } from "./history.js";
import { poseOf } from "./pose.js";
import { Rival } from "./rival.js";
import { Series } from "./series.js";

const CHARACTER = 0;
const REFRESH_MS = 250; // what is held is said again this often, so that a lost message does no harm
const KEPT = 300;

export class Session {
  // hear: called with messages for a person: {lost: text} or {problem: text}, with {welcome} when there is one, and with
  // {rival} when there is an opponent.
  // x: where it stands at first, metres.
  constructor(path, x, hear) {
    this.x = x;
    this.hear = hear;
    this.history = new History();
    this.latency = new Series(KEPT); // ms from a key, or a command without one, to the first pose that it changed
    this.gaps = new Series(KEPT); // ms between ticks as they come in
    this.sequence = 0;
    this.sent = new Map(); // sequence -> when its cause was, ms
    this.said = "";
    this.saidAt = 0;
    this.welcome = null;
    this.poses = 0;
    this.rival = null;
    this.rounds = null; // won by the character and by its opponent
    this.connection = new Connection(path, (message) => this.#take(message));
  }

  get isOpen() {
    return this.welcome !== null && !this.lost;
  }

  #take(message) {
    const take = this.#takers[message.type];
    if (take) take(message);
  }

  #takers = {
    welcome: (message) => this.#begin(message),
    pose: (message) => this.#follow(message, performance.now()),
    event: (message) => this.#happen(message),
    stepped: () => this.stepped?.(),
    error: ({ message }) => this.hear({ problem: message }),
    bridge: ({ message }) => this.#lose(message),
  };

  #begin(welcome) {
    this.welcome = welcome;
    this.lost = false;
    this.sequence = Math.max(this.sequence, welcome.sequence);
    this.sent.clear();
    this.said = "";
    this.hear({ welcome });
    for (const [, opponent] of welcome.opponents ?? []) this.#meet(opponent);
    if (!welcome.spawned.includes(CHARACTER)) this.#spawn();
  }

  #happen({ kind, character, opponent }) {
    if (kind === "spawned" && character === CHARACTER && opponent !== undefined) this.#meet(opponent);
    if (kind === "round" && opponent >= 0) this.rounds[character === CHARACTER ? 0 : 1] += 1;
  }

  #meet(number) {
    this.rivalNumber = number;
    this.rounds ??= [0, 0];
    if (this.rival) {
      this.rival.meet(this.welcome);
    } else {
      this.rival = new Rival(this.welcome);
      this.hear({ rival: this.rival });
    }
  }

  // Where it was, so that a server that was started again shows it where it stood.
  #spawn() {
    const last = this.history.newest;
    const [x, , z] = last ? last.root : [this.x, 0, 0];
    this.#say({ type: "spawn", character: CHARACTER, x, z, yaw: last ? last.facing : 0 });
  }

  #lose(message) {
    this.lost = true;
    this.hear({ lost: message });
  }

  #say(message) {
    this.sequence += 1;
    this.connection.send({ ...message, sequence: this.sequence });
    return this.sequence;
  }

  // wish: see wish.js; at: when what caused it happened, ms, undefined where it is only said again.
  ask(wish, at) {
    if (!this.isOpen) return;
    const now = performance.now();
    const said = JSON.stringify(wish);
    if (said === this.said && now - this.saidAt < REFRESH_MS) return;
    const sequence = this.#say({ type: "command", character: CHARACTER, ...wish });
    if (said !== this.said) this.sent.set(sequence, at ?? now);
    this.said = said;
    this.saidAt = now;
  }

  step(ticks) {
    this.connection.send({ type: "step", ticks });
  }

  #follow(message, now) {
    const pose = poseOf(message);
    if (message.character !== CHARACTER) {
      if (message.character === this.rivalNumber) this.rival.add(pose, now);
      return;
    }
    this.poses += 1;
    if (pose.tick !== this.history.newest?.tick) {
      if (this.tickAt) this.gaps.add(now - this.tickAt);
      this.tickAt = now;
    }
    this.history.add(pose, now);
    for (const [sequence, at] of this.sent) {
      if (sequence > pose.acknowledged) break;
      this.sent.delete(sequence);
      this.latency.add(now - at);
    }
  }
}
