import { describe, expect, it } from "vitest";
import { TreeRows, rowKey } from "../../../web/panels/model/tree-rows";
import { cubeProject } from "../../support/projects";

const keyOf = (row: ReturnType<TreeRows["at"]>): string => (row === undefined ? "" : rowKey(row));

describe("the rows of the tree", () => {
  const project = cubeProject();

  it("are found by their keys, with open, closed and filtered groups", () => {
    const cases: readonly (readonly [filter: string, closed: readonly string[]])[] = [
      ["", []],
      ["", ["point", "background-node"]],
      ["node", ["background-node"]],
      ["1", []],
      ["nothing of the kind", []],
    ];
    for (const [filter, closed] of cases) {
      const rows = new TreeRows(project, filter, new Set(closed));
      const keys = rows.slice(0, rows.length).map(keyOf);
      expect(keys).toHaveLength(rows.length);
      expect(new Set(keys).size).toBe(rows.length);
      keys.forEach((key, i) => expect(rows.indexOf(key)).toBe(i));
      expect(rows.at(rows.length)).toBeUndefined();
      expect(rows.at(-1)).toBeUndefined();
      expect(rows.indexOf("line-4711")).toBe(-1);
      expect(rows.indexOf(null)).toBe(-1);
    }
  });

  it("contain all entities below the headings of their kinds", () => {
    const rows = new TreeRows(project, "", new Set());
    const { points, lines, patches, background } = project;
    expect(rows.length).toBe(6 + points.length + lines.length + patches.length + background.nodes.length);
    expect(new TreeRows(project, "", new Set(["line"])).length).toBe(rows.length - lines.length);
  });

  it("contain only entities that match the filter", () => {
    const rows = new TreeRows(project, "point 3", new Set());
    expect(rows.slice(0, rows.length).map(keyOf)).toEqual(["point", "point-3"]);
    expect(rows.entitiesOf("point")).toEqual([{ kind: "point", id: 3 }]);
    expect(rows.entitiesOf("line")).toEqual([]);
    const id = project.lines[3]?.id ?? 0;
    expect(new TreeRows(project, `line ${id}`, new Set(["line"])).indexOf(`line-${id}`)).toBeGreaterThan(0);
    expect(new TreeRows(project, "no such thing", new Set()).length).toBe(0);
  });

  it("contain only the heading of a closed group", () => {
    const rows = new TreeRows(project, "", new Set(["point"]));
    expect(rows.at(0)).toMatchObject({ kind: "point", total: project.points.length, open: false });
    expect(rows.at(1)).toMatchObject({ kind: "line" });
    expect(rows.indexOf("point-1")).toBe(-1);
  });

  it("begin with the groups that the user made, and find them by name", () => {
    const groups = [
      { id: 3, name: "Inlet", members: [{ kind: "point", id: 1 }] },
      { id: 7, name: "outlet", members: [] },
    ] as const;
    const grouped = { ...project, groups };
    const keysOf = (filter: string, closed: readonly string[]) => {
      const rows = new TreeRows(grouped, filter, new Set(closed));
      const keys = rows.slice(0, rows.length).map(rowKey);
      keys.forEach((key, i) => expect(rows.indexOf(key)).toBe(i));
      return keys;
    };
    expect(keysOf("", []).slice(0, 5)).toEqual(["groups", "group-3", "group-7", "point", "point-1"]);
    expect(keysOf("", ["groups", "point"]).slice(0, 3)).toEqual(["groups", "point", "line"]);
    expect(keysOf("inl", ["groups"])).toEqual(["groups", "group-3"]);
    expect(keysOf("point 3", [])).toEqual(["point", "point-3"]);
    const headings = new TreeRows(grouped, "", new Set()).at(3);
    expect(headings).toMatchObject({ type: "group", ordinal: 2 });
  });

  it("are made only when they are requested", () => {
    let visited = 0;
    const nodes = Array.from({ length: 50_000 }, (_, i) => ({
      position: [0, 0, 0] as const,
      size: 1,
      get id() {
        ++visited;
        return i + 1;
      },
    }));
    const many = { ...project, background: { ...project.background, nodes } };
    const rows = new TreeRows(many, "", new Set());
    expect(rows.length).toBeGreaterThan(50_000);
    const first = rows.indexOf("background-node");
    visited = 0;
    expect(rows.slice(first, first + 60)).toHaveLength(60);
    expect(visited).toBeLessThan(200);
  });
});
