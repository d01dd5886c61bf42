import type { Project } from "tetrafront";
import { operationStrings } from "../../strings";
import type { Position } from "../position";
import { translation } from "../transforms/affine";
import { offerCopiesFrom } from "../transforms/copies";
import { coincides, fragmentEntities } from "../transforms/fragment";
import { zero } from "../vectors";
import type { Operation } from "./operation";
import { extentOf, pieceExtent } from "./sizes";

const { paste: texts, transforms } = operationStrings;

type PasteValues = { readonly offset: Position; readonly join: boolean };

/** Returns the operation that pastes a fragment: where it was, or beside its original if this is still there. */
export function pasteOperation(fragment: Project): Operation<PasteValues> {
  const entities = fragmentEntities(fragment);
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
    make: ({ project }, { offset, join }) =>
      offerCopiesFrom(project, fragment, entities, [translation(offset)], { label: texts.step, join }),
  };
}
