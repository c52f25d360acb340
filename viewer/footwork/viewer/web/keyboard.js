// Held keys as the protocol has them, and keys that do something once.
const FORWARD = { KeyW: 1, ArrowUp: 1, KeyS: -1, ArrowDown: -1 };
const STRAFE = { KeyD: 1, ArrowRight: 1, KeyA: -1, ArrowLeft: -1 };

export class Keyboard {
  // once: what to do when a key goes down, by its code; changed: called with the event's time when what is held changes.
  constructor(once, changed) {
    this.held = new Set();
    this.once = once;
    this.changed = changed;
    addEventListener("keydown", (event) => this.#down(event));
    addEventListener("keyup", (event) => this.#up(event));
    addEventListener("blur", (event) => this.#letGo(event)); // the key's going up is not told any more
  }

  #down(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || /INPUT|SELECT/.test(event.target.tagName)) return;
    if (event.code === "Space" || event.code.startsWith("Arrow")) event.preventDefault();
    if (event.repeat) return;
    this.once[event.code]?.();
    this.held.add(event.code);
    this.changed(event.timeStamp);
  }

  #up(event) {
    if (this.held.delete(event.code)) this.changed(event.timeStamp);
  }

  #letGo(event) {
    this.held.clear();
    this.changed(event.timeStamp);
  }

  get keys() {
    return {
      forward: this.#sum(FORWARD),
      strafe: this.#sum(STRAFE),
      run: this.held.has("ShiftLeft") || this.held.has("ShiftRight"),
      jump: this.held.has("Space"),
    };
  }

  // Whether any of some keys is held, by their codes.
  holds(...codes) {
    return codes.some((code) => this.held.has(code));
  }

  // The number of the digit that is held, 0 for none.
  get digit() {
    const code = [...this.held].find((one) => /^Digit[1-9]$/.test(one));
    return code ? Number(code.at(-1)) : 0;
  }

  #sum(signs) {
    const total = Object.entries(signs).reduce((sum, [code, sign]) => sum + (this.held.has(code) ? sign : 0), 0);
    return Math.sign(total);
  }
}
