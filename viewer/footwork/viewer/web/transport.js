// The bar at the bottom: pause, step, pace, the last minute, and recorded keys.
import { parseTrace, TracePlayer, TraceRecorder } from "./trace.js";
import { put } from "./card.js";

const at = (id) => document.getElementById(id);

export class Transport {
  // histories: gives those of all characters; yaw: gives the view's; complain: tells a person.
  constructor(histories, yaw, complain) {
    Object.assign(this, { histories, yaw, complain, recorder: null, player: null, paused: false });
    at("pause").onclick = () => this.pause();
    at("back").onclick = () => this.step(-1);
    at("forth").onclick = () => this.step(1);
    at("pace").onchange = (event) => this.#each((history) => history.setPace(Number(event.target.value)));
    at("when").oninput = (event) => this.#each((history) => history.seek(Number(event.target.value)));
    at("record").onclick = () => this.#record();
    at("load").onchange = (event) => this.#load(event.target);
    at("end").onclick = () => (this.player = null);
    at("place").oninput = (event) => (this.player.seconds = event.target.value * this.player.length);
  }

  #each(change) {
    this.histories().forEach(change);
    document.activeElement?.blur(); // so that keys go to the character again
  }

  get pace() {
    return Number(at("pace").value);
  }

  pause(paused = !this.paused) {
    this.paused = paused;
    this.#each((history) => history.pause(paused));
  }

  step(frames) {
    this.paused = true;
    this.#each((history) => history.step(frames));
  }

  #record() {
    if (!this.recorder) {
      this.recorder = new TraceRecorder(this.yaw(), performance.now());
      return;
    }
    download(this.recorder.csv, "trace.csv");
    this.recorder = null;
  }

  async #load(input) {
    const [file] = input.files;
    input.value = "";
    try {
      if (file) this.player = new TracePlayer(parseTrace(await file.text()), this.yaw());
    } catch (error) {
      this.complain(`${file.name}: ${error.message}`);
    }
  }

  show() {
    const [history] = this.histories();
    if (this.player?.isOver) this.player = null;
    put(at("pause"), this.paused ? "Go on" : "Pause");
    at("pause").classList.toggle("on", this.paused);
    put(at("record"), this.recorder ? `Save ${this.recorder.seconds.toFixed(0)} s of keys` : "Record keys");
    at("record").classList.toggle("on", this.recorder !== null);
    at("replaying").hidden = this.player === null;
    if (history) this.#showPlace(history);
    if (this.player) this.#showReplay();
  }

  #showPlace(history) {
    if (document.activeElement !== at("when")) at("when").value = history.share;
    put(at("ago"), history.live ? "live" : `−${history.behind.toFixed(2)} s`);
  }

  #showReplay() {
    if (document.activeElement !== at("place")) at("place").value = this.player.seconds / this.player.length;
    put(at("second"), `${this.player.seconds.toFixed(1)} of ${this.player.length.toFixed(0)} s`);
  }
}

function download(text, name) {
  const address = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
  Object.assign(document.createElement("a"), { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
