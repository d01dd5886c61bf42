import { useStore } from "zustand";
import { showTriangles } from "../../commands/selection-actions";
import { placed } from "../../document/placement";
import { triangleCentroid } from "../../document/triangles";
import type { Problem } from "../../document/validate";
import { Chip } from "../../ui/chip";
import { formatCount, formatPosition } from "../../strings/format";
import { strings } from "../../strings";
import { useApp, useRun, useView } from "../shared/app-context";
import { TextButton } from "../../ui/text-button";
import { useListSelection } from "../shared/use-list-selection";
import styles from "./triangle-list.module.css";

const texts = strings.triangles;

/** Largest number of triangles listed; the others are counted. */
const maxListed = 100;

/** Returns the surface that the triangles of a problem belong to, and where it is. */
function useSurface({ body: id }: Problem) {
  const rejected = useRun((state) => state.outcome?.result.mesh);
  const bodies = useStore(useApp().bodies.state, (state) => state.byId);
  if (id === null) return rejected && { surface: rejected };
  const body = bodies.get(id);
  return body?.loaded && { surface: body.loaded.surface, placement: body.body.placement };
}

/** The triangles of a surface that a problem names, with buttons that show them. */
export function TriangleList({ problem }: { readonly problem: Problem }) {
  const app = useApp();
  const { triangles, body } = problem;
  const found = useSurface(problem);
  const highlighted = useView((state) => state.triangles);
  const listed = triangles.slice(0, maxListed);
  const choose = useListSelection(listed, highlighted, (chosen) => showTriangles(app, chosen, body));
  if (!found) return null;
  const { surface, placement } = found;
  return (
    <details className={styles["triangles"]} data-testid="triangles">
      <summary>{texts.count(formatCount(triangles.length), triangles.length === 1)}</summary>
      <Chip onClick={() => showTriangles(app, triangles, body)}>{texts.all}</Chip>
      <ul>
        {listed.map((triangle) => {
          const given = triangleCentroid(surface, triangle);
          const position = given && placed(given, placement);
          return (
            <li key={triangle}>
              <TextButton
                aria-pressed={highlighted.length < triangles.length && highlighted.includes(triangle)}
                data-testid={`triangle-${triangle}`}
                onClick={(event) => choose(triangle, event)}
              >
                {texts.one(formatCount(triangle))}
              </TextButton>{" "}
              {position && strings.bottom.at(formatPosition(position))}
            </li>
          );
        })}
      </ul>
    </details>
  );
}
