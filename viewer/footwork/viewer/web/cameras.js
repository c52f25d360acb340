// Where the camera is and which way the player looks: yaw 0 looks along +z, positive yaw turns left.
import { Vector3 } from "./vendor/three.module.js";

export const KINDS = ["orbit", "follow"];
const NEAR = 1.2;
const FAR = 14;
// Height that is looked at, metres: nearer, it is the feet that one wants to see.
const EYE = { near: 0.25, far: 0.95, distance: 3.2 };
const RADIANS_A_PIXEL = 0.005;
const FOLLOW_SECONDS = 0.7;
const CATCH_UP_SECONDS = 0.08;

export class Camera {
  // orbit: the player turns it. follow: it swings behind the character.
  constructor(camera, canvas) {
    this.camera = camera;
    this.kind = KINDS[0];
    this.yaw = 0;
    this.pitch = 0.24;
    this.distance = 3.6;
    this.target = new Vector3(0, EYE.far, 0);
    this.turned = 0; // when the player last turned it, ms
    canvas.addEventListener("pointermove", (event) => this.#drag(event));
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
  }

  change() {
    this.kind = KINDS[(KINDS.indexOf(this.kind) + 1) % KINDS.length];
  }

  turn(yaw, pitch) {
    this.yaw = wrapped(this.yaw + yaw);
    this.pitch = Math.min(1.45, Math.max(-0.05, this.pitch + pitch));
    this.turned = performance.now();
  }

  #drag({ buttons, movementX, movementY }) {
    if (buttons) this.turn(-RADIANS_A_PIXEL * movementX, RADIANS_A_PIXEL * movementY);
  }

  #wheel(event) {
    event.preventDefault();
    this.distance = Math.min(FAR, Math.max(NEAR, this.distance * Math.exp(0.001 * event.deltaY)));
  }

  get #eye() {
    const share = Math.min(1, (this.distance - NEAR) / (EYE.distance - NEAR));
    return EYE.near + share * (EYE.far - EYE.near);
  }

  // place: of the character; facing: its yaw; seconds: since the last time.
  follow(place, facing, seconds) {
    if (this.kind === "follow" && performance.now() - this.turned > 1000) {
      this.yaw = wrapped(this.yaw + wrapped(facing - this.yaw) * (1 - Math.exp(-seconds / FOLLOW_SECONDS)));
    }
    const share = 1 - Math.exp(-seconds / CATCH_UP_SECONDS);
    const far = Math.hypot(place.x - this.target.x, place.z - this.target.z) > 3;
    this.target.lerp(new Vector3(place.x, this.#eye, place.z), far ? 1 : share);
    const flat = this.distance * Math.cos(this.pitch);
    this.camera.position.set(
      this.target.x - flat * Math.sin(this.yaw),
      Math.max(0.08, this.target.y + this.distance * Math.sin(this.pitch)),
      this.target.z - flat * Math.cos(this.yaw)
    );
    this.camera.lookAt(this.target);
  }
}

export function wrapped(angle) {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
