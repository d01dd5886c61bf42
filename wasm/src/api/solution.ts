/** Sizes from the fields of a solver, and fields from one mesh to another. */
import * as v from "valibot";
import { plural } from "../base/plural.js";
import { short } from "../base/short.js";
import { doubles } from "../calls/schemas.js";
import type { Diagnostic } from "../diagnostics/diagnostic.js";
import { refuse } from "../diagnostics/mesher-error.js";
import { invalidArrays, invalidOption, packageDiagnostic } from "../diagnostics/package-diagnostic.js";
import type { RunControl } from "../engine/control.js";
import type { EngineClient } from "../engine/engine-client.js";
import { countOf, numbered } from "../formats/groups.js";
import { sixfoldVolume } from "../formats/sixfold-volume.js";
import type { Mesh, VolumeInput } from "../mesh/mesh.js";
import type { FieldValues, SolutionSizes, TransferredFields } from "../mesh/solution.js";
import { beginCall } from "./call-checks.js";
import { patchesIn } from "./carried-mesh.js";
import { checkArrays, checkImproveInput, checkMesh } from "./input-checks.js";
import { frontSizeData } from "./node-sizes.js";
import type { SolutionSizeOptions, TransferOptions } from "./option-types.js";
import { checkSolutionSizeOptions, checkTransferOptions, engineSolutionOptions } from "./solution-options.js";

/** Difference of the number of elements from the target that a warning states. */
const COUNT_TOLERANCE = 0.05;

/** Implements `Mesher.sizeFromSolution`. */
export async function sizeFromSolution(
  client: EngineClient,
  given: { readonly mesh: VolumeInput; readonly fields: readonly FieldValues[] },
  options: SolutionSizeOptions,
  control: RunControl,
): Promise<SolutionSizes> {
  const { mesh, fields } = given;
  beginCall(client, control);
  // The result has the triangles and patches of the mesh, so these are checked too.
  refuse(checkImproveInput(mesh));
  refuse([...checkElements(mesh, "mesh"), ...checkSolutionSizeOptions(options)]);
  refuse(checkFields(mesh, fields));
  const indicator = indicatorAmong(fields, options.indicator);
  const asked = [volumeOf(mesh), packed(fields), engineSolutionOptions(options, indicator)] as const;
  const found = await client.ask("sizeFromSolution", asked, control);
  const { metrics, elements } = found;
  const nodeData = frontSizeData(found.frontSizes).set("metric", { components: 6, values: metrics });
  return {
    mesh: { ...completeVolume(mesh), nodeData },
    metrics,
    elements,
    expectedErrors: [...found.errors],
    diagnostics: [
      ...constantFields(fields, found.hasVariation, indicator),
      ...missedCount(options.elements, elements),
    ],
  };
}

/** Implements `Mesher.transferSolution`. */
export async function transferSolution(
  client: EngineClient,
  given: { readonly from: VolumeInput; readonly to: VolumeInput; readonly fields: readonly FieldValues[] },
  options: TransferOptions,
  control: RunControl,
): Promise<TransferredFields> {
  const { from, to, fields } = given;
  beginCall(client, control);
  refuse([...checkElements(from, "from"), ...checkElements(to, "to"), ...checkTransferOptions(options)]);
  refuse(checkFields(from, fields));
  const { conservative = false } = options;
  const asked = [volumeOf(from), volumeOf(to), packed(fields), conservative] as const;
  const found = await client.ask("transferSolution", asked, control);
  let first = 0;
  let component = 0;
  const moved: FieldValues[] = [];
  const integrals = fields.map(({ components }) => {
    const begin = component;
    component += components;
    return Array.from({ length: components }, (_, c) => ({
      before: found.integralsBefore[begin + c] ?? 0,
      after: found.integralsAfter[begin + c] ?? 0,
    }));
  });
  for (const field of fields) {
    const count = field.components * samplesOf(to, field);
    moved.push({ ...field, values: found.values.slice(first, first + count) });
    first += count;
  }
  const { outside, farthest } = found;
  return { fields: moved, integrals, outside, farthest };
}

const samplesOf = ({ points, tetrahedra }: VolumeInput, { isPerElement = false }: FieldValues): number =>
  isPerElement ? tetrahedra.length / 4 : points.length / 3;

/** Returns a mesh for the engine. */
function volumeOf({ points, tetrahedra }: VolumeInput) {
  const none = new Uint32Array();
  return { points: points.slice(), tetrahedra: tetrahedra.slice(), regions: none, front: none };
}

function packed(fields: readonly FieldValues[]) {
  const values = new Float64Array(fields.reduce((sum, field) => sum + field.values.length, 0));
  let end = 0;
  for (const field of fields) {
    values.set(field.values, end);
    end += field.values.length;
  }
  return {
    values,
    components: Uint32Array.from(fields, ({ components }) => components),
    isPerElement: Uint8Array.from(fields, ({ isPerElement = false }) => (isPerElement ? 1 : 0)),
  };
}

/** Checks the arrays of a mesh, and that its elements have positive volume. */
function checkElements(mesh: VolumeInput, name: string): Diagnostic[] {
  const wrong = checkMesh(mesh, name);
  if (wrong.length > 0) return wrong;
  const { points, tetrahedra } = mesh;
  for (let t = 0; t < tetrahedra.length; t += 4) {
    const [a = 0, b = 0, c = 0, d = 0] = tetrahedra.subarray(t, t + 4);
    if (sixfoldVolume(points, a, b, c, d).volume > 0) continue;
    const message = `tetrahedron ${t / 4} (counted from 0) has no positive volume`;
    return [packageDiagnostic("invalid-mesh", message, "Run `tetrafront improve` or `improveMesh()` first.")];
  }
  return [];
}

const fieldSchema = v.array(
  v.object({
    components: v.pipe(v.number(), v.integer(), v.minValue(1)),
    values: doubles(),
    name: v.optional(v.string()),
    isPerElement: v.optional(v.boolean()),
  }),
);

function checkFields(mesh: VolumeInput, fields: readonly FieldValues[]): Diagnostic[] {
  const remedy = "Pass fields with `components` and all their values in a Float64Array.";
  const wrong = checkArrays("fields", fields, fieldSchema, remedy);
  if (wrong.length > 0) return wrong;
  if (fields.length === 0) return [invalidArrays("no field is given", remedy)];
  return fields.flatMap((field, f) => checkField(mesh, field, nameOf(field, f)));
}

function checkField(mesh: VolumeInput, field: FieldValues, name: string): Diagnostic[] {
  const { components, values, isPerElement = false } = field;
  const word = isPerElement ? "tetrahedron" : "node";
  const count = samplesOf(mesh, field);
  if (values.length !== components * count) {
    const message = `${name} has ${plural(values.length, "value")}, but ${components} for each of ${plural(count, word)} make ${components * count}`;
    return [invalidArrays(message, "Pass the values of all nodes or elements, in their order.")];
  }
  const at = values.findIndex((value) => !Number.isFinite(value));
  if (at < 0) return [];
  const message = `${name} is ${values[at]} at ${word} ${Math.floor(at / components)} (counted from 0)`;
  return [invalidArrays(message, "Use a solution whose values are all finite.")];
}

function nameOf({ name }: FieldValues, index: number): string {
  return name === undefined ? `field ${index + 1}` : `the field "${name}"`;
}

/** Returns the index of the indicator, if there is one. Rejects a name that no field has, and values that are no indicator. */
function indicatorAmong(fields: readonly FieldValues[], name: string | undefined): number | undefined {
  if (name === undefined) return undefined;
  const index = fields.findIndex((field) => field.name === name);
  const field = fields[index];
  const remedy = "Pass a field with this name.";
  refuse(
    field === undefined
      ? [invalidOption("indicator", `no field is named "${name}"`, remedy)]
      : checkIndicator(field),
  );
  return index;
}

function checkIndicator({ name = "", components, values, isPerElement = false }: FieldValues): Diagnostic[] {
  const word = isPerElement ? "tetrahedron" : "node";
  if (components !== 1) {
    const message = `the indicator "${name}" has ${components} numbers per ${word}`;
    return [invalidArrays(message, "Use a field with one component.")];
  }
  const at = values.findIndex((value) => value < 0);
  if (at < 0) return [];
  const message = `the indicator "${name}" is ${values[at]} at ${word} ${at} (counted from 0)`;
  return [invalidArrays(message, "Use the magnitude of the error, which is at least 0.")];
}

function constantFields(
  fields: readonly FieldValues[],
  hasVariation: Uint8Array,
  indicator: number | undefined,
): Diagnostic[] {
  return fields.flatMap((field, f) => {
    if (hasVariation[f] === 1) return [];
    if (f === indicator) {
      const message = `the indicator "${field.name ?? ""}" is 0 everywhere, so no sizes follow from it`;
      return [packageDiagnostic("constant-field", message, "Use an indicator that is above 0.", "warning")];
    }
    const message = `${nameOf(field, f)} is linear, so elements of any size represent it, and no sizes follow from it`;
    return [packageDiagnostic("constant-field", message, "Use a field that bends.", "warning")];
  });
}

function missedCount(target: number | undefined, elements: number): Diagnostic[] {
  if (target === undefined || Math.abs(elements / target - 1) <= COUNT_TOLERANCE) return [];
  const message = `the limits of the sizes permit about ${short(elements)} elements, not ${target}`;
  const remedy = "Change the number of elements, the smallest or largest size, the aspect or the growth.";
  return [packageDiagnostic("element-count", message, remedy, "warning")];
}

/** Returns the mesh with all its parts. */
export function completeVolume(mesh: VolumeInput): Mesh {
  const { triangles = new Uint32Array(), tetrahedronRegion: given, regions = [] } = mesh;
  const tetrahedronRegion = given ?? new Uint32Array(mesh.tetrahedra.length / 4);
  return {
    ...mesh,
    ...patchesIn({ ...mesh, triangles }),
    triangles,
    tetrahedronRegion,
    regions: regions.length > 0 ? regions : numbered("region", countOf(tetrahedronRegion)),
    nodeData: mesh.nodeData ?? new Map(),
    elementData: undefined,
  };
}
