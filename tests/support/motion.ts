import type { ViewStore } from "../../web/document/selection";
import type { DocumentStore } from "../../web/session/document-store";
import type { Drawing } from "../../web/tools/drawing/drawing";
import { TypedKeys, type TypedKeysOptions } from "../../web/tools/drawing/typed-keys";
import { Motion } from "../../web/tools/motion";
import type { Viewer } from "../../web/viewer/viewer";

interface MotionParts {
  readonly documents: DocumentStore;
  readonly view: ViewStore;
  readonly drawing: Drawing;
  readonly seenFrom: Viewer["seenFrom"];
  readonly hotkeyOf?: TypedKeysOptions["hotkeyOf"];
}

/** Makes the motion that the tools of a view share. */
export function makeMotion({ documents, view, drawing, seenFrom, hotkeyOf }: MotionParts): Motion {
  const keys = new TypedKeys({ drawing, named: () => new Map(), hotkeyOf: hotkeyOf ?? (() => null) });
  return new Motion({ documents, view, drawing, keys, viewer: { seenFrom } });
}

/** Presses keys one after the other; returns whether a tool used all of them. */
export function pressKeys(tool: { key(event: KeyboardEvent): boolean }, ...keys: readonly string[]): boolean {
  return keys
    .map((key) =>
      tool.key({ key, shiftKey: false, ctrlKey: false, metaKey: false, altKey: false } as KeyboardEvent),
    )
    .every(Boolean);
}
