import type { LineType, PatchType, SourceType, Project } from "tetrafront/project";
import { create, takeOffer } from "./creation-actions";
import type { App } from "../app/app";
import { commandLabels } from "../strings";
import { define, type Command, type MenuName } from "./command";
import {
  addSource,
  offerClosedSpline,
  offerHole,
  offerLine,
  offerPatch,
  offerSource,
  offerTetrahedron,
  type Offer,
} from "../document/create";
import { offerSplit } from "../document/grid-edits";
import type { Entity } from "../document/entities";
import { offerLoft, offerSmooth } from "../document/smooth";
import { offerLineSplit } from "../document/splits/split-line";

/** Creates something from the selection. Each maker is a command and a button in the inspector. */
export interface Maker {
  readonly id: string;
  readonly label: string;
  readonly key: string | null;
  /** Kind of the selected entities that it needs; the inspector shows only the makers that fit the selection. */
  readonly from: Entity["kind"];
  /** Show no reason in the inspector if nothing can be created. */
  readonly quiet: boolean;
  readonly offer: (project: Project, selection: readonly Entity[]) => Offer;
}

const lineMaker = (type: LineType, key: string | null): Maker => ({
  id: `line-${type}`,
  label: commandLabels.lines[type],
  key,
  from: "point",
  quiet: false,
  offer: (project, selection) => offerLine(project, selection, type),
});

const patchMaker = (type: PatchType | null, key: string | null): Maker => ({
  id: `patch-${type ?? "any"}`,
  label: commandLabels.patches[type ?? "any"],
  key,
  from: "line",
  quiet: false,
  offer: (project, selection) => offerPatch(project, selection, type),
});

export const straightMaker = lineMaker("straight", "shift+L");
/** Makes a patch of the most likely type. */
export const anyPatchMaker = patchMaker(null, "shift+A");

export const lineMakers: readonly Maker[] = [
  straightMaker,
  lineMaker("parabolic", "Q"),
  lineMaker("spline", "S"),
  {
    id: "line-closed-spline",
    label: commandLabels.lines.closed,
    key: "shift+S",
    from: "point",
    quiet: false,
    offer: offerClosedSpline,
  },
  lineMaker("arc", "shift+Q"),
  lineMaker("circle", "C"),
  lineMaker("hermite", null),
];

export const patchMakers: readonly Maker[] = [
  anyPatchMaker,
  patchMaker("planar", null),
  patchMaker("coons", null),
  patchMaker("isoparametric-triangle", null),
  patchMaker("serendipity", null),
  patchMaker("barnhill-gregory-nielson", null),
  patchMaker("tube", null),
  patchMaker("gregory", null),
  patchMaker("nielson", null),
];

const loftMaker: Maker = {
  id: "loft",
  label: commandLabels.loftLines,
  key: null,
  from: "line",
  quiet: true,
  offer: offerLoft,
};

const smoothMaker: Maker = {
  id: "make-smooth",
  label: commandLabels.smooth,
  key: null,
  from: "patch",
  quiet: true,
  offer: offerSmooth,
};

const holeMaker: Maker = {
  id: "hole",
  label: commandLabels.hole,
  key: "O",
  from: "patch",
  quiet: false,
  offer: offerHole,
};

const tetrahedronMaker: Maker = {
  id: "tetrahedron",
  label: commandLabels.tetrahedron,
  key: "T",
  from: "background-node",
  quiet: false,
  offer: offerTetrahedron,
};

const splitMaker: Maker = {
  id: "split",
  label: commandLabels.split,
  key: null,
  from: "background-node",
  quiet: true,
  offer: offerSplit,
};

export const makers: readonly Maker[] = [
  ...lineMakers,
  ...patchMakers,
  loftMaker,
  smoothMaker,
  holeMaker,
  tetrahedronMaker,
  splitMaker,
];

const commandOf = (maker: Maker, section: number, menu: MenuName = "create"): Command =>
  define(menu, section)(
    maker.id,
    maker.label,
    (app) => createFrom(app, maker),
    maker.key === null ? {} : { keys: [maker.key] },
  );

/** Splits tetrahedra of the background grid. */
export const splitCommand = commandOf(splitMaker, 2, "mesh");

/** Runs a maker on the selection, or shows what to select first. */
export function createFrom(app: App, maker: Maker): void {
  const { selection } = app.view.state.getState();
  takeOffer(app, maker.label, maker.offer(app.documents.project, selection));
}

/** Runs the first maker that the selection fits, or shows a hint if it fits none. */
export function createOrHint(
  app: App,
  candidates: readonly Maker[],
  title: string,
  hint: readonly string[],
): void {
  const { selection } = app.view.state.getState();
  const possible = candidates.find(({ offer }) => offer(app.documents.project, selection).possible);
  if (possible) createFrom(app, possible);
  else app.shell.setState({ message: { title, lines: hint } });
}

/** Splits the selected line at the selected point, where the context menu was opened, or in its middle. */
function splitSelectedLine(app: App): void {
  const { selection } = app.view.state.getState();
  const { menuPosition } = app.drawing.state.getState();
  takeOffer(app, commandLabels.splitLine, offerLineSplit(app.documents.project, selection, menuPosition));
}

const sourceMaker = (type: SourceType): Maker => ({
  id: `source-${type}`,
  label: commandLabels.sources[type],
  key: null,
  from: "point",
  quiet: true,
  offer: (project, selection) => offerSource(project, selection, type),
});

/** Need selected points. The commands of the same names also work without a selection. */
export const sourceMakers: readonly Maker[] = [
  sourceMaker("point"),
  sourceMaker("segment"),
  sourceMaker("triangle"),
];

export const createMenu: readonly Command[] = [
  define("create", 1)(
    "new-point",
    commandLabels.newPoint,
    (app) => app.shell.setState({ dialog: "new-point" }),
    {
      keys: ["shift+P"],
    },
  ),
  ...lineMakers.map((maker) => commandOf(maker, 2)),
  define("create", 2)("split-line", commandLabels.splitLine, splitSelectedLine, {
    enabled: (app) => app.view.state.getState().selection.some(({ kind }) => kind === "line"),
  }),
  ...patchMakers.map((maker) => commandOf(maker, 3)),
  commandOf(loftMaker, 3),
  commandOf(smoothMaker, 3),
  commandOf(holeMaker, 3),
  define("create", 4)("new-node", commandLabels.newNode, (app) => app.shell.setState({ dialog: "new-node" })),
  commandOf(tetrahedronMaker, 4),
  ...(["point", "segment", "triangle"] as const).map((type) =>
    define("create", 5)(`source-${type}`, commandLabels.sources[type], (app) =>
      create(app, addSource(app.documents.project, app.view.state.getState().selection, type)),
    ),
  ),
];
