import {
  IconBox,
  IconCircle,
  IconEaseOut,
  IconGridDots,
  IconLine,
  IconPoint,
  IconTarget,
  IconTriangle,
  IconVectorBezier,
  IconVectorSpline,
} from "@tabler/icons-react";
import type { LineType, Project } from "tetrafront/project";
import { findRecord, type Entity } from "../../document/entities";

const size = 15;

const lineIcons: { readonly [T in LineType]: typeof IconLine } = {
  straight: IconLine,
  parabolic: IconVectorBezier,
  spline: IconVectorSpline,
  arc: IconEaseOut,
  circle: IconCircle,
  hermite: IconVectorSpline,
};

/** The icon of an entity's kind; for lines, of their type. */
export function EntityIcon({ entity, project }: { readonly entity: Entity; readonly project: Project }) {
  switch (entity.kind) {
    case "point":
      return <IconPoint size={size} fill="currentColor" aria-hidden />;
    case "line": {
      const type = findRecord(project, "line", entity.id)?.type;
      const Icon = lineIcons[type ?? "straight"];
      return <Icon size={size} aria-hidden />;
    }
    case "body":
      return <IconBox size={size} aria-hidden />;
    case "patch":
    case "body-patch":
      return <IconTriangle size={size} aria-hidden />;
    case "background-node":
      return <IconGridDots size={size} aria-hidden />;
    case "source":
      return <IconTarget size={size} aria-hidden />;
  }
}
