import { Select } from "@mantine/core";
import type { QualityReport } from "tetrafront";
import type { RegionChoice } from "../../document/quality-counts";
import { formatCount } from "../../strings/format";
import { strings } from "../../strings";
import styles from "./quality-report.module.css";
import { useRun } from "../shared/app-context";
import { RegionSwatch } from "../shared/region-list";

const texts = strings.report;

export interface RegionSelectProps {
  readonly quality: QualityReport;
  readonly choice: RegionChoice;
  readonly onChoose: (region: RegionChoice) => void;
}

/** Chooses the region that the charts show. */
export function RegionSelect({ quality, choice, onChoose }: RegionSelectProps) {
  const groups = useRun((state) => state.mesh?.mesh.regions);
  const all = quality.regions.reduce((sum, { tetrahedra }) => sum + tetrahedra, 0);
  return (
    <Select
      size="xs"
      mt={10}
      aria-label={texts.region}
      data-testid="quality-region"
      allowDeselect={false}
      data={[
        { value: "all", label: texts.allRegions(formatCount(all)) },
        ...quality.regions.map(({ region, tetrahedra }) => ({
          value: String(region),
          label: texts.oneRegion(region + 1, groups?.[region]?.name, formatCount(tetrahedra)),
        })),
      ]}
      value={choice === null ? "all" : String(choice)}
      leftSection={choice !== null && <RegionSwatch region={choice} />}
      renderOption={({ option: { value, label } }) => (
        <span className={styles["regionOption"]}>
          {value !== "all" && <RegionSwatch region={Number(value)} />}
          {label}
        </span>
      )}
      onChange={(value) => onChoose(value === null || value === "all" ? null : Number(value))}
    />
  );
}
