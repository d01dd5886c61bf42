import type { ManifoldToplevel } from "manifold-3d";
import { operationStrings } from "../../strings";
import { booleanKinds, type BooleanKind } from "../booleans/kinds";
import { isTriangulated, offerBoolean } from "../booleans/offer";
import type { Solid } from "../booleans/solids";
import type { Operation } from "./operation";

const texts = operationStrings.booleans;

type Values = { readonly kind: BooleanKind; readonly swap: boolean };

/** Returns the operation that combines two solids. They are those of the project when the operation is opened. */
export function booleanOperation(
  library: ManifoldToplevel,
  solids: readonly [Solid, Solid],
  kind: BooleanKind,
): Operation<Values> {
  const [first, second] = solids;
  return {
    id: "boolean",
    title: texts.title,
    step: texts.steps[kind],
    action: operationStrings.apply,
    usesSelection: false,
    initial: () => ({ kind, swap: false }),
    fields: (values) => [
      {
        kind: "choice",
        key: "kind",
        label: texts.kind,
        choices: booleanKinds.map((value) => ({ value, label: texts.kinds[value] })),
      },
      ...(values.kind === "difference" ? [{ kind: "switch", key: "swap", label: texts.swap } as const] : []),
    ],
    note: () => (isTriangulated(solids) ? texts.triangulated : texts.planar),
    make: ({ project }, values) =>
      offerBoolean(library, project, values.swap ? [second, first] : solids, values.kind),
  };
}
