import type { FaceLook } from "tetrafront/internal";
import type { SolidFeature } from "tetrafront/project";
import { operationStrings } from "../../strings";

const { nouns, parts } = operationStrings.features;

const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

/** Returns the name of a feature: its own, or its kind and number among those of its kind, such as "Fillet 2". */
export function featureLabel(features: readonly SolidFeature[], id: number): string {
  const feature = features.find((one) => one.id === id);
  if (!feature) return operationStrings.features.unknown(id);
  if (feature.name !== undefined) return feature.name;
  const alike = features.filter(({ type }) => type === feature.type);
  return `${capital(nouns[feature.type])} ${alike.indexOf(feature) + 1}`;
}

/** Returns what the file of a part, or a sewn patch, says about a face or a piece of it, by its origin: `3/face 2`, `3/face 2#4`. */
export function faceLook(features: readonly SolidFeature[], origin: string): FaceLook | undefined {
  const [, id, face] = /^(\d+)\/face (\d+)(#\d+)?$/.exec(origin) ?? [];
  const feature = features.find((one) => one.id === Number(id));
  return feature?.type === "import" || feature?.type === "sew"
    ? feature.looks?.[Number(face) - 1]
    : undefined;
}

/**
 * Returns the name of a face by its origin: the one in its file, "Box 1 top" of `3/top`, "Fillet 1 front–top" of `4/fillet 3/front|3/top`. Where a face
 * comes from another one, only the place of that one is named, unless the label is to be full: "Fillet 1 Box 1 front–Box 1 top".
 */
export function faceLabel(features: readonly SolidFeature[], origin: string, isFull = false): string {
  const [, id = "", own = ""] = /^(\d+)\/(.*)$/.exec(origin) ?? [];
  const feature = features.find((one) => one.id === Number(id));
  if (!feature) return origin;
  const given = faceLook(features, origin)?.name;
  if (given !== undefined) return given + own.replace(/^[^#]*#?/, " ").trimEnd();
  const words = own
    .replace(/^(fillet|chamfer|mirror|tool) /, "")
    .replace(/(\d+)\//g, (_, from) => (isFull ? `${featureLabel(features, Number(from))} ` : ""))
    .replace(/[()]/g, "")
    .replace(/(fillet|chamfer) /g, "")
    .replaceAll("|", "–")
    .replace(/#(\d+)$/, " $1");
  const place =
    feature.type === "hole" && words.startsWith("side") ? words.replace("side", parts.wall) : words;
  return `${featureLabel(features, feature.id)} ${place}`.trim();
}
