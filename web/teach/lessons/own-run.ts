import type { Trace } from "tetrafront/trace";
import type { Player } from "../player/player";

/** What is needed of a run of a lesson to show it. */
interface ShownRun {
  /** Empty for the lesson's own run. */
  readonly name: string;
  readonly trace: Trace;
  readonly file: Uint8Array<ArrayBuffer>;
}

/** Shows the lesson's own run if the player shows another of its runs. */
export function showOwnRun(player: Player, runs: readonly ShownRun[]): void {
  const shown = player.state.getState().trace;
  const own = runs.find(({ name }) => name === "");
  if (own && own.trace !== shown && runs.some(({ trace }) => trace === shown))
    player.show(own.trace, own.file);
}
