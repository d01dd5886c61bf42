import { parseProject, type Project } from "tetrafront/project";
import { describe, expect, it } from "vitest";
import type { Creation, Offer } from "../../../web/document/create";
import { setLineType, setTangent } from "../../../web/document/edits";
import type { Entity } from "../../../web/document/entities";
import { offerLoft, offerSmooth } from "../../../web/document/smooth";
import { splitLine } from "../../../web/document/splits/split-line";
import { rotationAbout } from "../../../web/document/transforms/affine";
import { offerCopies } from "../../../web/document/transforms/copies";
import { offerTransform } from "../../../web/document/transforms/transform";
import { DocumentStore } from "../../../web/session/document-store";
import { curvatureRange } from "../../../web/session/smoothness-feed";
import { cubeProject } from "../../support/projects";

const entities = (kind: "line" | "patch", ...ids: number[]): Entity[] => ids.map((id) => ({ kind, id }));

function taken(offer: Offer): Creation {
  if (!offer.possible) throw new Error(offer.reason);
  return offer.creation;
}

function after(project: Project, { edit }: Creation): Project {
  const store = new DocumentStore(project);
  store.edit(edit);
  return store.project;
}

/** A cube whose six faces are Coons patches. */
const coonsCube = (): Project => {
  const cube = cubeProject();
  return { ...cube, patches: cube.patches.map((patch) => ({ ...patch, type: "coons" as const })) };
};

describe("offerSmooth", () => {
  it("changes the patches and the lines around them in one step", () => {
    const project = coonsCube();
    const [first] = project.patches;
    if (!first) throw new Error("no patch");
    const store = new DocumentStore(project);
    store.edit(taken(offerSmooth(project, entities("patch", first.id))).edit);
    const around = new Set((first.loops[0] ?? []).map(Math.abs));
    expect(store.project.patches.map(({ type }) => type)).toEqual([
      "gregory",
      "coons",
      "coons",
      "coons",
      "coons",
      "coons",
    ]);
    for (const { id, type } of store.project.lines)
      expect(type).toBe(around.has(id) ? "hermite" : "straight");
    expect(parseProject(store.project).success).toBe(true);
    store.undo();
    expect(store.project).toEqual(project);
  });

  it("refuses planar and smooth patches", () => {
    const project = cubeProject();
    expect(offerSmooth(project, entities("patch", 1)).possible).toBe(false);
    const smooth = after(coonsCube(), taken(offerSmooth(coonsCube(), entities("patch", 1))));
    expect(offerSmooth(smooth, entities("patch", 1)).possible).toBe(false);
  });

  it("leaves parabolas that another patch needs", () => {
    const project = coonsCube();
    const lines = project.lines.map((line, i) =>
      i < 4 ? { ...line, type: "parabolic" as const, points: [...line.points, line.points[0] ?? 1] } : line,
    );
    const patches = project.patches.map((patch, i) =>
      i === 1 ? { ...patch, type: "serendipity" as const } : patch,
    );
    const second = new Set((patches[1]?.loops[0] ?? []).map(Math.abs));
    const changed = after(
      { ...project, lines, patches },
      taken(offerSmooth({ ...project, lines, patches }, entities("patch", 1))),
    );
    for (const line of changed.lines) {
      if (second.has(line.id)) expect(line.type).toBe(lines.find(({ id }) => id === line.id)?.type);
    }
  });
});

describe("offerLoft", () => {
  const rows = (reversed: readonly number[]): Project => {
    const points = [0, 1, 2].flatMap((j) =>
      [0, 1].map((i) => ({ id: 2 * j + i + 1, position: [i, j, j % 2] as const })),
    );
    const lines = [0, 1, 2].map((j) => {
      const ends = [2 * j + 1, 2 * j + 2];
      return { id: j + 1, type: "straight" as const, points: reversed.includes(j) ? ends.reverse() : ends };
    });
    return { ...cubeProject(), points, lines, patches: [], background: { nodes: [], tetrahedra: [] } };
  };

  it("adds the sides, and turns lines that run the other way", () => {
    const made = after(rows([1]), taken(offerLoft(rows([1]), entities("line", 1, 2, 3))));
    expect(made.patches).toEqual([{ id: 1, type: "loft", loops: [[1, 4, -3, -5], [-2]] }]);
    expect(made.lines.slice(3)).toEqual([
      { id: 4, type: "spline", points: [2, 4, 6] },
      { id: 5, type: "spline", points: [1, 3, 5] },
    ]);
    expect(parseProject(made).success).toBe(true);
  });

  it("refuses a single line, closed lines and lines with a common end", () => {
    expect(offerLoft(rows([]), entities("line", 1)).possible).toBe(false);
    expect(offerLoft(cubeProject(), entities("line", 1, 2)).possible).toBe(false);
  });
});

describe("tangents", () => {
  const bent = (): Project => {
    const project = coonsCube();
    const lines = project.lines.map((line, i) =>
      i === 0
        ? {
            ...line,
            type: "hermite" as const,
            startTangent: [1, 0, 0] as const,
            endTangent: [0, 1, 0] as const,
          }
        : line,
    );
    return { ...project, lines };
  };
  const close = (found: readonly number[] | undefined, expected: readonly number[]): void =>
    expected.forEach((x, k) => expect(found?.[k]).toBeCloseTo(x, 12));

  it("turn with a rotation and with copies, and stay in a move", () => {
    const project = bent();
    const turn = rotationAbout([5, 5, 5], [0, 0, 1], 90);
    const options = { label: "turn", join: false };
    const [line] = after(project, taken(offerTransform(project, entities("line", 1), turn, options))).lines;
    close(line?.startTangent, [0, 1, 0]);
    close(line?.endTangent, [-1, 0, 0]);
    const copied = after(project, taken(offerCopies(project, entities("line", 1), [turn], options))).lines.at(
      -1,
    );
    expect(copied?.type).toBe("hermite");
    close(copied?.startTangent, [0, 1, 0]);
  });

  it("are given and removed as steps of undo, and lost with the type", () => {
    const store = new DocumentStore(bent());
    store.edit(setTangent(1, "endTangent", [0, 0, 2]));
    expect(store.project.lines[0]?.endTangent).toEqual([0, 0, 2]);
    store.edit(setTangent(1, "startTangent", null));
    expect(store.project.lines[0]?.startTangent).toBeUndefined();
    store.undo();
    expect(store.project.lines[0]?.startTangent).toEqual([1, 0, 0]);
    store.edit(setLineType(1, "straight"));
    expect(store.project.lines[0]).not.toHaveProperty("endTangent");
  });

  it("stay at the outer ends when the line is split", () => {
    const project = { ...bent(), patches: [] };
    const split = splitLine(project, {
      line: 1,
      position: project.points[0]?.position.map(
        (x, k) => (x + (project.points[1]?.position[k] ?? 0)) / 2,
      ) as [number, number, number],
    });
    if (!split.success) throw new Error(split.reason);
    const [first, second] = split.parts.map((id) => split.project.lines.find((line) => line.id === id));
    expect([first?.startTangent, first?.endTangent]).toEqual([[1, 0, 0], undefined]);
    expect([second?.startTangent, second?.endTangent]).toEqual([undefined, [0, 1, 0]]);
    expect([first?.type, second?.type]).toEqual(["hermite", "hermite"]);
  });
});

describe("curvatureRange", () => {
  const samples = (largest: number[]) => ({
    points: new Float64Array([1, 0, 0]),
    gaussian: Float64Array.from(largest, (x) => -x * x),
    largest: Float64Array.from(largest),
  });

  it("leaves out a few extreme values, and is symmetric for the Gaussian curvature", () => {
    const values = samples([...Array.from({ length: 99 }, (_, i) => i / 99), 1000]);
    expect(curvatureRange(values, "largest")[1]).toBeLessThan(1);
    const [low, high] = curvatureRange(values, "gaussian");
    expect(low).toBe(-high);
  });

  it("takes the rounding of planes as no curvature", () => {
    expect(curvatureRange(samples([1e-12, 2e-12]), "largest")).toEqual([0, 0]);
  });
});
