// The bar at the bottom: pause, step, pace, the last minute, and recorded keys.
import { parseTrace, TracePlayer, TraceRecorder } from "./trace.js";
import { put } from "./card.js";

const at = (id) => document.getElementById(id);

export class Transport {
  // players: all characters; yaw: gives the view's; complain: tells a person.
  constructor(players, yaw, complain) {
    Object.assign(this, { players, yaw, complain, recorder: null, replay: null, paused: false });
    at("pause").onclick = () => this.pause();
    at("back").onclick = () => this.step(-1);
    at("forth").onclick = () => this.step(1);
    at("pace").onchange = (event) => this.#each((player) => player.setPace(Number(event.target.value)));
    at("when").oninput = (event) => this.#each((player) => player.session.history.seek(Number(event.target.value)));
    at("record").onclick = () => this.#record();
    at("load").onchange = (event) => this.#load(event.target);
    at("end").onclick = () => (this.replay = null);
    at("place").oninput = (event) => (this.replay.seconds = event.target.value * this.replay.length);
  }

  #each(change) {
    this.players.forEach(change);
    document.activeElement?.blur(); // so that keys go to the character again
  }

  pause(paused = !this.paused) {
    this.paused = paused;
    this.#each((player) => player.pause(paused));
  }

  step(frames) {
    this.paused = true;
    this.#each((player) => player.step(frames));
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
      if (file) this.replay = new TracePlayer(parseTrace(await file.text()), this.yaw());
    } catch (error) {
      this.complain(`${file.name}: ${error.message}`);
    }
  }

  show() {
    if (this.replay?.isOver) this.replay = null;
    put(at("pause"), this.paused ? "Go on" : "Pause");
    at("pause").classList.toggle("on", this.paused);
    put(at("record"), this.recorder ? `Save ${this.recorder.seconds.toFixed(0)} s of keys` : "Record keys");
    at("record").classList.toggle("on", this.recorder !== null);
    at("replaying").hidden = this.replay === null;
    this.#showPlace(this.players[0].session.history);
    if (this.replay) this.#showReplay();
  }

  #showPlace(history) {
    if (document.activeElement !== at("when")) at("when").value = history.share;
    put(at("ago"), history.told);
  }

  #showReplay() {
    if (document.activeElement !== at("place")) at("place").value = this.replay.seconds / this.replay.length;
    put(at("second"), `${this.replay.seconds.toFixed(1)} of ${this.replay.length.toFixed(0)} s`);
  }
}

function download(text, name) {
  const address = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
  Object.assign(document.createElement("a"), { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
