import { ActionIcon, Select, Text, Tooltip } from "@mantine/core";
import { IconTrash } from "@tabler/icons-react";
import type { PatchType, Project, ProjectPatch } from "tetrafront";
import { setPatchLoops, setPatchType } from "../../document/edits";
import { rotateToSecond } from "../../document/loops";
import { patchMisfit, patchRules, patchTypes } from "../../document/patch-rules";
import { FieldRow } from "../../ui/fields/field-row";
import { ListField } from "../../ui/fields/list-field";
import { patchTypeHints, patchTypeNames, strings } from "../../strings";
import { useApp } from "../shared/app-context";
import { EntityChips } from "../shared/entity-chips";
import styles from "./patch-editor.module.css";
import { PatchRoleList } from "./patch-role-list";

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
      {patchRules[patch.type].holes && (
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
  const misfit = misfitOf(patch.type);
  return (
    <FieldRow label={strings.inspector.type}>
      <Select
        size="xs"
        aria-label={strings.inspector.type}
        data-testid="patch-type"
        allowDeselect={false}
        comboboxProps={{ width: 260, position: "bottom-end" }}
        maxDropdownHeight={420}
        data={options}
        value={patch.type}
        error={misfit}
        renderOption={({ option }) => {
          const type = option.value;
          const wrong = misfitOf(type);
          return (
            <span className={styles["option"]} data-misfit={wrong !== null || undefined}>
              <b>{option.label}</b>
              <small>{wrong ?? patchTypeHints[type]}</small>
            </span>
          );
        }}
        onChange={(value) => {
          if (value !== null) app.documents.edit(setPatchType(patch.id, value));
        }}
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
  const known = new Set(project.lines.map(({ id }) => id));
  const refuse = (steps: readonly number[]): string | null => {
    if (steps.length < 1) return strings.fields.oneLine;
    const unknown = steps.find((step) => !known.has(Math.abs(step)));
    return unknown === undefined ? null : strings.fields.unknownLine(String(Math.abs(unknown)));
  };
  const setLoops = (loops: readonly (readonly number[])[]): void =>
    app.documents.edit(setPatchLoops(patch.id, loops));
  const label = index === 0 ? strings.inspector.outerLoop : strings.inspector.hole(index);
  const hasRoles = index === 0 && patch.type === "barnhill-gregory-nielson" && loop.length === 3;
  const list = (
    <ListField
      label={`${label}. ${strings.inspector.loopHint}`}
      values={loop}
      refuse={refuse}
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
          <Tooltip label={strings.inspector.removeHole(index)} openDelay={400}>
            <ActionIcon
              size={28}
              variant="subtle"
              color="gray"
              aria-label={strings.inspector.removeHole(index)}
              onClick={() => setLoops(patch.loops.filter((_, other) => other !== index))}
            >
              <IconTrash size={15} aria-hidden />
            </ActionIcon>
          </Tooltip>
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
