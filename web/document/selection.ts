import type { Project, LineType, SourceType } from "tetrafront/project";
import { createStore, type StoreApi } from "zustand/vanilla";
import type { Brush } from "./brush";
import type { QualitySpace } from "./mesh-quality";
import { entityKey, entityOfKey, existingIn, sameEntity, type Entity } from "./entities";
import type { Position } from "./position";
import type { CircleBy, HandleMode, Snapping, ToolName } from "./tools";
import { principalPlane, type WorkPlane } from "./work-plane";

/** The state of the view, which undo does not change: selection, visibility, cut, shading. */

export type Layer = "points" | "lines" | "patches" | "bodies" | "background" | "sources" | "mesh";
export type CutAxis = "x" | "y" | "z";
/** What the view shows of the smoothness of patches. */
export type Smoothness = "none" | "zebra" | "gaussian" | "largest";
export type Shading = "radius-ratio" | "dihedral" | "region" | "plain";

export interface Cut {
  readonly enabled: boolean;
  readonly axis: CutAxis;
  /** Between the two ends of the mesh along the axis, 0 to 1. */
  readonly position: number;
  /** False keeps the part below the plane, true the part above. */
  readonly flipped: boolean;
}

/** A plane across the model, on which target sizes are shown. */
export interface SizePlane {
  readonly axis: CutAxis;
  /** Between the two ends of the model along the axis, 0 to 1. */
  readonly position: number;
}

export interface ViewState {
  /** In the order of selection. A chain of points is closed if its last point is the first one again. */
  readonly selection: readonly Entity[];
  readonly hover: Entity | null;
  /** Index of a tetrahedron picked on a cut or in a list. */
  readonly element: number | null;
  /** Indices of triangles picked in a list of problems, in the surface of the last run or of `markedBody`. */
  readonly triangles: readonly number[];
  /** Id of the body that `triangles` belong to; null for the surface of the last run. */
  readonly markedBody: number | null;
  /** A position picked in a list, for example of repairs. */
  readonly markedPosition: Position | null;
  /** Which triangles of bodies are drawn where no mesh is: the given ones, or those of the preview. */
  readonly bodySurface: "given" | "new";
  /** Keys of the entities that are not drawn. */
  readonly hidden: ReadonlySet<string>;
  readonly layers: Readonly<Record<Layer, boolean>>;
  /** Ids of the regions of the mesh that are not drawn. */
  readonly hiddenRegions: ReadonlySet<number>;
  readonly cut: Cut;
  readonly shading: Shading;
  /** What the view shows on the patches, instead of the mesh: how smooth they are. */
  readonly smoothness: Smoothness;
  /** Whether the view shows the target sizes instead of the mesh, and on which plane. */
  readonly sizes: { readonly enabled: boolean; readonly plane: SizePlane | null };
  /** Where the quality of a stretched mesh is measured, wherever the page shows it. */
  readonly qualitySpace: QualitySpace;
  readonly edges: boolean;
  readonly tool: ToolName;
  /** What a drag with the left button does: it selects what lies in a box, or orbits. */
  readonly leftDrag: "select" | "orbit";
  /** Type of the lines that the line tool draws. */
  readonly lineType: LineType;
  /** What the line tool picks for a circle: its centre and a place on it, or three places on it. */
  readonly circleBy: CircleBy;
  /** Type of the sources that the source tool draws. */
  readonly sourceType: SourceType;
  readonly workPlane: WorkPlane;
  /** What the handles of the move tool do. */
  readonly handleMode: HandleMode;
  readonly snapping: Snapping;
  /** The brush with which the left button paints sizes; null if it selects. */
  readonly brush: Brush | null;
  /** What the handles in the view do; null without handles. */
  readonly moving: Moving | null;
  /** Show the ids of points. */
  readonly numbers: boolean;
  /** Every click toggles, as if Ctrl were held: for touch screens. */
  readonly several: boolean;
}

const nothingMarked = { element: null, triangles: [], markedBody: null, markedPosition: null } as const;

const initialView: ViewState = {
  selection: [],
  hover: null,
  ...nothingMarked,
  bodySurface: "new",
  hidden: new Set(),
  layers: {
    points: true,
    lines: true,
    patches: true,
    bodies: true,
    background: false,
    sources: false,
    mesh: true,
  },
  hiddenRegions: new Set(),
  cut: { enabled: false, axis: "x", position: 0.5, flipped: false },
  shading: "radius-ratio",
  smoothness: "none",
  sizes: { enabled: false, plane: { axis: "z", position: 0.5 } },
  qualitySpace: "metric",
  edges: true,
  tool: "select",
  leftDrag: "select",
  lineType: "straight",
  circleBy: "centre",
  sourceType: "segment",
  workPlane: principalPlane("xy"),
  handleMode: "translate",
  snapping: { grid: true, model: true, patches: true },
  brush: null,
  moving: null,
  numbers: false,
  several: false,
};

/** Returns whether the selection is a chain of points whose last point is the first one again. */
export function isClosedChain(selection: readonly Entity[]): boolean {
  const [first, ...rest] = selection;
  return first !== undefined && rest.length >= 3 && sameEntity(first, rest.at(-1) ?? null);
}

/**
 * Returns whether the entity is the first of at least three selected points, so that selecting it again
 * closes the chain.
 */
function closesChain(selection: readonly Entity[], entity: Entity): boolean {
  const isChain = selection.length >= 3 && selection.every(({ kind }) => kind === "point");
  return isChain && sameEntity(selection[0] ?? null, entity) && !isClosedChain(selection);
}

/** The body that handles in the view move. */
export interface Moving {
  readonly body: number;
  readonly mode: "translate" | "rotate";
}

export type SelectMode = "replace" | "add" | "toggle";

export class ViewStore {
  readonly state: StoreApi<ViewState> = createStore<ViewState>(() => initialView);

  /** Selects an entity; null with `replace` clears the selection. */
  select(entity: Entity | null, asked: SelectMode = "replace"): void {
    const { selection, several } = this.state.getState();
    const mode = asked === "replace" && several && entity !== null ? "toggle" : asked;
    if (entity === null) {
      if (mode === "replace" && !several) this.clear();
      return;
    }
    if ((mode === "add" || (mode === "toggle" && several)) && closesChain(selection, entity)) {
      this.state.setState({ selection: [...selection, entity], ...nothingMarked });
      return;
    }
    const opened = isClosedChain(selection) ? selection.slice(0, -1) : selection;
    const others = opened.filter((selected) => !sameEntity(selected, entity));
    const wasSelected = others.length < opened.length;
    if (mode === "replace") this.state.setState({ selection: [entity], ...nothingMarked });
    else if (mode === "toggle" && wasSelected) this.state.setState({ selection: others });
    else this.state.setState({ selection: [...others, entity], ...nothingMarked });
  }

  clear(): void {
    this.state.setState({ selection: [], ...nothingMarked });
  }

  /** Selects entities in one step: all of them, with the selection before, or each the other way round. */
  selectMany(entities: readonly Entity[], mode: SelectMode): void {
    const { selection } = this.state.getState();
    const before = new Set(selection.map(entityKey));
    const given = new Set(entities.map(entityKey));
    const added = entities.filter((entity) => !before.has(entityKey(entity)));
    if (mode === "replace") this.selectAll(entities);
    else if (mode === "add") this.selectAll([...selection, ...added]);
    else this.selectAll([...selection.filter((entity) => !given.has(entityKey(entity))), ...added]);
  }

  /** Selects the given entities and nothing else. */
  selectAll(entities: readonly Entity[]): void {
    this.state.setState({ selection: entities, ...nothingMarked });
    for (const { kind } of entities) this.reveal(kind);
  }

  /** Shows the layer of a kind that is hidden by default. */
  reveal(kind: Entity["kind"]): void {
    if (kind === "background-node") this.setLayer("background", true);
    if (kind === "source") this.setLayer("sources", true);
  }

  selectElement(element: number | null): void {
    this.state.setState({ ...nothingMarked, element, selection: [] });
  }

  /** Removes the highlight of an element, of triangles or of a position: their mesh is no longer shown. */
  unmark(): void {
    const { element, triangles, markedPosition } = this.state.getState();
    if (element !== null || triangles.length > 0 || markedPosition) this.state.setState(nothingMarked);
  }

  /** Highlights triangles of a body; without one, of the surface of the last run. */
  markTriangles(triangles: readonly number[], markedBody: number | null = null): void {
    const { selection } = this.state.getState();
    // The card of a body lists its problems, so it stays.
    this.state.setState({
      ...nothingMarked,
      triangles,
      markedBody,
      selection: markedBody === null ? [] : selection,
    });
  }

  /** Marks a position in the view; the selection stays. */
  markPosition(position: Position): void {
    this.state.setState({ ...nothingMarked, markedPosition: position });
  }

  setHover(hover: Entity | null): void {
    if (!sameEntity(hover, this.state.getState().hover)) this.state.setState({ hover });
  }

  /** Takes a tool, and puts the brush and the handles of a body away. */
  setTool(tool: ToolName): void {
    this.state.setState({ tool, brush: null, moving: null });
  }

  /** Takes a brush, or puts it away. */
  setBrush(brush: Brush | null): void {
    this.state.setState({ brush, moving: null, tool: "select" });
    if (brush) this.setLayer("sources", true);
  }

  /** Shows handles that move or rotate a body, or hides them. */
  setMoving(moving: Moving | null): void {
    this.state.setState({ moving, brush: null, tool: "select" });
  }

  setLayer(layer: Layer, visible: boolean): void {
    if (this.state.getState().layers[layer] === visible) return;
    this.state.setState(({ layers }) => ({ layers: { ...layers, [layer]: visible } }));
  }

  toggleLayer(layer: Layer): void {
    this.setLayer(layer, !this.state.getState().layers[layer]);
  }

  toggleRegion(region: number): void {
    this.state.setState(({ hiddenRegions }) => {
      const next = new Set(hiddenRegions);
      if (!next.delete(region)) next.add(region);
      return { hiddenRegions: next };
    });
  }

  /** Shows all regions, because the new mesh has other regions. */
  showAllRegions(): void {
    if (this.state.getState().hiddenRegions.size > 0) this.state.setState({ hiddenRegions: new Set() });
  }

  setCut(change: Partial<Cut>): void {
    this.state.setState(({ cut }) => ({ cut: { ...cut, ...change } }));
  }

  setSizes(change: Partial<ViewState["sizes"]>): void {
    this.state.setState(({ sizes }) => ({ sizes: { ...sizes, ...change } }));
  }

  /** Cuts across another axis and keeps the part whose cut faces the isometric view. */
  cutAcross(axis: CutAxis): void {
    this.setCut({ enabled: true, axis, flipped: axis === "y" });
  }

  setHidden(entities: readonly Entity[], hide: boolean): void {
    this.state.setState(({ hidden }) => {
      const next = new Set(hidden);
      for (const entity of entities) {
        if (hide) next.add(entityKey(entity));
        else next.delete(entityKey(entity));
      }
      return { hidden: next };
    });
  }

  /** Forgets what a project does not have: new entities may get the ids of removed ones. */
  forgetRemoved(project: Project): void {
    const { selection, hidden } = this.state.getState();
    const selected = existingIn(project, selection);
    if (selected.length < selection.length) this.state.setState({ selection: selected });
    if (hidden.size === 0) return;
    const stillHidden = existingIn(
      project,
      [...hidden].flatMap((key) => entityOfKey(key) ?? []),
    );
    if (stillHidden.length < hidden.size)
      this.state.setState({ hidden: new Set(stillHidden.map(entityKey)) });
  }

  showAll(): void {
    this.state.setState(({ layers }) => ({
      hidden: new Set(),
      hiddenRegions: new Set(),
      layers: { ...layers, points: true, lines: true, patches: true, bodies: true, mesh: true },
    }));
  }

  /** Resets everything that refers to entities of the project, before another project is shown. */
  reset(): void {
    this.state.setState({
      selection: [],
      hover: null,
      ...nothingMarked,
      hidden: new Set(),
      hiddenRegions: new Set(),
      tool: "select",
      workPlane: principalPlane("xy"),
      brush: null,
      moving: null,
      several: false,
    });
  }
}
