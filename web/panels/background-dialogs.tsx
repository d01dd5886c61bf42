import { Alert, Button, Checkbox, Group, SegmentedControl, Text } from "@mantine/core";
import { useEffect, useState } from "react";
import type { SizeProposal } from "tetrafront";
import { applyProposal, coverModel, likelySize } from "../commands/background-actions";
import { estimateTetrahedra } from "../document/estimate";
import { ApplyButton, DialogForm } from "../ui/dialog-form";
import { FieldRow } from "../ui/field-row";
import { formatCount, formatShort } from "../ui/format";
import { FramedDialog } from "../ui/framed-dialog";
import { NumberField } from "../ui/number-field";
import { strings } from "../ui/strings";
import { useApp, useProject, useRun, useShell } from "./app-context";
import { aboveZero, notNegative, sizeStep } from "./size-fields";

const texts = strings.background;

export function CoverDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "cover");
  const close = (): void => app.shell.setState({ dialog: null });
  return (
    <FramedDialog opened={opened} title={texts.cover} onClose={close}>
      <CoverForm onClose={close} />
    </FramedDialog>
  );
}

function CoverForm({ onClose }: { readonly onClose: () => void }) {
  const app = useApp();
  const hasGrid = useProject().background.nodes.length > 0;
  const [shape, setShape] = useState<"box" | "tetrahedron">("box");
  const [size, setSize] = useState(() => likelySize(app));
  return (
    <DialogForm
      onApply={() => {
        onClose();
        void coverModel(app, { size, shape });
      }}
    >
      <Text size="sm" c="dimmed" mb={8}>
        {texts.coverHint}
      </Text>
      <FieldRow label={texts.shape}>
        <SegmentedControl
          size="xs"
          fullWidth
          aria-label={texts.shape}
          data={[
            { value: "box", label: texts.box },
            { value: "tetrahedron", label: texts.tetrahedron },
          ]}
          value={shape}
          onChange={setShape}
        />
      </FieldRow>
      <FieldRow label={strings.inspector.size}>
        <NumberField
          label={strings.inspector.size}
          value={size}
          step={sizeStep(size)}
          refuse={aboveZero}
          testId="cover-size"
          onCommit={setSize}
        />
      </FieldRow>
      {hasGrid && (
        <Text size="sm" c="dimmed">
          {texts.replaces}
        </Text>
      )}
      <Group justify="flex-end" gap="xs" mt={12}>
        <Button size="xs" variant="default" onClick={onClose}>
          {texts.cancel}
        </Button>
        <ApplyButton data-testid="cover-apply">{texts.make}</ApplyButton>
      </Group>
    </DialogForm>
  );
}

export function ProposeDialog() {
  const app = useApp();
  const opened = useShell((state) => state.dialog === "propose");
  const close = (): void => app.shell.setState({ dialog: null });
  return (
    <FramedDialog opened={opened} title={texts.propose} onClose={close}>
      <ProposeForm onClose={close} />
    </FramedDialog>
  );
}

interface Wishes {
  readonly uniform: number;
  readonly smallest: number;
  readonly elementsPerCircle: number;
  readonly elementsPerGap: number;
  readonly growth: number;
}

type WishField = keyof Wishes;

const wishFields: readonly { field: WishField; step: number; zero: boolean }[] = [
  { field: "uniform", step: 0.01, zero: false },
  { field: "smallest", step: 0.001, zero: false },
  { field: "elementsPerCircle", step: 1, zero: true },
  { field: "elementsPerGap", step: 1, zero: true },
  { field: "growth", step: 0.05, zero: true },
];

/** The smallest size proposed, as a share of the largest, unless the user says otherwise. */
const smallestShare = 0.05;

/** Above this many tetrahedra a proposal is not applied without a warning. */
const mostTetrahedra = 500_000;

/** Beyond what brings the count down to the limit, for it is an estimate. */
const margin = 1.05;

/**
 * The same wishes with a larger smallest size, so that there are no more elements than the limit; the
 * largest size grows too where it is smaller, or where there is nothing but it.
 */
const coarser =
  ({ proposal, tetrahedra }: Answer) =>
  (wishes: Wishes): Wishes => {
    // The count falls with the cube of the size, in plates with its square.
    const factor = margin * Math.sqrt((tetrahedra ?? 0) / mostTetrahedra);
    const round = (size: number): number => Number(size.toPrecision(2));
    const found = proposal.sources.reduce((least, { size }) => Math.min(least, size), Infinity);
    if (!Number.isFinite(found)) return { ...wishes, uniform: round(factor * wishes.uniform) };
    const smallest = round(factor * Math.max(found, wishes.smallest));
    return { ...wishes, smallest, uniform: Math.max(smallest, wishes.uniform) };
  };

interface Answer {
  /** What the answer belongs to: it does not hold for other wishes. */
  readonly wishes: Wishes;
  readonly proposal: SizeProposal;
  readonly tetrahedra: number | null;
}

function ProposeForm({ onClose }: { readonly onClose: () => void }) {
  const app = useApp();
  const project = useProject();
  const presentSources = project.background.sources?.length ?? 0;
  const [wishes, setWishes] = useState<Wishes>(() => {
    const uniform = likelySize(app);
    const smallest = Number((smallestShare * uniform).toPrecision(2));
    return { uniform, smallest, elementsPerCircle: 24, elementsPerGap: 3, growth: 0.3 };
  });
  const [cover, setCover] = useState(true);
  const [replaceSources, setReplaceSources] = useState(true);
  const { answer, failure } = useProposal(wishes);
  const apply = (): void => {
    // A value that was committed just now has no answer yet.
    if (!answer) return;
    onClose();
    void applyProposal(app, answer.proposal, { cover, replaceSources });
  };
  const tooMany = (answer?.tetrahedra ?? 0) > mostTetrahedra;
  return (
    <DialogForm onApply={apply}>
      <Text size="sm" c="dimmed" mb={8}>
        {texts.proposeHint}
      </Text>
      {wishFields.map(({ field, step, zero }) => (
        <FieldRow key={field} label={texts.wishes[field]}>
          <NumberField
            label={texts.wishes[field]}
            value={wishes[field]}
            step={step}
            refuse={zero ? notNegative : aboveZero}
            testId={`propose-${field}`}
            onCommit={(value) => setWishes((present) => ({ ...present, [field]: value }))}
          />
        </FieldRow>
      ))}
      <Checkbox
        size="xs"
        my={8}
        label={texts.coverToo}
        checked={cover}
        onChange={(event) => setCover(event.currentTarget.checked)}
      />
      {presentSources > 0 && (
        <Checkbox
          size="xs"
          my={8}
          label={texts.replaceSources(presentSources)}
          checked={replaceSources}
          onChange={(event) => setReplaceSources(event.currentTarget.checked)}
        />
      )}
      <ProposalSummary answer={answer} failure={failure} />
      {tooMany && (
        <Alert mt={8} p={8} color="orange" data-testid="proposal-too-many">
          {texts.tooMany}
          <Button
            mt={6}
            size="compact-xs"
            variant="default"
            data-testid="propose-coarser"
            onClick={() => answer && setWishes(coarser(answer))}
          >
            {texts.coarser(formatCount(mostTetrahedra))}
          </Button>
        </Alert>
      )}
      <Group justify="flex-end" gap="xs" mt={12}>
        <Button size="xs" variant="default" onClick={onClose}>
          {texts.cancel}
        </Button>
        <ApplyButton
          data-testid="propose-apply"
          disabled={answer === null}
          {...(tooMany && { color: "orange" })}
        >
          {tooMany ? texts.applyAnyway : texts.apply}
        </ApplyButton>
      </Group>
    </DialogForm>
  );
}

/** What the engine proposes for these wishes, and how many elements that would make. */
function useProposal(wishes: Wishes): { readonly answer: Answer | null; readonly failure: string | null } {
  const app = useApp();
  const [answer, setAnswer] = useState<Answer | null>(null);
  const [failure, setFailure] = useState<string | null>(null);
  useEffect(() => {
    let stopped = false;
    const ask = async (): Promise<void> => {
      const proposal = await (await app.mesher).proposeSizes(app.documents.project, wishes);
      const { preview } = app.previews.state.getState();
      const tetrahedra = preview
        ? await estimateTetrahedra(preview, proposal.size, proposal.sources, () => stopped)
        : null;
      if (!stopped) setAnswer({ wishes, proposal, tetrahedra });
    };
    setFailure(null);
    ask().catch((error: unknown) => {
      if (!stopped) setFailure(error instanceof Error ? error.message : String(error));
    });
    return () => {
      stopped = true;
    };
  }, [app, wishes]);
  return { answer: answer?.wishes === wishes ? answer : null, failure };
}

interface ProposalSummaryProps {
  readonly answer: Answer | null;
  readonly failure: string | null;
}

function ProposalSummary({ answer, failure }: ProposalSummaryProps) {
  const present = useRun((state) => state.mesh?.report.tetrahedra);
  const smallest = answer?.proposal.sources.reduce((least, { size }) => Math.min(least, size), Infinity);
  return (
    <div className="tf-proposal" role="status" data-testid="proposal">
      {failure ?? (answer === null ? texts.asking : null)}
      {answer && (
        <dl className="tf-facts">
          <dt>{texts.largest}</dt>
          <dd>{formatShort(answer.proposal.size)}</dd>
          <dt>{texts.sources}</dt>
          <dd data-testid="proposal-sources">{formatCount(answer.proposal.sources.length)}</dd>
          {smallest !== undefined && Number.isFinite(smallest) && (
            <>
              <dt>{texts.smallestFound}</dt>
              <dd>{formatShort(smallest)}</dd>
            </>
          )}
          <dt>{texts.expected}</dt>
          <dd data-testid="proposal-count">
            {answer.tetrahedra === null
              ? strings.quality.unmeasured
              : texts.about(formatCount(Number(answer.tetrahedra.toPrecision(2))))}
          </dd>
          {present !== undefined && present > 0 && (
            <>
              <dt>{texts.present}</dt>
              <dd>{formatCount(present)}</dd>
            </>
          )}
        </dl>
      )}
    </div>
  );
}
