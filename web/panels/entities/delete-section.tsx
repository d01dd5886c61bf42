import { Text } from "@mantine/core";
import { useMemo } from "react";
import type { Project } from "tetrafront/project";
import { withDependents } from "../../document/edits";
import { entityKey, type Entity } from "../../document/entities";
import { strings } from "../../strings";
import { TextCommandButton } from "../shared/command-button";
import { EntityChips } from "../shared/entity-chips";

interface DeleteSectionProps {
  readonly entities: readonly Entity[];
  readonly project: Project;
}

/** Deletes the selection; shows beforehand what depends on it and goes with it. */
export function DeleteSection({ entities, project }: DeleteSectionProps) {
  const others = useMemo(() => {
    const chosen = new Set(entities.map(entityKey));
    return withDependents(project, entities).filter((entity) => !chosen.has(entityKey(entity)));
  }, [entities, project]);
  return (
    <>
      <TextCommandButton command="delete" mt={10} testId="delete-selection">
        {entities.length === 1 ? strings.inspector.delete : null}
      </TextCommandButton>
      {others.length > 0 && (
        <div data-testid="deletes-also">
          <Text size="xs" c="dimmed" mt={6}>
            {strings.inspector.deletesAlso(others.length)}
          </Text>
          <EntityChips entities={others} project={project} />
        </div>
      )}
    </>
  );
}
