import { Text } from "@mantine/core";
import { IconTrash } from "@tabler/icons-react";
import type { PatchType, Project, ProjectPatch } from "tetrafront/project";
import { setPatchLoops, setPatchType } from "../../document/edits";
import { rotateToSecond } from "../../document/loops";
import { patchMisfit, patchRules, patchTypes } from "../../document/patch-rules";
import { FieldRow } from "../../ui/fields/field-row";
import { ListField } from "../../ui/fields/list-field";
import { IconButton } from "../../ui/icon-button";
import { patchTypeHints, patchTypeNames, strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { EntityChips } from "../shared/entity-chips";
import styles from "./patch-editor.module.css";
import { PatchRoleList } from "./patch-role-list";
import { refuseIds } from "./refuse-ids";
import { TypeSelect } from "./type-select";

const options = patchTypes.map((value) => ({ value, label: patchTypeNames[value] }));

export interface PatchEditorProps {
  readonly patch: ProjectPatch;
  readonly project: Project;
}

/** The type and the loops of a patch. */
export function PatchEditor({ patch, project }: PatchEditorProps) {
  const { loops } = patch;
  return (
    <>
      <TypeField patch={patch} project={project} />
      {loops.map((loop, index) => (
        <LoopFields key={`${patch.id}-${index}`} patch={patch} project={project} loop={loop} index={index} />
      ))}
      {patchRules[patch.type].loops === null && patch.type !== "loft" && (
        <Text size="xs" c="dimmed" mb={6}>
          {strings.inspector.holeHint}
        </Text>
      )}
    </>
  );
}

/** The type of a patch. The list shows which lines each type needs, or why the loops do not fit it. */
function TypeField({ patch, project }: PatchEditorProps) {
  const app = useApp();
  const misfitOf = (type: PatchType): string | null => patchMisfit(project, type, patch.loops);
  return (
    <FieldRow label={strings.inspector.type}>
      <TypeSelect
        types={options}
        value={patch.type}
        testId="patch-type"
        comboboxProps={{ width: 260, position: "bottom-end" }}
        maxDropdownHeight={420}
        error={misfitOf(patch.type)}
        renderOption={({ value, label }) => {
          const misfit = misfitOf(value);
          return (
            <span className={styles["option"]} data-misfit={misfit !== null || undefined}>
              <b>{label}</b>
              <small>{misfit ?? patchTypeHints[value]}</small>
            </span>
          );
        }}
        onChange={(type) => app.documents.edit(setPatchType(patch.id, type))}
      />
      <Text size="xs" c="dimmed" mt={4} data-testid="patch-hint">
        {patchTypeHints[patch.type]}
      </Text>
    </FieldRow>
  );
}

interface LoopFieldsProps extends PatchEditorProps {
  readonly loop: readonly number[];
  readonly index: number;
}

/** A loop as a list of ids to type and as lines to click; for equation (14) also with the roles of the lines. */
function LoopFields({ patch, project, loop, index }: LoopFieldsProps) {
  const app = useApp();
  const rule = {
    known: new Set(project.lines.map(({ id }) => id)),
    atLeast: 1,
    tooFew: strings.fields.oneLine,
    unknown: strings.fields.unknownLine,
  };
  const setLoops = (loops: readonly (readonly number[])[]): void =>
    app.documents.edit(setPatchLoops(patch.id, loops));
  const isRim = patch.type === "tube";
  const isSection = patch.type === "loft";
  const further = isSection ? strings.inspector.section(index) : strings.inspector.hole(index);
  const named = index === 0 ? strings.inspector.outerLoop : further;
  const removeFurther = isSection
    ? strings.inspector.removeSection(index)
    : strings.inspector.removeHole(index);
  const label = isRim ? strings.inspector.rim(index + 1) : named;
  const hasRoles = index === 0 && patch.type === "barnhill-gregory-nielson" && loop.length === 3;
  const list = (
    <ListField
      label={`${label}. ${strings.inspector.loopHint}`}
      values={loop}
      refuse={(steps) => refuseIds(steps, rule)}
      testId={`patch-loop-${index}`}
      onCommit={(steps) => setLoops(patch.loops.with(index, steps))}
    />
  );
  return (
    <FieldRow label={label}>
      {index === 0 ? (
        list
      ) : (
        <div className={styles["hole"]}>
          {list}
          <IconButton
            label={isRim ? strings.inspector.removeRim : removeFurther}
            size={28}
            onClick={() => setLoops(patch.loops.filter((_, other) => other !== index))}
          >
            <IconTrash size={15} aria-hidden />
          </IconButton>
        </div>
      )}
      {hasRoles ? (
        <PatchRoleList
          project={project}
          loop={loop}
          onSecond={(index) => setLoops(patch.loops.with(0, rotateToSecond(loop, index)))}
        />
      ) : (
        <EntityChips
          project={project}
          paddingTop={5}
          entities={[...new Set(loop.map(Math.abs))].map((id) => ({ kind: "line", id }))}
        />
      )}
    </FieldRow>
  );
}
