import { createMesher, type Mesher } from "tetrafront";
import type { Project } from "tetrafront/project";
import { afterAll, beforeAll, expect, it } from "vitest";
import { fixEdit, quickFixOf, type QuickFix } from "../../../web/document/quick-fixes";
import { marginToCover } from "../../../web/document/coverage-margin";
import { toProblems, type Problem } from "../../../web/document/validate";
import { DocumentStore } from "../../../web/session/document-store";
import { cubeProject } from "../../support/projects";

let mesher: Mesher;
beforeAll(async () => {
  mesher = await createMesher();
});
afterAll(() => mesher.dispose());

async function problemsOf(project: Project): Promise<readonly Problem[]> {
  return toProblems(project, (await mesher.previewProject(project)).diagnostics);
}

const codes = (problems: readonly Problem[]): readonly string[] => [
  ...new Set(problems.map(({ code }) => code)),
];

function fixesOf(project: Project, problems: readonly Problem[]): readonly QuickFix[] {
  return problems.flatMap((problem) => quickFixOf(problem, { project, problems }) ?? []);
}

/** A change that damages a project. */
type Damage = (project: Project) => Project;

/** The cube with a point of its own for the first line of the second patch's loop. */
const splitPoint: Damage = (project) => {
  const [first] = project.points;
  const [line] = project.lines;
  if (!first || !line) throw new Error("the cube is empty");
  const id = 100;
  return {
    ...project,
    points: [...project.points, { id, position: first.position }],
    lines: project.lines.map((one) =>
      one === line ? { ...one, points: one.points.map((point) => (point === first.id ? id : point)) } : one,
    ),
  };
};

const repeatLine: Damage = (project) => {
  const [line] = project.lines;
  if (!line) throw new Error("the cube has no lines");
  const copy = { ...line, id: 100, points: line.points.toReversed() };
  const [user] = project.patches.filter(({ loops }) => loops.flat().includes(line.id));
  return {
    ...project,
    lines: [...project.lines, copy],
    patches: project.patches.map((patch) =>
      patch === user
        ? { ...patch, loops: patch.loops.map((loop) => loop.map((step) => (step === line.id ? -100 : step))) }
        : patch,
    ),
  };
};

const reverseStep: Damage = (project) => ({
  ...project,
  patches: project.patches.map((patch, i) =>
    i === 0
      ? { ...patch, loops: patch.loops.map((loop) => loop.map((step, k) => (k === 1 ? -step : step))) }
      : patch,
  ),
});

const withoutPatch: Damage = (project) => ({ ...project, patches: project.patches.slice(1) });

const flatTetrahedron: Damage = ({ background, ...project }) => {
  const [node] = background.nodes;
  if (!node) throw new Error("the cube has no background grid");
  const extra = [1, 2, 3].map((x) => ({
    ...node,
    id: 100 + x,
    position: [node.position[0] + x, node.position[1] + x * x, node.position[2]] as [number, number, number],
  }));
  return {
    ...project,
    background: {
      ...background,
      nodes: [...background.nodes, ...extra],
      tetrahedra: [...background.tetrahedra, [node.id, 101, 102, 103]],
    },
  };
};

it.each<[code: string, damage: Damage]>([
  ["duplicate-points", splitPoint],
  ["duplicate-lines", repeatLine],
  ["loop-not-closed", reverseStep],
  ["open-edge", withoutPatch],
  ["degenerate-background-tetrahedron", flatTetrahedron],
])("fixes %s in one step, which undo takes back", async (code, damage) => {
  const damaged = damage(cubeProject());
  const documents = new DocumentStore(damaged);
  const problems = await problemsOf(damaged);
  expect(codes(problems)).toContain(code);
  const fixes = fixesOf(
    damaged,
    problems.filter((problem) => problem.code === code),
  );
  expect(fixes.length).toBeGreaterThan(0);
  for (const { effect } of fixes) expect(effect).toMatch(/^[A-Z].*\.$/);
  const edit = fixEdit(damaged, "fix", fixes);
  if (!edit) throw new Error("the fixes change nothing");
  documents.edit(edit);
  expect(codes(await problemsOf(documents.project))).toEqual([]);
  documents.undo();
  expect(documents.project).toEqual(damaged);
  // Fixes of a project that needs none change nothing.
  const again = fixes.reduce((project, fix) => fix.apply(project), cubeProject());
  expect(again.patches.length).toBe(cubeProject().patches.length);
});

it("offers a covering grid if there is none, and no fix where the user must decide", async () => {
  const project = { ...cubeProject(), background: { nodes: [], tetrahedra: [] } };
  const problems = await problemsOf(project);
  expect(codes(problems)).toContain("empty-background-grid");
  expect(fixesOf(project, problems).map(({ cover }) => cover)).toEqual([{ kind: "replace", size: 0.05 }]);
  const bent = cubeProject();
  const moved = {
    ...bent,
    points: bent.points.map((point, i) =>
      i === 0
        ? { ...point, position: point.position.map((x) => x - 0.2) as [number, number, number] }
        : point,
    ),
  };
  const found = await problemsOf(moved);
  expect(codes(found)).toContain("not-planar");
  expect(
    fixesOf(
      moved,
      found.filter(({ code }) => code === "not-planar"),
    ),
  ).toEqual([]);
});

it("enlarges a grid of one size, and extends other ones by a margin, if the model has grown out of it", async () => {
  const cube = cubeProject();
  const covered: Project = { ...cube, background: await mesher.coverProject(cube, { size: 0.37 }) };
  expect(await problemsOf(covered)).toEqual([]);
  const tripled = ({ position }: Project["points"][number]): [number, number, number] => [
    3 * position[0],
    3 * position[1],
    3 * position[2],
  ];
  const grown = {
    ...covered,
    points: covered.points.map((point) => ({ ...point, position: tripled(point) })),
  };
  const problems = await problemsOf(grown);
  expect(codes(problems)).toEqual(["outside-background-grid"]);
  const [fix, ...others] = fixesOf(grown, problems);
  expect(others.every(({ effect }) => effect === fix?.effect)).toBe(true);
  expect(fix?.cover).toEqual({ kind: "replace", size: 0.37 });
  const background = await mesher.coverProject(grown, { size: 0.37 });
  expect(await problemsOf({ ...grown, background })).toEqual([]);
  for (const change of [{ size: 0.38 }, { stretching: 2, direction: [1, 0, 0] as const }]) {
    const [first, ...rest] = grown.background.nodes;
    if (!first) throw new Error("the grid has no nodes");
    const graded = {
      ...grown,
      background: { ...grown.background, nodes: [{ ...first, ...change }, ...rest] },
    };
    const [extension] = fixesOf(graded, problems);
    expect(extension?.cover).toEqual({ kind: "extend" });
    const { nodes } = await mesher.coverProject(grown, { size: 1 });
    const coverageMargin = await marginToCover(
      graded.background,
      nodes.map(({ position }) => position),
    );
    expect(await problemsOf({ ...graded, background: { ...graded.background, coverageMargin } })).toEqual([]);
  }
});

it("extends a graded grid without a change of the sizes inside", async () => {
  const cube = cubeProject();
  const { nodes, ...grid } = await mesher.coverProject(cube, { size: 0.37 });
  const background = {
    ...grid,
    nodes: nodes.map((node) => ({ ...node, size: 0.1 + 0.2 * Math.abs(node.position[0]) })),
  };
  const far: [number, number, number] = [9, -4, 30];
  const coverageMargin = await marginToCover(background, [far, [0, 0, 0]]);
  const positions = Float64Array.of(0.5, 0.5, 0.5, 0.1, 0.9, 0.3, ...far);
  const sizesIn = async (given: Project["background"]) => [
    ...(await mesher.sampleSizes({ ...cube, background: given }, positions)).sizes,
  ];
  const [a = 0, b = 0, outside = 0] = await sizesIn({ ...background, coverageMargin });
  expect([a, b]).toEqual((await sizesIn(background)).slice(0, 2));
  expect(Math.abs(a - b)).toBeGreaterThan(0.05);
  // Outside, the sizes are those of the grid's nearest place.
  const sizes = background.nodes.map(({ size }) => size);
  expect(outside).toBeGreaterThanOrEqual(Math.min(...sizes) - 1e-12);
  expect(outside).toBeLessThanOrEqual(Math.max(...sizes) + 1e-12);
  expect(await marginToCover({ nodes: [], tetrahedra: [] }, [far])).toBe(0);
});

/** A cube with a square bore, without the patch at the top. */
function boredCube(): Project {
  const id = (ring: number, level: number, corner: number): number => 1 + 8 * ring + 4 * level + (corner % 4);
  const rings = [
    [0, 1],
    [0.25, 0.75],
  ] as const;
  const corners = [
    [0, 0],
    [1, 0],
    [1, 1],
    [0, 1],
  ] as const;
  const points = rings.flatMap((range, ring) =>
    [0, 1].flatMap((level) =>
      corners.map(([x, y], corner) => ({
        id: id(ring, level, corner),
        position: [range[x], range[y], level] as [number, number, number],
      })),
    ),
  );
  const lines: { id: number; type: "straight"; points: [number, number] }[] = [];
  const step = (from: number, to: number): number => {
    const known = lines.find(({ points: ends }) => ends.includes(from) && ends.includes(to));
    if (known) return known.points[0] === from ? known.id : -known.id;
    lines.push({ id: lines.length + 1, type: "straight", points: [from, to] });
    return lines.length;
  };
  const walls = [0, 1].flatMap((ring) =>
    [0, 1, 2, 3].map((k) => {
      const around = [id(ring, 0, k), id(ring, 0, k + 1), id(ring, 1, k + 1), id(ring, 1, k)];
      return [around.map((from, i) => step(from, around[(i + 1) % 4] ?? 0))];
    }),
  );
  const bottom = [0, 1].map((ring) => [0, 1, 2, 3].map((k) => step(id(ring, 0, k), id(ring, 0, k + 1))));
  const patches = [...walls, bottom].map((loops, i) => ({ id: i + 1, type: "planar" as const, loops }));
  return { ...cubeProject(), points, lines, patches };
}

it("closes a bored cube around the bore, whichever of its lines is asked, and all at once", async () => {
  const project = boredCube();
  const problems = await problemsOf(project);
  expect(codes(problems)).toEqual(["open-edge"]);
  const fixes = fixesOf(project, problems);
  expect(fixes.length).toBeGreaterThan(0);
  for (const fix of fixes) {
    const closed = fix.apply(project);
    expect(closed.patches.at(-1)?.loops.map((loop) => loop.length)).toEqual([4, 4]);
    expect(codes(await problemsOf(closed))).toEqual([]);
  }
  const all = fixes.reduce((current, fix) => fix.apply(current), project);
  expect(all.patches).toHaveLength(10);
  expect(codes(await problemsOf(all))).toEqual([]);
});

/** A project with two circles, one above the other, and a tube between them. */
function openTube(): Project {
  const ids = [1, 2, 3, 4, 5, 6] as const;
  const points = ids.map((id, i) => {
    const [radius, turn] = [i < 3 ? 0.5 : 0.3, (2 * Math.PI * i) / 3];
    const position = [radius * Math.cos(turn), radius * Math.sin(turn), i < 3 ? 0 : 1] as const;
    return { id, position };
  });
  const lines = [
    { id: 1, type: "circle" as const, points: [1, 2, 3, 1] },
    { id: 2, type: "circle" as const, points: [4, 5, 6, 4] },
  ];
  return { ...cubeProject(), points, lines, patches: [{ id: 1, type: "tube", loops: [[1], [2]] }] };
}

it("closes a tube at both ends, and a dome of one curved patch: they begin at the lines that are open", async () => {
  const closed = async (project: Project): Promise<[Project, readonly string[]]> => {
    const problems = (await problemsOf(project)).filter(({ code }) => code === "open-edge");
    const fixes = fixesOf(project, problems);
    const documents = new DocumentStore(project);
    const edit = fixEdit(project, "fix", fixes);
    if (edit) documents.edit(edit);
    return [documents.project, fixes.map(({ effect }) => effect)];
  };
  const [tube, effects] = await closed(openTube());
  expect(effects).toEqual(["Adds a planar patch within line 1.", "Adds a planar patch within line 2."]);
  expect(tube.patches.map(({ type, loops }) => `${type} ${loops.join()}`)).toEqual([
    "tube 1,2",
    "planar 1",
    "planar 2",
  ]);
  expect(codes(await problemsOf(tube))).not.toContain("open-edge");
  // Each of the four lines asks for the same patch.
  const cube = cubeProject();
  const patches = cube.patches.slice(0, 1).map((patch) => ({ ...patch, type: "coons" as const }));
  const [dome] = await closed({ ...cube, patches });
  expect(dome.patches.map(({ type }) => type)).toEqual(["coons", "planar"]);
});

it("joins only the two lines that it names; all fixes join all", async () => {
  const cube = cubeProject();
  const [first, second] = cube.lines;
  if (!first || !second) throw new Error("the cube has no lines");
  const copies = [
    { ...first, id: 100 },
    { ...first, id: 101 },
    { ...second, id: 102 },
  ];
  const project: Project = { ...cube, lines: [...cube.lines, ...copies] };
  const problems = (await problemsOf(project)).filter(({ code }) => code === "duplicate-lines");
  const fixes = fixesOf(project, problems);
  expect(fixes).toHaveLength(3);
  for (const fix of fixes) expect(fix.apply(project).lines).toHaveLength(project.lines.length - 1);
  const all = fixes.reduce((current, fix) => fix.apply(current), project);
  expect(all.lines).toEqual(cube.lines);
});

it("reads the nodes of a grid once, however many problems ask and however often", () => {
  let reads = 0;
  const cube = cubeProject();
  const nodes = cube.background.nodes.map(({ size, ...node }) => ({
    ...node,
    get size() {
      ++reads;
      return size;
    },
  }));
  const project: Project = { ...cube, background: { ...cube.background, nodes } };
  const problem = { code: "outside-background-grid", entities: [], body: null } as unknown as Problem;
  const problems = Array.from({ length: 100 }, () => problem);
  const sizes = fixesOf(project, problems).map(({ cover }) =>
    cover?.kind === "replace" ? cover.size : null,
  );
  expect(new Set(sizes)).toEqual(new Set([cube.background.nodes[0]?.size]));
  expect(fixesOf({ ...project, name: "Copy" }, problems)).toHaveLength(100);
  expect(reads).toBeLessThanOrEqual(2 * nodes.length);
});
