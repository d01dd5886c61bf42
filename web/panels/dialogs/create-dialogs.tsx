import { Group, Text } from "@mantine/core";
import { useRef, useState } from "react";
import { create } from "../../commands/creation-actions";
import { addBackgroundNode, addPoint } from "../../document/create";
import { addPoints, readPositionList } from "../../document/position-list";
import { recordsOf } from "../../document/entities";
import { ApplyButton, DialogForm } from "../../ui/frames/dialog-form";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { NumberRow } from "../../ui/fields/number-row";
import { PositionRow } from "../../ui/fields/position-row";
import { entityWords, strings } from "../../strings";
import { useApp, useProject, useShell } from "../shared/app-context";
import { aboveZero, stepFor } from "../shared/size-fields";

type PositionedKind = "point" | "background-node";
type Position = readonly [number, number, number];
/** What the coordinates were typed as; null for plain numbers. */
type Expressions = readonly [string | null, string | null, string | null];

const dialogOf = { point: "new-point", "background-node": "new-node" } as const;

/** Creates a point or a background node at a position that the user types. */
export function CreatePositionedDialog({ kind }: { readonly kind: PositionedKind }) {
  const app = useApp();
  const opened = useShell((state) => state.dialog === dialogOf[kind]);
  return (
    <FramedDialog
      opened={opened}
      title={kind === "point" ? strings.create.point : strings.create.node}
      onClose={() => app.shell.setState({ dialog: null })}
    >
      <PositionForm kind={kind} />
    </FramedDialog>
  );
}

/** The values typed into the form, and what was added last. */
function useNewEntity(kind: PositionedKind) {
  const app = useApp();
  const project = useProject();
  const last = recordsOf(project, kind).at(-1);
  const [position, setPosition] = useState<Position>(() => last?.position ?? [0, 0, 0]);
  const [expressions, setExpressions] = useState<Expressions>([null, null, null]);
  const [size, setSize] = useState(() => recordsOf(project, "background-node").at(-1)?.size ?? 0.1);
  const [added, setAdded] = useState<string | null>(null);
  const add = (): void => {
    const current = app.documents.project;
    const creation =
      kind === "point"
        ? addPoint(current, position, expressions)
        : addBackgroundNode(current, position, size);
    create(app, creation);
    const [entity] = creation.entities;
    setAdded(entity ? `${entityWords[kind].one.toLowerCase()} ${entity.id}` : null);
  };
  const setCoordinate = (axis: 0 | 1 | 2, value: number, expression: string | null): void => {
    setPosition(([x, y, z]) => with3([x, y, z], axis, value));
    setExpressions(([x, y, z]) => with3([x, y, z], axis, expression));
  };
  /** Takes a pasted list: one position fills the fields, several become points at once. Returns false for other texts. */
  const paste = (text: string): boolean => {
    const positions = readPositionList(text) ?? [];
    const [first] = positions;
    if (!first || (positions.length > 1 && kind !== "point")) return false;
    setPosition(positions.at(-1) ?? first);
    setExpressions([null, null, null]);
    if (positions.length === 1) return true;
    create(app, addPoints(app.documents.project, positions));
    setAdded(strings.create.points(positions.length));
    return true;
  };
  return { position, expressions, setCoordinate, size, setSize, added, add, paste };
}

/** Keeps the coordinates for the next point, because points often share some. */
function PositionForm({ kind }: { readonly kind: PositionedKind }) {
  const app = useApp();
  const project = useProject();
  const { position, expressions, setCoordinate, size, setSize, added, add, paste } = useNewEntity(kind);
  const fields = useRef<HTMLDivElement>(null);
  const apply = (action: string): void => {
    add();
    if (action !== "add") fields.current?.querySelector("input")?.focus();
    else app.shell.setState({ dialog: null });
  };
  return (
    <DialogForm onApply={apply}>
      <div
        ref={fields}
        onPaste={(event) => {
          if (paste(event.clipboardData.getData("text/plain"))) event.preventDefault();
        }}
      >
        <PositionRow
          label={strings.create.position}
          value={position}
          step={stepFor(project)}
          testId="new"
          first
          {...(kind === "point" && { expressions: expressions.map((text) => text ?? undefined) })}
          onCommit={setCoordinate}
        />
      </div>
      {kind === "point" && (
        <Text size="xs" c="dimmed">
          {strings.create.pasteHint}
        </Text>
      )}
      {kind === "background-node" && <SizeRow size={size} onCommit={setSize} />}
      <Text size="sm" c="dimmed" role="status" mih={20} mt={6}>
        {added !== null && strings.create.added(added)}
      </Text>
      <Group justify="flex-end" gap="xs" mt={8}>
        <ApplyButton action="add" data-testid="add">
          {strings.create.addClose}
        </ApplyButton>
        <ApplyButton data-testid="add-next">{strings.create.addNext}</ApplyButton>
      </Group>
    </DialogForm>
  );
}

interface SizeRowProps {
  readonly size: number;
  readonly onCommit: (size: number) => void;
}

function SizeRow({ size, onCommit }: SizeRowProps) {
  return (
    <>
      <NumberRow
        label={strings.create.size}
        value={size}
        step={0.01}
        refuse={aboveZero}
        testId="new-size"
        onCommit={onCommit}
      />
      <Text size="xs" c="dimmed">
        {strings.create.nodeHint}
      </Text>
    </>
  );
}

function with3<Item>(
  [x, y, z]: readonly [Item, Item, Item],
  axis: 0 | 1 | 2,
  value: Item,
): readonly [Item, Item, Item] {
  return [axis === 0 ? value : x, axis === 1 ? value : y, axis === 2 ? value : z];
}
