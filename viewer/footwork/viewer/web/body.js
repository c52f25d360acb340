// A character's body: one group a joint, put where the skeleton has it.
import { Group, Mesh, MeshLambertMaterial } from "./vendor/three.module.js";
import { limb } from "./limbs.js";

const SKIN = 0xd9a27e;
const STANDING = 0x35d07f;
const SHOES = { left: 0x2f6fb0, right: 0xc4552d }; // told apart, so that steps can be
const STRUCK = 0xff3020;
const FEET = ["foot", "toes"];

export class Body {
  // shirt, trousers: colours of this character.
  constructor(skeleton, { shirt, trousers }) {
    this.group = new Group();
    this.shoes = { left: matte(SHOES.left), right: matte(SHOES.right) };
    const cloth = { shirt: matte(shirt), trousers: matte(trousers), skin: matte(SKIN) };
    this.cloth = Object.values(cloth);
    this.joints = skeleton.names.map((name, joint) => {
      const group = new Group();
      for (const solid of limb(skeleton, joint)) group.add(shadowing(new Mesh(solid, this.#material(name, cloth))));
      this.group.add(group);
      return group;
    });
  }

  #material(name, { shirt, trousers, skin }) {
    const side = name.startsWith("left") ? "left" : "right";
    if (FEET.some((part) => name.endsWith(part))) return this.shoes[side];
    if (/head|neck|hand|forearm/.test(name)) return skin;
    return /hips|thigh|shank/.test(name) ? trousers : shirt;
  }

  show(skeleton) {
    this.joints.forEach((group, joint) => {
      group.position.copy(skeleton.places[joint]);
      group.quaternion.copy(skeleton.turns[joint]);
    });
  }

  // Feet that stand are lit.
  light({ left, right }) {
    for (const [side, stands] of Object.entries({ left, right })) {
      this.shoes[side].color.setHex(stands ? STANDING : SHOES[side]);
    }
  }

  // A blow, 0 for none to 1, lights all but the shoes.
  flash(share) {
    for (const material of this.cloth) material.emissive.setHex(STRUCK).multiplyScalar(share);
  }

  dispose() {
    this.group.removeFromParent();
    this.group.traverse((part) => part.geometry?.dispose());
  }
}

function matte(color) {
  return new MeshLambertMaterial({ color });
}

function shadowing(mesh) {
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  return mesh;
}
