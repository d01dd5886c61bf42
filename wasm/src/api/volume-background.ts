/** Converts a volume mesh of a file to a background grid. */
import * as v from "valibot";
import { checkArgument } from "../calls/argument-checks.js";
import { throwIfCancelled } from "../calls/cancelling.js";
import type { RunControl } from "../engine/control.js";
import { doubles, map } from "../calls/schemas.js";
import { MesherError, refuse } from "../diagnostics/mesher-error.js";
import type { ReadResult } from "../diagnostics/read-error.js";
import type { VolumeFile } from "../formats/volume-file.js";
import type { NodeData } from "../mesh/file-mesh.js";
import type { BackgroundArrays } from "../project/background-arrays.js";
import { checkControl, checkVolume } from "./input-checks.js";
import type { Mesher } from "./mesher-interface.js";

const withNodeData = v.object({ nodeData: map });

/**
 * Returns a background grid with the node values `size` of the file as sizes or, without these values, with sizes
 * from the mesh's own edges. If the file has both `stretching` and `direction`, they are used too. A name may
 * differ in case if no other name then matches. Rejects as `backgroundFromMesh` does, but invalid sizes are an
 * error of the result. `unusedData` lists the other node values.
 */
export async function volumeBackground(
  mesher: Pick<Mesher, "backgroundFromMesh">,
  volume: VolumeFile,
  control: RunControl = {},
): Promise<ReadResult<BackgroundArrays>> {
  refuse(checkControl(control));
  throwIfCancelled(control.signal);
  checkArgument("mesher", mesher, v.object({ backgroundFromMesh: v.function() }));
  refuse(checkVolume(volume, undefined));
  checkArgument("volume", volume, withNodeData);
  const count = volume.points.length / 3;
  const failed = (message: string) => {
    const remedy =
      "Store one size per node, and one stretching and a direction of three components, or neither.";
    return { success: false, errors: [{ code: "invalid-sizes", message, remedy }] } as const;
  };
  const of = (name: string) => {
    const values = dataOf(volume, name)?.values;
    checkArgument(`volume.nodeData "${name}"`, values, v.optional(doubles()));
    return values;
  };
  const [sizes, stretchings, directions] = [of("size"), of("stretching"), of("direction")];
  if (sizes !== undefined && sizes.length !== count) return failed("`size` must have one value per node");
  if (stretchings !== undefined) {
    if (stretchings.length !== count) return failed("`stretching` must have one value per node");
    if (directions?.length !== 3 * count)
      return failed("`stretching` needs `direction` with three values per node");
  }
  try {
    const grid = await mesher.backgroundFromMesh(volume, { sizes }, control);
    return { success: true, value: stretchings === undefined ? grid : { ...grid, stretchings, directions } };
  } catch (failure) {
    if (!(failure instanceof MesherError) || failure.code !== "invalid-input") throw failure;
    const [first] = failure.data.diagnostics;
    if (first === undefined) throw failure;
    const { message, remedy } = first;
    return { success: false, errors: [{ code: "invalid-sizes", message, remedy }] };
  }
}

/**
 * Returns the name of the node values that equals `name`, or differs from it in case only and is the only such
 * name.
 */
function keyOf({ nodeData }: Pick<VolumeFile, "nodeData">, name: string): string | undefined {
  if (nodeData.has(name)) return name;
  const alike = [...nodeData.keys()].filter((key) => key.toLowerCase() === name);
  return alike.length === 1 ? alike[0] : undefined;
}

function dataOf(volume: VolumeFile, name: string): NodeData | undefined {
  return volume.nodeData.get(keyOf(volume, name) ?? name);
}

/**
 * Returns the names of the node values that `volumeBackground` does not use, in file order. Throws a `MesherError`
 * if `volume` is invalid.
 */
export function unusedData(volume: Pick<VolumeFile, "nodeData">): string[] {
  checkArgument("volume", volume, withNodeData);
  const stretching = keyOf(volume, "stretching");
  const used = [keyOf(volume, "size"), stretching, stretching && keyOf(volume, "direction")];
  return [...volume.nodeData.keys()].filter((name) => !used.includes(name));
}
