/** Examples that are solved at once: a model, a problem on it, and cycles. Loaded when one is opened. */
import type { Project } from "tetrafront/project";
import type { App } from "../app/app";
import { emptyProject } from "../document/create";
import { insertion, withInsertion } from "../document/insert-shape";
import { ShapeBuilder, type Shape } from "../document/shape";
import { loadModel } from "../session/gallery";
import {
  defaultCondition,
  defaultSetup,
  problemWith,
  type PatchCondition,
  type ProblemSetup,
} from "../session/problem-setup";
import { fieldNames, type Vector } from "../solve/problem";
import { solvedExamples, strings, type SolvedExample } from "../strings";
import { openProject } from "./project-actions";
import { solveInCycles } from "./solution-actions";

interface Example {
  readonly project: (app: App) => Promise<Project>;
  readonly setup: ProblemSetup;
  /** The field that is shown. */
  readonly field: string;
  readonly elements: number;
}

const cycles = 5;

const examples: Readonly<Record<SolvedExample, Example>> = {
  "l-shape": {
    project: () => Promise.resolve(lShapedProject()),
    setup: {
      ...defaultSetup,
      kind: "heat",
      conditions: [
        { ...defaultCondition("heat", "hot end"), value: 100 },
        { ...defaultCondition("heat", "cold end"), value: 0 },
        { ...defaultCondition("heat", "bottom"), kind: "flux", value: -5 },
      ],
    },
    field: fieldNames.heat[0],
    elements: 12_000,
  },
  bracket: {
    project: coarseBracket,
    setup: {
      ...defaultSetup,
      kind: "elasticity",
      conditions: [
        ...aroundBore("upright bore", fixed),
        ...aroundBore("base bore 1", pulled([0, 0, -2])),
        ...aroundBore("base bore 2", pulled([0, 0, -2])),
      ],
    },
    field: fieldNames.elasticity[1],
    elements: 12_000,
  },
};

/** Opens an example as a new document, meshes it, and solves it in cycles, which the panel lists. Rejects if it cannot be opened. */
export async function openSolvedExample(app: App, name: SolvedExample): Promise<void> {
  const { project, setup, field, elements } = examples[name];
  const model = await project(app);
  openProject(app, { ...model, problem: problemWith(setup, model) });
  app.solutions.choose({ name: field, component: 0, label: field });
  app.view.setLayer("mesh", true);
  app.shell.setState({ rightTab: "solution", drawer: "right" });
  await solveInCycles(app, { cycles, elements, norm: "l2" });
}

/** An L of three squares with sides of 1, seen from above, counter-clockwise; each side with the name of its patch. */
const outline: readonly (readonly [x: number, y: number, patch: string])[] = [
  [0, 0, "hot end"],
  [1, 0, "inner right"],
  [1, 1, "inner front"],
  [2, 1, "cold end"],
  [2, 2, "back"],
  [0, 2, "left"],
];

function lShapedProject(): Project {
  const project = { ...emptyProject(solvedExamples["l-shape"].title), meshing: { size: 0.25 } };
  return { ...project, ...withInsertion(project, insertion(project, prism(0.5), { join: false })) };
}

/** Returns the prism over the outline, with all loops counter-clockwise from outside. */
function prism(height: number): Shape {
  const builder = new ShapeBuilder();
  const [low, high] = [0, height].map((z) => outline.map(([x, y]) => builder.point([x, y, z]))) as [
    number[],
    number[],
  ];
  builder.patch("planar", [builder.polygon(low.toReversed())], "bottom");
  builder.patch("planar", [builder.polygon(high)], "top");
  outline.forEach(([, , name], i) => {
    const next = (i + 1) % outline.length;
    const corners = [low[i] ?? 0, low[next] ?? 0, high[next] ?? 0, high[i] ?? 0];
    builder.patch("planar", [builder.polygon(corners)], name);
  });
  return builder.shape;
}

/** Element size of the bracket before the first cycle. */
const bracketSize = 0.2;

/** Returns the bracket of the gallery with one size: the cycles find where it must be smaller. */
async function coarseBracket({ gallery }: App): Promise<Project> {
  const model = gallery.models.find(({ id }) => id === "bracket");
  if (!model) throw new Error(strings.messages.knownExamples(gallery.models.map(({ id }) => id)));
  const project = await loadModel(model);
  return {
    ...project,
    name: solvedExamples.bracket.title,
    background: { ...project.background, sources: [] },
    meshing: { ...project.meshing, size: bracketSize },
  };
}

type ConditionOf = (patch: string) => PatchCondition;

function fixed(patch: string): PatchCondition {
  return defaultCondition("elasticity", patch);
}

function pulled(traction: Vector): ConditionOf {
  return (patch) => ({ ...defaultCondition("elasticity", patch), kind: "traction", traction });
}

/** Returns the conditions of the four patches of a bore. */
function aroundBore(bore: string, conditionOf: ConditionOf): readonly PatchCondition[] {
  return ["right", "top", "left", "bottom"].map((side) => conditionOf(`${bore} ${side}`));
}
