// Plays animations of GLB files with three.js: where the joints are, one JSON line for each body of each animation.
// node places.mjs FILE...
import { readFileSync } from "node:fs";
import { AnimationMixer, LoopOnce, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

const loader = new GLTFLoader();
for (const file of process.argv.slice(2)) {
  const bytes = readFileSync(file);
  const gltf = await loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), "");
  for (const animation of gltf.animations) {
    const mixer = new AnimationMixer(gltf.scene);
    const action = mixer.clipAction(animation);
    action.setLoop(LoopOnce);
    action.clampWhenFinished = true;
    action.play();
    const times = [...new Set(animation.tracks.flatMap((track) => [...track.times]))].sort((a, b) => a - b);
    const frames = times.map((time) => {
      mixer.setTime(time);
      gltf.scene.updateMatrixWorld(true);
      return bodies(gltf.scene).map((bones) => bones.map((bone) => bone.getWorldPosition(new Vector3()).toArray()));
    });
    console.log(JSON.stringify({ file, animation: animation.name, times, frames }));
    action.stop();
  }
}

function bodies(scene) {
  const found = [];
  scene.traverse((node) => node.isSkinnedMesh && found.push(node.skeleton.bones));
  return found;
}
