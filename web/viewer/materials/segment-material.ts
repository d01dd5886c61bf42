import { ShaderMaterial } from "three";
import { drawStateGlsl, drawStateUniforms, type DrawState, type StateMaterial } from "../draw-state";
import { culled } from "./glsl";

const vertexShader = /* glsl */ `
  varying vec4 vColor;
  ${drawStateGlsl}
  void main() {
    vColor = vec4(stateColor(), stateScale());
    gl_Position = isDrawn() ? projectionMatrix * modelViewMatrix * vec4(position, 1.0) : ${culled};
  }
`;

const fragmentShader = /* glsl */ `
  varying vec4 vColor;
  void main() {
    gl_FragColor = vColor;
  }
`;

export interface SegmentPass {
  /** Opacity of each state that the pass draws. */
  readonly opacities: { readonly [S in DrawState]?: number };
  readonly depthTest: boolean;
}

/** Segments one pixel wide, coloured by the state of their entity. */
export function createSegmentMaterial({ opacities, depthTest }: SegmentPass): StateMaterial {
  const uniforms = drawStateUniforms(opacities);
  const material = new ShaderMaterial({
    vertexShader,
    fragmentShader,
    transparent: true,
    depthWrite: false,
    depthTest,
    uniforms,
  });
  return Object.assign(material, { uniforms });
}
