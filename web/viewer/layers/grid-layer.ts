import type { Project } from "tetrafront";
import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments } from "three";
import { positionsById } from "../../document/entities";
import type { ViewerColors } from "../colors";
import { DotsLayer, type DotState } from "./dots-layer";
import type { Place, SceneLayer } from "./layer";

const edgesOfTetrahedron = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]] as const; // prettier-ignore

/** The background grid: edges of its tetrahedra, and its nodes as squares. */
export class GridLayer implements SceneLayer {
  readonly root = new Group();
  readonly #material = new LineBasicMaterial({ transparent: true, opacity: 0.5, depthWrite: false });
  readonly #edges = new LineSegments(new BufferGeometry(), this.#material);
  readonly nodes = new DotsLayer("square", (colors) => colors.backgroundGrid);

  constructor() {
    this.#edges.frustumCulled = false;
    this.root.add(this.#edges, this.nodes.root);
  }

  setColors(colors: ViewerColors): void {
    this.#material.color.set(colors.backgroundGrid);
    this.nodes.setColors(colors);
  }

  setGrid(project: Project, origin: Place): void {
    const { background } = project;
    const places = background.nodes.map((node) => node.at);
    this.nodes.setPlaces(places, origin);
    const positions = positionsById(project, "background-node");
    const drawn = new Set<string>();
    const ends: number[] = [];
    for (const tetrahedron of background.tetrahedra) {
      for (const [a, b] of edgesOfTetrahedron) {
        const edge = [tetrahedron[a], tetrahedron[b]].sort((x, y) => x - y);
        if (drawn.has(edge.join())) continue;
        drawn.add(edge.join());
        for (const id of edge) {
          const at = places[positions.get(id) ?? -1] ?? origin;
          ends.push(at[0] - origin[0], at[1] - origin[1], at[2] - origin[2]);
        }
      }
    }
    this.#edges.geometry.dispose();
    this.#edges.geometry = new BufferGeometry().setAttribute(
      "position",
      new BufferAttribute(Float32Array.from(ends), 3),
    );
  }

  setStates(states: readonly DotState[]): void {
    this.nodes.setStates(states);
  }

  dispose(): void {
    this.#edges.geometry.dispose();
    this.#material.dispose();
    this.nodes.dispose();
  }
}
