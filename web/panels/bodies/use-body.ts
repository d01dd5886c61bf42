import type { ProjectBody } from "tetrafront/project";
import { useStore } from "zustand";
import type { BodyState } from "../../session/bodies";
import type { Preparation } from "../../session/body-preparations";
import { useApp, useProject } from "../shared/app-context";

/** Returns what is known of a body. */
export function useBody(id: number): BodyState | undefined {
  return useStore(useApp().bodies.state, ({ byId }) => byId.get(id));
}

/** Returns the last preview of a body, and whether it shows what a run would mesh. */
export function usePreparation(body: ProjectBody): {
  readonly preparation: Preparation | null;
  readonly isCurrent: boolean;
} {
  const app = useApp();
  const project = useProject();
  const preparation = useBody(body.id)?.preparation ?? null;
  const isCurrent = preparation !== null && app.bodies.preparations.find(project, body) === preparation;
  return { preparation, isCurrent };
}
