import { Color, DoubleSide, ShaderMaterial, Vector2, Vector3 } from "three";
import { enlarging } from "../../viewer/materials/enlarging";
import { edgeStrength, facetLight } from "../../viewer/materials/glsl";
import { fading } from "./front-values";

/** Share by which elements that are pulled apart are smaller. */
const shrinking = "0.14";
/** Distance that they move, as a share of that from the middle of the model. */
const distance = "0.75";

const vertexShader = /* glsl */ `
  attribute float value;
  attribute vec3 ownCentre;
  uniform vec2 range;
  uniform float apart;
  uniform vec3 middle;
  uniform float power;
  varying float vShade;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  void main() {
    int corner = gl_VertexID % 3;
    vBarycentric = vec3(corner == 0, corner == 1, corner == 2);
    vShade = 1.0 - pow(clamp((range.y - value) / (range.y - range.x), 0.0, 1.0), power);
    vec3 shrunk = mix(position, ownCentre, ${shrinking} * min(1.0, 3.0 * apart));
    vec4 viewPosition = modelViewMatrix * vec4(shrunk + ${distance} * apart * (ownCentre - middle), 1.0);
    vViewPosition = viewPosition.xyz;
    gl_Position = projectionMatrix * viewPosition;
  }
`;

const fragmentShader = /* glsl */ `
  uniform sampler2D ramp;
  uniform vec3 edgeColor;
  uniform vec3 plain;
  uniform vec3 background;
  uniform float fading;
  uniform vec2 depths;
  uniform float opacity;
  uniform float enlarging;
  varying float vShade;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  ${facetLight}
  ${edgeStrength}
  void main() {
    vec3 color = texture2D(ramp, vec2(clamp(vShade, 0.002, 0.998), 0.5)).rgb;
    color = mix(color, plain, fading * ${fading.plain.toFixed(2)});
    // The dark end of the scale would hide dark edges, and faces that look away from the light.
    float darkness = 1.0 - smoothstep(0.1, 0.4, dot(color, vec3(0.2126, 0.7152, 0.0722)));
    vec3 edge = mix(edgeColor, mix(color, vec3(1.0), 0.32), darkness);
    color = mix(color, vec3(1.0), 0.14 * darkness) * facetLight(vViewPosition);
    color = mix(color, edge, edgeStrength(vBarycentric, 0.6 * enlarging));
    float depth = clamp((-vViewPosition.z - depths.x) / max(depths.y - depths.x, 1e-30), 0.0, 1.0);
    float away = ${fading.background.toFixed(2)} + ${fading.depth.toFixed(2)} * depth;
    gl_FragColor = vec4(mix(color, background, fading * away), opacity);
  }
`;

/**
 * Triangles without an index, coloured by a value per corner; `range` and `power` are those of `FrontValues`. If `fading` is 1, they are
 * faded between the distances `depths` from the eye. `apart`: how far elements are pulled away from `middle`, by the attribute
 * `ownCentre` of their corners.
 */
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
      plain: { value: new Color() },
      background: { value: new Color() },
      fading: { value: 0 },
      depths: { value: new Vector2(0, 1) },
      opacity: { value: opacity },
      apart: { value: 0 },
      middle: { value: new Vector3() },
      enlarging,
    },
  });
}
