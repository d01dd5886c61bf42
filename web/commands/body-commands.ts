import { REMESH_DEFAULTS } from "tetrafront";
import type { ProjectBody } from "tetrafront/project";
import type { App } from "../app/app";
import { setCommonSurface } from "../document/body-edits";
import { newBrush } from "../document/brush";
import { bodiesOf, bodyOfEntity } from "../document/entities";
import { isFillable } from "../session/bodies";
import { commandLabels, paletteStrings } from "../strings";
import { define, type Command } from "./command";
import { previewSplit, repairBody } from "./surface-actions";

/** Returns the body that the selection belongs to; without a selection, the only body. */
function subjectOf({ documents: { project }, view }: App): ProjectBody | undefined {
  const { selection } = view.state.getState();
  const bodies = bodiesOf(project);
  if (selection.length === 0) return bodies.length === 1 ? bodies[0] : undefined;
  const ids = new Set(selection.map((entity) => bodyOfEntity(project, entity)));
  return ids.size === 1 ? bodies.find(({ id }) => ids.has(id)) : undefined;
}

const hasSubject = (app: App): boolean => subjectOf(app) !== undefined;

/** Shows the card of a body, unless that of one of its patches is shown. */
function showCard(app: App, { id }: ProjectBody): void {
  const { selection } = app.view.state.getState();
  if (selection.length !== 1) app.view.selectAll([{ kind: "body", id }]);
  app.shell.setState({ rightTab: "inspector", drawer: "right" });
}

/** Shows the split of the body, or of the selected patch, along sharp edges; the card applies it. */
function splitSubject(app: App): void {
  const body = subjectOf(app);
  if (!body) return;
  showCard(app, body);
  const [first] = app.view.state.getState().selection;
  const patch = first?.kind === "body-patch" ? first.id : null;
  void previewSplit(app, body, REMESH_DEFAULTS.featureAngle, patch);
}

function toggleBrush(app: App): void {
  const body = subjectOf(app);
  if (app.view.state.getState().brush) return app.view.setBrush(null);
  if (!body) return;
  app.view.selectAll([{ kind: "body", id: body.id }]);
  showCard(app, body);
  const { inspection, preparation } = app.bodies.state.getState().byId.get(body.id) ?? {};
  app.view.setBrush(newBrush(body, inspection?.box ?? null, preparation?.prepared.size));
}

/** Sets that meshing replaces the triangles of the selected bodies, or of all, and shows this setting. */
function remeshBodies({ documents, view, shell }: App): void {
  const { project } = documents;
  const selected = new Set(view.state.getState().selection.map((entity) => bodyOfEntity(project, entity)));
  const all = bodiesOf(project).map(({ id }) => id);
  const some = all.filter((id) => selected.has(id));
  const ids = some.length > 0 ? some : all;
  documents.edit(setCommonSurface(ids, "remesh"));
  view.selectAll(ids.map((id) => ({ kind: "body", id })));
  shell.setState({ rightTab: "inspector", drawer: "right" });
}

/** Returns the body if a repair is proposed that changes it. */
function repairableSubject(app: App): ProjectBody | undefined {
  const body = subjectOf(app);
  const state = body && app.bodies.state.getState().byId.get(body.id);
  const hasChanges = (state?.repair?.changes.length ?? 0) > 0;
  return state && !isFillable(state) && hasChanges ? body : undefined;
}

/** Commands for the given triangles of a body: those of its card that are used most. */
export const bodyCommands: readonly Command[] = [
  define("mesh", 4)("split-patches", commandLabels.splitPatches, splitSubject, {
    enabled: hasSubject,
    needs: paletteStrings.needs.body,
  }),
  define("mesh", 4)("paint-size", commandLabels.paintSize, toggleBrush, {
    needs: paletteStrings.needs.body,
    enabled: (app) => hasSubject(app) || app.view.state.getState().brush !== null,
    checked: (app) => app.view.state.getState().brush !== null,
  }),
  define("mesh", 4)(
    "repair-body",
    commandLabels.repairBody,
    (app) => {
      const body = repairableSubject(app);
      if (body) void repairBody(app, body.id);
    },
    { enabled: (app) => repairableSubject(app) !== undefined, needs: paletteStrings.needs.repair },
  ),
  define("mesh", 4)("remesh-bodies", commandLabels.remeshBodies, remeshBodies, {
    inMenu: false,
    enabled: ({ documents }) => bodiesOf(documents.project).length > 0,
    needs: paletteStrings.needs.bodies,
  }),
];
