import { createMesher, type Mesher } from "tetrafront";
import { afterAll, beforeAll, expect, it, vi } from "vitest";
import { addPoint, emptyProject } from "../../../web/document/create";
import { BodyFeed } from "../../../web/session/bodies";
import { BodyCheck } from "../../../web/session/body-check";
import { DocumentStore } from "../../../web/session/document-store";
import { PreviewFeed } from "../../../web/session/preview";
import { ProblemList } from "../../../web/session/problems";
import { MeshRun } from "../../../web/session/run";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

it("an empty project has no problems until it is meshed or something is drawn", async () => {
  const documents = new DocumentStore(emptyProject("new"), () => 0);
  const previews = new PreviewFeed(documents, Promise.resolve(mesher));
  const run = new MeshRun(documents, Promise.resolve(mesher));
  const bodies = new BodyFeed(documents, Promise.resolve(mesher));
  const check = new BodyCheck(documents, Promise.resolve(mesher), bodies);
  const problems = new ProblemList({ documents, previews, bodies, check, run });
  const count = (): number => problems.state.getState().problems.length;
  await vi.waitFor(() => expect(previews.state.getState().preview?.diagnostics.length).toBeGreaterThan(0));
  expect(count()).toBe(0);
  await run.generate();
  expect(count()).toBeGreaterThan(0);
  run.state.setState({ outcome: null });
  expect(count()).toBe(0);
  documents.edit(addPoint(documents.project, [0, 0, 0]).edit);
  await vi.waitFor(() => expect(count()).toBeGreaterThan(0));
});
