import { entityName, findRecord } from "../document/entities";
import { formatPlace, formatShort } from "../ui/format";
import { entityWords, lineTypeNames, patchTypeNames } from "../ui/strings";
import type { Hover } from "../tools/select-tool";
import { useProject } from "./app-context";

/** Names what lies under the pointer. */
export function HoverLabel({ hover: { entity, at } }: { readonly hover: Hover }) {
  const project = useProject();
  const { kind, id } = entity;
  const describe = (): string => {
    switch (kind) {
      case "point":
        return formatPlace(findRecord(project, "point", id)?.position ?? []);
      case "line":
        return lineTypeNames[findRecord(project, "line", id)?.type ?? "straight"];
      case "patch":
        return patchTypeNames[findRecord(project, "patch", id)?.type ?? "planar"];
      case "background-node":
      case "source":
        return `δ ${formatShort(findRecord(project, kind, id)?.size ?? 0)}`;
    }
  };
  return (
    <div className="tf-hover" style={{ transform: `translate(${at.x + 14}px, ${at.y + 14}px)` }} aria-hidden>
      <b>{entityName(project, entity) ?? `${entityWords[kind].one} ${id}`}</b> {describe()}
    </div>
  );
}
