// The ground: a plane with a grid of metres that goes along with the camera, so that it has no end.
import { CanvasTexture, Mesh, MeshLambertMaterial, PlaneGeometry, RepeatWrapping, SRGBColorSpace } from "./vendor/three.module.js";

const METRES = 5; // of one tile of the grid
const TILES = 40;
const PIXELS = 1024;

export class Ground {
  // anisotropy: how many samples sharpen the grid far away.
  constructor(anisotropy) {
    const map = new CanvasTexture(grid());
    map.wrapS = map.wrapT = RepeatWrapping;
    map.repeat.set(TILES, TILES);
    map.colorSpace = SRGBColorSpace;
    map.anisotropy = anisotropy;
    const plane = new PlaneGeometry(METRES * TILES, METRES * TILES).rotateX(-Math.PI / 2);
    this.mesh = new Mesh(plane, new MeshLambertMaterial({ map }));
    this.mesh.receiveShadow = true;
  }

  follow(place) {
    this.mesh.position.set(METRES * Math.round(place.x / METRES), 0, METRES * Math.round(place.z / METRES));
  }
}

function grid() {
  const canvas = Object.assign(document.createElement("canvas"), { width: PIXELS, height: PIXELS });
  const pen = canvas.getContext("2d");
  pen.fillStyle = "#8d979d";
  pen.fillRect(0, 0, PIXELS, PIXELS);
  const metre = PIXELS / METRES;
  for (let k = 0; k < METRES; k++) {
    for (let l = 0; l < METRES; l++) {
      pen.fillStyle = (k + l) % 2 ? "#939da3" : "#8a949a";
      pen.fillRect(k * metre, l * metre, metre, metre);
    }
  }
  pen.strokeStyle = "#6f7a81";
  lines(pen, metre, 3);
  pen.strokeStyle = "#556068";
  lines(pen, PIXELS, 8);
  return canvas;
}

function lines(pen, every, width) {
  pen.lineWidth = width;
  pen.beginPath();
  for (let at = 0; at <= PIXELS; at += every) {
    pen.moveTo(at, 0);
    pen.lineTo(at, PIXELS);
    pen.moveTo(0, at);
    pen.lineTo(PIXELS, at);
  }
  pen.stroke();
}
