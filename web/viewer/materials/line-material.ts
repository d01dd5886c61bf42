import { ShaderMaterial, Vector2 } from "three";
import { drawStateGlsl, drawStateUniforms, type DrawState, type StateMaterial } from "../draw-state";
import type { Viewport } from "../scene-state";
import { enlarging } from "./enlarging";
import { culled } from "./glsl";

/**
 * Segments as rectangles of a fixed width on the screen, with the vertices of `SegmentGeometry`: two at each end. The ends
 * are rounded.
 */
const vertexShader = /* glsl */ `
  attribute vec3 end;
  uniform vec2 resolution;
  uniform float leastWidth;
  uniform float enlarging;
  varying vec3 vColor;
  // Across the segment from -1 to 1, along it in pixels, and 1; times w, so that they are linear on the screen.
  varying vec3 vPlace;
  // Length and half the width, in pixels.
  flat varying vec2 vSize;
  ${drawStateGlsl}
  // Moves an end that lies behind the eye to the near plane.
  vec3 trimmed(vec3 visible, vec3 behind) {
    float near = -0.5 * projectionMatrix[3][2] / projectionMatrix[2][2];
    return mix(visible, behind, (near - visible.z) / (behind.z - visible.z));
  }
  void main() {
    vColor = stateColor();
    vec3 first = (modelViewMatrix * vec4(position, 1.0)).xyz;
    vec3 last = (modelViewMatrix * vec4(end, 1.0)).xyz;
    if (first.z < 0.0 && last.z >= 0.0) last = trimmed(first, last);
    else if (last.z < 0.0 && first.z >= 0.0) first = trimmed(last, first);
    vec4 clipFirst = projectionMatrix * vec4(first, 1.0);
    vec4 clipLast = projectionMatrix * vec4(last, 1.0);
    vec2 along = 0.5 * (clipLast.xy / clipLast.w - clipFirst.xy / clipFirst.w) * resolution;
    vSize = vec2(length(along), 0.5 * max(stateScale() * enlarging, leastWidth));
    along = vSize.x > 0.0 ? along / vSize.x : vec2(1.0, 0.0);
    int corner = gl_VertexID % 4;
    bool isLast = corner > 1;
    float side = corner % 2 == 0 ? -1.0 : 1.0;
    vec4 clip = isLast ? clipLast : clipFirst;
    vec2 offset = vec2(along.y, -along.x) * side + (isLast ? along : -along);
    clip.xy += 2.0 * vSize.y * offset / resolution * clip.w;
    vPlace = vec3(side, isLast ? vSize.x + vSize.y : -vSize.y, 1.0) * clip.w;
    gl_Position = isDrawn() ? clip : ${culled};
  }
`;

const fragmentShader = /* glsl */ `
  uniform float dash;
  varying vec3 vColor;
  varying vec3 vPlace;
  flat varying vec2 vSize;
  void main() {
    vec2 place = vPlace.xy / vPlace.z;
    if (dash > 0.0 && mod(clamp(place.y, 0.0, vSize.x), dash) > 0.6 * dash) discard;
    float beyond = max(max(-place.y, place.y - vSize.x), 0.0) / vSize.y;
    if (beyond > 0.0 && place.x * place.x + beyond * beyond > 1.0) discard;
    gl_FragColor = vec4(vColor, 1.0);
  }
`;

/** The same vertices as lines one pixel wide: half as many, each with one end to project. */
const thinVertexShader = /* glsl */ `
  attribute vec3 end;
  varying vec3 vColor;
  ${drawStateGlsl}
  void main() {
    vColor = stateColor();
    vec4 viewPosition = modelViewMatrix * vec4(gl_VertexID % 4 > 1 ? end : position, 1.0);
    // In front of the surfaces on which they lie.
    viewPosition.xyz *= 0.999;
    gl_Position = isDrawn() ? projectionMatrix * viewPosition : ${culled};
  }
`;

const thinFragmentShader = /* glsl */ `
  varying vec3 vColor;
  void main() {
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
  readonly uniforms: {
    readonly resolution: { readonly value: Vector2 };
    readonly leastWidth: { value: number };
  };
};

/** Line segments, coloured by the state of their line. Give it each new size of the view by `fitLines`. */
export function createLineMaterial({ widths, depthTest, dash = 0 }: LinePass): LineMaterial {
  const uniforms = {
    ...drawStateUniforms(widths),
    resolution: { value: new Vector2(1, 1) },
    leastWidth: { value: 0 },
    dash: { value: dash },
    enlarging,
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

/** Line segments one device pixel wide, which take a renderer without a graphics card a third of the time. */
export function createThinLineMaterial(states: readonly DrawState[], depthTest: boolean): StateMaterial {
  const uniforms = drawStateUniforms(Object.fromEntries(states.map((state) => [state, 1])));
  const material = new ShaderMaterial({
    vertexShader: thinVertexShader,
    fragmentShader: thinFragmentShader,
    depthTest,
    uniforms,
  });
  return Object.assign(material, { uniforms });
}

/** Adapts lines to the size of the view. They are as wide as a device pixel at least: thinner ones would have gaps. */
export function fitLines({ uniforms }: LineMaterial, { width, height, pixelRatio }: Viewport): void {
  uniforms.resolution.value.set(width, height);
  uniforms.leastWidth.value = 1 / pixelRatio;
}
