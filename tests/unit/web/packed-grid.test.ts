import { describe, expect, it } from "vitest";
import { packNodes, packTetrahedra, unpackNodes, unpackTetrahedra } from "../../../web/document/packed-grid";
import { cubeProject } from "../../support/projects";

describe("a packed grid", () => {
  it("comes back as it was, with what its nodes do not say left out", () => {
    const { nodes, tetrahedra } = cubeProject().background;
    const various = nodes.map((node, i) => ({
      ...node,
      id: 10 * node.id + 2 ** 40,
      ...(i % 2 === 0 ? { stretching: 3 } : {}),
      ...(i % 4 === 0 ? { direction: [0, -1, 0.5] as const } : {}),
    }));
    expect(unpackNodes(packNodes(various))).toEqual(various);
    expect(unpackTetrahedra(packTetrahedra(tetrahedra))).toEqual(tetrahedra);
  });
});
