// What is around the characters: renderer, light, shadows, air and ground.
import {
  ACESFilmicToneMapping,
  BasicShadowMap,
  Color,
  DirectionalLight,
  Fog,
  HemisphereLight,
  PCFShadowMap,
  PerspectiveCamera,
  Scene,
  WebGLRenderer,
} from "./vendor/three.module.js";
import { DRAWS_IN_SOFTWARE } from "./drawing_power.js";
import { Ground } from "./ground.js";

const AIR = 0xb9c6cf;
const SUN = [3.2, 6.5, -2.4]; // from the character, metres
const LIT = 4.5; // how far from the character there are shadows

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.software = DRAWS_IN_SOFTWARE;
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.software });
    this.renderer.toneMapping = ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = 1.05;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = this.software ? BasicShadowMap : PCFShadowMap;
    this.camera = new PerspectiveCamera(42, 1, 0.1, 200);
    this.scene = new Scene();
    this.scene.background = new Color(AIR);
    this.scene.fog = new Fog(AIR, 14, 60);
    this.scene.add(new HemisphereLight(0xf2f7ff, 0x7c776e, 1.5));
    this.sun = sun(this.software ? 1024 : 2048);
    this.ground = new Ground(this.software ? 1 : 8);
    this.fill = new DirectionalLight(0xe6f0ff, 0.9); // from where one looks
    this.scene.add(this.camera, this.fill, this.sun, this.sun.target, this.ground.mesh);
    this.detail(1);
  }

  // Pixels of the canvas a pixel of the screen: the share of full detail that the machine can draw in time.
  detail(share) {
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2) * share);
    this.#fit(true);
  }

  #fit(always) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!always && this.width === width && this.height === height) return;
    [this.width, this.height] = [width, height];
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
  }

  // place: of what is looked at.
  draw(place) {
    this.#fit(false);
    this.ground.follow(place);
    this.sun.target.position.set(place.x, 0, place.z);
    this.sun.position.set(place.x + SUN[0], SUN[1], place.z + SUN[2]);
    this.fill.position.copy(this.camera.position).sub(place);
    this.renderer.render(this.scene, this.camera);
  }
}

// pixels: of the shadows, across.
function sun(pixels) {
  const light = new DirectionalLight(0xfff1dc, 2.6);
  light.castShadow = true;
  light.shadow.mapSize.set(pixels, pixels);
  Object.assign(light.shadow.camera, { left: -LIT, right: LIT, top: LIT, bottom: -LIT, near: 0.5, far: 18 });
  light.shadow.bias = -0.0004;
  light.shadow.normalBias = 0.012;
  return light;
}
