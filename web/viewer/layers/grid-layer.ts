import type { Project, ProjectBackgroundNode } from "tetrafront/project";
import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, type Ray } from "three";
import { engineGrid } from "../../document/packed-grid";
import type { Position } from "../../document/position";
import { subtract } from "../../document/vectors";
import type { SceneChanges } from "../scene-state";
import type { Screen } from "../screen";
import { uniqueEdges } from "../queries/topology";
import { DotsLayer } from "./dots-layer";
import type { Hit, HittableLayer } from "./layer";

type Background = Project["background"];

/** Length of an arrow's head as a share of half its length, and its width as a share of the head's length. */
const headLength = 0.22;
const headSpread = 0.4;

/**
 * The background grid: edges of its tetrahedra, its nodes as squares, and at stretched nodes an arrow with two heads per
 * stretching, as long as the target edge length in its direction. A grid may be large, so it is laid out only while it is shown.
 */
export class GridLayer implements HittableLayer {
  readonly root = new Group();
  readonly #material = new LineBasicMaterial({ transparent: true, opacity: 0.5, depthWrite: false });
  readonly #arrowMaterial = new LineBasicMaterial({ transparent: true, depthTest: false });
  readonly #edges = new LineSegments(new BufferGeometry(), this.#material);
  readonly #arrows = new LineSegments(new BufferGeometry(), this.#arrowMaterial);
  readonly #nodes = new DotsLayer<ProjectBackgroundNode>({
    kind: "background-node",
    name: "background",
    shape: "square",
    color: (colors) => colors.backgroundGrid,
    records: ({ project }) => project.background.nodes,
    positions: ({ position }) => [position],
  });
  #shown: Background | null = null;
  #shownOrigin: Position = [0, 0, 0];
  #edgeNodes = new Uint32Array();

  constructor() {
    this.#edges.frustumCulled = false;
    this.#arrows.frustumCulled = false;
    this.#arrows.renderOrder = 6;
    this.root.add(this.#edges, this.#arrows, this.#nodes.root);
  }

  update(changes: SceneChanges): void {
    const { state } = changes;
    this.root.visible = state.layers.background;
    if (changes.has("colors")) {
      this.#material.color.set(state.colors.backgroundGrid);
      this.#arrowMaterial.color.set(state.colors.backgroundGrid);
    }
    this.#nodes.update(changes);
    if (this.root.visible) this.#lay(state.project, state.origin);
  }

  hit(ray: Ray, screen: Screen): Hit | null {
    return this.#nodes.hit(ray, screen);
  }

  dispose(): void {
    this.#edges.geometry.dispose();
    this.#arrows.geometry.dispose();
    this.#material.dispose();
    this.#arrowMaterial.dispose();
    this.#nodes.dispose();
  }

  /** Lays out edges and arrows of a grid that is not the one shown. */
  #lay(project: Project, origin: Position): void {
    const { background } = project;
    const shown = this.#shown;
    const sameEdges = shown?.tetrahedra === background.tetrahedra && sameIds(shown.nodes, background.nodes);
    if (sameEdges && shown.nodes === background.nodes && origin === this.#shownOrigin) return;
    this.#shown = background;
    this.#shownOrigin = origin;
    // Moving or resizing a node keeps the edges, which take a while to find in a large grid.
    if (!sameEdges) this.#edgeNodes = edgeNodes(project);
    this.#edges.geometry.dispose();
    this.#edges.geometry = new BufferGeometry()
      .setAttribute("position", this.#nodes.positions)
      .setIndex(new BufferAttribute(this.#edgeNodes, 1));
    this.#arrows.geometry.dispose();
    this.#arrows.geometry = new BufferGeometry().setAttribute(
      "position",
      new BufferAttribute(arrowEnds(background, origin), 3),
    );
  }
}

function sameIds(nodes: Background["nodes"], others: Background["nodes"]): boolean {
  if (nodes === others) return true;
  return nodes.length === others.length && nodes.every(({ id }, i) => id === others[i]?.id);
}

/** Returns the edges of the grid, two node indices each. */
function edgeNodes({ background }: Project): Uint32Array<ArrayBuffer> {
  return uniqueEdges(engineGrid(background).tetrahedra).slice();
}

/** Returns the segments of a shaft and two heads per stretching of a node; those of an arrow lie in one plane. */
function arrowEnds({ nodes }: Background, origin: Position): Float32Array {
  const ends: number[] = [];
  for (const node of nodes) {
    const { position, size, stretching = 1, direction = [1, 0, 0] } = node;
    const { secondStretching = 1, secondDirection = [0, 1, 0] } = node;
    const at = subtract(position, origin);
    pushArrow(ends, at, direction, stretching > 1 ? (size * stretching) / 2 : 0);
    pushArrow(ends, at, secondDirection, secondStretching > 1 ? (size * secondStretching) / 2 : 0);
  }
  return Float32Array.from(ends);
}

/** Adds the ends of the segments of an arrow of a half length, unless that is 0. */
function pushArrow(ends: number[], at: Position, direction: Position, half: number): void {
  const length = Math.hypot(...direction);
  if (!(half > 0) || !(length > 0)) return;
  const [x, y, z] = direction.map((d) => (d / length) * half) as [number, number, number];
  // Any direction across the arrow will do.
  const across: Position = Math.abs(z) < 0.9 * half ? [-y, x, 0] : [0, -z, y];
  const breadth = (headLength * headSpread * half) / (Math.hypot(...across) || 1);
  const push = (along: number, aside: number): void => {
    [x, y, z].forEach((d, k) => ends.push((at[k] ?? 0) + along * d + aside * breadth * (across[k] ?? 0)));
  };
  push(-1, 0);
  push(1, 0);
  for (const end of [-1, 1]) {
    for (const aside of [-1, 1]) {
      push(end, 0);
      push(end * (1 - headLength), aside);
    }
  }
}
