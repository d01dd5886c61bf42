/** Reads a CAD file by the library occt-import-js: OpenCascade, compiled to WebAssembly. */
import { crashOf, startFailure } from "./crash.js";
import type { CadFace, CadFormat, CadReply, CadRequest, CadShape, Deflection } from "./protocol.js";
import type { CadColor } from "./trimmed-model.js";

/** Makes an instance of the library. */
export type CreateOpenCascade = (options: object) => Promise<OpenCascade>;

/** The part of the library that is used here. Its types are those of its documentation. */
interface OpenCascade {
  readonly ReadStepFile: ReadCadFile;
  readonly ReadIgesFile: ReadCadFile;
  readonly ReadBrepFile: ReadCadFile;
}

type ReadCadFile = (content: Uint8Array, parameters: object) => CadResult;

type CadResult =
  | { readonly success: false }
  | { readonly success: true; readonly root: TreeNode; readonly meshes: readonly TriangleMesh[] };

interface TreeNode {
  readonly name: string;
  /** Indices of meshes. */
  readonly meshes: readonly number[];
  readonly children: readonly TreeNode[];
}

interface TriangleMesh {
  readonly name: string;
  readonly color?: CadColor;
  /** Inclusive ranges of triangles; an empty face ends before it begins. */
  readonly brep_faces: readonly {
    readonly first: number;
    readonly last: number;
    readonly color: CadColor | null;
  }[];
  readonly attributes: { readonly position: { readonly array: readonly number[] } };
  readonly index: { readonly array: readonly number[] };
}

const READERS = {
  step: "ReadStepFile",
  iges: "ReadIgesFile",
  brep: "ReadBrepFile",
} as const satisfies Record<CadFormat, keyof OpenCascade>;

/** Options of every instance: the library prints statistics, which would mix with the output of the program. */
export const QUIET = { print: () => undefined, printErr: () => undefined } as const;

/** Reads a file. After a failure, the instance must not be used again. */
export async function readByOpenCascade(
  load: () => Promise<OpenCascade>,
  { format, bytes, deflection }: CadRequest,
): Promise<CadReply> {
  let library: OpenCascade;
  try {
    library = await load();
  } catch (failure) {
    return startFailure(failure);
  }
  try {
    const result = library[READERS[format]](bytes, parametersOf(deflection));
    return result.success ? { kind: "read", shapes: shapesOf(result) } : { kind: "rejected" };
  } catch (failure) {
    return crashOf(failure);
  }
}

function parametersOf({ distance, isRelative, angle }: Deflection): object {
  return {
    linearUnit: "millimeter",
    linearDeflectionType: isRelative ? "bounding_box_ratio" : "absolute_value",
    linearDeflection: distance,
    angularDeflection: angle,
  };
}

function shapesOf({ root, meshes }: CadResult & { readonly success: true }): CadShape[] {
  const names = namesOf(root, meshes);
  return meshes.map((mesh, m) => ({
    name: names.get(m) ?? "",
    hasOwnName: !GENERIC.test(mesh.name),
    points: Float64Array.from(mesh.attributes.position.array),
    triangles: Uint32Array.from(mesh.index.array),
    faces: mesh.brep_faces.map(({ first, last, color }): CadFace => {
      const own = color ?? mesh.color;
      return { triangles: last - first + 1, color: own && displayed(own) };
    }),
  }));
}

/** Names that OpenCascade gives to shapes without one, when it reads and when it writes them. */
export const GENERIC = /^((SOLID|COMPOUND|COMPSOLID|SHELL|FACE)?|Open CASCADE STEP translator [\d. ]+)$/;

/** Returns the name of each mesh: its own, or that of the nearest part of the file above it that has one. */
function namesOf(root: TreeNode, meshes: readonly TriangleMesh[]): Map<number, string> {
  const names = new Map<number, string>();
  const open: (readonly [node: TreeNode, above: string])[] = [[root, ""]];
  for (let next = open.pop(); next !== undefined; next = open.pop()) {
    const [node, above] = next;
    const here = GENERIC.test(node.name) ? above : node.name;
    for (const m of node.meshes) {
      const own = meshes[m]?.name ?? "";
      names.set(m, GENERIC.test(own) ? here : own);
    }
    for (const child of node.children) open.push([child, here]);
  }
  return names;
}

/** OpenCascade has linear colours. */
function displayed(color: CadColor): CadColor {
  const [red, green, blue] = color.map((value) =>
    value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055,
  );
  return [red ?? 0, green ?? 0, blue ?? 0];
}
