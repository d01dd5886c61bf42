import { NumberField } from "./number-field";

const axes = ["x", "y", "z"] as const;

export interface PlaceFieldsProps {
  /** What the three numbers are, e.g. "Position". */
  readonly label: string;
  readonly place: readonly [number, number, number];
  readonly step: number;
  readonly refuse?: (axis: 0 | 1 | 2, value: number) => string | null;
  readonly onCommit: (axis: 0 | 1 | 2, value: number) => void;
  /** Test ids are this and the axis, e.g. "at-x". */
  readonly testId: string;
  /** The x field is to have the focus when the dialog around it opens. */
  readonly first?: boolean;
}

/** Three number fields side by side, marked x, y and z. */
export function PlaceFields({ label, place, step, refuse, onCommit, testId, first }: PlaceFieldsProps) {
  return (
    <div className="tf-place">
      {([0, 1, 2] as const).map((axis) => (
        <NumberField
          key={axis}
          label={`${label} ${axes[axis]}`}
          value={place[axis]}
          step={step}
          first={first === true && axis === 0}
          leftSection={<span className={`tf-axis tf-axis-${axes[axis]}`}>{axes[axis]}</span>}
          testId={`${testId}-${axes[axis]}`}
          onCommit={(value) => onCommit(axis, value)}
          {...(refuse && { refuse: (value: number) => refuse(axis, value) })}
        />
      ))}
    </div>
  );
}
