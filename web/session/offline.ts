/** The page's part of offline use: registers the service worker (web/service-worker.ts), and offers its updates. */

import { offlineStrings as texts } from "../strings/passing";
import { canWorkOffline, registerWorker } from "./service-worker";

/** What a page does when a version of the site is ready that it does not show. */
export type OnUpdate = (reload: () => void) => void;

/** Time between two searches for a new version, in milliseconds. */
const updateMs = 3_600_000;

/** Registers the service worker. `onUpdate` is called when a new version is there; it waits until the page loads it. */
export async function workOffline(onUpdate: OnUpdate): Promise<void> {
  if (!canWorkOffline()) return;
  const { serviceWorker } = navigator;
  const registration = await registerWorker();
  const offer = (worker: ServiceWorker): void => onUpdate(() => replaceBy(worker));
  const follow = (worker: ServiceWorker | null): void => {
    worker?.addEventListener("statechange", () => {
      // The first version does not replace another one.
      if (worker.state === "installed" && serviceWorker.controller) offer(worker);
    });
  };
  if (registration.waiting && serviceWorker.controller) offer(registration.waiting);
  follow(registration.installing);
  registration.addEventListener("updatefound", () => follow(registration.installing));
  offerOfAnotherTab(onUpdate);
  setInterval(() => void registration.update().catch(() => undefined), updateMs);
}

/** Replaces the version that the page shows. */
function replaceBy(worker: ServiceWorker): void {
  isReplacing = true;
  navigator.serviceWorker.addEventListener("controllerchange", () => window.location.reload(), {
    once: true,
  });
  worker.postMessage({ kind: "activate" });
}

let isReplacing = false;

/** If another tab has loaded a new version, this one shows the old one until it is reloaded. */
function offerOfAnotherTab(onUpdate: OnUpdate): void {
  const { serviceWorker } = navigator;
  let wasControlled = serviceWorker.controller !== null;
  serviceWorker.addEventListener("controllerchange", () => {
    if (wasControlled && !isReplacing) onUpdate(() => window.location.reload());
    wasControlled = true;
  });
}

/** How keeping has ended: with the size of all files in bytes, or why not. */
export type Kept =
  | { readonly kind: "kept"; readonly bytes: number }
  | { readonly kind: "failed"; readonly reason: string };

/** Time after which keeping counts as failed, in minutes: a browser may stop the service worker without a word. */
const keepMinutes = 5;

/** Keeps all files of the site, with the library that reads CAD files. */
export async function keepEverything(): Promise<Kept> {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const late = new Promise<Kept>((resolve) => {
    const fail = (): void => resolve({ kind: "failed", reason: texts.tooLong(keepMinutes) });
    timer = setTimeout(fail, keepMinutes * 60_000);
  });
  try {
    return await Promise.race([registerWorker().then(activeWorker).then(askToKeep), late]);
  } catch (error) {
    return { kind: "failed", reason: error instanceof Error ? error.message : String(error) };
  } finally {
    clearTimeout(timer);
  }
}

/** Resolves when a version is active. Rejects if the first one could not be installed. */
async function activeWorker(registration: ServiceWorkerRegistration): Promise<ServiceWorker> {
  const { active, waiting, installing } = registration;
  if (active) return active;
  const worker = waiting ?? installing;
  if (!worker) throw new Error(texts.notInstalled);
  return new Promise((resolve, reject) => {
    const follow = (): void => {
      if (worker.state === "activated") resolve(worker);
      if (worker.state === "redundant") reject(new Error(texts.notInstalled));
    };
    worker.addEventListener("statechange", follow);
    follow();
  });
}

function askToKeep(worker: ServiceWorker): Promise<Kept> {
  const { port1, port2 } = new MessageChannel();
  return new Promise((resolve) => {
    port1.onmessage = ({ data }: MessageEvent<Kept>) => resolve(data);
    worker.postMessage({ kind: "keep" }, [port2]);
  });
}

const cadFile = /\.(step|stp|iges|igs|brep|brp)$/i;

/** Keeps the library that reads CAD files when one was opened: it may have been fetched before the service worker was there. */
export function keepWhatReads(fileName: string): void {
  if (cadFile.test(fileName) && canWorkOffline()) void navigator.serviceWorker.ready.then(keepEverything);
}
