import { Text } from "@mantine/core";
import type { LengthUnit } from "tetrafront";
import { renameProject } from "../../document/edits";
import { existingIn } from "../../document/entities";
import { qualityIn } from "../../document/mesh-quality";
import { hasLengths, setProjectUnit, unitOf } from "../../document/length-units";
import { FieldRow } from "../../ui/fields/field-row";
import { formatAngle } from "../../strings/format";
import { NameField } from "../../ui/fields/name-field";
import { measuredIn, measureNames, strings } from "../../strings";
import { useApp, useProject, useQualitySpace, useRun, useView } from "../shared/app-context";
import { ElementSize } from "../background/element-size";
import { EntityCard, GroupList, SelectionCard } from "../later/later";
import { useEditedField } from "../entities/use-edited-field";
import { MeshSettings } from "./mesh-settings";
import { ParameterTable } from "./parameter-table";
import { UnitSelect } from "../shared/unit-select";
import { useEditedSetting } from "../shared/use-edited-setting";
import { PanelBoundary } from "../shared/panel-boundary";
import { QualityPanel } from "../quality/quality-panel";
import { ScrollPanel } from "../../ui/frames/scroll-panel";
import { SectionTitle } from "../../ui/frames/section-title";
import { Facts } from "../../ui/facts";

/** The fields of the selection, or of the project, and the quality of the mesh. */
export function Inspector() {
  const selection = useView((state) => state.selection);
  const element = useView((state) => state.element);
  const project = useProject();
  // The selection may hold entities that undo has removed.
  const existing = existingIn(project, selection);
  const [only] = existing;
  return (
    <ScrollPanel label={strings.inspector.title} data-testid="inspector">
      {element !== null && <ElementCard tetrahedron={element} />}
      {element === null && !only && <ProjectCard />}
      {existing.length > 1 && (
        <PanelBoundary>
          <SelectionCard selection={existing} />
        </PanelBoundary>
      )}
      {existing.length === 1 && only && (
        <PanelBoundary>
          <EntityCard entity={only} />
        </PanelBoundary>
      )}
      <QualityPanel />
    </ScrollPanel>
  );
}

function ProjectCard() {
  const app = useApp();
  const project = useProject();
  const changeUnit = (unit: LengthUnit | null): void => {
    const from = unitOf(project.units);
    if (from && unit && from !== unit && hasLengths(project)) app.shell.setState({ chosenUnit: unit });
    else app.documents.edit(setProjectUnit(unit));
  };
  const { name: nameField } = useEditedField();
  const unitField = useEditedSetting("units");
  return (
    <>
      <SectionTitle>{strings.inspector.project}</SectionTitle>
      <div ref={nameField}>
        <FieldRow label={strings.inspector.name}>
          <NameField
            label={strings.inspector.name}
            value={project.name}
            placeholder={strings.inspector.project}
            testId="project-name"
            onCommit={(name) => app.documents.edit(renameProject(name))}
          />
        </FieldRow>
      </div>
      <div ref={unitField}>
        <UnitSelect
          label={strings.units.ofProject}
          value={unitOf(project.units) ?? null}
          without={strings.units.unknown}
          testId="project-unit"
          onChange={changeUnit}
        />
      </div>
      {project.description !== undefined && (
        <Text size="sm" c="dimmed" my={6}>
          {project.description}
        </Text>
      )}
      <Text size="sm" c="dimmed">
        {strings.inspector.nothingSelected}
      </Text>
      {project.groups && (
        <PanelBoundary>
          <GroupList />
        </PanelBoundary>
      )}
      <ParameterTable />
      <ElementSize />
      <MeshSettings />
    </>
  );
}

/** The quality of the tetrahedron that was clicked on a cut. */
function ElementCard({ tetrahedron }: { readonly tetrahedron: number }) {
  const mesh = useRun((state) => state.mesh);
  const space = useQualitySpace();
  if (!mesh) return null;
  const nodes = [...mesh.mesh.tetrahedra.subarray(4 * tetrahedron, 4 * tetrahedron + 4)];
  return (
    <>
      <SectionTitle>{strings.inspector.element(String(tetrahedron))}</SectionTitle>
      <Facts>
        <dt>{strings.inspector.elementNodes}</dt>
        <dd>{nodes.join(", ")}</dd>
        <dt>{measuredIn(measureNames["radius-ratio"], space)}</dt>
        <dd>{qualityIn(mesh, space ?? "space", "radius-ratio", tetrahedron).toFixed(3)}</dd>
        <dt>{measuredIn(measureNames.dihedral, space)}</dt>
        <dd>{formatAngle(qualityIn(mesh, space ?? "space", "dihedral", tetrahedron))}</dd>
      </Facts>
    </>
  );
}
