import { useLayoutEffect, useRef } from "react";
import { useStore } from "zustand";
import type { Project, ProjectPreview } from "tetrafront";
import { findRecord, indexById } from "../../document/entities";
import { strings } from "../../strings";
import type { Position } from "../../document/position";
import type { Viewer } from "../../viewer/viewer";
import { useApp, useView } from "../shared/app-context";
import styles from "../shared/patch-roles.module.css";

interface RoleLabel {
  readonly name: string;
  /** Id of the line. */
  readonly line: number;
  readonly position: Position;
}

/** Returns a label at the middle of each line of a loop. */
function labelsOf(project: Project, preview: ProjectPreview, loop: readonly number[]): RoleLabel[] {
  const indices = indexById(project, "line");
  return loop.flatMap((step, role) => {
    const line = Math.abs(step);
    const index = indices.get(line) ?? -1;
    const first = preview.lineOffsets[index] ?? 0;
    const end = preview.lineOffsets[index + 1] ?? first;
    const middle = 3 * Math.floor((first + end) / 2);
    const [x, y, z] = preview.linePoints.subarray(middle, middle + 3);
    if (x === undefined || y === undefined || z === undefined) return [];
    return [{ name: `F${role + 1}`, line, position: [x, y, z] }];
  });
}

/**
 * The names F1, F2 and F3 at the lines of a selected Barnhill–Gregory–Nielson patch. They follow the camera without
 * rendering again.
 */
export function PatchRoleLabels({ viewer }: { readonly viewer: Viewer }) {
  const app = useApp();
  const [only, ...others] = useView((state) => state.selection);
  const { preview, project } = useStore(app.previews.state);
  const patch =
    only?.kind === "patch" && others.length === 0 && project
      ? findRecord(project, "patch", only.id)
      : undefined;
  const [loop = []] = patch?.type === "barnhill-gregory-nielson" ? patch.loops : [];
  const labels = project && preview && loop.length === 3 ? labelsOf(project, preview, loop) : [];
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const follow = (): void => {
      labels.forEach(({ position }, index) => {
        const label = box.current?.children[index];
        if (!(label instanceof HTMLElement)) return;
        const at = viewer.toScreen(position);
        label.style.display = at ? "" : "none";
        if (at) label.style.transform = `translate(${at.x}px, ${at.y}px) translate(-50%, -50%)`;
      });
    };
    follow();
    return viewer.onDrawn(follow);
  });
  return (
    <div ref={box} role="group" aria-label={strings.viewport.roles} hidden={labels.length === 0}>
      {labels.map(({ name, line }) => (
        <span
          key={name}
          className={`${styles["role"]} ${styles["inView"]}`}
          data-second={name === "F2" || undefined}
          data-line={line}
          data-testid={`role-label-${name}`}
        >
          {name}
        </span>
      ))}
    </div>
  );
}
