import { Color, DoubleSide, ShaderMaterial } from "three";
import { edgeStrength, facetLight } from "../viewer/materials/glsl";

const vertexShader = /* glsl */ `
  attribute float value;
  uniform vec2 range;
  uniform float power;
  varying float vShade;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  void main() {
    int corner = gl_VertexID % 3;
    vBarycentric = vec3(corner == 0, corner == 1, corner == 2);
    vShade = 1.0 - pow(clamp((range.y - value) / (range.y - range.x), 0.0, 1.0), power);
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    vViewPosition = viewPosition.xyz;
    gl_Position = projectionMatrix * viewPosition;
  }
`;

const fragmentShader = /* glsl */ `
  uniform sampler2D ramp;
  uniform vec3 edgeColor;
  uniform vec3 faded;
  uniform float fading;
  uniform float opacity;
  varying float vShade;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  ${facetLight}
  ${edgeStrength}
  void main() {
    vec3 color = texture2D(ramp, vec2(clamp(vShade, 0.002, 0.998), 0.5)).rgb * facetLight(vViewPosition);
    color = mix(color, edgeColor, edgeStrength(vBarycentric, 0.6));
    gl_FragColor = vec4(mix(color, faded, fading), opacity);
  }
`;

/** Triangles without an index, coloured by a value per corner; `range` and `power` are those of `FrontValues`. `fading` is the share of `faded`. */
export function createFrontMaterial({ opacity }: { readonly opacity: number }): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    side: DoubleSide,
    transparent: opacity < 1,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    uniforms: {
      ramp: { value: null },
      range: { value: [0, 1] },
      power: { value: 1 },
      edgeColor: { value: new Color() },
      faded: { value: new Color() },
      fading: { value: 0 },
      opacity: { value: opacity },
    },
  });
}
