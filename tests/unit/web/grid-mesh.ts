import type { Mesh } from "tetrafront";

/** Returns n × n × n cells of six tetrahedra each, around the diagonal of the cell, all of positive volume. */
export function gridMesh(n: number): Pick<Mesh, "points" | "tetrahedra" | "tetrahedronRegion"> {
  const at = (x: number, y: number, z: number) => x + (n + 1) * (y + (n + 1) * z);
  const points: number[] = [];
  const tetrahedra: number[] = [];
  for (let z = 0; z <= n; ++z) for (let y = 0; y <= n; ++y) for (let x = 0; x <= n; ++x) points.push(x, y, z);
  const walks = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]] as const; // prettier-ignore
  for (let cell = 0; cell < n ** 3; ++cell) {
    const corner = [cell % n, Math.floor(cell / n) % n, Math.floor(cell / n ** 2)] as [
      number,
      number,
      number,
    ];
    walks.forEach((walk, i) => {
      const nodes = [at(...corner)];
      const step = [...corner] as [number, number, number];
      for (const axis of walk) {
        step[axis] += 1;
        nodes.push(at(...step));
      }
      const [a = 0, b = 0, c = 0, d = 0] = nodes;
      tetrahedra.push(...(i < 3 ? [a, b, c, d] : [a, c, b, d]));
    });
  }
  return {
    points: Float64Array.from(points),
    tetrahedra: Uint32Array.from(tetrahedra),
    tetrahedronRegion: new Uint32Array(tetrahedra.length / 4),
  };
}
