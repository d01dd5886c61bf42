import { UnstyledButton } from "@mantine/core";
import { formatCount } from "../ui/format";
import { regionColor } from "../ui/region-colors";
import { strings } from "../ui/strings";
import { useApp, useRegions, useView } from "./app-context";

/** The colour in which the view draws a region. */
export function RegionSwatch({ region }: { readonly region: number }) {
  return <span className="tf-swatch" style={{ color: regionColor(region) }} aria-hidden />;
}

export interface RegionListProps {
  /** The test id of region 1 is this with "-1" behind. */
  readonly testId: string;
}

/** The regions of the mesh on show, with their colours and tetrahedra; each is hidden and shown by a click. */
export function RegionList({ testId }: RegionListProps) {
  const app = useApp();
  const regions = useRegions();
  const hidden = useView((state) => state.hiddenRegions);
  return (
    <ul className="tf-regions">
      {regions.map(({ region, tetrahedra }) => (
        <li key={region}>
          <UnstyledButton
            className="tf-region"
            aria-pressed={!hidden.has(region)}
            aria-label={strings.report.oneRegion(region + 1, formatCount(tetrahedra))}
            title={hidden.has(region) ? strings.regions.show : strings.regions.hide}
            data-testid={`${testId}-${region + 1}`}
            onClick={() => app.view.toggleRegion(region)}
          >
            <RegionSwatch region={region} />
            <b>{region + 1}</b>
            <span>{formatCount(tetrahedra)}</span>
          </UnstyledButton>
        </li>
      ))}
    </ul>
  );
}
