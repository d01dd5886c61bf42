import { Color, DoubleSide, ShaderMaterial } from "three";
import { drawStateGlsl, drawStateUniforms, type StateMaterial } from "../draw-state";
import { culled, edgeStrength, facetLight } from "./glsl";

const vertexShader = /* glsl */ `
  attribute float value;
  attribute float hiddenEdges;
  varying float vValue;
  flat varying float vOfTriangle;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  ${drawStateGlsl}
  void main() {
    int corner = gl_VertexID % 3;
    vBarycentric = vec3(corner == 0, corner == 1, corner == 2);
    // Far from an edge that is not drawn.
    vBarycentric += 2.0 * step(1.0, mod(floor(hiddenEdges / vec3(1.0, 2.0, 4.0)), 2.0));
    vValue = value;
    vOfTriangle = value;
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    vViewPosition = viewPosition.xyz;
    gl_Position = isDrawn() ? projectionMatrix * viewPosition : ${culled};
  }
`;

const fragmentShader = /* glsl */ `
  uniform sampler2D ramp;
  uniform float hues;
  uniform vec3 plainColor;
  uniform vec3 edgeColor;
  uniform float shaded;
  uniform float isPacked;
  uniform float edges;
  varying float vValue;
  // Interpolation would round a packed colour: one less than 0xc00000 is another colour.
  flat varying float vOfTriangle;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  ${facetLight}
  ${edgeStrength}
  void main() {
    bool isIndex = isPacked > 0.0 && vOfTriangle < -0.5;
    float hue = isIndex ? -1.0 - vOfTriangle : vValue;
    float texel = hues > 0.0 ? mod(hue + 0.5, hues) / hues : clamp(vValue, 0.002, 0.998);
    float bits = floor(vOfTriangle + 0.5);
    vec3 unpacked = mod(floor(bits / vec3(65536.0, 256.0, 1.0)), 256.0) / 255.0;
    vec3 given = isPacked > 0.0 && !isIndex ? unpacked : texture2D(ramp, vec2(texel, 0.5)).rgb;
    vec3 color = mix(plainColor, given, shaded);
    color *= facetLight(vViewPosition);
    gl_FragColor = vec4(mix(color, edgeColor, edges * edgeStrength(vBarycentric, 0.6)), 1.0);
  }
`;

/**
 * Triangles of a body without an index, seen from both sides: in one colour, or shaded by a value per corner, a position
 * on a colour ramp, with a palette of `hues` colours the index of a colour, or if `isPacked` a colour itself, or -1 - index.
 */
export function createBodyMaterial(): StateMaterial {
  const uniforms = {
    ...drawStateUniforms({ normal: 1, hover: 1, selected: 1, defective: 1 }),
    ramp: { value: null },
    hues: { value: 0 },
    plainColor: { value: new Color() },
    edgeColor: { value: new Color() },
    shaded: { value: 0 },
    isPacked: { value: 0 },
    edges: { value: 1 },
  };
  const material = new ShaderMaterial({
    vertexShader,
    fragmentShader,
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    uniforms,
  });
  return Object.assign(material, { uniforms });
}
