import type { Project } from "tetrafront/project";
import type { App } from "../app/app";
import { booleanKinds, type BooleanKind } from "../document/booleans/kinds";
import type { Solid } from "../document/booleans/solids";
import type { Entity } from "../document/entities";
import { solidBoolean } from "../document/operations/solid-booleans";
import { solidsOf as featureSolidsOf } from "../document/operations/solids";
import { loadManifold } from "../session/manifold";
import { operationStrings } from "../strings";
import { define, type Command } from "./command";
import { showFailure, showRefusal } from "./messages";
import { startOperation } from "./start-operation";

const texts = operationStrings.booleans;

/** Returns the solid with features that a body is; undefined for others. */
const solidWith = (project: Project, [entity]: readonly Entity[]) =>
  entity?.kind === "body" ? featureSolidsOf(project).find(({ id }) => id === entity.id) : undefined;

/** The latest request of each app: it replaces those that still wait. */
const latest = new WeakMap<App, symbol>();

/**
 * Opens the panel of a Boolean operation on two bodies, or shows what to select. Loading and sampling take time: if the
 * project or the selection changes meanwhile, or another operation is opened, nothing happens.
 */
async function startBoolean(app: App, kind: BooleanKind): Promise<void> {
  const request = Symbol(kind);
  latest.set(app, request);
  app.operations.cancel();
  const { project } = app.documents;
  const { selection } = app.view.state.getState();
  const isLatest = (): boolean =>
    latest.get(app) === request &&
    app.documents.project === project &&
    app.view.state.getState().selection === selection &&
    app.operations.state.getState().open === null;
  try {
    const [library, { solidOf, touchedBodies }, { booleanOperation }, preview] = await Promise.all([
      loadManifold(),
      import("../document/booleans/solids"),
      import("../document/operations/booleans"),
      app.previews.samples(),
    ]);
    if (!preview || !isLatest()) return;
    const selected = touchedBodies(project, selection);
    // A project with two bodies leaves no doubt which ones are meant.
    const all = selected.length < 2 ? touchedBodies(project, []) : [];
    const bodies = all.length === 2 ? all : selected;
    if (bodies.length !== 2) return showRefusal(app, texts.title, texts.twoBodies(bodies.length));
    const [solid, other] = bodies.map((entities) => solidWith(project, entities));
    if (solid && other) return startOperation(app, solidBoolean([solid, other], kind));
    const [first, second] = bodies.map((entities) => solidOf(project, entities, preview));
    if (!first || !second) return showRefusal(app, texts.title, texts.open);
    const both: readonly [Solid, Solid] = [first, second];
    startOperation(app, booleanOperation(library, both, kind));
  } catch (error) {
    if (isLatest()) showFailure(app, texts.title, error);
  }
}

/** Commands that combine two closed bodies. */
export const booleanCommands: readonly Command[] = booleanKinds.map((kind) =>
  define("edit", 7)(`boolean-${kind}`, texts.commands[kind], (app) => void startBoolean(app, kind)),
);
