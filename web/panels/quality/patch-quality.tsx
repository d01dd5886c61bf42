import type { MouseEvent } from "react";
import { Text, UnstyledButton } from "@mantine/core";
import type { PatchQuality } from "tetrafront/internal";
import type { Project } from "tetrafront/project";
import { showEntities } from "../../commands/selection-actions";
import { entityKey, entityOfKey, patchAt, type Entity } from "../../document/entities";
import { SectionTitle } from "../../ui/frames/section-title";
import { formatAngle, formatCount, formatMeasure } from "../../strings/format";
import { TableHead } from "../../ui/table-head";
import { strings } from "../../strings";
import { ratioMeanings } from "../../strings/ratio-meanings";
import { Explained } from "../../ui/explained";
import { useApp, useProject, useRun, useStale, useView } from "../shared/app-context";
import { entityTitle } from "../shared/entity-chips";
import { useListSelection } from "../shared/use-list-selection";
import { ScrollPanel } from "../../ui/frames/scroll-panel";
import { Facts } from "../../ui/facts";
import table from "../../ui/table.module.css";

const texts = strings.patches;

const deviationText = ({ chordDeviation }: PatchQuality, units?: string): string =>
  chordDeviation === undefined ? texts.unknown : formatMeasure(chordDeviation, units);

const noPatches: readonly PatchQuality[] = [];

/** Returns the quality of each patch in the shown mesh, by id; nothing while the mesh is out of date. */
function usePatchQuality(): readonly { readonly entity: Entity; readonly quality: PatchQuality }[] {
  const project = useProject();
  const stale = useStale();
  const all = useRun((state) => state.mesh?.report.patches ?? noPatches);
  if (stale) return [];
  return all.flatMap((quality) => {
    const entity = patchAt(project, quality.patch);
    return entity ? [{ entity, quality }] : [];
  });
}

/** Only runs know target lengths. */
const useMeanEdgeName = (): string =>
  useRun(({ origin }) => (origin === null ? texts.meanEdge : texts.meanEdgeOfMean));

/** The quality of the triangulation of one patch. */
export function PatchFacts({ patch }: { readonly patch: number }) {
  const meanEdge = useMeanEdgeName();
  const { units } = useProject();
  const found = usePatchQuality().find(({ entity }) => entity.id === patch);
  if (!found) return null;
  const { quality } = found;
  return (
    <section data-testid="patch-facts">
      <SectionTitle>{texts.one}</SectionTitle>
      <Facts>
        <dt>{texts.triangles}</dt>
        <dd>{formatCount(quality.triangles)}</dd>
        <dt>{texts.minAngle}</dt>
        <dd>{formatAngle(quality.minAngle)}</dd>
        <dt>
          <Explained name={texts.meanRatio} meaning={ratioMeanings.triangle} />
        </dt>
        <dd>{quality.meanRadiusRatio.toFixed(3)}</dd>
        <dt>{meanEdge}</dt>
        <dd>{quality.meanEdge.toFixed(3)}</dd>
        <dt>{texts.deviation}</dt>
        <dd>{deviationText(quality, units)}</dd>
      </Facts>
    </section>
  );
}

/** The quality of all patches of the mesh, the smallest angle first. */
export function PatchTable() {
  const project = useProject();
  const meanEdge = useMeanEdgeName();
  const rows = usePatchQuality().toSorted((a, b) => a.quality.minAngle - b.quality.minAngle);
  const app = useApp();
  const selected = useView((state) => state.selection).map(entityKey);
  const byKey = new Map(rows.map(({ entity }) => [entityKey(entity), entity]));
  const choose = useListSelection([...byKey.keys()], selected, (keys) =>
    showEntities(
      app,
      keys.flatMap((key) => byKey.get(key) ?? entityOfKey(key) ?? []),
    ),
  );
  return (
    <ScrollPanel label={texts.title}>
      {rows.length === 0 ? (
        <Text size="sm" c="dimmed">
          {texts.none}
        </Text>
      ) : (
        <table className={table["table"]} data-testid="patch-table">
          <TableHead
            meanings={{ [texts.meanRatio]: ratioMeanings.triangle }}
            titles={[
              texts.patch,
              texts.triangles,
              texts.minAngle,
              texts.meanRatio,
              meanEdge,
              texts.deviation,
            ]}
          />
          <tbody>
            {rows.map(({ entity, quality }) => (
              <PatchRow
                key={entity.id}
                entity={entity}
                quality={quality}
                project={project}
                isSelected={selected.includes(entityKey(entity))}
                onChoose={(keys) => choose(entityKey(entity), keys)}
              />
            ))}
          </tbody>
        </table>
      )}
    </ScrollPanel>
  );
}

interface PatchRowProps {
  readonly entity: Entity;
  readonly quality: PatchQuality;
  readonly project: Project;
  readonly isSelected: boolean;
  readonly onChoose: (event: MouseEvent) => void;
}

function PatchRow({ entity, quality, project, isSelected, onChoose }: PatchRowProps) {
  return (
    <tr data-highlighted={isSelected || undefined} data-testid={`patch-row-${entity.id}`}>
      <th scope="row">
        <UnstyledButton aria-pressed={isSelected} title={entityTitle(project, entity)} onClick={onChoose}>
          {entityTitle(project, entity)}
        </UnstyledButton>
      </th>
      <td>{formatCount(quality.triangles)}</td>
      <td>{formatAngle(quality.minAngle)}</td>
      <td>{quality.meanRadiusRatio.toFixed(3)}</td>
      <td>{quality.meanEdge.toFixed(3)}</td>
      <td>{deviationText(quality, project.units)}</td>
    </tr>
  );
}
