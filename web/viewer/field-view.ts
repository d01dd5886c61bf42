import type { StoreApi } from "zustand/vanilla";
import type { Position } from "../document/position";
import { diagonalOf, vectorField, type SolutionState, type Solutions } from "../session/solutions";
import { viridisAt } from "../ui/theme/viridis";
import { FieldLayer } from "./layers/field-layer";
import { arrowsOf } from "./queries/field-shapes";
import type { MeshQueryClient } from "./queries/mesh-query-client";
import type { Viewer } from "./viewer";

/** What the shapes of a field are drawn with. */
export interface FieldViewParts {
  readonly solutions: Solutions;
  readonly meshQueries: MeshQueryClient;
  readonly viewer: StoreApi<{ readonly viewer: Viewer | null }>;
}

/** Length of the longest arrow, relative to the diagonal of the mesh. */
const arrowLength = 0.07;

/** Draws the isosurface and the arrows that the user has chosen, in each view of the page. */
export class FieldView {
  readonly #parts: FieldViewParts;
  #layer = new FieldLayer();
  #shown: SolutionState | null = null;
  /** Number of isosurfaces asked for: only the last one counts. */
  #asked = 0;

  constructor(parts: FieldViewParts) {
    this.#parts = parts;
    parts.viewer.subscribe(({ viewer }) => this.#attach(viewer));
    parts.solutions.state.subscribe((state) => this.#draw(state));
    this.#attach(parts.viewer.getState().viewer);
  }

  #attach(viewer: Viewer | null): void {
    if (!viewer) return;
    // The view before has disposed of its layers.
    this.#layer = new FieldLayer();
    viewer.addLayer(this.#layer);
    this.#shown = null;
    this.#draw(this.#parts.solutions.state.getState());
  }

  #draw(state: SolutionState): void {
    const before = this.#shown;
    this.#shown = state;
    const isOfSameMesh = before !== null && before.meshes === state.meshes && before.at === state.at;
    const isSame = isOfSameMesh && before.shown === state.shown;
    if (!isSame || before.shapes.arrows !== state.shapes.arrows) this.#drawArrows(state);
    if (!isSame || before.shapes.isosurface !== state.shapes.isosurface) void this.#drawIsosurface(state);
  }

  #drawArrows({ meshes, at, choice, shapes }: SolutionState): void {
    const solved = at === null ? undefined : meshes[at];
    const field = shapes.arrows && solved ? vectorField(solved, choice) : undefined;
    const { points } = solved?.mesh.mesh ?? { points: new Float64Array() };
    this.#layer.setArrows(
      field ? arrowsOf(points, field.values, arrowLength * diagonalOf(points)) : new Float64Array(),
    );
    this.#redraw();
  }

  async #drawIsosurface({ meshes, at, shown, shapes }: SolutionState): Promise<void> {
    const asked = ++this.#asked;
    const solved = at === null ? undefined : meshes[at];
    if (shapes.isosurface === null || !shown || !solved) {
      this.#layer.setIsosurface(null);
      return this.#redraw();
    }
    const [low, high] = shown.range;
    const origin: Position = this.#layer.origin;
    const level = low + shapes.isosurface * (high - low);
    const corners = await this.#parts.meshQueries
      .isosurface(solved.mesh, shown, level, origin)
      // The view says why its faces could not be computed, by the same worker.
      .catch(() => null);
    if (asked !== this.#asked) return;
    this.#layer.setIsosurface(corners && { corners, origin, color: viridisAt(shapes.isosurface) });
    this.#redraw();
  }

  #redraw(): void {
    this.#parts.viewer.getState().viewer?.requestFrame();
  }
}
