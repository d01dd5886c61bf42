import type { App } from "../app/app";
import { failureLines, readDroppedFiles, type FailedOpening, type OpenResult } from "../session/files";
import { strings } from "../strings";
import { showMessage } from "./messages";
import { noteReading, showNotes, takeOpened } from "./project-actions";
import { addSurfaces, fitToBodies } from "./surface-actions";

type Failure = Omit<FailedOpening, "kind">;

/**
 * Opens files that are dropped together: the first one as a document, to which the bodies of all others are added as one
 * step of undo. A message names the files that cannot be used.
 */
export async function openDropped(app: App, files: readonly File[]): Promise<void> {
  const results = await readDroppedFiles(files, noteReading(app));
  const [first, ...others] = results.filter(({ kind }) => kind !== "failed");
  if (first) await takeOpened(app, first);
  const surfaces = others.flatMap((other) =>
    other.kind === "surface" || other.kind === "mesh" ? [other] : [],
  );
  if (first && surfaces.length > 0) {
    const { bodies, notes } = await addSurfaces(app, surfaces);
    for (const { body } of bodies) app.bodies.prepareWhenValid(body.id);
    app.view.setLayer("bodies", true);
    fitToBodies(app, bodies);
    showNotes(app, [...notesOf(first), ...notes]);
  }
  const failures = [
    ...results.flatMap((result) => (result.kind === "failed" ? [result] : [])),
    ...others.flatMap((other) =>
      other.kind === "opened" ? [{ fileName: other.fileName, reasons: [strings.files.furtherProject] }] : [],
    ),
  ];
  showFailures(app, failures);
}

const notesOf = (result: OpenResult): readonly string[] =>
  result.kind === "surface"
    ? result.read.notes
    : result.kind === "mesh"
      ? [...result.read.notes, strings.files.meshNotSaved]
      : [];

function showFailures(app: App, failures: readonly Failure[]): void {
  const [first, second] = failures;
  if (!first) return;
  const { openFailed, someFailed } = strings.messages;
  const title = second ? someFailed(failures.length) : openFailed(first.fileName);
  showMessage(app, title, failureLines(failures));
}
