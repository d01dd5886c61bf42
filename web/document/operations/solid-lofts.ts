import type { Project, SolidFeature } from "tetrafront/project";
import { operationStrings, stepNames } from "../../strings";
import type { Entity } from "../entities";
import { drawnSections, drawnSweep, type SectionOrder } from "./drawn-sections";
import { typed, type Typed } from "./feature-numbers";
import type { FieldSpec, FieldValues, Operation } from "./operation";
import { keepProfile, withoutProfile } from "./solid-sweeps";
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

const texts = operationStrings.lofts;

/** What every piece of several drawn loops or lines is asked. */
type DrawnUse = { readonly makes: PieceUse; readonly keepProfile: boolean };

/** The piece that a selection gives, and what the user should know about it, or why there is none. */
type DrawnPiece =
  | { readonly success: true; readonly piece: Typed<NewPiece>; readonly note: string }
  | { readonly success: false; readonly reason: string };

interface DrawnForm<Values extends FieldValues> {
  readonly id: string;
  readonly noun: string;
  readonly title: string;
  readonly initial: Values;
  /** The fields of a new piece, and of one that is edited. */
  fields(isNew: boolean): readonly FieldSpec[];
  find(project: Project, selection: readonly Entity[], values: Values): DrawnPiece;
  /** Returns the values of such a feature; null for another kind. */
  read(feature: SolidFeature): Values | null;
  /** Returns such a feature with other values. */
  changed(feature: Typed<SolidFeature>, values: Values): Typed<NewPiece>;
}

/** Returns an operation that makes a feature of several drawn loops or lines. */
function drawnOperation<Values extends FieldValues>(
  form: DrawnForm<Values>,
): FeatureOperation<Values & DrawnUse> {
  const { noun } = form;
  const operation: Operation<Values & DrawnUse> = {
    id: form.id,
    title: form.title,
    step: stepNames.add(noun),
    action: operationStrings.create,
    usesSelection: true,
    initial: (subject) => ({
      ...form.initial,
      makes: solidIn(subject) ? "join" : "new",
      keepProfile: false,
    }),
    fields: (_, subject) => [
      ...form.fields(true),
      withoutPatches(makesField(solidIn(subject) !== undefined)),
      keepProfile,
    ],
    note: (values, subject) => {
      const found = form.find(subject.project, subject.selection, values);
      const use = values.makes === "patches" ? "" : solidNote(values.makes, subject);
      return found.success ? `${found.note} ${use}`.trim() : use;
    },
    make: ({ project, selection }, values) => {
      const found = form.find(project, selection, values);
      return { possible: false, reason: found.success ? "" : found.reason };
    },
    makeLater: (subject, values, solids) => {
      const { project, selection } = subject;
      const found = form.find(project, selection, values);
      if (!found.success || values.makes === "patches") return null;
      const offer = addedPiece({ subject, solids, noun, use: values.makes }, found.piece);
      return values.keepProfile ? offer : offer.then((made) => withoutProfile(project, selection, made));
    },
  };
  return {
    ...operation,
    edit: (solid, feature, expressions = {}) => {
      const values = form.read(feature);
      if (!values || !("operation" in feature)) return null;
      const isFirst = solid.features[0]?.id === feature.id;
      const fields = [...form.fields(false), ...(isFirst ? [] : [withoutPatches(makesField(true))])];
      if (fields.length === 0) return null;
      const given = typed<SolidFeature>(feature, expressions);
      return editOf<Values & DrawnUse>({
        operation: { ...operation, fields: () => fields },
        noun,
        solid,
        feature,
        values: { ...values, makes: feature.operation, keepProfile: false } as Typed<Values & DrawnUse>,
        made: (now) =>
          now.makes === "patches" ? null : { ...form.changed(given, now), operation: now.makes },
      });
    },
  };
}

type Loft = { readonly order: SectionOrder; readonly isRuled: boolean };

const ruledField: FieldSpec = { kind: "switch", key: "isRuled", label: texts.ruled };

const orderField: FieldSpec = {
  kind: "choice",
  key: "order",
  label: texts.order,
  choices: (["selected", "nearest"] as const).map((value) => ({ value, label: texts.orders[value] })),
};

const loft = drawnOperation<Loft>({
  id: "solid-loft",
  ...texts.loft,
  initial: { order: "selected", isRuled: false },
  fields: (isNew) => (isNew ? [orderField, ruledField] : [ruledField]),
  find: (project, selection, { order, isRuled }) => {
    const found = drawnSections(project, selection, order);
    if (!found.success) return found;
    const sections = found.sections.map(({ profile }) => profile);
    const note = texts.through(found.sections.map(({ name }) => name));
    return { success: true, piece: { type: "loft", sections, isRuled }, note };
  },
  read: (feature) =>
    feature.type === "loft" ? { order: "selected", isRuled: feature.isRuled === true } : null,
  changed: (feature, { isRuled }) => ({ ...(feature as Typed<NewPiece>), isRuled }) as Typed<NewPiece>,
});

const sweep = drawnOperation<Record<never, never>>({
  id: "solid-sweep",
  ...texts.sweep,
  initial: {},
  fields: () => [],
  find: (project, selection) => {
    const found = drawnSweep(project, selection);
    if (!found.success) return found;
    const { profile, path } = found;
    return { success: true, piece: { type: "sweep", profile, path }, note: texts.along(path.length) };
  },
  read: (feature) => (feature.type === "sweep" ? {} : null),
  changed: (feature) => feature as Typed<NewPiece>,
});

/** The operations that make a feature of several drawn loops and lines, in the order of the menu. */
export const loftOperations: readonly FeatureOperation[] = [loft, sweep];
