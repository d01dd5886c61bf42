import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import type { Project } from "tetrafront/project";
import { renameProject } from "../../../web/document/edits";
import { scaleSizes } from "../../../web/document/size-edits";
import { DocumentStore, hasUnsavedChanges, newDocument } from "../../../web/session/document-store";
import {
  keptDocument,
  maxKeptHistoryBytes,
  openKept,
  type KeptDocument,
} from "../../../web/session/kept-document";
import { cubeProject } from "../../support/projects";

/** Stores the document, loads it in another page and opens it there. */
async function reloaded(documents: DocumentStore): Promise<DocumentStore> {
  const kept = structuredClone(keptDocument(documents.state.getState(), 0, true));
  const opened = await openKept(kept);
  if (!opened) throw new Error("The kept document cannot be read");
  const others = new DocumentStore(cubeProject());
  others.show(opened);
  return others;
}

const labels = (documents: DocumentStore) => {
  const { past, future } = documents.state.getState().history;
  return { past: past.map(({ label }) => label), future: future.map(({ label }) => label) };
};

/** A cube with a background grid so large that it is stored as arrays. */
function largeProject(): Project {
  const cube = cubeProject();
  const [tetrahedron] = cube.background.tetrahedra;
  if (!tetrahedron) throw new Error("The cube has no tetrahedra");
  return {
    ...cube,
    background: { ...cube.background, tetrahedra: Array.from({ length: 3000 }, () => tetrahedron) },
  };
}

describe("a kept document", () => {
  it("is restored with its undo and redo steps, its id and the state of its file", async () => {
    const documents = new DocumentStore(cubeProject(), () => 0);
    const { id } = documents.state.getState();
    for (const name of ["first", "second", "third"]) documents.edit(renameProject(name));
    documents.edit(scaleSizes(documents.project, 0.5));
    documents.markSaved(id, documents.project, null);
    documents.undo();
    documents.undo();
    const others = await reloaded(documents);
    expect(others.state.getState().id).toBe(id);
    expect(others.project).toEqual(documents.project);
    expect(labels(others)).toEqual(labels(documents));
    expect(hasUnsavedChanges(others.state.getState())).toBe(true);
    others.redo();
    others.redo();
    expect(hasUnsavedChanges(others.state.getState())).toBe(false);
    for (let i = 0; i < 4; ++i) others.undo();
    expect(others.project).toEqual(cubeProject());
  });

  it("restores large background grids and the steps around them", async () => {
    const documents = new DocumentStore(largeProject(), () => 0);
    documents.edit(renameProject("large"));
    const kept = keptDocument(documents.state.getState(), 0, true);
    expect(kept.grid?.tetrahedra).toHaveLength(4 * 3000);
    const others = await reloaded(documents);
    expect(others.project).toEqual(documents.project);
    others.undo();
    expect(others.project.name).toBe("Unit cube");
  });

  it("drops steps beyond its limit, first those furthest from the present", async () => {
    const documents = new DocumentStore(cubeProject(), () => 0);
    documents.edit(renameProject("small"));
    documents.edit(renameProject("x".repeat(maxKeptHistoryBytes)));
    documents.edit(renameProject("next"));
    documents.edit(renameProject("last"));
    documents.undo();
    const others = await reloaded(documents);
    expect(labels(others)).toEqual({ past: [], future: ["Rename project"] });
    others.redo();
    expect(others.project.name).toBe("last");
  });

  it("never merges an edit after the reload into an earlier step", async () => {
    const documents = new DocumentStore(cubeProject(), () => 0);
    documents.edit({ ...renameProject("before"), mergeKey: "name" });
    const others = await reloaded(documents);
    others.edit({ ...renameProject("after"), mergeKey: "name" });
    others.undo();
    expect(others.project.name).toBe("before");
  });

  it("opens without its steps if they belong to another version of the project file", async () => {
    const documents = new DocumentStore(cubeProject(), () => 0);
    documents.edit(renameProject("edited"));
    const kept = keptDocument(documents.state.getState(), 0, true);
    const opened = await openKept({ ...kept, version: kept.version - 1 });
    expect(opened?.history.past).toEqual([]);
    expect(opened?.history.present.project.name).toBe("edited");
  });

  it("is rejected if its project is invalid", async () => {
    const kept = keptDocument(newDocument(cubeProject()), 0, true);
    expect(await openKept({ ...kept, text: "{}" })).toBeNull();
  });

  it("keeps its steps if an earlier version of the app has stored them as patches", async () => {
    // Written by that version: a document of 23 steps, of which 8 are undone, with its first and its last state.
    const file = new URL("../../fixtures/kept-document-with-patches.json", import.meta.url);
    const { kept, first, last } = JSON.parse(readFileSync(file, "utf8")) as {
      readonly kept: KeptDocument;
      readonly first: Project;
      readonly last: Project;
    };
    const opened = await openKept(kept);
    if (!opened) throw new Error("The document cannot be read");
    const documents = new DocumentStore(cubeProject());
    documents.show(opened);
    expect(documents.project).toEqual(JSON.parse(kept.text));
    expect([opened.history.past.length, opened.history.future.length]).toEqual([15, 8]);
    documents.jumpTo(0);
    expect(documents.project).toEqual(first);
    documents.jumpTo(23);
    expect(documents.project).toEqual(last);
  });
});
