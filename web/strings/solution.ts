/** Texts of the panel that shows fields, solves problems and adapts meshes. Loaded with it. */
import { formatCount, formatCounted } from "./format";

/** Returns a number with at most three digits; small ones with a power of ten: 0.0012, 1.2e-5. */
function short(value: number): string {
  const rounded = Number(value.toPrecision(3));
  if (rounded === 0 || Math.abs(rounded) >= 1e-3) return String(rounded);
  const [digits = "", power = ""] = rounded.toExponential().split("e");
  return `${digits}e${power}`;
}

const firstMesh = "First mesh";

export const solutionStrings = {
  title: "Solution",
  intro:
    "Solve an example problem on the mesh of this model, or open a mesh file with values at its nodes or of its elements.",
  problem: "Problem",
  kind: "Kind",
  kinds: {
    heat: "Heat conduction",
    elasticity: "Elasticity",
    advection: "Advection and diffusion",
  },
  conductivity: "Conductivity",
  diffusivity: "Diffusivity",
  velocity: "Velocity",
  source: "Source",
  sourceHint: "Per unit of volume. All units are yours, but they must fit together.",
  youngsModulus: "Young’s modulus",
  poissonRatio: "Poisson’s ratio",
  poissonRange: "Above −1 and below 0.5",
  conditions: "Conditions",
  noConditions: {
    heat: "Give at least one patch a temperature. Patches without a condition are insulated.",
    elasticity: "Fix at least one patch. Patches without a condition are free.",
    advection: "Give at least one patch a concentration. Patches without a condition have no diffusive flux.",
  },
  add: "Add a condition on…",
  addLabel: "Add a condition on a patch",
  remove: (patch: string) => `Remove the condition on ${patch}`,
  conditionOn: (patch: string) => `Condition on ${patch}`,
  valueOn: (patch: string) => `Value on ${patch}`,
  tractionOn: (patch: string) => `Traction on ${patch}`,
  conditionKinds: {
    heat: { value: "Temperature", flux: "Inward heat flux", fixed: "", traction: "" },
    advection: { value: "Concentration", flux: "Inward flux", fixed: "", traction: "" },
    elasticity: { value: "", flux: "", fixed: "Fixed", traction: "Traction" },
  },
  solve: "Solve",
  cycles: "Cycles",
  cyclesHint: "Each cycle adapts the mesh to the solution, then solves again.",
  elements: "Elements at the end",
  run: (cycles: number) => `Run ${formatCounted(cycles, "cycle")}`,
  wholeCycles: "A whole number from 1 to 20",
  wholeElements: "A whole number from 100 to 2,000,000",
  solving: "Solving",
  sizing: "Computing sizes",
  adapting: "Adapting the mesh",
  transferring: "Transferring the fields",
  ofCycle: (text: string, cycle: number, cycles: number) =>
    `${cycle === 0 ? firstMesh : `Cycle ${cycle} of ${cycles}`}: ${text.toLowerCase()}`,
  field: "Field",
  noField: "None",
  ofElements: (name: string) => `${name} (elements)`,
  component: "Component",
  magnitude: "Magnitude",
  axes: ["x", "y", "z"],
  number: (index: number) => String(index + 1),
  lines: "Lines of equal value",
  isosurface: "Isosurface",
  isosurfaceAt: "Value of the isosurface",
  arrows: "Arrows",
  deformed: "Deformed",
  deformedBy: (factor: number) => `Deformed × ${short(factor)}`,
  choice: (name: string, component: string) => `${name}, ${component}`,
  adapt: "Adapt to this field…",
  adaptTitle: "Adapt the mesh to a field",
  adaptHint:
    "Elements become small where the field bends, and thin across its layers. The fields are transferred to the new mesh.",
  target: "Target",
  targets: { elements: "Number of elements", error: "Error" },
  count: "Elements",
  error: "Error",
  norm: "Norm",
  norms: { l1: "L1", l2: "L2", l4: "L4", max: "Maximum" },
  forecast: (elements: number, error: number) =>
    `About ${formatCount(Number(elements.toPrecision(2)))} elements, expected error ${short(error)}`,
  counting: "Counting…",
  apply: "Adapt",
  cancel: "Cancel",
  cycle: (index: number) => (index === 0 ? firstMesh : `Cycle ${index}`),
  columns: ["Mesh", "Elements", "Error", "Least quality"],
  errorMeaning:
    "Estimated interpolation error of the first field, in the L2 norm, from its second derivatives on the elements of the mesh.",
  qualityMeaning:
    "Least mean ratio of the elements in the metric that the mesh was made for: 1 for an element that is regular there.",
  previous: "Previous mesh",
  next: "Next mesh",
  error3: short,
  chart: "Estimated error over the number of elements, both logarithmic",
  chartPoint: (mesh: string, elements: string, error: string) =>
    `${mesh}: ${elements} elements, error ${error}`,
  noMesh: "There is no complete mesh of the model. See the problems below the view, then generate a mesh.",
  failures: {
    "no-elements": "The mesh has no tetrahedra. Generate a mesh first.",
    "not-held":
      "The problem has no unique solution: a part of the mesh has no given value. Add a condition with a value, or fix a patch.",
    "bad-material":
      "The material is invalid. Conductivity, diffusivity and Young’s modulus must be above 0, Poisson’s ratio above −1 and below 0.5.",
    "not-converged": "The iterative solver did not converge. Improve the mesh.",
  },
  advectionNotConverged: "The iterative solver did not converge. Improve the mesh, or raise the diffusivity.",
} as const;
