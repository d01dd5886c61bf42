import { Button, SegmentedControl, Switch, Text } from "@mantine/core";
import { IconArrowsExchange } from "@tabler/icons-react";
import type { Layer, Shading, Smoothness } from "../../document/selection";
import { FieldRow } from "../../ui/fields/field-row";
import { measureNames, strings } from "../../strings";
import { formatShortShare } from "../../strings/format";
import { useApp, useRegions, useRun, useView } from "../shared/app-context";
import { RegionList } from "../shared/region-list";
import { CutAxisControl, CutSlider } from "./cut-controls";
import { ScrollPanel } from "../../ui/frames/scroll-panel";
import { SectionTitle } from "../../ui/frames/section-title";

const layers: readonly Layer[] = ["points", "lines", "patches", "bodies", "background", "sources", "mesh"];
const shadings: readonly { value: Shading; label: string }[] = [
  { value: "radius-ratio", label: measureNames["radius-ratio"] },
  { value: "dihedral", label: strings.display.dihedral },
  { value: "region", label: strings.display.region },
  { value: "plain", label: strings.display.plain },
];

/** Layers, shading and cut of the view. */
export function DisplayPanel() {
  const regions = useRegions();
  return (
    <ScrollPanel label={strings.inspector.display}>
      <SectionTitle>{strings.display.layers}</SectionTitle>
      <LayerSwitches />
      <SectionTitle>{strings.display.shading}</SectionTitle>
      <ShadingControls />
      <SectionTitle>{strings.display.patchColors}</SectionTitle>
      <SmoothnessChoice />
      <SectionTitle>{strings.display.mouse}</SectionTitle>
      <MouseChoice />
      <SectionTitle>{strings.display.cut}</SectionTitle>
      <CutSettings />
      {regions.length > 1 && (
        <>
          <SectionTitle>{strings.regions.title}</SectionTitle>
          <RegionList testId="display-region" />
        </>
      )}
    </ScrollPanel>
  );
}

function LayerSwitches() {
  const app = useApp();
  const visible = useView((state) => state.layers);
  const numbers = useView((state) => state.numbers);
  const switches = layers.map((layer) => (
    <Switch
      key={layer}
      size="xs"
      my={6}
      label={strings.display[layer]}
      checked={visible[layer]}
      onChange={(event) => app.view.setLayer(layer, event.currentTarget.checked)}
    />
  ));
  return (
    <>
      {switches}
      <Switch
        size="xs"
        my={6}
        label={strings.display.numbers}
        checked={numbers}
        onChange={(event) => app.view.state.setState({ numbers: event.currentTarget.checked })}
      />
    </>
  );
}

function ShadingControls() {
  const app = useApp();
  const shading = useView((state) => state.shading);
  const edges = useView((state) => state.edges);
  return (
    <>
      <SegmentedControl
        size="xs"
        fullWidth
        aria-label={strings.display.shading}
        data={[...shadings]}
        value={shading}
        onChange={(value) => app.view.state.setState({ shading: value })}
      />
      <Switch
        size="xs"
        my={10}
        label={strings.display.edges}
        checked={edges}
        onChange={(event) => app.view.state.setState({ edges: event.currentTarget.checked })}
      />
    </>
  );
}

const smoothnesses: readonly Smoothness[] = ["none", "zebra", "gaussian", "largest"];

function SmoothnessChoice() {
  const app = useApp();
  const smoothness = useView((state) => state.smoothness);
  return (
    <SegmentedControl
      size="xs"
      fullWidth
      aria-label={strings.display.patchColors}
      data-testid="smoothness"
      data={smoothnesses.map((value) => ({ value, label: strings.display.smoothness[value] }))}
      value={smoothness}
      onChange={(value) => app.view.state.setState({ smoothness: value })}
    />
  );
}

function MouseChoice() {
  const app = useApp();
  const leftDrag = useView((state) => state.leftDrag);
  return (
    <SegmentedControl
      size="xs"
      fullWidth
      aria-label={strings.display.mouse}
      data={(["select", "orbit"] as const).map((value) => ({
        value,
        label: strings.display.leftDrag[value],
      }))}
      value={leftDrag}
      onChange={(value) => app.view.state.setState({ leftDrag: value })}
    />
  );
}

/** Says what the regular elements are that the cut shows. */
function LatticeNote() {
  const lattice = useRun(({ mesh }) => mesh?.report.interior.lattice ?? 0);
  const tetrahedra = useRun(({ mesh }) => mesh?.report.tetrahedra ?? 0);
  if (lattice === 0) return null;
  return (
    <Text size="xs" c="dimmed" mt={6}>
      {strings.display.lattice(formatShortShare(lattice / tetrahedra))}
    </Text>
  );
}

function CutSettings() {
  const app = useApp();
  const cut = useView((state) => state.cut);
  return (
    <>
      <Switch
        size="xs"
        my={6}
        label={strings.display.cutOn}
        checked={cut.enabled}
        onChange={(event) => app.view.setCut({ enabled: event.currentTarget.checked })}
      />
      <FieldRow label={strings.display.cutAxis}>
        <CutAxisControl />
      </FieldRow>
      <FieldRow label={strings.display.cutPosition}>
        <CutSlider />
      </FieldRow>
      <Button
        size="compact-sm"
        mt={8}
        variant="default"
        leftSection={<IconArrowsExchange size={14} aria-hidden />}
        disabled={!cut.enabled}
        onClick={() => app.view.setCut({ flipped: !cut.flipped })}
      >
        {strings.display.flip}
      </Button>
      {cut.enabled && <LatticeNote />}
    </>
  );
}
