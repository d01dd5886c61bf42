import type { Project } from "tetrafront/project";
import { operationStrings } from "../../strings";
import type { Offer } from "../create";
import { insertion, withInsertion } from "../insert-shape";
import { storableTexts } from "../quantity-positions";
import { mapPoints, type Shape } from "../shape";
import { mapPosition, type Affine } from "./affine";
import { keptCoordinates, keptInstead } from "./mapped-expressions";
import type { Profile } from "./profile";
import { mapQuantities, typedMap } from "./typed-maps";

/** A point of a profile at a station of a sweep: 0 is where it begins. */
export interface SweptPoint {
  readonly index: number;
  readonly station: number;
}

export interface SweepOptions {
  readonly label: string;
  /** Keep the selected patches, also where they then separate two regions. */
  readonly keepBase: boolean;
}

/** Returns the points of a profile where a sweep begins. */
export const profilePoints = ({ points }: Shape): SweptPoint[] =>
  points.map((_, index) => ({ index, station: 0 }));

/** Offers to add what a profile has swept. `mapTo` returns the map from station 0 to another one. */
export function offerSweep(
  project: Project,
  { patchIds, shape, quantities }: Profile,
  swept: Shape<SweptPoint>,
  mapTo: (station: number) => Affine,
  { label, keepBase }: SweepOptions,
): Offer {
  const base = new Set(keepBase ? [] : patchIds);
  const kept = base.size === 0 ? project.patches : project.patches.filter(({ id }) => !base.has(id));
  const maps = new Map([...new Set(swept.points.map(({ station }) => station))].map((at) => [at, mapTo(at)]));
  const placed = mapPoints(swept, ({ index, station }) => {
    const [position, map] = [shape.points[index] ?? ([0, 0, 0] as const), maps.get(station)];
    return station === 0 || !map ? position : mapPosition(map, position);
  });
  const made = insertion(project, placed, { join: true });
  // With `keepBase` off, the patches of the base are neither kept nor added again: they have the same lines.
  const lists = withInsertion({ ...project, patches: kept }, made);
  const texts = storableTexts(
    swept.points.map(({ index, station }) => {
      const [position, map] = [quantities[index] ?? ([0, 0, 0] as const), maps.get(station)];
      return station === 0 || !map ? position : mapQuantities(typedMap(map), position);
    }),
  );
  return {
    possible: true,
    creation: {
      entities: made.patchIds.filter((id) => !base.has(id)).map((id) => ({ kind: "patch", id })),
      ...(!texts && { note: operationStrings.numbersKept }),
      edit: {
        label,
        replace: {
          ...lists,
          ...keptInstead(project, keptCoordinates(project, made.pointIds, texts ?? [])),
        },
      },
    },
  };
}
