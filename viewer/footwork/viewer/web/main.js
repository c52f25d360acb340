// The live view: sessions, what the player asks of them, and what is drawn.
import { Camera } from "./cameras.js";
import { Card, put } from "./card.js";
import { Figure } from "./figure.js";
import { gamepad } from "./gamepad.js";
import { Graph } from "./graphs.js";
import { Keyboard } from "./keyboard.js";
import { Quality } from "./quality.js";
import { Series } from "./series.js";
import { Session } from "./session.js";
import { Stage } from "./stage.js";
import { Transport } from "./transport.js";
import { states, wishOf } from "./wish.js";

const COLORS = { shirt: 0x5d88a6, trousers: 0x646d78, trail: 0xff9d2e };
const ERROR_MS = 4000;
const TOLD_MS = 80; // between updates of what is told beside the picture
const at = (id) => document.getElementById(id);

const stage = new Stage(at("view"));
const camera = new Camera(stage.camera, stage.canvas);
const figure = new Figure(stage.scene, COLORS);
const card = new Card(at("figures"), "");
const session = new Session("/socket", hear);
const latencyGraph = new Graph(at("graphs"), "key to pose", "ms", 120, 34);
const tickGraph = new Graph(at("graphs"), "tick to tick", "ms", 90, 1000 / 30);
const frameGraph = new Graph(at("graphs"), "drawn every", "ms", 60, 1000 / 60);
const frames = new Series(300);
const quality = new Quality(stage);
const transport = new Transport(
  () => [session.history],
  () => camera.yaw,
  complain
);
const once = {
  KeyC: changeCamera,
  KeyP: () => transport.pause(),
  Comma: () => transport.step(-1),
  Period: () => transport.step(1),
  KeyH: () => (at("help").hidden = !at("help").hidden),
};
const keyboard = new Keyboard(once, (when) => ask(when));
at("camera").onclick = changeCamera;

function changeCamera() {
  camera.change();
  put(at("camera"), `Camera: ${camera.kind}`);
}

function hear({ welcome, lost, problem }) {
  if (welcome) greet(welcome);
  if (lost) notify(lost);
  if (problem) complain(problem);
}

function greet(welcome) {
  at("notice").hidden = true;
  figure.dress(welcome);
  const asked = states(welcome).map((name, k) => `<b>${k + 1}</b> ${name.replace(/[<&]/g, "")}`);
  at("states").innerHTML = asked.join(" ");
  put(card.title, welcome.attribution.join(" ") || "motions that were generated");
}

function notify(text) {
  put(at("notice"), text);
  at("notice").hidden = false;
}

function complain(text) {
  put(at("error"), text);
  at("error").hidden = false;
  clearTimeout(complain.timer);
  complain.timer = setTimeout(() => (at("error").hidden = true), ERROR_MS);
}

// when: of the event that changed what is held, undefined where only time has passed.
function ask(when) {
  if (!session.welcome || transport.player) return;
  session.ask(wishOf(session.welcome, camera.yaw, keyboard, gamepad()), when);
}

function replay(seconds) {
  const { keys, yaw } = transport.player.advance(transport.paused ? 0 : seconds);
  camera.yaw = yaw;
  session.ask({ keys: { view_yaw: yaw, ...keys } });
}

function turnByPad(seconds) {
  const pad = gamepad();
  if (pad && (pad.turn || pad.tilt)) camera.turn(pad.turn * seconds, pad.tilt * seconds);
}

let before = performance.now();
function draw(now) {
  const seconds = Math.min(0.25, (now - before) / 1000);
  if (now > before) frames.add(now - before);
  quality.note(now - before);
  before = now;
  turnByPad(seconds);
  if (transport.player && session.welcome) replay(seconds);
  else ask();
  transport.recorder?.note(keyboard.keys, camera.yaw, now);
  if (session.welcome) show(seconds, now);
  camera.follow(figure.place, figure.facing, seconds);
  stage.draw(camera.target);
  requestAnimationFrame(draw);
}

function show(seconds, now) {
  figure.show(session.history.advance(seconds, session.welcome.frame_rate));
  if (now - toldAt > TOLD_MS) tell(now);
}

let toldAt = 0;
function tell(now) {
  toldAt = now;
  card.show(figure, session.history, session.welcome);
  latencyGraph.show(session.latency);
  tickGraph.show(session.gaps);
  frameGraph.show(frames);
  transport.show();
}

requestAnimationFrame(draw);
// For whoever looks from outside, such as a test.
globalThis.footwork = { session, figure, camera, frames, transport, stage };
