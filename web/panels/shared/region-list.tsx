import { UnstyledButton } from "@mantine/core";
import { formatCount } from "../../strings/format";
import { regionColor } from "../../ui/theme/region-colors";
import { ownRegionName, strings } from "../../strings";
import { useApp, useRegions, useRun, useView } from "./app-context";
import styles from "./region-list.module.css";

/** The colour in which the view draws a region. */
export function RegionSwatch({ region }: { readonly region: number }) {
  return <span className={styles["swatch"]} style={{ color: regionColor(region) }} aria-hidden />;
}

export interface RegionListProps {
  /** Prefix of the test ids: "legend" gives "legend-1" for region 1. */
  readonly testId: string;
}

/** The regions of the shown mesh, with colours and element counts. A click hides or shows a region. */
export function RegionList({ testId }: RegionListProps) {
  const app = useApp();
  const regions = useRegions();
  const groups = useRun((state) => state.mesh?.mesh.regions);
  const hidden = useView((state) => state.hiddenRegions);
  return (
    <ul className={styles["list"]}>
      {regions.map(({ region, tetrahedra }) => (
        <li key={region}>
          <UnstyledButton
            className={styles["region"]}
            aria-pressed={!hidden.has(region)}
            aria-label={strings.report.oneRegion(region + 1, groups?.[region]?.name, formatCount(tetrahedra))}
            title={hidden.has(region) ? strings.regions.show : strings.regions.hide}
            data-testid={`${testId}-${region + 1}`}
            onClick={() => app.view.toggleRegion(region)}
          >
            <RegionSwatch region={region} />
            <b>{region + 1}</b>
            <span className={styles["name"]}>{ownRegionName(region + 1, groups?.[region]?.name)}</span>
            <span>{formatCount(tetrahedra)}</span>
          </UnstyledButton>
        </li>
      ))}
    </ul>
  );
}
