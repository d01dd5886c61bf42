import { showTriangles } from "../../commands/selection-actions";
import { triangleCentroid } from "../../document/triangles";
import { Chip } from "../../ui/chip";
import { formatCount, formatPosition } from "../../ui/format";
import { strings } from "../../strings";
import { useApp, useRun, useView } from "../shared/app-context";
import { TextButton } from "../../ui/text-button";
import styles from "./triangle-list.module.css";

const texts = strings.triangles;

/** The triangles of the rejected surface that a problem names, with buttons that show them. */
export function TriangleList({ triangles }: { readonly triangles: readonly number[] }) {
  const app = useApp();
  const surface = useRun((state) => state.outcome?.result.surface);
  const highlighted = useView((state) => state.triangles);
  if (!surface) return null;
  return (
    <details className={styles["triangles"]} data-testid="triangles">
      <summary>{texts.count(formatCount(triangles.length), triangles.length === 1)}</summary>
      <Chip onClick={() => showTriangles(app, triangles)}>{texts.all}</Chip>
      <ul>
        {triangles.map((triangle) => {
          const position = triangleCentroid(surface, triangle);
          return (
            <li key={triangle}>
              <TextButton
                aria-pressed={highlighted.length === 1 && highlighted[0] === triangle}
                data-testid={`triangle-${triangle}`}
                onClick={() => showTriangles(app, [triangle])}
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
