/**
 * A reader of OpenFOAM's polyMesh that follows the user guide, and a check by OpenFOAM's rules; neither uses
 * the code that writes it.
 */
import { unzipSync } from "fflate";

export interface PolyMesh {
  readonly points: number[][];
  readonly faces: number[][];
  readonly owner: number[];
  readonly neighbour: number[];
  readonly patches: { readonly name: string; readonly begin: number; readonly count: number }[];
  readonly cellZones: { readonly name: string; readonly cells: number[] }[];
  readonly faceZones: { readonly name: string; readonly faces: number[] }[];
}

export function readPolyMesh(zip: Uint8Array): PolyMesh {
  const files = unzipSync(zip);
  const body = (name: string) => {
    const bytes = files[`constant/polyMesh/${name}`];
    if (bytes === undefined) throw new Error(`no ${name}`);
    const text = new TextDecoder().decode(bytes);
    if (!text.includes(`object ${name};`)) throw new Error(`${name} does not name itself`);
    return text.slice(text.indexOf("}") + 1);
  };
  const counted = <T>(name: string, entries: T[]): T[] => {
    const count = Number(/^\s*(\d+)/.exec(body(name))?.[1]);
    if (count !== entries.length) throw new Error(`${name} announces ${count}, has ${entries.length}`);
    return entries;
  };
  const rows = (name: string) =>
    counted(name, body(name).match(/\(([^()]+)\)/g) ?? []).map((row) =>
      row.slice(1, -1).trim().split(/\s+/).map(Number),
    );
  const labels = (name: string) =>
    counted(name, (/\(([^)]*)\)/.exec(body(name))?.[1] ?? "").split(/\s+/).filter(Boolean).map(Number));
  const zones = (name: string) =>
    [...body(name).matchAll(/(\S+)\s*\{\s*type \w+;\s*\w+Labels List<label> (\d+)\s*\(([^)]*)\)/g)].map(
      ([, zone = "", count, list = ""]) => {
        const numbers = list.split(/\s+/).filter(Boolean).map(Number);
        if (numbers.length !== Number(count)) throw new Error(`zone ${zone} announces ${count}`);
        return { name: zone, numbers };
      },
    );
  return {
    points: rows("points"),
    faces: rows("faces"),
    owner: labels("owner"),
    neighbour: labels("neighbour"),
    patches: counted("boundary", [
      ...body("boundary").matchAll(/(\S+)\s*\{\s*type patch;\s*nFaces (\d+);\s*startFace (\d+);\s*\}/g),
    ]).map(([, name = "", count, begin]) => ({ name, begin: Number(begin), count: Number(count) })),
    cellZones: zones("cellZones").map(({ name, numbers }) => ({ name, cells: numbers })),
    faceZones: zones("faceZones").map(({ name, numbers }) => ({ name, faces: numbers })),
  };
}

/** Returns the violated rules of OpenFOAM's `checkMesh`; empty for a valid mesh. */
export function polyMeshDefects(mesh: PolyMesh): string[] {
  const defects: string[] = [];
  const { points, faces, owner, neighbour, patches } = mesh;
  const cellCount = [...owner, ...neighbour].reduce((largest, cell) => Math.max(largest, cell), -1) + 1;
  if (owner.length !== faces.length) defects.push("not one owner per face");
  neighbour.forEach((other, f) => {
    if (!((owner[f] ?? 0) < other))
      defects.push(`face ${f}: owner ${owner[f]} is not below neighbour ${other}`);
    const isBehind = (owner[f - 1] ?? -1) < (owner[f] ?? 0);
    const isNext = owner[f - 1] === owner[f] && (neighbour[f - 1] ?? -1) < other;
    if (f > 0 && !isBehind && !isNext) defects.push(`face ${f} is not in upper triangular order`);
  });
  let next = neighbour.length;
  for (const { name, begin, count } of patches) {
    if (begin !== next) defects.push(`patch ${name} begins at ${begin}, not at ${next}`);
    if (!/^[A-Za-z_][\w.-]*$/.test(name)) defects.push(`"${name}" is not a word`);
    next = begin + count;
  }
  if (next !== faces.length) defects.push("the patches do not end with the faces");
  const names = patches.map(({ name }) => name);
  if (new Set(names).size !== names.length) defects.push("two patches have one name");
  // The area vectors of a closed cell add up to zero, and outward vectors point away from its centre.
  const at = (p: number, axis: number) => points[p]?.[axis] ?? NaN;
  const cells = Array.from({ length: cellCount }, () => ({ sum: [0, 0, 0], nodes: new Set<number>() }));
  faces.forEach((face, f) => {
    for (const cell of [owner[f], neighbour[f]]) {
      if (cell !== undefined) for (const node of face) cells[cell]?.nodes.add(node);
    }
  });
  const centres = cells.map(({ nodes }) =>
    [0, 1, 2].map((axis) => [...nodes].reduce((sum, node) => sum + at(node, axis), 0) / nodes.size),
  );
  faces.forEach((face, f) => {
    const [a = 0, b = 0, c = 0] = face;
    const side = (to: number, axis: number) => at(to, axis % 3) - at(a, axis % 3);
    const area = [0, 1, 2].map(
      (i) => (side(b, i + 1) * side(c, i + 2) - side(b, i + 2) * side(c, i + 1)) / 2,
    );
    const cell = owner[f] ?? 0;
    const outward = area.reduce(
      (sum, value, axis) => sum + value * (at(a, axis) - (centres[cell]?.[axis] ?? 0)),
      0,
    );
    if (!(outward > 0)) defects.push(`face ${f} points into its owner ${cell}`);
    area.forEach((value, axis) => {
      const [own, other] = [cells[cell], cells[neighbour[f] ?? -1]];
      if (own) own.sum[axis] = (own.sum[axis] ?? 0) + value;
      if (other) other.sum[axis] = (other.sum[axis] ?? 0) - value;
    });
  });
  cells.forEach(({ sum, nodes }, cell) => {
    if (nodes.size !== 4 || !sum.every((value) => Math.abs(value) < 1e-12))
      defects.push(`cell ${cell} is open`);
  });
  return defects;
}
