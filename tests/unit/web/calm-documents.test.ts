import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { renameProject } from "../../../web/document/edits";
import { calmDocuments } from "../../../web/panels/shared/calm-documents";
import { DocumentStore } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

it("panels follow a gesture ten times per second, its end and all other edits at once", () => {
  const documents = new DocumentStore(cubeProject(), () => 0);
  const calm = calmDocuments(documents.state);
  expect(calmDocuments(documents.state)).toBe(calm);
  const name = () => calm.getState().history.present.project.name;
  let changes = 0;
  calm.subscribe(() => ++changes);
  documents.edit(renameProject("edited"));
  expect(name()).toBe("edited");
  const gesture = documents.begin("Move");
  changes = 0;
  for (let step = 1; step <= 60; ++step) {
    gesture.update(renameProject(`step ${step}`));
    vi.advanceTimersByTime(1000 / 60);
  }
  expect(changes).toBeGreaterThanOrEqual(8);
  expect(changes).toBeLessThanOrEqual(11);
  gesture.update(renameProject("last"));
  vi.advanceTimersByTime(100);
  expect(name()).toBe("last");
  gesture.update(renameProject("end"));
  gesture.commit();
  expect(name()).toBe("end");
});

it("panels that take long follow a gesture less often, but still twice per second", async () => {
  const documents = new DocumentStore(cubeProject(), () => 0);
  const calm = calmDocuments(documents.state);
  let [changes, took] = [0, 20];
  calm.subscribe(() => {
    ++changes;
    vi.advanceTimersByTime(took);
  });
  const gesture = documents.begin("Move");
  const follow = async (): Promise<number> => {
    changes = 0;
    for (const begin = performance.now(); performance.now() < begin + 3000;) {
      gesture.update(renameProject(`at ${performance.now()}`));
      await Promise.resolve();
      vi.advanceTimersByTime(16);
    }
    return changes;
  };
  // 20 ms are a fifteenth of 300 ms.
  const often = await follow();
  expect(often).toBeGreaterThanOrEqual(8);
  expect(often).toBeLessThanOrEqual(11);
  took = 200;
  await follow();
  const seldom = await follow();
  expect(seldom).toBeGreaterThanOrEqual(4);
  expect(seldom).toBeLessThanOrEqual(7);
  gesture.update(renameProject("end"));
  gesture.commit();
  expect(calm.getState().history.present.project.name).toBe("end");
});
