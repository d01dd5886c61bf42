import { Color, ShaderMaterial } from "three";

const vertexShader = /* glsl */ `
  varying vec2 vPosition;
  void main() {
    vPosition = position.xy;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }
`;

const fragmentShader = /* glsl */ `
  uniform vec3 color;
  uniform float reach;
  varying vec2 vPosition;
  void main() {
    float fade = 1.0 - smoothstep(0.15, 1.0, length(vPosition) / reach);
    gl_FragColor = vec4(color, 0.4 * fade);
  }
`;

/** Lines of the ground grid, which fade out with the distance from the model. */
export function createGroundMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    transparent: true,
    depthWrite: false,
    uniforms: { color: { value: new Color() }, reach: { value: 1 } },
  });
}
