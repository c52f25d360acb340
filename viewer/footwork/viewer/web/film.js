// A film: characters whose poses are all known, in place of sessions with a server.
import { History } from "./history.js";
import { Series } from "./series.js";

const { decode } = globalThis.MessagePack;

// One stand-in for a session a character of the film.
export async function filmed(address) {
  const film = decode(new Uint8Array(await (await fetch(address)).arrayBuffer()));
  return film.roles.map((role) => new Filmed(film, role));
}

class Filmed {
  constructor({ welcome, first_tick: firstTick, frames }, role) {
    this.title = role.title;
    this.welcome = welcome;
    this.history = new History(Infinity);
    this.history.live = false;
    this.latency = new Series(1);
    this.gaps = new Series(1);
    const columns = columnsOf(role);
    const framesPerTick = welcome.frame_rate / welcome.tick_rate;
    for (let frame = 0; frame < frames; frame++) {
      const when = { tick: firstTick + Math.floor(frame / framesPerTick), frame: (frame % framesPerTick) + 1 };
      const pose = { ...when, ...poseAt(columns, frame - role.first) };
      this.history.add(pose, (1000 * frame) / welcome.frame_rate);
    }
    this.poses = frames;
  }

  ask() {} // who is filmed does what it did
}

function columnsOf({ poses, health, behaviour, transition, clip, frame }) {
  return {
    poses: new Float32Array(poses.slice().buffer),
    health: health && new Float32Array(health.slice().buffer),
    behaviour: new Int16Array(behaviour.slice().buffer),
    clip: new Int32Array(clip.slice().buffer),
    frame: new Int32Array(frame.slice().buffer),
    transition,
  };
}

// frame: of the character; before its first and after its last it is absent.
function poseAt({ poses, health, behaviour, transition, clip, frame: frames }, frame) {
  if (frame < 0 || frame >= frames.length) return { absent: true, behaviour: -1, transition: false };
  const size = poses.length / frames.length;
  const values = poses.subarray(size * frame, size * (frame + 1));
  const rotations = values.subarray(3);
  return {
    facing: yawOf(rotations),
    behaviour: behaviour[frame],
    clip: clip[frame],
    sourceFrame: frames[frame],
    transition: transition[frame] === 1,
    health: health?.[frame],
    root: values.subarray(0, 3),
    rotations,
  };
}

// The yaw of joint 0's z axis: what a camera may follow.
function yawOf([x, y, z, w]) {
  return Math.atan2(2 * (x * z + w * y), 1 - 2 * (x * x + y * y));
}
