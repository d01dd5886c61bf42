import type { Viewer } from "../../../viewer/viewer";
import { LensLabels } from "./lens-labels";

/** What is written in the view of a front. */
export function FrontOverlay({ viewer }: { readonly viewer: Viewer }) {
  return (
    <>
      <LensLabels viewer={viewer} />
    </>
  );
}
