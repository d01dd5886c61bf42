import type { AdvanceStep } from "tetrafront";
import type { LensCandidate } from "../../player/lens";
import { strings } from "../../strings";

const texts = strings.player;

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

/** Returns what accepting a refused candidate would have done, by our own check; null for the accepted one. */
export function whatIfOf({ candidate, isBehind, crossed }: LensCandidate): string | null {
  if (candidate.verdict === "accepted") return null;
  if (isBehind) return texts.whatIf.behind;
  if (crossed.length > 0) return texts.whatIf.crosses(crossed);
  return candidate.verdict === "too-close" ? texts.whatIf.tooClose : texts.whatIf.clear;
}
