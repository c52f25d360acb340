// A WebSocket to the bridge that comes back by itself; one MessagePack map a frame.
const { decode, encode } = globalThis.MessagePack;

const RETRY_MS = 500;
export const LOST = "the live view's own process does not answer; is it still running?";

export class Connection {
  // path: where on this page's host. hear(message): called with each message, and with a notice when there is none.
  constructor(path, hear) {
    this.address = new URL(path, location.href.replace(/^http/, "ws"));
    this.hear = hear;
    this.received = 0;
    this.final = false;
    this.#open();
  }

  get isOpen() {
    return this.socket.readyState === WebSocket.OPEN;
  }

  send(message) {
    if (this.isOpen) this.socket.send(encode(message));
  }

  #open() {
    this.socket = new WebSocket(this.address);
    this.socket.binaryType = "arraybuffer";
    this.socket.onmessage = ({ data }) => this.#take(decode(new Uint8Array(data)));
    this.socket.onclose = () => this.#closed();
  }

  #take(message) {
    this.received += 1;
    this.final = message.type === "bridge" && message.state === "refused";
    this.hear(message);
  }

  #closed() {
    if (this.final) return;
    this.hear({ type: "bridge", state: "lost", message: LOST });
    setTimeout(() => this.#open(), RETRY_MS);
  }
}
