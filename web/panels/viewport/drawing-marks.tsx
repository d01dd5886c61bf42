import { TextInput } from "@mantine/core";
import { IconCopy } from "@tabler/icons-react";
import { useEffect, useRef } from "react";
import { useStore } from "zustand";
import { pasteLines } from "../../commands/clipboard-actions";
import type { LengthUnit } from "tetrafront";
import { unitOf } from "../../document/length-units";
import { measure } from "../../document/measurement";
import type { Position } from "../../document/position";
import { formatShort, formatPosition } from "../../strings/format";
import { IconButton } from "../../ui/icon-button";
import { strings } from "../../strings";
import type { ScreenPoint } from "../../viewer/screen";
import type { Viewer } from "../../viewer/viewer";
import { useApp, useProject } from "../shared/app-context";
import { BesidePointer } from "./beside-pointer";
import { useMarkers } from "./use-markers";
import styles from "./drawing.module.css";

const words = strings.drawing;
const axisNames = ["X", "Y", "Z"] as const;

/** What the drawing tools show in the view: the place under the pointer, typed coordinates, a measurement. */
export function DrawingMarks({ viewer }: { readonly viewer: Viewer }) {
  const app = useApp();
  const typed = useStore(app.drawing.state, (state) => state.typed);
  const measured = useStore(app.drawing.state, (state) => state.measured);
  return (
    <>
      <SnapMark viewer={viewer} />
      <DragAmount />
      <WaitingLetter />
      {typed !== null && <CoordinateField typed={typed} />}
      {measured.length > 1 && <MeasurementCard places={measured} viewer={viewer} />}
    </>
  );
}

/** A marker at the place that a click would use, with a word for what it snaps to. */
function SnapMark({ viewer }: { readonly viewer: Viewer }) {
  const app = useApp();
  const snap = useStore(app.drawing.state, (state) => state.snap);
  const box = useMarkers(viewer, [snap?.position ?? null]);
  return (
    <div ref={box} aria-hidden>
      {snap && (
        <span className={styles["mark"]} data-snap={snap.kind} data-testid="snap">
          <span className={styles["shape"]} />
          <span className={styles["word"]}>
            {words.snaps[snap.kind]} {formatPosition(snap.position)}
          </span>
        </span>
      )}
    </div>
  );
}

/** By how much a drag changes the selection, or what a handle changes: beside the pointer. */
function DragAmount() {
  const app = useApp();
  const amount = useStore(app.drawing.state, (state) => (state.typed === null ? state.amount : null));
  const pointer = useStore(app.drawing.state, (state) => state.pointer);
  if (amount === null) return null;
  return (
    <BesidePointer at={pointer}>
      <span className={styles["amount"]} data-testid="amount">
        {amount}
      </span>
    </BesidePointer>
  );
}

/** Beside the pointer, but neither outside the view nor under the tools at its edges, where the pointer may be at first. */
const fieldPosition = ({ x, y }: ScreenPoint) => ({
  left: `clamp(58px, ${x + 16}px, 100% - 200px)`,
  top: `clamp(118px, ${y + 16}px, 100% - 60px)`,
});

/** A letter that may begin coordinates, and the command that it runs unless more is typed. */
function WaitingLetter() {
  const app = useApp();
  const waiting = useStore(app.drawing.state, (state) => state.waiting);
  const pointer = useStore(app.drawing.state, (state) => state.pointer);
  if (!waiting) return null;
  return (
    <span
      className={styles["waiting"]}
      style={fieldPosition(pointer)}
      role="status"
      data-testid="waiting-letter"
    >
      {words.waiting(waiting.letter, waiting.command)}
    </span>
  );
}

/** The field for coordinates beside the pointer. It opens when the user begins to type. */
function CoordinateField({ typed }: { readonly typed: string }) {
  const app = useApp();
  const pointer = useStore(app.drawing.state, (state) => state.pointer);
  const mistake = useStore(app.drawing.state, (state) => state.mistake);
  const refused = useStore(app.drawing.state, (state) => state.refused);
  const motion = useStore(app.drawing.state, (state) => state.motion);
  const axis = useStore(app.drawing.state, (state) => state.axis);
  const texts = motion ? words.motions[motion] : words;
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => {
    const input = field.current;
    const before = document.activeElement;
    input?.focus();
    input?.setSelectionRange(input.value.length, input.value.length);
    return () => {
      if (before instanceof HTMLElement) before.focus();
    };
  }, []);
  return (
    <div className={styles["field"]} style={fieldPosition(pointer)}>
      <TextInput
        ref={field}
        size="xs"
        w={184}
        aria-label={axis === null ? texts.coordinates : words.alongAxis(texts.coordinates, axisNames[axis])}
        placeholder={texts.coordinatesHint}
        title={texts.coordinatesTitle}
        leftSection={axis === null ? undefined : <b aria-hidden>{axisNames[axis]}</b>}
        data-testid="coordinates"
        autoComplete="off"
        spellCheck={false}
        value={typed}
        error={mistake === "refused" ? refused : mistake && words.mistakes[mistake]}
        onChange={(event) => app.drawing.type(event.currentTarget.value)}
        onPaste={(event) => {
          const text = event.clipboardData.getData("text");
          if (!text.trim().includes("\n")) return;
          // A field of one line would join the lines.
          event.preventDefault();
          pasteLines(app, text);
        }}
        onBlur={() => app.drawing.type(null)}
        onKeyDown={(event) => {
          const isTab = event.key === "Tab" && !event.shiftKey;
          // Enter would press the button that gets the focus back.
          if (isTab || event.key === "Enter") event.preventDefault();
          if (isTab) app.drawing.next();
          else if (event.key === "Enter") app.drawing.submit();
          else if (event.key === "Escape") app.drawing.type(null);
        }}
      />
    </div>
  );
}

interface MeasurementProps {
  readonly places: readonly Position[];
  readonly viewer: Viewer;
}

/** A measurement, beside the place picked last. */
function MeasurementCard({ places, viewer }: MeasurementProps) {
  const box = useMarkers(viewer, [places.at(-1) ?? null]);
  const rows = measurementRows(places, unitOf(useProject().units) ?? null);
  const text = rows.map((row) => row.join(" ")).join(", ");
  return (
    <div ref={box}>
      <div className={styles["anchor"]}>
        <dl className={styles["measurement"]} aria-label={words.measurement} data-testid="measurement">
          {rows.map(([name, value]) => (
            <div key={name}>
              <dt>{name}</dt>
              <dd>{value}</dd>
            </div>
          ))}
          <IconButton
            label={words.copy}
            size={24}
            onClick={() => void navigator.clipboard.writeText(text).catch(() => undefined)}
          >
            <IconCopy size={13} aria-hidden />
          </IconButton>
        </dl>
      </div>
    </div>
  );
}

/** Returns the names and values of a measurement: lengths with the unit of the project, if it has one. */
export function measurementRows(
  places: readonly Position[],
  unit: LengthUnit | null,
): readonly (readonly [name: string, value: string])[] {
  const measured = measure(places);
  if (!measured) return [];
  const { distance, offset, angle } = measured;
  const inUnit = (length: number): string =>
    unit === null ? formatShort(length) : `${formatShort(length)} ${strings.units[unit]}`;
  return [
    [words.distance, inUnit(distance)],
    ...(["dx", "dy", "dz"] as const).map((name, k) => [name, inUnit(offset[k] ?? 0)] as const),
    ...(angle === null ? [] : [[words.angle, `${formatShort(angle)}°`] as const]),
  ];
}
