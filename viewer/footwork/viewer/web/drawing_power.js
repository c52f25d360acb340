// Whether a graphics processor draws, or the machine's own processor has to do it all.
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

function drawsInSoftware() {
  const pen = document.createElement("canvas").getContext("webgl2");
  const told = pen?.getExtension("WEBGL_debug_renderer_info");
  const name = told ? pen.getParameter(told.UNMASKED_RENDERER_WEBGL) : "";
  pen?.getExtension("WEBGL_lose_context")?.loseContext();
  return SOFTWARE.test(name);
}

export const DRAWS_IN_SOFTWARE = drawsInSoftware();
