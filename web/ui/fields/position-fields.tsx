import { NumberField, type OwnNumber } from "./number-field";
import styles from "./position-fields.module.css";

const axes = ["x", "y", "z"] as const;

export interface PositionFieldsProps {
  /** Meaning of the three numbers, for example "Position". */
  readonly label: string;
  /** Null for a coordinate in which several positions differ. */
  readonly value: readonly [number | null, number | null, number | null];
  /** What the coordinates were computed from. */
  readonly expressions?: readonly (string | undefined)[] | undefined;
  /** Changes of a coordinate from each entity's own value. */
  readonly own?: ((axis: 0 | 1 | 2) => OwnNumber) | undefined;
  readonly step: number;
  /** Returns why a coordinate is invalid, or null if it is valid. */
  readonly refuse?: (axis: 0 | 1 | 2, value: number) => string | null;
  readonly onCommit: (axis: 0 | 1 | 2, value: number, expression: string | null) => void;
  /** Prefix of the test ids, which end with the axis: "new" gives "new-x". */
  readonly testId: string;
  /** Also commit valid coordinates while they are typed. */
  readonly live?: boolean;
  /** The x field gets the focus when the dialog opens. */
  readonly first?: boolean;
}

/** Three number fields side by side, labelled x, y and z. */
export function PositionFields({
  label,
  value: position,
  expressions = [],
  own,
  step,
  refuse,
  onCommit,
  testId,
  live = false,
  first,
}: PositionFieldsProps) {
  return (
    <div className={styles["fields"]}>
      {([0, 1, 2] as const).map((axis) => (
        <NumberField
          key={axis}
          label={`${label} ${axes[axis]}`}
          value={position[axis]}
          expression={expressions[axis]}
          own={own?.(axis)}
          step={step}
          live={live}
          first={first === true && axis === 0}
          leftSection={
            <span className={styles["axis"]} data-axis={axes[axis]}>
              {axes[axis]}
            </span>
          }
          testId={`${testId}-${axes[axis]}`}
          onCommit={(value, expression) => onCommit(axis, value, expression)}
          {...(refuse && { refuse: (value: number) => refuse(axis, value) })}
        />
      ))}
    </div>
  );
}
