import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import type { Project } from "tetrafront/project";
import { renameProject } from "../../../web/document/edits";
import { scaleSizes } from "../../../web/document/size-edits";
import type { Difference } from "../../../web/session/difference";
import { DocumentStore, hasUnsavedChanges, newDocument } from "../../../web/session/document-store";
import { documentWrite, type DocumentWrite, type Stored } from "../../../web/session/document-write";
import {
  maxKeptHistoryBytes,
  openKept,
  type DocumentHead,
  type KeptChange,
  type KeptContent,
  type KeptDocument,
} from "../../../web/session/kept-document";
import { cubeProject } from "../../support/projects";
import { afterWrite, keptDocument } from "./storage-doubles";

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
    expect(kept.content.grid?.tetrahedra).toHaveLength(4 * 3000);
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
    const opened = await openKept({
      ...kept,
      content: { ...kept.content, version: kept.content.version - 1 },
    });
    expect(opened?.history.past).toEqual([]);
    expect(opened?.history.present.project.name).toBe("edited");
  });

  it("is as it was opened if it is not listed, whatever keys an earlier version of the app has made", async () => {
    const kept = keptDocument(newDocument(cubeProject()), 0, false);
    const documents = new DocumentStore(cubeProject());
    const opened = await openKept({ ...kept, savedKey: "of an earlier version" });
    if (opened) documents.show(opened);
    expect(hasUnsavedChanges(documents.state.getState())).toBe(false);
  });

  it("is rejected if its project is invalid", async () => {
    const kept = keptDocument(newDocument(cubeProject()), 0, true);
    expect(await openKept({ ...kept, content: { ...kept.content, text: "{}" } })).toBeNull();
  });

  it("keeps its steps if an earlier version of the app has stored them as patches", async () => {
    // Written by that version: a document of 23 steps with its first and its last state. Eight of the steps are undone.
    const file = new URL("../../fixtures/kept-document-with-patches.json", import.meta.url);
    const { kept, first, last } = JSON.parse(readFileSync(file, "utf8")) as {
      readonly kept: DocumentHead & KeptContent;
      readonly first: Project;
      readonly last: Project;
    };
    const opened = await openKept({ ...kept, content: kept, changes: [] });
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

/** A change of a project into one without points. */
const invalid: Difference = { fields: { project: { fields: { points: { to: null } } } } };

describe("a document that is written after each step", () => {
  const bytesOf = (value: unknown): number => JSON.stringify(value).length;

  /** Writes the states of a document one after the other, as autosave does. */
  function writer(documents: DocumentStore) {
    let stored: Stored | null = null;
    let kept: KeptDocument | undefined;
    return {
      write: (): DocumentWrite => {
        const next = documentWrite(documents.state.getState(), stored, 0, true);
        ({ stored } = next);
        kept = afterWrite(kept, structuredClone(next.write));
        return next.write;
      },
      kept: (): KeptDocument => {
        if (!kept) throw new Error("Nothing was written");
        return kept;
      },
    };
  }

  /** A project of many points, which takes about half a megabyte. */
  const manyPoints = (): Project => ({
    ...cubeProject(),
    points: Array.from({ length: 10_000 }, (_, i) => ({ id: i + 1, position: [i, 1 / 3, 0] })),
  });

  it("takes less than a kilobyte for a point that was dragged, for undo and for redo, however many points there are", async () => {
    const documents = new DocumentStore(manyPoints());
    const { write, kept } = writer(documents);
    expect(bytesOf(write())).toBeGreaterThan(400_000);
    for (let i = 0; i < 20; ++i) {
      const gesture = documents.begin("Move");
      for (let move = 0; move < 3; ++move) {
        const points = documents.project.points.map((point) =>
          point.id === 5000 + i ? { ...point, position: [1 / 3, move / 7, i / 7] as const } : point,
        );
        gesture.update({ replace: { points } });
      }
      gesture.commit();
      expect(bytesOf(write())).toBeLessThan(1000);
    }
    for (const move of [() => documents.undo(), () => documents.undo(), () => documents.redo()]) {
      move();
      expect(bytesOf(write())).toBeLessThan(1000);
    }
    const opened = await openKept(kept());
    expect(opened?.history.present.project).toEqual(documents.project);
    expect([opened?.history.past.length, opened?.history.future.length]).toEqual([19, 1]);
  });

  it("is written as a whole again before its changes take long to read", async () => {
    const documents = new DocumentStore(manyPoints());
    const { write, kept } = writer(documents);
    write();
    let contents = 0;
    let length = 0;
    for (let i = 0; i < 300; ++i) {
      documents.edit(renameProject(`${i} `.padEnd(1000, "x")));
      const written = write();
      if ("content" in written) contents += 1;
      length = Math.max(length, bytesOf(kept().changes));
    }
    expect(contents).toBeGreaterThan(0);
    expect(contents).toBeLessThan(20);
    expect(length).toBeLessThan(bytesOf(kept().content));
    expect((await openKept(kept()))?.history.past).toHaveLength(300);
  });

  it("loses no change if a later version of the project file cannot use its steps", async () => {
    const documents = new DocumentStore(cubeProject(), () => 0);
    const { write, kept } = writer(documents);
    write();
    documents.edit(renameProject("edited"));
    write();
    const { content, ...rest } = kept();
    expect(rest.changes).toHaveLength(1);
    const opened = await openKept({ ...rest, content: { ...content, version: content.version - 1 } });
    expect(opened?.history.past).toEqual([]);
    expect(opened?.history.present.project.name).toBe("edited");
  });

  it.each<[string, Partial<KeptChange>]>([
    ["is not JSON", { steps: ["{"] }],
    ["goes back further than there are steps", { move: -9 }],
    ["lacks a long text", { steps: [JSON.stringify({ change: { to: "\u0001text missing" } })] }],
    ["leads to an invalid project", { steps: [JSON.stringify({ change: invalid })] }],
    ["continues another content", { stamp: "of another content" }],
    ["follows one that is missing", { number: 7 }],
  ])("opens as before a change that %s", async (_, broken) => {
    const documents = new DocumentStore(cubeProject(), () => 0);
    const { write, kept } = writer(documents);
    write();
    for (const name of ["first", "second", "third"]) {
      documents.edit(renameProject(name));
      write();
    }
    const { changes, ...rest } = kept();
    const opened = await openKept({
      ...rest,
      changes: changes.map((change, i) => (i === 1 ? { ...change, ...broken } : change)),
    });
    expect(opened?.history.present.project.name).toBe("first");
    expect(opened?.history.past).toHaveLength(1);
  });

  it("keeps what was stored last if steps beyond the limit lie between", async () => {
    const documents = new DocumentStore(cubeProject(), () => 0);
    const { write, kept } = writer(documents);
    documents.edit(renameProject("first"));
    documents.edit(renameProject("x".repeat(maxKeptHistoryBytes)));
    documents.edit(renameProject("last"));
    write();
    // The storage has neither the long step nor those before it.
    const check = async (): Promise<void> => {
      write();
      expect((await openKept(kept()))?.history.present.project).toEqual(documents.project);
    };
    for (let i = 0; i < 3; ++i, await check()) documents.undo();
    for (let i = 0; i < 3; ++i, await check()) documents.redo();
    documents.jumpTo(0);
    await check();
    documents.edit(renameProject("other"));
    await check();
    expect((await openKept(kept()))?.history.past).toHaveLength(1);
  });
});
