import type { Mesh, MeshResult } from "tetrafront";
import { dataOf, fieldsOf } from "tetrafront/internal";
import { createStore, type StoreApi } from "zustand/vanilla";
import { lengthAt } from "../document/vectors";
import type { DocumentStore } from "./document-store";
import type { MeshRun } from "./run";
import { shownParts, type ShownMesh } from "./shown-mesh";

/** Values at the nodes or of the elements of a mesh: all components of the first one, then those of the next. */
export interface MeshField {
  readonly name: string;
  readonly components: number;
  readonly values: Float64Array;
  /** Default: at the nodes. */
  readonly isPerElement?: boolean | undefined;
}

/** A mesh with fields: one cycle of an adaptation, or a mesh from a file. */
export interface SolvedMesh extends ShownMesh {
  readonly fields: readonly MeshField[];
  /** Estimated interpolation error of the field that decides the sizes; null if it is not known. */
  readonly estimatedError: number | null;
  /** Least mean ratio of the elements in the metric that the mesh was made for; null without a metric. */
  readonly leastQuality: number | null;
}

/** Which values of a field are shown: its only one, a component, or the magnitude of the vector. */
export interface FieldChoice {
  readonly name: string;
  readonly component: number | "magnitude";
  /** What a reader calls the values. */
  readonly label: string;
  /** Whether it is a field of the elements. Default: at the nodes. */
  readonly isPerElement?: boolean | undefined;
}

/** Values that the view shows as colours. */
export interface ShownField {
  /** Those of the mesh that the values are of. Compared by identity. */
  readonly tetrahedra: Uint32Array;
  /** The field that they are of. Another solution on the same mesh has other fields. */
  readonly source: MeshField;
  readonly choice: FieldChoice;
  /** One per node or element. */
  readonly values: Float32Array<ArrayBuffer>;
  readonly isPerElement: boolean;
  readonly range: readonly [low: number, high: number];
  /** Number of values at which lines are drawn; 0 for none. */
  readonly lines: number;
  /** x y z per node by which the mesh is drawn deformed; null if it is not. */
  readonly offsets: Float32Array<ArrayBuffer> | null;
  /** Offsets / displacements of the nodes; 1 without offsets. */
  readonly enlargement: number;
}

/** What else the view shows of a field. */
export interface FieldShapes {
  /** Position of an isosurface between the least and the largest value, 0 to 1; null for none. */
  readonly isosurface: number | null;
  /** Whether the first field of vectors is shown as arrows. */
  readonly arrows: boolean;
  /** Whether the mesh is drawn with its displacements, enlarged so that they can be seen. */
  readonly deformed: boolean;
}

export interface SolutionState {
  readonly meshes: readonly SolvedMesh[];
  /** Index of the shown mesh in `meshes`; null if it is none of them. */
  readonly at: number | null;
  readonly choice: FieldChoice | null;
  readonly lines: number;
  readonly shapes: FieldShapes;
  readonly shown: ShownField | null;
  /** Why the last problem could not be solved; null if it was. */
  readonly failure: string | null;
}

const nothing: SolutionState = {
  meshes: [],
  at: null,
  choice: null,
  lines: 0,
  shapes: { isosurface: null, arrows: false, deformed: false },
  shown: null,
  failure: null,
};

/** The fields of the shown mesh, and the meshes that an adaptation has made. */
export class Solutions {
  readonly state: StoreApi<SolutionState> = createStore<SolutionState>(() => nothing);
  readonly #run: MeshRun;

  constructor(documents: DocumentStore, run: MeshRun) {
    this.#run = run;
    documents.onLeave(() => this.state.setState(nothing));
    run.state.subscribe(({ mesh }, before) => {
      if (mesh !== before.mesh) this.#follow(mesh);
    });
  }

  /** Lists meshes with their solutions, unless the shown mesh is none of them, for example after undo. The shown mesh stays. */
  list(meshes: readonly SolvedMesh[]): void {
    const at = indexIn(meshes, this.#run.state.getState().mesh);
    if (at !== null) this.#set({ meshes, at });
  }

  /** Shows one of the listed meshes. */
  show(index: number): void {
    const { meshes } = this.state.getState();
    const { mesh } = this.#run.state.getState();
    const other = meshes[index];
    if (mesh && other) this.#run.exchange(mesh, shownParts(other));
  }

  /** Shows values of a field as colours; null shows none. */
  choose(choice: FieldChoice | null): void {
    this.#set({ choice });
  }

  setLines(lines: number): void {
    this.#set({ lines });
  }

  setShapes(change: Partial<FieldShapes>): void {
    this.#set({ shapes: { ...this.state.getState().shapes, ...change } });
  }

  fail(failure: string | null): void {
    this.state.setState({ failure });
  }

  /** Returns a mesh with the fields of the listed one that is shown, if it has the same elements. */
  withFields(mesh: Mesh): Mesh {
    const { meshes, at } = this.state.getState();
    const solved = at === null ? undefined : meshes[at];
    if (solved?.mesh.mesh.tetrahedra !== mesh.tetrahedra) return mesh;
    return { ...mesh, ...dataOf(solved.fields) };
  }

  /** Forgets listed meshes if another mesh is shown; that may have fields of its file. */
  #follow(mesh: MeshResult | null): void {
    const { meshes } = this.state.getState();
    const at = indexIn(meshes, mesh);
    if (at !== null || mesh === null) return this.#set({ at });
    const fields = fieldsOf(mesh.mesh);
    if (fields.length === 0) this.#set({ meshes: [], at: null });
    else {
      const shown = shownParts({ ...this.#run.state.getState(), mesh });
      this.#set({ meshes: [{ ...shown, fields, estimatedError: null, leastQuality: null }], at: 0 });
    }
  }

  #set(change: Partial<SolutionState>): void {
    const state = { ...this.state.getState(), ...change };
    this.state.setState({ ...state, shown: shownField(state) });
  }
}

/** Returns which mesh has the elements of another one; curved elements are the same elements. */
function indexIn(meshes: readonly SolvedMesh[], shown: MeshResult | null): number | null {
  const index = meshes.findIndex(({ mesh }) => mesh.mesh.tetrahedra === shown?.mesh.tetrahedra);
  return index < 0 ? null : index;
}

/** Returns the chosen field. One of the elements may have the name of one at the nodes. */
export function chosenField(fields: readonly MeshField[], choice: FieldChoice | null): MeshField | undefined {
  return fields.find(
    ({ name, isPerElement = false }) =>
      name === choice?.name && isPerElement === (choice.isPerElement ?? false),
  );
}

/** Returns the first field of vectors at the nodes: the chosen one if it is one. */
export function vectorField({ fields }: SolvedMesh, choice: FieldChoice | null): MeshField | undefined {
  const vectors = fields.filter(({ components, isPerElement }) => components === 3 && isPerElement !== true);
  return vectors.find(({ name }) => name === choice?.name) ?? vectors[0];
}

/** Returns the displacements of the nodes of a solution. */
export const displacementsIn = ({ fields }: SolvedMesh): MeshField | undefined =>
  fields.find(
    ({ name, components, isPerElement }) =>
      components === 3 && isPerElement !== true && /displacement/i.test(name),
  );

/** Largest displacement as it is drawn, relative to the diagonal of the mesh. */
const drawnDeformation = 0.08;

/** Returns displacements, enlarged or reduced so that they can be seen. */
function deformation(
  { values }: MeshField,
  points: Float64Array,
): Pick<ShownField, "offsets" | "enlargement"> {
  let longest = 0;
  for (let i = 0; i < values.length; i += 3) longest = Math.max(longest, lengthAt(values, i, 3));
  const enlargement = longest === 0 ? 1 : (drawnDeformation * diagonalOf(points)) / longest;
  return { offsets: Float32Array.from(values, (value) => enlargement * value), enlargement };
}

/** Returns the diagonal of the box around positions. */
export function diagonalOf(points: Float64Array): number {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; ++i) {
    const x = points[i] ?? 0;
    if (x < (low[i % 3] ?? 0)) low[i % 3] = x;
    if (x > (high[i % 3] ?? 0)) high[i % 3] = x;
  }
  return points.length === 0 ? 0 : Math.hypot(...high.map((x, axis) => x - (low[axis] ?? 0)));
}

const atRest = { offsets: null, enlargement: 1 } as const;

function shownField(state: SolutionState): ShownField | null {
  const { meshes, at, choice, lines, shown, shapes } = state;
  const solved = at === null ? undefined : meshes[at];
  const field = chosenField(solved?.fields ?? [], choice);
  if (!solved || !field || !choice) return null;
  const { tetrahedra } = solved.mesh.mesh;
  const displacements = shapes.deformed ? displacementsIn(solved) : undefined;
  const isSame = shown?.tetrahedra === tetrahedra && shown.source === field && shown.choice === choice;
  if (isSame && shown.lines === lines && (shown.offsets !== null) === (displacements !== undefined))
    return shown;
  const moved = displacements ? deformation(displacements, solved.mesh.mesh.points) : atRest;
  if (isSame) return { ...shown, lines, ...moved };
  const values = valuesOf(field, choice.component);
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  const { isPerElement = false } = field;
  // Without any value, all have one colour.
  const range: ShownField["range"] = low <= high ? [low, high] : [0, 0];
  return { tetrahedra, source: field, choice, values, isPerElement, range, lines, ...moved };
}

/** Returns one value per node or element. */
function valuesOf(
  { components, values }: MeshField,
  component: FieldChoice["component"],
): Float32Array<ArrayBuffer> {
  const shown = new Float32Array(values.length / components);
  for (let node = 0; node < shown.length; ++node) {
    const first = components * node;
    shown[node] =
      component === "magnitude" ? lengthAt(values, first, components) : (values[first + component] ?? 0);
  }
  return shown;
}
