import { Color, ShaderMaterial } from "three";
import { drawStateGlsl, drawStateUniforms, type StateMaterial } from "../draw-state";
import { enlarging } from "./enlarging";
import { culled } from "./glsl";

/** Diameters in CSS pixels. */
const diameters = { normal: 7, hover: 12, selected: 12, defective: 12 };
/** Dots above this diameter are emphasized. */
const maxPlainDiameter = 8;

const vertexShader = /* glsl */ `
  uniform float pixelRatio;
  uniform float enlarging;
  varying vec3 vColor;
  varying float vDiameter;
  ${drawStateGlsl}
  void main() {
    vColor = stateColor();
    vDiameter = stateScale() * enlarging * pixelRatio;
    gl_PointSize = vDiameter;
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    // Moving the dot along the line of sight changes its depth, but not its position on the screen: a surface
    // does not cut a dot on it in half, and an emphasized dot shows through everything in front of it.
    viewPosition.xyz *= stateScale() > ${maxPlainDiameter.toFixed(1)} ? 0.4 : 0.997;
    gl_Position = isDrawn() ? projectionMatrix * viewPosition : ${culled};
    // Not beyond the near plane, which lies shortly before a model that is seen from afar.
    gl_Position.z = max(gl_Position.z, -gl_Position.w);
  }
`;

const fragmentShader = /* glsl */ `
  uniform float square;
  uniform vec3 rim;
  varying vec3 vColor;
  varying float vDiameter;
  void main() {
    vec2 offset = 2.0 * gl_PointCoord - 1.0;
    float reach = mix(length(offset), max(abs(offset.x), abs(offset.y)), square);
    // In a low resolution, a pixel is a large share of the dot, whose rim must not hide its colour. The rim is two of these
    // widths: with at most 0.28, the inner 44 % of the radius keep the colour.
    float pixel = min(2.0 / vDiameter, 0.28);
    float alpha = 1.0 - smoothstep(1.0 - pixel, 1.0, reach);
    if (alpha <= 0.01) discard;
    vec3 color = mix(vColor, rim, smoothstep(1.0 - 2.0 * pixel, 1.0 - pixel, reach));
    gl_FragColor = vec4(color, alpha);
  }
`;

/** Dots of a fixed size on the screen, with a rim that contrasts with the background. */
export function createDotMaterial(shape: "round" | "square"): StateMaterial {
  const uniforms = {
    ...drawStateUniforms(diameters),
    pixelRatio: { value: 1 },
    enlarging,
    square: { value: shape === "square" ? 1 : 0 },
    rim: { value: new Color() },
  };
  const material = new ShaderMaterial({
    vertexShader,
    fragmentShader,
    transparent: true,
    depthWrite: false,
    uniforms,
  });
  return Object.assign(material, { uniforms });
}
