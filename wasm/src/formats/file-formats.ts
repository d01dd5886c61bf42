/** Which format a file has: its extension says. */
import type { Project } from "../project-schema.js";
import type { ReadResult } from "../read-result.js";
import type { MeshResult, SurfaceInput } from "../types.js";
import type { GroupNames } from "./groups.js";
import { writeMedit } from "./medit.js";
import { readMsh } from "./msh-reader.js";
import { writeMsh } from "./msh.js";
import { readObj } from "./obj.js";
import { readOff } from "./off.js";
import { readPly } from "./ply.js";
import { readStl } from "./stl.js";
import { writeSu2 } from "./su2.js";
import type { VolumeFile } from "./volume-file.js";
import { writeVtk } from "./vtk.js";
import { readVtu } from "./vtu-reader.js";
import { writeVtu } from "./vtu.js";

/** Closed surfaces that can be read. */
export const SURFACE_READERS: Readonly<Record<string, (bytes: Uint8Array) => ReadResult<SurfaceInput>>> = {
  ".stl": readStl,
  ".off": readOff,
  ".obj": readObj,
  ".ply": readPly,
};

/** Volume meshes that can be read, to become background grids (`volumeBackground`). */
export const VOLUME_READERS: Readonly<
  Record<string, (bytes: Uint8Array) => Promise<ReadResult<VolumeFile>>>
> = {
  ".vtu": readVtu,
  ".msh": (bytes) => Promise.resolve(readMsh(bytes)),
};

/** Meshes that can be written; the names in them come from the project, if there is one. */
export const MESH_WRITERS: Readonly<
  Record<string, (mesh: MeshResult, project?: Project) => Uint8Array<ArrayBuffer>>
> = {
  ".vtu": (mesh) => writeVtu(mesh),
  ".msh": (mesh, project) => writeMsh(mesh, namesOf(mesh, project)),
  ".vtk": (mesh) => writeVtk(mesh),
  ".mesh": (mesh) => writeMedit(mesh),
  ".su2": (mesh, project) => writeSu2(mesh, namesOf(mesh, project)),
};

function namesOf(mesh: MeshResult, project: Project | undefined): GroupNames {
  return { patches: project ? patchNames(project) : shellNames(mesh) };
}

/** What to call each patch in a file: its name, else its id. */
export function patchNames(project: Project): string[] {
  return project.patches.map(({ id, name }) => (name === undefined || name === "" ? `patch ${id}` : name));
}

/** A given surface has no patches; its triangles belong to its shells. */
function shellNames({ surface }: MeshResult): string[] {
  const shells = surface.trianglePatch.reduce((most, shell) => Math.max(most, shell + 1), 0);
  return Array.from({ length: shells }, (_, shell) => `shell ${shell + 1}`);
}

/** The extension of a file name in lower case, with its dot; empty where there is none. */
export function extensionOf(fileName: string): string {
  return /\.[^./\\]+$/.exec(fileName)?.[0].toLowerCase() ?? "";
}
