import type { Project, ProjectBackground, ProjectMeshing } from "tetrafront/project";
import { stepNames } from "../strings";
import { addDirection, addSecondDirection } from "./node-directions";
import { nounOf, recordOf, type Axis, type ProjectDraft } from "./draft-records";
import type { DraftEdit, ProjectEdit } from "./edit";

/**
 * Changes of sizes and mesh settings, as named edits for the history: background nodes, sources, the background grid as
 * a whole, and the uniform size. An edit of a missing entity changes nothing.
 */

export function setNodeSize(id: number, size: number): DraftEdit {
  return {
    label: stepNames.setNode("size", id),
    mergeKey: `size-${id}`,
    change: ({ project }) => {
      const node = recordOf(project.background.nodes, id);
      if (node) node.size = size;
    },
  };
}

export function setNodeStretching(id: number, stretching: number): DraftEdit {
  return {
    label: stepNames.setNode("stretching", id),
    mergeKey: `stretching-${id}`,
    change: ({ project }) => {
      const node = recordOf(project.background.nodes, id);
      if (!node) return;
      node.stretching = stretching;
      addDirection(node);
    },
  };
}

export function setNodeSecondStretching(id: number, stretching: number): DraftEdit {
  return {
    label: stepNames.setNode("second stretching", id),
    mergeKey: `second-stretching-${id}`,
    change: ({ project }) => {
      const node = recordOf(project.background.nodes, id);
      if (!node) return;
      node.secondStretching = stretching;
      addSecondDirection(node);
    },
  };
}

function sourceOf({ background }: ProjectDraft, id: number) {
  return background.sources && recordOf(background.sources, id);
}

/** A number of a source that determines sizes. */
export type SourceField = "size" | "distance" | "growth";

export function setSourceField(id: number, field: SourceField, value: number): DraftEdit {
  return {
    label: stepNames.setSource(field, id),
    mergeKey: `source-${field}-${id}`,
    change: ({ project }) => {
      const source = sourceOf(project, id);
      if (source) source[field] = value;
    },
  };
}

/** Moves one corner of a source along one axis. */
export function moveSource(id: number, corner: number, axis: Axis, value: number): DraftEdit {
  return {
    label: stepNames.move(nounOf("source", id)),
    mergeKey: `move-source-${id}-${corner}-${axis}`,
    change: ({ project }) => {
      const position = sourceOf(project, id)?.positions[corner];
      if (position) position[axis] = value;
    },
  };
}

/** Returns the settings with a new value in one field. Null removes the field; without fields, the result is undefined. */
function changed<Field extends keyof ProjectMeshing>(
  { meshing }: Project,
  field: Field,
  value: ProjectMeshing[Field] | null,
): ProjectMeshing | undefined {
  const { [field]: _, ...others } = meshing ?? {};
  const settings = value === null ? others : { ...others, [field]: value };
  return Object.keys(settings).length > 0 ? settings : undefined;
}

/** Changes a mesh setting of the project; null removes it, so that the default applies. */
function labelOf(field: keyof ProjectMeshing, isRemoved: boolean): string {
  if (isRemoved && field === "size") return stepNames.removeUniformSize;
  return isRemoved && field === "elements" ? stepNames.removeElements : stepNames.setMeshing[field];
}

export function setMeshing<Field extends keyof ProjectMeshing>(
  field: Field,
  value: ProjectMeshing[Field] | null,
): DraftEdit {
  return {
    label: labelOf(field, value === null),
    ...(typeof value === "number" && { mergeKey: `meshing-${field}` }),
    change: (draft) => {
      const settings = changed(draft.project as Project, field, value);
      if (settings === undefined) delete draft.project.meshing;
      else draft.project.meshing = settings;
    },
  };
}

/** Replaces the sources and keeps the background grid. A uniform size stays in force. */
export function replaceSources(label: string, background: ProjectBackground): ProjectEdit {
  return { label, replace: { background } };
}

/** Replaces the background grid with its sources. It also replaces a uniform size. */
export function replaceBackground(
  label: string,
  project: Project,
  background: ProjectBackground,
): ProjectEdit {
  return { label, replace: { background, meshing: changed(project, "size", null) } };
}

/** Multiplies all sizes: of background nodes, of sources, and the uniform one. Above 1, the mesh gets coarser. */
export function scaleSizes({ background, meshing }: Project, factor: number): ProjectEdit {
  const scaled = <Item extends { readonly size: number }>(list: readonly Item[]): readonly Item[] =>
    list.map((item) => ({ ...item, size: factor * item.size }));
  return {
    label: factor < 1 ? stepNames.refineSizes : stepNames.coarsenSizes,
    replace: {
      background: {
        ...background,
        nodes: scaled(background.nodes),
        ...(background.sources && { sources: scaled(background.sources) }),
      },
      ...(meshing?.size !== undefined && { meshing: { ...meshing, size: factor * meshing.size } }),
    },
  };
}
