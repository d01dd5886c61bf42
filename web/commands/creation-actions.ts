import type { App } from "../app/app";
import type { Creation, Offer } from "../document/create";
import { showNote, showRefusal } from "./messages";

/** Adds what an offer creates to the project and selects it, or shows why it cannot be created. */
export function takeOffer(app: App, title: string, offer: Offer): void {
  if (!offer.possible) {
    showRefusal(app, title, offer.reason);
    return;
  }
  create(app, offer.creation);
}

/** Applies a creation and selects the new entities. */
export function create(app: App, { edit, entities, note }: Creation): void {
  app.documents.edit(edit);
  app.view.selectAll(entities);
  if (note !== undefined) showNote(app, note);
  app.shell.setState({ rightTab: "inspector", leftTab: "model" });
}
