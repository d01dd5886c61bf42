import { bodyBox } from "tetrafront/internal";
import type { Project } from "tetrafront/project";
import type { Offer } from "../create";
import type {} from "../edit";
import type { DraftChange } from "../edit";
import { rangeAlong } from "../extent";

/** Extents of new pieces and their elements: round numbers that fit the model. */

/** Extent of a new piece / extent of the model. */
const pieceShare = 0.5;
/** Size of the elements of a new model / its extent. */
const elementShare = 0.1;

/** Returns a number rounded down to 1, 2 or 5 times a power of ten. */
function roundNumber(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const factor = [5, 2, 1].find((digit) => digit * power <= value * (1 + 1e-12)) ?? 1;
  return Number((factor * power).toPrecision(6));
}

/** Returns the largest extent of the drawn points along an axis; 0 without any. */
export function extentOf(points: readonly { readonly position: readonly number[] }[]): number {
  if (points.length === 0) return 0;
  return Math.max(
    ...[0, 1, 2].map((axis) => {
      const [low, high] = rangeAlong(points, axis);
      return high - low;
    }),
  );
}

/** Returns an extent for a new piece: 1 in an empty project. */
export function pieceExtent({ points, bodies = [], background }: Project): number {
  // Other bodies may have millions of triangles.
  const solids = bodies.filter(({ features }) => features !== undefined);
  const corners = solids.flatMap((body) => bodyBox(body).map((position) => ({ position })));
  const model = [...points, ...corners];
  const extent = extentOf(model.length > 0 ? model : background.nodes);
  return extent > 0 ? roundNumber(pieceShare * extent) : 1;
}

/** Returns whether a project says how large its elements are. */
export function hasSizes({ meshing, background }: Project): boolean {
  return meshing?.size !== undefined || background.tetrahedra.length > 0;
}

/** Returns the uniform size of the elements that fits drawn points; undefined if they have no extent. */
export function proposedSize(points: Project["points"]): number | undefined {
  const extent = extentOf(points);
  return extent > 0 ? roundNumber(elementShare * extent) : undefined;
}

/** Returns an offer that also gives the project a uniform size if it has no sizes and the offer replaces its points. */
export function sizedOffer(project: Project, offer: Offer): Offer {
  if (!offer.possible || hasSizes(project)) return offer;
  const { creation } = offer;
  const { edit } = creation;
  if (!("replace" in edit)) return offer;
  const { points = project.points } = edit.replace;
  const size = points === project.points ? undefined : proposedSize(points);
  if (size === undefined) return offer;
  const meshing = { ...project.meshing, size };
  return { ...offer, creation: { ...creation, edit: { ...edit, replace: { ...edit.replace, meshing } } } };
}

/** Returns a change that also gives the project a uniform size if it has no sizes, so that it can be meshed at once. */
export function withSizes(project: Project, { change }: DraftChange): DraftChange {
  if (hasSizes(project)) return { change };
  return {
    change: (draft) => {
      change(draft);
      const size = proposedSize(draft.project.points);
      if (size !== undefined) draft.project.meshing = { ...draft.project.meshing, size };
    },
  };
}
