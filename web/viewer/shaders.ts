import type { Camera, Object3D, WebGLRenderer } from "three";

/**
 * Has all shaders of a scene made while the page goes on. What three.js asks about each before it is first used
 * is asked here: once drawing has begun the answer waits for all that is being drawn.
 */
export async function prepareShaders(
  renderer: WebGLRenderer,
  scene: Object3D,
  camera: Camera,
): Promise<void> {
  await renderer.compileAsync(scene, camera);
  for (const program of renderer.info.programs ?? []) {
    program.getUniforms();
    program.getAttributes();
  }
}
