// What a character did in the last seconds: a band coloured by behaviour, a stroke at every transition.
const SECONDS = 10;
const COLORS = { stop: "#6c8ea0", walk: "#5fb98c", run: "#e8a13c", jump: "#c678dd", locomotion: "#6c8ea0", shadow: "#6c8ea0", attack: "#e0574f", evade: "#e8c13c" };
const OTHERS = ["#e06c75", "#56b6c2", "#d19a66", "#98c379", "#b07cd8", "#e5c07b", "#61afef"];

export function colorOf(behaviours, index) {
  const name = behaviours[index];
  return COLORS[name] ?? (index < 0 ? "#3a464e" : OTHERS[index % OTHERS.length]);
}

export function drawStrip(canvas, history, behaviours) {
  const pen = sharp(canvas);
  const { width, height } = canvas;
  const end = Math.floor(history.shown);
  const until = history.poses[end]?.at ?? 0;
  pen.fillStyle = "rgb(255 255 255 / 8%)";
  pen.fillRect(0, 0, width, height);
  let right = width;
  for (let k = end; k >= 0 && right > 0; k--) {
    const left = width * (1 - (until - history.poses[k].at) / (1000 * SECONDS));
    pen.fillStyle = colorOf(behaviours, history.poses[k].behaviour);
    pen.fillRect(left, 0, right - left + 1, height);
    right = left;
  }
  pen.fillStyle = "#10181d";
  for (let k = end; k > 0 && until - history.poses[k].at < 1000 * SECONDS; k--) {
    if (history.poses[k].transition && history.poses[k].tick !== history.poses[k - 1].tick) {
      pen.fillRect(width * (1 - (until - history.poses[k].at) / (1000 * SECONDS)), height * 0.55, 2, height * 0.45);
    }
  }
}

// The canvas' pen, with a pixel for each of the screen's.
export function sharp(canvas) {
  const width = Math.round(canvas.clientWidth * devicePixelRatio);
  const height = Math.round(canvas.clientHeight * devicePixelRatio);
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const pen = canvas.getContext("2d");
  pen.clearRect(0, 0, width, height);
  return pen;
}
