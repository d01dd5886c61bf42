import type { Camera, Object3D, WebGLRenderer } from "three";

/**
 * Compiles all shaders of a scene without blocking the page. Also makes three.js query their uniforms and attributes:
 * once drawing has begun, such a query waits for everything that is being drawn.
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
