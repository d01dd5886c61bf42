/** CAD solids that touch: the faces that they share are interfaces, meshed once, on their surfaces. */
import type { TopoDS_Shape } from "replicad-opencascadejs";
import { createMesher, type Mesh, type Mesher, NO_REGION } from "tetrafront";
import { meshFile } from "tetrafront/node";
import { afterAll, beforeAll, expect, test } from "vitest";

import { askForCad } from "../../../wasm/dist/cad/cad-client.js";
import { DEFLECTION } from "../../../wasm/dist/cad/deflection.js";
import { defectsOf, NO_DEFECTS } from "../../support/check-mesh.js";
import { type Kernel, stepOf, testKernel, together } from "../../support/kernel-shapes.js";
import { temporaryFolder } from "../../support/temporary-folder.js";

type Position = readonly [number, number, number];

const folder = temporaryFolder("all tests");
let kernel: Kernel;
let mesher: Mesher;
beforeAll(async () => {
  [kernel, mesher] = await Promise.all([testKernel(), createMesher()]);
});
afterAll(() => mesher.dispose());

const box = (corner: Position, sides: Position) =>
  new kernel.BRepPrimAPI_MakeBox(new kernel.gp_Pnt(...corner), ...sides).Shape();
const axesAt = (origin: Position) =>
  new kernel.gp_Ax2(new kernel.gp_Pnt(...origin), new kernel.gp_Dir(0, 0, 1));
const cylinder = (base: Position, radius: number, height: number) =>
  new kernel.BRepPrimAPI_MakeCylinder(axesAt(base), radius, height).Shape();
const ball = (centre: Position, radius: number) =>
  new kernel.BRepPrimAPI_MakeSphere(axesAt(centre), radius).Shape();
const without = (shape: TopoDS_Shape, tool: TopoDS_Shape) =>
  new kernel.BRepAlgoAPI_Cut(shape, tool, new kernel.Message_ProgressRange()).Shape();
const united = (shape: TopoDS_Shape, other: TopoDS_Shape) =>
  new kernel.BRepAlgoAPI_Fuse(shape, other, new kernel.Message_ProgressRange()).Shape();

const RADIUS = 2;
const drilledPlate = () => without(box([0, 0, 0], [10, 10, 2]), cylinder([5, 5, -1], RADIUS, 4));
const plateVolume = 200 - Math.PI * RADIUS ** 2 * 2;
const bolt = () => united(cylinder([5, 5, 0], RADIUS, 2), cylinder([5, 5, 2], 3, 1.5));

/** Solids, their volumes, and the pairs of regions with an interface, with its area. */
interface Case {
  readonly solids: () => readonly TopoDS_Shape[];
  readonly volumes: readonly number[];
  readonly interfaces: Readonly<Record<string, number>>;
  /** Whether a face has a cusp, at which triangles may be changed off the faces for the sake of their angles. */
  readonly hasCusp?: true;
}

const cases: Record<string, Case> = {
  "two boxes with a part of a face in common": {
    solids: () => [box([0, 0, 0], [2, 2, 2]), box([2, 1, 0.5], [2, 2, 2])],
    volumes: [8, 8],
    interfaces: { "0 1": 1.5 },
  },
  "a bolt in a hole": {
    solids: () => [drilledPlate(), bolt()],
    volumes: [plateVolume, Math.PI * (RADIUS ** 2 * 2 + 9 * 1.5)],
    interfaces: { "0 1": Math.PI * (2 * RADIUS * 2 + 9 - RADIUS ** 2) },
  },
  "a pin through a plate": {
    solids: () => [drilledPlate(), cylinder([5, 5, -1], RADIUS, 5)],
    volumes: [plateVolume, Math.PI * RADIUS ** 2 * 5],
    interfaces: { "0 1": 2 * Math.PI * RADIUS * 2 },
  },
  "three boxes at one edge": {
    solids: () => [box([0, 0, 0], [2, 2, 2]), box([2, 0, 0], [2, 2, 2]), box([0, 2, 0], [4, 2, 2])],
    volumes: [8, 8, 16],
    interfaces: { "0 1": 4, "0 2": 4, "1 2": 4 },
  },
  "a ball in the cavity of a box": {
    solids: () => [without(box([0, 0, 0], [10, 10, 10]), ball([5, 5, 5], 3)), ball([5, 5, 5], 3)],
    volumes: [1000 - 36 * Math.PI, 36 * Math.PI],
    interfaces: { "0 1": 36 * Math.PI },
  },
  "two boxes with an edge in common": {
    solids: () => [box([0, 0, 0], [2, 2, 2]), box([2, 2, 0], [2, 2, 2])],
    volumes: [8, 8],
    interfaces: {},
  },
  "two boxes with a vertex in common": {
    solids: () => [box([0, 0, 0], [2, 2, 2]), box([2, 2, 2], [2, 2, 2])],
    volumes: [8, 8],
    interfaces: {},
  },
  "a rod on a box, tangent to one of its edges": {
    solids: () => [box([0, 0, 0], [10, 10, 2]), cylinder([3, 5, 2], 3, 2)],
    volumes: [200, 18 * Math.PI],
    interfaces: { "0 1": 9 * Math.PI },
    hasCusp: true,
  },
  "two rods on a box that touch along a line": {
    solids: () => [box([0, 0, 0], [14, 10, 2]), cylinder([4, 5, 2], 3, 2), cylinder([10, 5, 2], 3, 2)],
    volumes: [280, 18 * Math.PI, 18 * Math.PI],
    interfaces: { "0 1": 9 * Math.PI, "0 2": 9 * Math.PI },
    hasCusp: true,
  },
};

const save = (name: string, shapes: readonly TopoDS_Shape[]): string => {
  folder.save(`${name}.step`, stepOf(kernel, together(kernel, shapes)));
  return folder.inFolder(`${name}.step`);
};

const positionOf = (points: Float64Array, node: number): Position => {
  const [x = 0, y = 0, z = 0] = points.subarray(3 * node, 3 * node + 3);
  return [x, y, z];
};

const determinant = ([a, b, c]: readonly [Position, Position, Position]) =>
  a[0] * (b[1] * c[2] - b[2] * c[1]) -
  a[1] * (b[0] * c[2] - b[2] * c[0]) +
  a[2] * (b[0] * c[1] - b[1] * c[0]);

/** Returns the volume of each region, of elements with ten nodes: the rule is exact for cubic functions. */
function volumesOf({ points, tetrahedra, tetrahedronRegion, regions, curvedEdges }: Mesh): number[] {
  const middles = new Map<string, Position>();
  const keyOf = (a: number, b: number) => `${Math.min(a, b)} ${Math.max(a, b)}`;
  curvedEdges?.edges.forEach((a, i) => {
    const b = curvedEdges.edges[i + 1] ?? 0;
    if (i % 2 === 0) middles.set(keyOf(a, b), positionOf(curvedEdges.middles, i / 2));
  });
  const volumes = regions.map(() => 0);
  const rule = [
    { weight: -0.8, at: [0.25, 0.25, 0.25, 0.25] },
    ...[0, 1, 2, 3].map((k) => ({ weight: 0.45, at: [0, 1, 2, 3].map((i) => (i === k ? 1 / 2 : 1 / 6)) })),
  ];
  tetrahedronRegion.forEach((region, t) => {
    const nodes = [...tetrahedra.subarray(4 * t, 4 * t + 4)];
    const corners = nodes.map((node) => positionOf(points, node));
    for (const { weight, at } of rule) {
      // Derivatives by the barycentric coordinates: of corners 4 l - 1, of middles 4 times the other coordinate.
      const by = [0, 1, 2, 3].map((k) =>
        [0, 1, 2].map((axis) => {
          let sum = (4 * (at[k] ?? 0) - 1) * (corners[k]?.[axis] ?? 0);
          for (const other of [0, 1, 2, 3]) {
            if (other === k) continue;
            const halfway = ((corners[k]?.[axis] ?? 0) + (corners[other]?.[axis] ?? 0)) / 2;
            const middle = middles.get(keyOf(nodes[k] ?? 0, nodes[other] ?? 0))?.[axis] ?? halfway;
            sum += 4 * (at[other] ?? 0) * middle;
          }
          return sum;
        }),
      );
      const [first = []] = by;
      const rows = by.slice(1).map((row) => row.map((x, axis) => x - (first[axis] ?? 0)));
      const jacobian = determinant(rows as unknown as [Position, Position, Position]);
      volumes[region] = (volumes[region] ?? 0) + (weight * jacobian) / 6;
    }
  });
  return volumes;
}

/** Returns the area of the interfaces between each pair of regions. */
function interfacesOf({ points, triangles, triangleRegions = new Uint32Array() }: Mesh) {
  const areas: Record<string, number> = {};
  for (let t = 0; t < triangles.length / 3; t++) {
    const pair = [...triangleRegions.subarray(2 * t, 2 * t + 2)].sort((a, b) => a - b);
    if (pair[1] === NO_REGION) continue;
    const [a, b, c] = [0, 1, 2].map((k) => positionOf(points, triangles[3 * t + k] ?? 0)) as [
      Position,
      Position,
      Position,
    ];
    const [u, v] = [b, c].map((p): Position => [p[0] - a[0], p[1] - a[1], p[2] - a[2]]) as [
      Position,
      Position,
    ];
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    areas[pair.join(" ")] = (areas[pair.join(" ")] ?? 0) + Math.hypot(...normal) / 2;
  }
  return areas;
}

test.each(Object.keys(cases))(
  "%s",
  async (name) => {
    const { solids, volumes, interfaces, hasCusp = false } = cases[name] as Case;
    const made = await meshFile(save(name, solids()), { elementOrder: 2, mesher });
    if (!made.success) throw new Error(made.message);
    const { mesh, report } = made;
    expect(report.remesh?.failedFaces).toEqual([]);
    if (!hasCusp) expect(report.remesh).toMatchObject({ onFaces: true, placement: { unplaced: 0 } });
    const { placed = 0, unplaced = Infinity } = report.remesh?.placement ?? {};
    expect(unplaced / placed).toBeLessThan(0.025);
    expect(report.dihedral.min).toBeGreaterThan(15);
    expect(defectsOf(mesh, mesh)).toEqual(NO_DEFECTS);
    const found = volumesOf(mesh);
    expect(found).toHaveLength(volumes.length);
    found.forEach((volume, region) => {
      expect(Math.abs(volume / (volumes[region] ?? 0) - 1)).toBeLessThan(hasCusp ? 1e-3 : 2e-4);
    });
    const areas = interfacesOf(mesh);
    expect(Object.keys(areas).sort()).toEqual(Object.keys(interfaces).sort());
    // Chords of circles are shorter.
    for (const [pair, area] of Object.entries(interfaces))
      expect(Math.abs((areas[pair] ?? 0) / area - 1)).toBeLessThan(0.03);
  },
  60_000,
);

test("the nodes of a bolt and its hole are on the cylinder", async () => {
  const made = await meshFile(save("bolt", [drilledPlate(), bolt()]), { mesher });
  if (!made.success) throw new Error(made.message);
  const { points, triangles, triangleRegions = new Uint32Array() } = made.mesh;
  const shared = new Set<number>();
  triangles.forEach((node, i) => {
    if (triangleRegions[2 * Math.floor(i / 3) + 1] !== NO_REGION) shared.add(node);
  });
  const around = [...shared].map((node) => positionOf(points, node)).filter(([, , z]) => z < 2 - 1e-6);
  expect(around.length).toBeGreaterThan(40);
  for (const [x, y] of around) expect(Math.abs(Math.hypot(x - 5, y - 5) - RADIUS)).toBeLessThan(1e-9 * 14);
});

test("faces keep their names, numbers and colours when they are cut", async () => {
  const step = stepOf(kernel, together(kernel, [box([0, 0, 0], [2, 2, 2]), box([2, 1, 0.5], [2, 2, 2])]));
  const text = new TextDecoder().decode(step);
  let face = 0;
  const named = text.replaceAll("ADVANCED_FACE('',", () => `ADVANCED_FACE('side ${++face}',`);
  folder.save("named.step", new TextEncoder().encode(named));
  const made = await meshFile(folder.inFolder("named.step"), { mesher });
  if (!made.success) throw new Error(made.message);
  const names = made.mesh.patches.map((patch) => patch.name).sort();
  const own = [1, 2].flatMap((solid) =>
    [1, 2, 3, 4, 5, 6].map((side) => `solid ${solid} side ${6 * (solid - 1) + side}`),
  );
  expect(names).toEqual([...own, "solid 1 / solid 2"].sort());
});

test("a solid that is inside out shares its faces, too", async () => {
  const solids = [box([0, 0, 0], [2, 2, 2]), box([2, 0, 0], [2, 2, 2]).Reversed()];
  const text = kernel.BRepToolsWrapper.Write(together(kernel, solids));
  folder.save("inside out.brep", new TextEncoder().encode(text));
  const made = await meshFile(folder.inFolder("inside out.brep"), { mesher });
  if (!made.success) throw new Error(made.message);
  expect(made.report.remesh).toMatchObject({ onFaces: true, placement: { unplaced: 0 } });
  expect(Math.abs(made.report.volume - 16)).toBeLessThan(1e-9);
});

test("solids that overlap are treated as triangles, with a message", async () => {
  const made = await meshFile(save("overlap", [box([0, 0, 0], [2, 2, 2]), box([1, 1, 1], [2, 2, 2])]), {
    mesher,
  });
  if (!made.success) throw new Error(made.message);
  expect(made.report.diagnostics.map(({ message }) => message).join()).toContain("overlap by a volume of 1");
  expect(made.report.remesh?.onFaces).toBe(false);
});

test("solids are read without common faces if the search for these takes too long", async () => {
  const bytes = stepOf(kernel, together(kernel, [drilledPlate(), bolt()]));
  const question = { format: "step", bytes, deflection: DEFLECTION } as const;
  const shared = await askForCad(question, undefined);
  const apart = await askForCad(question, undefined, { sharing: 0 });
  if (shared.kind !== "read" || apart.kind !== "read") throw new Error("the file was not read");
  expect([shared.areApart, apart.areApart]).toEqual([undefined, true]);
  const countsOf = (reply: typeof shared) => reply.shapes.map(({ trueFaces }) => trueFaces?.faceCount);
  // The faces of the plate and of the head are cut.
  expect(countsOf(apart)).toEqual([7, 5]);
  expect(countsOf(shared)).toEqual([8, 5]);
});

test("solids are fused once if they are triangulated again for a small size", async () => {
  const bytes = stepOf(kernel, together(kernel, [drilledPlate(), bolt()]));
  const coarse = await askForCad(
    { format: "step", bytes, deflection: DEFLECTION, keepsBare: true },
    undefined,
  );
  if (coarse.kind !== "read") throw new Error("the file was not read");
  const deflection = { distance: 0.001, isRelative: false, angle: DEFLECTION.angle };
  const question = { format: "step", bytes, deflection } as const;
  // A search would have no time.
  const again = await askForCad({ ...question, bare: coarse.bare }, undefined, { sharing: 0 });
  const direct = await askForCad(question, undefined);
  if (again.kind !== "read" || direct.kind !== "read") throw new Error("the file was not triangulated");
  expect(again.areApart).toBeUndefined();
  const countsOf = ({ shapes }: typeof again) =>
    shapes.map(({ triangles, trueFaces }) => [triangles.length, trueFaces?.faceCount]);
  expect(countsOf(again)).toEqual(countsOf(direct));
  expect(countsOf(again)).not.toEqual(countsOf(coarse));
});
