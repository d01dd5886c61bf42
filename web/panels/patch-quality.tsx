import { Text, UnstyledButton } from "@mantine/core";
import type { PatchQuality, Project } from "tetrafront";
import { showEntities } from "../commands/selection-actions";
import { SectionTitle } from "../ui/section-title";
import { formatAngle, formatCount, formatShort } from "../ui/format";
import { strings } from "../strings";
import { useApp, useProject, useRun, useStale } from "./app-context";
import { entityTitle } from "./entity-chips";
import { ScrollPanel } from "../ui/scroll-panel";
import { Facts } from "../ui/facts";
import table from "../ui/table.module.css";

const texts = strings.patches;

const noFigures: readonly PatchQuality[] = [];

/** The figures of the mesh on show with the patches they belong to; nothing while the mesh is stale. */
function useFigures(): readonly { readonly id: number; readonly figures: PatchQuality }[] {
  const project = useProject();
  const stale = useStale();
  const all = useRun((state) => state.mesh?.report.patches ?? noFigures);
  if (stale) return [];
  return all.flatMap((figures) => {
    const id = project.patches[figures.patch]?.id;
    return id === undefined ? [] : [{ id, figures }];
  });
}

/** The triangulation of one patch in figures. */
export function PatchFacts({ patch }: { readonly patch: number }) {
  const found = useFigures().find(({ id }) => id === patch);
  if (!found) return null;
  const { figures } = found;
  return (
    <section data-testid="patch-facts">
      <SectionTitle>{texts.one}</SectionTitle>
      <Facts>
        <dt>{texts.triangles}</dt>
        <dd>{formatCount(figures.triangles)}</dd>
        <dt>{texts.minAngle}</dt>
        <dd>{formatAngle(figures.minAngle)}</dd>
        <dt>{texts.meanRatio}</dt>
        <dd>{figures.meanRadiusRatio.toFixed(3)}</dd>
        <dt>{texts.meanEdge}</dt>
        <dd>{figures.meanEdge.toFixed(3)}</dd>
        <dt>{texts.deviation}</dt>
        <dd>{formatShort(figures.chordDeviation)}</dd>
      </Facts>
    </section>
  );
}

/** All patches of the mesh, the worst angle first. */
export function PatchTable() {
  const project = useProject();
  const rows = useFigures().toSorted((a, b) => a.figures.minAngle - b.figures.minAngle);
  return (
    <ScrollPanel label={texts.title}>
      {rows.length === 0 ? (
        <Text size="sm" c="dimmed">
          {texts.none}
        </Text>
      ) : (
        <table className={table["table"]} data-testid="patch-table">
          <thead>
            <tr>
              {[
                texts.patch,
                texts.triangles,
                texts.minAngle,
                texts.meanRatio,
                texts.meanEdge,
                texts.deviation,
              ].map((title) => (
                <th key={title} scope="col">
                  {title}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {rows.map(({ id, figures }) => (
              <PatchRow key={id} id={id} figures={figures} project={project} />
            ))}
          </tbody>
        </table>
      )}
    </ScrollPanel>
  );
}

interface PatchRowProps {
  readonly id: number;
  readonly figures: PatchQuality;
  readonly project: Project;
}

function PatchRow({ id, figures, project }: PatchRowProps) {
  const app = useApp();
  const entity = { kind: "patch", id } as const;
  return (
    <tr data-testid={`patch-row-${id}`}>
      <th scope="row">
        <UnstyledButton onClick={() => showEntities(app, [entity])}>
          {entityTitle(project, entity)}
        </UnstyledButton>
      </th>
      <td>{formatCount(figures.triangles)}</td>
      <td>{formatAngle(figures.minAngle)}</td>
      <td>{figures.meanRadiusRatio.toFixed(3)}</td>
      <td>{figures.meanEdge.toFixed(3)}</td>
      <td>{formatShort(figures.chordDeviation)}</td>
    </tr>
  );
}
