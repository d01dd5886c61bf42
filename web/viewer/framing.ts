import type { Project } from "tetrafront/project";
import type { Entity } from "../document/entities";
import type { Position } from "../document/position";
import {
  areAlike,
  Bounds,
  boundsOf,
  entityBounds,
  isSampled,
  projectBounds,
  roomyBounds,
  shownBounds,
} from "./bounds";
import type { ViewCamera } from "./camera";
import { closeUpBox } from "./close-up";
import { elementCorners, selectedCorners } from "./highlight-corners";
import type { Target } from "./layers/layer";
import type { SceneState, Viewport } from "./scene-state";
import { screenProjection, type ScreenPoint } from "./screen";

/** The scene that is framed. */
export interface FramedScene {
  readonly state: SceneState;
  readonly update: (change: Partial<SceneState>) => void;
  /** Draws the next frame. */
  readonly request: () => void;
}

/** If the model has grown by this factor since it was last fitted, and beyond the view, it is fitted again. */
const outgrowth = 1.5;
/** If it has shrunk by this factor, and appears smaller than this share of the view, too: as by a change of units. */
const shrinkage = 5;
const lostShare = 0.2;
/** A model that appears smaller than this, in CSS pixels, is fitted too. */
const minPixels = 40;

/** Positions on the lines of the model, if they have been sampled since it changed: circles lie beside their points. */
function sampledPositions(state: SceneState): readonly Position[] {
  const points = isSampled(state) ? state.preview.samples.linePoints : [];
  return Array.from({ length: points.length / 3 }, (_, i) => [
    points[3 * i] ?? 0,
    points[3 * i + 1] ?? 0,
    points[3 * i + 2] ?? 0,
  ]);
}

/** Returns the radius of the model; 0 without extent. */
function projectRadius({ project, bodies }: SceneState): number {
  const { empty, radius } = projectBounds(project, bodies);
  return empty ? 0 : radius;
}

/** Returns the corners of a box. */
const cornersOf = ({ low, high }: Bounds): readonly Position[] =>
  [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [
    i & 1 ? high[0] : low[0],
    i & 2 ? high[1] : low[1],
    i & 4 ? high[2] : low[2],
  ]);

/** Returns the width or height of what appears at positions of the screen, whichever is larger. */
function extentOf(seen: readonly (ScreenPoint | null)[]): number {
  const shown = new Bounds();
  for (const at of seen) if (at) shown.add(at.x, at.y, 0);
  return Math.max(shown.high[0] - shown.low[0], shown.high[1] - shown.low[1]);
}

/** Decides what the camera is fitted to, and when it follows the model. Keeps the local coordinates small. */
export class Framing {
  readonly #view: ViewCamera;
  readonly #scene: FramedScene;
  /** If false, the camera jumps instead of gliding. */
  readonly #motion: boolean;
  /** Box of what is shown instead of the model; null for the model. */
  #replaced: Bounds | null = null;
  #coveredLeft: number;
  /** Radius of the model when it was last fitted as a whole; 0 without extent. */
  #fittedRadius = 0;
  /** The background for which the reach was computed: it may have millions of nodes. */
  #reached: {
    readonly background: Project["background"];
    readonly origin: Position;
    readonly reach: number;
  } | null = null;
  /** Whether what was fitted last is the whole model, or what is shown instead of it. */
  #isWholeFitted = false;
  /** While something is moved, the camera does not follow the model. */
  #isHeld = false;
  #hasMissedChange = false;

  constructor(view: ViewCamera, scene: FramedScene, motion: boolean, coveredLeft: number) {
    this.#view = view;
    this.#scene = scene;
    this.#motion = motion;
    this.#coveredLeft = coveredLeft;
  }

  /** Width of the view that is covered at the left, in CSS pixels. */
  get coveredLeft(): number {
    return this.#coveredLeft;
  }

  /** Starts again after another model was opened: fits it without motion. */
  reset(): void {
    const { project, bodies } = this.#scene.state;
    const roomy = roomyBounds(project, bodies);
    this.#scene.update({ origin: roomy.centre });
    this.#view.setModelRadius(roomy.radius, this.#backgroundReach());
    this.fit(null, false);
  }

  /** Moves to the given entities, or to the whole model. */
  fit(entities: readonly Entity[] | null, animate = this.#motion): void {
    const { project, preview, bodies } = this.#scene.state;
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
    const { project, preview, bodies } = this.#scene.state;
    const isShown = entities.every((entity) => {
      const bounds = entityBounds(entity, project, preview, bodies);
      return bounds.empty || this.#showsAll(bounds);
    });
    if (!isShown) this.fit(null);
  }

  /** Moves to what the pointer has hit, or to the whole model. */
  fitTarget(target: Target | null): void {
    if (target?.kind !== "element") return this.fit(target && [target]);
    const { mesh } = this.#scene.state;
    if (mesh) this.#fitBounds(boundsOf(elementCorners(mesh.mesh, target.index)));
  }

  /** Moves to the selected element or triangles. */
  fitSelectedFaces(): void {
    const target = boundsOf(selectedCorners(this.#scene.state));
    if (!target.empty) this.#fitBounds(target);
  }

  fitPosition(position: Position): void {
    this.fitPositions([position]);
  }

  /**
   * Moves to positions; `from`: seen from a direction of any length, else from where the camera is; `surroundings`: the largest
   * ones, as of `closeUpBox`.
   */
  fitPositions(positions: readonly Position[], from: Position | null = null, surroundings?: number): void {
    if (from) this.#view.lookFrom(from, this.#motion);
    const target = new Bounds();
    for (const position of positions) target.add(...position);
    this.#fitBounds(target, this.#motion, surroundings);
  }

  /** Fits the positions, x y z each, of what is shown instead of the model, now and whenever all is fitted; null: the model. */
  replaceModel(positions: Float64Array | null): void {
    if (positions === null && this.#replaced === null) return;
    const { project, bodies } = this.#scene.state;
    this.#replaced = positions && boundsOf(positions);
    const isOtherModel = this.#replaced !== null && !areAlike(this.#replaced, projectBounds(project, bodies));
    this.#scene.update({ isOtherModel });
    this.fit(null);
  }

  /**
   * Follows a changed model: keeps local coordinates small, and fits the model if it has outgrown the view, or shrunk to
   * a dot in it. A model that only moves may leave the view.
   */
  followModel(): void {
    if (this.#isHeld) {
      this.#hasMissedChange = true;
      return;
    }
    const { project, bodies, origin } = this.#scene.state;
    const bounds = projectBounds(project, bodies);
    const { empty, radius } = bounds;
    const roomy = roomyBounds(project, bodies);
    const isOutgrown = !empty && radius > outgrowth * this.#fittedRadius && !this.#showsModel(bounds);
    const isShrunk = radius > 0 && shrinkage * radius < this.#fittedRadius && this.#isTiny(bounds);
    if (isOutgrown || isShrunk || empty) this.#fittedRadius = empty ? 0 : radius;
    const drift = Math.hypot(...roomy.centre.map((x, k) => x - (origin[k] ?? 0)));
    if (isOutgrown || isShrunk || drift > 2 * roomy.radius) {
      this.#view.shift(roomy.centre.map((x, k) => (origin[k] ?? 0) - x) as [number, number, number]);
      this.#scene.update({ origin: roomy.centre });
    }
    this.#view.setModelRadius(roomy.radius, this.#backgroundReach());
    if (isOutgrown || isShrunk) this.fit(null);
  }

  /**
   * Keeps the camera from following the model while a tool moves something: what lies under the pointer must stay there. The
   * camera follows as soon as it is no longer held.
   */
  hold(isHeld: boolean): void {
    this.#isHeld = isHeld;
    if (isHeld || !this.#hasMissedChange) return;
    this.#hasMissedChange = false;
    this.followModel();
  }

  /**
   * Sets the size of the view, and the width that is covered at the left, in CSS pixels. What was in view stays in view, in
   * the part that is free. Null: a view without size.
   */
  resize(viewport: Viewport | null, coveredLeft: number): void {
    if (!viewport) {
      this.#coveredLeft = coveredLeft;
      return;
    }
    const { project, bodies } = this.#scene.state;
    const model = this.#replaced ?? projectBounds(project, bodies);
    const wasShown = !model.empty && this.#showsAll(model);
    this.#coveredLeft = coveredLeft;
    const isFittedAgain = this.#view.resize(viewport.width, viewport.height, coveredLeft);
    this.#scene.update({ viewport });
    // For example when a panel that covered half of the view is closed. The model may have grown since it was fitted; another
    // target keeps its fit.
    if (isFittedAgain ? this.#isWholeFitted : wasShown && !this.#showsAll(model)) this.fit(null, false);
  }

  /** Distance from the origin to the farthest node or source. */
  #backgroundReach(): number {
    const { project, origin } = this.#scene.state;
    const { background } = project;
    const known = this.#reached;
    if (known?.background === background && known.origin === origin) return known.reach;
    let reach = 0;
    const add = ([x, y, z]: Position, around = 0): void => {
      reach = Math.max(reach, Math.hypot(x - origin[0], y - origin[1], z - origin[2]) + around);
    };
    for (const { position } of background.nodes) add(position);
    for (const { positions, distance } of background.sources ?? []) {
      for (const position of positions) add(position, distance);
    }
    this.#reached = { background, origin, reach };
    return reach;
  }

  /** Returns whether a box is in view and large enough to see. */
  #showsAll(bounds: Bounds): boolean {
    return this.#shows(cornersOf(bounds));
  }

  /** Returns whether a box appears much smaller than the view, wherever it is. */
  #isTiny(bounds: Bounds): boolean {
    const { viewport, origin } = this.#scene.state;
    const seen = cornersOf(bounds).map(screenProjection(this.#view.camera, viewport, origin));
    return (
      seen.every((at) => at !== null) &&
      extentOf(seen) < lostShare * Math.min(viewport.width, viewport.height)
    );
  }

  /** Returns whether positions are in view, and far enough apart to see. */
  #shows(positions: readonly Position[]): boolean {
    const { viewport, origin } = this.#scene.state;
    const { width, height } = viewport;
    const seen = positions.map(screenProjection(this.#view.camera, viewport, origin));
    const left = this.#coveredLeft;
    const isInView = seen.every((at) => at && at.x >= left && at.y >= 0 && at.x <= width && at.y <= height);
    if (!isInView) return false;
    return extentOf(seen) >= minPixels;
  }

  /**
   * Returns whether the whole model is in view. Corners of its box where there is nothing may be outside: the view must
   * not change while the user draws within it.
   */
  #showsModel(bounds: Bounds): boolean {
    const { project, bodies } = this.#scene.state;
    if (bodies.length > 0 || project.points.length === 0) return this.#showsAll(bounds);
    const points = project.points.map(({ position }) => position);
    return this.#shows([...points, ...sampledPositions(this.#scene.state)]);
  }

  /** Moves to a target, with its surroundings if it is smaller than the model. */
  #fitBounds(target: Bounds, animate = this.#motion, surroundings?: number): void {
    this.#isWholeFitted = target.empty || target === this.#replaced;
    const { state } = this.#scene;
    const whole = shownBounds(state);
    if (target.empty) this.#fittedRadius = projectRadius(state);
    const [from, to] = closeUpBox(target.empty ? whole : target, whole.radius, state.origin, surroundings);
    this.#view.fit(from, to, animate);
    this.#scene.request();
  }
}
