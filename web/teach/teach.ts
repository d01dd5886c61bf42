/** What teaches, attached to the app: the recorded front with its player, and the way to the lessons. */
import type { App } from "../app/app";
import { addPaletteItems } from "../commands/palette-items";
import { addCommands } from "../commands/registry";
import { frontCommands, lessonCommands } from "./commands/front-commands";
import { teachingItems } from "./commands/palette-items";
import { sharedFrontIn, withoutFront } from "./player/shared-front";

export { replayOf } from "./commands/replay";
export { teachingSlots } from "./panels/slots";

addCommands([...lessonCommands, ...frontCommands]);
addPaletteItems(teachingItems);

/** What an address asks for: the state of a front, or nothing. */
export interface TeachingAddress {
  /** Whether the front of the first document is recorded, so that it is not meshed too. */
  readonly showsFront: boolean;
  /** Shows what the address asks for in an app. Rejects if it cannot be shown. */
  readonly follow: (app: App) => Promise<void>;
}

/** Reads the parameters of an address. `hasLink`: a project in the address replaces the state of a front. */
export function teachingAddress(query: URLSearchParams, hasLink: boolean): TeachingAddress {
  const shared = hasLink ? null : sharedFrontIn(query);
  const follow = async (app: App): Promise<void> => {
    keepAddress(app);
    await Promise.all([
      shared && import("./commands/step-links").then(({ showSharedIfOpen }) => showSharedIfOpen(app, shared)),
      query.size > 0 && showProblems(app, query),
    ]);
  };
  return { showsFront: shared !== null, follow };
}

async function showProblems(app: App, query: URLSearchParams): Promise<void> {
  const { addressProblems, showAddressProblems } = await import("./commands/address-problems");
  showAddressProblems(app, addressProblems(query));
}

/** Lets the address name no step of an earlier document. */
function keepAddress(app: App): void {
  app.documents.state.subscribe(({ id }, before) => {
    if (id !== before.id) window.history.replaceState(null, "", withoutFront(window.location.href));
  });
}
