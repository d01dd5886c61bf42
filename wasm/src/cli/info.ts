/** `tetrafront info` prints the contents of a file; `tetrafront stats` prints the quality of its elements. */
import { readingNotes } from "../api/reading-notes.js";
import { plural } from "../base/plural.js";
import { short } from "../base/short.js";
import { packageDiagnostic, printable } from "../diagnostics/package-diagnostic.js";
import { formatOf } from "../formats/file-formats.js";
import { NO_REGION } from "../generated/constants.js";
import type { MeshGroup, Mesh, SurfaceRegions } from "../mesh/mesh.js";
import { entityLabel } from "../diagnostics/entity-names.js";
import { bodyBox } from "../project/bodies.js";
import { bodyArrays } from "../project/body-arrays.js";
import {
  GROUP_KINDS,
  type BodySurface,
  type Project,
  type ProjectBody,
  type ProjectGroup,
} from "../project/project-types.js";
import { writeToStandardOutput } from "./files.js";
import { withMesher } from "./grids.js";
import { formatName, isProject, readMeshFile, readProjectFile } from "./input.js";
import { patchShapes } from "./patch-shapes.js";
import type { UnitOptions } from "./units.js";
import { InvalidInput, ExitCode, reportFailure } from "./messages.js";
import {
  type Box,
  boxText,
  meshLines,
  mixedOrientationLines,
  oppositeOrderLines,
  qualityLines,
} from "./tables.js";

/** Options as commander passes them. */
export interface InfoCommandOptions extends UnitOptions {
  readonly from?: string;
  readonly json?: boolean;
}

/** Runs `info`; resolves with the exit code. */
export function infoOnFile(input: string, options: InfoCommandOptions): Promise<number> {
  return answered(input, options, async () => {
    if (isProject(input, options.from)) {
      const held = projectContents(await readProjectFile(input, options.from));
      return { json: held, lines: projectLines(held) };
    }
    const mesh = await readMeshFile(input, options);
    const format = mesh.format ?? formatOf(formatName(input, options.from))?.name ?? "";
    const held = { format, ...meshContents(mesh) };
    return {
      json: held,
      lines: [
        ...contentLines(held),
        ...oppositeOrderLines(mesh),
        ...mixedOrientationLines(mesh),
        ...readingNotes(mesh),
      ],
    };
  });
}

/** Runs `stats`; resolves with the exit code. */
export function statsOfFile(input: string, options: InfoCommandOptions): Promise<number> {
  return answered(input, options, async () => {
    const mesh = await readMeshFile(input, options);
    if (mesh.tetrahedra.length === 0) {
      const remedy = "Use a volume mesh; `tetrafront check` prints the statistics of a surface.";
      const none = packageDiagnostic("no-tetrahedra", "the file contains no tetrahedra", remedy);
      throw new InvalidInput(input, [none]);
    }
    const found = await withMesher((mesher) => mesher.inspectMesh(mesh));
    const { boundary, ...statistics } = found;
    const reversedInFile = mesh.reversedTetrahedra ?? 0;
    const json = { ...statistics, reversedInFile, boundaryTriangles: boundary.triangles.length / 3 };
    const defects = found.isValid ? [] : ["the mesh is invalid: `tetrafront check` lists its problems"];
    const lines = [
      ...meshLines(found),
      ...qualityLines(found.quality),
      ...oppositeOrderLines(mesh),
      ...mixedOrientationLines(mesh),
      ...readingNotes(mesh),
      ...defects,
    ];
    return { json, lines };
  });
}

interface Answer {
  readonly json: object;
  readonly lines: readonly string[];
}

async function answered(
  input: string,
  { json: isJson }: InfoCommandOptions,
  ask: () => Promise<Answer>,
): Promise<number> {
  try {
    const { json, lines } = await ask();
    const text =
      isJson === true
        ? JSON.stringify({ input, ...json }, null, 2)
        : [input, ...lines].map(printable).join("\n  ");
    await writeToStandardOutput(`${text}\n`);
    return ExitCode.meshed;
  } catch (failure) {
    return reportFailure(failure, input);
  }
}

function projectContents({
  name,
  units,
  points,
  lines,
  patches,
  bodies = [],
  background,
  groups = [],
}: Project) {
  return {
    format: "Tetrafront project",
    name,
    units: units ?? null,
    points: points.length,
    lines: lines.length,
    patches: patches.length,
    bodies: bodies.map(bodyContents),
    backgroundTetrahedra: background.tetrahedra.length,
    sources: background.sources?.length ?? 0,
    groups: groups.map(groupContents),
  };
}

/** Counts the members of a group by kind; kinds without members are left out. */
function groupContents({ id, name, members }: ProjectGroup) {
  const count = (kind: string) => members.filter((member) => member.kind === kind).length;
  const counts = GROUP_KINDS.map((kind) => [kind, count(kind)] as const);
  return { id, name, members: Object.fromEntries(counts.filter(([, number]) => number > 0)) };
}

function groupLine({ id, name, members }: ReturnType<typeof groupContents>): string {
  const counts = Object.entries(members).map(([kind, number]) => plural(number, kind));
  return `${entityLabel("group", { id, name })}: ${counts.length > 0 ? counts.join(", ") : "empty"}`;
}

function bodyContents(body: ProjectBody) {
  const { points, triangles } = bodyArrays(body);
  const [low, high] = bodyBox(body);
  return {
    id: body.id,
    name: body.name ?? "",
    nodes: points.length / 3,
    triangles: triangles.length / 3,
    patches: body.patches.map(({ id, name = "" }) => ({ id, name })),
    surface: body.surface ?? "remesh",
    box: { low, high },
  };
}

function projectLines(held: ReturnType<typeof projectContents>): string[] {
  return [
    `${held.format} "${held.name}"${held.units === null ? "" : `, in ${held.units}`}`,
    [plural(held.points, "point"), plural(held.lines, "line"), plural(held.patches, "patch")].join(", "),
    ...held.bodies.flatMap(bodyLines),
    `a background grid of ${plural(held.backgroundTetrahedra, "tetrahedron")}, ${plural(held.sources, "source")}`,
    ...held.groups.map(groupLine),
  ];
}

function bodyLines(body: ReturnType<typeof bodyContents>): string[] {
  const { triangles, patches, surface, box } = body;
  const shape = [plural(triangles, "triangle"), plural(patches.length, "patch"), boxText(box)];
  return [
    `${entityLabel("body", body)}: ${[...shape, SURFACE_WORDS[surface]].join(", ")}`,
    ...patches.flatMap((patch) => (patch.name === "" ? [] : [`  ${entityLabel("patch", patch)}`])),
  ];
}

const SURFACE_WORDS: Readonly<Record<BodySurface, string>> = {
  remesh: "to be remeshed",
  refine: "to be refined",
  keep: "kept",
};

interface HeldGroup {
  readonly name: string;
  readonly tag: number;
  readonly elements: number;
}

interface HeldPatch extends HeldGroup {
  readonly box: Box | null;
  readonly area: number;
  /** The unit normal, to the side from which the triangles are counter-clockwise; null if the patch is not flat. */
  readonly normal: readonly number[] | null;
}

function meshContents(mesh: Mesh) {
  return {
    unit: mesh.unit ?? null,
    points: mesh.points.length / 3,
    box: boxOf(mesh.points),
    triangles: mesh.triangles.length / 3,
    patches: heldPatches(mesh),
    tetrahedra: mesh.tetrahedra.length / 4,
    reversedInFile: mesh.reversedTetrahedra ?? 0,
    inverted: mesh.invertedTetrahedra?.length ?? 0,
    regions: heldGroups(mesh.regions, mesh.tetrahedronRegion),
    ...(mesh.surfaceRegions && { surfaceRegions: heldSurfaceRegions(mesh.surfaceRegions) }),
    nodeData: heldFields(mesh.nodeData),
    elementData: heldFields(mesh.elementData ?? new Map()),
  };
}

const heldFields = (data: Mesh["nodeData"]) =>
  Array.from(data, ([name, { components }]) => ({ name, components }));

function heldGroups(groups: readonly MeshGroup[], positions: Uint32Array): HeldGroup[] {
  const counts = new Uint32Array(groups.length);
  for (const position of positions) counts[position] = (counts[position] ?? 0) + 1;
  return groups.map(({ name, tag }, i) => ({ name, tag, elements: counts[i] ?? 0 }));
}

/** Counts the triangles with the region on a side. */
function heldSurfaceRegions({ regions, triangleRegions }: SurfaceRegions): HeldGroup[] {
  return heldGroups(
    regions,
    triangleRegions.filter((region) => region !== NO_REGION),
  );
}

function heldPatches(mesh: Mesh): HeldPatch[] {
  const { patches, trianglePatch, triangles, points } = mesh;
  const shapes = patchShapes(mesh);
  const boxes = patches.map(() => emptyBox());
  triangles.forEach((node, corner) => {
    const box = boxes[trianglePatch[Math.floor(corner / 3)] ?? 0];
    if (box !== undefined) extend(box, points, node);
  });
  return heldGroups(patches, trianglePatch).map((group, i) => ({
    ...group,
    box: group.elements > 0 ? (boxes[i] ?? null) : null,
    area: shapes[i]?.area ?? 0,
    normal: shapes[i]?.normal ?? null,
  }));
}

function boxOf(points: Float64Array): Box | null {
  if (points.length === 0) return null;
  const box = emptyBox();
  for (let node = 0; 3 * node < points.length; ++node) extend(box, points, node);
  return box;
}

const emptyBox = () => ({ low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] });

function extend({ low, high }: ReturnType<typeof emptyBox>, points: Float64Array, node: number): void {
  for (let axis = 0; axis < 3; ++axis) {
    const x = points[3 * node + axis] ?? 0;
    low[axis] = Math.min(low[axis] ?? x, x);
    high[axis] = Math.max(high[axis] ?? x, x);
  }
}

/** One line per patch, by their numbers. `whole`: the box around the mesh. */
function patchLines(patches: readonly HeldPatch[], whole: Box | null): string[] {
  return [...patches]
    .sort((a, b) => a.tag - b.tag)
    .map(({ name, tag, elements, box, area, normal }) =>
      [
        `patch ${tag} "${name}": ${elements}`,
        ...(box === null ? [] : [boxText(box, whole ?? box), `area ${short(area)}`]),
        ...(normal === null ? [] : [`normal (${normal.map((x) => Number(x.toFixed(3)) + 0).join(", ")})`]),
      ].join(", "),
    );
}

function contentLines(held: { readonly format: string } & ReturnType<typeof meshContents>): string[] {
  const groups = (word: string, all: readonly HeldGroup[]) =>
    all.map(({ name, tag, elements }) => `${word} ${tag} "${name}": ${elements}`);
  return [
    held.unit === null ? held.format : `${held.format}, in ${held.unit}`,
    plural(held.points, "point"),
    ...(held.box === null ? [] : [boxText(held.box)]),
    plural(held.triangles, "triangle"),
    ...patchLines(held.patches, held.box),
    plural(held.tetrahedra, "tetrahedron"),
    ...groups("region", held.regions),
    ...(held.surfaceRegions ?? []).map(
      ({ name, tag, elements }) => `region ${tag} "${name}": ${plural(elements, "triangle")} around it`,
    ),
    ...held.nodeData.map(({ name, components }) => `values at the nodes "${name}": ${components} per node`),
    ...held.elementData.map(
      ({ name, components }) => `values of the elements "${name}": ${components} per element`,
    ),
  ];
}
