import { ActionIcon, Select, Text, Tooltip, UnstyledButton } from "@mantine/core";
import { IconArrowBackUp, IconTrash } from "@tabler/icons-react";
import type { PatchType, Project, ProjectPatch } from "tetrafront";
import { setPatchLoops, setPatchType } from "../document/edits";
import { turnToSecond } from "../document/loops";
import { patchMisfit, patchRules, patchTypes } from "../document/patch-rules";
import { FieldRow } from "../ui/field-row";
import { ListField } from "../ui/list-field";
import { patchTypeHints, patchTypeNames, strings } from "../ui/strings";
import { useApp } from "./app-context";
import { EntityChips, entityTitle } from "./entity-chips";

const options = patchTypes.map((value) => ({ value, label: patchTypeNames[value] }));

export interface PatchEditorProps {
  readonly patch: ProjectPatch;
  readonly project: Project;
}

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

/** The type, what it is spanned by, and, before one is chosen, what speaks against the others. */
function TypeField({ patch, project }: PatchEditorProps) {
  const app = useApp();
  const misfitOf = (type: PatchType): string | null => patchMisfit(project, type, patch.loops);
  const misfit = misfitOf(patch.type);
  return (
    <FieldRow label={strings.inspector.type}>
      <Select
        size="xs"
        aria-label={strings.inspector.type}
        data-testid="patch-kind"
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
            <span className="tf-option" data-misfit={wrong !== null || undefined}>
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

/** A loop as numbers to type, and as lines to click; for eq. (14) also with their roles. */
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
        <div className="tf-with-button">
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
        <RoleList
          project={project}
          loop={loop}
          onSecond={(position) => setLoops(patch.loops.with(0, turnToSecond(loop, position)))}
        />
      ) : (
        <EntityChips
          project={project}
          entities={[...new Set(loop.map(Math.abs))].map((id) => ({ kind: "line", id }))}
        />
      )}
    </FieldRow>
  );
}

interface RoleListProps {
  readonly project: Project;
  readonly loop: readonly number[];
  readonly onSecond: (position: number) => void;
}

/** The lines F1, F2 and F3 of equation (14), and a way to give F2's role to another. */
function RoleList({ project, loop, onSecond }: RoleListProps) {
  const app = useApp();
  return (
    <>
      <ol className="tf-roles" aria-label={strings.inspector.lines}>
        {loop.map((step, position) => {
          const entity = { kind: "line", id: Math.abs(step) } as const;
          const title = entityTitle(project, entity);
          const second = position === 1;
          return (
            <li key={step} data-second={second || undefined}>
              <b data-testid={`role-${entity.id}`}>F{position + 1}</b>
              <UnstyledButton
                className="tf-role-line"
                onClick={() => app.view.select(entity)}
                onMouseEnter={() => app.view.setHover(entity)}
                onMouseLeave={() => app.view.setHover(null)}
              >
                {title}
              </UnstyledButton>
              {step < 0 && <IconArrowBackUp size={14} role="img" aria-label={strings.inspector.backwards} />}
              {!second && (
                <UnstyledButton
                  className="tf-chip"
                  aria-label={strings.inspector.makeSecond(title)}
                  data-testid={`make-second-${entity.id}`}
                  onClick={() => onSecond(position)}
                >
                  {strings.inspector.makeSecondShort}
                </UnstyledButton>
              )}
            </li>
          );
        })}
      </ol>
      <Text size="xs" c="dimmed" mt={4}>
        {strings.inspector.secondRole}
      </Text>
    </>
  );
}
