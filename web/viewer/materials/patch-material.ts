import { DoubleSide, ShaderMaterial } from "three";
import { drawStateGlsl, drawStateUniforms, type DrawState, type StateMaterial } from "../draw-state";
import { culled, facetLight } from "./glsl";

const vertexShader = /* glsl */ `
  varying vec3 vViewPosition;
  varying vec4 vColor;
  ${drawStateGlsl}
  void main() {
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    vViewPosition = viewPosition.xyz;
    vColor = vec4(stateColor(), stateScale());
    gl_Position = isDrawn() ? projectionMatrix * viewPosition : ${culled};
  }
`;

const fragmentShader = /* glsl */ `
  varying vec3 vViewPosition;
  varying vec4 vColor;
  ${facetLight}
  void main() {
    gl_FragColor = vec4(vColor.rgb * facetLight(vViewPosition), vColor.a);
  }
`;

export interface PatchPass {
  /** Opacity of each state that the pass draws. */
  readonly opacities: { readonly [S in DrawState]?: number };
  readonly depthTest?: boolean;
  readonly polygonOffset?: number;
}

/** Translucent triangles of patches, coloured by the state of their patch. */
export function createPatchMaterial({
  opacities,
  depthTest = true,
  polygonOffset = 0,
}: PatchPass): StateMaterial {
  const uniforms = drawStateUniforms(opacities);
  const material = new ShaderMaterial({
    vertexShader,
    fragmentShader,
    side: DoubleSide,
    transparent: true,
    depthWrite: false,
    depthTest,
    polygonOffset: polygonOffset !== 0,
    polygonOffsetFactor: polygonOffset,
    polygonOffsetUnits: polygonOffset,
    uniforms,
  });
  return Object.assign(material, { uniforms });
}
