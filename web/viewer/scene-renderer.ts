import {
  type BufferGeometry,
  Mesh,
  MeshBasicMaterial,
  type PerspectiveCamera,
  Scene,
  WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import type { Tile } from "./picture-tiles";
import type { Viewport } from "./scene-state";
import { prepareShaders } from "./shaders";
import { drawsInSoftware } from "./software-drawing";

export interface SceneRendererOptions {
  readonly smoothEdges: boolean;
  readonly onContextLost: () => void;
  readonly onContextRestored: () => void;
}

const maxPixelRatio = 2;
/** Width and height of the buffer in which parts of a picture are drawn; every WebGL 2 has this size. */
const tileBuffer = 2048;
/** Time between two questions whether everything is drawn, in milliseconds. */
const fencePollMs = 10;

/** The scene, and the WebGL context that draws it. Throws if the browser offers no WebGL 2. */
export class SceneRenderer {
  readonly scene = new Scene();
  readonly webgl: WebGLRenderer;
  /** As the canvas: for another buffer, other variants of shaders would be compiled. */
  readonly #hidden = Object.assign(new WebGLRenderTarget(1, 1, { stencilBuffer: true }), {
    isXRRenderTarget: true,
  });
  /** Holds a geometry to be uploaded. The renderer uploads what is visible, although an invisible material draws nothing. */
  readonly #carrier = Object.assign(new Mesh(undefined, new MeshBasicMaterial({ visible: false })), {
    frustumCulled: false,
  });
  readonly #carriers = new Scene().add(this.#carrier);
  readonly #listening = new AbortController();
  /** Device pixels per CSS pixel in full resolution. */
  readonly #fullRatio: number;
  /** Share of the full resolution for a picture that stays: above 1, the browser averages pixels. */
  readonly #sharpScale: number;

  constructor(canvas: HTMLCanvasElement, options: SceneRendererOptions) {
    // Without a graphics processor, several samples a pixel take several times as long in every frame. There, only pictures
    // that stay have smooth edges: they are drawn in a higher resolution.
    const multisampling = options.smoothEdges && !drawsInSoftware();
    this.webgl = new WebGLRenderer({ canvas, antialias: multisampling, alpha: true });
    this.#fullRatio = Math.min(window.devicePixelRatio, maxPixelRatio);
    this.#sharpScale = options.smoothEdges && !multisampling ? maxPixelRatio / this.#fullRatio : 1;
    this.webgl.setPixelRatio(this.#fullRatio);
    this.#hidden.texture.colorSpace = this.webgl.outputColorSpace;
    this.webgl.setClearColor(0x000000, 0);
    // Querying the status of a shader blocks until it is compiled, so do it in development builds only.
    this.webgl.debug.checkShaderErrors = import.meta.env.DEV;
    const { signal } = this.#listening;
    const onLost = (event: Event): void => {
      event.preventDefault();
      options.onContextLost();
    };
    canvas.addEventListener("webglcontextlost", onLost, { signal });
    canvas.addEventListener("webglcontextrestored", options.onContextRestored, { signal });
  }

  /** Compiles all shaders without blocking the page. Drawing before that would wait for them. */
  async prepare(camera: PerspectiveCamera): Promise<void> {
    await prepareShaders(this.webgl, this.scene, camera);
  }

  /**
   * Draws in one pixel beside the canvas. The first drawing uploads buffers and compiles the final variants of shaders. The
   * page does not wait for it: it waits only for what is drawn on the canvas.
   */
  warmUp(camera: PerspectiveCamera): void {
    this.webgl.setRenderTarget(this.#hidden);
    try {
      this.webgl.render(this.scene, camera);
    } finally {
      this.webgl.setRenderTarget(null);
    }
  }

  /** Copies the buffers of a geometry to the GPU, and draws nothing. */
  upload(geometry: BufferGeometry, camera: PerspectiveCamera): void {
    this.#carrier.geometry = geometry;
    this.webgl.setRenderTarget(this.#hidden);
    try {
      this.webgl.render(this.#carriers, camera);
    } finally {
      this.webgl.setRenderTarget(null);
    }
  }

  /** Pixels that are averaged in each direction for a pixel of a picture. */
  get #samples(): number {
    return this.webgl.getContextAttributes().antialias ? 1 : maxPixelRatio;
  }

  /** Largest width and height of a tile, in pixels of the picture. */
  get tileSide(): number {
    return tileBuffer / this.#samples;
  }

  /** Device pixels per CSS pixel in the buffer of a tile, if a CSS pixel has `scale` pixels in the picture. */
  tileRatio(scale: number): number {
    return scale * this.#samples;
  }

  /** Draws a part of a picture. The canvas has another size afterwards: see `resize`. */
  drawTile(paper: CanvasRenderingContext2D, camera: PerspectiveCamera, tile: Tile): void {
    const { width, height } = paper.canvas;
    camera.setViewOffset(width, height, tile.x, tile.y, tile.width, tile.height);
    this.webgl.setPixelRatio(1);
    this.webgl.setSize(tile.width * this.#samples, tile.height * this.#samples, false);
    this.webgl.render(this.scene, camera);
    paper.drawImage(this.webgl.domElement, tile.x, tile.y, tile.width, tile.height);
  }

  /** Resolves when everything is drawn, without blocking the page. */
  async finish(): Promise<void> {
    const gl = this.webgl.getContext();
    const fence =
      gl instanceof WebGL2RenderingContext ? gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0) : null;
    if (!(gl instanceof WebGL2RenderingContext) || !fence) return;
    gl.flush();
    // A lost context counts as finished.
    while (gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.UNSIGNALED)
      await new Promise((resolve) => setTimeout(resolve, fencePollMs));
    gl.deleteSync(fence);
  }

  /** Returns the new viewport. */
  resize(width: number, height: number): Viewport {
    this.webgl.setSize(width, height, false);
    return { width, height, pixelRatio: this.webgl.getPixelRatio(), isHurried: false };
  }

  /** Sets the share of the full resolution. Returns the device pixels per CSS pixel; the canvas is blank if they change. */
  setScale(scale: number): number {
    const ratio = scale * this.#fullRatio;
    if (ratio !== this.webgl.getPixelRatio()) this.webgl.setPixelRatio(ratio);
    return ratio;
  }

  /** Share of the full resolution in which a picture that stays is drawn; at least 1. */
  get sharpScale(): number {
    return this.#sharpScale;
  }

  get isSharp(): boolean {
    return this.webgl.getPixelRatio() === this.#sharpScale * this.#fullRatio;
  }

  render(camera: PerspectiveCamera): void {
    this.webgl.render(this.scene, camera);
  }

  /**
   * Copies the last sharp picture in full resolution, and sets the size of the copy. The picture lasts until the page is
   * drawn.
   *
   * @param background colour behind it; transparent if null.
   */
  copyTo(paper: CanvasRenderingContext2D, background: string | null): void {
    const { domElement } = this.webgl;
    const [width, height] = [domElement.width, domElement.height].map((size) =>
      Math.round(size / this.#sharpScale),
    ) as [number, number];
    const { canvas } = paper;
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    if (background !== null) {
      paper.fillStyle = background;
      paper.fillRect(0, 0, width, height);
    }
    paper.drawImage(domElement, 0, 0, width, height);
  }

  dispose(): void {
    this.#listening.abort();
    this.#hidden.dispose();
    this.webgl.dispose();
  }
}
