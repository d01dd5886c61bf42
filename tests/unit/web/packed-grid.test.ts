import { backgroundArrays, projectBackground, type ProjectBackground } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { documentKey } from "../../../web/document/content-keys";
import { documentGrid } from "../../../web/document/large-grid";
import {
  engineGrid,
  packArrays,
  packedGrid,
  packedTetrahedra,
  unpackGrid,
} from "../../../web/document/packed-grid";
import { cubeProject } from "../../support/projects";

/** Nodes with and without their optional values, and with ids that differ from their indices. */
function variousGrid(idOf: (id: number) => number): ProjectBackground {
  const { nodes, tetrahedra } = cubeProject().background;
  return {
    nodes: nodes.map((node, i) => ({
      ...node,
      id: idOf(node.id),
      ...(i % 2 === 0 ? { stretching: 3 } : {}),
      ...(i % 4 === 0 ? { direction: [0, -1, 0.5] as const } : {}),
      ...(i % 3 === 0 ? { secondStretching: 2, secondDirection: [4, 0, 0] as const } : {}),
    })),
    tetrahedra: tetrahedra.map(([a, b, c, d]) => [idOf(a), idOf(b), idOf(c), idOf(d)] as const),
    coverageMargin: 0.25,
  };
}

const farIds = (id: number): number => 10 * id + 2 ** 40;

describe("a packed grid", () => {
  it("has the same document key as the grid, computed at once or in slices", async () => {
    const project = { ...cubeProject(), background: variousGrid(farIds) };
    const { nodes, tetrahedra } = await documentGrid(packedGrid(project.background));
    expect(nodes).not.toBe(project.background.nodes);
    const same = { ...project, background: { nodes, tetrahedra, coverageMargin: 0.25 } };
    expect(documentKey(same)).toBe(documentKey(project));
    const other = nodes.map((node, i) => (i === 0 ? { ...node, size: node.size + 1e-15 } : node));
    expect(documentKey({ ...same, background: { ...same.background, nodes: other } })).not.toBe(
      documentKey(project),
    );
  });

  it("has another document key with another second stretching", () => {
    const project = { ...cubeProject(), background: variousGrid(farIds) };
    const { nodes } = project.background;
    const keyWith = (changed: typeof nodes) =>
      documentKey({ ...project, background: { ...project.background, nodes: changed } });
    const key = documentKey(project);
    expect(keyWith(nodes.map((node) => ({ ...node, secondStretching: 3 })))).not.toBe(key);
    expect(keyWith(nodes.map((node) => ({ ...node })))).toBe(key);
  });

  it("is unpacked unchanged, without the optional values that its nodes lack", async () => {
    const { nodes, tetrahedra } = variousGrid(farIds);
    expect(await unpackGrid(packedGrid({ nodes, tetrahedra }))).toEqual({ nodes, tetrahedra });
  });

  it("is made once per list", async () => {
    const grid = variousGrid(farIds);
    expect(packedGrid(grid).nodes).toBe(packedGrid(grid).nodes);
    const packed = packedGrid(grid);
    const unpacked = await unpackGrid(packed);
    expect(packedGrid(unpacked).nodes).toBe(packed.nodes);
    expect(packedTetrahedra(unpacked.tetrahedra)).toBe(packed.tetrahedra);
  });

  it("equals the arrays that the package makes for the engine, whatever the ids", () => {
    for (const idOf of [farIds, (id: number) => id, (id: number) => 100 - id]) {
      const grid = variousGrid(idOf);
      expect(engineGrid(grid)).toEqual({ ...backgroundArrays(grid), sources: undefined });
    }
  });

  it("keeps its tetrahedra if only values of nodes change", () => {
    const grid = variousGrid(farIds);
    const before = engineGrid(grid);
    const nodes = grid.nodes.map((node) => ({ ...node, size: 2 * node.size }));
    const after = engineGrid({ ...grid, nodes });
    expect(after.tetrahedra).toBe(before.tetrahedra);
    expect(after.sizes).toEqual(before.sizes.map((size) => 2 * size));
    const renumbered = engineGrid({ ...grid, nodes: grid.nodes.toReversed() });
    expect(renumbered.tetrahedra).not.toEqual(before.tetrahedra);
  });

  it("can be made from the engine's arrays, as by the package", async () => {
    const arrays = backgroundArrays(variousGrid(farIds));
    const { nodes, tetrahedra } = projectBackground(arrays);
    expect(await unpackGrid(packArrays(arrays))).toEqual({ nodes, tetrahedra });
  });
});
