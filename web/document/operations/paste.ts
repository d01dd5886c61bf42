import type { Project } from "tetrafront/project";
import { operationStrings } from "../../strings";
import type { Position } from "../position";
import { offerCopiesFrom } from "../transforms/copies";
import { coincides, fragmentEntities, hasSameNumbers } from "../transforms/fragment";
import { typedTranslation } from "../transforms/typed-maps";
import { zero } from "../vectors";
import { typedPosition, type Operation } from "./operation";
import { extentOf, pieceExtent } from "./sizes";

const { paste: texts, transforms } = operationStrings;

type PasteValues = { readonly offset: Position; readonly join: boolean };

/**
 * Returns the operation that pastes a fragment: where it was, or beside its original if this is still there. Expressions are
 * pasted too, unless the project would compute other numbers from them.
 */
export function pasteOperation(fragment: Project): Operation<PasteValues> {
  const entities = fragmentEntities(fragment);
  const { expressions: _, ...numbers } = fragment;
  // Computed once per project, not at each change of a value in the panel.
  let last: { readonly project: Project; readonly isSame: boolean } | null = null;
  const isSameIn = (project: Project): boolean => {
    if (last?.project !== project) last = { project, isSame: hasSameNumbers(project, fragment) };
    return last.isSame;
  };
  return {
    id: "paste",
    ...texts,
    action: operationStrings.apply,
    usesSelection: false,
    initial: ({ project }) => {
      const beside = extentOf(fragment.points) || pieceExtent(project);
      return { offset: coincides(project, fragment) ? [beside, 0, 0] : zero, join: true };
    },
    fields: () => [
      { kind: "position", key: "offset", label: transforms.fields.offset },
      { kind: "switch", key: "join", label: transforms.fields.join },
    ],
    note: (_, { project }) => (isSameIn(project) ? "" : texts.numbersKept),
    make: ({ project }, values, expressions) => {
      const from = isSameIn(project) ? fragment : numbers;
      const map = typedTranslation(typedPosition(values, "offset", expressions));
      return offerCopiesFrom(project, from, entities, [map], { label: texts.step, join: values.join });
    },
  };
}
