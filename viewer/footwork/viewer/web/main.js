// The live view: whom it shows, what the player asks of them, and what is drawn.
import { Camera } from "./cameras.js";
import { put } from "./card.js";
import { Fight } from "./fight.js";
import { filmed } from "./film.js";
import { gamepad } from "./gamepad.js";
import { Graph } from "./graphs.js";
import { Keyboard } from "./keyboard.js";
import { Notices } from "./notices.js";
import { Player } from "./player.js";
import { Quality } from "./quality.js";
import { Series } from "./series.js";
import { Stage } from "./stage.js";
import { Transport } from "./transport.js";
import { fightWish, states, wishOf } from "./wish.js";

const TOLD_MS = 80; // between updates of what is told beside the picture
const at = (id) => document.getElementById(id);

const about = await (await fetch("about.json")).json();
const films = about.film ? await filmed(about.film) : [];
document.body.classList.toggle("film", films.length > 0);
const titles = about.film ? films.map((film) => film.title) : about.titles;
const stage = new Stage(at("view"));
const camera = new Camera(stage.camera, stage.canvas);
const quality = new Quality(stage);
const notices = new Notices();
const players = titles.map((title, number) => new Player(stage, at("figures"), title, number, hear, films[number]));
const [{ session, figure }] = players; // of whom the graphs tell
const fight = new Fight(at("fight"), players);
let [followed] = players; // by the camera, but for fights
for (const player of players) player.card.root.onclick = () => (followed = player);
const frames = new Series(300);
const graphs = [
  [new Graph(at("graphs"), "key to pose", "ms", 120, 34), session.latency],
  [new Graph(at("graphs"), "tick to tick", "ms", 90, 1000 / 30), session.gaps],
  [new Graph(at("graphs"), "drawn every", "ms", 4 * quality.aim, quality.aim), frames],
];
const transport = new Transport(
  players,
  () => camera.yaw,
  (text) => notices.complain(text)
);
const once = {
  KeyC: changeCamera,
  KeyP: () => transport.pause(),
  Comma: () => transport.step(-1),
  Period: () => transport.step(1),
  KeyH: () => (at("help").hidden = !at("help").hidden),
};
const keyboard = new Keyboard(once, ask);
at("camera").onclick = changeCamera;

function changeCamera() {
  camera.change();
  put(at("camera"), `Camera: ${camera.kind}`);
}

function hear({ welcome, lost, problem, rival }) {
  if (lost) notices.lose(lost);
  if (problem) notices.complain(problem);
  if (rival) oppose(rival);
  if (!welcome) return;
  notices.find();
  at("states").replaceChildren(...states(welcome).flatMap((name, k) => [bold(k + 1), ` ${name} `]));
}

// Somebody came whom the character fights.
function oppose(rival) {
  players.push(new Player(stage, at("figures"), rival.title, players.length, hear, rival));
  document.body.classList.add("fighting");
}

let faced = false;
// Once there is a fight the camera goes where both are seen, from head to foot.
function face() {
  if (faced || !fight.isOn) return;
  faced = true;
  if (camera.kind !== "follow") changeCamera();
  camera.distance = 4.4;
}

function bold(text) {
  return Object.assign(document.createElement("b"), { textContent: text });
}

// when: of the event that changed what is held, undefined where only time has passed.
function ask(when) {
  if (transport.replay) return;
  const pad = gamepad();
  for (const { session: one, welcome } of players) {
    if (!welcome) continue;
    const wish = one.rival ? fightWish(welcome, fight.bearing, keyboard, pad) : wishOf(welcome, camera.yaw, keyboard, pad);
    one.ask(wish, when);
  }
}

function replay(seconds) {
  const { keys, yaw } = transport.replay.advance(transport.paused ? 0 : seconds);
  camera.yaw = yaw;
  for (const player of players) player.session.ask({ keys: { view_yaw: yaw, ...keys } });
}

function turnByPad(seconds) {
  const pad = gamepad();
  if (pad && (pad.turn || pad.tilt)) camera.turn(pad.turn * seconds, pad.tilt * seconds);
}

let before = performance.now();
let toldAt = 0;
function turn(now) {
  requestAnimationFrame(turn);
  const seconds = Math.min(0.25, Math.max(0, now - before) / 1000);
  turnByPad(seconds);
  if (transport.replay) replay(seconds);
  else ask();
  transport.recorder?.note(keyboard.keys, camera.yaw, now);
  for (const player of players) player.show(now, seconds);
  fight.light(now);
  face();
  camera.follow(middle(), fight.isOn ? fight.view : followed.figure.facing, seconds);
  if (quality.allows(now)) draw(now);
  before = now;
}

// What is looked at: halfway between those who fight, else whose card was clicked, while it is there.
function middle() {
  if (fight.isOn) return fight.middle;
  const there = [followed, ...players].find((player) => player.figure.isThere) ?? followed;
  return there.figure.place;
}

let drawnAt = performance.now();
function draw(now) {
  frames.add(now - drawnAt);
  drawnAt = now;
  if (now - toldAt > TOLD_MS) tell(now);
  stage.draw(camera.target);
}

function tell(now) {
  toldAt = now;
  for (const player of players) player.tell();
  fight.tell();
  for (const [graph, series] of graphs) graph.show(series);
  transport.show();
}

requestAnimationFrame(turn);
// For whoever looks from outside, such as a test.
globalThis.footwork = { players, session, figure, camera, frames, transport, stage, fight };
