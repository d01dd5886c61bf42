import { describe, expect, it } from "vitest";
import { parseProject } from "tetrafront/project";
import { deleteEntities, moveEntity, renameEntity } from "../../../web/document/edits";
import { setDirections } from "../../../web/document/node-directions";
import {
  replaceBackground,
  replaceSources,
  scaleSizes,
  setMeshing,
  setNodeStretching,
} from "../../../web/document/size-edits";
import { documentKey } from "../../../web/document/content-keys";
import { DocumentStore, hasUnsavedChanges } from "../../../web/session/document-store";
import { toProblems } from "../../../web/document/validate";
import { cubeProject } from "../../support/projects";

describe("the document", () => {
  it("changes only the entities that an edit names", () => {
    const before = cubeProject();
    const documents = new DocumentStore(before, () => 0);
    const [point] = before.points;
    if (!point) throw new Error("The cube has no points");
    documents.edit(moveEntity("point", point.id, 2, -3));
    documents.edit(renameEntity({ kind: "point", id: point.id }, "corner"));
    const after = documents.project;
    expect(after.points[0]).toEqual({
      id: point.id,
      name: "corner",
      position: [point.position[0], point.position[1], -3],
    });
    expect(after.points.slice(1)).toEqual(before.points.slice(1));
    expect(after.lines).toBe(before.lines);
    documents.edit(renameEntity({ kind: "point", id: point.id }, ""));
    expect(documents.project.points[0]).not.toHaveProperty("name");
    documents.edit(scaleSizes(documents.project, 0.5));
    expect(documents.project.background.nodes.map(({ size }) => size)).toEqual(
      before.background.nodes.map(({ size }) => size / 2),
    );
  });

  it("gives a stretched node a direction", () => {
    const documents = new DocumentStore(cubeProject(), () => 0);
    const id = documents.project.background.nodes[0]?.id ?? 0;
    documents.edit(setNodeStretching(id, 3));
    const change = { axis: 1, value: 2, expression: null } as const;
    documents.edit(setDirections(documents.project, [id], "direction", change));
    expect(documents.project.background.nodes[0]).toMatchObject({ stretching: 3, direction: [1, 2, 0] });
  });

  it("is a valid project after any deletion", () => {
    const project = cubeProject();
    for (const [kind, list] of [
      ["point", project.points],
      ["line", project.lines],
      ["patch", project.patches],
      ["background-node", project.background.nodes],
    ] as const) {
      for (const { id } of list) {
        const documents = new DocumentStore(project, () => 0);
        documents.edit(deleteEntities(project, [{ kind, id }]));
        expect(parseProject(documents.project).success).toBe(true);
        expect(documentKey(documents.project)).not.toBe(documentKey(project));
        documents.undo();
        expect(documents.project).toEqual(project);
      }
    }
  });

  it("knows whether its file is up to date, also after undo and redo", () => {
    const documents = new DocumentStore(cubeProject(), () => 0);
    const unsaved = () => hasUnsavedChanges(documents.state.getState());
    expect(unsaved()).toBe(false);
    documents.edit(scaleSizes(documents.project, 2));
    expect(unsaved()).toBe(true);
    documents.undo();
    expect(unsaved()).toBe(false);
    documents.redo();
    expect(unsaved()).toBe(true);
    const { id } = documents.state.getState();
    documents.markSaved(id, documents.project, null);
    expect(unsaved()).toBe(false);
    documents.undo();
    expect(unsaved()).toBe(true);
  });
});

describe("toProblems", () => {
  it("refers diagnostics to ids, puts errors first, and omits information and duplicates", () => {
    const project = cubeProject();
    const about = (index: number) => [{ kind: "patch", index, label: "" } as const];
    const diagnostic = { code: "not-planar", remedy: "Mend it.", data: { distance: 1 } } as const;
    const problems = toProblems(project, [
      { ...diagnostic, severity: "information", message: "note", entities: [] },
      { ...diagnostic, severity: "warning", message: "warned", entities: about(1), position: [1, 2, 3] },
      {
        ...diagnostic,
        severity: "error",
        message: "failed",
        entities: [...about(0), ...[7, 9].map((index) => ({ kind: "triangle", index, label: "" }) as const)],
      },
      { ...diagnostic, severity: "error", message: "failed", entities: about(0) },
    ]);
    expect(problems.map(({ severity, message }) => [severity, message])).toEqual([
      ["error", "failed"],
      ["warning", "warned"],
    ]);
    expect(problems.map(({ entities }) => entities)).toEqual([
      [{ kind: "patch", id: project.patches[0]?.id }],
      [{ kind: "patch", id: project.patches[1]?.id }],
    ]);
    expect(problems[1]?.position).toEqual([1, 2, 3]);
    expect(problems.map(({ triangles }) => triangles)).toEqual([[7, 9], []]);
  });
});

describe("sizes", () => {
  it("replace the uniform size if they come from a new grid, and complement it if they come from new sources", () => {
    const project = cubeProject();
    const documents = new DocumentStore(project, () => 0);
    documents.edit(setMeshing("size", 0.5));
    documents.edit(setMeshing("optimization", "fast"));
    documents.edit(scaleSizes(documents.project, 0.5));
    expect(documents.project.meshing?.size).toBe(0.25);
    expect(documents.project.background.nodes[0]?.size).toBe(0.5 * (project.background.nodes[0]?.size ?? 0));
    documents.edit(replaceSources("Sources", { ...project.background, sources: [] }));
    expect(documents.project.meshing?.size).toBe(0.25);
    documents.edit(
      replaceBackground("Grid", documents.project, { ...project.background, coverageMargin: 1 }),
    );
    expect(documents.project.meshing).toEqual({ optimization: "fast" });
    documents.undo();
    expect(documents.project.meshing?.size).toBe(0.25);
  });
});
