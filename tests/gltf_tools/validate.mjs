// Prints what Khronos' validator says of GLB files, one JSON line each: node validate.mjs FILE...
import { readFileSync } from "node:fs";
import validator from "gltf-validator";

for (const file of process.argv.slice(2)) {
  const { issues, info } = await validator.validateBytes(new Uint8Array(readFileSync(file)));
  console.log(JSON.stringify({ file, issues, info }));
}
