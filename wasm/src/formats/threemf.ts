/**
 * Reads 3MF: the objects that are built, each a region, in millimetres. The triangles of one colour or material of an object
 * are a patch. Parts in other files (production extension) are rejected; supports, textures and print settings are ignored.
 */
import { unzipSync } from "fflate";
import { type Steps, stepwise } from "../base/steps.js";
import { inSteps } from "../calls/yielder.js";
import type { Mesh } from "../mesh/mesh.js";
import { allBytes, type ByteSource } from "./byte-source.js";
import type { ReadContext } from "./file-format.js";
import type { Shape, ShapeFace } from "./joined-shapes.js";
import { failureAt, ReadFailure, truncatedAt } from "./read-result.js";
import { surfaceOfShapes } from "./shape-surface.js";
import {
  failInModel,
  type Model,
  type ModelObject,
  parseModel,
  THREE_MF_REMEDY,
  type Transform,
  type Use,
} from "./threemf-model.js";
import { indexOf } from "./text-bytes.js";
import { xmlInUtf8 } from "./xml-encoding.js";
import { hasStatedChecksum } from "./zip-directory.js";
import { withShortSizes } from "./zip64.js";

/** Limit of the model's size, per byte of the file and in addition: text of a mesh is packed to about a tenth. */
const MAX_RATIO = 200;
const MAX_EXTRA = 1 << 20;
/** Limits of objects within objects, and of the triangles of all objects that are built. */
const MAX_DEPTH = 32;
const MAX_TRIANGLES = 20_000_000;
/** Work per use of an object, in triangles. */
const PER_USE = 1000;

export async function readThreeMf(source: ByteSource, { signal }: ReadContext): Promise<Mesh> {
  const bytes = await allBytes(source);
  if (bytes.length === 0) {
    const message = "the file is empty";
    throw new ReadFailure({ code: "empty-file", message, remedy: THREE_MF_REMEDY, offset: 0 });
  }
  return inSteps(meshIn(bytes), signal);
}

function* meshIn(file: Uint8Array): Steps<Mesh> {
  const bytes = modelIn(file);
  const model = yield* parseModel(bytes);
  const shapes: Shape[] = [];
  const building = { bytes, model, shapes, triangles: 0, supports: 0 };
  const items = model.items.length > 0 ? model.items : everyObject(model);
  for (const item of items) yield* build(building, item, unitOf(model), "", 0);
  if (shapes.length === 0) failInModel(bytes, "the model builds no triangles", bytes.length);
  const { notes = [], ...mesh } = yield* surfaceOfShapes(shapes);
  const allNotes = [...notes, ...(building.supports > 0 ? ["supports are left out"] : [])];
  return { ...mesh, unit: "mm", ...(allNotes.length > 0 && { notes: allNotes }) };
}

/** Returns the bytes of the model. Throws a ReadFailure if the file is not a zip with a model. */
function modelIn(file: Uint8Array): Uint8Array {
  const tooLarge: string[] = [];
  let damaged: string | undefined;
  const wanted = /^\/?3D\/[^/]*\.model$/i;
  try {
    const found = unzipSync(withShortSizes(file), {
      filter: ({ name, originalSize }) => {
        if (!wanted.test(name)) return false;
        if (originalSize <= MAX_EXTRA + MAX_RATIO * file.length) return true;
        tooLarge.push(name);
        return false;
      },
    });
    const [model = ""] = Object.keys(found).sort();
    const bytes = found[model];
    if (bytes !== undefined) {
      if (hasStatedChecksum(file, model, bytes)) return xmlInUtf8(bytes);
      damaged = "the model in the file is damaged: its checksum is not the one that the file states";
    }
  } catch {
    if (isCutZip(file)) throw truncatedAt({ offset: file.length }, "without the list of files of a zip file");
    damaged = "the file is not a zip file, or it is damaged";
  }
  if (damaged !== undefined) throw failureAt({ offset: 0 }, damaged, THREE_MF_REMEDY);
  const message =
    tooLarge.length > 0
      ? "the model unpacks to far more than the size of the file"
      : "the file is a zip file without a 3D model";
  throw failureAt({ offset: 0 }, message, THREE_MF_REMEDY);
}

/** Returns whether a zip file begins, but has no list of its files, which is at its end. */
function isCutZip(file: Uint8Array): boolean {
  const [local, list] = [
    [0x50, 0x4b, 3, 4],
    [0x50, 0x4b, 1, 2],
  ].map((bytes) => indexOf(file, Uint8Array.from(bytes), 0));
  return local === 0 && list === -1;
}

const unitOf = ({ scale }: Model): Transform => [scale, 0, 0, 0, scale, 0, 0, 0, scale, 0, 0, 0];

/** Objects that no other object uses, for files that do not say what is built. */
function everyObject({ objects }: Model): Use[] {
  const used = new Set(
    [...objects.values()].flatMap(({ components }) => components.map(({ object }) => object)),
  );
  const transform = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];
  return [...objects.keys()].filter((id) => !used.has(id)).map((object) => ({ object, transform, at: 0 }));
}

interface Building {
  readonly bytes: Uint8Array;
  readonly model: Model;
  readonly shapes: Shape[];
  triangles: number;
  supports: number;
}

/** Adds the shapes of an object at its position. `name`: that of the object that uses it. */
function* build(building: Building, use: Use, outer: Transform, name: string, depth: number): Steps<void> {
  const { bytes, model } = building;
  const object = model.objects.get(use.object);
  if (object === undefined)
    return failInModel(bytes, `there is no object ${use.object.slice(0, 24)}`, use.at);
  if (depth > MAX_DEPTH)
    return failInModel(bytes, "objects are nested too deeply, or contain themselves", use.at);
  if (object.isSupport) {
    building.supports++;
    return;
  }
  const own = object.name === "" ? name : object.name;
  const transform = chained(use.transform, outer);
  building.triangles += PER_USE + object.triangles.length / 3;
  if (building.triangles > MAX_TRIANGLES)
    return failInModel(bytes, "the objects that are built have too many triangles", use.at);
  if (object.triangles.length > 0) building.shapes.push(yield* shapeOf(object, own, transform, model));
  for (const component of object.components) yield* build(building, component, transform, own, depth + 1);
}

/** Returns the transform that applies `inner` first. */
function chained(inner: Transform, outer: Transform): Transform {
  return inner.map((_, i) => {
    const [row, column] = [3 * Math.floor(i / 3), i % 3];
    const sum = [0, 1, 2].reduce((all, k) => all + (inner[row + k] ?? 0) * (outer[3 * k + column] ?? 0), 0);
    return row === 9 ? sum + (outer[9 + column] ?? 0) : sum;
  });
}

function* shapeOf(
  { points: given, triangles: corners, property }: ModelObject,
  name: string,
  transform: Transform,
  { properties }: Model,
): Steps<Shape> {
  const points = new Float64Array(given.length);
  yield* stepwise(given.length, (i) => {
    const [first, axis] = [i - (i % 3), i % 3];
    points[i] = [0, 1, 2].reduce(
      (sum, k) => sum + (given[first + k] ?? 0) * (transform[3 * k + axis] ?? 0),
      transform[9 + axis] ?? 0,
    );
  });
  const order = Uint32Array.from(property.keys()).sort(
    (a, b) => (property[a] ?? 0) - (property[b] ?? 0) || a - b,
  );
  const triangles = new Uint32Array(corners.length);
  yield* stepwise(order.length, (t) => {
    const from = 3 * (order[t] ?? 0);
    triangles.set(corners.subarray(from, from + 3), 3 * t);
  });
  return { name, points, triangles, faces: facesOf(property, properties) };
}

function facesOf(property: Uint32Array, properties: Model["properties"]): ShapeFace[] {
  const counts = new Map<number, number>();
  for (const owner of property) counts.set(owner, (counts.get(owner) ?? 0) + 1);
  return [...counts]
    .sort(([a], [b]) => a - b)
    .map(([owner, triangles]) => {
      const { name = "", color } = properties[owner] ?? {};
      return { name, triangles, color };
    });
}
