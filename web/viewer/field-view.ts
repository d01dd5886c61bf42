import type { StoreApi } from "zustand/vanilla";
import type { MeshResult } from "tetrafront";
import {
  diagonalOf,
  vectorField,
  type ShownField,
  type SolutionState,
  type Solutions,
} from "../session/solutions";
import { viridisAt } from "../ui/theme/viridis";
import { FieldLayer } from "./layers/field-layer";
import { arrowsOf } from "./queries/field-shapes";
import type { MeshQueryClient } from "./queries/mesh-query-client";
import type { Viewer } from "./viewer";

/** What the shapes of a field are drawn with. */
export interface FieldViewParts {
  readonly solutions: Solutions;
  readonly meshQueries: Pick<MeshQueryClient, "isosurface">;
  readonly viewer: StoreApi<{ readonly viewer: Viewer | null }>;
}

/** Which isosurface to draw. Compared by identity. */
interface WantedIsosurface {
  readonly mesh: MeshResult;
  readonly shown: ShownField;
  /** Between the least and the largest value, 0 to 1. */
  readonly position: number;
}

/** Length of the longest arrow, relative to the diagonal of the mesh. */
const arrowLength = 0.07;

/** Draws the isosurface and the arrows that the user has chosen, in each view of the page. */
export class FieldView {
  readonly #parts: FieldViewParts;
  #layer = new FieldLayer();
  #shown: SolutionState | null = null;
  #wanted: WantedIsosurface | null = null;
  #isQuerying = false;

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
    if (!isSame || before.shapes.isosurface !== state.shapes.isosurface) this.#drawIsosurface(state);
  }

  #drawArrows({ meshes, at, choice, shapes, shown }: SolutionState): void {
    const solved = at === null ? undefined : meshes[at];
    const field = shapes.arrows && shown && solved ? vectorField(solved, choice) : undefined;
    const { points } = solved?.mesh.mesh ?? { points: new Float64Array() };
    const length = arrowLength * diagonalOf(points);
    this.#layer.setArrows(
      field ? arrowsOf(moved(points, shown?.offsets ?? null), field.values, length) : new Float64Array(),
    );
    this.#redraw();
  }

  #drawIsosurface({ meshes, at, shown, shapes }: SolutionState): void {
    const solved = at === null ? undefined : meshes[at];
    const { isosurface: position } = shapes;
    const isShown = position !== null && shown?.isPerElement === false && solved;
    this.#wanted = isShown ? { mesh: solved.mesh, shown, position } : null;
    if (this.#wanted === null) {
      this.#layer.setIsosurface(null);
      return this.#redraw();
    }
    if (!this.#isQuerying) void this.#query();
  }

  /** Queries isosurfaces one after the other, until the one that is wanted at that time is drawn. */
  async #query(): Promise<void> {
    this.#isQuerying = true;
    let asked: WantedIsosurface | null = null;
    while (this.#wanted !== null && this.#wanted !== asked) {
      asked = this.#wanted;
      const { mesh, shown, position } = asked;
      const [low, high] = shown.range;
      const { origin } = this.#layer;
      const corners = await this.#parts.meshQueries
        .isosurface(mesh, shown, low + position * (high - low), origin)
        // The view says why its faces could not be computed, by the same worker.
        .catch(() => null);
      // While the value changes, the ones on the way are drawn too.
      if (!this.#wants(shown)) continue;
      this.#layer.setIsosurface(corners && { corners, origin, color: viridisAt(position) });
      this.#redraw();
    }
    this.#isQuerying = false;
  }

  /** Returns whether an isosurface of these values is wanted. */
  #wants(shown: ShownField): boolean {
    return this.#wanted?.shown === shown;
  }

  #redraw(): void {
    this.#parts.viewer.getState().viewer?.requestFrame();
  }
}

/** Returns positions with their offsets. */
const moved = (points: Float64Array, offsets: Float32Array | null): Float64Array =>
  offsets ? points.map((x, i) => x + (offsets[i] ?? 0)) : points;
