import { bodySurface, createBody, type Project, type ProjectBody } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import { addBodies, nextBodyIds, setPlacement, usedPatches } from "../../../web/document/body-edits";
import { documentKey, meshKey, preparedKey } from "../../../web/document/content-keys";
import { drawnSurface } from "../../../web/document/drawn-surface";
import { deleteEntities, renameEntity } from "../../../web/document/edits";
import { anglesOf, combined, placed, placedBox, rotationOf } from "../../../web/document/placement";
import { bodyProblems } from "../../../web/document/validate";
import { DocumentStore } from "../../../web/session/document-store";
import { entryBytes, maxHistoryBytes } from "../../../web/session/history";
import { maxKeptHistoryBytes, openKept } from "../../../web/session/kept-document";
import { BrushTool } from "../../../web/tools/brush-tool";
import { ViewStore } from "../../../web/document/selection";
import type { ToolPointer } from "../../../web/tools/interaction";
import { TreeRows } from "../../../web/panels/model/tree-rows";
import { cubeProject } from "../../support/projects";
import { boxSurface, sphereSurface } from "../../support/surfaces";
import { sceneState, show } from "./scene";
import { keptDocument } from "./storage-doubles";

const surface = sphereSurface(16);
const body = createBody(surface, { id: 3, firstPatchId: 20, name: "ball" });
const withBody = (change: Partial<ProjectBody> = {}): Project => ({
  ...cubeProject(),
  bodies: [{ ...body, ...change }],
});

describe("keys of projects with bodies", () => {
  it("depend on the triangles, the treatment and the placement, and only the document's on names", () => {
    const other = createBody(boxSurface(2), { id: 3, firstPatchId: 20, name: "ball" });
    const changes: Partial<ProjectBody>[] = [
      { points: other.points },
      { triangles: other.triangles },
      { surface: "keep" },
      { remeshing: { size: 0.2 } },
      { placement: { position: [0, 0, 1] } },
      { patches: [{ id: 21, name: "ball" }] },
    ];
    const projects = [cubeProject(), withBody(), ...changes.map(withBody)];
    for (const key of [documentKey, meshKey]) {
      expect(new Set(projects.map(key)).size).toBe(projects.length);
      expect(key(withBody())).toBe(key(structuredClone(withBody())));
    }
    for (const renamed of [withBody({ name: "globe" }), withBody({ patches: [{ id: 20, name: "skin" }] })]) {
      expect(meshKey(renamed)).toBe(meshKey(withBody()));
      expect(documentKey(renamed)).not.toBe(documentKey(withBody()));
    }
    const ofBox = (size: number) =>
      withBody({
        features: [
          { id: 1, type: "box", operation: "new", position: [0, 0, 0], axis: [0, 0, 1], size: [1, 1, size] },
        ],
      });
    expect(documentKey(ofBox(2))).not.toBe(documentKey(ofBox(1)));
    expect(documentKey(ofBox(1))).toBe(documentKey(structuredClone(ofBox(1))));
    const tuned = { ...withBody(), meshing: { optimization: "fast" } as const };
    expect(preparedKey(tuned, body)).toBe(preparedKey(withBody(), body));
    expect(preparedKey({ ...tuned, meshing: { size: 0.1 } }, body)).not.toBe(preparedKey(withBody(), body));
  });
});

describe("the placement of a body", () => {
  const placement = { position: [1, -2, 3], rotation: rotationOf([30, -50, 110]), scale: 2.5 } as const;

  it("moves points as the package does", () => {
    const moved = bodySurface({ ...body, placement });
    for (let node = 0; node < 50; ++node) {
      const [x = 0, y = 0, z = 0] = surface.points.subarray(3 * node, 3 * node + 3);
      placed([x, y, z], placement).forEach((at, k) =>
        expect(at).toBeCloseTo(moved.points[3 * node + k] ?? NaN, 12),
      );
    }
    const { low, high } = placedBox([-1, -1, -1], [1, 1, 1], placement);
    for (let i = 0; i < moved.points.length; ++i) {
      expect(moved.points[i]).toBeGreaterThanOrEqual((low[i % 3] ?? 0) - 1e-12);
      expect(moved.points[i]).toBeLessThanOrEqual((high[i % 3] ?? 0) + 1e-12);
    }
  });

  it("is given by angles, and omits what equals its default", () => {
    for (const angles of [
      [30, -50, 110],
      [0, 0, 90],
      [-170, 20, 5],
    ] as const) {
      anglesOf(rotationOf(angles)).forEach((angle, k) => expect(angle).toBeCloseTo(angles[k] ?? NaN, 5));
    }
    const documents = new DocumentStore(withBody(), () => 0);
    documents.edit(setPlacement(3, { position: [0, 0, 0], rotation: rotationOf([0, 0, 0]), scale: 2 }));
    expect(documents.project.bodies?.[0]?.placement).toEqual({ scale: 2 });
    documents.edit(setPlacement(3, { scale: 1 }));
    expect(documents.project.bodies?.[0]).toEqual(body);
  });

  it("combines rotations in order", () => {
    const [first, then] = [rotationOf([40, 0, -20]), rotationOf([0, 70, 10])];
    const both = placed([1, 2, 3], { rotation: combined(then, first) });
    const inOrder = placed(placed([1, 2, 3], { rotation: first }), { rotation: then });
    both.forEach((x, k) => expect(x).toBeCloseTo(inOrder[k] ?? NaN, 12));
  });

  it("moves the positions of problems", () => {
    const diagnostic = {
      code: "open-edge",
      severity: "error",
      message: "open",
      remedy: "",
      entities: [],
      data: {},
    };
    const inspection = { diagnostics: [{ ...diagnostic, position: [1, 0, 0] }] } as never;
    const [problem] = bodyProblems({ ...body, placement: { position: [0, 5, 0], scale: 3 } }, inspection);
    expect(problem).toMatchObject({ body: 3, position: [3, 5, 0] });
    expect(problem?.remedy).toContain("Repair");
  });
});

describe("drawn triangles of a body", () => {
  it("are sorted by patch, with their values, and keep their order within a patch", () => {
    const { points, triangles } = boxSurface(1);
    const trianglePatch = Uint32Array.from({ length: triangles.length / 3 }, (_, t) => t % 3);
    const values = Float32Array.from(trianglePatch, (_, t) => t);
    const drawn = drawnSurface({ points, triangles, trianglePatch }, 4, values);
    expect([...drawn.patchOffsets]).toEqual([0, 4, 8, 12, 12]);
    expect([...drawn.order]).toEqual([0, 3, 6, 9, 1, 4, 7, 10, 2, 5, 8, 11]);
    drawn.order.forEach((triangle, slot) => {
      expect([...(drawn.values?.subarray(3 * slot, 3 * slot + 3) ?? [])]).toEqual([
        triangle,
        triangle,
        triangle,
      ]);
      for (let k = 0; k < 9; ++k) {
        const node = triangles[3 * triangle + Math.floor(k / 3)] ?? 0;
        const given = (points[3 * node + (k % 3)] ?? 0) - (drawn.centre[k % 3] ?? 0);
        expect(drawn.corners[9 * slot + k]).toBeCloseTo(given, 6);
      }
    });
  });
});

describe("a document with bodies", () => {
  /** A body of about 4 million characters. */
  const large = createBody(sphereSurface(150), { id: 1, firstPatchId: 7, name: "large" });

  it("counts the texts of a body once, however many steps share them", () => {
    const documents = new DocumentStore(cubeProject(), () => 0);
    documents.edit(addBodies(documents.project, [large]));
    for (let i = 0; i < 30; ++i) {
      documents.edit(deleteEntities(documents.project, [{ kind: "body", id: 1 }]));
      documents.undo();
      documents.edit(renameEntity({ kind: "body", id: 1 }, `name ${i}`));
    }
    const { past } = documents.state.getState().history;
    expect(past).toHaveLength(31);
    const counted = new Set<string>();
    const bytes = past.reduce((sum, entry) => sum + entryBytes(entry, counted), 0);
    expect(bytes).toBeGreaterThan(large.points.length + large.triangles.length);
    expect(bytes).toBeLessThan(2 * (large.points.length + large.triangles.length));
    expect(bytes).toBeLessThan(maxHistoryBytes);
  });

  it("is restored with its steps, although one text alone is larger than their limit", async () => {
    expect(large.points.length + large.triangles.length).toBeGreaterThan(maxKeptHistoryBytes / 2);
    const documents = new DocumentStore(cubeProject(), () => 0);
    documents.edit(addBodies(documents.project, [large]));
    documents.edit(renameEntity({ kind: "body-patch", id: 7 }, "skin"));
    const kept = keptDocument(documents.state.getState(), 0, true);
    expect(kept.content.text.length).toBeLessThan(100_000);
    expect(kept.content.past.join("").length).toBeLessThan(100_000);
    const opened = await openKept(structuredClone(kept));
    if (!opened) throw new Error("The kept document cannot be read");
    const others = new DocumentStore(cubeProject());
    others.show(opened);
    expect(others.project).toEqual(documents.project);
    others.undo();
    expect(others.project.bodies?.[0]).toEqual(large);
    others.undo();
    expect(others.project.bodies ?? []).toEqual([]);
    others.redo();
    expect(others.project.bodies?.[0]).toEqual(large);
  });

  it("gives new bodies and patches ids of their own", () => {
    expect(nextBodyIds(cubeProject())).toEqual({ id: 1, firstPatchId: 7 });
    expect(nextBodyIds(withBody())).toEqual({ id: 4, firstPatchId: 21 });
  });

  it("drops patches without triangles", () => {
    const patches = [4, 5, 6, 7].map((id) => ({ id }));
    const used = usedPatches(patches, Uint32Array.of(3, 1, 3, 1));
    expect(used).toEqual({ patches: [{ id: 5 }, { id: 7 }], trianglePatch: Uint32Array.of(1, 0, 1, 0) });
  });

  it("lists the patches of a body below it", () => {
    const patches = [{ id: 20 }, { id: 25, name: "inlet" }];
    const project = withBody({ patches });
    const rows = new TreeRows(project, "", new Set());
    const index = rows.indexOf("body-3");
    expect(rows.at(index)).toMatchObject({ level: 2, open: true });
    expect(rows.at(rows.indexOf("body-patch-25"))).toMatchObject({
      title: "inlet",
      level: 3,
      ordinal: 2,
      siblings: 2,
    });
    const closed = new TreeRows(project, "", new Set(["body-3"]));
    expect(closed.length).toBe(rows.length - 2);
    expect(closed.indexOf("body-patch-25")).toBe(-1);
    const found = new TreeRows(project, "inlet", new Set(["body", "body-3"]));
    expect(found.slice(0, found.length)).toHaveLength(3);
  });
});

describe("the brush", () => {
  const pointer = (x: number | null): ToolPointer => ({
    at: { x: 0, y: 0 },
    button: "left",
    shift: false,
    mod: false,
    alt: false,
    touch: false,
    isDrag: false,
    clicks: 1,
    hit: () =>
      x === null ? null : { target: { kind: "body-patch", id: 20 }, position: [x, 0, 0], depth: 1 },
  });

  const taken = () => {
    const documents = new DocumentStore(withBody(), () => 0);
    const view = new ViewStore();
    view.setBrush({ size: 0.1, radius: 1 });
    let frames = 0;
    const viewer = { requestFrame: () => void ++frames };
    return { documents, view, tool: new BrushTool(documents, view, viewer), frames: () => frames };
  };
  const sources = (documents: DocumentStore) => documents.project.background.sources ?? [];

  it("paints a stroke as segments of half a radius or more, in one step of undo", () => {
    const { documents, tool } = taken();
    expect(tool.down(pointer(null))).toBe(false);
    expect(tool.down(pointer(0))).toBe(true);
    for (const x of [0.2, 0.5, 0.6, null, 1.2]) tool.move(pointer(x));
    tool.up();
    expect(sources(documents).map(({ type, positions }) => [type, positions.map(([x]) => x)])).toEqual([
      ["segment", [0, 0.5]],
      ["segment", [0.5, 1.2]],
    ]);
    expect(sources(documents)[0]).toMatchObject({ size: 0.1, distance: 1, body: 3 });
    expect(tool.down(pointer(3))).toBe(true);
    tool.up();
    expect(sources(documents).map(({ id, type }) => [id, type])).toEqual([
      [1, "segment"],
      [2, "segment"],
      [3, "point"],
    ]);
    documents.undo();
    documents.undo();
    expect(documents.project).toEqual(withBody());
  });

  it("shows its reach at the pointer, also without a stroke", () => {
    const { view, tool, frames } = taken();
    const layer = tool.overlay();
    const { root } = layer;
    show(layer, sceneState({ origin: [1, 0, 0] }));
    expect(root.visible).toBe(false);
    view.setBrush({ size: 0.1, radius: 0.5 });
    tool.move(pointer(3));
    expect(root.visible).toBe(true);
    expect(root.position.toArray()).toEqual([2, 0, 0]);
    expect(root.scale.toArray()).toEqual([0.5, 0.5, 0.5]);
    expect(frames()).toBe(1);
    tool.move(pointer(null));
    expect(root.visible).toBe(false);
    expect(frames()).toBe(2);
  });

  it("cancels a stroke, and Escape puts it away", () => {
    const { documents, view, tool } = taken();
    tool.down(pointer(0));
    tool.cancel();
    expect(documents.project).toEqual(withBody());
    expect(documents.state.getState().history.past).toHaveLength(0);
    expect(tool.key({ key: "Escape" } as KeyboardEvent)).toBe(true);
    expect(view.state.getState().brush).toBeNull();
    expect(tool.down(pointer(0))).toBe(false);
  });
});
