import type { App } from "../app/app";
import type { Operation } from "../document/operations/operation";

/** Opens the panel of an operation. */
export function startOperation(app: App, operation: Operation): void {
  app.shell.setState({ drawer: null, dialog: null });
  app.operations.start(operation);
}
