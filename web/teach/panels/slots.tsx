import { lazy, Suspense } from "react";
import type { Slots } from "../../panels/shared/slots";
import type { Viewer } from "../../viewer/viewer";
import { frontStrings } from "../strings/front";
import { useHasLens } from "./player/use-has-lens";
import { useBesidePlane } from "./player/use-player";

const loadPanels = () => import("./player/front-panels");
const loadPlane = () => import("./player/plane-view");

const Lens = lazy(async () => ({ default: (await loadPanels()).Lens }));
const FrontPanel = lazy(async () => ({ default: (await loadPanels()).FrontPanel }));
const PlaneView = lazy(async () => ({ default: (await loadPlane()).PlaneView }));
const FrontOverlay = lazy(async () => {
  const { FrontOverlay: Overlay } = await import("./player/front-overlay");
  // So that the plane of a patch is there when one is first shown.
  loadPlane().catch(() => undefined);
  return { default: Overlay };
});

const FrontLegend = lazy(async () => ({
  default: (await import("./player/front-legend")).FrontLegend,
}));

function Legend() {
  return (
    <Suspense fallback={null}>
      <FrontLegend />
    </Suspense>
  );
}

function Overlay({ viewer }: { readonly viewer: Viewer }) {
  return (
    <Suspense fallback={null}>
      <FrontOverlay viewer={viewer} />
    </Suspense>
  );
}

/** What the page shows of fronts. */
export const teachingSlots: Slots = {
  left: { label: frontStrings.lens, Panel: Lens, useIsOffered: useHasLens },
  bottom: { label: frontStrings.tab, Panel: FrontPanel },
  Overlay,
  Legend,
  Beside: PlaneView,
  useBeside: useBesidePlane,
  load: loadPanels,
};
