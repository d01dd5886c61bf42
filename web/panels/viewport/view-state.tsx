import { useEffect, type RefObject } from "react";
import { useStore } from "zustand";
import {
  useApp,
  useAutosavePending,
  useProblems,
  useProject,
  useRun,
  useStale,
  useView,
} from "../shared/app-context";

/** Copies the state of the model, the mesh and the tools to attributes of the viewport element, for tests. */
export function ViewState({ container }: { readonly container: RefObject<HTMLDivElement | null> }) {
  const mesh = useRun((state) => state.mesh);
  const busy = useRun((state) => state.busy);
  const front = useRun((state) => state.progress?.frontFaces ?? (state.mesh?.front.length ?? 0) / 3);
  const drawnFront = useRun((state) => state.front && state.front.length / 9);
  const stale = useStale();
  const pending = useAutosavePending();
  const { points, lines, patches, bodies } = useProject();
  // Solids have true faces: those of features, and of CAD files.
  const solids = bodies?.filter(({ trueFaces }) => trueFaces !== undefined).length ?? 0;
  const problems = useProblems((state) => state.problems.length);
  const tool = useView((state) => state.tool);
  useEffect(() => {
    const data = container.current?.dataset;
    if (!data) return;
    data["tets"] = String(mesh?.report.tetrahedra ?? 0);
    data["status"] = mesh?.report.status ?? "none";
    data["fingerprint"] = mesh?.report.fingerprint ?? "";
    data["front"] = String(front);
    if (drawnFront === null) delete data["frontDrawn"];
    else data["frontDrawn"] = String(drawnFront);
    data["stale"] = String(stale);
    data["busy"] = String(busy);
    data["autosaved"] = String(!pending);
  }, [container, mesh, front, drawnFront, stale, busy, pending]);
  useEffect(() => {
    const data = container.current?.dataset;
    if (!data) return;
    data["points"] = String(points.length);
    data["lines"] = String(lines.length);
    data["patches"] = String(patches.length);
    data["solids"] = String(solids);
    data["problems"] = String(problems);
    data["tool"] = tool;
  }, [container, points, lines, patches, solids, problems, tool]);
  useReplayState(container);
  return null;
}

/** Copies the state of what is played, if it is shown. */
function useReplayState(container: RefObject<HTMLDivElement | null>): void {
  const replay = useStore(useApp().replay.state, ({ data }) => data);
  useEffect(() => {
    const data = container.current?.dataset;
    if (!data) return undefined;
    Object.assign(data, replay);
    return () => {
      for (const name of Object.keys(replay)) delete data[name];
    };
  }, [container, replay]);
}
