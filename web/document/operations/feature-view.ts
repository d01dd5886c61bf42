import type { BodyPlacement, ProjectBody, SolidFeature } from "tetrafront/project";
import { carried, noRotation, placed, turned } from "../placement";
import type { Position } from "../position";
import { add, addScaled, dot, length, scale, subtract, unit } from "../vectors";
import type { OperationHandle } from "./operation";

type Solid = Pick<ProjectBody, "placement"> & { readonly features: readonly SolidFeature[] };

/** Where the coordinates of a feature are in the view. */
interface FeatureView {
  readonly there: (position: Position) => Position;
  /** The inverse. */
  readonly back: (position: Position) => Position;
}

/** Digits of a dragged position, of its largest part: motions keep about 15. */
const digits = 12;

/** Returns handles with the coordinates of a feature at their places in the view: later features and the placement of the solid move it. */
export function handlesInView(
  handles: readonly OperationHandle[],
  solid: Solid,
  feature: SolidFeature,
): readonly OperationHandle[] {
  const views = viewsAfter(solid, feature);
  if (views.length === 0) return handles;
  const there = (position: Position) => views.reduce((at, view) => view.there(at), position);
  const back = (position: Position) => views.reduceRight((at, view) => view.back(at), position);
  return handles.map(({ from, along, position, rate, ...handle }) => {
    const direction = along && subtract(there(add(from, along)), there(from));
    return {
      ...handle,
      from: there(from),
      position: there(position),
      along: direction && unit(direction),
      rate: direction ? rate / length(direction) : rate,
      valueAt: (at) => rounded(back(at), at),
    };
  });
}

/** Returns a position without the rounding errors of motions, which fields would show. `at`: the same position in the view. */
function rounded(position: Position, at: Position): Position {
  const size = Math.max(...[...position, ...at].map(Math.abs));
  const step = size > 0 ? 10 ** (Math.ceil(Math.log10(size)) - digits) : 1;
  const [x, y, z] = position.map((part) => Number((Math.round(part / step) * step).toPrecision(digits)) + 0);
  return [x ?? 0, y ?? 0, z ?? 0];
}

/** Returns what moves a feature, in order. */
function viewsAfter({ features, placement }: Solid, { id }: SolidFeature): FeatureView[] {
  const index = features.findIndex((one) => one.id === id);
  const later = features.slice(index + 1).flatMap((one) => motionOf(one) ?? []);
  return placement ? [...later, placedView(placement)] : later;
}

/** Returns how a feature moves the solid; undefined if it leaves the original where it is. */
function motionOf(feature: SolidFeature): FeatureView | undefined {
  if (feature.isOff === true) return undefined;
  if (feature.type === "move") return placedView(motionPlacement(feature));
  if (feature.type === "mirror" && feature.keepOriginal !== true) return mirrorView(feature);
  return undefined;
}

function motionPlacement({ translation, rotation }: Extract<SolidFeature, { type: "move" }>): BodyPlacement {
  const turn = rotation ? turned(rotation.axis, rotation.angle) : noRotation;
  const centre = rotation?.position ?? [0, 0, 0];
  const position = subtract(centre, placed(centre, { rotation: turn }));
  return { position: translation ? add(position, translation) : position, rotation: turn };
}

const placedView = (placement: BodyPlacement): FeatureView => ({
  there: (position) => placed(position, placement),
  back: (position) => carried(position, placement),
});

function mirrorView({ position, normal }: Extract<SolidFeature, { type: "mirror" }>): FeatureView {
  const across = unit(normal) ?? scale(normal, 0);
  const image = (at: Position) => addScaled(at, across, -2 * dot(subtract(at, position), across));
  return { there: image, back: image };
}
