import {
  CustomBlending,
  Mesh,
  NearestFilter,
  OneFactor,
  OneMinusSrcAlphaFactor,
  OrthographicCamera,
  PlaneGeometry,
  ShaderMaterial,
  Vector2,
  WebGLRenderTarget,
  type Camera,
  type Object3D,
  type WebGLRenderer,
} from "three";
import { prepareShaders } from "./shaders";

const vertexShader = /* glsl */ `
  void main() {
    gl_Position = vec4(position.xy, 0.0, 1.0);
  }
`;

const fragmentShader = /* glsl */ `
  uniform sampler2D picture;
  uniform vec2 corner;
  void main() {
    gl_FragColor = texelFetch(picture, ivec2(gl_FragCoord.xy - corner), 0);
  }
`;

/** A square at the top right of the canvas, in CSS pixels. */
interface Square {
  readonly size: number;
  /** Distance from the two sides. */
  readonly offset: number;
}

/** A picture of a scene that is drawn once, pixel by pixel as on the canvas, and then shown there in every frame. */
export class KeptPicture {
  readonly #renderer: WebGLRenderer;
  readonly #square: Square;
  readonly #target: WebGLRenderTarget;
  /** In device pixels. */
  readonly #corner = new Vector2();
  readonly #material: ShaderMaterial;
  readonly #paper: Mesh;
  readonly #camera = new OrthographicCamera();

  constructor(renderer: WebGLRenderer, square: Square) {
    this.#renderer = renderer;
    this.#square = square;
    // The buffer has the format of the canvas, so that the shaders need no other variants.
    this.#target = Object.assign(
      new WebGLRenderTarget(1, 1, {
        magFilter: NearestFilter,
        minFilter: NearestFilter,
        resolveDepthBuffer: false,
        samples: renderer.getContext().getContextAttributes()?.antialias === true ? 4 : 0,
      }),
      { isXRRenderTarget: true },
    );
    this.#target.texture.colorSpace = renderer.outputColorSpace;
    // The buffer with several samples per pixel has this format, and is copied into the texture: both must be equal.
    this.#target.texture.internalFormat = "RGBA8";
    this.#material = new ShaderMaterial({
      vertexShader,
      fragmentShader,
      transparent: true,
      depthTest: false,
      depthWrite: false,
      // The colours of the picture are multiplied by its opacity.
      blending: CustomBlending,
      blendSrc: OneFactor,
      blendDst: OneMinusSrcAlphaFactor,
      uniforms: { picture: { value: this.#target.texture }, corner: { value: this.#corner } },
    });
    this.#paper = new Mesh(new PlaneGeometry(2, 2), this.#material);
    this.#paper.frustumCulled = false;
  }

  /** Compiles the shader that shows the picture. */
  async prepare(): Promise<void> {
    await prepareShaders(this.#renderer, this.#paper, this.#camera);
  }

  /** Draws the picture, in the present resolution of the canvas. */
  draw(scene: Object3D, camera: Camera): void {
    const width = Math.round(this.#square.size * this.#renderer.getPixelRatio());
    this.#target.setSize(width, width);
    this.#renderer.setRenderTarget(this.#target);
    try {
      this.#renderer.render(scene, camera);
    } finally {
      this.#renderer.setRenderTarget(null);
    }
  }

  /** Shows the picture on the canvas, over what is drawn there. */
  show(): void {
    const renderer = this.#renderer;
    const { size, offset } = this.#square;
    const { x: width, y: height } = renderer.getSize(new Vector2());
    const { autoClear } = renderer;
    const [left, bottom] = [width - offset - size, height - offset - size];
    renderer.autoClear = false;
    renderer.setViewport(left, bottom, size, size);
    // The renderer rounds its viewport in the same way.
    this.#corner.set(left, bottom).multiplyScalar(renderer.getPixelRatio()).round();
    try {
      renderer.render(this.#paper, this.#camera);
    } finally {
      renderer.setViewport(0, 0, width, height);
      renderer.autoClear = autoClear;
    }
  }

  dispose(): void {
    this.#target.dispose();
    this.#paper.geometry.dispose();
    this.#material.dispose();
  }
}
