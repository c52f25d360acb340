// What is told of one character: behaviour, transition, clip and frame, speed, feet, and what it did lately.
import { drawStrip } from "./strip.js";

const FLASH_MS = 350; // for how long a transition stays lit

export class Card {
  // color: of the character's shirt.
  constructor(parent, title, color) {
    this.root = element("section", "panel figure", parent);
    this.root.style.setProperty("--shirt", `#${color.toString(16).padStart(6, "0")}`);
    this.title = element("h2", "", this.root);
    this.title.textContent = title;
    const doing = element("div", "doing", this.root);
    this.behaviour = element("span", "behaviour", doing);
    this.transition = element("span", "transition", doing);
    this.transition.textContent = "transition";
    const list = element("dl", "", this.root);
    this.clip = row(list, "clip");
    this.frame = row(list, "frame");
    this.speed = row(list, "speed");
    const feet = row(list, "feet");
    this.feet = { left: element("span", "foot", feet), right: element("span", "foot", feet) };
    for (const [side, foot] of Object.entries(this.feet)) foot.textContent = side;
    this.strip = element("canvas", "", this.root);
    this.jumped = -Infinity;
  }

  show(figure, history, welcome) {
    const pose = figure.shown;
    if (!pose) return;
    const now = performance.now();
    if (pose.transition && pose.tick !== this.tick) this.jumped = now;
    this.tick = pose.tick;
    put(this.behaviour, pose.absent ? "not here" : (welcome.behaviours[pose.behaviour] ?? "other"));
    this.transition.classList.toggle("now", now - this.jumped < FLASH_MS);
    drawStrip(this.strip, history, welcome.behaviours);
    if (pose.absent) return;
    put(this.clip, welcome.clips[pose.clip] ?? "none");
    put(this.frame, `${pose.sourceFrame}, tick ${pose.tick}`);
    put(this.speed, `${figure.speed.toFixed(2)} m/s, facing ${degrees(pose.facing)}°`);
    for (const [side, foot] of Object.entries(this.feet)) foot.classList.toggle("down", figure.standing[side] !== null);
  }
}

function degrees(angle) {
  return Math.round(((((angle * 180) / Math.PI) % 360) + 360) % 360);
}

export function element(name, className, parent) {
  const made = Object.assign(document.createElement(name), { className });
  parent.append(made);
  return made;
}

function row(list, name) {
  element("dt", "", list).textContent = name;
  return element("dd", "", list);
}

// Text is written only when it changes: layout costs more than comparing.
export function put(node, text) {
  if (node.textContent !== text) node.textContent = text;
}
