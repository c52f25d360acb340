// Recorded keys: 35 a second, as CSV files that `footwork score --traces` and `build --players` read.
export const TRACE_HZ = 35;
const COLUMNS = ["tick", "forward", "strafe", "run", "yaw_delta_deg", "attack", "use"];
const MOST_ROWS = 400000;

export class TraceRecorder {
  // yaw: of the view as recording starts, radians.
  constructor(yaw, now) {
    this.rows = [];
    this.yaw = yaw;
    this.start = now;
  }

  // Notes what is held, for all ticks up to now.
  note(keys, yaw, now) {
    const ticks = Math.min(MOST_ROWS, Math.floor(((now - this.start) / 1000) * TRACE_HZ));
    while (this.rows.length < ticks) {
      const turn = ((((yaw - this.yaw) * 180) / Math.PI + 540) % 360) - 180;
      const delta = this.rows.length + 1 === ticks ? Number(turn.toFixed(5)) : 0;
      if (delta) this.yaw = yaw;
      this.rows.push([this.rows.length, keys.forward, keys.strafe, +keys.run, delta, +keys.jump, 0]);
    }
  }

  get csv() {
    return [COLUMNS, ...this.rows].map((row) => row.join(",")).join("\n") + "\n";
  }

  get seconds() {
    return this.rows.length / TRACE_HZ;
  }
}

// The recorded keys in a CSV file's text; throws an Error with a line for people.
export function parseTrace(text) {
  const lines = text.split(/\r?\n/).filter((line) => line.trim());
  const header = (lines.shift() ?? "").split(",").map((cell) => cell.trim());
  const places = COLUMNS.map((name) => header.indexOf(name));
  const missing = COLUMNS.filter((_, k) => places[k] < 0);
  if (missing.length) throw new Error(`no column ${missing.join(", ")}; expected ${COLUMNS.join(",")}`);
  if (lines.length < 2 || lines.length > MOST_ROWS) throw new Error(`${lines.length} rows, expected 2 to ${MOST_ROWS}`);
  return lines.map((line, k) => row(line.split(",").map(Number), places, k + 2));
}

function row(cells, places, line) {
  const [, forward, strafe, run, turn, attack] = places.map((place) => cells[place]);
  const signs = [forward, strafe].every((value) => [-1, 0, 1].includes(value));
  if (!signs || !(Math.abs(turn) <= 180)) throw new Error(`line ${line}: not what a trace holds`);
  return { forward, strafe, run: run === 1, turn: (turn * Math.PI) / 180, jump: attack === 1 };
}

export class TracePlayer {
  constructor(rows, yaw) {
    this.rows = rows;
    let view = yaw;
    this.yaws = rows.map(({ turn }) => (view += turn));
    this.seconds = 0;
  }

  get length() {
    return this.rows.length / TRACE_HZ;
  }

  get isOver() {
    return this.seconds >= this.length;
  }

  // Keys and view yaw so many seconds further on.
  advance(seconds) {
    this.seconds = Math.min(this.length, this.seconds + seconds);
    const at = Math.min(this.rows.length - 1, Math.floor(this.seconds * TRACE_HZ));
    const { forward, strafe, run, jump } = this.rows[at];
    return { keys: { forward, strafe, run, jump }, yaw: this.yaws[at] };
  }
}
