/** The registration of the service worker (web/service-worker.ts), which pages of the app and of lessons share. */

/** The development server has no service worker. Without a secure address, browsers have none. */
export const canWorkOffline = (): boolean => import.meta.env.PROD && "serviceWorker" in navigator;

/** Registers the service worker for the whole site. `root` leads from the page to the root of the site. */
export const registerWorker = async (root = "./"): Promise<ServiceWorkerRegistration> =>
  navigator.serviceWorker.register(new URL(`${root}sw.js`, document.baseURI));
