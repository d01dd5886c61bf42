/** In the names of renderers that draw with the processor: of Chromium, Mesa, Windows and Apple. */
const softwareNames = /swiftshader|llvmpipe|softpipe|software|basic render/i;

let answer: boolean | null = null;

/** Returns whether the browser draws WebGL with the processor, without a graphics card. */
export function drawsInSoftware(): boolean {
  answer ??= softwareNames.test(rendererName());
  return answer;
}

/** Returns the name of the renderer that the browser reports; empty without WebGL 2. */
function rendererName(): string {
  const webgl = document.createElement("canvas").getContext("webgl2");
  if (!webgl) return "";
  const info = webgl.getExtension("WEBGL_debug_renderer_info");
  const name: unknown = webgl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : webgl.RENDERER);
  // Browsers allow a few contexts only.
  webgl.getExtension("WEBGL_lose_context")?.loseContext();
  return String(name);
}
