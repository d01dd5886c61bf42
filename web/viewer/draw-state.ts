import { Color, type ShaderMaterial } from "three";
import { displayColor } from "./materials/uniforms";

/** State of an entity that determines how it is drawn. */
export type DrawState = "hidden" | "normal" | "hover" | "selected" | "defective" | "open";

/** Value of each state in the vertex attribute `state`. */
export const stateCodes: { readonly [S in DrawState]: number } = {
  hidden: 0,
  normal: 1,
  hover: 2,
  selected: 3,
  defective: 4,
  /** A line at which patches are still missing. */
  open: 5,
};

const stateCount = Object.keys(stateCodes).length;

/**
 * Vertex shader declarations: the state of the vertex's entity, its tint, and whether this pass draws it. The last number
 * of a tint is 1 without a tint, as in geometries without this attribute.
 */
export const drawStateGlsl = /* glsl */ `
  attribute float state;
  attribute vec4 tint;
  uniform int drawnStates;
  uniform vec3 stateColors[${stateCount}];
  uniform float stateScales[${stateCount}];
  bool isDrawn() { return ((drawnStates >> int(state)) & 1) == 1; }
  vec3 stateColor() {
    return int(state) == ${stateCodes.normal} ? mix(tint.rgb, stateColors[int(state)], tint.a) : stateColors[int(state)];
  }
  float stateScale() { return stateScales[int(state)]; }
`;

/**
 * Values of the uniforms of `drawStateGlsl`, for a pass that draws some states. The scale of a state is a diameter, a
 * width or an opacity, depending on the material.
 */
export function drawStateUniforms(scales: { readonly [S in DrawState]?: number }) {
  const drawn = Object.keys(scales) as DrawState[];
  const stateScales = new Array<number>(stateCount).fill(0);
  for (const state of drawn) stateScales[stateCodes[state]] = scales[state] ?? 0;
  return {
    drawnStates: { value: drawn.reduce((mask, state) => mask | (1 << stateCodes[state]), 0) },
    stateColors: { value: Array.from({ length: stateCount }, () => new Color()) },
    stateScales: { value: stateScales },
  };
}

type StateUniforms = ReturnType<typeof drawStateUniforms>;

/** A material that draws entities by their state. */
export type StateMaterial = ShaderMaterial & { readonly uniforms: StateUniforms };

/** Sets the colours of states from CSS colours. */
export function setStateColors(
  { uniforms }: StateMaterial,
  colors: { readonly [S in DrawState]?: string },
): void {
  for (const state of Object.keys(colors) as DrawState[]) {
    uniforms.stateColors.value[stateCodes[state]]?.copy(displayColor(colors[state] ?? ""));
  }
}

/** Sets the scale of a state. */
export function setStateScale({ uniforms }: StateMaterial, state: DrawState, scale: number): void {
  uniforms.stateScales.value[stateCodes[state]] = scale;
}
