import type { ElementQuality } from "tetrafront/internal";
import { showElement } from "../../commands/selection-actions";
import { formatAngle, formatCount, formatPosition } from "../../strings/format";
import { strings } from "../../strings";
import table from "../../ui/table.module.css";
import { TableHead } from "../../ui/table-head";
import { TextButton } from "../../ui/text-button";
import { useApp, useView } from "../shared/app-context";

const texts = strings.report;

export interface ElementButtonProps {
  readonly element: ElementQuality;
  readonly text: string;
  readonly testId?: string;
}

/** Highlights an element and moves the view to it. */
export function ElementButton({ element: { tetrahedron, centroid }, text, testId }: ElementButtonProps) {
  const app = useApp();
  const isHighlighted = useView((state) => state.element === tetrahedron);
  const label = texts.show(formatCount(tetrahedron), formatPosition(centroid));
  return (
    <TextButton
      aria-pressed={isHighlighted}
      aria-label={label}
      title={label}
      data-testid={testId}
      onClick={() => void showElement(app, tetrahedron)}
    >
      {text}
    </TextButton>
  );
}

export interface ElementTableProps {
  readonly elements: readonly ElementQuality[];
  readonly testId: string;
}

/** Elements in the given order, with centroid, angles and radius ratio. */
export function ElementTable({ elements, testId }: ElementTableProps) {
  const highlighted = useView((state) => state.element);
  return (
    <table className={`${table["table"]} ${table["compact"]}`} data-testid={testId}>
      <TableHead titles={texts.columns} />
      <tbody>
        {elements.map((element, index) => (
          <tr key={element.tetrahedron} data-highlighted={element.tetrahedron === highlighted || undefined}>
            <th scope="row">
              <ElementButton
                element={element}
                text={formatPosition(element.centroid.map((x) => Number(x.toPrecision(3))))}
                testId={`${testId}-${index}`}
              />
            </th>
            <td>{formatAngle(element.dihedral.min)}</td>
            <td>{formatAngle(element.dihedral.max)}</td>
            <td>{element.radiusRatio.toFixed(2)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
