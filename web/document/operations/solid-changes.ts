import type { SolidFeature } from "tetrafront/project";
import { operationStrings, stepNames } from "../../strings";
import type { Position } from "../position";
import { pieceExtent } from "./sizes";
import { valueOf } from "../../expressions/quantity";
import { typed, type Typed } from "./feature-numbers";
import { positiveLength, wholeNumber } from "./number-specs";
import type { FieldExpressions, FieldSpec, FieldValues, Operation, SolidMaker, Subject } from "./operation";
import { addedFeature, editOf, solidIn, type FeatureOperation, type NewFeature, type Solid } from "./solids";
import { holeStart, startOf } from "./start";

const texts = operationStrings.solids;

/** What the selection says about the solid before the feature. */
interface Chosen {
  /** Origins of the selected patches of the solid. */
  readonly faces: readonly string[];
  /** Names of the edges that the selected patches mean, or all. */
  edges(): Promise<readonly string[]>;
}

/** What distinguishes a kind of feature that changes a solid. */
interface ChangeKind<Values extends FieldValues> {
  readonly id: string;
  readonly noun: string;
  readonly title: string;
  initial(subject: Subject, solid: Solid | undefined): Values;
  fields(values: Values): readonly FieldSpec[];
  /** Whether selected patches choose where it is. */
  readonly usesSelection: boolean;
  readonly note?: string;
  /** Returns the feature; `before` is the one that is edited, which keeps what was chosen for it. */
  feature(
    values: Typed<Values>,
    chosen: Chosen,
    before: SolidFeature | null,
  ): Promise<Typed<NewFeature>> | Typed<NewFeature>;
  /** Returns the values of such a feature; null for another kind. */
  read(feature: Typed<SolidFeature>): Typed<Values> | null;
}

function changeOperation<Values extends FieldValues>(kind: ChangeKind<Values>): FeatureOperation<Values> {
  const step = stepNames.add(kind.noun);
  const operation: Operation<Values> = {
    id: `solid-${kind.id}`,
    title: kind.title,
    step,
    action: operationStrings.create,
    usesSelection: kind.usesSelection,
    initial: (subject) => kind.initial(subject, solidIn(subject)),
    fields: (values) => kind.fields(values),
    note: () => kind.note ?? "",
    make: () => ({ possible: false, reason: texts.noSolid }),
    makeLater: (subject, values, solids, expressions = {}) => {
      const solid = solidIn(subject);
      if (!solid) return null;
      const given = kind.feature(typed<Values>(values, expressions), chosenIn(subject, solid, solids), null);
      const change = { project: subject.project, solids, solid };
      return Promise.resolve(given).then((feature) => addedFeature(change, feature, step));
    },
  };
  return {
    ...operation,
    edit: (solid, feature, expressions = {}) => {
      const values = kind.read(typed<SolidFeature>(feature, expressions));
      if (!values) return null;
      const made = (changed: Values, now: FieldExpressions, subject: Subject, solids: SolidMaker) =>
        kind.feature(typed<Values>(changed, now), chosenIn(subject, solid, solids), feature);
      return editOf<Values>({ operation, noun: kind.noun, solid, feature, values, made });
    },
  };
}

function chosenIn({ selection }: Subject, solid: Solid, solids: SolidMaker): Chosen {
  const ids = new Set(selection.filter(({ kind }) => kind === "body-patch").map(({ id }) => id));
  const faces = solid.patches.flatMap(({ id, origin }) =>
    ids.has(id) && origin !== undefined ? [origin] : [],
  );
  return {
    faces,
    edges: async () => {
      const isChosen = new Set(faces);
      const all = await solids.edgesOf(solid.features);
      // The seam of a closed face is not an edge of the shape.
      const real = all.filter(({ faces: [one, other] }) => one !== other);
      if (faces.length === 0 && ids.size > 0) throw new Error(texts.noEdges);
      if (faces.length === 0) return real.map(({ name }) => name);
      const isMeant = ([one, other]: readonly [string, string]): boolean =>
        faces.length === 1
          ? isChosen.has(one) || isChosen.has(other)
          : isChosen.has(one) && isChosen.has(other);
      const meant = real.filter((edge) => isMeant(edge.faces));
      if (meant.length === 0) throw new Error(texts.noEdges);
      return meant.map(({ name }) => name);
    },
  };
}

const share = (part: number) => (subject: Subject, solid: Solid | undefined) =>
  Number((part * (solid ? pieceExtent(subject.project) : 1)).toPrecision(1));

const fillet = changeOperation({
  id: "fillet",
  ...texts.fillet,
  usesSelection: true,
  note: texts.ofFaces,
  initial: (subject, solid) => ({ radius: share(0.1)(subject, solid) }),
  fields: () => [positiveLength("radius", texts.radius)],
  feature: async ({ radius }, chosen, before) => ({
    type: "fillet",
    radius,
    edges: before?.type === "fillet" ? before.edges : await chosen.edges(),
  }),
  read: (feature) => (feature.type === "fillet" ? { radius: feature.radius } : null),
});

const chamfer = changeOperation({
  id: "chamfer",
  ...texts.chamfer,
  usesSelection: true,
  note: texts.ofFaces,
  initial: (subject, solid) => ({ distance: share(0.1)(subject, solid) }),
  fields: () => [positiveLength("distance", texts.distance)],
  feature: async ({ distance }, chosen, before) => ({
    type: "chamfer",
    distance,
    edges: before?.type === "chamfer" ? before.edges : await chosen.edges(),
  }),
  read: (feature) => (feature.type === "chamfer" ? { distance: feature.distance } : null),
});

const shell = changeOperation({
  id: "shell",
  ...texts.shell,
  usesSelection: true,
  note: texts.openFaces,
  initial: (subject, solid) => ({ thickness: share(0.1)(subject, solid) }),
  fields: () => [positiveLength("thickness", texts.thickness)],
  feature: ({ thickness }, { faces }, before) => ({
    type: "shell",
    thickness,
    openFaces: before?.type === "shell" ? before.openFaces : faces,
  }),
  read: (feature) => (feature.type === "shell" ? { thickness: feature.thickness } : null),
});

type HoleValues = {
  readonly position: Position;
  readonly axis: Position;
  readonly diameter: number;
  readonly through: boolean;
  readonly depth: number;
};

const hole = changeOperation<HoleValues>({
  id: "hole",
  ...texts.drilled,
  usesSelection: false,
  initial: (subject, solid) => {
    const { project, selection } = subject;
    const { position, axis } = solid ? holeStart(project, selection, solid) : startOf(project, selection);
    const diameter = share(0.2)(subject, solid);
    const inward: readonly [number, number, number] = [0 - axis[0], 0 - axis[1], 0 - axis[2]];
    return { position, axis: inward, diameter, through: true, depth: 2 * diameter };
  },
  fields: ({ through }) => [
    { kind: "position", key: "position", label: texts.position },
    { kind: "direction", key: "axis", label: texts.axis },
    positiveLength("diameter", texts.diameter),
    { kind: "switch", key: "through", label: texts.through },
    ...(through ? [] : [positiveLength("depth", texts.depth)]),
  ],
  feature: ({ position, axis, diameter, through, depth }) => ({
    type: "hole",
    position,
    axis,
    diameter,
    depth: through ? undefined : depth,
  }),
  read: (feature) => {
    if (feature.type !== "hole") return null;
    const { position, axis, diameter, depth } = feature;
    return { position, axis, diameter, through: depth === undefined, depth: depth ?? 2 * valueOf(diameter) };
  },
});

const linear = changeOperation({
  id: "linear-array",
  ...texts.linear,
  usesSelection: false,
  initial: (subject, solid) => ({
    step: [2 * share(1)(subject, solid), 0, 0] as readonly [number, number, number],
    count: 2,
  }),
  fields: () => [
    { kind: "position", key: "step", label: texts.step },
    wholeNumber("count", texts.count, 2, 100),
  ],
  feature: ({ step, count }) => ({ type: "linear-array", step, count }),
  read: (feature) => (feature.type === "linear-array" ? { step: feature.step, count: feature.count } : null),
});

const zAxis: readonly [number, number, number] = [0, 0, 1];
const origin: readonly [number, number, number] = [0, 0, 0];

const circular = changeOperation({
  id: "circular-array",
  ...texts.circular,
  usesSelection: false,
  initial: () => ({ position: origin, axis: zAxis, angle: 90, count: 4 }),
  fields: () => [
    { kind: "position", key: "position", label: texts.point },
    { kind: "direction", key: "axis", label: texts.axis },
    { kind: "number", key: "angle", label: texts.angle, unit: "degrees" },
    wholeNumber("count", texts.count, 2, 100),
  ],
  feature: (values) => ({ type: "circular-array", ...values }),
  read: (feature) => {
    if (feature.type !== "circular-array") return null;
    const { position, axis, angle, count } = feature;
    return { position, axis, angle, count };
  },
});

type MirrorValues = {
  readonly position: Position;
  readonly normal: Position;
  readonly keepOriginal: boolean;
};

const mirror = changeOperation<MirrorValues>({
  id: "mirror",
  ...texts.mirrored,
  usesSelection: false,
  initial: () => ({
    position: origin,
    normal: [1, 0, 0] as readonly [number, number, number],
    keepOriginal: true,
  }),
  fields: () => [
    { kind: "position", key: "position", label: texts.point },
    { kind: "direction", key: "normal", label: texts.normal },
    { kind: "switch", key: "keepOriginal", label: texts.keepOriginal },
  ],
  feature: (values) => ({ type: "mirror", ...values }),
  read: (feature) => {
    if (feature.type !== "mirror") return null;
    const { position, normal, keepOriginal = false } = feature;
    return { position, normal, keepOriginal };
  },
});

type MoveValues = {
  readonly translation: Position;
  readonly angle: number;
  readonly axis: Position;
  readonly position: Position;
};

const move = changeOperation<MoveValues>({
  id: "move",
  ...texts.moved,
  usesSelection: false,
  initial: () => ({ translation: origin, angle: 0, axis: zAxis, position: origin }),
  fields: ({ angle }) => [
    { kind: "position", key: "translation", label: texts.translation },
    { kind: "number", key: "angle", label: texts.turn, unit: "degrees" },
    ...(angle === 0
      ? []
      : [
          { kind: "direction", key: "axis", label: texts.axisOfTurn } as const,
          { kind: "position", key: "position", label: texts.point } as const,
        ]),
  ],
  feature: ({ translation, angle, axis, position }) => ({
    type: "move",
    translation,
    // An expression that gives 0 stays.
    rotation: angle === 0 ? undefined : { angle, axis, position },
  }),
  read: (feature) => {
    if (feature.type !== "move") return null;
    const { translation = origin, rotation } = feature;
    return { translation, ...(rotation ?? { angle: 0, axis: zAxis, position: origin }) };
  },
});

/** The operations that add a change to a solid, in the order of the menu. */
export const changeOperations: readonly FeatureOperation[] = [
  hole,
  fillet,
  chamfer,
  shell,
  move,
  mirror,
  linear,
  circular,
];
