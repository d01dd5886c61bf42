/** Plays the searches of several structures at one pace: as many visits at once in all of them. */
import { button } from "../../kit/dom";
import { isCalm, Motion } from "../../kit/motion";

/** Seconds in which the longest search is played. */
const playTime = 4;

export class VisitPlayer {
  readonly button = button({ class: "round play", "aria-label": "Search" }, "", () => this.#play());
  /** Visits that are shown: all, or those so far. */
  shown = Infinity;
  readonly #motion = new Motion();

  constructor(
    /** Number of visits of the longest search. */
    readonly longest: () => number,
    readonly show: () => void,
  ) {
    const icon = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    icon.setAttribute("viewBox", "0 0 24 24");
    icon.setAttribute("aria-hidden", "true");
    icon.append(document.createElementNS("http://www.w3.org/2000/svg", "path"));
    icon.firstElementChild?.setAttribute("d", "M8 5l11 7-11 7z");
    this.button.append(icon);
  }

  get isPlaying(): boolean {
    return this.shown !== Infinity;
  }

  /** Shows all visits again. */
  stop(): void {
    this.#motion.stop();
    this.shown = Infinity;
  }

  /** Returns how many of the given number of visits are shown. */
  of(visits: number): number {
    return Math.min(visits, Math.floor(this.shown));
  }

  #play(): void {
    if (isCalm()) return;
    const longest = this.longest();
    this.shown = 0;
    this.#motion.frames(
      (seconds) => {
        this.shown += (seconds * longest) / playTime;
        this.show();
        return this.shown < longest;
      },
      () => {
        this.stop();
        this.show();
      },
    );
  }
}
