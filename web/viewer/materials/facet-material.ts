import { Color, DoubleSide, ShaderMaterial } from "three";
import { edgeStrength, facetLight } from "./glsl";

const vertexShader = /* glsl */ `
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  void main() {
    int corner = gl_VertexID % 3;
    vBarycentric = vec3(corner == 0, corner == 1, corner == 2);
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    vViewPosition = viewPosition.xyz;
    gl_Position = projectionMatrix * viewPosition;
  }
`;

const fragmentShader = /* glsl */ `
  uniform vec3 color;
  uniform vec3 edgeColor;
  uniform float edges;
  uniform float opacity;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  ${facetLight}
  ${edgeStrength}
  void main() {
    vec3 lit = color * facetLight(vViewPosition);
    gl_FragColor = vec4(mix(lit, edgeColor, edges * edgeStrength(vBarycentric, 0.6)), opacity);
  }
`;

export interface FacetOptions {
  readonly opacity: number;
  readonly depthWrite?: boolean;
  readonly depthTest?: boolean;
  readonly polygonOffset?: number;
  /** Draws the edges of the triangles, which must not be indexed. */
  readonly edges?: boolean;
}

/** Triangles in one colour: highlighted elements, the front. */
export function createFacetMaterial(options: FacetOptions): ShaderMaterial {
  const { opacity, depthWrite = false, depthTest = true, polygonOffset = 0, edges = false } = options;
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    side: DoubleSide,
    transparent: opacity < 1,
    depthWrite,
    depthTest,
    polygonOffset: polygonOffset !== 0,
    polygonOffsetFactor: polygonOffset,
    polygonOffsetUnits: polygonOffset,
    uniforms: {
      color: { value: new Color() },
      edgeColor: { value: new Color() },
      edges: { value: edges ? 1 : 0 },
      opacity: { value: opacity },
    },
  });
}
