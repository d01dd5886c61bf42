/** Keeps a small picture of the open document for lists of documents. Loaded after the first picture. */
import type { App } from "../app/app";
import { isListed } from "../session/document-store";

/** Size of a picture in pixels, that of the examples. */
const size = { width: 240, height: 150 } as const;
/** Time without a change after which the view shows what has been made, in milliseconds. */
const calmMs = 2500;

/** Takes a picture of every document that lists show, when it has not changed for a moment. */
export function keepPictures(app: App): void {
  const { library, documents, run } = app;
  if (!library) return;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const later = (): void => {
    clearTimeout(timer);
    timer = setTimeout(() => void take(app), calmMs);
  };
  documents.state.subscribe(({ history, file }, before) => {
    if (history !== before.history || file !== before.file) later();
  });
  run.state.subscribe(({ busy }, before) => {
    if (busy !== before.busy) later();
  });
  later();
}

async function take({
  documents,
  run,
  viewer: { getState },
  library,
  pictures,
  meshQueries,
}: App): Promise<void> {
  const state = documents.state.getState();
  const { viewer } = getState();
  if (!viewer || !library || !isListed(state) || run.state.getState().busy || document.hidden) return;
  const picture = await meshQueries.pictureOf(await viewer.bitmap(), size).catch(() => null);
  if (!picture || state.left.aborted) return;
  const listed = await library.list().catch(() => []);
  await pictures.write(state.id, picture, [...listed.map(({ id }) => id), state.id]);
}
