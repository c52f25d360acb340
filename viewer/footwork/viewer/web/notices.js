// What a person must know: that a server is lost, and what went wrong for a moment.
import { put } from "./card.js";

const ERROR_MS = 4000;
const at = (id) => document.getElementById(id);

export class Notices {
  lose(text) {
    put(at("notice"), text);
    at("notice").hidden = false;
  }

  find() {
    at("notice").hidden = true;
  }

  complain(text) {
    put(at("error"), text);
    at("error").hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => (at("error").hidden = true), ERROR_MS);
  }
}
