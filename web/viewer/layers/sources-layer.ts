import type { ProjectSource } from "tetrafront/project";
import { Group, type Ray } from "three";
import { setStateColors, setStateScale } from "../draw-state";
import { createSegmentMaterial } from "../materials/segment-material";
import { nearestSegment, pointOnSegment } from "../nearest";
import type { Position } from "../../document/position";
import type { SceneChanges } from "../scene-state";
import type { Screen } from "../screen";
import { DotsLayer } from "./dots-layer";
import { EntitySegments } from "./entity-segments";
import { addOrigin, type Hit, type HittableLayer } from "./layer";
import { appendEdges, appendReach } from "./source-shapes";

/** If there are more sources, only emphasized sources show their distance. */
const manySources = 200;
const reachOpacity = 0.55;

/** Sources of element size: their dots and edges, and the distance up to which their size applies. */
export class SourcesLayer implements HittableLayer {
  readonly root = new Group();
  readonly #dots = new DotsLayer<ProjectSource>({
    kind: "source",
    name: "sources",
    shape: "square",
    color: (colors) => colors.source,
    records: ({ project }) => project.background.sources ?? noSources,
    positions: ({ positions }) => positions,
  });
  readonly #edgeMaterial = createSegmentMaterial({
    opacities: { normal: 1, hover: 1, selected: 1 },
    depthTest: false,
  });
  readonly #reachMaterial = createSegmentMaterial({ opacities: { normal: reachOpacity }, depthTest: true });
  readonly #emphasizedReach = createSegmentMaterial({
    opacities: { hover: 1, selected: 1 },
    depthTest: false,
  });
  readonly #edges = new EntitySegments("source", [this.#edgeMaterial]);
  readonly #reaches = new EntitySegments("source", [this.#reachMaterial, this.#emphasizedReach]);
  #sources: readonly ProjectSource[] = noSources;
  #origin: Position = [0, 0, 0];

  constructor() {
    this.root.add(...this.#edges.passes, ...this.#reaches.passes, this.#dots.root);
  }

  update(changes: SceneChanges): void {
    const { state } = changes;
    this.root.visible = state.layers.sources;
    if (changes.has("colors")) {
      const { source: normal, selection: selected } = state.colors;
      for (const material of [this.#edgeMaterial, this.#reachMaterial, this.#emphasizedReach]) {
        setStateColors(material, { normal, hover: selected, selected });
      }
    }
    this.#dots.update(changes);
    if (!this.root.visible) return;
    this.#lay(state.project.background.sources ?? noSources, state.origin);
    this.#edges.update(state);
    this.#reaches.update(state);
  }

  /** Sources are drawn through everything, so they can be hit through everything. */
  hit(_ray: Ray, screen: Screen): Hit | null {
    if (!this.root.visible) return null;
    const { ends, states } = this.#edges;
    const nearest = nearestSegment(ends, screen, (segment) => states.canHit(2 * segment, screen), Infinity);
    const target = nearest && states.entityAt(states.recordOf(2 * nearest.index));
    if (!target) return null;
    const position = addOrigin(pointOnSegment(ends, nearest), this.#origin);
    return { target, position, depth: nearest.depth };
  }

  dispose(): void {
    for (const material of [this.#edgeMaterial, this.#reachMaterial, this.#emphasizedReach])
      material.dispose();
    this.#edges.dispose();
    this.#reaches.dispose();
    this.#dots.dispose();
  }

  #lay(sources: readonly ProjectSource[], origin: Position): void {
    if (sources === this.#sources && origin === this.#origin) return;
    this.#sources = sources;
    this.#origin = origin;
    this.#edges.lay(sources, (source, ends) => appendEdges(source, origin, ends));
    this.#reaches.lay(sources, (source, ends) => appendReach(source, origin, ends));
    setStateScale(this.#reachMaterial, "normal", sources.length <= manySources ? reachOpacity : 0);
  }
}

const noSources: readonly ProjectSource[] = [];
