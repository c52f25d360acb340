// A film: characters whose poses are all known, in place of sessions with a server.
import { History } from "./history.js";
import { Series } from "./series.js";

const { decode } = globalThis.MessagePack;

// One stand-in for a session a character of the film.
export async function filmed(address) {
  const film = decode(new Uint8Array(await (await fetch(address)).arrayBuffer()));
  return film.fighters.map((fighter) => new Filmed(film, fighter));
}

class Filmed {
  constructor({ welcome, ticks }, fighter) {
    this.title = fighter.title;
    this.welcome = welcome;
    this.history = new History(Infinity);
    this.history.live = false;
    this.latency = new Series(1);
    this.gaps = new Series(1);
    const columns = columnsOf(fighter);
    for (let tick = 0; tick < ticks; tick++) this.history.add(poseAt(columns, tick), (1000 * tick) / welcome.tick_rate);
    this.poses = ticks;
  }

  ask() {} // who is filmed does what it did
}

function columnsOf({ poses, health, behaviour, transition, clip, frame }) {
  return {
    poses: new Float32Array(poses.slice().buffer),
    health: new Float32Array(health.slice().buffer),
    clip: new Int32Array(clip.slice().buffer),
    frame: new Int32Array(frame.slice().buffer),
    behaviour,
    transition,
  };
}

function poseAt({ poses, health, behaviour, transition, clip, frame }, tick) {
  const size = poses.length / health.length;
  const values = poses.subarray(size * tick, size * (tick + 1));
  const rotations = values.subarray(3);
  return {
    tick,
    frame: 1,
    facing: yawOf(rotations),
    behaviour: behaviour[tick],
    clip: clip[tick],
    sourceFrame: frame[tick],
    transition: transition[tick] === 1,
    health: health[tick],
    root: values.subarray(0, 3),
    rotations,
  };
}

// The yaw of joint 0's z axis: what a camera may follow.
function yawOf([x, y, z, w]) {
  return Math.atan2(2 * (x * z + w * y), 1 - 2 * (x * x + y * y));
}
