import type { Viewer } from "../../../viewer/viewer";
import { CandidateDots } from "./candidate-dots";
import { LensLabels } from "./lens-labels";

/** What is written in the view of a front. */
export function FrontOverlay({ viewer }: { readonly viewer: Viewer }) {
  return (
    <>
      <LensLabels viewer={viewer} />
      <CandidateDots viewer={viewer} />
    </>
  );
}
