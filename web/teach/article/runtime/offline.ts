/** Lessons without a network: the first one that is opened keeps the whole site, once its figures are there. */
import { canWorkOffline, registerWorker } from "../../../session/service-worker";
import type { PageFigures } from "./page-figure";

/** Time that the figures in view have for their first pictures before anything else is fetched, in milliseconds. */
const calmMs = 1500;
/** A page that is never idle does not wait longer, in milliseconds. */
const idleMs = 10_000;

export async function keepOffline(figures: PageFigures): Promise<void> {
  if (!canWorkOffline()) return;
  if (document.readyState !== "complete")
    await new Promise((resolve) => window.addEventListener("load", resolve, { once: true }));
  await new Promise((resolve) => setTimeout(resolve, calmMs));
  await Promise.all([...figures.values()].map((figure) => figure.begun()));
  await idle();
  // A browser may refuse it, as in a private window: then lessons need the network, as before.
  await registerWorker(document.documentElement.dataset["root"]).catch(() => undefined);
}

/** Resolves when the page has nothing else to do. Safari does not tell. */
const idle = (): Promise<unknown> =>
  new Promise((resolve) => {
    if ("requestIdleCallback" in window) window.requestIdleCallback(resolve, { timeout: idleMs });
    else setTimeout(resolve, calmMs);
  });
