import type { Project } from "tetrafront/project";
import { operationStrings, stepNames } from "../../strings";
import { connectedPatches } from "../booleans/solids";
import type { Offer } from "../create";
import type { Entity } from "../entities";
import type { Operation } from "./operation";
import { drawnProfile } from "./solid-profiles";
import { keepProfile, withoutProfile } from "./solid-sweeps";
import { addedPiece, makesField, solidIn, solidNote, withoutPatches, type PieceUse } from "./solids";

const texts = operationStrings.solids;

type Values = { readonly makes: PieceUse; readonly keepProfile: boolean };

/** Makes a solid of drawn planar patches: those that are connected to a selected one, or all. */
export const sew: Operation<Values> = {
  id: "sew",
  ...texts.sewn,
  step: stepNames.add(texts.sewn.noun),
  action: operationStrings.create,
  usesSelection: true,
  initial: () => ({ makes: "new", keepProfile: false }),
  fields: (_values, subject) => [
    ...(solidIn(subject) ? [withoutPatches(makesField(true))] : []),
    keepProfile,
  ],
  note: ({ makes }, subject) => (makes === "patches" ? "" : solidNote(makes, subject)),
  make: ({ project, selection }) => ({ possible: false, reason: facesOf(project, selection).reason }),
  makeLater: async (subject, values, solids) => {
    const { project, selection } = subject;
    const { patches, faces, reason } = facesOf(project, selection);
    if (values.makes === "patches" || reason !== "") return { possible: false, reason } satisfies Offer;
    const addition = { subject, solids, noun: texts.sewn.noun, use: values.makes };
    const offer = await addedPiece(addition, { type: "sew", faces });
    return values.keepProfile ? offer : withoutProfile(project, patches, offer);
  },
};

/** Returns the patches that are sewn, and their loops, or why they cannot be sewn. */
function facesOf(project: Project, selection: readonly Entity[]) {
  const selected = new Set(selection.flatMap(({ kind, id }) => (kind === "patch" ? [id] : [])));
  const groups = connectedPatches(project);
  const meant = selected.size > 0 ? groups.filter((group) => group.some((id) => selected.has(id))) : groups;
  const patches = meant.flat().map((id): Entity => ({ kind: "patch", id }));
  const found = patches.map((patch) => drawnProfile(project, [patch]));
  const faces = found.flatMap((one) => (one.success ? [one.profile] : []));
  const [refused] = found.flatMap((one) => (one.success ? [] : [one.reason]));
  return { patches, faces, reason: patches.length === 0 ? texts.noPatches : (refused ?? "") };
}
