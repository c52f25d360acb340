// A client with nothing of footwork's: npm install && node client.mjs [ADDRESS]
//
// Walks ahead for a second, turns back for another, and prints how the character does.
// protocol/SPEC.md tells what the fields mean.
import { decode, encode } from "@msgpack/msgpack";
import { Dealer } from "zeromq";

const VERSION = 1;
const SILENCE_MS = 5000;

function connect(address) {
  const socket = new Dealer({ receiveTimeout: SILENCE_MS, linger: 200 });
  socket.connect(address);
  return socket;
}

const send = (socket, type, fields = {}) => socket.send(encode({ type, ...fields }));

async function receive(socket) {
  const [data] = await socket.receive();
  const message = decode(data);
  if (message.type === "error" || message.type === "bye") {
    throw new Error(`the server says ${JSON.stringify(message)}`);
  }
  return message;
}

// The bytes of a pose lie at any offset of the message, so they are read one by one.
function floats(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  return Array.from({ length: bytes.byteLength / 4 }, (_, index) => view.getFloat32(4 * index, true));
}

// Holds the forward key with the camera at viewYaw; returns the last sequence number used.
async function walk(socket, viewYaw, seconds, sequence) {
  const end = performance.now() + 1000 * seconds;
  const sent = new Map();
  let longest = 0;
  let pose = null;
  while (pose === null || performance.now() < end) {
    const message = await receive(socket);
    if (message.type !== "pose" || message.frame !== 1) continue;
    pose = message;
    if (sent.has(pose.acknowledged)) {
      longest = Math.max(longest, performance.now() - sent.get(pose.acknowledged));
      sent.delete(pose.acknowledged);
    }
    sequence += 1;
    sent.set(sequence, performance.now());
    await send(socket, "command", { sequence, character: 0, keys: { view_yaw: viewYaw, forward: 1 } });
  }
  const [x, , z] = floats(pose.root);
  const joints = floats(pose.rotations).length / 4;
  const place = `(${x.toFixed(2)}, ${z.toFixed(2)}) m facing ${pose.facing.toFixed(2)} rad`;
  console.log(`tick ${pose.tick}: at ${place}, ${joints} joints, command to pose at most ${longest.toFixed(1)} ms`);
  return sequence;
}

async function main(address = "tcp://127.0.0.1:5555") {
  const socket = connect(address);
  await send(socket, "hello", { version: VERSION, client: "client.mjs" });
  const welcome = await receive(socket);
  console.log(`${welcome.joints.length} joints, behaviours ${welcome.behaviours.join(", ")}`);
  await send(socket, "spawn", { sequence: 1, character: 0 });
  const sequence = await walk(socket, 0, 1, 1);
  await walk(socket, Math.PI, 1, sequence);
  await send(socket, "bye");
  socket.close();
}

await main(...process.argv.slice(2));
