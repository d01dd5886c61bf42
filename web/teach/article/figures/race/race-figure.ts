/** Four fronts fill the same channel with the same sizes; only the order of their base edges differs. */
import { effect, untracked } from "@preact/signals-core";
import { loadPlaneFront, type PlaneFront } from "tetrafront/trace";
import { element } from "../../kit/dom";
import type { Figure } from "../../kit/figure";
import { Motion } from "../../kit/motion";
import type { PlanePoint } from "../../kit/plane-view";
import type { Values } from "../../kit/values";
import { filmOf } from "../front/front-film";
import { RacePanel, type PanelOwner } from "./race-panel";
import { centre, fillChannel, orders, withinChannel, type Wing } from "./race-rules";
import { Timeline } from "./timeline";

const runs = [
  { name: "smallest", title: "Smallest first", dash: [] },
  { name: "oldest", title: "Oldest first", dash: [7, 4] },
  { name: "random", title: "At random", dash: [2, 3] },
  { name: "layered", title: "Layer by layer", dash: [9, 3, 2, 3] },
] as const;
const shares: Readonly<Record<string, number>> = { start: 0, third: 0.35, end: 1 };

export class RaceFigure implements Figure, PanelOwner {
  readonly #panels = runs.map(({ title }, index) => new RacePanel(this, index + 1, title));
  readonly #timeline = new Timeline(() => this.#show());
  readonly #motion = new Motion();
  readonly #notice = element("div", { class: "notice", role: "status" });
  #at = centre;
  /** The wing at the end of its last movement. */
  focus = centre;
  #values: Values | null = null;
  #engine: PlaneFront | null = null;
  #isHandled = false;
  /** Whether a word of the text sets the inputs at present. */
  #isLed = false;
  #lit: string | null = null;

  async mount(host: HTMLElement, values: Values): Promise<void> {
    this.#values = values;
    host.append(
      this.#notice,
      element("div", { class: "race-panels" }, ...this.#panels.map((panel) => panel.element)),
      this.#timeline.element,
    );
    this.#engine = await loadPlaneFront();
    let isFirst = true;
    effect(() => {
      values.number("growth");
      values.number("angle");
      if (!isFirst && !this.#isLed) this.#isHandled = true;
      isFirst = false;
      untracked(() => this.#fill());
    });
    this.#timeline.seek(shares["third"] ?? 0);
  }

  go({ share, growth, angle, wing }: Readonly<Record<string, string>>): void {
    this.#isHandled = false;
    this.#isLed = true;
    if (growth !== undefined) this.#values?.ask("growth", Number(growth));
    if (angle !== undefined) this.#values?.ask("angle", Number(angle));
    this.#isLed = false;
    const arrive = (): void => {
      if (share !== undefined) this.#timeline.glideTo(shares[share] ?? Number(share));
    };
    if (wing !== "centre") {
      this.#report();
      return arrive();
    }
    const from = this.#at;
    this.#motion.run(
      500,
      (t) => {
        this.#at = [from[0] + (centre[0] - from[0]) * t, from[1] + (centre[1] - from[1]) * t];
        this.focus = this.#at;
        this.#fill();
      },
      arrive,
    );
  }

  mark(part: string | null): void {
    this.#lit = part;
    this.#show();
  }

  get wing(): Wing {
    return { at: this.#at, angle: this.#values?.number("angle") ?? 0 };
  }

  begin(): void {
    this.#motion.stop();
    this.#timeline.pause();
  }

  end(): void {
    this.focus = this.#at;
    this.#show();
  }

  moveWing(to: PlanePoint): void {
    this.#isHandled = true;
    this.#at = withinChannel(to);
    this.#fill();
  }

  turnWing([x, y]: PlanePoint): void {
    const [dx, dy] = [x - this.#at[0], y - this.#at[1]];
    // The tail stays behind the nose.
    if (dx > 0) this.#values?.ask("angle", (-Math.atan2(dy, dx) * 180) / Math.PI);
  }

  #fill(): void {
    const [engine, values] = [this.#engine, this.#values];
    if (!engine || !values) return;
    const growth = values.number("growth");
    this.#panels.forEach((panel, i) => {
      const filled = fillChannel(engine, this.wing, growth, orders[i] ?? "layered");
      this.#notice.textContent = filled.success ? "" : filled.message;
      if (filled.success) panel.setFilm(filmOf(filled));
    });
    this.#timeline.setRuns(
      runs.map(({ name, dash }, i) => ({
        name,
        dash,
        refusedBefore: this.#panels[i]?.film?.refusedBefore ?? [0],
      })),
    );
    this.#report();
  }

  #report(): void {
    const films = this.#panels.map(({ film }) => film);
    const totals = films.map((film) => film?.refusedCount ?? 0);
    const fewest = totals.indexOf(Math.min(...totals));
    const named = runs.flatMap(({ name }, i) => [
      [name, totals[i] ?? 0],
      [`${name}angle`, films[i]?.worst.angle ?? 0],
    ]);
    this.#values?.put({
      ...(Object.fromEntries(named) as Record<string, number>),
      triangles: films[0]?.triangles.length ?? 0,
      share: this.#timeline.share,
      x: this.#at[0],
      y: this.#at[1],
      handled: this.#isHandled,
      fewest: (runs[fewest]?.title ?? "").toLowerCase(),
    });
    this.#show();
  }

  #show(): void {
    const { share, isPlaying } = this.#timeline;
    const totals = this.#panels.map(({ film }) => film?.refusedCount ?? Infinity);
    const least = Math.min(...totals);
    this.#values?.put({ share });
    this.#panels.forEach((panel, i) =>
      panel.show(share, this.#lit, share === 1 && totals[i] === least, isPlaying),
    );
  }
}
