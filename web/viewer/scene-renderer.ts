import { Scene, WebGLRenderer, type PerspectiveCamera } from "three";
import type { Viewport } from "./scene-state";
import { prepareShaders } from "./shaders";

export interface SceneRendererOptions {
  readonly multisampling: boolean;
  readonly onContextLost: () => void;
  readonly onContextRestored: () => void;
}

const maxPixelRatio = 2;

/** The scene, and the WebGL context that draws it. Throws if the browser offers no WebGL 2. */
export class SceneRenderer {
  readonly scene = new Scene();
  readonly webgl: WebGLRenderer;
  readonly #listening = new AbortController();
  /** Device pixels per CSS pixel in full resolution. */
  readonly #fullRatio: number;

  constructor(canvas: HTMLCanvasElement, options: SceneRendererOptions) {
    this.webgl = new WebGLRenderer({ canvas, antialias: options.multisampling, alpha: true });
    this.#fullRatio = Math.min(window.devicePixelRatio, maxPixelRatio);
    this.webgl.setPixelRatio(this.#fullRatio);
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

  /** Returns the new viewport. */
  resize(width: number, height: number): Viewport {
    this.webgl.setSize(width, height, false);
    return { width, height, pixelRatio: this.webgl.getPixelRatio() };
  }

  /** Sets the share of the full resolution. Returns the device pixels per CSS pixel; the canvas is blank if they change. */
  setScale(scale: number): number {
    const ratio = scale * this.#fullRatio;
    if (ratio !== this.webgl.getPixelRatio()) this.webgl.setPixelRatio(ratio);
    return ratio;
  }

  get isFull(): boolean {
    return this.webgl.getPixelRatio() === this.#fullRatio;
  }

  get canvas(): HTMLCanvasElement {
    return this.webgl.domElement;
  }

  /** Returns a new picture as a PNG file. */
  picture(camera: PerspectiveCamera): Promise<Blob> {
    this.render(camera);
    return new Promise((resolve, reject) => {
      // The picture is taken at once: the canvas is empty after the page is drawn.
      this.canvas.toBlob((blob) => {
        if (blob) resolve(blob);
        else reject(new Error("The browser cannot write this picture"));
      }, "image/png");
    });
  }

  render(camera: PerspectiveCamera): void {
    this.webgl.render(this.scene, camera);
  }

  dispose(): void {
    this.#listening.abort();
    this.webgl.dispose();
  }
}
