import type { App } from "../app/app";
import { booleanKinds, type BooleanKind } from "../document/booleans/kinds";
import type { Solid } from "../document/booleans/solids";
import { loadManifold } from "../session/manifold";
import { operationStrings } from "../strings";
import { define, type Command } from "./command";
import { showFailure, showMessage } from "./messages";
import { startOperation } from "./start-operation";

const texts = operationStrings.booleans;

/** Resolves when the samples of the view are those of the current project. */
async function samplesOf({ documents, previews }: App) {
  for (;;) {
    const { project } = documents;
    const { preview, project: sampled } = previews.state.getState();
    if (preview && sampled === project) return { project, preview };
    await new Promise<void>((resolve) => {
      const stop = previews.state.subscribe(() => {
        stop();
        resolve();
      });
    });
  }
}

/** Opens the panel of a Boolean operation on two bodies, or says what to select. */
async function startBoolean(app: App, kind: BooleanKind): Promise<void> {
  try {
    app.operations.cancel();
    const library = loadManifold();
    const [{ solidCandidates }, { booleanOperation }] = await Promise.all([
      import("../document/booleans/solids"),
      import("../document/operations/booleans"),
    ]);
    const { project, preview } = await samplesOf(app);
    const { selection } = app.view.state.getState();
    const candidates = solidCandidates(project, selection, preview);
    const solids = candidates.flatMap(({ solid }) => solid ?? []);
    const [first, second] = solids;
    if (candidates.length !== 2) {
      return showMessage(app, texts.title, [texts.twoBodies(candidates.length)]);
    }
    if (!first || !second) return showMessage(app, texts.title, [texts.open]);
    const both: readonly [Solid, Solid] = [first, second];
    startOperation(app, booleanOperation(await library, both, kind));
  } catch (error) {
    showFailure(app, texts.title, error);
  }
}

/** Commands that combine two closed bodies. */
export const booleanCommands: readonly Command[] = booleanKinds.map((kind) =>
  define("edit", 7)(`boolean-${kind}`, texts.commands[kind], (app) => void startBoolean(app, kind)),
);
