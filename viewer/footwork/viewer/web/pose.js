// What a pose message holds, as numbers.

// The bytes lie at any offset of the message, and a Float32Array must be aligned: they are copied.
function floats(bytes) {
  return new Float32Array(bytes.slice().buffer);
}

export function poseOf(message) {
  return {
    tick: message.tick,
    frame: message.frame,
    acknowledged: message.acknowledged,
    facing: message.facing,
    behaviour: message.behaviour,
    clip: message.clip,
    sourceFrame: message.source_frame,
    transition: message.transition,
    health: message.health,
    stamina: message.stamina,
    root: floats(message.root),
    rotations: floats(message.rotations),
  };
}

// A pose part of the way from one to the next; what is no number is the former's.
export function between(former, next, share) {
  if (former.absent || next.absent) return former;
  const root = former.root.map((value, k) => value + share * (next.root[k] - value));
  return { ...former, root, rotations: blended(former.rotations, next.rotations, share) };
}

// Normalised sums of quaternions, each pair on the same side: frames are near enough for that.
function blended(from, to, share) {
  const mixed = new Float32Array(from.length);
  for (let at = 0; at < from.length; at += 4) {
    const side = Math.sign(dot(from, to, at)) || 1;
    for (let k = at; k < at + 4; k++) mixed[k] = (1 - share) * from[k] + share * side * to[k];
    const length = Math.sqrt(dot(mixed, mixed, at));
    for (let k = at; k < at + 4; k++) mixed[k] /= length;
  }
  return mixed;
}

function dot(a, b, at) {
  return a[at] * b[at] + a[at + 1] * b[at + 1] + a[at + 2] * b[at + 2] + a[at + 3] * b[at + 3];
}
