import { useLayoutEffect, useRef } from "react";
import { useStore } from "zustand";
import { findRecord, indexById } from "../document/entities";
import { strings } from "../ui/strings";
import type { Viewer } from "../viewer/viewer";
import { useApp, useView } from "./app-context";

type Place = readonly [number, number, number];

/**
 * The names F1, F2 and F3 at the lines of a selected Barnhill–Gregory–Nielson patch. Follows the camera
 * without React.
 */
export function PatchMarks({ viewer }: { readonly viewer: Viewer }) {
  const app = useApp();
  const [only, ...others] = useView((state) => state.selection);
  const { preview, project } = useStore(app.previews.state);
  const patch =
    only?.kind === "patch" && others.length === 0 && project
      ? findRecord(project, "patch", only.id)
      : undefined;
  const [loop = []] = patch?.type === "barnhill-gregory-nielson" ? patch.loops : [];
  const marks: { name: string; line: number; place: Place }[] = [];
  if (project && preview && loop.length === 3) {
    const positions = indexById(project, "line");
    loop.forEach((step, index) => {
      const position = positions.get(Math.abs(step)) ?? -1;
      const first = preview.lineOffsets[position] ?? 0;
      const end = preview.lineOffsets[position + 1] ?? first;
      const middle = 3 * Math.floor((first + end) / 2);
      const [x, y, z] = preview.linePoints.subarray(middle, middle + 3);
      if (x === undefined || y === undefined || z === undefined) return;
      marks.push({ name: `F${index + 1}`, line: Math.abs(step), place: [x, y, z] });
    });
  }
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const follow = (): void => {
      marks.forEach(({ place }, index) => {
        const mark = box.current?.children[index];
        if (!(mark instanceof HTMLElement)) return;
        const at = viewer.toScreen(place);
        mark.style.display = at ? "" : "none";
        if (at) mark.style.transform = `translate(${at.x}px, ${at.y}px) translate(-50%, -50%)`;
      });
    };
    follow();
    return viewer.onDrawn(follow);
  });
  return (
    <div ref={box} role="group" aria-label={strings.viewport.roles} hidden={marks.length === 0}>
      {marks.map(({ name, line }) => (
        <span
          key={name}
          className="tf-role-mark"
          data-second={name === "F2" || undefined}
          data-line={line}
          data-testid={`mark-${name}`}
        >
          {name}
        </span>
      ))}
    </div>
  );
}
