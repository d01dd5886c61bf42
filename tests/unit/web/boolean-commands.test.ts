/** Boolean commands wait for a library and for samples; what the user does meanwhile takes precedence. */
import Module, { type ManifoldToplevel } from "manifold-3d";
import { createMesher, type Mesher } from "tetrafront";
import type { Project } from "tetrafront/project";
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { App } from "../../../web/app/app";
import { booleanCommands } from "../../../web/commands/boolean-commands";
import type { BooleanKind } from "../../../web/document/booleans/kinds";
import { emptyProject } from "../../../web/document/create";
import type { Entity } from "../../../web/document/entities";
import { renameProject } from "../../../web/document/edits";
import { newDocument } from "../../../web/session/document-store";
import * as manifold from "../../../web/session/manifold";
import { pieceOperations } from "../../../web/document/operations/pieces";
import { operationStrings } from "../../../web/strings";
import { cubeProject } from "../../support/projects";
import { SilentWorker } from "../../support/silent-worker";

/** What the command waits for: the library, or its failure. */
let end: (library: Promise<ManifoldToplevel>) => void;
/** Decides the answers of previews. */
let sample: Mesher["previewProject"];
let app: App;

beforeEach(async () => {
  vi.stubGlobal("Worker", SilentWorker);
  vi.stubGlobal("document", { baseURI: "https://example.org/" });
  const loading = new Promise<ManifoldToplevel>((resolve) => (end = resolve));
  vi.spyOn(manifold, "loadManifold").mockImplementation(() => loading);
  const real = await createMesher();
  sample = (...question) => real.previewProject(...question);
  const idle = { meshProject: () => new Promise(() => undefined) } as unknown as Mesher;
  const previewMesher = {
    previewProject: (...question: Parameters<typeof sample>) => sample(...question),
    sampleSizes: () => new Promise(() => undefined),
  } as unknown as Mesher;
  app = new App(
    {
      first: { document: newDocument(twoCubes()) },
      mesher: Promise.resolve(idle),
      previewMesher: Promise.resolve(previewMesher),
      library: null,
    },
    { gallery: { opening: "cube", models: [] }, generate: false, still: true },
  );
});

afterEach(() => {
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
});

async function manifoldLibrary(): Promise<ManifoldToplevel> {
  const library = await Module();
  library.setup();
  return library;
}

/** Two cubes that intersect. */
function twoCubes(): Project {
  const { points, lines, patches, ...others } = cubeProject();
  const far = 100;
  return {
    ...others,
    points: [
      ...points,
      ...points.map(({ id, position: [x, y, z] }) => ({
        id: id + far,
        position: [x + 0.5, y + 0.5, z + 0.5] as const,
      })),
    ],
    lines: [
      ...lines,
      ...lines.map((line) => ({ ...line, id: line.id + far, points: line.points.map((id) => id + far) })),
    ],
    patches: [
      ...patches,
      ...patches.map((patch) => ({
        ...patch,
        id: patch.id + far,
        loops: patch.loops.map((loop) => loop.map((step) => step + Math.sign(step) * far)),
      })),
    ],
  };
}

const start = (kind: BooleanKind): void =>
  booleanCommands.find(({ id }) => id === `boolean-${kind}`)?.run(app);
const opened = (): string | undefined => app.operations.state.getState().open?.operation.step;
/** What is said beside the work, in a notice, or in the way, in a dialog. */
const message = (): string | undefined => {
  const { message, notices } = app.shell.getState();
  return message?.lines.join() ?? notices[0]?.text;
};
/** Ends the loading, and waits for what the command then does. */
async function load(library: Promise<ManifoldToplevel> = manifoldLibrary()): Promise<void> {
  end(library);
  await library.catch(() => undefined);
  await new Promise((resolve) => setTimeout(resolve, 50));
}

const { steps } = operationStrings.booleans;

it("opens its panel once the library and the samples are there", async () => {
  start("union");
  expect(opened()).toBeUndefined();
  await load();
  await vi.waitFor(() => expect(opened()).toBe(steps.union));
});

it.each<readonly [string, readonly Entity[]]>([
  ["nothing is selected", []],
  ["one of them is selected", [{ kind: "patch", id: 101 }]],
])("takes the only two bodies if %s, the one with the first patch first", async (_, selection) => {
  const cubes = twoCubes();
  // The points of the second body come first.
  app.showProject({ ...cubes, points: cubes.points.toReversed() });
  app.view.selectAll(selection);
  start("difference");
  await load();
  await vi.waitFor(() => expect(opened()).toBe(steps.difference));
  const { points } = app.documents.project;
  // The difference keeps the origin, a corner of the first cube, and no node of the far corner of the second.
  expect(points.some(({ position }) => position.every((x) => x === 0))).toBe(true);
  expect(points.some(({ position }) => position.every((x) => x === 1.5))).toBe(false);
});

it("asked twice, opens the panel of the second", async () => {
  start("union");
  start("difference");
  await load();
  await vi.waitFor(() => expect(opened()).toBe(steps.difference));
  expect(app.documents.state.getState().history.past).toHaveLength(0);
});

it.each<readonly [string, () => void]>([
  ["an edit", () => app.documents.edit(renameProject("other"))],
  ["another selection", () => app.view.selectAll([{ kind: "patch", id: 1 }])],
  ["another project", () => app.showProject(emptyProject("other"))],
  ["another operation", () => pieceOperations.slice(0, 1).forEach((box) => app.operations.start(box))],
])("gives way to %s", async (_, change) => {
  start("union");
  await vi.waitFor(() => expect(app.previews.busy).toBe(false));
  change();
  const before = opened();
  await load();
  await vi.waitFor(() => expect(app.previews.busy).toBe(false));
  expect(opened()).toBe(before);
  expect(message()).toBeUndefined();
});

it("says why the library is missing", async () => {
  start("union");
  await load(Promise.reject(new Error("no network")));
  expect(message()).toBe("no network");
});

it("says why there are no samples", async () => {
  sample = () => Promise.reject(new Error("no memory"));
  app.documents.edit(renameProject("other"));
  start("union");
  await load();
  await vi.waitFor(() => expect(message()).toBe("no memory"));
});
