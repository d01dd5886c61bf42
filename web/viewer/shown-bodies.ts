import type { BodyPlacement, Project, ProjectBodyPatch } from "tetrafront/project";
import type { DrawnSurface } from "../document/drawn-surface";
import { bodiesOf } from "../document/entities";
import { meaningOf, type PatchMeaning } from "../document/patch-colors";
import { placed, placedBox } from "../document/placement";
import type { Position } from "../document/position";
import type { ViewState } from "../document/selection";
import type { BodyFeed, BodyState } from "../session/bodies";
import { sameItems } from "../session/derived";
import type { LoadedSurface, NewBody } from "../workers/surface-files";

/** A body as the view shows it. */
export interface ShownBody {
  readonly id: number;
  readonly patches: readonly ProjectBodyPatch[];
  readonly placement: BodyPlacement | undefined;
  /** The given triangles; null until they are loaded. */
  readonly given: LoadedSurface | null;
  /** The triangles of an up-to-date preview, at their position; null without one. */
  readonly preview: DrawnSurface | null;
  /** The body after a proposed split of its patches; null without a proposal. */
  readonly split: NewBody | null;
}

/** Triangles to draw, and how. */
export interface DrawnTriangles {
  readonly drawn: DrawnSurface | null;
  readonly patches: readonly ProjectBodyPatch[];
  /** Where to move them; undefined if they are at their position. */
  readonly placement: BodyPlacement | undefined;
  /** Meaning of the values: deviations, indices of patches, or packed colours. */
  readonly values: "deviation" | PatchMeaning;
}

const noBodies: readonly ShownBody[] = [];
/** The last result for each feed: what has not changed must be the same object, because it is not drawn again. */
const known = new WeakMap<BodyFeed, readonly ShownBody[]>();

/** Returns the bodies of a project. */
export function shownBodies(project: Project, feed: BodyFeed): readonly ShownBody[] {
  const bodies = bodiesOf(project);
  if (bodies.length === 0) return noBodies;
  const { byId } = feed.state.getState();
  const before = known.get(feed) ?? noBodies;
  const shown = bodies.map(({ id, patches, placement }, index): ShownBody => {
    const state = byId.get(id);
    const given = state?.loaded ?? null;
    const preview = state ? currentPreview(project, feed, state) : null;
    const split = state?.split?.after ?? null;
    const body = { id, patches, placement, given, preview, split };
    const last = before[index];
    return last && isSame(body, last) ? last : body;
  });
  const same = sameItems(shown, before);
  known.set(feed, same);
  return same;
}

const isSame = (a: ShownBody, b: ShownBody): boolean =>
  (Object.keys(a) as (keyof ShownBody)[]).every((part) => a[part] === b[part]);

function currentPreview(project: Project, { preparations }: BodyFeed, state: BodyState): DrawnSurface | null {
  const body = bodiesOf(project).find(({ id }) => id === state.body.id);
  const current = state.preparation && body ? preparations.find(project, body) : null;
  return current === state.preparation ? (current?.drawn ?? null) : null;
}

/** Returns the triangles to draw of a body. */
export function drawnOf(
  { given, preview, split, patches, placement }: ShownBody,
  surface: ViewState["bodySurface"],
): DrawnTriangles {
  if (split) return { drawn: split.loaded.drawn, patches: split.body.patches, placement, values: "patch" };
  if (surface === "new" && preview)
    return { drawn: preview, patches, placement: undefined, values: "deviation" };
  return { drawn: given?.drawn ?? null, patches, placement, values: meaningOf(patches) };
}

/** Returns the box of a body at its placement; null until its triangles are loaded. */
export function shownBox({ given, placement }: ShownBody) {
  return given && placedBox(given.drawn.low, given.drawn.high, placement);
}

/** Returns the corners of given triangles of a body at its placement, x y z each. Leaves out indices out of range. */
export function bodyCorners({ given, placement }: ShownBody, indices: readonly number[]): number[] {
  if (!given) return [];
  const { points, triangles } = given.surface;
  return indices.flatMap((triangle) =>
    [...triangles.subarray(3 * triangle, 3 * triangle + 3)].flatMap((node) => {
      const at: Position = [points[3 * node] ?? 0, points[3 * node + 1] ?? 0, points[3 * node + 2] ?? 0];
      return [...placed(at, placement)];
    }),
  );
}
