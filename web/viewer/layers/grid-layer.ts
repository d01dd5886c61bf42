import type { Project } from "tetrafront";
import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments } from "three";
import { engineGrid } from "../../document/packed-grid";
import type { ViewerColors } from "../colors";
import { uniqueEdges } from "../topology";
import { DotsLayer, type DotState } from "./dots-layer";
import type { Position, SceneLayer } from "./layer";

type Background = Project["background"];

/** The head of an arrow, as a share of its length, and how far it spreads. */
const headLength = 0.22;
const headSpread = 0.4;

/**
 * The background grid: edges of its tetrahedra, its nodes as squares, and at stretched nodes an arrow
 * with two heads, as long as the elements wanted there. Laid out only while it is on show.
 */
export class GridLayer implements SceneLayer {
  readonly root = new Group();
  readonly #material = new LineBasicMaterial({ transparent: true, opacity: 0.5, depthWrite: false });
  readonly #arrowMaterial = new LineBasicMaterial({ transparent: true, depthTest: false });
  readonly #edges = new LineSegments(new BufferGeometry(), this.#material);
  readonly #arrows = new LineSegments(new BufferGeometry(), this.#arrowMaterial);
  readonly nodes = new DotsLayer("square", (colors) => colors.backgroundGrid);
  #shown: Background | null = null;
  #shownOrigin: Position = [0, 0, 0];
  #edgeNodes = new Uint32Array();

  constructor() {
    this.#edges.frustumCulled = false;
    this.#arrows.frustumCulled = false;
    this.#arrows.renderOrder = 6;
    this.root.add(this.#edges, this.#arrows, this.nodes.root);
  }

  setColors(colors: ViewerColors): void {
    this.#material.color.set(colors.backgroundGrid);
    this.#arrowMaterial.color.set(colors.backgroundGrid);
    this.nodes.setColors(colors);
  }

  /** Lays the grid out if it is another one. */
  setGrid(project: Project, origin: Position): void {
    const { background } = project;
    const shown = this.#shown;
    const sameEdges = shown?.tetrahedra === background.tetrahedra && sameIds(shown.nodes, background.nodes);
    if (sameEdges && shown.nodes === background.nodes && origin === this.#shownOrigin) return;
    this.#shown = background;
    this.#shownOrigin = origin;
    // Moving or sizing a node leaves the edges: of a large grid they take a while to find.
    if (!sameEdges) this.#edgeNodes = edgeNodes(project);
    this.nodes.setPlaces(
      background.nodes.map((node) => node.at),
      origin,
    );
    this.#edges.geometry.dispose();
    this.#edges.geometry = new BufferGeometry()
      .setAttribute("position", this.nodes.root.geometry.getAttribute("position"))
      .setIndex(new BufferAttribute(this.#edgeNodes, 1));
    replacePositions(this.#arrows, arrowPlaces(background, origin));
  }

  setStates(states: readonly DotState[]): void {
    this.nodes.setStates(states);
  }

  dispose(): void {
    this.#edges.geometry.dispose();
    this.#arrows.geometry.dispose();
    this.#material.dispose();
    this.#arrowMaterial.dispose();
    this.nodes.dispose();
  }
}

function replacePositions(lines: LineSegments, places: Float32Array): void {
  lines.geometry.dispose();
  lines.geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(places, 3));
}

function sameIds(nodes: Background["nodes"], others: Background["nodes"]): boolean {
  if (nodes === others) return true;
  return nodes.length === others.length && nodes.every(({ id }, i) => id === others[i]?.id);
}

/** The edges of the grid, two positions of nodes each. */
function edgeNodes({ background }: Project): Uint32Array<ArrayBuffer> {
  return uniqueEdges(engineGrid(background).tetrahedra).slice();
}

/** Shaft and two heads per stretched node, in one plane. */
function arrowPlaces({ nodes }: Background, origin: Position): Float32Array {
  const places: number[] = [];
  for (const { at, size, stretching = 1, direction = [1, 0, 0] } of nodes) {
    const length = Math.hypot(...direction);
    if (!(stretching > 1) || !(length > 0)) continue;
    const half = (size * stretching) / 2;
    const [x, y, z] = direction.map((d) => (d / length) * half) as [number, number, number];
    // Any direction across the arrow will do.
    const across: Position = Math.abs(z) < 0.9 * half ? [-y, x, 0] : [0, -z, y];
    const breadth = (headLength * headSpread * half) / (Math.hypot(...across) || 1);
    const push = (along: number, aside: number): void => {
      [x, y, z].forEach((d, k) =>
        places.push((at[k] ?? 0) - (origin[k] ?? 0) + along * d + aside * breadth * (across[k] ?? 0)),
      );
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
  return Float32Array.from(places);
}
