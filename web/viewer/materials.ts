import {
  Color,
  DataTexture,
  DoubleSide,
  FrontSide,
  LinearFilter,
  NearestFilter,
  RGBAFormat,
  ShaderMaterial,
  UnsignedByteType,
  type MagnificationTextureFilter,
  type Side,
  type Texture,
} from "three";

/**
 * All shaders work in display (sRGB) values, so that a theme colour arrives on the screen as written.
 * The light sits at the camera: faces turned to the viewer are brightest, which reads well from
 * everywhere and needs no set-up.
 */

/** A theme colour without three's conversion to linear light. */
export function displayColor(css: string): Color {
  const color = new Color();
  color.setStyle(css);
  return color.convertLinearToSRGB();
}

const rampLength = 256;

/** The ramp as a one-row texture, linearly interpolated between its colours. */
export function rampTexture(colors: readonly string[]): DataTexture {
  const stops = colors.map(displayColor);
  const data = new Uint8Array(4 * rampLength);
  const mixed = new Color();
  for (let i = 0; i < rampLength; ++i) {
    const place = (i / (rampLength - 1)) * (stops.length - 1);
    const low = Math.min(Math.floor(place), stops.length - 2);
    mixed.copy(stops[low] ?? mixed).lerp(stops[low + 1] ?? mixed, place - low);
    data.set([mixed.r * 255, mixed.g * 255, mixed.b * 255, 255], 4 * i);
  }
  return rowTexture(data, LinearFilter);
}

/** Colours side by side in a one-row texture, one texel each. */
export function paletteTexture(colors: readonly string[]): DataTexture {
  const data = colors.map(displayColor).flatMap(({ r, g, b }) => [r * 255, g * 255, b * 255, 255]);
  return rowTexture(Uint8Array.from(data, Math.round), NearestFilter);
}

function rowTexture(data: Uint8Array<ArrayBuffer>, filter: MagnificationTextureFilter): DataTexture {
  const texture = new DataTexture(data, data.length / 4, 1, RGBAFormat, UnsignedByteType);
  texture.minFilter = filter;
  texture.magFilter = filter;
  texture.needsUpdate = true;
  return texture;
}

/** Flat normal from the screen derivatives of the position: no normals to store or update. */
const facetLight = /* glsl */ `
  float facetLight(vec3 viewPosition) {
    vec3 normal = normalize(cross(dFdx(viewPosition), dFdy(viewPosition)));
    vec3 toEye = normalize(-viewPosition);
    vec3 keyLight = normalize(vec3(-0.35, 0.55, 0.75));
    return 0.42 + 0.38 * abs(dot(normal, toEye)) + 0.26 * max(dot(normal, keyLight), 0.0);
  }
`;

const meshVertex = /* glsl */ `
  attribute float value;
  varying float vValue;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  void main() {
    int corner = gl_VertexID % 3;
    vBarycentric = vec3(corner == 0, corner == 1, corner == 2);
    vValue = value;
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    vViewPosition = viewPosition.xyz;
    gl_Position = projectionMatrix * viewPosition;
  }
`;

const meshFragment = /* glsl */ `
  uniform sampler2D ramp;
  uniform float hues;
  uniform vec3 plainColor;
  uniform vec3 edgeColor;
  uniform vec3 fadedColor;
  uniform float shaded;
  uniform float edges;
  uniform float edgeWidth;
  uniform float fading;
  varying float vValue;
  varying vec3 vViewPosition;
  varying vec3 vBarycentric;
  ${facetLight}
  void main() {
    float place = hues > 0.0 ? mod(vValue + 0.5, hues) / hues : clamp(vValue, 0.002, 0.998);
    vec3 color = mix(plainColor, texture2D(ramp, vec2(place, 0.5)).rgb, shaded);
    color *= facetLight(vViewPosition);
    vec3 spread = fwidth(vBarycentric);
    vec3 inside = smoothstep(spread * (edgeWidth - 0.5), spread * (edgeWidth + 0.5), vBarycentric);
    // Where elements shrink to a few pixels their edges would cover all; they fade out instead.
    float density = max(spread.x, max(spread.y, spread.z));
    float strength = edges * (1.0 - smoothstep(0.22, 0.6, density)) * 0.8;
    color = mix(color, edgeColor, strength * (1.0 - min(inside.x, min(inside.y, inside.z))));
    gl_FragColor = vec4(mix(color, fadedColor, fading), 1.0);
  }
`;

/**
 * Faces of tetrahedra: shaded by a value per corner, with element edges drawn in the same pass. The value is a
 * place on the ramp, from 0 to 1, or, where the ramp is a palette of `hues` colours, one of these by its number.
 */
export function createMeshMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: meshVertex,
    fragmentShader: meshFragment,
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
      edgeWidth: { value: 0.6 },
      fading: { value: 0 },
    },
  });
}

const facetVertex = /* glsl */ `
  varying vec3 vViewPosition;
  void main() {
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    vViewPosition = viewPosition.xyz;
    gl_Position = projectionMatrix * viewPosition;
  }
`;

const facetFragment = /* glsl */ `
  uniform vec3 color;
  uniform float opacity;
  varying vec3 vViewPosition;
  ${facetLight}
  void main() {
    gl_FragColor = vec4(color * facetLight(vViewPosition), opacity);
  }
`;

export interface FacetOptions {
  readonly opacity: number;
  readonly depthWrite?: boolean;
  readonly depthTest?: boolean;
  readonly polygonOffset?: number;
  readonly side?: Side;
}

/** Evenly coloured surfaces: patches, highlights, the remaining front. */
export function createFacetMaterial(options: FacetOptions): ShaderMaterial {
  const { opacity, depthWrite = false, depthTest = true, polygonOffset = 0, side = DoubleSide } = options;
  return new ShaderMaterial({
    vertexShader: facetVertex,
    fragmentShader: facetFragment,
    side,
    transparent: opacity < 1,
    depthWrite,
    depthTest,
    polygonOffset: polygonOffset !== 0,
    polygonOffsetFactor: polygonOffset,
    polygonOffsetUnits: polygonOffset,
    uniforms: { color: { value: new Color() }, opacity: { value: opacity } },
  });
}

/** Dots above this diameter in pixels are marked ones. */
const largestPlainDot = 8;

const dotVertex = /* glsl */ `
  attribute vec3 tint;
  attribute float diameter;
  uniform float pixelRatio;
  varying vec3 vTint;
  varying float vDiameter;
  void main() {
    vTint = tint;
    vDiameter = diameter * pixelRatio;
    gl_PointSize = vDiameter;
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    // Nearer along the line of sight, the picture is the same but the depth is not: a dot on a surface
    // is not cut in half by it, and a marked one shows through what lies before it.
    viewPosition.xyz *= diameter > ${largestPlainDot.toFixed(1)} ? 0.4 : 0.997;
    gl_Position = projectionMatrix * viewPosition;
  }
`;

const dotFragment = /* glsl */ `
  uniform float square;
  uniform vec3 rim;
  varying vec3 vTint;
  varying float vDiameter;
  void main() {
    vec2 place = 2.0 * gl_PointCoord - 1.0;
    float reach = mix(length(place), max(abs(place.x), abs(place.y)), square);
    float pixel = 2.0 / vDiameter;
    float alpha = 1.0 - smoothstep(1.0 - pixel, 1.0, reach);
    if (alpha <= 0.01) discard;
    vec3 color = mix(vTint, rim, smoothstep(1.0 - 3.0 * pixel, 1.0 - 2.0 * pixel, reach));
    gl_FragColor = vec4(color, alpha);
  }
`;

/** Dots of a fixed size on the screen, with a rim that sets them off from what lies behind. */
export function createDotMaterial(shape: "round" | "square"): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: dotVertex,
    fragmentShader: dotFragment,
    transparent: true,
    depthWrite: false,
    uniforms: {
      pixelRatio: { value: 1 },
      square: { value: shape === "square" ? 1 : 0 },
      rim: { value: new Color() },
    },
  });
}

const groundVertex = /* glsl */ `
  varying vec2 vPlace;
  void main() {
    vPlace = position.xy;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }
`;

const groundFragment = /* glsl */ `
  uniform vec3 color;
  uniform float reach;
  varying vec2 vPlace;
  void main() {
    float fade = 1.0 - smoothstep(0.15, 1.0, length(vPlace) / reach);
    gl_FragColor = vec4(color, 0.4 * fade);
  }
`;

/** Lines of the ground grid, fading out with the distance from the model. */
export function createGroundMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: groundVertex,
    fragmentShader: groundFragment,
    transparent: true,
    depthWrite: false,
    uniforms: { color: { value: new Color() }, reach: { value: 1 } },
  });
}

/** Sets a colour uniform from a theme colour. */
export function setColor(material: ShaderMaterial, uniform: string, css: string): void {
  const target = material.uniforms[uniform];
  if (target?.value instanceof Color) target.value.copy(displayColor(css));
}

export function setTexture(material: ShaderMaterial, uniform: string, value: Texture | null): void {
  const target = material.uniforms[uniform];
  if (target) target.value = value;
}

export function setNumber(material: ShaderMaterial, uniform: string, value: number): void {
  const target = material.uniforms[uniform];
  if (target) target.value = value;
}
