import { useMemo } from "react";
import { meshKey } from "../../document/content-keys";
import type { Problem } from "../../document/validate";
import { useProject, useRun } from "./app-context";

/**
 * How a problem is shown. One that is `expected` while a model is drawn does not alarm before a mesh is asked for; a `note` needs
 * no action.
 */
export type ShownSeverity = Problem["severity"] | "expected" | "note";

/** Whether a problem is shown without alarm. */
export const isCalm = (severity: ShownSeverity): boolean => severity === "expected" || severity === "note";

/** Bodies that touch are joined by a run. */
const notes: ReadonlySet<string> = new Set(["touching-bodies"]);

/** While it is drawn, a model need not be closed yet, nor have sizes. */
const expectedWhileDrawn: ReadonlySet<string> = new Set([
  "open-edge",
  "empty-model",
  "empty-background-grid",
  "outside-background-grid",
]);

/** Returns whether the user has asked for a mesh of the present model. */
export function useIsMeshed(): boolean {
  const project = useProject();
  const key = useRun((state) => state.outcome?.key);
  return useMemo(() => key === meshKey(project), [project, key]);
}

/** Returns a function that tells how a problem of the present model is shown. */
export function useShownSeverity(): (problem: Pick<Problem, "code" | "severity">) => ShownSeverity {
  const isMeshed = useIsMeshed();
  return ({ code, severity }) => {
    if (notes.has(code)) return "note";
    return !isMeshed && expectedWhileDrawn.has(code) ? "expected" : severity;
  };
}
