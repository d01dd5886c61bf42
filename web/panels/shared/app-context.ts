import { createContext, useContext } from "react";
import { useStore } from "zustand";
import { createStore } from "zustand/vanilla";
import type { App } from "../../app/app";
import type { DocumentState } from "../../session/document-store";
import type { ProblemState } from "../../session/problems";
import { isOfOtherBodies, isStale, type RunState } from "../../session/run-state";
import type { QualitySpace } from "../../document/mesh-quality";
import type { ViewState } from "../../document/selection";
import type { ShellState } from "../../session/shell";
import type { RegionQuality } from "tetrafront/internal";
import type { Project } from "tetrafront/project";
import { calmDocuments } from "./calm-documents";

export const AppContext = createContext<App | null>(null);

export function useApp(): App {
  const app = useContext(AppContext);
  if (!app) throw new Error("A panel was used outside the app");
  return app;
}

/** Returns a part of the document's state, a little later during gestures. */
export function useDocument<T>(select: (state: DocumentState) => T): T {
  return useStore(calmDocuments(useApp().documents.state), select);
}

export function useProject(): Project {
  return useDocument((state) => state.history.present.project);
}

export function useView<T>(select: (state: ViewState) => T): T {
  return useStore(useApp().view.state, select);
}

/**
 * Returns where the quality of the shown mesh is measured; null if the mesh is not stretched, because there
 * is then no choice.
 */
export function useQualitySpace(): QualitySpace | null {
  const isStretched = useRun((state) => state.mesh?.metricShapes !== undefined);
  const space = useView((state) => state.qualitySpace);
  return isStretched ? space : null;
}

export function useRun<T>(select: (state: RunState) => T): T {
  return useStore(useApp().run.state, select);
}

const noRegions: readonly RegionQuality[] = [];

/** The regions of the shown mesh; none before the mesh is finished. */
export function useRegions(): readonly RegionQuality[] {
  return useRun((state) => state.mesh?.report.quality.regions ?? noRegions);
}

export function useProblems<T>(select: (state: ProblemState) => T): T {
  return useStore(useApp().problems.state, select);
}

export function useShell<T>(select: (state: ShellState) => T): T {
  return useStore(useApp().shell, select);
}

const neverPending = createStore(() => ({ pending: false }));

/** Returns whether there is a change that has not been written to the browser's storage. */
export function useAutosavePending(): boolean {
  return useStore(useApp().autosave?.state ?? neverPending, (state) => state.pending);
}

/** Returns whether the view shows the bodies of the project instead of a mesh of others. */
export function useMeshOfOthers(): boolean {
  const document = useDocument((state) => state);
  return useRun((state) => isOfOtherBodies(state, document));
}

export function useStale(): boolean {
  const document = useDocument((state) => state);
  return useRun((state) => isStale(state, document));
}
