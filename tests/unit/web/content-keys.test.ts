import { describe, expect, it } from "vitest";
import { createMesher } from "tetrafront";
import type { Project } from "tetrafront/project";
import { documentKey, meshKey } from "../../../web/document/content-keys";
import { addPoint } from "../../../web/document/create";
import type { ProjectEdit } from "../../../web/document/edit";
import { moveEntity, renameEntity, renameProject, setLineType } from "../../../web/document/edits";
import { scaleSizes, setMeshing } from "../../../web/document/size-edits";
import { DocumentStore } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";

function edited(project: Project, ...edits: readonly ProjectEdit[]): Project {
  const documents = new DocumentStore(project, () => 0);
  for (const edit of edits) documents.edit(edit);
  return documents.project;
}

const cube = cubeProject();
const withLoosePoint = edited(cube, addPoint(cube, [0.25, 0.5, 7]).edit);
const loose = withLoosePoint.points.at(-1)?.id ?? 0;

describe("the key of a mesh", () => {
  it("ignores names and unused points, unlike the key of the document", () => {
    const harmless: readonly (readonly [string, Project])[] = [
      ["the name of the project", edited(cube, renameProject("renamed"))],
      ["the name of a point", edited(cube, renameEntity({ kind: "point", id: 1 }, "corner"))],
      ["the name of a line", edited(cube, renameEntity({ kind: "line", id: 1 }, "edge"))],
      ["the name of a patch", edited(cube, renameEntity({ kind: "patch", id: 1 }, "wall"))],
      ["a loose point", withLoosePoint],
      ["a group", { ...cube, groups: [{ id: 1, name: "g", members: [] }] }],
      ["a member", { ...cube, groups: [{ id: 1, name: "g", members: [{ kind: "line", id: 1 }] }] }],
      ["a parameter", { ...cube, parameters: [{ name: "r", expression: "1" }] }],
      [
        "an expression",
        { ...cube, expressions: [{ kind: "point", id: 1, field: "position.0", expression: "r" }] },
      ],
      ["a moved loose point", edited(withLoosePoint, moveEntity("point", loose, 0, -5))],
    ];
    for (const [what, project] of harmless) {
      expect(meshKey(project), what).toBe(meshKey(cube));
      expect(documentKey(project), what).not.toBe(documentKey(cube));
    }
    expect(new Set(harmless.map(([, project]) => documentKey(project))).size).toBe(harmless.length);
  });

  it("differs if anything differs that affects the mesh", () => {
    const projects = [
      cube,
      edited(cube, moveEntity("point", 1, 0, -1)),
      edited(cube, setLineType(1, "spline")),
      edited(cube, scaleSizes(cube, 0.5)),
      edited(cube, setMeshing("size", 0.5)),
      edited(cube, setMeshing("order", "smallest-first")),
      { ...cube, patches: cube.patches.slice(1) },
      { ...cube, background: { ...cube.background, tetrahedra: cube.background.tetrahedra.slice(1) } },
    ];
    expect(new Set(projects.map(meshKey)).size).toBe(projects.length);
    expect(new Set(projects.map(documentKey)).size).toBe(projects.length);
  });

  it("depends on a point as soon as a line uses it", () => {
    const [line] = withLoosePoint.lines;
    const used = {
      ...withLoosePoint,
      lines: [...withLoosePoint.lines, { ...line, id: 99, type: "straight" as const, points: [1, loose] }],
    };
    expect(meshKey(edited(used, moveEntity("point", loose, 0, -5)))).not.toBe(meshKey(used));
  });

  it("may ignore unused points, because they do not change the mesh", async () => {
    const mesher = await createMesher();
    const fingerprints: string[] = [];
    for (const project of [cube, withLoosePoint]) {
      fingerprints.push((await mesher.meshProject(project)).report.fingerprint);
    }
    mesher.dispose();
    expect(fingerprints[1]).toBe(fingerprints[0]);
  });
});

describe("both keys", () => {
  it("do not depend on the order of the fields in a record", () => {
    const reversed = (record: object): object => Object.fromEntries(Object.entries(record).reverse());
    const other = {
      ...(reversed(cube) as Project),
      points: cube.points.map(reversed) as unknown as Project["points"],
      lines: cube.lines.map(reversed) as unknown as Project["lines"],
      patches: cube.patches.map(reversed) as unknown as Project["patches"],
    };
    expect(documentKey(other)).toBe(documentKey(cube));
    expect(meshKey(other)).toBe(meshKey(cube));
  });
});
