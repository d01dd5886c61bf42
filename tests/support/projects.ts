/** Small projects for tests. */
import type { Project } from "tetrafront/project";

/** Returns a project with one point moved. */
export function movePoint(project: Project, id: number, offset: readonly [number, number, number]): Project {
  const points = project.points.map((point) => {
    const [x, y, z] = point.position;
    const position: [number, number, number] = [x + offset[0], y + offset[1], z + offset[2]];
    return point.id === id ? { ...point, position } : point;
  });
  return { ...project, points };
}

/** Returns the unit cube: six planar patches and a background grid of five tetrahedra with one size. */
export function cubeProject(size = 0.25): Project {
  const corner = (i: number): [number, number, number] => [i & 1, (i >> 1) & 1, (i >> 2) & 1];
  const cornerIds = [0, 1, 2, 3, 4, 5, 6, 7];
  const edges = cornerIds.flatMap((i) =>
    [1, 2, 4].filter((bit) => (i & bit) === 0).map((bit) => [i + 1, (i | bit) + 1] as const),
  );
  const lineId = (from: number, to: number): number => {
    const forward = edges.findIndex(([a, b]) => a === from && b === to);
    return forward >= 0 ? forward + 1 : -(edges.findIndex(([a, b]) => a === to && b === from) + 1);
  };
  const faces = [
    [1, 3, 4, 2],
    [5, 6, 8, 7],
    [1, 2, 6, 5],
    [3, 7, 8, 4],
    [1, 5, 7, 3],
    [2, 4, 8, 6],
  ];
  const names = ["bottom", "top", "front", "back", "left", "right"];
  return {
    format: "tetrafront-project",
    version: 2,
    name: "Unit cube",
    points: cornerIds.map((i) => ({ id: i + 1, position: corner(i) })),
    lines: edges.map(([a, b], i) => ({ id: i + 1, type: "straight" as const, points: [a, b] })),
    patches: faces.map((face, p) => ({
      id: p + 1,
      name: names[p],
      type: "planar" as const,
      loops: [face.map((from, i) => lineId(from, face[(i + 1) % 4] ?? 0))],
    })),
    background: {
      nodes: cornerIds.map((i) => ({
        id: i + 1,
        position: corner(i).map((x) => 3 * x - 1) as [number, number, number],
        size,
      })),
      tetrahedra: [
        [1, 2, 3, 5],
        [4, 3, 2, 8],
        [6, 5, 8, 2],
        [7, 8, 5, 3],
        [2, 3, 5, 8],
      ],
    },
  };
}

/** The unit cube in a background grid that asks for elements three times as long along an oblique direction. */
export function stretchedCube(size: number): Project {
  const project = cubeProject(size);
  const nodes = project.background.nodes.map((node) => ({
    ...node,
    stretching: 3,
    direction: [1, 2, 0.5] as [number, number, number],
  }));
  return { ...project, background: { ...project.background, nodes } };
}
