import { Switch, Text } from "@mantine/core";
import type { SecondOrderQuality } from "tetrafront";
import { useStore } from "zustand";
import { showElement } from "../../commands/selection-actions";
import { bestValue, scalePosition, worstShown } from "../../document/mesh-quality";
import { strings } from "../../strings";
import { formatCount } from "../../strings/format";
import { Explained } from "../../ui/explained";
import { Facts } from "../../ui/facts";
import { SectionTitle } from "../../ui/frames/section-title";
import { HistogramChart } from "../../ui/histogram-chart";
import { TextButton } from "../../ui/text-button";
import { viridisAt } from "../../ui/theme/viridis";
import { useApp, useRun, useView } from "../shared/app-context";

const texts = strings.secondOrder;
const ticks = [0, 0.25, 0.5, 0.75, 1];
const valueText = (value: number): string => value.toFixed(3);
const colorOf = (value: number): string =>
  viridisAt(
    scalePosition(Math.max(value * bestValue["radius-ratio"], worstShown["radius-ratio"]), "radius-ratio"),
  );

/** Chooses second-order elements, and says what they are like. */
export function SecondOrderSection() {
  const { secondOrder } = useApp();
  const { isOn, failure } = useStore(secondOrder.state);
  const mesh = useRun((state) => state.mesh);
  const quality = mesh?.report.secondOrder;
  return (
    <section aria-label={texts.title} data-testid="second-order">
      <Switch
        size="xs"
        my={10}
        label={texts.title}
        title={texts.hint}
        checked={isOn}
        onChange={(event) => secondOrder.setOn(event.currentTarget.checked)}
      />
      {isOn && failure !== null && (
        <Text size="sm" role="alert">
          {failure}
        </Text>
      )}
      {isOn && quality && (
        <>
          {!mesh.mesh.curvedEdges && (
            <Text size="xs" c="dimmed" mb={6}>
              {texts.straight}
            </Text>
          )}
          <ScaledJacobians quality={quality} />
        </>
      )}
    </section>
  );
}

function ScaledJacobians({ quality }: { readonly quality: SecondOrderQuality }) {
  const { minScaledJacobian, meanScaledJacobian, histogram, straightened, worst } = quality;
  return (
    <>
      <Text size="sm" c="dimmed" mb={4}>
        <Explained name={texts.scaledJacobian} meaning={texts.meaning} />
      </Text>
      <HistogramChart
        bars={histogram}
        end={1}
        ticks={ticks}
        testId="chart-scaled-jacobian"
        label={strings.quality.histogram(texts.scaledJacobian)}
        colorOf={colorOf}
        describe={(count, from, to) =>
          strings.quality.bar(formatCount(count), from.toFixed(2), to.toFixed(2))
        }
        facts={[
          [strings.quality.min, valueText(minScaledJacobian)],
          [strings.quality.mean, valueText(meanScaledJacobian)],
        ]}
      />
      <Facts>
        <dt>{texts.straightened}</dt>
        <dd data-testid="straightened">{formatCount(straightened.length)}</dd>
      </Facts>
      {worst.length > 0 && <WorstElements worst={worst} />}
    </>
  );
}

function WorstElements({ worst }: Pick<SecondOrderQuality, "worst">) {
  const app = useApp();
  const highlighted = useView((state) => state.element);
  return (
    <section aria-label={texts.worst}>
      <SectionTitle>{texts.worst}</SectionTitle>
      <Facts>
        {worst.map(({ tetrahedron, scaledJacobian }) => (
          <WorstElement
            key={tetrahedron}
            text={valueText(scaledJacobian)}
            tetrahedron={tetrahedron}
            isHighlighted={tetrahedron === highlighted}
            onShow={() => void showElement(app, tetrahedron)}
          />
        ))}
      </Facts>
    </section>
  );
}

interface WorstElementProps {
  readonly tetrahedron: number;
  readonly text: string;
  readonly isHighlighted: boolean;
  readonly onShow: () => void;
}

function WorstElement({ tetrahedron, text, isHighlighted, onShow }: WorstElementProps) {
  return (
    <>
      <dt>
        <TextButton aria-pressed={isHighlighted} onClick={onShow}>
          {texts.element(formatCount(tetrahedron))}
        </TextButton>
      </dt>
      <dd>{text}</dd>
    </>
  );
}
