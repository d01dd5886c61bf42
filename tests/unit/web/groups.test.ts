import { liveNotes, parseProject, type Project } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { deleteEntities } from "../../../web/document/edits";
import {
  addGroup,
  colorFromCss,
  colorGroup,
  cssColor,
  extendGroup,
  groupEntities,
  groupTints,
  membershipIn,
  reduceGroup,
  removeGroup,
  renameGroup,
} from "../../../web/document/groups";
import { DocumentStore } from "../../../web/session/document-store";
import { viewerColors } from "../../../web/ui/theme/theme";
import { cubeProject } from "../../support/projects";

function opened(project: Project = cubeProject()) {
  const documents = new DocumentStore(project, () => 0);
  const group = (id: number) => documents.project.groups?.find((one) => one.id === id);
  return { documents, group };
}

describe("a group", () => {
  it("is left by entities that are taken out of it, and removed with the last one", () => {
    const { documents, group } = opened();
    const lines = [1, 2, 3].map((id) => ({ kind: "line", id }) as const);
    documents.edit(addGroup(documents.project, lines));
    const membership = (ids: readonly number[]) => {
      const [known] = documents.project.groups ?? [];
      return known && membershipIn(known, ids.map((id) => ({ kind: "line", id }) as const)); // prettier-ignore
    };
    expect([[1, 2], [2, 4], [4]].map(membership)).toEqual(["all", "some", "none"]);
    documents.edit(reduceGroup(documents.project, 1, [{ kind: "line", id: 2 }, { kind: "line", id: 4 }])); // prettier-ignore
    expect(group(1)?.members).toEqual([lines[0], lines[2]]);
    documents.edit(reduceGroup(documents.project, 1, lines));
    expect(documents.project.groups).toBeUndefined();
    documents.undo();
    documents.undo();
    expect(group(1)?.members).toEqual(lines);
  });

  it("has a colour that means nothing else in the view, and differs from those of the groups before it", () => {
    const { documents } = opened();
    const used = Object.values(viewerColors).flatMap(({ front, selection, hover }) =>
      [front, selection, hover].map(colorFromCss),
    );
    for (let i = 0; i < 6; ++i) {
      documents.edit(addGroup(documents.project, [{ kind: "line", id: i + 1 }]));
      const color = documents.project.groups?.at(-1)?.color ?? [0, 0, 0];
      for (const other of used) {
        expect(Math.hypot(...color.map((x, k) => x - (other[k] ?? 0))), cssColor(color)).toBeGreaterThan(0.3);
      }
      used.push(color);
    }
  });

  it("holds each entity once, has a name and a colour, and is valid in a file", () => {
    const { documents, group } = opened();
    const [point, node] = [
      documents.project.points[0]?.id ?? 0,
      documents.project.background.nodes[0]?.id ?? 0,
    ];
    documents.edit(
      addGroup(documents.project, [
        { kind: "point", id: point },
        { kind: "point", id: point },
        { kind: "background-node", id: node },
      ]),
    );
    expect(group(1)?.members).toEqual([{ kind: "point", id: point }]);
    documents.edit(
      extendGroup(documents.project, 1, [
        { kind: "line", id: 1 },
        { kind: "point", id: point },
      ]),
    );
    documents.edit(renameGroup(documents.project, 1, "left"));
    documents.edit(colorGroup(documents.project, 1, [1, 0, 0.5]));
    expect(group(1)).toEqual({
      id: 1,
      name: "left",
      color: [1, 0, 0.5],
      members: [
        { kind: "point", id: point },
        { kind: "line", id: 1 },
      ],
    });
    expect(parseProject(documents.project).success).toBe(true);
    expect([...groupTints(documents.project)]).toEqual([
      [`point-${point}`, [1, 0, 0.5]],
      ["line-1", [1, 0, 0.5]],
    ]);
  });

  it("loses what is deleted, and goes without its entities", () => {
    const { documents, group } = opened();
    const lines = documents.project.lines.length;
    documents.edit(
      addGroup(documents.project, [
        { kind: "line", id: 1 },
        { kind: "line", id: 2 },
      ]),
    );
    documents.edit(deleteEntities(documents.project, [{ kind: "line", id: 1 }]));
    expect(group(1)?.members).toEqual([{ kind: "line", id: 2 }]);
    documents.edit(removeGroup(documents.project, 1));
    expect(documents.project.groups).toBeUndefined();
    expect(documents.project.lines).toHaveLength(lines - 1);
    for (let i = 0; i < 3; ++i) documents.undo();
    expect(documents.project.groups).toBeUndefined();
    expect(documents.project.lines).toHaveLength(lines);
    expect(liveNotes(documents.project)).toEqual({});
  });

  it("keeps patches of bodies apart from drawn ones", () => {
    const project = cubeProject();
    expect(groupEntities(project, { id: 1, name: "", members: [{ kind: "patch", id: 1 }] })).toEqual([
      { kind: "patch", id: 1 },
    ]);
  });

  it("has colours that survive the way through CSS", () => {
    for (const text of ["#000000", "#ff8000", "#0c22ff"]) expect(cssColor(colorFromCss(text))).toBe(text);
  });
});
