import type { AdvanceStep, EdgeCandidate } from "tetrafront/trace";
import type { LensCandidate } from "../../player/lens";
import type { LensScene } from "../../player/lens-scene";
import { playerStrings } from "../../strings/player";

const texts = playerStrings;

/** Returns the verdict of the engine on a candidate as a sentence. */
export function sentenceOf(step: AdvanceStep, { candidate, pair }: LensCandidate): string {
  const { node, isNew, verdict, culprit } = candidate;
  const name = isNew ? null : node;
  switch (verdict) {
    case "accepted":
      return texts.sentence.accepted(node, isNew, step.addedElements[0] ?? 0);
    case "behind":
      return texts.sentence.behind(name);
    case "crosses":
      return texts.sentence.crosses(name, culprit ?? 0, pair?.isNewSide ?? null);
    case "too-close":
      return texts.sentence.tooClose(culprit ?? 0);
  }
}

/** As `sentenceOf`, for a candidate in the plane of a patch. */
export function planarSentenceOf({ node, isNew, verdict, culprit }: EdgeCandidate): string {
  return verdict === "accepted"
    ? texts.patch.accepted(node ?? 0, isNew)
    : texts.patch[verdict](isNew ? null : node, culprit ?? 0);
}

/**
 * Returns how the front changes with the examined candidate: if it was accepted, or if the view shows the front as it would be with
 * it; else null.
 */
export function frontChangeOf({ examined, supposed }: LensScene): string | null {
  if (supposed) return texts.frontChange.supposed(supposed.left, supposed.joined.length);
  if (examined?.candidate.verdict !== "accepted") return null;
  const { left, joined } = examined.change;
  return texts.frontChange.accepted(left, joined.length);
}

/**
 * Returns what accepting a refused candidate would have done, by our own check, or that the check does not find what was
 * recorded; null for an accepted candidate that passes.
 */
export function whatIfOf({ candidate: { verdict }, isBehind, crossed }: LensCandidate): string | null {
  const { whatIf, disagreement } = texts;
  if (verdict === "behind") return isBehind ? whatIf.behind : disagreement.inFront;
  if (isBehind) return disagreement.behind;
  if (crossed.length > 0)
    return verdict === "accepted" ? disagreement.crosses(crossed) : whatIf.crosses(crossed);
  if (verdict === "accepted") return null;
  return verdict === "too-close" ? whatIf.tooClose : disagreement.clear;
}
