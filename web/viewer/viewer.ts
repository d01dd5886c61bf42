import type { PerspectiveCamera } from "three";
import type { Entity } from "../document/entities";
import { areAlike, Bounds, boundsOf, entityBounds, projectBounds, shownBounds, roomyBounds } from "./bounds";
import { ViewCamera, type CameraPose, type StandardView } from "./camera";
import { closeUpBox } from "./close-up";
import type { ViewerColors } from "./colors";
import { FrameLoop } from "./frame-loop";
import { elementCorners, selectedCorners } from "./highlight-corners";
import type { Hit, Layer, Target } from "./layers/layer";
import { MotionWatch } from "./motion-watch";
import type { MeshQueryClient } from "./queries/mesh-query-client";
import type { Position } from "../document/position";
import { pointerView, type PointerView } from "./pointer-view";
import { SceneLayers } from "./scene-layers";
import { SceneChanges, type SceneState, type ShownState, type Viewport } from "./scene-state";
import { SceneRenderer } from "./scene-renderer";
import { Screen, type ScreenPoint } from "./screen";
import type { ViewCube } from "./view-cube";

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

/** If the model has grown by this factor since it was last fitted, and beyond the view, it is fitted again. */
const outgrowth = 1.5;
/** A model that appears smaller than this, in CSS pixels, is fitted too. */
const minPixels = 40;
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
  readonly #loop: FrameLoop;
  readonly #motion = new MotionWatch(() => this.#sharpen());
  /** Loaded after the first picture. */
  #cube: ViewCube | null = null;
  #isDisposed = false;
  /** Whether the next frame is the last one of a motion. */
  #isResting = false;
  readonly #layers: SceneLayers;
  readonly #observer: ResizeObserver;
  /** Box of what is shown instead of the model; null for the model. */
  #replaced: Bounds | null = null;
  #coveredLeft: number;
  /** Radius of the model when it was last fitted as a whole; 0 without extent. */
  #fittedRadius = 0;
  /** Whether what was fitted last is the whole model, or what is shown instead of it. */
  #isWholeFitted = false;
  #state: SceneState;

  constructor(container: HTMLElement, canvas: HTMLCanvasElement, options: ViewerOptions) {
    const { events } = options;
    this.#container = container;
    this.#options = options;
    this.#coveredLeft = options.coveredLeft;
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
    this.#state = { ...options.state, colors: options.colors, origin, viewport, isOtherModel: false };
    this.#updateLayers(null);
    this.#view.controls.addEventListener("control", () => this.#loop.request());
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(container);
    this.#resize();
    this.reset();
    void this.#start();
    void this.#loadCube();
  }

  setColors(colors: ViewerColors): void {
    this.#cube?.setColors(colors);
    this.#update({ colors });
  }

  /** Shows a new state. The camera follows a model that has grown beyond the view. */
  show(change: Partial<ShownState>): void {
    const before = this.#state;
    const parts = Object.keys(change) as (keyof ShownState)[];
    if (parts.every((part) => change[part] === before[part])) return;
    this.#update(change);
    this.#view.leftOrbits = this.#state.leftDrag === "orbit";
    if (this.#state.project !== before.project || this.#state.bodies !== before.bodies) this.#followModel();
  }

  /** Starts again after another model was opened: fits it without motion. */
  reset(): void {
    const { project, bodies } = this.#state;
    const { empty, radius } = projectBounds(project, bodies);
    const roomy = roomyBounds(project, bodies);
    this.#fittedRadius = empty ? 0 : radius;
    this.#update({ origin: roomy.centre });
    this.#view.setModelRadius(roomy.radius);
    this.fit(null, false);
  }

  /** Moves to the given entities, or to the whole model. */
  fit(entities: readonly Entity[] | null, animate = this.#options.motion): void {
    const { project, preview, bodies } = this.#state;
    if (entities === null && this.#replaced) return this.#fitBounds(this.#replaced, animate);
    const target = new Bounds();
    for (const entity of entities ?? []) {
      const { low, high, empty } = entityBounds(entity, project, preview, bodies);
      if (!empty) target.add(...low).add(...high);
    }
    this.#fitBounds(target, animate);
  }

  /** Moves to the whole model unless the given entities are in view. */
  fitUnlessShown(entities: readonly Entity[]): void {
    const { project, preview, bodies } = this.#state;
    const isShown = entities.every((entity) => {
      const { low, high, empty } = entityBounds(entity, project, preview, bodies);
      return empty || this.#showsAll(low, high);
    });
    if (!isShown) this.fit(null);
  }

  /** Moves to what the pointer has hit, or to the whole model. */
  fitTarget(target: Target | null): void {
    if (target?.kind !== "element") return this.fit(target && [target]);
    const { mesh } = this.#state;
    if (mesh) this.#fitBounds(boundsOf(elementCorners(mesh.volume, target.index)));
  }

  /** Moves to the selected element or triangles. */
  fitSelectedFaces(): void {
    const target = boundsOf(selectedCorners(this.#state));
    if (!target.empty) this.#fitBounds(target);
  }

  fitPosition(position: Position): void {
    this.fitPositions([position]);
  }

  fitPositions(positions: readonly Position[]): void {
    const target = new Bounds();
    for (const position of positions) target.add(...position);
    this.#fitBounds(target);
  }

  /** Fits the positions, x y z each, of what is shown instead of the model, now and whenever all is fitted; null: the model. */
  replaceModel(positions: Float64Array | null): void {
    if (positions === null && this.#replaced === null) return;
    this.#replaced = positions && boundsOf(positions);
    const model = projectBounds(this.#state.project, this.#state.bodies);
    this.#update({ isOtherModel: this.#replaced !== null && !areAlike(this.#replaced, model) });
    this.fit(null);
  }

  /** Sets the width that is covered at the left, in CSS pixels. What was in view stays in view, in the part that is free. */
  setCoveredLeft(width: number): void {
    if (width !== this.#coveredLeft) this.#resize(width);
  }

  look(view: StandardView): void {
    this.#view.look(view, this.#options.motion);
    this.fit(null);
  }

  /** Where the camera is and what it looks at, in the coordinates of the model. */
  get pose(): CameraPose {
    const { eye, target } = this.#view.pose;
    const { origin } = this.#state;
    return { eye: moved(eye, origin, 1), target: moved(target, origin, 1) };
  }

  setPose({ eye, target }: CameraPose): void {
    const { origin } = this.#state;
    this.#view.setPose({ eye: moved(eye, origin, -1), target: moved(target, origin, -1) });
    this.#loop.request();
  }

  /** Rotates by angles in degrees. */
  rotate(azimuth: number, polar: number): void {
    this.#view.rotate(azimuth, polar, this.#options.motion);
    this.#loop.request();
  }

  /** Moves sideways, by fractions of the distance to the target. */
  pan(right: number, down: number): void {
    this.#view.pan(right, down, this.#options.motion);
    this.#loop.request();
  }

  zoom(factor: number): void {
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
  toScreen([x, y, z]: Position): ScreenPoint | null {
    const { origin, viewport } = this.#state;
    const point = { x: 0, y: 0, depth: 0 };
    const screen = new Screen(this.#view.camera, viewport, point);
    return screen.project(x - origin[0], y - origin[1], z - origin[2], point)
      ? { x: point.x, y: point.y }
      : null;
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
    return { ...this.size, coveredLeft: this.#coveredLeft };
  }

  /** Draws again, after a layer has changed by itself. */
  requestFrame(): void {
    this.#loop.request();
  }

  /**
   * Returns the picture as a PNG file, without the view cube and with a transparent background. `add` draws on it; its pixels
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

  /** Draws the picture now, on a canvas of the same size; by default on the background of the page. */
  drawOn(
    paper: CanvasRenderingContext2D,
    background: string | null = getComputedStyle(document.body).backgroundColor,
  ): void {
    this.#setScale(this.#renderer.sharpScale);
    this.#renderer.render(this.#view.camera);
    this.#renderer.copyTo(paper, background);
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
    this.#cube?.dispose();
    this.#layers.dispose();
    this.#view.dispose();
    this.#renderer.dispose();
  }

  #update(change: Partial<SceneState>): void {
    const before = this.#state;
    this.#state = { ...before, ...change };
    this.#updateLayers(before);
    this.#loop.request();
  }

  #updateLayers(before: SceneState | null): void {
    this.#layers.update(new SceneChanges(this.#state, before));
  }

  /** Returns whether a box, given by two corners, is in view and large enough to see. */
  #showsAll(low: Position, high: Position): boolean {
    const corner = (i: number): Position => [
      i & 1 ? high[0] : low[0],
      i & 2 ? high[1] : low[1],
      i & 4 ? high[2] : low[2],
    ];
    return this.#shows([0, 1, 2, 3, 4, 5, 6, 7].map(corner));
  }

  /** Returns whether positions are in view, and far enough apart to see. */
  #shows(positions: readonly Position[]): boolean {
    const { width, height } = this.#state.viewport;
    const seen = positions.map((position) => this.toScreen(position));
    const left = this.#coveredLeft;
    const isInView = seen.every((at) => at && at.x >= left && at.y >= 0 && at.x <= width && at.y <= height);
    if (!isInView) return false;
    const shown = new Bounds();
    for (const at of seen) if (at) shown.add(at.x, at.y, 0);
    return Math.max(shown.high[0] - shown.low[0], shown.high[1] - shown.low[1]) >= minPixels;
  }

  /**
   * Returns whether the whole model is in view. Corners of its box where there is no point may be outside: the view must
   * not change while the user draws within it.
   */
  #showsModel({ low, high }: Bounds): boolean {
    const { project, bodies } = this.#state;
    if (bodies.length > 0 || project.points.length === 0) return this.#showsAll(low, high);
    return this.#shows(project.points.map(({ position }) => position));
  }

  /** Keeps local coordinates small, and fits the model if it has outgrown the view. */
  #followModel(): void {
    const { project, bodies, origin } = this.#state;
    const bounds = projectBounds(project, bodies);
    const { empty, radius } = bounds;
    const roomy = roomyBounds(project, bodies);
    const isOutgrown = !empty && radius > outgrowth * this.#fittedRadius && !this.#showsModel(bounds);
    if (isOutgrown || empty) this.#fittedRadius = empty ? 0 : radius;
    const drift = Math.hypot(...roomy.centre.map((x, k) => x - (origin[k] ?? 0)));
    if (isOutgrown || drift > 2 * roomy.radius) this.#update({ origin: roomy.centre });
    this.#view.setModelRadius(roomy.radius);
    if (isOutgrown) this.fit(null);
  }

  /** Moves to a target, with its surroundings if it is smaller than the model. */
  #fitBounds(target: Bounds, animate = this.#options.motion): void {
    this.#isWholeFitted = target.empty || target === this.#replaced;
    const whole = shownBounds(this.#state);
    const [from, to] = closeUpBox(target.empty ? whole : target, whole.radius, this.#state.origin);
    this.#view.fit(from, to, animate);
    this.#loop.request();
  }

  /** Drawing before the shaders are compiled would wait for them. */
  async #start(): Promise<void> {
    await this.#renderer.prepare(this.#view.camera);
    if (!this.#isDisposed) this.#loop.start();
  }

  async #loadCube(): Promise<void> {
    const { ViewCube: Cube } = await import("./view-cube");
    if (this.#isDisposed) return;
    const { camera, controls } = this.#view;
    const cube = new Cube(camera, this.#renderer.webgl, controls, this.#state.colors, {
      container: this.#container,
      animated: this.#options.motion,
      onChange: () => this.#loop.request(),
    });
    await this.#showCube(cube);
  }

  async #showCube(cube: ViewCube): Promise<void> {
    await cube.prepare(this.#renderer.webgl, this.#view.camera);
    if (this.#isDisposed) return cube.dispose();
    cube.setColors(this.#state.colors);
    this.#cube = cube;
    this.#loop.request();
  }

  #resize(coveredLeft = this.#coveredLeft): void {
    const { clientWidth, clientHeight } = this.#container;
    if (clientWidth === 0 || clientHeight === 0) {
      this.#coveredLeft = coveredLeft;
      return;
    }
    const { empty, low, high } = this.#replaced ?? projectBounds(this.#state.project, this.#state.bodies);
    const wasShown = !empty && this.#showsAll(low, high);
    this.#coveredLeft = coveredLeft;
    const isFittedAgain = this.#view.resize(clientWidth, clientHeight, this.#coveredLeft);
    this.#update({ viewport: this.#renderer.resize(clientWidth, clientHeight) });
    // For example when a panel that covered half of the view is closed. The model may have grown since it was fitted; another
    // target keeps its fit.
    if (isFittedAgain ? this.#isWholeFitted : wasShown && !this.#showsAll(low, high)) this.fit(null, false);
    this.#cube?.resize();
    // Draw at once: the canvas is blank after a change of its size.
    this.#loop.drawNow();
  }

  #setScale(scale: number): void {
    const before = this.#state;
    const pixelRatio = this.#renderer.setScale(scale);
    if (pixelRatio === before.viewport.pixelRatio) return;
    this.#state = { ...before, viewport: { ...before.viewport, pixelRatio, isHurried: scale < 1 } };
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
    this.#cube?.render();
    const isGrowing = this.#layers.drawMore();
    return isMoving || isGrowing || this.#cube?.animating === true;
  }
}

function moved([x, y, z]: Position, [dx, dy, dz]: Position, sign: 1 | -1): Position {
  return [x + sign * dx, y + sign * dy, z + sign * dz];
}
