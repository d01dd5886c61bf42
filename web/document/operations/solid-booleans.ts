import type { Project, SolidFeature } from "tetrafront/project";
import { operationStrings } from "../../strings";
import { booleanKinds, type BooleanKind } from "../booleans/kinds";
import type { Offer } from "../create";
import { bodiesOf } from "../entities";
import { expressionsOfFeature, typed, type Typed } from "./feature-numbers";
import type { FieldSpec, Operation } from "./operation";
import {
  addedFeature,
  editOf,
  withoutPlacement,
  type FeatureOperation,
  type NewFeature,
  type Solid,
} from "./solids";

const texts = operationStrings.booleans;

const uses = { union: "join", difference: "cut", intersection: "intersect" } as const;

type Values = { readonly kind: BooleanKind; readonly swap: boolean };

const kindField: FieldSpec = {
  kind: "choice",
  key: "kind",
  label: texts.kind,
  choices: booleanKinds.map((value) => ({ value, label: texts.kinds[value] })),
};

const panel = {
  id: "boolean",
  title: texts.title,
  step: texts.title,
  action: operationStrings.apply,
  usesSelection: false,
  make: (): Offer => ({ possible: false, reason: texts.open }),
} as const;

/** Returns the operation that makes one solid a feature of another. They are those of the project when it is opened. */
export function solidBoolean(solids: readonly [Solid, Solid], kind: BooleanKind): Operation<Values> {
  return {
    ...panel,
    step: texts.steps[kind],
    initial: () => ({ kind, swap: false }),
    fields: (values) => [
      kindField,
      ...(values.kind === "difference" ? [{ kind: "switch", key: "swap", label: texts.swap } as const] : []),
    ],
    note: () => texts.solids,
    makeLater: ({ project }, values, maker) => {
      const [first, second] = solids;
      const [solid, tool] = values.swap && values.kind === "difference" ? [second, first] : [first, second];
      const feature = booleanFeature(project, tool, uses[values.kind]);
      const without = { ...project, bodies: bodiesOf(project).filter(({ id }) => id !== tool.id) };
      return addedFeature({ project: without, solids: maker, solid }, feature, texts.steps[values.kind]);
    },
  };
}

/** Returns the feature of the features of another solid, with their expressions. */
function booleanFeature(
  project: Project,
  solid: Solid,
  operation: (typeof uses)[BooleanKind],
): Typed<NewFeature> {
  const tool = withoutPlacement(solid).features.map((feature) =>
    typed<SolidFeature>(feature, expressionsOfFeature(project, solid.id, feature.id)),
  );
  return { type: "boolean", operation, tool };
}

type Whole = Extract<SolidFeature, { readonly type: "boolean" | "import" | "sew" }>;

/** Changes what the solid of a file, or with features of its own, does to the solid before it. */
export const editBoolean: Pick<FeatureOperation, "edit"> = {
  edit: (solid, feature, expressions = {}) => {
    if (feature.type !== "boolean" && feature.type !== "import" && feature.type !== "sew") return null;
    const kind = booleanKinds.find((one) => uses[one] === feature.operation);
    if (solid.features[0]?.id === feature.id || !kind) return null;
    const given = typed<Whole>(feature, expressions);
    return editOf<Pick<Values, "kind">>({
      operation: { ...panel, initial: () => ({ kind }), fields: () => [kindField] },
      noun: texts.noun,
      solid,
      feature,
      values: { kind },
      made: (values) => ({ ...given, operation: uses[values.kind] }),
    });
  },
};
