/** The shapes of "Be the mesher", each with the front with which it begins and the mesh that the program makes of it. */
import { fillPlane, loadTrace, type PlaneSizes } from "tetrafront/trace";
import type { Position } from "../../../../document/position";
import { distance } from "../../../../document/vectors";
import type { PlanePoint } from "../../kit/plane-view";
import type { Start } from "./board";

export interface Mesh {
  readonly nodes: readonly Position[];
  readonly elements: readonly (readonly number[])[];
}

export interface Level extends Start {
  /** 2 in the plane, 3 in space. */
  readonly dimension: 2 | 3;
  readonly program: Mesh;
  /** Candidates that the program refused. */
  readonly programRefused: number;
  /** Factor by which the shape is longer along x than the board, on which triangles are to be equilateral. */
  readonly stretching: number;
}

interface PlaneLevel {
  readonly loop: readonly PlanePoint[];
  readonly size: number;
  /** Where triangles are smaller; sizes grow away from it. */
  readonly fine?: { readonly position: PlanePoint; readonly size: number };
  readonly stretching?: number;
}

/** Growth of sizes away from where they are small. */
const growth = 0.3;

const regular = (corners: number): readonly PlanePoint[] =>
  Array.from({ length: corners }, (_none, i) => {
    const angle = (2 * Math.PI * (i + 0.25)) / corners;
    return [Math.cos(angle), Math.sin(angle)] as const;
  });

const planeLevels = {
  five: { loop: regular(5), size: 1 },
  boot: {
    loop: [
      [0, 0],
      [2, 0],
      [2, 0.8],
      [1, 0.9],
      [0.9, 2],
      [0, 2],
    ],
    size: 0.58,
  },
  fine: {
    loop: [
      [0, 0],
      [2, 0],
      [2, 1.4],
      [0, 1.4],
    ],
    size: 0.66,
    fine: { position: [0, 0], size: 0.22 },
  },
  stretched: {
    loop: [
      [0, 0],
      [3, 0],
      [3, 1],
      [1.2, 1.35],
      [0, 1],
    ],
    size: 0.45,
    stretching: 2.4,
  },
} satisfies Readonly<Record<string, PlaneLevel>>;

/** Traces of fronts in space, and the size of their elements. */
const spaceLevels = { cube: 1.2, prism: 1.2 } as const;
const traces = { cube: "cube", prism: "pocket" } as const;

export const levelNames = ["five", "boot", "fine", "stretched", "cube", "prism"] as const;
export type LevelName = (typeof levelNames)[number];

const isInPlane = (name: LevelName): name is keyof typeof planeLevels => name in planeLevels;

export const loadLevel = (name: LevelName): Promise<Level> =>
  isInPlane(name) ? planeLevel(planeLevels[name]) : spaceLevel(name);

async function planeLevel({ loop, size, fine, stretching = 1 }: PlaneLevel): Promise<Level> {
  const sizes: PlaneSizes =
    stretching > 1
      ? { nodes: [{ position: [0, 0], size, stretching, direction: [1, 0] }] }
      : { size, ...(fine && { sources: [{ ...fine, growth }] }) };
  const filled = await fillPlane([loop], sizes, { improve: false });
  if (!filled.success) throw new Error(filled.message);
  const { front, mesh, trace } = filled;
  const at = (x: number, y: number): Position => [x / stretching, y, 0];
  const nodes = pairs(front.plane).map(([x, y]) => at(x, y));
  const first = front.firstStep;
  const facets = Array.from(front.edgesBorn).flatMap((born, edge) =>
    born <= first && (front.edgesDied[edge] ?? 0) > first
      ? [[front.edges[2 * edge] ?? 0, front.edges[2 * edge + 1] ?? 0]]
      : [],
  );
  let programRefused = 0;
  for (let step = first + 1; step <= trace.stepCount; step++)
    programRefused += trace.refusalsAt(step).filter((refusal) => refusal !== undefined).length;
  const source = fine && { at: at(...fine.position), size: fine.size };
  return {
    dimension: 2,
    nodes: nodes.slice(0, front.boundaryNodes),
    facets,
    sizeAt: (position) =>
      source ? Math.min(size, source.size + growth * distance(position, source.at)) : size,
    program: { nodes: pairs(mesh.points).map(([x, y]) => at(x, y)), elements: grouped(mesh.triangles, 3) },
    programRefused,
    stretching,
  };
}

async function spaceLevel(name: keyof typeof spaceLevels): Promise<Level> {
  const answer = await fetch(new URL(`../../traces/${traces[name]}.tft`, window.location.href));
  const read = await loadTrace(new Uint8Array(await answer.arrayBuffer()));
  if (!read.success) throw new Error(read.errors[0].message);
  const trace = read.value;
  const { positions } = trace.nodes;
  const all = Array.from({ length: positions.length / 3 }, (_none, i): Position => [
    positions[3 * i] ?? 0,
    positions[3 * i + 1] ?? 0,
    positions[3 * i + 2] ?? 0,
  ]);
  const facets = Array.from(trace.frontAt(0), (face) => [
    ...trace.faces.nodes.subarray(3 * face, 3 * face + 3),
  ]);
  const given = 1 + Math.max(...facets.flat());
  const { refused } = trace.summary();
  return {
    dimension: 3,
    nodes: all.slice(0, given),
    facets,
    sizeAt: () => spaceLevels[name],
    program: {
      nodes: all,
      elements: Array.from(trace.elementsAt(trace.stepCount), (element) => [
        ...trace.elements.nodes.subarray(4 * element, 4 * element + 4),
      ]),
    },
    programRefused: Object.values(refused).reduce((sum, count) => sum + count, 0),
    stretching: 1,
  };
}

const grouped = (values: ArrayLike<number>, count: number): readonly (readonly number[])[] =>
  Array.from({ length: values.length / count }, (_none, i) =>
    Array.from({ length: count }, (_each, k) => values[count * i + k] ?? 0),
  );

const pairs = (values: ArrayLike<number>): readonly PlanePoint[] =>
  grouped(values, 2) as unknown as PlanePoint[];
