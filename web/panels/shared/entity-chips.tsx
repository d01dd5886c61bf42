import type { Project } from "tetrafront/project";
import { entityKey, entityName, type Entity } from "../../document/entities";
import { Chip } from "../../ui/chip";
import { defaultName, strings } from "../../strings";
import { useApp } from "./app-context";
import { useEntityHover } from "./use-entity-hover";
import styles from "./entity-chips.module.css";

/** Largest number of buttons; the other entities are counted. */
const maxChips = 24;

export function entityTitle(project: Project, entity: Entity): string {
  return entityName(project, entity) ?? defaultName(entity.kind, entity.id);
}

export interface EntityChipsProps {
  readonly entities: readonly Entity[];
  readonly project: Project;
  /** Space above the chips, in pixels. */
  readonly paddingTop?: number;
  /** Called instead of selecting the entity. */
  readonly onChoose?: (entity: Entity) => void;
}

/** Small buttons that select entities. */
export function EntityChips({ entities, project, paddingTop = 2, onChoose }: EntityChipsProps) {
  const app = useApp();
  const choose = onChoose ?? ((entity: Entity) => app.view.select(entity));
  return (
    <div className={styles["chips"]} style={{ paddingTop }}>
      {entities.slice(0, maxChips).map((entity, index) => (
        <EntityChip
          // A closed chain of points ends with its first one again.
          key={`${index}-${entityKey(entity)}`}
          entity={entity}
          title={entityTitle(project, entity)}
          onChoose={choose}
        />
      ))}
      {entities.length > maxChips && (
        <span className={styles["more"]}>{strings.inspector.more(entities.length - maxChips)}</span>
      )}
    </div>
  );
}

interface EntityChipProps {
  readonly entity: Entity;
  readonly title: string;
  readonly onChoose: (entity: Entity) => void;
}

function EntityChip({ entity, title, onChoose }: EntityChipProps) {
  return (
    <Chip title={title} onClick={() => onChoose(entity)} {...useEntityHover(entity)}>
      {title}
    </Chip>
  );
}
