import { Select, SegmentedControl, Text } from "@mantine/core";
import { useEffect, useRef, useState } from "react";
import { useStore } from "zustand";
import { adaptMesh } from "../../commands/solution-actions";
import { forecast, type AdaptationForecast, type Norm, type Target } from "../../session/adaptation";
import { failureText } from "../../session/failure-text";
import { LatestTask, pause } from "../../session/latest-task";
import type { MeshField, SolvedMesh } from "../../session/solutions";
import { solutionStrings as texts } from "../../strings/solution";
import { FieldRow } from "../../ui/fields/field-row";
import { NumberRow } from "../../ui/fields/number-row";
import { DialogButtons } from "../../ui/frames/dialog-buttons";
import { ApplyButton, DialogForm } from "../../ui/frames/dialog-form";
import { FramedDialog } from "../../ui/frames/framed-dialog";
import { useApp } from "../shared/app-context";
import { aboveZero } from "../shared/size-fields";

/** Adapts the shown mesh to one of its fields. Mounted while it is open. */
export function AdaptDialog() {
  const app = useApp();
  const { meshes, at, choice } = useStore(app.solutions.state);
  const solved = at === null ? undefined : meshes[at];
  const close = (): void => app.shell.setState({ dialog: null });
  return (
    <FramedDialog opened title={texts.adaptTitle} onClose={close}>
      {solved && <AdaptForm solved={solved} first={choice?.name} onClose={close} />}
    </FramedDialog>
  );
}

interface AdaptFormProps {
  readonly solved: SolvedMesh;
  /** Name of the field that is chosen at first. */
  readonly first: string | undefined;
  readonly onClose: () => void;
}

/** Most elements that an adaptation can aim at. */
const maxElements = 2_000_000;

const norms: readonly Norm[] = ["l1", "l2", "l4", "max"];

function AdaptForm({ solved, first, onClose }: AdaptFormProps) {
  const app = useApp();
  const { fields } = solved;
  const [name, setName] = useState(first);
  const [by, setBy] = useState<"elements" | "error">("elements");
  const [elements, setElements] = useState(Math.min(maxElements, 2 * solved.mesh.report.tetrahedra));
  const [error, setError] = useState<number | null>(null);
  const [norm, setNorm] = useState<Norm>("l2");
  const field = fields.find((one) => one.name === name) ?? fields[0];
  const target: Target = by === "elements" || error === null ? { elements, norm } : { error, norm };
  const isUndecided = by === "error" && error === null;
  const { answer, text } = useForecast(solved, field, target);
  const chooseBy = (value: "elements" | "error"): void => {
    // Begin with the error that the present number leads to.
    if (error === null && answer) setError(Number(answer.error.toPrecision(2)));
    setBy(value);
  };
  return (
    <DialogForm
      onApply={() => {
        if (isUndecided) return;
        onClose();
        if (field) void adaptMesh(app, field, target);
      }}
    >
      <Text size="sm" c="dimmed" mb={8}>
        {texts.adaptHint}
      </Text>
      <FieldRow label={texts.field}>
        <Select
          size="xs"
          aria-label={texts.field}
          allowDeselect={false}
          data={fields.map((one) => one.name)}
          value={field?.name ?? null}
          onChange={(value) => setName(value ?? undefined)}
        />
      </FieldRow>
      <FieldRow label={texts.target}>
        <SegmentedControl
          size="xs"
          fullWidth
          aria-label={texts.target}
          data={(["elements", "error"] as const).map((value) => ({ value, label: texts.targets[value] }))}
          value={by}
          onChange={chooseBy}
        />
      </FieldRow>
      {by === "elements" ? (
        <NumberRow
          label={texts.count}
          value={elements}
          step={1000}
          refuse={wholeCount}
          live
          first
          testId="adapt-elements"
          onCommit={setElements}
        />
      ) : (
        <NumberRow
          label={texts.error}
          value={error}
          placeholder=""
          step={(error ?? 1) / 10}
          refuse={aboveZero}
          live
          testId="adapt-error"
          onCommit={setError}
        />
      )}
      <FieldRow label={texts.norm}>
        <SegmentedControl
          size="xs"
          fullWidth
          aria-label={texts.norm}
          data={norms.map((value) => ({ value, label: texts.norms[value] }))}
          value={norm}
          onChange={setNorm}
        />
      </FieldRow>
      <Text size="sm" role="status" data-testid="adapt-forecast">
        {text}
      </Text>
      <DialogButtons cancel={texts.cancel} onCancel={onClose}>
        <ApplyButton disabled={isUndecided} data-testid="adapt-apply">
          {texts.apply}
        </ApplyButton>
      </DialogButtons>
    </DialogForm>
  );
}

const wholeCount = (value: number): string | null =>
  Number.isInteger(value) && value >= 100 && value <= maxElements ? null : texts.wholeElements;

/** Time without a change before sizes are computed, in milliseconds. */
const restMs = 250;

const counting = { answer: null, text: texts.counting } as const;

/** Returns what the adaptation would make, as soon as it is known. */
function useForecast(solved: SolvedMesh, field: MeshField | undefined, { elements, error, norm }: Target) {
  const app = useApp();
  const task = useRef(new LatestTask());
  const [state, setState] = useState<{ readonly answer: AdaptationForecast | null; readonly text: string }>(
    counting,
  );
  useEffect(() => {
    const latest = task.current;
    if (!field) return;
    setState(counting);
    const target = elements === undefined ? { error, norm } : { elements, norm };
    latest
      .run(
        async (signal) => {
          await pause(restMs, signal);
          signal.throwIfAborted();
          return forecast(await app.mesher, solved, field, target, signal);
        },
        (answer) => setState({ answer, text: texts.forecast(answer.elements, answer.error) }),
      )
      .catch((failure: unknown) => setState({ answer: null, text: failureText(failure) }));
    return () => latest.cancel();
  }, [app, solved, field, elements, error, norm]);
  return state;
}
