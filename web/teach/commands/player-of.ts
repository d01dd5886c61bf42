import type { App } from "../../app/app";
import type { Player } from "../player/player";

const players = new WeakMap<App, Player>();

/** Lets an app have a player. */
export function setPlayer(app: App, player: Player): void {
  players.set(app, player);
}

/** Returns the player of an app. */
export function playerOf(app: App): Player {
  const player = players.get(app);
  if (!player) throw new Error("The app was made without a player");
  return player;
}
