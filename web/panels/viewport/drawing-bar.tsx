import { NativeSelect, SegmentedControl } from "@mantine/core";
import {
  IconCheck,
  IconGridDots,
  IconKeyboard,
  IconMagnet,
  IconPlaneDeparture,
  IconTriangle,
  type Icon,
} from "@tabler/icons-react";
import { useStore } from "zustand";
import type { LineType, SourceType } from "tetrafront/project";
import { runNamed } from "../../commands/registry";
import { lineTypes } from "../../document/line-types";
import {
  circleWays,
  handleModes,
  toolKinds,
  type CircleBy,
  type Snapping,
  type ToolName,
} from "../../document/tools";
import { principalPlane, principalPlanes } from "../../document/work-plane";
import { lineTypeNames, strings } from "../../strings";
import { IconButton } from "../../ui/icon-button";
import { useApp, useView } from "../shared/app-context";
import { useLayout } from "../shared/use-layout";
import styles from "./drawing.module.css";

const words = strings.drawing;

/** Choices of the active tool: type of line, handles, work plane, snapping; and what to do next. */
export function DrawingBar() {
  const tool = useView((state) => state.tool);
  const lineType = useView((state) => state.lineType);
  const circleBy = useView((state) => state.circleBy);
  const sourceType = useView((state) => state.sourceType);
  const isPhone = useLayout() === "phone";
  if (tool === "select") return null;
  const isCircle = tool === "line" && lineType === "circle";
  const { isDrawing, usesWorkPlane, adds } = toolKinds[tool];
  const hint =
    isCircle && circleBy === "points" ? words.hints.circleThrough : hintOf(tool, lineType, sourceType);
  return (
    <div
      className={styles["bar"]}
      role="group"
      aria-label={words.bar}
      data-lets-through
      data-testid="drawing-bar"
    >
      <div className={styles["choices"]}>
        {tool === "line" && <LineTypeChoice value={lineType} circleBy={circleBy} />}
        {isCircle && !isPhone && <CircleChoice value={circleBy} />}
        {tool === "source" && <SourceTypeChoice value={sourceType} />}
        {tool === "move" && <HandleChoice />}
        {usesWorkPlane && <PlaneChoice />}
        {usesWorkPlane && <SnapSwitches />}
        {isDrawing && usesWorkPlane && <CoordinatesButton />}
        {adds && <FinishButton />}
      </div>
      <Hint text={hint} />
    </div>
  );
}

interface ChoiceProps<Value extends string> {
  readonly label: string;
  readonly names: readonly (readonly [Value, string])[];
  readonly value: Value | null;
  readonly onChange: (value: Value) => void;
  readonly "data-testid"?: string;
}

/** One of several values: beside each other, or on phones, where there is no room for them, in a list that opens. */
function Choice<Value extends string>({ label, names, value, onChange, ...rest }: ChoiceProps<Value>) {
  const isPhone = useLayout() === "phone";
  const choose = (chosen: string): void => {
    const found = names.find(([name]) => name === chosen);
    if (found) onChange(found[0]);
  };
  const data = names.map(([name, text]) => ({ value: name, label: text }));
  const common = { "aria-label": label, ...rest };
  if (!isPhone)
    return <SegmentedControl size="xs" data={data} value={value ?? ""} onChange={choose} {...common} />;
  const none = { value: "", label: words.none, disabled: true };
  return (
    <NativeSelect
      size="sm"
      data={value === null ? [none, ...data] : data}
      value={value ?? ""}
      onChange={(event) => choose(event.currentTarget.value)}
      {...common}
    />
  );
}

interface LineTypeProps {
  readonly value: LineType;
  readonly circleBy: CircleBy;
}

/** On phones, a circle through points is one of the types: there is no room for a second choice. */
function LineTypeChoice({ value, circleBy }: LineTypeProps) {
  const app = useApp();
  const isPhone = useLayout() === "phone";
  const types = [...lineTypes].map((type) => [type, lineTypeNames[type]] as const);
  const isThroughPoints = isPhone && value === "circle" && circleBy === "points";
  return (
    <Choice
      label={words.lineType}
      names={isPhone ? [...types, ["circle-points", words.circleThroughPoints] as const] : types}
      value={isThroughPoints ? "circle-points" : value}
      onChange={(type) => {
        if (type === "circle-points") app.view.state.setState({ lineType: "circle", circleBy: "points" });
        else app.view.state.setState({ lineType: type, ...(isPhone && { circleBy: "centre" }) });
      }}
    />
  );
}

function CircleChoice({ value }: { readonly value: CircleBy }) {
  const app = useApp();
  return (
    <Choice
      label={words.circleBy}
      data-testid="circle-by"
      names={circleWays.map((way) => [way, words.circleWays[way]])}
      value={value}
      onChange={(circleBy) => app.view.state.setState({ circleBy })}
    />
  );
}

function HandleChoice() {
  const app = useApp();
  const handleMode = useView((state) => state.handleMode);
  return (
    <Choice
      label={words.handles}
      data-testid="handle-mode"
      names={handleModes.map((mode) => [mode, words.handleModes[mode]])}
      value={handleMode}
      onChange={(mode) => app.view.state.setState({ handleMode: mode })}
    />
  );
}

const sourceTypes: readonly SourceType[] = ["point", "segment", "triangle"];

function SourceTypeChoice({ value }: { readonly value: SourceType }) {
  const app = useApp();
  return (
    <Choice
      label={words.sourceType}
      names={sourceTypes.map((type) => [type, words.sourceTypes[type]])}
      value={value}
      onChange={(sourceType) => app.view.state.setState({ sourceType })}
    />
  );
}

function PlaneChoice() {
  const app = useApp();
  const { kind } = useView((state) => state.workPlane);
  return (
    <span className={styles["group"]}>
      <Choice
        label={words.plane}
        names={principalPlanes.map((plane) => [plane, words.planes[plane]])}
        value={kind === "free" ? null : kind}
        onChange={(plane) => app.view.state.setState({ workPlane: principalPlane(plane) })}
      />
      <IconButton
        label={words.planeOfSelection}
        size={26}
        data-testid="plane-selection"
        onClick={() => runNamed(app, "plane-selection")}
      >
        <IconPlaneDeparture size={16} aria-hidden />
      </IconButton>
    </span>
  );
}

const snapIcons: Readonly<Record<keyof Snapping, Icon>> = {
  grid: IconGridDots,
  model: IconMagnet,
  patches: IconTriangle,
};
const snaps = Object.keys(snapIcons) as (keyof Snapping)[];

function SnapSwitches() {
  const app = useApp();
  const snapping = useView((state) => state.snapping);
  return (
    <span className={styles["group"]} role="group" aria-label={words.snapping}>
      {snaps.map((name) => {
        const Icon = snapIcons[name];
        return (
          <IconButton
            key={name}
            label={`${words.snapping}: ${words.snapTo[name]}`}
            size={26}
            variant={snapping[name] ? "light" : "subtle"}
            color={snapping[name] ? "blue" : "gray"}
            aria-pressed={snapping[name]}
            data-testid={`snap-${name}`}
            onClick={() => app.view.state.setState({ snapping: { ...snapping, [name]: !snapping[name] } })}
          >
            <Icon size={16} aria-hidden />
          </IconButton>
        );
      })}
    </span>
  );
}

/** Opens the field for coordinates: on touch screens, no key does. */
function CoordinatesButton() {
  const app = useApp();
  return (
    <IconButton
      label={words.typeCoordinates}
      size={26}
      data-testid="type-coordinates"
      onClick={() => app.drawing.type("")}
    >
      <IconKeyboard size={16} aria-hidden />
    </IconButton>
  );
}

/** Ends what is being drawn, as Enter does: touch screens have no keys. */
function FinishButton() {
  const app = useApp();
  const picked = useStore(app.drawing.state, (state) => state.picked);
  if (picked === 0) return null;
  return (
    <IconButton
      label={words.finish}
      size={26}
      variant="light"
      color="blue"
      data-testid="finish-drawing"
      onClick={() => app.drawing.complete()}
    >
      <IconCheck size={16} aria-hidden />
    </IconButton>
  );
}

/** Returns what to do next. */
function hintOf(tool: ToolName, lineType: LineType, sourceType: SourceType): string | null {
  if (tool === "select") return null;
  if (tool === "line") return words.hints[lineType];
  return tool === "source" ? words.hints.source[sourceType] : words.hints[tool];
}

/** What to do next, or why the last action created nothing. */
function Hint({ text }: { readonly text: string | null }) {
  const app = useApp();
  const refused = useStore(app.drawing.state, (state) => state.refused);
  if (text === null) return null;
  return (
    <div
      className={styles["hint"]}
      role="status"
      data-testid="drawing-hint"
      data-refused={refused !== null || undefined}
    >
      {refused ?? text}
    </div>
  );
}
