import { createMesher, type Mesher, type Project } from "tetrafront";
import { afterAll, beforeAll, expect, it } from "vitest";
import { fixEdit, quickFixOf, type QuickFix } from "../../../web/document/quick-fixes";
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
  expect(fixesOf(project, problems).map(({ coversModel }) => coversModel)).toEqual([true]);
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
