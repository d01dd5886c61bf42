import { afterEach, describe, expect, it, vi } from "vitest";
import { deleteEntities, moveEntity, renameProject } from "../../../web/document/edits";
import {
  DocumentStore,
  hasUnsavedChanges,
  isUntouched,
  newDocument,
  savedState,
  settledProject,
  type ProjectFile,
} from "../../../web/session/document-store";
import { isStale, type RunState } from "../../../web/session/run-state";
import { cubeProject } from "../../support/projects";

afterEach(() => vi.restoreAllMocks());

const project = cubeProject();
const [first] = project.points;
const id = first?.id ?? 0;
const moveTo = (x: number) => moveEntity("point", id, 0, x);
const xOf = (documents: DocumentStore): number | undefined => documents.project.points[0]?.position[0];

function opened() {
  const documents = new DocumentStore(project, () => 0);
  const past = () => documents.state.getState().history.past.map(({ label }) => label);
  return { documents, past };
}

describe("a gesture", () => {
  it("shows every update and becomes one undo step", () => {
    const { documents, past } = opened();
    const gesture = documents.begin("Drag");
    for (let i = 1; i <= 50; ++i) {
      gesture.update(moveTo(i));
      expect(xOf(documents)).toBe(i);
    }
    expect(past()).toEqual([]);
    gesture.commit();
    expect(past()).toEqual(["Drag"]);
    expect(xOf(documents)).toBe(50);
    documents.undo();
    expect(documents.project).toEqual(project);
    documents.redo();
    expect(xOf(documents)).toBe(50);
  });

  it("applies each update to the project from before the gesture", () => {
    const { documents } = opened();
    const gesture = documents.begin("Drag");
    const shift = {
      change: ({ project: draft }: { project: { points: { position: number[] }[] } }) => {
        const position = draft.points[0]?.position;
        if (position) position[0] = (position[0] ?? 0) + 1;
      },
    };
    gesture.update(shift);
    gesture.update(shift);
    expect(xOf(documents)).toBe((first?.position[0] ?? 0) + 1);
  });

  it("restores the project and all undo and redo steps when it is cancelled", () => {
    const { documents } = opened();
    documents.edit(renameProject("before"));
    documents.edit(renameProject("after"));
    documents.undo();
    const { history } = documents.state.getState();
    const gesture = documents.begin("Drag");
    gesture.update(moveTo(9));
    gesture.cancel();
    expect(documents.state.getState().history).toBe(history);
    expect(documents.state.getState().gestureStart).toBeNull();
  });

  it("is cancelled by undo, which then undoes nothing else", () => {
    const { documents, past } = opened();
    documents.edit(renameProject("before"));
    documents.begin("Drag").update(moveTo(9));
    documents.undo();
    expect(past()).toEqual(["Rename project"]);
    expect(xOf(documents)).toBe(first?.position[0]);
  });

  it("is committed by an edit or another gesture; its handle then has no effect", () => {
    const { documents, past } = opened();
    const early = documents.begin("Drag");
    early.update(moveTo(5));
    documents.edit(renameProject("renamed"));
    expect(past()).toEqual(["Drag", "Rename project"]);
    early.update(moveTo(6));
    early.cancel();
    expect(xOf(documents)).toBe(5);
    documents.begin("Second").update(moveTo(7));
    documents.begin("Third").commit();
    expect(past()).toEqual(["Drag", "Rename project", "Second"]);
  });

  it("adds no undo step if it changes nothing", () => {
    const { documents } = opened();
    const { history } = documents.state.getState();
    documents.begin("Click").commit();
    expect(documents.state.getState().history).toBe(history);
  });

  it("computes no key until it ends; the mesh then counts as out of date and the project as unsaved", () => {
    const { documents } = opened();
    const run = { mesh: {}, meshKey: "key" } as unknown as RunState;
    const settled: unknown[] = [];
    documents.onSettled((changed) => settled.push(changed));
    const gesture = documents.begin("Drag");
    const stringify = vi.spyOn(JSON, "stringify");
    for (let i = 1; i <= 20; ++i) {
      gesture.update(moveTo(i));
      expect(isStale(run, documents.state.getState())).toBe(true);
      expect(hasUnsavedChanges(documents.state.getState())).toBe(true);
      expect(settledProject(documents.state.getState())).toBe(project);
    }
    expect(stringify).not.toHaveBeenCalled();
    expect(settled).toEqual([]);
    gesture.commit();
    expect(settled).toEqual([{ project: documents.project }]);
  });
});

describe("the identity of a document", () => {
  const fileOf = (name: string): ProjectFile => ({
    handle: { name } as FileSystemFileHandle,
    lastModified: 1,
  });
  const stateOf = (documents: DocumentStore) => documents.state.getState();

  it("belongs to one document with its file and its undo steps, which never lead to another document", () => {
    const { documents } = opened();
    documents.edit(moveTo(1));
    const a = stateOf(documents);
    documents.markSaved(a.id, documents.project, fileOf("a.json"));
    const before = documents.show(newDocument({ ...project, name: "B" }));
    expect(before.file?.handle.name).toBe("a.json");
    expect(stateOf(documents).id).not.toBe(a.id);
    expect(stateOf(documents).file).toBeNull();
    documents.undo();
    expect(documents.project.name).toBe("B");
    documents.show(before);
    expect(stateOf(documents).file?.handle.name).toBe("a.json");
    documents.undo();
    expect(documents.project).toEqual(project);
  });

  it("prevents a late save from assigning its file to a document opened meanwhile", () => {
    const { documents } = opened();
    const { id: saving } = stateOf(documents);
    documents.show(newDocument({ ...project, name: "B" }));
    documents.markSaved(saving, project, fileOf("a.json"));
    expect(stateOf(documents).file).toBeNull();
  });

  it("keeps an edit unsaved that was made while the file was written", () => {
    const { documents } = opened();
    const written = documents.project;
    documents.edit(moveTo(3));
    documents.markSaved(stateOf(documents).id, written, fileOf("a.json"));
    expect(hasUnsavedChanges(stateOf(documents))).toBe(true);
    documents.undo();
    expect(hasUnsavedChanges(stateOf(documents))).toBe(false);
  });

  it("counts as untouched only until the first edit, even if that is undone", () => {
    const { documents } = opened();
    expect(isUntouched(stateOf(documents))).toBe(true);
    documents.edit(moveTo(3));
    documents.undo();
    expect(isUntouched(stateOf(documents))).toBe(false);
  });
});

describe("the state of saving", () => {
  it("distinguishes a document that was never changed from a saved one", () => {
    const { documents } = opened();
    const state = () => savedState(documents.state.getState());
    expect(state()).toBe("unchanged");
    documents.edit(moveTo(7));
    expect(state()).toBe("unsaved");
    documents.markSaved(documents.state.getState().id, documents.project, null);
    expect(state()).toBe("saved");
  });
});

describe("groups and expressions", () => {
  it("lose entities that an edit removes, and undo restores them", () => {
    const noted = {
      ...project,
      groups: [{ id: 1, name: "corner", members: [{ kind: "point", id } as const] }],
      expressions: [{ kind: "point", id, field: "position.0", expression: "1/2" } as const],
    };
    const documents = new DocumentStore(noted, () => 0);
    documents.edit(deleteEntities(noted, [{ kind: "point", id }]));
    expect(documents.project.groups).toEqual([{ id: 1, name: "corner", members: [] }]);
    expect(documents.project.expressions).toBeUndefined();
    documents.undo();
    expect(documents.project).toEqual(noted);
    documents.redo();
    expect(documents.project.expressions).toBeUndefined();
  });
});
