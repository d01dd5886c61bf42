/** The page's part of offline use: registers the service worker (web/service-worker.ts), and offers its updates. */

/** What a page does when a version of the site is ready that it does not show. */
export type OnUpdate = (reload: () => void) => void;

/** Time between two searches for a new version, in milliseconds. */
const updateMs = 3_600_000;

/** The development server has no service worker. Without a secure address, browsers have none. */
export const canWorkOffline = (): boolean => import.meta.env.PROD && "serviceWorker" in navigator;

/** Registers the service worker. `onUpdate` is called when a new version is there; it waits until the page loads it. */
export async function workOffline(onUpdate: OnUpdate): Promise<void> {
  if (!canWorkOffline()) return;
  const { serviceWorker } = navigator;
  const registration = await serviceWorker.register(new URL("./sw.js", document.baseURI));
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
  { readonly kind: "kept"; readonly bytes: number } | { readonly kind: "failed"; readonly reason: string };

/** Keeps all files of the site, with the library that reads CAD files. */
export async function keepEverything(): Promise<Kept> {
  const { active } = await navigator.serviceWorker.ready;
  const { port1, port2 } = new MessageChannel();
  return new Promise((resolve) => {
    port1.onmessage = ({ data }: MessageEvent<Kept>) => resolve(data);
    active?.postMessage({ kind: "keep" }, [port2]);
  });
}

const cadFile = /\.(step|stp|iges|igs|brep|brp)$/i;

/** Keeps the library that reads CAD files when one was opened: it may have been fetched before the service worker was there. */
export function keepWhatReads(fileName: string): void {
  if (cadFile.test(fileName) && canWorkOffline()) void keepEverything();
}
