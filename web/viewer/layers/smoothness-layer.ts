import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Mesh, ShaderMaterial } from "three";
import { entityKey } from "../../document/entities";
import type { ShownSmoothness } from "../../session/smoothness-feed";
import type { SceneChanges } from "../scene-state";
import type { Layer } from "./layer";

const vertexShader = /* glsl */ `
  attribute float value;
  varying vec3 vNormal;
  varying vec3 vToEye;
  varying float vValue;
  void main() {
    vec4 viewPosition = modelViewMatrix * vec4(position, 1.0);
    vNormal = normalMatrix * normal;
    vToEye = -viewPosition.xyz;
    vValue = value;
    gl_Position = projectionMatrix * viewPosition;
  }
`;

/**
 * Zebra stripes are the reflections of parallel lights in a mirror: a kink of the surface interrupts them, and where only the
 * curvature jumps they have a kink. The lights are fixed to the view, so that they move over the surface with the camera.
 */
const fragmentShader = /* glsl */ `
  uniform bool isZebra;
  uniform vec3 ramp[9];
  varying vec3 vNormal;
  varying vec3 vToEye;
  varying float vValue;
  const float stripes = 9.0;
  void main() {
    vec3 eye = normalize(vToEye);
    vec3 n = normalize(vNormal);
    if (dot(n, eye) < 0.0) n = -n;
    if (isZebra) {
      vec3 mirrored = reflect(-eye, n);
      float angle = asin(clamp(mirrored.y, -1.0, 1.0)) * stripes;
      float width = max(fwidth(angle), 1e-4);
      float stripe = smoothstep(-width, width, sin(2.0 * angle));
      gl_FragColor = vec4(mix(vec3(0.06, 0.07, 0.09), vec3(0.93), stripe), 1.0);
    } else {
      float at = clamp(vValue, 0.0, 1.0) * 8.0;
      int low = int(min(floor(at), 7.0));
      vec3 color = mix(ramp[low], ramp[low + 1], at - float(low));
      gl_FragColor = vec4(color * (0.55 + 0.45 * abs(dot(n, eye))), 1.0);
    }
    #include <colorspace_fragment>
  }
`;

/** Number of colours of the ramp in the shader. */
const rampColors = 9;

/** The patches with zebra stripes, or coloured by their curvature, by their own normals. */
export class SmoothnessLayer implements Layer {
  readonly root = new Group();
  readonly #material = new ShaderMaterial({
    vertexShader,
    fragmentShader,
    side: DoubleSide,
    uniforms: {
      isZebra: { value: false },
      ramp: { value: Array.from({ length: rampColors }, () => new Color()) },
    },
  });
  readonly #patches = new Mesh(new BufferGeometry(), this.#material);

  constructor() {
    this.#patches.frustumCulled = false;
    this.root.add(this.#patches);
  }

  update(changes: SceneChanges): void {
    const { shownSmoothness: shown, origin, colors, hidden, project } = changes.state;
    this.root.visible = shown !== null;
    if (!shown || !changes.has("shownSmoothness", "origin", "colors", "hidden")) return;
    const { isZebra, ramp } = this.#material.uniforms;
    if (isZebra) isZebra.value = shown.by === "zebra";
    if (ramp) ramp.value = rampOf(colors.ramp);
    const { points, normals, triangles, patchOffsets } = shown.samples;
    const local = Float32Array.from(points, (x, i) => x - (origin[i % 3] ?? 0));
    const drawn = project.patches.flatMap(({ id }, p) =>
      hidden.has(entityKey({ kind: "patch", id }))
        ? []
        : [triangles.subarray(3 * (patchOffsets[p] ?? 0), 3 * (patchOffsets[p + 1] ?? 0))],
    );
    const index = new Uint32Array(drawn.reduce((sum, one) => sum + one.length, 0));
    let end = 0;
    for (const one of drawn) {
      index.set(one, end);
      end += one.length;
    }
    this.#patches.geometry.dispose();
    this.#patches.geometry = new BufferGeometry()
      .setAttribute("position", new BufferAttribute(local, 3))
      .setAttribute("normal", new BufferAttribute(Float32Array.from(normals), 3))
      .setAttribute("value", new BufferAttribute(scaledValues(shown), 1))
      .setIndex(new BufferAttribute(index, 1));
  }

  dispose(): void {
    this.#patches.geometry.dispose();
    this.#material.dispose();
  }
}

/** Returns the curvatures as shares of the colour scale; in the middle if it has no extent. */
export function scaledValues({
  samples,
  by,
  range: [low, high],
}: ShownSmoothness): Float32Array<ArrayBuffer> {
  const values = by === "gaussian" ? samples.gaussian : samples.largest;
  return Float32Array.from(values, (value) => (high > low ? (value - low) / (high - low) : 0.5));
}

/** Returns colours evenly spaced along a ramp. */
function rampOf(colors: readonly string[]): Color[] {
  return Array.from({ length: rampColors }, (_, i) => {
    const at = (i / (rampColors - 1)) * (colors.length - 1);
    const [first, second] = [colors[Math.floor(at)], colors[Math.ceil(at)]];
    return new Color(first).lerp(new Color(second), at - Math.floor(at));
  });
}
