// The first gamepad: left stick travels, right stick turns the view, A jumps or strikes, B evades, shoulder or trigger
// runs.
const DEAD = 0.18;
const TURN = 2.6; // radians a second of the right stick
const RUN = [4, 5, 6, 7];

export function gamepad() {
  const pad = navigator.getGamepads?.().find((one) => one?.connected);
  if (!pad) return null;
  const [x, y, turn, tilt] = pad.axes.map((axis) => (Math.abs(axis) < DEAD ? 0 : axis));
  return {
    x: x ?? 0,
    y: -(y ?? 0),
    push: Math.min(1, Math.hypot(x ?? 0, y ?? 0)),
    turn: -(turn ?? 0) * TURN,
    tilt: (tilt ?? 0) * TURN,
    run: RUN.some((button) => pad.buttons[button]?.pressed),
    jump: Boolean(pad.buttons[0]?.pressed),
    evade: Boolean(pad.buttons[1]?.pressed),
  };
}
