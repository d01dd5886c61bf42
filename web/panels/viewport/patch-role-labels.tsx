import { useLayoutEffect, useRef } from "react";
import { useStore } from "zustand";
import type { PatchType, Project, ProjectPatch, ProjectPreview } from "tetrafront/project";
import { findRecord, indexById } from "../../document/entities";
import { strings } from "../../strings";
import type { Position } from "../../document/position";
import { linePositions } from "../../document/line-samples";
import { between, distance } from "../../document/vectors";
import { placedApart } from "../../viewer/apart";
import type { Viewer } from "../../viewer/viewer";
import { useApp, useView } from "../shared/app-context";
import { numberLabel, numberedPoints } from "./number-label";
import styles from "../shared/patch-roles.module.css";

interface RoleLabel {
  readonly name: string;
  /** Id of the line. */
  readonly line: number;
  readonly position: Position;
  /** A position a little further in the direction in which the equation traverses the line. */
  readonly ahead: Position;
}

/** Patch types whose equations name their lines, and the roles that run against the direction of the loop. */
const namedLines: Partial<
  Record<PatchType, { readonly lines: number; readonly reversed: readonly number[] }>
> = {
  "barnhill-gregory-nielson": { lines: 3, reversed: [] },
  // F1 and F3 run along ξ, F2 and F4 along η.
  coons: { lines: 4, reversed: [2, 3] },
};

/** Returns a label at the middle of each line of a patch. */
function labelsOf(project: Project, preview: ProjectPreview, { type, loops }: ProjectPatch): RoleLabel[] {
  const rule = namedLines[type];
  const [loop = []] = loops;
  if (!rule || loop.length !== rule.lines) return [];
  const indices = indexById(project, "line");
  return loop.flatMap((step, role) => {
    const line = Math.abs(step);
    const index = indices.get(line) ?? -1;
    const first = preview.lineOffsets[index] ?? 0;
    const last = (preview.lineOffsets[index + 1] ?? first) - 1;
    if (last <= first) return [];
    const sampleAt = (i: number): Position => {
      const [x = 0, y = 0, z = 0] = preview.linePoints.subarray(3 * i, 3 * i + 3);
      return [x, y, z];
    };
    // The middle sample, or the middle between two samples.
    const [from, to] = [Math.floor((first + last - 1) / 2), Math.ceil((first + last + 1) / 2)];
    const [before, after] = [sampleAt(from), sampleAt(to)];
    const position = to - from === 2 ? sampleAt(from + 1) : between(before, after, 0.5);
    // The engine samples a line from the end with the lower id.
    const start =
      linePositions(project, { points: project.lines[index]?.points.slice(0, 1) ?? [] })[0] ?? before;
    const isSampledBackwards = distance(sampleAt(last), start) < distance(sampleAt(first), start);
    const runsForward = step > 0 !== rule.reversed.includes(role);
    const isForward = runsForward !== isSampledBackwards;
    return [{ name: `F${role + 1}`, line, position, ahead: isForward ? after : before }];
  });
}

/**
 * The names F1, F2 and so on at the lines of a selected patch of Barnhill, Gregory and Nielson or of Coons, with arrows in
 * the directions of the equation. They keep off each other and the numbers of points, and follow the camera without rendering again.
 */
export function PatchRoleLabels({ viewer }: { readonly viewer: Viewer }) {
  const app = useApp();
  const [only, ...others] = useView((state) => state.selection);
  const { preview, project } = useStore(app.previews.state);
  const patch =
    only?.kind === "patch" && others.length === 0 && project
      ? findRecord(project, "patch", only.id)
      : undefined;
  const labels = project && preview && patch ? labelsOf(project, preview, patch) : [];
  const hasNumbers = useView((state) => state.numbers && state.layers.points);
  const hidden = useView((state) => state.hidden);
  const numbered = hasNumbers && project && patch ? numberedPoints(project.points, hidden) : [];
  const isTriangle = patch?.type === "barnhill-gregory-nielson";
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const follow = (): void => {
      const numbers = numbered.flatMap(({ id, position }) => {
        const at = viewer.toScreen(position);
        return at ? [numberLabel(id, at)] : [];
      });
      const shown = labels.flatMap(({ position, ahead }, index) => {
        const label = box.current?.children[index];
        if (!(label instanceof HTMLElement)) return [];
        const at = viewer.toScreen(position);
        label.style.display = at ? "" : "none";
        const to = viewer.toScreen(ahead);
        const arrow = label.querySelector<HTMLElement>("[data-arrow]");
        if (at && to && arrow) {
          arrow.style.transform = `rotate(${Math.atan2(to.y - at.y, to.x - at.x)}rad)`;
        }
        return at ? [{ ...at, width: label.offsetWidth, height: label.offsetHeight, label }] : [];
      });
      placedApart(shown, undefined, numbers).forEach(({ x, y }, i) => {
        const { style } = shown[i]?.label ?? {};
        if (style) style.transform = `translate(${x}px, ${y}px) translate(-50%, -50%)`;
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
          data-second={(isTriangle && name === "F2") || undefined}
          data-line={line}
          data-testid={`role-label-${name}`}
        >
          {name}
          <span className={styles["arrow"]} data-arrow aria-hidden>
            →
          </span>
        </span>
      ))}
    </div>
  );
}
