// What the player wishes: either held keys, or a heading and a behaviour outright, as in a command.
const KEYED = ["stop", "walk", "run", "jump"];

// Behaviours that keys 1 to 9 ask for.
export function states(welcome) {
  return welcome.behaviours.filter((behaviour) => !KEYED.includes(behaviour)).slice(0, 9);
}

export function wishOf(welcome, yaw, keyboard, pad) {
  const state = states(welcome)[keyboard.digit - 1];
  if (state) return outright(heading(yaw, keyboard.keys), state);
  if (pad && (pad.push > 0 || pad.jump)) return ofPad(welcome, yaw, pad);
  return { keys: { view_yaw: yaw, ...keyboard.keys } };
}

// The wish of one who fights; yaw: where the opponent is.
export function fightWish(welcome, yaw, keyboard, pad) {
  const keys = { ...keyboard.keys, jump: false };
  if (keyboard.holds("KeyJ", "Space") || pad?.jump) return outright(heading(yaw, keys), "attack");
  if (keyboard.holds("KeyK") || pad?.evade) return outright(heading(yaw, keys), "evade");
  const [footwork] = welcome.behaviours;
  if (pad?.push > 0) return outright(yaw + Math.atan2(-pad.x, pad.y), footwork, pad.push);
  return { keys: { view_yaw: yaw, ...keys } };
}

function ofPad(welcome, yaw, pad) {
  const travel = yaw + Math.atan2(-pad.x, pad.y);
  if (pad.jump) return outright(travel, "jump");
  const behaviour = pad.run && welcome.behaviours.includes("run") ? "run" : "walk";
  const [slow, fast] = welcome.speeds[behaviour] ?? [];
  return outright(travel, behaviour, slow === undefined ? null : slow + (fast - slow) * pad.push);
}

function outright(angle, behaviour, speed = null) {
  return { heading: angle, behaviour, speed };
}

// The direction of travel that keys ask for, radians.
export function heading(yaw, { forward, strafe }) {
  return forward || strafe ? yaw + Math.atan2(-strafe, forward) : yaw;
}
