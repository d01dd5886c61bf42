import { Badge, Text } from "@mantine/core";
import { useMemo } from "react";
import type { Project } from "tetrafront/project";
import { renameEntity } from "../../document/edits";
import { dependentsOf, entityKey, entityName, findRecord, type Entity } from "../../document/entities";
import { FieldRow } from "../../ui/fields/field-row";
import { NameField } from "../../ui/fields/name-field";
import { defaultName, strings } from "../../strings";
import { useApp, useProblems, useProject } from "../shared/app-context";
import { EntityChips } from "../shared/entity-chips";
import { EntityIcon } from "../shared/entity-icon";
import { BodyCard } from "../bodies/body-card";
import { BodyPatchCard } from "../bodies/body-patch-card";
import { DeleteSection } from "./delete-section";
import { GroupButtons } from "./group-list";
import { LineEditor } from "./line-editor";
import { NodeEditor } from "./node-editor";
import { PatchEditor } from "./patch-editor";
import { PatchFacts } from "../quality/patch-quality";
import { PointEditor } from "./point-editor";
import { ProblemCard } from "../problems/problem-card";
import { CreateFromSelection } from "./selection-card";
import { SourceEditor } from "./source-editor";
import { useEditedField } from "./use-edited-field";
import styles from "./entity-card.module.css";

/** The fields of one entity. */
export function EntityCard({ entity }: { readonly entity: Entity }) {
  const app = useApp();
  const project = useProject();
  const problems = useProblems((state) => state.byEntity.get(entityKey(entity)));
  const { name: nameField, values } = useEditedField();
  const record = findRecord(project, entity.kind, entity.id);
  const dependents = useMemo(() => dependentsOf(project, entity), [project, entity]);
  const alone = useMemo(() => [entity], [entity]);
  if (!record) return null;
  const name = entityName(project, entity) ?? "";
  return (
    <>
      <EntityTitle entity={entity} project={project} isValid={!problems} />
      {entity.kind !== "background-node" && (
        <div ref={nameField} className={styles["fields"]}>
          <FieldRow label={strings.inspector.name}>
            <NameField
              key={entityKey(entity)}
              label={strings.inspector.name}
              value={name}
              placeholder={defaultName(entity.kind, entity.id)}
              testId="entity-name"
              onCommit={(next) => app.documents.edit(renameEntity(entity, next))}
            />
          </FieldRow>
        </div>
      )}
      <div ref={values} className={styles["fields"]}>
        <EntityFields key={entityKey(entity)} entity={entity} project={project} />
      </div>
      <CreateFromSelection selection={[entity]} />
      {dependents.length > 0 && (
        <FieldRow label={strings.inspector.usedBy}>
          <EntityChips entities={dependents} project={project} paddingTop={5} />
        </FieldRow>
      )}
      <GroupButtons selection={[entity]} />
      {entity.kind !== "body-patch" && <DeleteSection entities={alone} project={project} />}
      {(entity.kind === "patch" || entity.kind === "body-patch") && <PatchFacts patch={entity.id} />}
      {entity.kind !== "body" &&
        problems?.map((problem) => <ProblemCard key={problem.key} problem={problem} />)}
    </>
  );
}

interface EntityTitleProps {
  readonly entity: Entity;
  readonly project: Project;
  readonly isValid: boolean;
}

/** The name of an entity, or its default label. */
function EntityTitle({ entity, project, isValid }: EntityTitleProps) {
  const name = entityName(project, entity) ?? "";
  const fallback = defaultName(entity.kind, entity.id);
  return (
    <div className={styles["title"]}>
      <EntityIcon entity={entity} project={project} />
      <Text fw={600} size="md" component="h2">
        {name === "" ? fallback : name}
      </Text>
      {name !== "" && (
        <Text size="sm" c="dimmed">
          {fallback.toLowerCase()}
        </Text>
      )}
      {isValid && (
        <Badge size="sm" variant="outline" color="var(--tf-success)" className={styles["valid"]}>
          {strings.inspector.valid}
        </Badge>
      )}
    </div>
  );
}

function EntityFields({ entity, project }: { readonly entity: Entity; readonly project: Project }) {
  switch (entity.kind) {
    case "point": {
      const point = findRecord(project, "point", entity.id);
      return point && <PointEditor point={point} project={project} />;
    }
    case "line": {
      const line = findRecord(project, "line", entity.id);
      return line && <LineEditor line={line} project={project} />;
    }
    case "patch": {
      const patch = findRecord(project, "patch", entity.id);
      return patch && <PatchEditor patch={patch} project={project} />;
    }
    case "body": {
      const body = findRecord(project, "body", entity.id);
      return body && <BodyCard body={body} />;
    }
    case "body-patch":
      return <BodyPatchCard patch={entity.id} />;
    case "background-node": {
      const node = findRecord(project, "background-node", entity.id);
      return node && <NodeEditor node={node} project={project} />;
    }
    case "source": {
      const source = findRecord(project, "source", entity.id);
      return source && <SourceEditor source={source} project={project} />;
    }
  }
}
