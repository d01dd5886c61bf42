import { createMesher, type Mesher } from "tetrafront";
import type { Project } from "tetrafront/project";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { documentKey } from "../../../web/document/content-keys";
import { emptyProject, type Offer } from "../../../web/document/create";
import type { Entity } from "../../../web/document/entities";
import { rangeAlong } from "../../../web/document/extent";
import { sweepOperations } from "../../../web/document/operations/sweeps";
import { transformOperations } from "../../../web/document/operations/transforms";
import type { Operation, FieldValues } from "../../../web/document/operations/operation";
import { box } from "../../../web/document/pieces/box";
import { cylinder } from "../../../web/document/pieces/cylinder";
import { onCircle } from "../../../web/document/pieces/on-circle";
import { prism } from "../../../web/document/pieces/prism";
import type { Position } from "../../../web/document/position";
import {
  determinant,
  mapPosition,
  reflectionAt,
  rotationAbout,
  scalingAbout,
  translation,
} from "../../../web/document/transforms/affine";
import { joinPoints } from "../../../web/document/transforms/join-points";
import { offerCopies } from "../../../web/document/transforms/copies";
import { worldFrame } from "../../../web/document/vectors";
import { offerTransform } from "../../../web/document/transforms/transform";
import { placedIn, ShapeBuilder, type Shape } from "../../../web/document/shape";
import { pasteOperation } from "../../../web/document/operations/paste";
import { offerExtrusion } from "../../../web/document/transforms/extrude";
import { fragmentText, readFragment } from "../../../web/document/transforms/fragment";
import { offerHoleThrough } from "../../../web/document/transforms/hole-through";
import { offerRevolution } from "../../../web/document/transforms/revolve";
import { DocumentStore } from "../../../web/session/document-store";
import { regionVolumes } from "../../support/check-mesh";
import { expectValid } from "../../support/expect-valid";
import { projectOf } from "../../support/pieces";
import { randomSource } from "../../support/random";

let mesher: Mesher;
beforeAll(async () => void (mesher = await createMesher()));
afterAll(() => mesher.dispose());

const allPatches = (project: Project): Entity[] =>
  project.patches.map(({ id }) => ({ kind: "patch", id }) as const);

/** Applies an offer, checks that undo restores the project, and returns the new project. */
function applied(project: Project, offer: Offer): Project {
  if (!offer.possible) throw new Error(offer.reason);
  const documents = new DocumentStore(project, () => 0);
  const before = documentKey(project);
  documents.edit(offer.creation.edit);
  const after = documents.project;
  documents.undo();
  expect(documentKey(documents.project)).toBe(before);
  for (const list of [after.points, after.lines, after.patches]) {
    expect(new Set(list.map(({ id }) => id)).size).toBe(list.length);
  }
  return after;
}

async function volumesOf(project: Project): Promise<number[]> {
  const result = await mesher.meshProject(project);
  expect(result.report.diagnostics.filter(({ severity }) => severity !== "information")).toEqual([]);
  expectValid(result);
  return regionVolumes(result.mesh);
}

function operationNamed(id: string): Operation {
  const found = transformOperations.find((operation) => operation.id === id);
  if (!found) throw new Error(id);
  return found;
}

/** Runs an operation on all patches with some of its first values changed. */
function operated(project: Project, id: string, values: FieldValues): Project {
  const operation = operationNamed(id);
  const subject = { project, selection: allPatches(project) };
  return applied(project, operation.make(subject, { ...operation.initial(subject), ...values }));
}

const options = { label: "Test", join: true };

describe("affine maps", () => {
  const next = randomSource(7);
  const random = (): number => next() / 2 ** 32;
  const position = (): Position => [random() - 0.5, random() - 0.5, random() - 0.5];

  it("keep centres and have the determinants of their kinds", () => {
    for (let trial = 0; trial < 50; ++trial) {
      const [centre, axis] = [position(), position()];
      const rotation = rotationAbout(centre, axis, 360 * random());
      const reflection = reflectionAt(centre, axis);
      for (const map of [rotation, reflection, scalingAbout(centre, [2, 3, 4])]) {
        mapPosition(map, centre).forEach((x, k) => expect(x).toBeCloseTo(centre[k] ?? 0, 12));
      }
      expect(determinant(rotation)).toBeCloseTo(1, 12);
      expect(determinant(reflection)).toBeCloseTo(-1, 12);
      expect(determinant(scalingAbout(centre, [2, 3, 4]))).toBeCloseTo(24, 12);
    }
  });

  it("put a point on an axis at 0 there, without the rounding errors of an eighth of a turn", () => {
    const eighth = rotationAbout([0, 0, 0.5], [0, 0, 1], 45);
    expect(mapPosition(eighth, [-0.5, -0.5, 0])).toEqual([0, expect.closeTo(-Math.SQRT1_2, 15), 0]);
    expect(mapPosition(translation([-0.3, 0, 1e-30]), [0.1 + 0.2, 0, 0])).toEqual([0, 0, 1e-30]);
  });

  it("four quarter turns are exact", () => {
    const quarter = rotationAbout([1, 0, 0], [0, 0, 1], 90);
    const turned = Array.from({ length: 4 }).reduce<Position>((at) => mapPosition(quarter, at), [3, 4, 5]);
    expect(turned).toEqual([3, 4, 5]);
  });
});

describe("what a mirror or a rotation leaves in its place", () => {
  const round = projectOf(
    [cylinder(1, 1, 2), placedIn(cylinder(1, 1, 2), { ...worldFrame, origin: [4, 0, 0] })],
    0.6,
  );
  const first = allPatches(round).slice(0, 3);

  it("circles and tubes on the plane of a mirror image are not doubled", async () => {
    const mirrored = applied(
      round,
      offerCopies(round, allPatches(round), [reflectionAt([0, 0, 0], [1, 0, 0])], options),
    );
    expect([mirrored.lines, mirrored.patches].map(({ length }) => length)).toEqual([6, 9]);
    expect(mirrored.points).toHaveLength(18);
    const volumes = await volumesOf(mirrored);
    expect(volumes).toHaveLength(3);
    // Circles that begin elsewhere are the same ones.
    const slanted = offerCopies(round, first, [reflectionAt([0, 0, 0], [1, 0.3, 0])], options);
    expect(slanted).toMatchObject({ possible: false });
    const turned = offerCopies(round, first, [rotationAbout([0, 0, 0], [0, 0, 1], 50)], options);
    expect(turned).toMatchObject({ possible: false });
    // The tube is turned upside down: its circles change places.
    const flipped = offerCopies(round, first, [reflectionAt([0, 0, 1], [0, 0, 1])], options);
    expect(flipped).toMatchObject({ possible: false });
    const separate = applied(
      round,
      offerCopies(round, first, [rotationAbout([0, 0, 0], [0, 0, 1], 50)], { ...options, join: false }),
    );
    expect(separate.patches).toHaveLength(9);
  });

  it("a cylinder moved into another one joins it, without loose points", () => {
    const onto = rotationAbout([2, 0, 0], [0, 0, 1], 180);
    const turned = applied(round, offerTransform(round, allPatches(round).slice(3), onto, options));
    expect([turned.points, turned.lines, turned.patches].map(({ length }) => length)).toEqual([6, 2, 3]);
    const used = new Set(turned.lines.flatMap(({ points }) => points));
    expect(turned.points.every(({ id }) => used.has(id))).toBe(true);
  });

  it("a closed spline is the same one wherever it begins", () => {
    const builder = new ShapeBuilder();
    const ring = [0, 1, 2, 3, 4, 5].map((i) =>
      builder.point([Math.cos((i * Math.PI) / 3), Math.sin((i * Math.PI) / 3), 0]),
    );
    builder.line("spline", [...ring, 0]);
    const project = projectOf([builder.shape], 0.3);
    for (const map of [rotationAbout([0, 0, 0], [0, 0, 1], 120), reflectionAt([0, 0, 0], [1, 0, 0])]) {
      expect(offerCopies(project, [{ kind: "line", id: 1 }], [map], options)).toMatchObject({
        possible: false,
      });
    }
    const between = rotationAbout([0, 0, 0], [0, 0, 1], 30);
    expect(offerCopies(project, [{ kind: "line", id: 1 }], [between], options)).toMatchObject({
      possible: true,
    });
  });
});

describe("transforms", () => {
  const cube = projectOf([box(1, 1, 1)], 0.4);

  it.each([
    ["translated", translation([3, -2, 1]), 1],
    ["rotated", rotationAbout([1, 2, 3], [1, 1, 0], 37), 1],
    ["scaled", scalingAbout([1, 1, 1], [2, 3, 0.5]), 3],
    ["mirrored", reflectionAt([0, 0, 3], [1, 2, 3]), 1],
  ])("a cube is %s", async (_, map, factor) => {
    const moved = applied(cube, offerTransform(cube, allPatches(cube), map, options));
    expect(await volumesOf(moved)).toEqual([expect.closeTo(factor, 9)]);
    const copied = applied(cube, offerCopies(cube, allPatches(cube), [map], { ...options, join: false }));
    expect(copied.patches).toHaveLength(12);
  });

  it("copies side by side share what coincides", async () => {
    const row = operated(cube, "array-linear", { spacing: 1, count: 3 });
    expect([row.points.length, row.lines.length, row.patches.length]).toEqual([16, 28, 16]);
    expect(await volumesOf(row)).toEqual([1, 1, 1].map((volume) => expect.closeTo(volume, 9) as number));
    const mirrored = operated(cube, "transform-mirror", { point: [0.5, 0, 0] });
    expect(mirrored.patches).toHaveLength(11);
    expect(await volumesOf(mirrored)).toHaveLength(2);
  });

  it("a mirror image that coincides with its original is refused, with what to change", () => {
    const operation = operationNamed("transform-mirror");
    const subject = { project: cube, selection: allPatches(cube) };
    const values = operation.initial(subject);
    const offer = operation.make(subject, { ...values, point: [0, 0, 0] });
    expect(offer.possible ? "" : offer.reason).toContain("Move the plane");
    expect(operation.make(subject, values).possible).toBe(true);
  });

  /** The cube with its lowest corner at a position. */
  const cubeAt = ([x, y, z]: Position): Project =>
    applied(cube, offerTransform(cube, allPatches(cube), translation([x + 0.5, y + 0.5, z]), options));

  it.each([
    ["across the origin", [-0.5, -0.5, 0], [0.5, 0.5, 0]],
    ["that touches the origin", [0, 0, 0], [0, 0, 0]],
    ["beside the origin", [2, -3, 5], [0, 0, 0]],
  ] as const)(
    "a mirror begins with a plane that a body %s does not cross, for any axis",
    (_, corner, point) => {
      const body = corner[0] === -0.5 ? cube : cubeAt(corner);
      const operation = operationNamed("transform-mirror");
      const subject = { project: body, selection: allPatches(body) };
      const values = operation.initial(subject);
      expect(values).toMatchObject({ point, normal: [1, 0, 0] });
      for (const [axis, normal] of [worldFrame.x, worldFrame.y, worldFrame.z].entries()) {
        const both = applied(body, operation.make(subject, { ...values, normal }));
        const [low, high] = rangeAlong(both.points, axis);
        // The cube and its image do not overlap.
        expect(high - low).toBeGreaterThanOrEqual(2 - 1e-9);
      }
    },
  );

  it("a mirror of something flat does not begin with its own plane", () => {
    const project = projectOf([prism(4, 1, 1)], 0.4);
    const base = project.patches.find(({ loops }) =>
      [0, 1, 2, 3].every((i) => {
        const line = project.lines.find(({ id }) => id === Math.abs(loops[0]?.[i] ?? 0));
        return line?.points.every((id) => project.points.find((p) => p.id === id)?.position[2] === 0);
      }),
    );
    const upright = operated(project, "transform-rotate", { axis: worldFrame.y, centre: [0, 0, 0] });
    const selection = [{ kind: "patch", id: base?.id ?? 0 }] as const;
    const first = (of: Project): unknown =>
      operationNamed("transform-mirror").initial({ project: of, selection })["normal"];
    expect([first(project), first(upright)]).toEqual([worldFrame.x, worldFrame.y]);
  });

  it("a circular array of sectors closes", async () => {
    const wedge = projectOf([prism(3, 1, 1)], 0.5);
    const apex = wedge.points.find(({ position: [x, , z] }) => x === 1 && z === 0);
    const ring = operated(wedge, "array-circular", { centre: apex?.position ?? [0, 0, 0], count: 6 });
    const area = (3 * Math.sqrt(3)) / 4;
    const volumes = await volumesOf(ring);
    expect(volumes).toHaveLength(6);
    for (const volume of volumes) expect(volume).toBeCloseTo(area, 9);
  });

  it("points that are moved onto others are joined, with their lines and patches", async () => {
    const two = projectOf([box(1, 1, 1)], 0.4);
    const apart = applied(two, offerCopies(two, allPatches(two), [translation([5, 0, 0])], options));
    const copy = apart.patches.slice(6).map(({ id }) => ({ kind: "patch", id }) as const);
    const together = applied(apart, offerTransform(apart, copy, translation([-4, 0, 0]), options));
    expect([together.points.length, together.lines.length, together.patches.length]).toEqual([12, 20, 11]);
    expect(await volumesOf(together)).toHaveLength(2);
    expect(joinPoints(together)).toBe(together);
  });

  it("an arc is joined to one with the same course and another middle point", () => {
    const arc = (share: number): Shape => ({
      points: [onCircle(1, 0, 0), onCircle(1, share, 0), onCircle(1, 1 / 4, 0)],
      lines: [{ type: "arc", points: [0, 1, 2] }],
      patches: [],
    });
    expect(projectOf([arc(0.1), arc(0.2)], 1).lines).toHaveLength(1);
    expect(projectOf([arc(0.1), arc(0.6)], 1).lines).toHaveLength(2);
  });

  it("says what to select", () => {
    const operation = operationNamed("transform-move");
    const subject = { project: cube, selection: [] };
    expect(operation.make(subject, operation.initial(subject))).toMatchObject({ possible: false });
  });
});

describe("sweeps", () => {
  const cube = projectOf([box(1, 1, 1)], 0.4);
  const top = cube.patches.find(({ name }) => name === "top")?.id ?? 0;
  const patch = (id: number): Entity[] => [{ kind: "patch", id }];
  const extrudedBy = (project: Project, selection: Entity[], vector: Position, keepBase = true): Project =>
    applied(project, offerExtrusion(project, selection, vector, { label: "Extrude", keepBase }));

  it("a patch is extruded to a region of its own, or as a part of its region", async () => {
    const two = extrudedBy(cube, patch(top), [0.5, 0, 2]);
    expect(two.patches).toHaveLength(11);
    expect(await volumesOf(two)).toEqual([1, 2].map((volume) => expect.closeTo(volume, 9) as number));
    const one = extrudedBy(cube, patch(top), [0, 0, 2], false);
    expect(one.patches).toHaveLength(10);
    expect(await volumesOf(one)).toEqual([expect.closeTo(3, 9)]);
  });

  it("lines of a closed loop are extruded to a solid", async () => {
    const outline = projectOf([{ ...prism(5, 1, 1), patches: [] }], 0.4);
    const base = outline.lines
      .filter(({ points }) =>
        points.every((id) => outline.points.find((point) => point.id === id)?.position[2] === 0),
      )
      .map(({ id }) => ({ kind: "line", id }) as const);
    const solid = extrudedBy({ ...outline, lines: outline.lines.slice(0, 5) }, base, [0, 0, 2]);
    expect(solid.patches).toHaveLength(7);
    expect(await volumesOf(solid)).toEqual([expect.closeTo(5 * Math.sin((2 * Math.PI) / 5), 9)]);
  });

  it("a circle is extruded to a cylinder", async () => {
    const disc = cylinder(1, 1, 1);
    const project = projectOf([{ ...disc, patches: disc.patches.slice(0, 1) }], 0.3);
    const raised = extrudedBy(project, patch(project.patches[0]?.id ?? 0), [0, 0, 2]);
    expect(raised.patches.map(({ type }) => type)).toEqual(["planar", "tube", "planar"]);
    expect((await volumesOf(raised))[0]).toBeGreaterThan(0.97 * 2 * Math.PI);
  });

  const revolve = (project: Project, selection: Entity[], point: Position, angle: number): Project =>
    applied(
      project,
      offerRevolution(project, selection, { point, axis: [0, 0, 1], angle }, { label: "R", keepBase: true }),
    );
  const rectangle = (x: number): Project => {
    const corners: Position[] = [[x, 0, 0], [x + 1, 0, 0], [x + 1, 0, 1], [x, 0, 1]]; // prettier-ignore
    const builder = new ShapeBuilder({ points: corners, lines: [], patches: [] });
    builder.patch("planar", [builder.polygon([0, 1, 2, 3])]);
    return projectOf([builder.shape], 0.4);
  };

  it.each([
    ["a sector beside the axis", 1, 90, (3 * Math.PI) / 4],
    ["a ring beside the axis", 1, 360, 3 * Math.PI],
    ["a sector at the axis", 0, 200, (Math.PI * 200) / 360],
    ["a cylinder at the axis", 0, -360, Math.PI],
  ])("a rectangle is revolved to %s", async (_, x, angle, expected) => {
    const project = rectangle(x);
    const solid = revolve(project, patch(project.patches[0]?.id ?? 0), [0, 0, 0], angle);
    const volumes = await volumesOf(solid);
    expect(volumes).toHaveLength(1);
    expect((volumes[0] ?? 0) / expected).toBeGreaterThan(0.96);
    expect((volumes[0] ?? 0) / expected).toBeLessThan(1.0001);
  });

  it("a hole goes through to the patch opposite", async () => {
    const hole = { patch: top, centre: [0.1, 0.1, 7] as Position, diameter: 0.5 };
    const drilled = applied(cube, offerHoleThrough(cube, hole, "Hole"));
    expect(drilled.patches.filter(({ loops }) => loops.length === 2)).toHaveLength(3);
    const [volume = 0, ...others] = await volumesOf({ ...drilled, meshing: { size: 0.15 } });
    expect(others).toEqual([]);
    expect(volume).toBeGreaterThan(1 - Math.PI / 16);
    expect(volume).toBeLessThan(1 - 0.94 * (Math.PI / 16));
    expect(offerHoleThrough(cube, { ...hole, diameter: 0.9 }, "Hole").possible).toBe(false);
  });
});

describe("the clipboard", () => {
  it("has the selection as a project, and pastes it into another", async () => {
    const cube = projectOf([box(1, 1, 1)], 0.4);
    const text = fragmentText(cube, allPatches(cube));
    const read = readFragment(text ?? "");
    if (!("fragment" in read)) throw new Error(read.reason);
    const paste = pasteOperation(read.fragment);
    const other = projectOf([], 0.4);
    const into = (project: Project): Project => {
      const subject = { project, selection: [] };
      return applied(project, paste.make(subject, paste.initial(subject)));
    };
    expect(await volumesOf(into(other))).toEqual([expect.closeTo(1, 12)]);
    expect(await volumesOf(into(cube))).toHaveLength(2);
    expect("reason" in readFragment("{}")).toBe(true);
    expect(fragmentText(cube, [])).toBeNull();
  });

  describe("with expressions", () => {
    const textOf = (project: Project) => project.expressions?.map(({ kind, field, expression }) => `${kind} ${field} ${expression}`); // prettier-ignore
    const from: Project = {
      ...emptyProject(),
      parameters: [
        { name: "unused", expression: "7" },
        { name: "r", expression: "d/2" },
        { name: "d", expression: "1" },
      ],
      points: [
        { id: 4, position: [1, 0.5, 0] },
        { id: 5, position: [0, 0, 3] },
      ],
      expressions: [
        { kind: "point", id: 4, field: "position.0", expression: "2*r" },
        { kind: "point", id: 4, field: "position.1", expression: "r" },
        { kind: "point", id: 5, field: "position.2", expression: "6*r" },
      ],
    };
    const copied = (): Project => {
      const read = readFragment(fragmentText(from, [{ kind: "point", id: 4 }]) ?? "");
      if (!("fragment" in read)) throw new Error(read.reason);
      return read.fragment;
    };
    const pasteInto = (project: Project, values = {}, expressions = {}) => {
      const operation = pasteOperation(copied());
      const subject = { project, selection: [] };
      const all = { ...operation.initial(subject), ...values };
      return {
        note: operation.note?.(all, subject),
        project: applied(project, operation.make(subject, all, expressions)),
      };
    };

    it("copies the expressions of the selection, and the parameters that they use", () => {
      const { parameters, expressions } = copied();
      expect(parameters?.map(({ name }) => name)).toEqual(["r", "d"]);
      expect(expressions?.map(({ expression }) => expression)).toEqual(["2*r", "r"]);
    });

    it("keeps them in a project with the parameters", () => {
      const pasted = pasteInto(from, { offset: [0, 0, 2] });
      expect(pasted.note).toBe("");
      expect(pasted.project.points.at(-1)).toEqual({ id: 6, position: [1, 0.5, 2] });
      expect(textOf(pasted.project)?.slice(3)).toEqual(["point position.0 2*r", "point position.1 r"]);
      const typed = pasteInto(from, { offset: [0, 0, 2] }, { "offset.2": "4*r" });
      expect(textOf(typed.project)?.slice(3)).toContain("point position.2 4*r");
    });

    it.each([
      ["without the parameters", {}],
      ["with other values of them", { parameters: [{ name: "r", expression: "3" }] }],
    ])("pastes numbers into a project %s, with a note", (_, others) => {
      const pasted = pasteInto({ ...emptyProject(), ...others });
      expect(pasted.note).toContain("the numbers are pasted");
      expect(pasted.project.points).toEqual([{ id: 1, position: [1, 0.5, 0] }]);
      expect(pasted.project.expressions).toBeUndefined();
    });

    describe("whose values are not allowed", () => {
      const source = { id: 1, type: "point", positions: [[0, 0, 0]], size: 0.3, distance: 1, growth: 0.2 } as const; // prettier-ignore
      const withSource = (d: string): Project => ({
        ...emptyProject(),
        parameters: [{ name: "d", expression: d }],
        background: { nodes: [], tetrahedra: [], sources: [source] },
        meshing: { size: 0.5 },
        expressions: [
          { kind: "source", id: 1, field: "size", expression: "d" },
          { kind: "meshing", field: "size", expression: "2*d" },
        ],
      });
      const noteIn = (project: Project, fragment: Project): string | undefined => {
        const operation = pasteOperation(fragment);
        const subject = { project, selection: [] };
        return operation.note?.(operation.initial(subject), subject);
      };

      it("keeps them where the parameters have the same values; those of settings do not count", () => {
        expect(noteIn(withSource("0.3"), withSource("0.3"))).toBe("");
        expect(noteIn(withSource("-1"), withSource("-1"))).toBe("");
        expect(noteIn(withSource("-1"), withSource("0.3"))).toContain("the numbers are pasted");
        expect(noteIn(withSource("0.3"), withSource("-1"))).toBe("");
        expect(noteIn(withSource("0.4"), withSource("-1"))).toContain("the numbers are pasted");
      });
    });

    it("has a note for each project, whichever it was asked for before", () => {
      const operation = pasteOperation(copied());
      const noteIn = (project: Project): string | undefined => {
        const subject = { project, selection: [] };
        return operation.note?.(operation.initial(subject), subject);
      };
      for (const project of [from, emptyProject(), from]) {
        for (let k = 0; k < 2; ++k) expect(noteIn(project) === "").toBe(project === from);
      }
    });
  });
});

describe("sizes of a drawn model", () => {
  it("come with an extrusion or a revolution, unless the project has some", () => {
    const builder = new ShapeBuilder();
    const corners = ([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]] as const).map((corner) => builder.point(corner)); // prettier-ignore
    builder.patch("planar", [builder.polygon(corners)]);
    const { meshing: _, ...flat } = projectOf([builder.shape], 1);
    for (const operation of sweepOperations.slice(0, 2)) {
      const made = (project: Project): Project => {
        const subject = { project, selection: allPatches(project) };
        const values = {
          ...operation.initial(subject),
          axis: [0, 1, 0],
          point: [-1, 0, 0],
          angle: 90,
        } as const;
        return applied(project, operation.make(subject, values));
      };
      const extents = [0, 1, 2].map((axis) => {
        const values = made(flat).points.map(({ position }) => position[axis] ?? 0);
        return Math.max(...values) - Math.min(...values);
      });
      const size = made(flat).meshing?.size ?? NaN;
      expect(size / Math.max(...extents)).toBeGreaterThan(0.03);
      expect(size / Math.max(...extents)).toBeLessThanOrEqual(0.1);
      expect(made({ ...flat, meshing: { size: 7 } }).meshing?.size).toBe(7);
    }
  });
});
