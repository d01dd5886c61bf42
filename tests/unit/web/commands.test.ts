import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { Mesher } from "tetrafront";
import { App } from "../../../web/app/app";
import { paletteItems } from "../../../web/commands/palette-items";
import { searchPalette } from "../../../web/commands/palette-search";
import {
  newProject,
  openProject,
  openRecent,
  openTemplate,
  save,
} from "../../../web/commands/project-actions";
import { commandNamed, commands, keyNames, runCommand } from "../../../web/commands/registry";
import { deleteEntities, moveEntity, renameProject } from "../../../web/document/edits";
import { templates } from "../../../web/document/templates";
import { DocumentLibrary } from "../../../web/session/document-library";
import { newDocument } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";
import { SilentWorker } from "../../support/silent-worker";
import { MemoryLocks, MemoryStorage, MemoryTab } from "./storage-doubles";

const saved: { readonly name: string; readonly file: string | undefined }[] = [];
/** Time of the last change of each file on the disk, by name. */
const disk = new Map<string, number>();
let chosenFile = "chosen.json";

const handleOf = (name: string) =>
  ({
    name,
    getFile: () => Promise.resolve({ lastModified: disk.get(name) }),
  }) as unknown as FileSystemFileHandle;

vi.mock("browser-fs-access", () => ({
  fileSave: async (blob: Promise<Blob>, _options: unknown, handle: FileSystemFileHandle | null) => {
    const { name } = JSON.parse(await (await blob).text()) as { readonly name: string };
    saved.push({ name, file: handle?.name });
    const written = handle ?? handleOf(chosenFile);
    disk.set(written.name, (disk.get(written.name) ?? 0) + 1);
    return written;
  },
}));

/** A mesher whose runs and previews never end. */
const busyMesher = Promise.resolve({
  meshProject: () => new Promise(() => undefined),
  previewProject: () => new Promise(() => undefined),
} as unknown as Mesher);

function openApp(storage = new MemoryStorage(), locks = new MemoryLocks(), generate = false) {
  const library = new DocumentLibrary(storage, locks, new MemoryTab());
  const first = { document: newDocument({ ...cubeProject(), name: "A" }) };
  const app = new App(
    { first, mesher: busyMesher, previewMesher: busyMesher, library },
    { gallery: { opening: "", models: [] }, generate, still: true },
  );
  app.autosave?.follow();
  const run = (id: string): void => runCommand(app, commandNamed(id));
  return { app, storage, locks, run };
}

const noticeKeys = (app: App) => app.shell.getState().notices.map(({ key }) => key);
const labels = (app: App) => app.documents.state.getState().history.past.map(({ label }) => label);

beforeEach(() => {
  vi.stubGlobal("Worker", SilentWorker);
  saved.length = 0;
  disk.clear();
});
afterEach(() => void vi.unstubAllGlobals());

describe("the commands", () => {
  it("have unique ids and keys", () => {
    const ids = commands.map(({ id }) => id);
    expect(new Set(ids).size).toBe(ids.length);
    const keys = commands.flatMap((command) => command.keys.map((key) => key.toLowerCase()));
    expect(new Set(keys).size).toBe(keys.length);
    expect(() => commandNamed("none")).toThrow('There is no command "none"');
  });

  it("have no plain characters as keys if they work in text fields", () => {
    for (const { keys, inFields } of commands) {
      if (inFields) for (const key of keys) expect(key).toMatch(/^mod\+|Escape$/);
    }
  });

  it("keep the sections of a menu together", () => {
    for (const menu of ["file", "edit", "create", "view", "mesh", "help"]) {
      const sections = commands.filter((command) => command.menu === menu).map(({ section }) => section);
      expect(sections.length).toBeGreaterThan(0);
      expect(sections).toEqual([...sections].sort((a, b) => a - b));
    }
  });

  it("select all and invert leave out what is hidden, and invert nodes among nodes", () => {
    const { app, run } = openApp();
    const { view } = app;
    const count = () => view.state.getState().selection.length;
    const all = 8 + 12 + 6;
    run("select-all");
    expect(count()).toBe(all);
    view.setHidden([{ kind: "patch", id: 1 }, { kind: "line", id: 1 }], true); // prettier-ignore
    run("select-all");
    expect(count()).toBe(all - 2);
    view.setLayer("points", false);
    view.select({ kind: "patch", id: 2 });
    run("select-inverse");
    expect(count()).toBe(4);
    view.clear();
    run("select-inverse");
    expect(count()).toBe(11 + 5);
    view.selectAll([{ kind: "background-node", id: 1 }]);
    run("select-inverse");
    expect(count()).toBe(app.documents.project.background.nodes.length - 1);
  });

  it("leave nothing selected or hidden that is removed: new entities may have the same ids", () => {
    const { app, run } = openApp();
    const { documents, view } = app;
    const removed = { kind: "patch", id: 6 } as const;
    const add = (): void =>
      documents.edit({
        label: "Add",
        change: ({ project }) => void project.patches.push({ id: 6, type: "planar", loops: [[1, 2, 3, 4]] }),
      });
    view.setHidden([removed], true);
    view.selectAll([removed, { kind: "patch", id: 1 }]);
    documents.edit(deleteEntities(documents.project, [removed]));
    expect(view.state.getState().selection).toEqual([{ kind: "patch", id: 1 }]);
    expect(view.state.getState().hidden.size).toBe(0);
    add();
    expect(view.state.getState().selection).toEqual([{ kind: "patch", id: 1 }]);
    // Redo brings it back: until another step, it stays selected.
    view.select(removed);
    run("undo");
    expect(view.state.getState().selection).toEqual([removed]);
    run("redo");
    expect(view.state.getState().selection).toEqual([removed]);
    run("undo");
    add();
    expect(view.state.getState().selection).toEqual([]);
  });

  it("say in a notice, never in a dialog, what they need that is not selected", async () => {
    const { app } = openApp();
    const opensDialog = new Set(["new-point", "new-node", "help"]);
    for (const command of commands.filter(({ keys, menu, id }) => {
      const isKey = keys.some((key) => !key.startsWith("mod+"));
      return isKey && menu !== "file" && !opensDialog.has(id);
    })) {
      app.view.clear();
      app.operations.cancel();
      runCommand(app, command);
      const { message, dialog } = app.shell.getState();
      expect([command.id, message, dialog]).toEqual([command.id, null, null]);
    }
    runCommand(app, commandNamed("line-spline"));
    runCommand(app, commandNamed("boolean-union"));
    runCommand(app, commandNamed("plane-selection"));
    await vi.waitFor(() => expect(noticeKeys(app)).toEqual(["note"]));
    expect(app.shell.getState().message).toBeNull();
  });

  it("close the start page if they work with the model beside it", () => {
    const { app, run } = openApp();
    const isOpenAfter = (id: string): boolean => {
      app.shell.setState({ startPage: true });
      run(id);
      return app.shell.getState().startPage;
    };
    for (const id of ["cut-x", "tool-line", "line-spline", "show-all"])
      expect([id, isOpenAfter(id)]).toEqual([id, false]);
    for (const id of ["start", "help", "scheme-dark", "share"])
      expect([id, isOpenAfter(id)]).toEqual([id, true]);
    app.shell.setState({ startPage: true });
    const [point] = searchPalette("point 1", [], paletteItems(app).found);
    point?.run();
    expect(app.shell.getState().startPage).toBe(false);
  });

  it("do nothing while they are disabled", () => {
    const { app, run } = openApp();
    const { history } = app.documents.state.getState();
    for (const id of ["undo", "redo", "delete", "deselect", "hide"]) {
      expect(commandNamed(id).enabled(app)).toBe(false);
      run(id);
    }
    expect(app.documents.state.getState().history).toBe(history);
  });

  it("are found in the palette by words with mistakes, and while they are disabled with what they need", () => {
    const { listed, found } = paletteItems(openApp().app);
    const search = (query: string) => searchPalette(query, listed, found);
    for (const query of ["boolean", "bolean", "booleen"]) {
      expect(search(query).slice(0, 3).map(({ id }) => id)).toEqual(["boolean-union", "boolean-difference", "boolean-intersection"]); // prettier-ignore
    }
    expect(search("bolean")[0]?.needs).toBeNull();
    const [first] = search("export");
    expect(first).toMatchObject({ id: "export", needs: "Generate a mesh first." });
    expect(search("duplicate")[0]?.needs).toMatch(/^Select something/);
    expect(listed.every(({ needs }) => needs === null)).toBe(true);
  });

  it("have a text of what they need only if it would enable them", () => {
    const { app } = openApp();
    const needs = (id: string): string | null => commandNamed(id).needs(app);
    const selecting = ["rename", "group", "copy", "fit-selection", "delete"];
    for (const id of selecting) expect(needs(id), id).toMatch(/^Select something/);
    expect(needs("select-all")).toBeNull();
    expect(needs("improve")).toMatch(/^Generate a mesh/);

    // Several entities that are no group have no name, and groups cannot hold nodes of the background grid.
    app.view.selectAll([
      { kind: "background-node", id: 1 },
      { kind: "background-node", id: 2 },
    ]);
    for (const id of ["rename", "group"]) expect(commandNamed(id).enabled(app), id).toBe(false);
    expect(needs("rename")).toBe("Select one entity or all of a group.");
    for (const id of selecting.slice(1)) expect(needs(id), id).toBeNull();
    // A text of the page is selected, which Ctrl C copies.
    vi.stubGlobal("window", { getSelection: () => ({ isCollapsed: false }) });
    const { listed, found } = paletteItems(app);
    const ids = [...listed, ...found].map(({ id }) => id);
    for (const id of ["delete", "rename"]) expect(ids).toContain(id);
    expect(listed.map(({ id }) => id)).not.toContain("rename");
    for (const id of ["group", "copy"]) expect(ids).not.toContain(id);
  });

  it("do not ask for a mesh that a run is working on", () => {
    const { app } = openApp();
    const reasons = (): (string | null)[] =>
      ["export", "download-report", "background-from-mesh", "improve"].map((id) =>
        commandNamed(id).needs(app),
      );
    expect(new Set(reasons())).toEqual(new Set(["Generate a mesh first."]));
    app.run.state.setState({ busy: true });
    expect(new Set(reasons())).toEqual(new Set(["The mesh is being generated."]));
    app.run.state.setState({ task: "improve" });
    expect(commandNamed("improve").needs(app)).toBe("The mesh is being improved.");
  });

  it("close the panel of an operation for a tool that draws, and put such a tool away for the panel", () => {
    const { app, run } = openApp();
    const { project } = app.documents;
    const isOpen = (): boolean => app.operations.state.getState().open !== null;
    for (const tool of ["tool-line", "tool-source", "tool-point"]) {
      run("create-box");
      expect(isOpen()).toBe(true);
      expect(app.view.state.getState().tool).toBe("select");
      run(tool);
      expect(isOpen(), tool).toBe(false);
      expect(app.documents.project).toBe(project);
      expect(app.view.state.getState().tool).toBe(tool.slice("tool-".length));
    }
    // Handles and distances go with a preview.
    run("create-box");
    for (const tool of ["tool-measure", "tool-move", "tool-select"]) {
      run(tool);
      expect(isOpen(), tool).toBe(true);
    }
  });

  it("name the step that they undo or redo", () => {
    const { app, run } = openApp();
    app.documents.edit(renameProject("renamed"));
    expect(commandNamed("undo").label(app)).toBe("Undo: Rename project");
    run("undo");
    expect(commandNamed("undo").label(app)).toBe("Undo");
    expect(commandNamed("redo").label(app)).toBe("Redo: Rename project");
    run("redo");
    expect(app.documents.project.name).toBe("renamed");
  });

  it("show their keys as they are printed on a keyboard", () => {
    expect(keyNames("mod+shift+Z")).toEqual(["Ctrl", "Shift", "Z"]);
    expect(keyNames("Escape")).toEqual(["Esc"]);
  });

  it("delete the selection with its dependents, and then select nothing", () => {
    const { app, run } = openApp();
    app.view.selectAll([{ kind: "point", id: 1 }]);
    run("delete");
    expect(app.documents.project.lines).toHaveLength(9);
    expect(app.view.state.getState().selection).toEqual([]);
  });
});

describe("opening a template", () => {
  it.each(templates)("meshes $id, unless it is empty", async ({ id, make }) => {
    const { app } = openApp(new MemoryStorage(), new MemoryLocks(), true);
    const wasRun = vi.fn();
    app.run.state.subscribe(({ busy }) => {
      if (busy) wasRun();
    });
    openTemplate(app, make());
    await new Promise((resolve) => setTimeout(resolve, 20));
    expect(app.documents.project.name).toBe(make().name);
    expect(wasRun.mock.calls.length > 0).toBe(id !== "empty");
  });
});

describe("opening another project", () => {
  it("offers to reopen a project with unsaved changes, with all its undo steps", async () => {
    const { app } = openApp();
    app.documents.edit(moveEntity("point", 1, 0, -2));
    app.documents.edit(renameProject("changed"));
    openProject(app, { ...cubeProject(), name: "B" });
    expect(app.documents.project.name).toBe("B");
    expect(labels(app)).toEqual([]);
    const [notice] = app.shell.getState().notices;
    expect(notice?.text).toContain("changed");
    notice?.action.run();
    await vi.waitFor(() => expect(app.documents.project.name).toBe("changed"));
    expect(labels(app)).toEqual(["Move point 1", "Rename project"]);
  });

  it("neither keeps a project without changes nor shows a notice", async () => {
    const { app, storage } = openApp();
    await app.autosave?.flush();
    const { id } = app.documents.state.getState();
    expect(storage.documents.has(id)).toBe(true);
    newProject(app);
    expect(noticeKeys(app)).toEqual([]);
    await app.autosave?.flush();
    expect(storage.documents.has(id)).toBe(false);
  });

  it("keeps every changed project for Recent, whatever is opened next", async () => {
    const { app, storage } = openApp();
    for (const name of ["one", "two", "three"]) {
      app.documents.edit(renameProject(name));
      newProject(app);
    }
    await app.autosave?.flush();
    expect((await storage.list()).map(({ name }) => name).sort()).toEqual(["one", "three", "two"]);
    const two = [...storage.documents.values()].find(({ name }) => name === "two");
    await openRecent(app, two?.id ?? "", "two");
    expect(app.documents.project.name).toBe("two");
    expect(labels(app)).toEqual(["Rename project"]);
  });

  it("rejects a project that is open in another tab", async () => {
    const { app, storage, locks } = openApp();
    const other = openApp(storage, locks).app;
    other.documents.edit(renameProject("elsewhere"));
    await other.autosave?.flush();
    await openRecent(app, other.documents.state.getState().id, "elsewhere");
    expect(app.shell.getState().message?.lines).toEqual(["The project is open in another tab."]);
    expect(app.documents.project.name).toBe("A");
  });
});

describe("saving", () => {
  it("never writes a project into another project's file", async () => {
    const { app } = openApp();
    chosenFile = "a.json";
    await save(app, true);
    openProject(app, { ...cubeProject(), name: "B" });
    app.documents.undo();
    chosenFile = "b.json";
    await save(app, false);
    expect(saved).toEqual([
      { name: "A", file: undefined },
      { name: "B", file: undefined },
    ]);
    await save(app, false);
    expect(saved.at(-1)).toEqual({ name: "B", file: "b.json" });
  });

  it("writes a reopened document to its own file", async () => {
    const { app } = openApp();
    chosenFile = "a.json";
    await save(app, true);
    app.documents.edit(renameProject("A changed"));
    const { id } = app.documents.state.getState();
    newProject(app);
    app.shell.getState().notices[0]?.action.run();
    await vi.waitFor(() => expect(app.documents.state.getState().id).toBe(id));
    await save(app, false);
    expect(saved.at(-1)).toEqual({ name: "A changed", file: "a.json" });
  });

  it("asks for a file again if another program has changed the file", async () => {
    const { app } = openApp();
    chosenFile = "a.json";
    await save(app, true);
    disk.set("a.json", 1000);
    await save(app, false);
    expect(saved.at(-1)).toEqual({ name: "A", file: undefined });
  });

  it("marks the written state as saved, but not later edits", async () => {
    const { app } = openApp();
    const saving = save(app, true);
    app.documents.edit(renameProject("edited meanwhile"));
    await saving;
    const { savedKey } = app.documents.state.getState();
    app.documents.undo();
    expect(newDocument(app.documents.project).savedKey).toBe(savedKey);
  });
});

describe("two apps on one page", () => {
  it("have separate documents, selections and undo steps", () => {
    const [first, second] = [openApp().app, openApp().app];
    first.documents.edit(renameProject("first"));
    first.view.selectAll([{ kind: "point", id: 1 }]);
    expect(second.documents.project.name).toBe("A");
    expect(labels(second)).toEqual([]);
    expect(second.view.state.getState().selection).toEqual([]);
    expect(first.documents.state.getState().id).not.toBe(second.documents.state.getState().id);
  });
});
