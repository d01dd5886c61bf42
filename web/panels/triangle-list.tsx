import { UnstyledButton } from "@mantine/core";
import { showTriangles } from "../commands/selection-actions";
import { triangleCentre } from "../document/triangles";
import { formatCount, formatPlace } from "../ui/format";
import { strings } from "../ui/strings";
import { useApp, useRun, useView } from "./app-context";

const texts = strings.triangles;

/** The triangles of the refused boundary that a problem is about: each with its place, to go to. */
export function TriangleList({ triangles }: { readonly triangles: readonly number[] }) {
  const app = useApp();
  const surface = useRun((state) => state.outcome?.result.surface);
  const marked = useView((state) => state.triangles);
  if (!surface) return null;
  return (
    <details className="tf-triangles" data-testid="triangles">
      <summary>{texts.count(formatCount(triangles.length), triangles.length === 1)}</summary>
      <UnstyledButton className="tf-chip" onClick={() => showTriangles(app, triangles)}>
        {texts.all}
      </UnstyledButton>
      <ul>
        {triangles.map((triangle) => {
          const place = triangleCentre(surface, triangle);
          return (
            <li key={triangle}>
              <UnstyledButton
                className="tf-element"
                aria-pressed={marked.length === 1 && marked[0] === triangle}
                data-testid={`triangle-${triangle}`}
                onClick={() => showTriangles(app, [triangle])}
              >
                {texts.one(formatCount(triangle))}
              </UnstyledButton>{" "}
              {place && strings.bottom.at(formatPlace(place))}
            </li>
          );
        })}
      </ul>
    </details>
  );
}
