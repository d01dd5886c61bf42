/** Bodies of projects: their texts, the schema, placement, and their prepared surfaces. */
import {
  createMesher,
  type Mesher,
  type MeshResult,
  type PreparedBody,
  type CallProgress,
  readMesh,
  type SurfaceInput,
  writeMesh,
} from "tetrafront";
import { patchNames } from "tetrafront/internal";
import {
  type BodyPlacement,
  bodySurface,
  createBody,
  parseProject,
  type Project,
  type ProjectBackground,
  type ProjectBody,
  readProject,
  writeProject,
} from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

import { base64Of, bytesOfBase64 } from "../../../wasm/src/base/base64.js";
import { bodyArrays } from "../../../wasm/src/project/body-arrays.js";
import { parseProject as parseSource } from "../../../wasm/src/project/project.js";
import { enclosedVolume } from "../../support/check-mesh.js";
import { cubeProject } from "../../support/projects.js";
import { boxSurface, sphereSurface } from "../../support/surfaces.js";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

const EMPTY: Project = {
  format: "tetrafront-project",
  version: 2,
  name: "bodies",
  points: [],
  lines: [],
  patches: [],
  background: { nodes: [], tetrahedra: [] },
};

/** The faces of a box as six patches, in the order of `boxSurface`. */
function boxBody(changes: Partial<ProjectBody> = {}, n = 2): ProjectBody {
  const surface = boxSurface(n);
  const perFace = surface.triangles.length / 18;
  const trianglePatch = new Uint32Array(6 * perFace).map((_, t) => Math.floor(t / perFace));
  const patches = ["left", "right", "front", "back", "bottom", "top"].map((name) => ({ name }));
  const body = createBody({ ...surface, trianglePatch, patches }, { id: 3, firstPatchId: 11, name: "box" });
  return { ...body, ...changes };
}

const withBodies = (...bodies: ProjectBody[]): Project => ({ ...EMPTY, bodies });

/** Returns the path and message of the first error. */
function firstError(project: unknown): string {
  const read = parseProject(project);
  if (read.success) throw new Error("the project was accepted");
  return read.errors[0].message;
}

const textOf = (...numbers: number[]) => base64Of(new Uint8Array(Uint32Array.from(numbers).buffer));
const doublesText = (...numbers: number[]) => base64Of(new Uint8Array(Float64Array.from(numbers).buffer));

describe("base64", () => {
  test.each([0, 1, 2, 3, 4, 5, 255])("of %i bytes equals that of Node, and is read back", (length) => {
    const bytes = Uint8Array.from({ length }, (_, i) => (37 * i + 251) & 255);
    expect(base64Of(bytes)).toBe(Buffer.from(bytes).toString("base64"));
    expect(bytesOfBase64(base64Of(bytes))).toEqual(bytes);
  });

  test.each(["A", "AA", "AAA", "A===", "AA=A", "AAA\u{1F600}", "AAA-", "AA A", "====", "AAAAA==="])(
    "rejects %j",
    (text) => expect(bytesOfBase64(text)).toBeUndefined(),
  );
});

describe("a body in a project file", () => {
  test("is read back unchanged, one body per line", () => {
    const placement: BodyPlacement = { position: [1, 2, 3], rotation: [0, 0, 0.6, 0.8], scale: 2 };
    const remeshing = { minSize: 0.1, layers: 2 };
    const project = withBodies(boxBody({ placement, surface: "refine", remeshing }));
    const text = writeProject(project);
    expect(readProject(text)).toEqual({ success: true, value: project });
    expect(text.split("\n").filter((line) => line.startsWith('    {"id":3'))).toHaveLength(1);
  });

  test("has the arrays of its surface, bit for bit", () => {
    const { points, triangles } = sphereSurface(3, 0.7, [0.1, 0.2, 0.3]);
    const body = createBody({ points, triangles }, { id: 1, firstPatchId: 5, name: "ball" });
    expect(bodySurface(body)).toEqual({
      points,
      triangles,
      trianglePatch: new Uint32Array(triangles.length / 3),
    });
    expect(body.patches).toEqual([{ id: 5, name: "ball" }]);
    expect(body).not.toHaveProperty("trianglePatch");
  });

  test("keeps the names of the patches, and no meaningless ones", () => {
    expect(boxBody().patches[5]).toEqual({ id: 16, name: "top" });
    const surface = { ...boxSurface(1), patches: [{ name: "surface" }] };
    expect(createBody(surface, { id: 1, firstPatchId: 1 }).patches).toEqual([{ id: 1 }]);
    // A colour is no name, as long as there is only one.
    const colored = { ...surface, patches: [{ name: "#b51010" }] };
    expect(createBody(colored, { id: 1, firstPatchId: 1, name: "ball" }).patches[0]?.name).toBe("ball");
  });

  const invalid: [string, Partial<Record<keyof ProjectBody, unknown>>, RegExp][] = [
    ["points that are not base64", { points: "?" }, /^bodies\[0\]\.points: body "box": expected base64/],
    ["points without z", { points: doublesText(0, 0) }, /^bodies\[0\]\.points: .*24 bytes/],
    [
      "a coordinate that is not finite",
      { points: doublesText(...new Array<number>(77).fill(0), NaN) },
      /^bodies\[0\]\.points: .*node 25 .*NaN/,
    ],
    ["no triangles", { triangles: "" }, /^bodies\[0\]\.triangles: /],
    [
      "an index out of range",
      { triangles: textOf(0, 1, 26) },
      /^bodies\[0\]\.triangles: .*triangle 0 .*node 26, but there are 26 nodes/,
    ],
    ["too few patch indices", { trianglePatch: textOf(0) }, /^bodies\[0\]\.trianglePatch: .*48 triangles/],
    ["no patch indices", { trianglePatch: undefined }, /^bodies\[0\]\.trianglePatch: .*6 patches/],
    [
      "a patch that does not exist",
      { patches: [{ id: 1 }] },
      /^bodies\[0\]\.trianglePatch: .*patch 1, but there are 1 patch/,
    ],
    [
      "patches with the same id",
      { patches: [1, 1, 2, 3, 4, 5].map((id) => ({ id })) },
      /^bodies\[0\]\.patches\[1\]\.id: /,
    ],
    ["no patches", { patches: [] }, /^bodies\[0\]\.patches: /],
    [
      "a rotation that is no unit quaternion",
      { placement: { rotation: [0, 0, 1, 1] } },
      /^bodies\[0\]\.placement\.rotation: .*unit quaternion/,
    ],
    ["a scale of 0", { placement: { scale: 0 } }, /^bodies\[0\]\.placement\.scale: /],
    ["an unknown treatment", { surface: "melt" }, /^bodies\[0\]\.surface: expected one of/],
    ["an unknown option", { remeshing: { sizes: 1 } }, /^bodies\[0\]\.remeshing: there is no key "sizes"/],
    ["an angle above 180", { remeshing: { featureAngle: 200 } }, /^bodies\[0\]\.remeshing\.featureAngle: /],
  ];
  test.each(invalid)("with %s is refused", (_, changes, expected) => {
    expect(firstError({ ...EMPTY, bodies: [{ ...boxBody(), ...changes }] })).toMatch(expected);
  });

  test("must not use the patch id of a drawn patch or of another body, nor the id of another body", () => {
    const cube = cubeProject();
    const body = boxBody({ patches: boxBody().patches.map((patch, p) => ({ ...patch, id: p + 6 })) });
    expect(firstError({ ...cube, bodies: [body] })).toMatch(
      /^bodies\[0\]\.patches\[0\]\.id: another patch also has the id 6/,
    );
    expect(firstError(withBodies(boxBody(), boxBody({ id: 4 })))).toMatch(/^bodies\[1\]\.patches\[0\]\.id: /);
    expect(firstError(withBodies(boxBody(), boxBody()))).toMatch(/^bodies\[1\]\.id: another body/);
  });

  test("with a million triangles is decoded once, however often its project is checked", () => {
    const surface = sphereSurface(289);
    const project = withBodies(createBody(surface, { id: 1, firstPatchId: 1 }));
    const arraysOf = (given: Project) => {
      const read = parseSource(given);
      if (!read.success) throw new Error(read.errors[0].message);
      return read.value.bodies?.map(bodyArrays)[0];
    };
    const first = arraysOf(project);
    expect(first?.triangles.length).toBeGreaterThan(3e6);
    expect(first?.points.length).toBe(surface.points.length);
    const second = arraysOf({ ...project, name: "edited" });
    expect(second?.points).toBe(first?.points);
    expect(second?.triangles).toBe(first?.triangles);
  });
});

describe("the placement of a body", () => {
  test("scales, then rotates, then moves", () => {
    const half = Math.SQRT1_2;
    // A quarter turn about z: x goes to y.
    const placement: BodyPlacement = { position: [10, 20, 30], rotation: [0, 0, half, half], scale: 2 };
    const given = bodySurface(boxBody()).points;
    const { points } = bodySurface(boxBody({ placement }));
    for (let i = 0; i < points.length; i += 3) {
      const [x = 0, y = 0, z = 0] = given.subarray(i, i + 3);
      expect(points[i]).toBeCloseTo(10 - 2 * y, 12);
      expect(points[i + 1]).toBeCloseTo(20 + 2 * x, 12);
      expect(points[i + 2]).toBeCloseTo(30 + 2 * z, 12);
    }
  });

  test("that changes nothing gives the same coordinates", () => {
    const placement: BodyPlacement = { position: [0, 0, 0], rotation: [0, 0, 0, 1], scale: 1 };
    const body = createBody(sphereSurface(4), { id: 1, firstPatchId: 1 });
    expect(bodySurface({ ...body, placement }).points).toEqual(bodySurface(body).points);
  });
});

const diagnosticsOf = (call: Promise<unknown>) =>
  call.then(
    () => [],
    (failure: { data: { diagnostics: readonly { message: string; body?: number; entities: object[] }[] } }) =>
      failure.data.diagnostics,
  );

/** A box that a second one intersects, as one surface. */
function intersectingSurface(): SurfaceInput {
  const [one, two] = [boxSurface(2), boxSurface(2, [0.5, 0.4, 0.3], [1.5, 1.4, 1.3])];
  const nodes = one.points.length / 3;
  return {
    points: Float64Array.of(...one.points, ...two.points),
    triangles: Uint32Array.of(...one.triangles, ...two.triangles.map((node) => node + nodes)),
  };
}

describe("prepareBody", () => {
  test("keeps the triangles of a body that asks for it", async () => {
    const body = boxBody({ surface: "keep", placement: { scale: 2 } });
    const prepared = await mesher.prepareBody(withBodies(body), 3);
    expect(prepared).toEqual({
      body: 3,
      ...bodySurface(body),
      origin: new Uint32Array(48).map((_, t) => t),
      diagnostics: [],
    });
  });

  test("remeshes by default; the patches stay and the figures are there", async () => {
    const progress: CallProgress[] = [];
    const project = withBodies(boxBody());
    const control = { onProgress: (now: CallProgress) => progress.push(now) };
    const prepared = await mesher.prepareBody(project, 3, { size: 0.2 }, control);
    const { mesh: surface, ...figures } = await mesher.remeshSurface(bodySurface(boxBody()), { size: 0.2 });
    expect(prepared.points).toEqual(surface.points);
    expect(prepared.triangles).toEqual(surface.triangles);
    expect(prepared).toMatchObject(figures);
    // Each triangle lies in the plane of its patch.
    prepared.trianglePatch.forEach((patch, t) => {
      for (const node of prepared.triangles.subarray(3 * t, 3 * t + 3)) {
        expect(prepared.points[3 * node + Math.floor(patch / 2)]).toBe(patch % 2);
      }
    });
    expect(progress.at(-1)).toMatchObject({ phase: "bodies", body: 3, fraction: 1 });
  });

  test("takes the body's own size, else the project's, else sizes by shape; sources cap each", async () => {
    const count = async (project: Project, options = {}) =>
      (await mesher.prepareBody(project, 3, options)).triangles.length / 3;
    const plain = withBodies(boxBody());
    const own = withBodies(boxBody({ remeshing: { size: 0.1 } }));
    const bodySize = await count(own);
    expect(await count(own, { size: 0.5 })).toBe(bodySize);
    expect(await count({ ...plain, meshing: { size: 0.1 } })).toBe(bodySize);
    expect(await count(plain, { size: 0.1 })).toBe(bodySize);
    const { background } = cubeProject(0.1);
    const byGrid = await count({ ...plain, background });
    expect(byGrid).toBeGreaterThan(0.8 * bodySize);
    expect(byGrid).toBeLessThan(1.25 * bodySize);
    const automatic = await count(plain);
    expect(await count({ ...plain, background }, { size: 0.5 })).toBeLessThan(0.3 * byGrid);
    const sources = [{ id: 1, type: "point", positions: [[0, 0, 0]], size: 0.02, distance: 0.3 }] as const;
    const capped = { ...EMPTY.background, sources };
    expect(await count({ ...plain, background: capped })).toBeGreaterThan(1.2 * automatic);
    expect(await count({ ...own, background: capped })).toBeGreaterThan(1.2 * bodySize);
  });

  test("divides large triangles of a body that asks for it, and keeps them without a size", async () => {
    const project = withBodies(boxBody({ surface: "refine" }));
    const refined = await mesher.prepareBody(project, 3, { size: 0.2 });
    const { mesh: surface, origin } = await mesher.refineSurface(bodySurface(boxBody()), { size: 0.2 });
    expect(refined).toMatchObject({ points: surface.points, triangles: surface.triangles, origin });
    expect(refined.trianglePatch).toEqual(
      origin.map((from) => bodySurface(boxBody()).trianglePatch[from] ?? 0),
    );
    expect((await mesher.prepareBody(project, 3)).triangles).toEqual(bodySurface(boxBody()).triangles);
    expect(enclosedVolume(refined)).toBeCloseTo(1, 12);
  });

  test("names the body and the patch in its errors", async () => {
    const surface = intersectingSurface();
    const trianglePatch = new Uint32Array(surface.triangles.length / 3).map((_, t) => Number(t >= 48));
    const patches = [{ name: "block" }, { name: "lid" }];
    const body = createBody(
      { ...surface, trianglePatch, patches },
      { id: 8, firstPatchId: 20, name: "part" },
    );
    const [found] = await diagnosticsOf(mesher.prepareBody(withBodies(body), 8));
    expect(found?.message).toMatch(/^Body "part": the surface .*triangle \d+ of patch "block"/);
    expect(found?.message).toMatch(/of patch "lid"/);
    expect(found).toMatchObject({ code: "self-intersection", body: 8 });
    expect(found?.entities).toContainEqual({ kind: "patch", index: 1, id: 21, label: 'patch "lid"' });
  });

  test("refuses a body that does not exist, and a cancelled call", async () => {
    const [found] = await diagnosticsOf(mesher.prepareBody(withBodies(boxBody()), 4));
    expect(found?.message).toBe("There is no body with the id 4");
    const aborted = new AbortController();
    const call = mesher.prepareBody(withBodies(boxBody()), 3, { size: 0.01 }, { signal: aborted.signal });
    setTimeout(() => aborted.abort(), 100);
    await expect(call).rejects.toMatchObject({ code: "cancelled" });
  });
});

const errorsIn = ({ report }: MeshResult) =>
  report.diagnostics.filter(({ severity }) => severity === "error");

describe("meshProject with bodies", () => {
  test("alone gives the mesh of the filled surface", async () => {
    const surface = sphereSurface(5);
    const body = createBody(surface, { id: 1, firstPatchId: 4, name: "ball" });
    const kept = await mesher.meshProject(withBodies({ ...body, surface: "keep" }));
    const filled = await mesher.fillSurface(surface);
    expect(kept.report.status).toBe("done");
    expect(kept.report.fingerprint).toBe(filled.report.fingerprint);
    const remeshed = await mesher.meshProject(withBodies(body), { size: 0.3 });
    const prepared = await mesher.remeshSurface(surface, { size: 0.3 });
    const refilled = await mesher.fillSurface(prepared.mesh, { size: 0.3 });
    expect(remeshed.report.fingerprint).toBe(refilled.report.fingerprint);
    expect(remeshed.report.fingerprint).not.toBe(filled.report.fingerprint);
  });

  test("beside a drawn cube adds their volume, and names all patches in every format", async () => {
    const ball = createBody(sphereSurface(5, 0.5), { id: 1, firstPatchId: 17, name: "ball" });
    const project: Project = {
      ...cubeProject(),
      meshing: { size: 0.2 },
      bodies: [
        boxBody({ placement: { position: [3, 0, 0] } }),
        { ...ball, placement: { position: [-2, 0, 0] } },
      ],
    };
    const result = await mesher.meshProject(project);
    expect(result.report.status).toBe("done");
    expect(result.report.diagnostics.filter(({ severity }) => severity !== "information")).toEqual([]);
    const ballVolume = enclosedVolume(await mesher.prepareBody(project, 1));
    expect(result.report.volume).toBeCloseTo(2 + ballVolume, 9);
    expect(ballVolume).toBeGreaterThan(0.5);
    const names = patchNames(project);
    expect(names).toEqual([
      ...["bottom", "top", "front", "back", "left", "right"],
      ...["left", "right", "front", "back", "bottom", "top", "ball"],
    ]);
    expect(result.report.patches.map(({ patch }) => patch)).toEqual(names.map((_, p) => p));
    expect(Math.min(...result.report.patches.map(({ minAngle }) => minAngle))).toBeGreaterThan(25);
    for (const extension of ["msh", "vtu", "inp"]) {
      const [file] = await writeMesh(result.mesh, `part.${extension}`);
      expect(new TextDecoder().decode(file?.bytes)).toContain("ball");
    }
    const [file] = await writeMesh(result.mesh, "part.vtu");
    const read = await readMesh(file?.bytes ?? new Uint8Array(), { fileName: "part.vtu" });
    expect(read.success && read.value.patches.map(({ name }) => name)).toContain("ball");
  });

  test("within a drawn cube makes a region, as both face outward, or leaves a cavity", async () => {
    const placement: BodyPlacement = { position: [0.5, 0.5, 0.5] };
    const ball = createBody(sphereSurface(4, 0.25), { id: 1, firstPatchId: 17 });
    const project: Project = { ...cubeProject(), bodies: [{ ...ball, surface: "keep", placement }] };
    const inside = enclosedVolume(bodySurface(ball));
    const cavity = await mesher.meshProject(project, { innerShells: "cavities" });
    expect(cavity.report.volume).toBeCloseTo(1 - inside, 9);
    for (const innerShells of [undefined, "regions"] as const) {
      const regions = await mesher.meshProject(project, { innerShells });
      expect(regions.report.volume).toBeCloseTo(1, 9);
      expect(regions.report.quality.regions).toHaveLength(2);
    }
  });

  test("that intersects a drawn patch names both patches", async () => {
    const project: Project = {
      ...cubeProject(),
      bodies: [boxBody({ placement: { position: [0.5, 0.3, 0.3] } })],
    };
    const [found] = errorsIn(await mesher.meshProject(project));
    expect(found?.code).toBe("self-intersection");
    const ids = found?.entities.filter(({ kind }) => kind === "patch").map(({ id }) => id);
    expect(ids?.some((id) => id !== undefined && id >= 11)).toBe(true);
    expect(ids?.some((id) => id !== undefined && id <= 6)).toBe(true);
  });

  test("takes prepared bodies as they are", async () => {
    const project = withBodies(boxBody());
    const prepared = await mesher.prepareBody(project, 3, { size: 0.5 });
    const phases = new Set<string>();
    const onProgress = ({ phase }: CallProgress) => void phases.add(phase);
    const result = await mesher.meshProject(project, { preparedBodies: [prepared] }, { onProgress });
    expect(result.mesh.triangles).toHaveLength(prepared.triangles.length);
    expect(phases).not.toContain("bodies");
    // The arrays still belong to the caller.
    expect(prepared.points.length).toBeGreaterThan(0);
  });

  test("hands over each body that it prepares, but none that it was given", async () => {
    const other = createBody(sphereSurface(5), { id: 4, firstPatchId: 30, name: "ball" });
    const project = withBodies(boxBody(), { ...other, placement: { position: [4, 0, 0] } });
    const known = await mesher.prepareBody(project, 3, { size: 0.5 });
    const made: PreparedBody[] = [];
    const options = { size: 0.5, preparedBodies: [known] };
    await mesher.meshProject(project, options, { onBody: (prepared) => void made.push(prepared) });
    expect(made).toEqual([await mesher.prepareBody(project, 4, { size: 0.5 })]);
    const failure = new Error("stop");
    const onBody = (): void => {
      throw failure;
    };
    await expect(mesher.meshProject(project, options, { onBody })).rejects.toBe(failure);
    const rejecting = { onBody: () => Promise.reject(failure) };
    await expect(mesher.meshProject(project, options, rejecting)).rejects.toBe(failure);
    const abort = new AbortController();
    const endless = { onBody: () => (abort.abort(), new Promise(() => undefined)), signal: abort.signal };
    expect((await mesher.meshProject(project, options, endless)).report.status).toBe("cancelled");
  });

  test("reports the body that is prepared, and progress that never decreases", async () => {
    const other = createBody(sphereSurface(5), { id: 4, firstPatchId: 30, name: "ball" });
    const project = withBodies(boxBody(), { ...other, placement: { position: [4, 0, 0] } });
    const seen: CallProgress[] = [];
    const { report } = await mesher.meshProject(
      project,
      { size: 0.1 },
      { onProgress: (now) => seen.push(now) },
    );
    expect(report.status).toBe("done");
    expect(new Set(seen.map(({ body }) => body))).toEqual(new Set([3, 4, undefined]));
    for (const [i, { fraction, elapsedSeconds }] of seen.entries()) {
      expect(fraction).toBeGreaterThanOrEqual(seen[i - 1]?.fraction ?? 0);
      expect(elapsedSeconds).toBeGreaterThanOrEqual(seen[i - 1]?.elapsedSeconds ?? 0);
    }
    expect(seen.at(-1)?.fraction).toBe(1);
    const { seconds } = report;
    expect(seconds.surface).toBeGreaterThan(0);
    expect(seconds.surface).toBeLessThan(seconds.total);
  });

  test("can be cancelled while a body is prepared", async () => {
    const abort = new AbortController();
    const onProgress = ({ phase }: CallProgress) => phase === "bodies" && abort.abort();
    const { report } = await mesher.meshProject(
      withBodies(boxBody()),
      { size: 0.01 },
      { signal: abort.signal, onProgress },
    );
    expect(report.status).toBe("cancelled");
  });

  test("reports the errors of all bodies by name", async () => {
    const open = (id: number, name: string) => {
      const { points, triangles } = boxSurface(1);
      return createBody({ points, triangles: triangles.slice(3) }, { id, firstPatchId: 100 * id, name });
    };
    const result = await mesher.meshProject(withBodies(open(1, "cup"), boxBody(), open(2, "lid")));
    expect(result.report.status).toBe("invalid-input");
    const named = new Set(errorsIn(result).map(({ body, message }) => `${body} ${message.slice(0, 10)}`));
    expect(named).toEqual(new Set(['1 Body "cup"', '2 Body "lid"']));
  });

  test("reports errors of what is drawn before it prepares bodies", async () => {
    const cube = cubeProject();
    const project: Project = { ...cube, patches: cube.patches.slice(1), bodies: [boxBody()] };
    const phases = new Set<string>();
    const onProgress = ({ phase }: CallProgress) => void phases.add(phase);
    const result = await mesher.meshProject(project, { size: 0.02 }, { onProgress });
    expect(errorsIn(result)[0]?.code).toBe("open-edge");
    expect(phases).not.toContain("bodies");
  });
});

describe("the preview of a project with bodies", () => {
  test("has no problems without sizes and drawn patches", async () => {
    expect((await mesher.previewProject(withBodies(boxBody()))).diagnostics).toEqual([]);
    const [found] = (await mesher.previewProject(EMPTY)).diagnostics;
    expect(found?.code).toBe("empty-model");
  });

  test("reports options of a body that contradict each other", async () => {
    const body = boxBody({ remeshing: { size: 1, minSize: 2 } });
    const [found] = (await mesher.previewProject(withBodies(body))).diagnostics;
    expect(found).toMatchObject({ code: "invalid-option", severity: "error", body: 3 });
    expect(found?.message).toMatch(/^Body "box": the smallest size, 2, /);
  });

  test("goes with a covering grid and proposed sizes for the whole extent", async () => {
    const body = boxBody({ placement: { position: [9, 0, 0] } });
    const boxOf = ({ nodes }: ProjectBackground) => {
      const x = nodes.map(({ position }) => position[0]);
      return [Math.min(...x), Math.max(...x)];
    };
    const [low = 0, high = 0] = boxOf(await mesher.coverProject({ ...cubeProject(), bodies: [body] }));
    expect(low).toBeLessThan(0);
    expect(high).toBeGreaterThan(10);
    const [bodyLow = 0] = boxOf(await mesher.coverProject(withBodies(body)));
    expect(bodyLow).toBeGreaterThan(8.5);
    const { size } = await mesher.proposeSizes(withBodies(body));
    expect(size).toBeCloseTo(Math.sqrt(3) / 20, 9);
  });
});

describe("triangles that face inward", () => {
  const { points, triangles } = boxSurface(2);
  const treatments = ["keep", "refine", "remesh"] as const;
  const bodyOf = (nodes: Uint32Array, surface: (typeof treatments)[number]): Project => ({
    ...withBodies({
      ...createBody({ points, triangles: nodes }, { id: 1, firstPatchId: 1, name: "box" }),
      surface,
    }),
    meshing: { size: 0.4 },
  });
  const codesIn = ({ diagnostics }: MeshResult["report"]): string[] =>
    diagnostics.map(({ code }) => code).filter((code) => /orient|flipped/.test(code));

  test.each(treatments)("are refused with the remedy of fillSurface if single, with %s", async (surface) => {
    const one = triangles.slice();
    [one[0], one[1]] = [one[1] ?? 0, one[0] ?? 0];
    const [wanted] = (await mesher.fillSurface({ points, triangles: one })).report.diagnostics;
    const { report } = await mesher.meshProject(bodyOf(one, surface));
    expect(report.status).toBe("invalid-input");
    expect(report.diagnostics).toMatchObject([
      { code: "flipped-triangle", severity: "error", body: 1, remedy: wanted?.remedy },
    ]);
    await expect(mesher.remeshSurface({ points, triangles: one })).rejects.toMatchObject({
      data: { diagnostics: [{ code: "flipped-triangle" }] },
    });
    const { mesh: repaired } = await mesher.repairSurface({ points, triangles: one });
    const mesh = await mesher.meshProject(bodyOf(repaired.triangles, surface));
    expect(codesIn(mesh.report)).toEqual([]);
  });

  test.each(treatments)("are turned and noted once if they are a whole shell, with %s", async (surface) => {
    const { report } = await mesher.meshProject(bodyOf(triangles.slice().reverse(), surface));
    expect(report.status).toBe("done");
    expect(report.volume).toBeCloseTo(1, 9);
    expect(codesIn(report)).toEqual(["reoriented-patch"]);
    expect(report.diagnostics[0]?.message).toContain('Body "box"');
  });
});

test("the chord deviation of a remeshed body is that from its given surface, by patch", async () => {
  const sphere = sphereSurface(24, 1);
  const lower = sphere.triangles.length / 6;
  const trianglePatch = new Uint32Array(2 * lower).map((_, t) => (t < lower ? 0 : 1));
  const patches = [{ name: "first" }, { name: "second" }];
  const body = createBody({ ...sphere, trianglePatch, patches }, { id: 1, firstPatchId: 1 });
  const project = { ...withBodies({ ...body, remeshing: { size: 0.4, tolerance: 0.05 } }), meshing: {} };
  const prepared = await mesher.prepareBody(project, 1);
  const { report } = await mesher.meshProject(project, { preparedBodies: [prepared] });
  const largest = [0, 1].map((patch) =>
    Math.max(...(prepared.triangleDeviation ?? []).filter((_, t) => prepared.trianglePatch[t] === patch)),
  );
  expect(Math.min(...largest)).toBeGreaterThan(1e-3);
  expect(report.patches.map(({ chordDeviation }) => chordDeviation)).toEqual(largest);
  // The deviation of triangles from elsewhere is not known.
  const { triangleDeviation: _, ...without } = prepared;
  const other = await mesher.meshProject(project, { preparedBodies: [without] });
  expect(other.report.patches.map(({ chordDeviation }) => chordDeviation)).toEqual([undefined, undefined]);
  const kept = await mesher.meshProject({ ...project, bodies: [{ ...body, surface: "keep" }] });
  expect(kept.report.patches.map(({ chordDeviation }) => chordDeviation)).toEqual([0, 0]);
});
