/** What every call of a mesher checks before and between its slices. */
import { throwIfCancelled } from "../calls/cancelling.js";
import { refuse } from "../diagnostics/mesher-error.js";
import type { RunControl } from "../engine/control.js";
import type { EngineClient } from "../engine/engine-client.js";
import { checkControl } from "./input-checks.js";

/** Throws before a large input is checked and copied if the call cannot succeed. */
export function beginCall(client: EngineClient, control: RunControl): void {
  refuse(checkControl(control));
  client.assertOpen();
  throwIfCancelled(control.signal);
}

/** Throws after a pause if the call can no longer succeed. */
export async function afterPause(
  client: EngineClient,
  pause: Promise<void>,
  { signal }: RunControl,
): Promise<void> {
  await pause;
  client.assertOpen();
  throwIfCancelled(signal);
}
