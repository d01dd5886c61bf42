import { ShaderMaterial, Vector2 } from "three";
import { drawStateGlsl, drawStateUniforms, type DrawState, type StateMaterial } from "../draw-state";
import { culled } from "./glsl";

/**
 * Segments as rectangles of a fixed width on the screen, one instance each. The vertices are those of three's
 * LineSegmentsGeometry: x is -1 or 1 across the segment, y is -1 to 2 along it, and the ends are rounded.
 */
const vertexShader = /* glsl */ `
  attribute vec3 instanceStart;
  attribute vec3 instanceEnd;
  uniform vec2 resolution;
  varying vec3 vColor;
  varying vec2 vUv;
  varying float vAlong;
  ${drawStateGlsl}
  // Moves an end that lies behind the eye to the near plane.
  vec3 trimmed(vec3 visible, vec3 behind) {
    float near = -0.5 * projectionMatrix[3][2] / projectionMatrix[2][2];
    return mix(visible, behind, (near - visible.z) / (behind.z - visible.z));
  }
  void main() {
    vColor = stateColor();
    vUv = uv;
    vec3 start = (modelViewMatrix * vec4(instanceStart, 1.0)).xyz;
    vec3 end = (modelViewMatrix * vec4(instanceEnd, 1.0)).xyz;
    if (start.z < 0.0 && end.z >= 0.0) end = trimmed(start, end);
    else if (end.z < 0.0 && start.z >= 0.0) start = trimmed(end, start);
    vec4 clipStart = projectionMatrix * vec4(start, 1.0);
    vec4 clipEnd = projectionMatrix * vec4(end, 1.0);
    // From here to the offset, lengths are in pixels.
    vec2 along = (clipEnd.xy / clipEnd.w - clipStart.xy / clipStart.w) * resolution;
    vAlong = position.y < 0.5 ? 0.0 : 0.5 * length(along);
    along = length(along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
    vec2 offset = vec2(along.y, -along.x) * sign(position.x);
    if (position.y < 0.0) offset -= along;
    else if (position.y > 1.0) offset += along;
    vec4 clip = position.y < 0.5 ? clipStart : clipEnd;
    clip.xy += offset * stateScale() / resolution * clip.w;
    gl_Position = isDrawn() ? clip : ${culled};
  }
`;

const fragmentShader = /* glsl */ `
  uniform float dash;
  varying vec3 vColor;
  varying vec2 vUv;
  varying float vAlong;
  void main() {
    if (dash > 0.0 && mod(vAlong, dash) > 0.6 * dash) discard;
    float beyond = max(abs(vUv.y) - 1.0, 0.0);
    if (beyond > 0.0 && vUv.x * vUv.x + beyond * beyond > 1.0) discard;
    gl_FragColor = vec4(vColor, 1.0);
  }
`;

export interface LinePass {
  /** Width in CSS pixels of each state that the pass draws. */
  readonly widths: { readonly [S in DrawState]?: number };
  readonly depthTest: boolean;
  /** Length of a dash and the gap after it, in CSS pixels; without it, lines are solid. */
  readonly dash?: number;
}

export type LineMaterial = StateMaterial & {
  readonly uniforms: { readonly resolution: { readonly value: Vector2 } };
};

/** Line segments, coloured by the state of their line. The uniform `resolution` is the size of the view in CSS pixels. */
export function createLineMaterial({ widths, depthTest, dash = 0 }: LinePass): LineMaterial {
  const uniforms = {
    ...drawStateUniforms(widths),
    resolution: { value: new Vector2(1, 1) },
    dash: { value: dash },
  };
  const material = new ShaderMaterial({
    vertexShader,
    fragmentShader,
    depthTest,
    polygonOffset: true,
    polygonOffsetFactor: -2,
    polygonOffsetUnits: -2,
    uniforms,
  });
  return Object.assign(material, { uniforms });
}
