/** What teaches, attached to the app: the recorded front with its player, and the lessons. */
import type { App } from "../app/app";
import { addPaletteItems } from "../commands/palette-items";
import { addCommands } from "../commands/registry";
import { frontCommands, lessonCommands } from "./commands/front-commands";
import { openLessonOf } from "./commands/open-lesson";
import { teachingItems } from "./commands/palette-items";
import { lessonIn, withLesson } from "./lessons/lesson-address";
import { sharedFrontIn, withoutFront } from "./player/shared-front";

export { replayOf } from "./commands/replay";
export { teachingSlots } from "./panels/slots";

addCommands([...lessonCommands, ...frontCommands]);
addPaletteItems(teachingItems);

/** What an address asks for: the state of a front, a lesson, or neither. */
export interface TeachingAddress {
  /** Whether the front of the first document is recorded, so that it is not meshed too. */
  readonly showsFront: boolean;
  /** Number of the lesson that is opened, which shows its own model; null for none. */
  readonly lesson: number | null;
  /** Shows what the address asks for in an app. Rejects if it cannot be shown. */
  readonly follow: (app: App) => Promise<void>;
}

/** Reads the parameters of an address. `hasLink`: a project in the address replaces the state of a front. */
export function teachingAddress(query: URLSearchParams, hasLink: boolean): TeachingAddress {
  const shared = hasLink ? null : sharedFrontIn(query);
  const lesson = lessonIn(query);
  const follow = async (app: App): Promise<void> => {
    keepAddress(app);
    await Promise.all([
      shared && import("./commands/step-links").then(({ showSharedIfOpen }) => showSharedIfOpen(app, shared)),
      query.size > 0 && showProblems(app, query),
      lesson &&
        import("./commands/lesson-actions").then(({ openLessonNumber }) =>
          openLessonNumber(app, lesson, query.get("lesson") ?? undefined),
        ),
    ]);
  };
  return { showsFront: shared !== null, lesson: lesson && lesson.number, follow };
}

async function showProblems(app: App, query: URLSearchParams): Promise<void> {
  const { addressProblems, showAddressProblems } = await import("./commands/address-problems");
  showAddressProblems(app, addressProblems(query));
}

/** Lets the address name the open lesson and its runs, so that both can be passed on, and no step of an earlier document. */
function keepAddress(app: App): void {
  const replace = (address: URL): void => window.history.replaceState(null, "", address);
  app.documents.state.subscribe(({ id }, before) => {
    if (id !== before.id) replace(withoutFront(window.location.href));
  });
  openLessonOf(app).subscribe(({ number, runs }) => {
    replace(withLesson(window.location.href, number === null ? null : { number, runs }));
  });
}
