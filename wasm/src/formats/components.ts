/** Connected parts of a surface. */

export interface DisjointSets {
  /** The least number of the set. */
  readonly rootOf: (number: number) => number;
  readonly join: (one: number, other: number) => void;
}

/** Sets of the numbers from 0, at first one each. */
export function disjointSets(count: number): DisjointSets {
  const parent = Uint32Array.from({ length: count }, (_, number) => number);
  const rootOf = (number: number): number => {
    let root = number;
    while (parent[root] !== root) root = parent[root] ?? root;
    for (let at = number; at !== root;) {
      const next = parent[at] ?? root;
      parent[at] = root;
      at = next;
    }
    return root;
  };
  const join = (one: number, other: number): void => {
    const [a, b] = [rootOf(one), rootOf(other)];
    parent[Math.max(a, b)] = Math.min(a, b);
  };
  return { rootOf, join };
}

/** Returns per node the least node that triangles connect it to. */
export function nodeComponentsOf(triangles: Uint32Array, nodes: number): Uint32Array {
  const sets = disjointSets(nodes);
  for (let t = 0; t < triangles.length; t += 3) {
    for (const corner of [t + 1, t + 2]) sets.join(triangles[t] ?? 0, triangles[corner] ?? 0);
  }
  return Uint32Array.from({ length: nodes }, (_, node) => sets.rootOf(node));
}

/** Returns per triangle the least node of the triangles that are connected to it over nodes. */
export function componentsOf(triangles: Uint32Array, nodes: number): Uint32Array {
  const parts = nodeComponentsOf(triangles, nodes);
  return Uint32Array.from({ length: triangles.length / 3 }, (_, t) => parts[triangles[3 * t] ?? 0] ?? 0);
}
