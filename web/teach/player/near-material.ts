import { Color, DoubleSide, FrontSide, ShaderMaterial, Vector3 } from "three";
import { enlarging } from "../../viewer/materials/enlarging";
import { edgeStrength, facetLight } from "../../viewer/materials/glsl";

const vertexShader = /* glsl */ `
  attribute float away;
  varying float vDistance;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  void main() {
    int corner = gl_VertexID % 3;
    vBarycentric = vec3(corner == 0, corner == 1, corner == 2);
    vDistance = away;
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    vViewPosition = viewPosition.xyz;
    gl_Position = projectionMatrix * viewPosition;
  }
`;

/** Where the neighbourhood begins to fade, and where it ends, in reaches. */
const fade = "smoothstep(0.5, 1.0, vDistance)";

/** A fragment hides the step if it lies before the sphere around the step, as the eye sees it. */
const hides = /* glsl */ `
  bool hides(vec3 viewPosition) {
    vec3 ray = normalize(viewPosition);
    float along = dot(centre, ray);
    bool isBeside = length(centre - along * ray) > 1.15 * radius;
    return !isBeside && length(viewPosition) < along - 0.7 * radius;
  }
`;

const wallShader = /* glsl */ `
  uniform vec3 rim;
  uniform vec3 hollow;
  uniform vec3 edgeColor;
  uniform vec3 centre;
  uniform float radius;
  uniform float reach;
  uniform float enlarging;
  varying float vDistance;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  ${facetLight}
  ${edgeStrength}
  ${hides}
  void main() {
    if (hides(vViewPosition)) discard;
    float depth = clamp(0.3 + 1.1 * (centre.z - vViewPosition.z) / reach, 0.0, 1.0);
    vec3 color = mix(rim, hollow, depth) * mix(1.0, facetLight(vViewPosition), 0.65);
    color = mix(color, edgeColor, edgeStrength(vBarycentric, 0.7 * enlarging));
    gl_FragColor = vec4(color, 1.0 - ${fade});
  }
`;

const outlineShader = /* glsl */ `
  uniform vec3 outline;
  uniform vec3 centre;
  uniform float radius;
  uniform float enlarging;
  varying float vDistance;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  ${edgeStrength}
  ${hides}
  void main() {
    if (gl_FrontFacing && !hides(vViewPosition)) discard;
    gl_FragColor = vec4(outline, 0.5 * edgeStrength(vBarycentric, 0.6 * enlarging) * (1.0 - ${fade}));
  }
`;

/**
 * Materials of the front near a step. The depth: what lies behind a face is not blended with it where the face fades. The wall: faces that look to the eye, with edges and with depth as colour. The outlines:
 * only the edges of the faces that hide the step, or look away.
 */
export function createNearMaterials(): Record<"depth" | "wall" | "outlines", ShaderMaterial> {
  const common = {
    centre: { value: new Vector3() },
    radius: { value: 1 },
    reach: { value: 1 },
    enlarging,
  };
  const wallOptions = {
    vertexShader,
    fragmentShader: wallShader,
    side: FrontSide,
    transparent: true,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
    uniforms: {
      ...common,
      rim: { value: new Color() },
      hollow: { value: new Color() },
      edgeColor: { value: new Color() },
    },
  } as const;
  const depth = new ShaderMaterial({ ...wallOptions, colorWrite: false });
  const wall = new ShaderMaterial({ ...wallOptions, depthWrite: false });
  const outlines = new ShaderMaterial({
    vertexShader,
    fragmentShader: outlineShader,
    side: DoubleSide,
    transparent: true,
    depthWrite: false,
    depthTest: false,
    uniforms: { ...common, outline: { value: new Color() } },
  });
  return { depth, wall, outlines };
}
