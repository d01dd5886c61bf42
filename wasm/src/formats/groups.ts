/** Triangles by patch and tetrahedra by region, with names: what other programs put conditions on. */

/** With Gmsh's numbers of element types; its node order is ours. */
export const TRIANGLE = { type: 2, dimension: 2, nodes: 3 } as const;
export const TETRAHEDRON = { type: 4, dimension: 3, nodes: 4 } as const;
export type ElementKind = typeof TRIANGLE | typeof TETRAHEDRON;

/** Elements of one entity, in the order of the mesh. */
export interface Group {
  readonly kind: ElementKind;
  /** Entity and physical tag, from 1. */
  readonly tag: number;
  readonly name: string;
  /** Node positions of all its elements. */
  readonly nodes: Uint32Array;
}

export interface GroupNames {
  /** By position of the patch; else "patch 1", "patch 2", … */
  readonly patches?: readonly string[] | undefined;
  /** By region; else "region 1", "region 2", … */
  readonly regions?: readonly string[] | undefined;
}

/** Splits elements by owner, keeping their order. Owners without elements get no group. */
export function groupsOf(
  kind: ElementKind,
  nodes: Uint32Array,
  owners: Uint32Array,
  word: string,
  names: readonly string[] = [],
): Group[] {
  const counts: number[] = [];
  for (const owner of owners) counts[owner] = (counts[owner] ?? 0) + 1;
  const split = Array.from(counts, (count: number | undefined) => new Uint32Array(kind.nodes * (count ?? 0)));
  const filled = split.map(() => 0);
  owners.forEach((owner, e) => {
    const begin = filled[owner] ?? 0;
    split[owner]?.set(nodes.subarray(kind.nodes * e, kind.nodes * (e + 1)), begin);
    filled[owner] = begin + kind.nodes;
  });
  const taken = new Set<string>();
  return split.flatMap((own, owner) => {
    if (own.length === 0) return [];
    const tag = owner + 1;
    return [{ kind, tag, name: uniqueName(names[owner], `${word} ${tag}`, taken), nodes: own }];
  });
}

/** Quoted in the file, and told apart by name in other programs. */
function uniqueName(given: string | undefined, otherwise: string, taken: Set<string>): string {
  const plain = (given ?? "").replace(/["\r\n]/g, "'").trim();
  let name = plain === "" ? otherwise : plain;
  if (taken.has(name)) name = `${name} (${otherwise})`;
  taken.add(name);
  return name;
}
