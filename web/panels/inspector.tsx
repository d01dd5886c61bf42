import { Badge, Text } from "@mantine/core";
import type { Project } from "tetrafront";
import { useMemo } from "react";
import { renameEntity, renameProject } from "../document/edits";
import { dependentsOf, entityKey, entityName, findRecord, type Entity } from "../document/entities";
import { qualityOf } from "../document/mesh-quality";
import { FieldRow, SectionTitle } from "../ui/field-row";
import { formatAngle } from "../ui/format";
import { NameField } from "../ui/name-field";
import { entityWords, measureNames, strings } from "../ui/strings";
import { useApp, useProblems, useProject, useRun, useView } from "./app-context";
import { ElementSize } from "./element-size";
import { EntityChips } from "./entity-chips";
import { LineEditor, NodeEditor, PointEditor, SourceEditor } from "./entity-editors";
import { EntityIcon } from "./entity-icon";
import { ProblemCard } from "./problem-card";
import { PatchEditor } from "./patch-editor";
import { QualityPanel } from "./quality-panel";
import { MakeOfSelection, SelectionCard } from "./selection-card";

/** What is selected, to be edited; and the mesh's quality. */
export function Inspector() {
  const selection = useView((state) => state.selection);
  const element = useView((state) => state.element);
  const [only] = selection;
  return (
    <div
      className="tf-scroll tf-pad"
      data-testid="inspector"
      tabIndex={0}
      role="region"
      aria-label={strings.inspector.title}
    >
      {element !== null && <ElementCard tetrahedron={element} />}
      {element === null && selection.length === 0 && <ProjectCard />}
      {selection.length > 1 && <SelectionCard selection={selection} />}
      {selection.length === 1 && only && <EntityCard entity={only} />}
      <QualityPanel />
    </div>
  );
}

function ProjectCard() {
  const app = useApp();
  const project = useProject();
  return (
    <>
      <SectionTitle>{strings.inspector.project}</SectionTitle>
      <FieldRow label={strings.inspector.name}>
        <NameField
          label={strings.inspector.name}
          value={project.name}
          placeholder={strings.inspector.project}
          testId="project-name"
          onCommit={(name) => app.documents.edit(renameProject(name))}
        />
      </FieldRow>
      {project.description !== undefined && (
        <Text size="sm" c="dimmed" my={6}>
          {project.description}
        </Text>
      )}
      <Text size="sm" c="dimmed">
        {strings.inspector.nothingSelected}
      </Text>
      <ElementSize />
    </>
  );
}

function EntityCard({ entity }: { readonly entity: Entity }) {
  const app = useApp();
  const project = useProject();
  const problems = useProblems((state) => state.byEntity.get(entityKey(entity)));
  const record = findRecord(project, entity.kind, entity.id);
  const dependents = useMemo(() => dependentsOf(project, entity), [project, entity]);
  if (!record) return <ProjectCard />;
  const name = entityName(project, entity) ?? "";
  const fallback = `${entityWords[entity.kind].one} ${entity.id}`;
  return (
    <>
      <div className="tf-card-title">
        <EntityIcon entity={entity} project={project} />
        <Text fw={600} size="md" component="h2">
          {name === "" ? fallback : name}
        </Text>
        {name !== "" && (
          <Text size="sm" c="dimmed">
            {fallback.toLowerCase()}
          </Text>
        )}
        {!problems && (
          <Badge size="sm" variant="outline" color="var(--tf-success)" className="tf-valid">
            {strings.inspector.valid}
          </Badge>
        )}
      </div>
      {entity.kind !== "background-node" && (
        <FieldRow label={strings.inspector.name}>
          <NameField
            key={entityKey(entity)}
            label={strings.inspector.name}
            value={name}
            placeholder={fallback}
            testId="entity-name"
            onCommit={(next) => app.documents.edit(renameEntity(entity, next))}
          />
        </FieldRow>
      )}
      <EntityFields entity={entity} project={project} />
      <MakeOfSelection selection={[entity]} />
      {dependents.length > 0 && (
        <FieldRow label={strings.inspector.usedBy}>
          <EntityChips entities={dependents} project={project} />
        </FieldRow>
      )}
      {problems?.map((problem) => (
        <ProblemCard key={problem.key} problem={problem} />
      ))}
    </>
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

/** A tetrahedron picked on a cut. */
function ElementCard({ tetrahedron }: { readonly tetrahedron: number }) {
  const volume = useRun((state) => state.mesh?.volume);
  if (!volume) return null;
  const nodes = [...volume.tetrahedra.subarray(4 * tetrahedron, 4 * tetrahedron + 4)];
  return (
    <>
      <SectionTitle>{strings.inspector.element(String(tetrahedron))}</SectionTitle>
      <dl className="tf-facts">
        <dt>{strings.inspector.elementNodes}</dt>
        <dd>{nodes.join(", ")}</dd>
        <dt>{measureNames["radius-ratio"]}</dt>
        <dd>{(qualityOf(volume, "radius-ratio")[tetrahedron] ?? 0).toFixed(3)}</dd>
        <dt>{measureNames.dihedral}</dt>
        <dd>{formatAngle(qualityOf(volume, "dihedral")[tetrahedron] ?? 0)}</dd>
      </dl>
    </>
  );
}
