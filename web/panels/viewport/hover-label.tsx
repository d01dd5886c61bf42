import { bodyOfPatch, findRecord } from "../../document/entities";
import { formatPosition, formatMeasure } from "../../strings/format";
import { lineTypeNames, patchTypeNames } from "../../strings";
import type { Hover } from "../../tools/select-tool";
import { useProject } from "../shared/app-context";
import { entityTitle } from "../shared/entity-chips";
import { BesidePointer } from "./beside-pointer";
import styles from "./hover-label.module.css";

/** The name and type of the entity under the pointer. */
export function HoverLabel({ hover: { entity, at } }: { readonly hover: Hover }) {
  const project = useProject();
  const { kind, id } = entity;
  const describe = (): string => {
    switch (kind) {
      case "point":
        return formatPosition(findRecord(project, "point", id)?.position ?? []);
      case "line":
        return lineTypeNames[findRecord(project, "line", id)?.type ?? "straight"];
      case "patch":
        return patchTypeNames[findRecord(project, "patch", id)?.type ?? "planar"];
      case "body":
        return "";
      case "body-patch": {
        const body = bodyOfPatch(project, id);
        return body ? entityTitle(project, { kind: "body", id: body.id }) : "";
      }
      case "background-node":
      case "source":
        return `size ${formatMeasure(findRecord(project, kind, id)?.size ?? 0, project.units)}`;
    }
  };
  return (
    <BesidePointer at={at}>
      <div className={styles["label"]} aria-hidden data-testid="hover-label">
        <b>{entityTitle(project, entity)}</b> {describe()}
      </div>
    </BesidePointer>
  );
}
