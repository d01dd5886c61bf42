import type { BufferGeometry, PerspectiveCamera } from "three";
import type { Entity } from "../document/entities";
import { nextTurn } from "../document/slices";
import { entityBounds, roomyBounds } from "./bounds";
import type { Label } from "./apart";
import { ViewCamera, type CameraPose, type StandardView } from "./camera";
import type { ViewerColors } from "./colors";
import { FrameLoop } from "./frame-loop";
import { Framing, type FramedScene } from "./framing";
import type { Hit, Layer } from "./layers/layer";
import { MotionWatch } from "./motion-watch";
import type { MeshQueryClient } from "./queries/mesh-query-client";
import type { Position } from "../document/position";
import { tilesOf } from "./picture-tiles";
import { pointerView, type PointerView } from "./pointer-view";
import { SceneLayers } from "./scene-layers";
import { SceneChanges, type SceneState, type ShownState, type Viewport } from "./scene-state";
import { SceneRenderer } from "./scene-renderer";
import { screenProjection, type ScreenPoint } from "./screen";
import { cubeArea } from "./view-cube";

export interface ViewerEvents {
  readonly onFrame: (frames: number) => void;
  /** Number of mesh faces drawn; `isCurrent` if they are the ones to draw. */
  readonly onFaces: (drawn: number, isCurrent: boolean) => void;
  readonly onFailure: (reason: string) => void;
  readonly onContextLost: () => void;
  readonly onContextRestored: () => void;
}

export interface ViewerOptions {
  /** What is shown at first. */
  readonly state: ShownState;
  readonly colors: ViewerColors;
  /** If false, the camera jumps instead of gliding. */
  readonly motion: boolean;
  readonly smoothEdges: boolean;
  /** If true, a motion that is drawn too slowly is drawn in a lower resolution. */
  readonly adaptiveResolution: boolean;
  /** Width that is covered at the left at first, in CSS pixels. */
  readonly coveredLeft: number;
  readonly meshQueries: MeshQueryClient;
  readonly events: ViewerEvents;
}

/** A view without a new frame for this time has been drawn as it stays, in milliseconds: see MotionWatch. */
const quietMs = 250;
/** Longest time for which frames wait for shaders. */
const longestPreparationMs = 5000;

/**
 * The three-dimensional view: an imperative object outside React. It draws on request, when something has changed.
 * Throws if the browser offers no WebGL 2.
 */
export class Viewer {
  readonly #container: HTMLElement;
  readonly #options: ViewerOptions;
  readonly #renderer: SceneRenderer;
  readonly #view: ViewCamera;
  /** What the camera is fitted to. */
  readonly framing: Framing;
  readonly #loop: FrameLoop;
  readonly #motion = new MotionWatch(() => this.#sharpen());
  #isDisposed = false;
  #isPreparing = false;
  /** Whether the next frame is the last one of a motion. */
  #isResting = false;
  readonly #movedListeners = new Set<() => void>();
  readonly #layers: SceneLayers;
  readonly #observer: ResizeObserver;
  #state: SceneState;

  constructor(container: HTMLElement, canvas: HTMLCanvasElement, options: ViewerOptions) {
    const { events } = options;
    this.#container = container;
    this.#options = options;
    this.#renderer = new SceneRenderer(canvas, {
      smoothEdges: options.smoothEdges,
      onContextLost: events.onContextLost,
      onContextRestored: () => {
        events.onContextRestored();
        this.#loop.request();
      },
    });
    this.#view = new ViewCamera(canvas, options.motion);
    this.#loop = new FrameLoop((seconds) => this.#draw(seconds));
    this.#loop.onDrawn(() => events.onFrame(this.#loop.frames));
    this.#layers = new SceneLayers(this.#renderer.scene, options.meshQueries, {
      onChange: () => this.#meshChanged(),
      onFailure: events.onFailure,
    });
    const viewport = { width: 1, height: 1, pixelRatio: 1, isHurried: false };
    const origin = roomyBounds(options.state.project, options.state.bodies).centre;
    const { state, colors } = options;
    this.#state = { ...state, colors, origin, viewport, isOtherModel: false };
    this.#updateLayers(null);
    this.framing = new Framing(this.#view, this.#framedScene(), options.motion, options.coveredLeft);
    this.#view.controls.addEventListener("control", () => this.#loop.request());
    this.#view.controls.addEventListener("controlstart", () => this.#userMoved());
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(container);
    this.#resize();
    this.framing.reset();
    void this.#start();
  }

  setColors(colors: ViewerColors): void {
    this.#update({ colors });
  }

  /** Shows a new state. The camera follows a model that has grown beyond the view. */
  show(change: Partial<ShownState>): void {
    const before = this.#state;
    const parts = Object.keys(change) as (keyof ShownState)[];
    if (parts.every((part) => change[part] === before[part])) return;
    this.#update(change);
    this.#view.leftOrbits = this.#state.leftDrag === "orbit";
    const { project, bodies, preview } = this.#state;
    const isOther = project !== before.project || bodies !== before.bodies || preview !== before.preview;
    if (isOther) this.framing.followModel();
  }

  /** Sets the width that is covered at the left, in CSS pixels. What was in view stays in view, in the part that is free. */
  setCoveredLeft(width: number): void {
    if (width !== this.framing.coveredLeft) this.#resize(width);
  }

  /** Calls back when the user moves the camera, or a link sets it. Returns a function that ends this. */
  onUserMoved(listener: () => void): () => void {
    this.#movedListeners.add(listener);
    return () => this.#movedListeners.delete(listener);
  }

  #userMoved(): void {
    for (const listener of this.#movedListeners) listener();
  }

  look(view: StandardView): void {
    this.#userMoved();
    this.#view.look(view, this.#options.motion);
    this.framing.fit(null);
  }

  /** Looks from a direction, at the same position and distance. */
  lookFrom(direction: Position): void {
    this.#userMoved();
    this.#view.lookFrom(direction, this.#options.motion);
    this.#loop.request();
  }

  /** Where the camera is and what it looks at, in the coordinates of the model. */
  get pose(): CameraPose {
    const { eye, target } = this.#view.pose;
    const { origin } = this.#state;
    return { eye: moved(eye, origin, 1), target: moved(target, origin, 1) };
  }

  setPose({ eye, target }: CameraPose): void {
    this.#userMoved();
    const { origin } = this.#state;
    this.#view.setPose({ eye: moved(eye, origin, -1), target: moved(target, origin, -1) });
    this.#loop.request();
  }

  /** Rotates by angles in degrees. */
  rotate(azimuth: number, polar: number): void {
    this.#userMoved();
    this.#view.rotate(azimuth, polar, this.#options.motion);
    this.#loop.request();
  }

  /** Moves sideways, by fractions of the distance to the target. */
  pan(right: number, down: number): void {
    this.#userMoved();
    this.#view.pan(right, down, this.#options.motion);
    this.#loop.request();
  }

  zoom(factor: number): void {
    this.#userMoved();
    this.#view.zoom(factor, this.#options.motion);
    this.#loop.request();
  }

  /** Returns what lies at a point of the view. */
  hit(at: ScreenPoint): Hit | null {
    return this.#layers.hit(this.#view.camera, this.#state.viewport, at);
  }

  /** Returns the entities at a point of the view, the uppermost first. */
  entitiesAt(at: ScreenPoint): Entity[] {
    return this.#layers.entitiesAt(this.#view.camera, this.#state.viewport, at);
  }

  /** Returns the view as seen from a position of the pointer. */
  seenFrom(at: ScreenPoint): PointerView {
    return pointerView(this.#view.camera, this.#state.viewport, this.#state.origin, at);
  }

  /** Length in the model that appears as one CSS pixel at the distance of the target. */
  get pixelLength(): number {
    return this.#view.heightAtTarget / this.#state.viewport.height;
  }

  /** Returns where a position appears, also beside the view; null if it lies behind the eye or too far away. */
  toScreen(position: Position): ScreenPoint | null {
    const { origin, viewport } = this.#state;
    return screenProjection(this.#view.camera, viewport, origin)(position);
  }

  /**
   * Returns where the middle of an entity appears, also beside the view; null if it lies behind the eye or too far away, or does
   * not exist.
   */
  entityOnScreen(entity: Entity): ScreenPoint | null {
    const { project, preview, bodies } = this.#state;
    const bounds = entityBounds(entity, project, preview, bodies);
    return bounds.empty ? null : this.toScreen(bounds.centre);
  }

  /** Adds a layer on top of the others, which the viewer then updates. Returns a function that removes and disposes it. */
  addLayer(layer: Layer): () => void {
    const remove = this.#layers.add(layer, new SceneChanges(this.#state, null));
    this.#loop.request();
    return () => {
      remove();
      this.#loop.request();
    };
  }

  /**
   * Makes ready what layers show only later, so that its first frame takes no longer than others: compiles their shaders,
   * also those of hidden ones, and draws every state once, out of sight. Each of `states` shows one, and `restore` the
   * present one again. Ends early if `signal` is aborted.
   *
   * The page does not wait for any of this: the next frame is drawn when the shaders are compiled, and the states while the
   * view is at rest, one after the other.
   */
  async warmUp(states: readonly (() => void)[], restore: () => void, signal: AbortSignal): Promise<void> {
    await this.#loop.waitFor(this.#untilPrepared(signal));
    for (const show of states) {
      const isEnded = (): boolean => signal.aborted || this.#isDisposed;
      while (!isEnded() && this.#loop.restedMs < quietMs)
        await new Promise((resolve) => setTimeout(resolve, quietMs / 5));
      if (isEnded()) return;
      try {
        show();
        this.#renderer.warmUp(this.#view.camera);
      } finally {
        restore();
      }
      await this.#renderer.finish();
    }
  }

  /** Compiles shaders. Ends early if `signal` is aborted: three.js waits forever if a material is disposed of meanwhile. */
  async #untilPrepared(signal: AbortSignal): Promise<void> {
    if (signal.aborted) return;
    const prepared = this.#renderer.prepare(this.#view.camera);
    const ended = new Promise<void>((resolve) => {
      signal.addEventListener("abort", () => resolve(), { once: true });
      setTimeout(resolve, longestPreparationMs);
    });
    await Promise.race([prepared, ended]);
  }

  get camera(): PerspectiveCamera {
    return this.#view.camera;
  }

  /** Width and height in CSS pixels. */
  get size(): Pick<Viewport, "width" | "height"> {
    return this.#state.viewport;
  }

  /** Where labels can be seen, in CSS pixels. */
  get labelArea(): { readonly width: number; readonly height: number; readonly coveredLeft: number } {
    return { ...this.size, coveredLeft: this.framing.coveredLeft };
  }

  /** The square under the view cube. */
  get cubeArea(): Label {
    return cubeArea(this.size.width);
  }

  /** Draws again, after a layer has changed by itself. */
  requestFrame(): void {
    this.#loop.request();
  }

  /**
   * Returns the picture as a PNG file with a transparent background. `add` draws on it; its pixels
   * are those of the screen.
   */
  picture(add: (paper: CanvasRenderingContext2D) => void = () => undefined): Promise<Blob> {
    const paper = document.createElement("canvas").getContext("2d");
    if (!paper) throw new Error("The browser offers no canvas");
    this.drawOn(paper, null);
    add(paper);
    return new Promise((resolve, reject) => {
      paper.canvas.toBlob((blob) => {
        if (blob) resolve(blob);
        else reject(new Error("The browser cannot write this picture"));
      }, "image/png");
    });
  }

  /** Returns the picture as it is drawn now, for another thread: the page does not wait for it. */
  bitmap(): Promise<ImageBitmap> {
    this.#drawWithoutCube();
    return createImageBitmap(this.#renderer.webgl.domElement);
  }

  /** Draws the picture now, on a canvas of the same size; by default on the background of the page. */
  drawOn(
    paper: CanvasRenderingContext2D,
    background: string | null = getComputedStyle(document.body).backgroundColor,
  ): void {
    this.#drawWithoutCube();
    this.#renderer.copyTo(paper, background);
  }

  /** Draws a picture on the canvas, for a copy. The next frame shows the view cube again before the page is drawn. */
  #drawWithoutCube(): void {
    this.#setScale(this.#renderer.sharpScale);
    this.#renderer.render(this.#view.camera);
    this.#loop.request();
  }

  /**
   * Draws the view over what is on a canvas of any size. Lines and points are as wide as in the view, relative to the model.
   * Returns the number of pixels for a CSS pixel of the view; the middle of its free part is in the middle of the picture.
   */
  drawSized(paper: CanvasRenderingContext2D, { axes }: { readonly axes: boolean }): number {
    const { width, height } = paper.canvas;
    const { viewport } = this.#state;
    const { camera } = this.#view;
    const hadRatio = this.#renderer.webgl.getPixelRatio();
    const restore = this.#view.frame(width / height);
    const scale = (height * camera.zoom) / viewport.height;
    this.#layers.axes.root.visible = axes;
    try {
      for (const tile of tilesOf({ width, height }, this.#renderer.tileSide)) {
        const [across, down] = [tile.width / scale, tile.height / scale];
        const pixelRatio = this.#renderer.tileRatio(scale);
        this.#setViewport({ width: across, height: down, pixelRatio, isHurried: false });
        this.#renderer.drawTile(paper, camera, tile);
      }
      return scale;
    } finally {
      restore();
      this.#layers.axes.root.visible = true;
      this.#renderer.webgl.setPixelRatio(hadRatio);
      this.#renderer.resize(viewport.width, viewport.height);
      this.#setViewport(viewport);
      this.#loop.drawNow();
    }
  }

  /** Calls back after every frame. Returns a function that ends this. */
  onDrawn(listener: () => void): () => void {
    return this.#loop.onDrawn(listener);
  }

  dispose(): void {
    this.#isDisposed = true;
    this.#loop.stop();
    this.#motion.stop();
    this.#observer.disconnect();
    this.#layers.dispose();
    this.#view.dispose();
    this.#renderer.dispose();
  }

  #framedScene(): FramedScene {
    const state = (): SceneState => this.#state;
    return {
      get state() {
        return state();
      },
      update: (change) => this.#update(change),
      request: () => this.#loop.request(),
    };
  }

  #update(change: Partial<SceneState>): void {
    const before = this.#state;
    this.#state = { ...before, ...change };
    this.#updateLayers(before);
    this.#loop.request();
  }

  #updateLayers(before: SceneState | null): void {
    this.#layers.update(new SceneChanges(this.#state, before));
    if (before) void this.#prepareLayers();
  }

  /** Uploads a large front in pieces, each in a task of its own. */
  async #prepareLayers(): Promise<void> {
    if (this.#isPreparing) return;
    this.#isPreparing = true;
    const upload = (geometry: BufferGeometry): void => this.#renderer.upload(geometry, this.#view.camera);
    for (;;) {
      const done = this.#isDisposed ? "nothing" : this.#layers.prepareMore(upload);
      if (done === "nothing") break;
      if (done === "shown") this.#loop.request();
      await nextTurn();
    }
    this.#isPreparing = false;
  }

  /** Drawing before the shaders are compiled would wait for them. */
  async #start(): Promise<void> {
    await this.#renderer.prepare(this.#view.camera);
    if (!this.#isDisposed) this.#loop.start();
  }

  #resize(coveredLeft = this.framing.coveredLeft): void {
    const { clientWidth: width, clientHeight: height } = this.#container;
    const viewport = width === 0 || height === 0 ? null : this.#renderer.resize(width, height);
    this.framing.resize(viewport, coveredLeft);
    if (!viewport) return;
    // Draw at once: the canvas is blank after a change of its size.
    this.#loop.drawNow();
  }

  #setScale(scale: number): void {
    const { viewport } = this.#state;
    const pixelRatio = this.#renderer.setScale(scale);
    if (pixelRatio !== viewport.pixelRatio)
      this.#setViewport({ ...viewport, pixelRatio, isHurried: scale < 1 });
  }

  #setViewport(viewport: Viewport): void {
    const before = this.#state;
    this.#state = { ...before, viewport };
    this.#updateLayers(before);
  }

  /** After a motion, draws the last frame again as a picture that stays. */
  #sharpen(): void {
    if (this.#renderer.isSharp) return;
    this.#isResting = true;
    this.#loop.request();
  }

  #meshChanged(): void {
    this.#options.events.onFaces(this.#layers.mesh.faceCount, this.#layers.mesh.isCurrent);
    this.#loop.request();
  }

  #draw(seconds: number): boolean {
    this.#layers.mesh.queryFaces();
    if (this.#options.adaptiveResolution)
      this.#setScale(this.#isResting ? this.#renderer.sharpScale : this.#motion.nextFrame());
    this.#isResting = false;
    const isMoving = this.#view.update(seconds);
    this.#renderer.render(this.#view.camera);
    const isGrowing = this.#layers.drawMore();
    return isMoving || isGrowing;
  }
}

function moved([x, y, z]: Position, [dx, dy, dz]: Position, sign: 1 | -1): Position {
  return [x + sign * dx, y + sign * dy, z + sign * dz];
}
