import { Color, FrontSide, ShaderMaterial } from "three";
import { edgeStrength, facetLight } from "./glsl";

const vertexShader = /* glsl */ `
  attribute float value;
  attribute vec3 share;
  uniform float curved;
  varying float vValue;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  void main() {
    int corner = gl_VertexID % 3;
    vBarycentric = curved > 0.0 ? share * curved : vec3(corner == 0, corner == 1, corner == 2);
    vValue = value;
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    vViewPosition = viewPosition.xyz;
    gl_Position = projectionMatrix * viewPosition;
  }
`;

const fragmentShader = /* glsl */ `
  uniform sampler2D ramp;
  uniform float hues;
  uniform vec3 plainColor;
  uniform vec3 edgeColor;
  uniform vec3 fadedColor;
  uniform float shaded;
  uniform float edges;
  uniform float edgeWidth;
  uniform float lines;
  uniform float fading;
  varying float vValue;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  ${facetLight}
  ${edgeStrength}
  void main() {
    float texel = hues > 0.0 ? mod(vValue + 0.5, hues) / hues : clamp(vValue, 0.002, 0.998);
    vec3 color = mix(plainColor, texture2D(ramp, vec2(texel, 0.5)).rgb, shaded);
    color *= facetLight(vViewPosition);
    float level = vValue * lines;
    float fromLine = abs(fract(level) - 0.5) / max(fwidth(level), 1e-6);
    color = mix(color, edgeColor, lines > 0.0 ? 1.0 - smoothstep(0.6, 1.4, fromLine) : 0.0);
    color = mix(color, edgeColor, edges * edgeStrength(vBarycentric, edgeWidth));
    gl_FragColor = vec4(mix(color, fadedColor, fading), 1.0);
  }
`;

/**
 * Faces of tetrahedra without an index: shaded by a value per corner, with element edges drawn in the same pass. With
 * a colour ramp, the value is a position on it, 0 to 1. With a palette of `hues` colours, it is the index of a colour.
 * `lines` is the number of lines of equal value that are drawn; 0 for none.
 * With `curved` above 0, triangles are pieces of faces, and `share` times `curved` are the coordinates of a corner in its face.
 */
export function createMeshMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    side: FrontSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    uniforms: {
      ramp: { value: null },
      hues: { value: 0 },
      plainColor: { value: new Color() },
      edgeColor: { value: new Color() },
      fadedColor: { value: new Color() },
      shaded: { value: 1 },
      edges: { value: 1 },
      curved: { value: 0 },
      edgeWidth: { value: 0.6 },
      lines: { value: 0 },
      fading: { value: 0 },
    },
  });
}
