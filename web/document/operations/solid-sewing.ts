import type { Project, ProjectPatch } from "tetrafront/project";
import { defaultName, operationStrings, stepNames } from "../../strings";
import { connectedPatches } from "../booleans/solids";
import { withHeirs } from "../patch-heirs";
import type { Offer } from "../create";
import { entityName, type Entity } from "../entities";
import type { Operation } from "./operation";
import { arePlain, plainFaces, sampledFaces } from "./sewn-faces";
import { keepProfile, withoutProfile } from "./solid-sweeps";
import { addedPiece, makesField, solidIn, solidNote, withoutPatches, type PieceUse } from "./solids";

const texts = operationStrings.solids;

type Values = { readonly makes: PieceUse; readonly keepProfile: boolean };

/** Makes a solid of drawn patches: those that are connected to a selected one, or all. */
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
  make: ({ project, selection }) => ({
    possible: false,
    reason: patchesIn(project, selection).length === 0 ? texts.noPatches : "",
  }),
  makeLater: async (subject, values, solids) => {
    const { project, selection } = subject;
    const patches = patchesIn(project, selection);
    if (values.makes === "patches" || patches.length === 0)
      return { possible: false, reason: texts.noPatches } satisfies Offer;
    const shared = lineOfThree(patches);
    if (shared !== undefined)
      return { possible: false, reason: texts.threePatches(lineName(project, shared)) } satisfies Offer;
    const plain = arePlain(project, patches) ? plainFaces(project, patches) : undefined;
    const isPlain = plain !== undefined && !("reason" in plain);
    // Coordinates of plane patches may be rounded.
    const found = isPlain ? plain : await sampledFaces(project, patches, solids);
    if ("reason" in found) return { possible: false, reason: found.reason } satisfies Offer;
    const addition = { subject, solids, noun: texts.sewn.noun, use: values.makes };
    const { faces, looks, owners } = found;
    const made = await addedPiece(addition, { type: "sew", faces, looks });
    const offer = isPlain ? made : noted(made, texts.keptShape);
    if (values.keepProfile) return offer;
    const drawn = patches.map(({ id }): Entity => ({ kind: "patch", id }));
    const alone = withoutProfile(project, drawn, offer);
    return values.makes === "new" ? withPatchIds(project, alone, owners) : alone;
  },
};

/** Returns the patches that are sewn. */
function patchesIn(project: Project, selection: readonly Entity[]): ProjectPatch[] {
  const selected = new Set(selection.flatMap(({ kind, id }) => (kind === "patch" ? [id] : [])));
  const groups = connectedPatches(project);
  const meant = new Set(
    (selected.size > 0 ? groups.filter((group) => group.some((id) => selected.has(id))) : groups).flat(),
  );
  return project.patches.filter(({ id }) => meant.has(id));
}

/** Returns a line at which more than two of the patches meet. */
function lineOfThree(patches: readonly ProjectPatch[]): number | undefined {
  const uses = new Map<number, number>();
  for (const step of patches.flatMap(({ type, loops }) =>
    (type === "loft" ? loops.slice(0, 1) : loops).flat(),
  ))
    uses.set(Math.abs(step), (uses.get(Math.abs(step)) ?? 0) + 1);
  return [...uses].find(([, count]) => count > 2)?.[0];
}

const lineName = (project: Project, id: number): string =>
  entityName(project, { kind: "line", id }) ?? defaultName("line", id);

/**
 * Gives the faces of the new solid, which is the last body, the ids of the patches that they replace, so that groups and conditions
 * stay. Of several faces of one patch, the first has its id, and the others are in its groups and have its conditions.
 */
function withPatchIds(project: Project, offer: Offer, owners: readonly number[]): Offer {
  if (!offer.possible) return offer;
  const { creation } = offer;
  const { edit } = creation;
  if (!("replace" in edit)) return offer;
  const { bodies = [] } = edit.replace;
  const body = bodies.at(-1);
  if (!body) return offer;
  const heirs = new Map<number, readonly number[]>();
  const patches = body.patches.map((patch) => {
    const face = Number(/^1\/face (\d+)$/.exec(patch.origin ?? "")?.[1]) - 1;
    const owner = owners[face];
    if (owner === undefined) return patch;
    const id = owners.indexOf(owner) === face ? owner : patch.id;
    heirs.set(owner, [...(heirs.get(owner) ?? []), id]);
    return { ...patch, id };
  });
  const others = withHeirs({ ...project, ...edit.replace }, heirs);
  const replace = { ...edit.replace, ...others, bodies: [...bodies.slice(0, -1), { ...body, patches }] };
  return { ...offer, creation: { ...creation, edit: { ...edit, replace } } };
}

/** Returns an offer with a further note. */
const noted = (offer: Offer, note: string): Offer =>
  offer.possible
    ? {
        ...offer,
        creation: { ...offer.creation, note: [offer.creation.note, note].filter(Boolean).join(" ") },
      }
    : offer;
