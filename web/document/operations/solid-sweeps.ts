import type { Profile } from "tetrafront/internal";
import type { Project, SolidFeature } from "tetrafront/project";
import { operationStrings } from "../../strings";
import type { Offer } from "../create";
import type { Entity } from "../entities";
import { selectedParts } from "../transforms/selected-parts";
import { typed, type Typed } from "./feature-numbers";
import type { FieldSpec, FieldValues, Operation } from "./operation";
import { drawnProfile } from "./solid-profiles";
import {
  addedPiece,
  editOf,
  makesField,
  solidIn,
  solidNote,
  withoutPatches,
  type FeatureOperation,
  type NewPiece,
  type PieceUse,
} from "./solids";

/** What a sweep becomes. */
type SweepUse = {
  readonly makes: PieceUse;
  /** Whether the drawn loops stay beside the copy in the feature. */
  readonly keepProfile: boolean;
};

/** How a sweep is a feature of a solid. */
interface SweepForm<Values extends FieldValues> {
  readonly noun: string;
  make(values: Typed<Values>, profile: Typed<Profile>): Typed<NewPiece>;
  /** Returns the values of such a feature, with its profile. */
  read(
    feature: Typed<SolidFeature>,
  ): { readonly values: Typed<Values>; readonly profile: Typed<Profile> } | null;
}

export const keepProfile: FieldSpec = {
  kind: "switch",
  key: "keepProfile",
  label: operationStrings.sweeps.fields.keepProfile,
};

/** Returns an operation that sweeps a profile to patches or to a feature of a solid. */
export function sweepOperation<Values extends FieldValues>(
  toPatches: Operation<Values>,
  form: SweepForm<Values>,
): FeatureOperation<Values & SweepUse> {
  const operation: Operation<Values & SweepUse> = {
    ...toPatches,
    initial: (subject) => ({
      ...toPatches.initial(subject),
      makes: solidIn(subject) ? "join" : "patches",
      keepProfile: false,
    }),
    fields: (values, subject) => {
      const own = toPatches.fields(values, subject);
      const makes = makesField(solidIn(subject) !== undefined);
      if (values.makes === "patches") return [...own, makes];
      return [...own.filter(({ key }) => key !== "keepBase"), makes, keepProfile];
    },
    note: (values, subject, expressions) =>
      values.makes === "patches"
        ? (toPatches.note?.(values, subject, expressions) ?? "")
        : solidNote(values.makes, subject),
    make: (subject, values, expressions) =>
      values.makes === "patches"
        ? toPatches.make(subject, values, expressions)
        : { possible: false, reason: reasonOf(subject.project, subject.selection) },
    makeLater: (subject, values, solids, expressions = {}) => {
      const { makes } = values;
      if (makes === "patches") return null;
      const found = drawnProfile(subject.project, subject.selection);
      if (!found.success) return null;
      const piece = form.make(typed<Values>(values, expressions), found.profile);
      const offer = addedPiece({ subject, solids, noun: form.noun, use: makes }, piece);
      return values.keepProfile
        ? offer
        : offer.then((made) => withoutProfile(subject.project, subject.selection, made));
    },
  };
  return {
    ...operation,
    edit: (solid, feature, expressions = {}) => {
      const found = form.read(typed<SolidFeature>(feature, expressions));
      if (!found || !("operation" in feature)) return null;
      const isFirst = solid.features[0]?.id === feature.id;
      const { values, profile } = found;
      return editOf<Values & SweepUse>({
        operation: {
          ...operation,
          fields: (now, subject) =>
            operation
              .fields(now, subject)
              .filter(({ key }) => key !== "keepProfile" && !(isFirst && key === "makes"))
              .map(withoutPatches),
        },
        noun: form.noun,
        solid,
        feature,
        values: { ...values, makes: feature.operation, keepProfile: false } as Typed<Values & SweepUse>,
        made: (now, changed) =>
          now.makes === "patches"
            ? null
            : { ...form.make(typed<Values>(now, changed), profile), operation: now.makes },
      });
    },
  };
}

function reasonOf(project: Project, selection: readonly Entity[]): string {
  const found = drawnProfile(project, selection);
  return found.success ? "" : found.reason;
}

/** Returns an offer that also removes what is drawn of the profile, unless something else uses it. */
export function withoutProfile(project: Project, selection: readonly Entity[], offer: Offer): Offer {
  if (!offer.possible || !("replace" in offer.creation.edit)) return offer;
  const { creation } = offer;
  const { edit } = creation;
  if (!("replace" in edit)) return offer;
  const parts = selectedParts(project, selection);
  const [ownPatches, ownLines] = [parts.patches, parts.lines].map(
    (list) => new Set(list.map(({ id }) => id)),
  );
  const patches = project.patches.filter(({ id }) => ownPatches?.has(id) !== true);
  const usedLines = new Set(patches.flatMap(({ loops }) => loops.flat().map(Math.abs)));
  const lines = project.lines.filter(({ id }) => ownLines?.has(id) !== true || usedLines.has(id));
  const usedPoints = new Set(lines.flatMap((line) => line.points));
  const ownPoints = new Set(parts.points.map(({ id }) => id));
  const points = project.points.filter(({ id }) => !ownPoints.has(id) || usedPoints.has(id));
  const replace = { ...edit.replace, patches, lines, points };
  return { ...offer, creation: { ...creation, edit: { ...edit, replace } } };
}
