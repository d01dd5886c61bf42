import { formatCounted } from "./format";
import { LIMITS } from "tetrafront";

const nodesOf = (ids: readonly number[]): string =>
  ids.length === 1 ? `background node ${ids[0]}` : formatCounted(ids.length, "background node");

/** Names of the steps of undo: verb and object. */
export const stepNames = {
  change: (noun: string) => `Change ${noun}`,
  move: (entity: string) => `Move ${entity}`,
  rotate: (entity: string) => `Rotate ${entity}`,
  scale: (entity: string) => `Scale ${entity}`,
  rename: (entity: string) => `Rename ${entity}`,
  renameProject: "Rename project",
  setProblem: "Change problem",
  setTangent: (id: number) => `Change tangent of line ${id}`,
  smooth: (count: number) => (count === 1 ? "Make patch smooth" : `Make ${count} patches smooth`),
  setLineType: (id: number) => `Change type of line ${id}`,
  setLinePoints: (id: number) => `Change points of line ${id}`,
  splitLine: (id: number) => `Split line ${id}`,
  setPatchType: (id: number) => `Change type of patch ${id}`,
  setPatchLoops: (id: number) => `Change loops of patch ${id}`,
  setNode: (field: "size" | "stretching" | "second stretching", id: number) =>
    `Set ${field} of background node ${id}`,
  setDirections: {
    direction: (ids: readonly number[]) => `Set direction of ${nodesOf(ids)}`,
    secondDirection: (ids: readonly number[]) => `Set second direction of ${nodesOf(ids)}`,
  },
  setSource: (field: "size" | "distance" | "growth", id: number) => `Set ${field} of source ${id}`,
  setNodeShape: (id: number) => `Shape background node ${id}`,
  setSourceShape: (id: number) => `Shape source ${id}`,
  splitTetrahedra: (count: number) =>
    `Split ${count} background ${count === 1 ? "tetrahedron" : "tetrahedra"}`,
  setMeshing: {
    size: "Set uniform size",
    elements: "Set number of elements",
    gradation: "Set gradation",
    innerShells: "Set inner shells",
    order: "Set front order",
    optimization: "Set optimization",
    interior: "Set interior",
  },
  setUnits: "Set length unit",
  convertUnits: (from: string, to: string) => `Convert lengths from ${from} to ${to}`,
  removeElements: "Mesh with the given sizes",
  removeUniformSize: "Use sizes of background grid",
  refineSizes: "Make all sizes finer",
  coarsenSizes: "Make all sizes coarser",
  entities: (count: number) => `${count} entities`,
  delete: (subject: string, dependents: number) =>
    dependents === 0
      ? `Delete ${subject}`
      : `Delete ${subject} and ${dependents} dependent ${dependents === 1 ? "entity" : "entities"}`,
  add: (entity: string) => `Add ${entity}`,
  addPoints: (count: number) => `Add ${count} points`,
  addLines: (count: number) => `Add ${count} lines`,
  addHole: (patch: string) => `Add hole to ${patch}`,
  addTetrahedron: "Add background tetrahedron",
  addParameter: (name: string) => `Add parameter ${name}`,
  setParameter: (name: string) => `Set parameter ${name}`,
  renameParameter: (name: string) => `Rename parameter ${name}`,
  removeParameter: (name: string) => `Remove parameter ${name}`,
  addGroup: (name: string) => `Add ${name.toLowerCase()}`,
  renameGroup: (name: string) => `Rename group ${name}`,
  colorGroup: (name: string) => `Set colour of group ${name}`,
  extendGroup: (name: string) => `Add to group ${name}`,
  reduceGroup: (name: string) => `Take out of group ${name}`,
  removeGroup: (name: string) => `Remove group ${name}`,
  setCommon: {
    "position.0": (count: number) => `Set x of ${formatCounted(count, "entity", "entities")}`,
    "position.1": (count: number) => `Set y of ${formatCounted(count, "entity", "entities")}`,
    "position.2": (count: number) => `Set z of ${formatCounted(count, "entity", "entities")}`,
    size: (count: number) => `Set size of ${formatCounted(count, "entity", "entities")}`,
    stretching: (count: number) => `Set stretching of ${formatCounted(count, "entity", "entities")}`,
    secondStretching: (count: number) =>
      `Set second stretching of ${formatCounted(count, "entity", "entities")}`,
    distance: (count: number) => `Set distance of ${formatCounted(count, "entity", "entities")}`,
    growth: (count: number) => `Set growth of ${formatCounted(count, "entity", "entities")}`,
    "placement.scale": (count: number) => `Scale ${formatCounted(count, "body", "bodies")}`,
    "remeshing.size": (count: number) => `Set size of ${formatCounted(count, "body", "bodies")}`,
    "remeshing.tolerance": (count: number) => `Set tolerance of ${formatCounted(count, "body", "bodies")}`,
  },
  setCommonType: (count: number, kind: "lines" | "patches") => `Change type of ${count} ${kind}`,
  paintSize: "Paint size",
  improve: "Improve mesh",
  adapt: "Adapt mesh",
  generate: "Generate mesh",
} as const;

/** Why nothing can be created from the selection: what to select instead. */
export const selectionHints = {
  replacesUniform: "The background grid now gives the sizes, instead of the uniform size.",
  closedSpline: "Select at least three points, in order.",
  straightLine: "Select two points, or more for a chain.",
  parabola: "Select three points: start, middle, end.",
  arc: "Select three points: start, a point between, end.",
  circle: "Select three points of the circle.",
  spline: "Select at least three points, in order.",
  loop: "Select the lines around the patch.",
  smooth: "Select patches with three or four lines that are not smooth yet.",
  loft: "Select at least two open lines, in order: each after the one beside it.",
  shared: "Two of the lines have a common end.",
  hole: "Select one patch and the lines around the hole.",
  tetrahedron: "Select four nodes of the background grid.",
  flatTetrahedron: "The four nodes lie in one plane.",
  split: "Select two, three or four nodes of one tetrahedron of the background grid.",
  sameTetrahedron: "The background grid already has this tetrahedron.",
  source: (positions: number) =>
    positions === 1
      ? "Select one point or background node."
      : `Select ${positions} points or background nodes, or lines that have ${positions} ends together.`,
} as const;

/** Why a line cannot be split. */
export const lineSplitStrings = {
  noLine: "Select one line, or one line and a point on it.",
  atEnd: "The line ends there already.",
  pointAway: "The selected point does not lie on the line.",
  misfit: (patch: string, misfit: string) => `${patch} needs the line as it is. ${misfit}`,
} as const;

/** Why lines do not form loops. */
export const loopDefects = {
  open: (point: number) => `The lines do not close: only one of them ends at point ${point}.`,
  branching: (point: number, lines: number) =>
    `${lines} of the lines end at point ${point}; in a loop, exactly two lines end at each point.`,
} as const;

const countWords: Readonly<Record<number, string>> = { 2: "two", 3: "three", 4: "four" };

/** Why loops cannot bound a patch of a type. */
export const patchMisfits = {
  lineCount: (needed: number, found: number) =>
    `Needs ${countWords[needed] ?? needed} lines; found ${found === 1 ? "1 line" : `${found} lines`}.`,
  loopCount: (needed: number, found: number) =>
    `Needs ${countWords[needed] ?? needed} loops; found ${found === 1 ? "1 loop" : `${found} loops`}.`,
  lineType: (line: string) => `Needs parabolic lines; ${line} has another type.`,
} as const;

/** Why a parameter cannot have a name or an expression. */
export const parameterProblems = {
  name: "Use letters, digits and underscores, and begin with a letter",
  reserved: (name: string) => `"${name}" is a function or a constant`,
  taken: (name: string) => `There is already a parameter ${name}`,
  longer: (name: string) => `With ${name}, an expression has more than ${LIMITS.expression} characters`,
  expression: "Enter a number or a formula, such as 2*r",
  unknown: (name: string) => `There is no parameter ${name}`,
  cycle: (name: string) => `Uses ${name} itself`,
} as const;

/** Name of a new group. */
export const groupName = (id: number): string => `Group ${id}`;

/** Name of a new project. */
export const untitled = "Untitled";
