import { type BufferGeometry, Group, type PerspectiveCamera, type Scene } from "three";
import type { Entity } from "../document/entities";
import { defectiveCorners, selectedCorners } from "./highlight-corners";
import { entitiesUnder, hitTest } from "./hit-test";
import { AxesLayer } from "./layers/axes-layer";
import { BodiesLayer } from "./layers/bodies-layer";
import { DotsLayer } from "./layers/dots-layer";
import { FrontLayer, type Preparation } from "./layers/front-layer";
import { GridLayer } from "./layers/grid-layer";
import { GroundLayer } from "./layers/ground-layer";
import { HighlightLayer } from "./layers/highlight-layer";
import type { Hit, HittableLayer, Layer } from "./layers/layer";
import { LinesLayer } from "./layers/lines-layer";
import { MeshLayer, type MeshLayerEvents } from "./layers/mesh-layer";
import { PatchesLayer } from "./layers/patches-layer";
import { SizesLayer } from "./layers/sizes-layer";
import { SmoothnessLayer } from "./layers/smoothness-layer";
import { SourcesLayer } from "./layers/sources-layer";
import type { MeshQueryClient } from "./queries/mesh-query-client";
import type { SceneChanges, Viewport } from "./scene-state";
import type { ScreenPoint } from "./screen";

/** The layers of a scene: updates them together and finds what the pointer hits. */
export class SceneLayers {
  readonly mesh: MeshLayer;
  readonly axes = new AxesLayer();
  readonly #scene: Scene;
  readonly #patches: PatchesLayer;
  readonly #bodies: BodiesLayer;
  readonly #front = new FrontLayer();
  readonly #lines = new LinesLayer();
  readonly #points = new DotsLayer({
    kind: "point",
    name: "points",
    shape: "round",
    color: (colors) => colors.point,
    records: ({ project }) => project.points,
    positions: ({ position }) => [position],
  });
  readonly #grid = new GridLayer();
  readonly #sources = new SourcesLayer();
  /** What a recorded front and target sizes replace. Sizes replace only some bodies: their layer knows them. */
  readonly #replaced = new Group();
  readonly #entities = new Group();
  #isReplaying = false;
  /** In the order in which they are added to the scene. */
  readonly #all: Layer[];

  constructor(scene: Scene, meshQueries: MeshQueryClient, meshEvents: MeshLayerEvents) {
    this.#scene = scene;
    this.#patches = new PatchesLayer((corners) => meshQueries.treeOf(corners));
    this.#bodies = new BodiesLayer((corners) => meshQueries.treeOf(corners));
    this.mesh = new MeshLayer(meshQueries, meshEvents);
    this.#all = this.#inOrder();
    for (const { root } of this.#all) if (!root.parent) scene.add(root);
  }

  update(changes: SceneChanges): void {
    const { isReplaying, isOtherModel, shownSizes, shownSmoothness } = changes.state;
    this.#isReplaying = isReplaying;
    this.#replaced.visible = !isReplaying && shownSizes === null && shownSmoothness === null;
    this.#bodies.root.visible = !isReplaying;
    this.#entities.visible = !isOtherModel;
    for (const layer of this.#all) layer.update(changes);
  }

  /** Adds a layer on top of the others. Returns a function that removes and disposes it. */
  add(layer: Layer, changes: SceneChanges): () => void {
    this.#all.push(layer);
    this.#scene.add(layer.root);
    layer.update(changes);
    return () => {
      this.#all.splice(this.#all.indexOf(layer), 1);
      this.#scene.remove(layer.root);
      layer.dispose();
    };
  }

  /** Returns what lies at a point of the view; null if nothing does. */
  hit(camera: PerspectiveCamera, viewport: Viewport, at: ScreenPoint): Hit | null {
    const onSurfaces = this.#shownEntities;
    const solid = [
      ...(this.#replaced.visible ? [this.mesh] : []),
      ...(this.#isReplaying ? [] : [this.#bodies]),
    ];
    const order = { solid, onSurfaces, translucent: this.#isReplaying ? null : this.#patches };
    return hitTest(order, camera, viewport, at);
  }

  /** Returns the entities at a point of the view, the uppermost first: those behind a mesh too. */
  entitiesAt(camera: PerspectiveCamera, viewport: Viewport, at: ScreenPoint): Entity[] {
    const onSurfaces = this.#shownEntities;
    const translucent = this.#isReplaying ? null : this.#patches;
    return entitiesUnder({ solid: [this.#bodies], onSurfaces, translucent }, camera, viewport, at);
  }

  /** Draws more of large surfaces in the next frame. Returns whether there is more. */
  drawMore(): boolean {
    return this.#bodies.drawMore();
  }

  /** Passes one more part of a large front to `upload`; it is drawn when all of them have been uploaded. */
  prepareMore(upload: (geometry: BufferGeometry) => void): Preparation {
    return this.#front.prepareMore(upload);
  }

  dispose(): void {
    for (const layer of this.#all) layer.dispose();
  }

  /** In the order in which a hit test prefers them. */
  get #shownEntities(): readonly HittableLayer[] {
    return this.#entities.visible ? [this.#points, this.#grid, this.#sources, this.#lines] : [];
  }

  #inOrder(): Layer[] {
    const defects = new HighlightLayer({
      corners: defectiveCorners,
      parts: ["checkedSurface", "defects", "bodies"],
      faceColor: ({ front }) => front,
      edgeColor: ({ meshEdge }) => meshEdge,
    });
    const selectedFaces = new HighlightLayer({
      corners: selectedCorners,
      parts: ["element", "triangles", "markedBody", "mesh", "checkedSurface", "bodies"],
      faceColor: ({ selection }) => selection,
      edgeColor: ({ hover }) => hover,
    });
    const surfaces = [this.#patches, this.#bodies, this.mesh, this.#front, defects, selectedFaces];
    for (const layer of surfaces) if (layer !== this.#bodies) this.#replaced.add(layer.root);
    this.#scene.add(this.#replaced);
    const entities = [this.#lines, this.#points, this.#grid, this.#sources];
    this.#entities.add(...entities.map(({ root }) => root));
    this.#scene.add(this.#entities);
    return [new GroundLayer(), this.axes, ...surfaces, new SizesLayer(), new SmoothnessLayer(), ...entities];
  }
}
