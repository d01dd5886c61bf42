import type { MeshResult, Project, ProjectPreview, SurfaceMesh } from "tetrafront";
import { Scene, Timer, Vector2, Vector3, WebGLRenderer } from "three";
import { entityKey, sameEntity, type DrawnKind, type Entity } from "../document/entities";
import type { Faults } from "../document/validate";
import type { SelectMode, ViewState } from "../document/selection";
import { Bounds, boundsOf, entityBounds, projectBounds, roomyBounds } from "./bounds";
import { ViewCamera, type StandardView } from "./camera";
import type { ViewerColors } from "./colors";
import { dotStates } from "./dot-states";
import { DotsLayer } from "./layers/dots-layer";
import { GridLayer } from "./layers/grid-layer";
import { GroundLayer } from "./layers/ground-layer";
import type { Position, SceneLayer } from "./layers/layer";
import { LinesLayer } from "./layers/lines-layer";
import { HighlightLayer } from "./layers/highlight-layer";
import { MeshLayer } from "./layers/mesh-layer";
import { PatchesLayer } from "./layers/patches-layer";
import { SourcesLayer } from "./layers/sources-layer";
import type { MeshQueryClient } from "./mesh-query-client";
import { patchOfFace } from "./patch-finder";
import { Picker, type Pick } from "./picking";
import { elementCorners, triangleCorners } from "./highlight-corners";
import { watchPointer } from "./pointer";
import { prepareShaders } from "./shaders";
import type { ViewCube } from "./view-cube";

export interface ViewerEvents {
  /** The user clicked: on something, or on nothing. */
  readonly onPick: (pick: Pick, mode: SelectMode) => void;
  readonly onHover: (entity: Entity | null, at: { x: number; y: number } | null) => void;
  readonly onFrame: (frames: number) => void;
  /** So many faces of the mesh are drawn; `isCurrent` if no others are wanted. */
  readonly onFaces: (drawn: number, isCurrent: boolean) => void;
  readonly onFailure: (reason: string) => void;
  readonly onContextLost: () => void;
  readonly onContextRestored: () => void;
}

export interface ViewerOptions {
  readonly colors: ViewerColors;
  /** Without it the camera jumps where it would glide. */
  readonly motion: boolean;
  readonly multisampling: boolean;
  readonly meshQueries: MeshQueryClient;
  readonly events: ViewerEvents;
}

/** What the view state points out of a mesh or of a boundary. */
type Marked = { readonly [Key in "element" | "triangles"]: ViewState[Key] };

const maxPixelRatio = 2;
/** A point, or a tetrahedron, is shown with this much of the model around it. */
const closeUp = 0.12;
/** A drawing that has become this much larger than it was when last fitted is fitted again. */
const outgrowth = 1.5;

/**
 * The three-dimensional view: an imperative object outside React. It is told what to show and draws
 * when something has changed, never otherwise. Throws if the browser offers no WebGL 2.
 */
export class Viewer {
  readonly #container: HTMLElement;
  readonly #options: ViewerOptions;
  readonly #renderer: WebGLRenderer;
  readonly #scene = new Scene();
  readonly #view: ViewCamera;
  /** Comes a moment after the first picture. */
  #cube: ViewCube | null = null;
  #colors: ViewerColors;
  #disposed = false;
  /** The shaders are there; before, nothing is drawn. */
  #prepared = false;
  readonly #mesh: MeshLayer;
  readonly #marks = new HighlightLayer(({ selection, hover }) => ({ face: selection, edge: hover }));
  readonly #faults = new HighlightLayer(({ front, meshEdge }) => ({ face: front, edge: meshEdge }));
  readonly #patches = new PatchesLayer();
  readonly #lines = new LinesLayer();
  readonly #points = new DotsLayer("round", (colors) => colors.point);
  readonly #grid = new GridLayer();
  readonly #sources = new SourcesLayer();
  readonly #ground = new GroundLayer();
  readonly #picker: Picker;
  readonly #timer = new Timer();
  readonly #size = new Vector2(1, 1);
  readonly #observer: ResizeObserver;
  readonly #unwatchPointer: () => void;
  readonly #drawnListeners = new Set<() => void>();
  #frameRequest = 0;
  #frames = 0;
  #origin: Position = [0, 0, 0];
  /** Of the model when it was last fitted as a whole; 0 without extent. */
  #fittedRadius = 0;
  #project: Project | null = null;
  #preview: ProjectPreview | null = null;
  #previewProject: Project | null = null;
  #result: MeshResult | null = null;
  #checked: SurfaceMesh | null = null;
  #faulty: Faults = { triangles: [], patches: new Set() };
  #state: ViewState | null = null;

  constructor(container: HTMLElement, canvas: HTMLCanvasElement, options: ViewerOptions) {
    this.#container = container;
    this.#options = options;
    this.#colors = options.colors;
    this.#renderer = new WebGLRenderer({ canvas, antialias: options.multisampling, alpha: true });
    this.#renderer.setPixelRatio(Math.min(window.devicePixelRatio, maxPixelRatio));
    this.#renderer.setClearColor(0x000000, 0);
    // To ask how a shader has fared is to wait for it.
    this.#renderer.debug.checkShaderErrors = import.meta.env.DEV;
    this.#view = new ViewCamera(canvas, options.motion);
    this.#mesh = new MeshLayer(options.meshQueries, {
      onChange: () => this.#meshChanged(),
      onFailure: options.events.onFailure,
    });
    this.#picker = new Picker(this.#view.camera, this.#mesh, this.#patches);
    for (const layer of this.#layers) this.#scene.add(layer.root);
    this.#view.controls.addEventListener("control", () => this.#requestFrame());
    canvas.addEventListener("webglcontextlost", this.#onContextLost);
    canvas.addEventListener("webglcontextrestored", this.#onContextRestored);
    this.#unwatchPointer = watchPointer(canvas, {
      onClick: (at, mode) => this.#click(at, mode),
      onDoubleClick: (at) => this.#fitAt(at),
      onHover: (at) => this.#hover(at),
    });
    this.setColors(options.colors);
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(container);
    this.#resize();
    void this.#prepare();
    void this.#loadCube();
  }

  setColors(colors: ViewerColors): void {
    this.#colors = colors;
    for (const layer of this.#layers) layer.setColors(colors);
    this.#cube?.setColors(colors);
    this.#requestFrame();
  }

  /** Shows another state of the project. `fit` where it is another project altogether. */
  setProject(project: Project, fit: boolean): void {
    this.#project = project;
    const bounds = roomyBounds(project);
    const { empty, radius } = projectBounds(project);
    const outgrown = !empty && radius > outgrowth * this.#fittedRadius;
    if (fit || outgrown || empty) this.#fittedRadius = empty ? 0 : radius;
    // Single precision suffices near the origin only, so the origin follows the model if it is far off.
    const drift = Math.hypot(...bounds.centre.map((x, k) => x - (this.#origin[k] ?? 0)));
    if (fit || outgrown || drift > 2 * bounds.radius) this.#moveOrigin(bounds);
    this.#view.setModelRadius(bounds.radius);
    this.#points.setPlaces(
      project.points.map(({ at }) => at),
      this.#origin,
    );
    this.#sources.setSources(project, this.#origin);
    this.#updateMarkings();
    if (fit) this.fit(null, false);
    else if (outgrown) this.fit(null);
    this.#requestFrame();
  }

  /** Shows the sampled lines and patches of a project. */
  setPreview(preview: ProjectPreview | null, project: Project | null): void {
    this.#preview = preview;
    this.#previewProject = project;
    this.#lines.setPreview(preview, this.#origin);
    this.#patches.setPreview(preview, this.#origin);
    this.#updateMarkings();
    this.#requestFrame();
  }

  setMesh(result: MeshResult | null): void {
    this.#result = result;
    this.#mesh.setMesh(result, this.#origin);
    this.#updateMarkings();
    this.#updateMarks();
    this.#requestFrame();
  }

  /** The boundary that the last run has checked, of which triangles may be marked. */
  setCheckedSurface(surface: SurfaceMesh | null): void {
    this.#checked = surface;
    this.#updateMarks();
    this.#requestFrame();
  }

  /** Points out patches, and triangles of the boundary that the last run has checked. */
  setFaults(faults: Faults): void {
    this.#faulty = faults;
    this.#updateMarkings();
    this.#updateMarks();
    this.#requestFrame();
  }

  setStale(stale: boolean): void {
    this.#mesh.setStale(stale);
    this.#requestFrame();
  }

  setView(state: ViewState): void {
    const before = this.#state;
    this.#state = state;
    this.#mesh.root.visible = state.layers.mesh;
    this.#patches.root.visible = state.layers.patches;
    this.#lines.root.visible = state.layers.lines;
    this.#points.root.visible = state.layers.points;
    this.#grid.root.visible = state.layers.background;
    this.#sources.root.visible = state.layers.sources;
    this.#mesh.setShading(state.shading, state.edges);
    this.#mesh.setCut(state.cut);
    this.#mesh.setHiddenRegions(state.hiddenRegions);
    if (state.element !== before?.element || state.triangles !== before.triangles) this.#updateMarks();
    const marked =
      state.selection !== before?.selection ||
      state.hover !== before.hover ||
      state.hidden !== before.hidden ||
      state.layers !== before.layers;
    if (marked) this.#updateMarkings();
    this.#requestFrame();
  }

  /** Moves to the given entities, or to the whole model. */
  fit(entities: readonly Entity[] | null, animate = this.#options.motion): void {
    if (!this.#project) return;
    const whole = roomyBounds(this.#project);
    let target = whole;
    if (entities && entities.length > 0) {
      const [first] = entities;
      if (first) target = entityBounds(first, this.#project, this.#preview);
      for (const entity of entities.slice(1)) {
        const { low, high, empty } = entityBounds(entity, this.#project, this.#preview);
        if (!empty) target.add(...low).add(...high);
      }
    }
    this.#fitBounds(target.empty ? whole : target, whole, animate);
  }

  /** Moves to the element or the triangles that are marked. */
  fitMarked(): void {
    if (!this.#project || !this.#state) return;
    const target = boundsOf(this.#markedCorners(this.#state));
    if (!target.empty) this.#fitBounds(target, roomyBounds(this.#project), this.#options.motion);
  }

  fitPlace(place: Position): void {
    if (!this.#project) return;
    this.#fitBounds(new Bounds().add(...place), roomyBounds(this.#project), this.#options.motion);
  }

  look(view: StandardView): void {
    this.#view.look(view, this.#options.motion);
    this.fit(null);
    this.#requestFrame();
  }

  turn(azimuth: number, polar: number): void {
    this.#view.turn(azimuth, polar, this.#options.motion);
    this.#requestFrame();
  }

  shift(right: number, down: number): void {
    this.#view.shift(right, down, this.#options.motion);
    this.#requestFrame();
  }

  zoom(factor: number): void {
    this.#view.zoom(factor, this.#options.motion);
    this.#requestFrame();
  }

  /** Where a place of the model appears, in CSS pixels of the view; null if behind the eye. */
  toScreen(place: Position): { x: number; y: number } | null {
    return this.#picker.toScreen(place, this.#size, this.#origin);
  }

  /** Calls back after every frame drawn. Returns the way to stop. */
  onDrawn(listener: () => void): () => void {
    this.#drawnListeners.add(listener);
    return () => this.#drawnListeners.delete(listener);
  }

  dispose(): void {
    cancelAnimationFrame(this.#frameRequest);
    this.#observer.disconnect();
    this.#unwatchPointer();
    this.#renderer.domElement.removeEventListener("webglcontextlost", this.#onContextLost);
    this.#renderer.domElement.removeEventListener("webglcontextrestored", this.#onContextRestored);
    this.#disposed = true;
    this.#cube?.dispose();
    for (const layer of this.#layers) layer.dispose();
    this.#view.dispose();
    this.#timer.dispose();
    this.#renderer.dispose();
  }

  get #layers(): readonly SceneLayer[] {
    const model = [this.#lines, this.#points, this.#grid, this.#sources];
    return [this.#ground, this.#patches, this.#mesh, this.#faults, this.#marks, ...model];
  }

  /** To draw with shaders that are not there is to wait for them. */
  async #prepare(): Promise<void> {
    await prepareShaders(this.#renderer, this.#scene, this.#view.camera);
    this.#prepared = true;
    this.#requestFrame();
  }

  async #loadCube(): Promise<void> {
    const { ViewCube: Cube } = await import("./view-cube");
    if (this.#disposed) return;
    const { camera, controls } = this.#view;
    const cube = new Cube(camera, this.#renderer, controls, this.#colors, {
      container: this.#container,
      animated: this.#options.motion,
      onChange: () => this.#requestFrame(),
    });
    await this.#showCube(cube);
  }

  async #showCube(cube: ViewCube): Promise<void> {
    await cube.prepare(this.#renderer, this.#view.camera);
    if (this.#disposed) return cube.dispose();
    cube.setColors(this.#colors);
    this.#cube = cube;
    this.#requestFrame();
  }

  readonly #onContextLost = (event: Event): void => {
    event.preventDefault();
    this.#options.events.onContextLost();
  };

  readonly #onContextRestored = (): void => {
    this.#options.events.onContextRestored();
    this.#requestFrame();
  };

  #moveOrigin(bounds: Bounds): void {
    this.#origin = bounds.centre;
    this.#lines.setPreview(this.#preview, this.#origin);
    this.#patches.setPreview(this.#preview, this.#origin);
    this.#mesh.setMesh(this.#result, this.#origin);
    this.#updateMarks();
    this.#ground.setExtent(bounds.radius, bounds.low[2] - bounds.centre[2] - bounds.radius * 0.04);
  }

  /** Something smaller than a part of the model is shown with this part around it. */
  #fitBounds(target: Bounds, whole: Bounds, animate: boolean): void {
    const least = target.radius < closeUp * whole.radius ? closeUp * whole.radius : 0;
    const { low, high, centre } = target;
    const [x, y, z] = this.#origin;
    const from = new Vector3(low[0] - x, low[1] - y, low[2] - z);
    const to = new Vector3(high[0] - x, high[1] - y, high[2] - z);
    if (least > 0) {
      from.set(centre[0] - x, centre[1] - y, centre[2] - z).subScalar(least);
      to.copy(from).addScalar(2 * least);
    }
    this.#view.fit(from, to, animate);
    this.#requestFrame();
  }

  /** Brings colours and visibility of all entities in line with the view state. */
  #updateMarkings(): void {
    const state = this.#state;
    if (!state || !this.#project) return;
    const selected = new Set(state.selection.map(entityKey));
    const markingOf = (kind: DrawnKind, id: number) => {
      const key = entityKey({ kind, id });
      if (state.hidden.has(key)) return null;
      if (selected.has(key)) return "selected";
      return sameEntity(state.hover, { kind, id }) ? "hover" : "normal";
    };
    const { points, background } = this.#project;
    const statesOf = (kind: "point" | "background-node", records: readonly { readonly id: number }[]) =>
      dotStates(records, kind, state, selected);
    this.#points.setStates(statesOf("point", points));
    // These may be many: nothing is done for them while they are not on show.
    if (state.layers.background) {
      this.#grid.setGrid(this.#project, this.#origin);
      this.#grid.setStates(statesOf("background-node", background.nodes));
    }
    if (state.layers.sources) {
      const sources = background.sources ?? [];
      this.#sources.setStates(sources.map(({ id }) => markingOf("source", id) ?? "hidden"));
    }
    const drawn = this.#previewProject;
    const idAt = (list: readonly { readonly id: number }[] | undefined, position: number) =>
      list?.[position]?.id ?? 0;
    this.#lines.update((position) => markingOf("line", idAt(drawn?.lines, position)));
    this.#patches.update((position) => {
      const id = idAt(drawn?.patches, position);
      const marking = markingOf("patch", id);
      return marking === "normal" && this.#faulty.patches.has(id) ? "faulty" : marking;
    });
    this.#patches.setOverMesh(state.layers.mesh && this.#mesh.counts.tetrahedra > 0);
  }

  #markedCorners({ element, triangles }: Marked): number[] {
    if (element !== null) return this.#result ? elementCorners(this.#result.volume, element) : [];
    return this.#checked ? triangleCorners(this.#checked, triangles) : [];
  }

  #updateMarks(): void {
    if (this.#state) this.#marks.setTriangles(this.#markedCorners(this.#state), this.#origin);
    this.#faults.setTriangles(
      this.#checked ? triangleCorners(this.#checked, this.#faulty.triangles) : [],
      this.#origin,
    );
  }

  #fitElement(element: number): void {
    if (!this.#project) return;
    const corners = this.#markedCorners({ element, triangles: [] });
    this.#fitBounds(boundsOf(corners), roomyBounds(this.#project), this.#options.motion);
  }

  #pick(at: Vector2): Pick | null {
    if (!this.#project || !this.#state) return null;
    return this.#picker.pick(at, this.#size, {
      project: this.#project,
      preview: this.#preview,
      previewProject: this.#previewProject,
      view: this.#state,
      origin: this.#origin,
      patchOfFace: (nodes) => this.#result && patchOfFace(this.#result.surface, nodes),
    });
  }

  #click(at: Vector2, mode: SelectMode): void {
    const pick = this.#pick(at);
    if (pick) this.#options.events.onPick(pick, mode);
  }

  #fitAt(at: Vector2): void {
    const pick = this.#pick(at);
    if (pick?.entity) this.fit([pick.entity]);
    else if (pick?.element != null) this.#fitElement(pick.element);
    else this.fit(null);
  }

  #hover(at: Vector2 | null): void {
    const entity = at ? (this.#pick(at)?.entity ?? null) : null;
    this.#options.events.onHover(entity, at && entity ? { x: at.x, y: at.y } : null);
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.#container;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.#size.set(clientWidth, clientHeight);
    this.#renderer.setSize(clientWidth, clientHeight, false);
    this.#view.resize(clientWidth, clientHeight);
    this.#cube?.resize();
    const pixelRatio = this.#renderer.getPixelRatio();
    this.#points.setPixelRatio(pixelRatio);
    this.#grid.nodes.setPixelRatio(pixelRatio);
    this.#sources.places.setPixelRatio(pixelRatio);
    this.#lines.setResolution(clientWidth, clientHeight);
    this.#draw();
  }

  #meshChanged(): void {
    this.#options.events.onFaces(this.#mesh.counts.drawnFaces, this.#mesh.isCurrent);
    this.#requestFrame();
  }

  #requestFrame(): void {
    if (!this.#disposed && this.#frameRequest === 0)
      this.#frameRequest = requestAnimationFrame(() => this.#draw());
  }

  #draw(): void {
    cancelAnimationFrame(this.#frameRequest);
    this.#frameRequest = 0;
    this.#mesh.refresh();
    if (!this.#prepared) return;
    this.#timer.update();
    const moving = this.#view.update(Math.min(this.#timer.getDelta(), 0.1));
    this.#renderer.render(this.#scene, this.#view.camera);
    this.#cube?.render();
    this.#options.events.onFrame(++this.#frames);
    for (const listener of this.#drawnListeners) listener();
    if (moving || this.#cube?.animating === true) this.#requestFrame();
  }
}
