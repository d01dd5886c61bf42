import { UnstyledButton } from "@mantine/core";
import type { Project } from "tetrafront";
import { entityKey, entityName, type Entity } from "../document/entities";
import { entityWords, strings } from "../ui/strings";
import { useApp } from "./app-context";

/** More buttons than this are not looked at one by one. */
const maxChips = 24;

export function entityTitle(project: Project, entity: Entity): string {
  return entityName(project, entity) ?? `${entityWords[entity.kind].one} ${entity.id}`;
}

export interface EntityChipsProps {
  readonly entities: readonly Entity[];
  readonly project: Project;
  /** Instead of selecting it. */
  readonly onChoose?: (entity: Entity) => void;
}

/** Entities as small buttons that select them. */
export function EntityChips({ entities, project, onChoose }: EntityChipsProps) {
  const app = useApp();
  const choose = onChoose ?? ((entity: Entity) => app.view.select(entity));
  return (
    <div className="tf-chips">
      {entities.slice(0, maxChips).map((entity, index) => (
        <UnstyledButton
          // A closed chain of points names its first again at its end.
          key={`${index}-${entityKey(entity)}`}
          className="tf-chip"
          onClick={() => choose(entity)}
          onMouseEnter={() => app.view.setHover(entity)}
          onMouseLeave={() => app.view.setHover(null)}
        >
          {entityTitle(project, entity)}
        </UnstyledButton>
      ))}
      {entities.length > maxChips && (
        <span className="tf-chip-more">{strings.inspector.more(entities.length - maxChips)}</span>
      )}
    </div>
  );
}
