// Graphs of a session: how long a key takes to show, how even the ticks come, and how often the page draws.
import { element, put } from "./card.js";
import { sharp } from "./strip.js";

export class Graph {
  // most: the value at the graph's top; mark: a value that is drawn as a line.
  constructor(parent, title, unit, most, mark) {
    const box = element("div", "", parent);
    const line = element("p", "", box);
    element("span", "", line).textContent = title;
    this.value = element("span", "", line);
    this.canvas = element("canvas", "", box);
    Object.assign(this, { unit, most, mark });
  }

  show(series) {
    const [middle, high] = [0.5, 0.99].map((share) => series.quantile(share));
    const told = `${middle.toFixed(0)} ${this.unit}, 99 %: ${high.toFixed(0)}`;
    put(this.value, Number.isNaN(middle) ? "none yet" : told);
    this.#draw(series.values, series.most);
  }

  #draw(values, most) {
    const pen = sharp(this.canvas);
    const { width, height } = this.canvas;
    const y = (value) => height * (1 - Math.min(1, value / this.most));
    pen.fillStyle = "rgb(255 255 255 / 7%)";
    pen.fillRect(0, 0, width, height);
    pen.fillStyle = "rgb(255 255 255 / 30%)";
    pen.fillRect(0, y(this.mark), width, 1);
    const step = width / most;
    values.forEach((value, k) => {
      pen.fillStyle = value > 1.5 * this.mark ? "#ff7b72" : "#7ee0a1";
      pen.fillRect(k * step, y(value), Math.max(1, step - 0.5), height - y(value));
    });
  }
}
