import { createMesher, type Mesher } from "tetrafront";
import { createBody, type Project, type ProjectBody } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, it, vi } from "vitest";
import { joinedHead, replaceByJoined } from "../../../web/document/touching-bodies";
import { DocumentStore } from "../../../web/session/document-store";
import { BodyPairs, joinedBody, type GivenBody } from "../../../web/session/touching-bodies";
import { emptyProject } from "../../../web/document/create";
import { boxSurface } from "../../support/surfaces";

let mesher: Mesher;
beforeAll(async () => void (mesher = await createMesher()));
afterAll(() => mesher.dispose());

const { signal } = new AbortController();

/** A unit cube, scaled and moved by its placement. */
function cube(id: number, edge: number, position: [number, number, number]): GivenBody {
  const surface = boxSurface(1);
  const trianglePatch = new Uint32Array(surface.triangles.length / 3);
  const made = createBody(surface, { id, firstPatchId: 10 * id, name: `cube ${id}` });
  const body: ProjectBody = { ...made, placement: { position, scale: edge } };
  return { body, surface: { ...surface, trianglePatch }, volume: edge ** 3, regions: 1, isPlain: true };
}

const projectOf = (given: readonly GivenBody[]): Project => ({
  ...emptyProject("a"),
  bodies: given.map(({ body }) => body),
});

describe("bodies that touch", () => {
  it("are found in groups: in a part of a face, an edge, or by a common volume", async () => {
    const bodies = [
      cube(1, 2, [0, 0, 0]),
      cube(2, 1, [2, 0.5, 0.5]),
      cube(3, 1, [9, 0, 0]),
      cube(4, 1, [9.5, 0.5, 0.5]),
      cube(5, 1, [20, 0, 0]),
      // Beside the first one, with a gap.
      cube(6, 1, [0.5, 0.5, 2.1]),
      cube(7, 2, [2, -2, 0]),
    ];
    const groups = await new BodyPairs().touching(mesher, bodies, signal);
    expect(groups.map((group) => group.map(({ body }) => body.id))).toEqual([
      [1, 2, 7],
      [3, 4],
    ]);
  });

  it("are inspected again only if the triangles or the placement of one of them have changed", async () => {
    const inspected = vi.spyOn(mesher, "inspectSurface");
    const pairs = new BodyPairs();
    const bodies = [cube(1, 1, [0, 0, 0]), cube(2, 1, [0.5, 0, 0]), cube(3, 1, [1, 0, 0])];
    const countAfter = async (given: readonly GivenBody[], groups: number[][]): Promise<number> => {
      inspected.mockClear();
      const found = await pairs.touching(mesher, given, signal);
      expect(found.map((group) => group.map(({ body }) => body.id))).toEqual(groups);
      return inspected.mock.calls.length;
    };
    const all = [[1, 2, 3]];
    expect(await countAfter(bodies, all)).toBe(3);
    expect(await countAfter(bodies, all)).toBe(0);
    const renamed = bodies.map((one) => ({ ...one, body: { ...one.body, name: "new" } }));
    expect(await countAfter(renamed, all)).toBe(0);
    const [first, second, third] = bodies;
    if (!first || !second || !third) throw new Error("no bodies");
    expect(await countAfter([first, second, cube(3, 1, [1.25, 0, 0])], all)).toBe(1);
    expect(await countAfter([first, second, cube(3, 1, [9, 0, 0])], [[1, 2]])).toBe(0);
    expect(await countAfter(bodies, all)).toBe(0);
    inspected.mockRestore();
  });

  it("become one body with a region each, in the patches of both", async () => {
    const group = [cube(1, 2, [0, 0, 0]), cube(2, 1, [2, 0.5, 0.5])];
    const project = projectOf(group);
    const joined = await joinedBody(mesher, project, group, signal);
    expect(joined).toMatchObject({ regions: 2, shared: 0 });
    expect(joined?.body).toMatchObject({ id: 3, name: "cube 1 + cube 2" });
    expect(joined?.body.patches).toEqual([
      { id: 10, name: "cube 1", solid: "cube 1" },
      { id: 20, name: "cube 2", solid: "cube 2" },
    ]);
    if (!joined) throw new Error("not joined");
    const { isFillable, volume } = await mesher.inspectSurface(joined.surface);
    expect([isFillable, volume]).toEqual([true, 9]);
  });

  it("keep a region each if their solids have the same names", async () => {
    const one = cube(1, 1, [0, 0, 0]);
    const stated = one.body.patches.map((patch) => ({ ...patch, name: "block", solid: "block" }));
    const first = { ...one, body: { ...one.body, patches: stated } };
    const patches = stated.map((patch) => ({ ...patch, id: 20 }));
    const copy: GivenBody = {
      ...first,
      body: { ...first.body, id: 2, patches, placement: { position: [1, 0, 0] } },
    };
    const project = projectOf([first, copy]);
    const joined = await joinedBody(mesher, project, [first, copy], signal);
    expect(joined?.body.patches.map(({ solid }) => solid)).toEqual(["block", "block 2"]);
  });

  it("keep their triangles if these are equal where they touch; cut ones are replaced", async () => {
    const treatmentOf = async (others: GivenBody): Promise<string> => {
      const group = [cube(1, 1, [0, 0, 0]), others].map((one) => ({
        ...one,
        body: { ...one.body, surface: "refine" as const },
      }));
      return (await joinedBody(mesher, projectOf(group), group, signal))?.body.surface ?? "remesh";
    };
    expect(await treatmentOf(cube(2, 1, [1, 0, 0]))).toBe("refine");
    expect(await treatmentOf(cube(2, 0.5, [1, 0.25, 0.25]))).toBe("remesh");
  });

  it("that share a volume keep a region each, and the first gets the volume", async () => {
    const group = [cube(1, 2, [0, 0, 0]), cube(2, 1, [1.5, 0.5, 0.5])];
    const joined = await joinedBody(mesher, projectOf(group), group, signal);
    expect(joined?.regions).toBe(2);
    expect(joined?.shared).toBeCloseTo(0.5, 12);
    if (!joined) throw new Error("not joined");
    const { shells } = await mesher.inspectSurface(joined.surface);
    expect(shells.map(({ volume }) => Math.round(volume * 1e9) / 1e9)).toEqual([8, 0.5]);
  });

  it("keep several regions of one of them where they share a volume", async () => {
    // Two cubes with a common face, as one body, and a third cube across it.
    const pair = [cube(1, 2, [0, 0, 0]), cube(2, 2, [2, 0, 0])];
    const two = await joinedBody(mesher, projectOf(pair), pair, signal);
    expect(two?.regions).toBe(2);
    if (!two) return;
    const divided: GivenBody = { ...two, volume: 16, isPlain: false };
    const group = [divided, cube(3, 1, [1.5, 0.5, 1.5])];
    const joined = await joinedBody(mesher, projectOf(group), group, signal);
    expect(joined?.shared).toBeCloseTo(0.5, 12);
    expect(joined?.regions).toBe(3);
    const { shells } = await mesher.inspectSurface(joined?.surface ?? two.surface);
    const volumes = shells.map(({ volume }) => Math.round(volume * 1e9) / 1e9);
    expect(volumes.sort((a, b) => a - b)).toEqual([0.5, 8, 8]);
  });

  it("that share a volume become one region, if one of them has fewer regions than volumes", async () => {
    const group = [cube(1, 2, [0, 0, 0]), { ...cube(2, 1, [1.5, 0.5, 0.5]), regions: 2, isPlain: false }];
    const joined = await joinedBody(mesher, projectOf(group), group, signal);
    expect(joined?.regions).toBe(1);
    expect(joined?.shared).toBeCloseTo(0.5, 12);
  });

  it("keep the region of one whose triangles face inward", async () => {
    const inward = cube(2, 1, [1.5, 0.5, 0.5]);
    const triangles = inward.surface.triangles.slice();
    for (let i = 0; i < triangles.length; i += 3) triangles.subarray(i, i + 3).reverse();
    const second = { ...inward, surface: { ...inward.surface, triangles }, isPlain: false };
    const group = [cube(1, 2, [0, 0, 0]), second];
    const joined = await joinedBody(mesher, projectOf(group), group, signal);
    expect(joined?.shared).toBeCloseTo(0.5, 12);
    if (!joined) throw new Error("not joined");
    const { shells } = await mesher.inspectSurface(joined.surface);
    expect(shells.map(({ volume }) => Math.round(volume * 1e9) / 1e9)).toEqual([8, 0.5]);
  });

  it("are joined also if the regions of one of them cannot be located, unless the work was stopped", async () => {
    const located = vi.spyOn(mesher, "locateRegions").mockRejectedValue(new Error("intersects itself"));
    const group = [cube(1, 2, [0, 0, 0]), { ...cube(2, 1, [1.5, 0.5, 0.5]), isPlain: false }];
    const joined = await joinedBody(mesher, projectOf(group), group, signal);
    expect(joined?.regions).toBe(1);
    expect(joined?.shared).toBeCloseTo(0.5, 12);
    const stopped = joinedBody(mesher, projectOf(group), group, AbortSignal.abort());
    await expect(stopped).rejects.toThrow("intersects itself");
    located.mockRestore();
  });

  it("are replaced in one step of undo, with the sizes painted on them, in their groups", () => {
    const given = [cube(1, 2, [0, 0, 0]), cube(2, 1, [2, 0, 0]), cube(3, 1, [5, 0, 0])];
    const source = { id: 1, type: "point", positions: [[2, 1, 1]], size: 0.1 } as const;
    const project: Project = {
      ...projectOf(given),
      groups: [
        { id: 1, name: "both", members: [1, 2].map((id) => ({ kind: "body", id })) },
        { id: 2, name: "other", members: [{ kind: "body", id: 3 }] },
      ],
      background: {
        nodes: [],
        tetrahedra: [],
        sources: [
          { ...source, body: 2 },
          { ...source, id: 2 },
        ],
      },
    };
    const documents = new DocumentStore(project, () => 0);
    const joined = { ...(given[0]?.body as ProjectBody), id: 4 };
    documents.edit(replaceByJoined(project, "Join", joined, [1, 2]));
    expect(documents.project.bodies?.map(({ id }) => id)).toEqual([4, 3]);
    expect(documents.project.background.sources).toEqual([
      { ...source, body: 4 },
      { ...source, id: 2 },
    ]);
    expect(documents.project.groups?.map(({ members }) => members)).toEqual([
      [{ kind: "body", id: 4 }],
      [{ kind: "body", id: 3 }],
    ]);
    documents.undo();
    expect(documents.project).toEqual(project);
  });

  it("keep the finest of the options that all have", () => {
    const [first, second] = [cube(1, 1, [0, 0, 0]).body, cube(2, 1, [0, 0, 0]).body];
    const bodies: ProjectBody[] = [
      { ...first, surface: "keep", remeshing: { size: 0.3, layers: 1, tolerance: 0.1 } },
      { ...second, surface: "refine", remeshing: { size: 0.2, layers: 3 } },
    ];
    const head = joinedHead({ ...emptyProject("a"), bodies }, bodies);
    expect(head).toEqual({ id: 3, name: "cube 1 + cube 2", remeshing: { size: 0.2, layers: 3 } });
  });
});
