import type { Viewer } from "../../../viewer/viewer";
import { LensLabels } from "./lens-labels";
import { VolumeChoices } from "./volume-choices";

/** What is written in the view of a front. */
export function FrontOverlay({ viewer }: { readonly viewer: Viewer }) {
  return (
    <>
      <VolumeChoices viewer={viewer} />
      <LensLabels viewer={viewer} />
    </>
  );
}
