/**
 * The service worker of the built site, sw.js: after one visit, the site works without a network. The build replaces SITE by the
 * list of its files (scripts/lib/site-offline.mjs).
 *
 * Each version of the site has a cache of its own, and a page gets all its files from one version. A new version is fetched in
 * the background, and waits until a page asks for it. Files of an older version stay for the pages that still show it.
 */
interface SiteFile {
  /** Relative to the folder of the site. */
  readonly path: string;
  readonly bytes: number;
  /** Its name changes with its content. */
  readonly isHashed: boolean;
  /** Kept only when it is used, or on request. */
  readonly isLater: boolean;
}

declare const SITE: { readonly version: string; readonly files: readonly SiteFile[] };

/** The parts of the worker's global scope that are used here; the DOM types describe a window's. */
interface ExtendableEvent extends Event {
  waitUntil(work: Promise<unknown>): void;
}
interface FetchEvent extends ExtendableEvent {
  readonly request: Request;
  respondWith(answer: Promise<Response>): void;
}
interface MessageEventWithWork extends ExtendableEvent {
  readonly data: { readonly kind: "activate" | "keep" };
  readonly ports: readonly MessagePort[];
}
interface Scope {
  readonly registration: { readonly scope: string };
  readonly clients: { claim(): Promise<void>; matchAll(options: object): Promise<readonly unknown[]> };
  skipWaiting(): Promise<void>;
  addEventListener(type: "install" | "activate", act: (event: ExtendableEvent) => void): void;
  addEventListener(type: "fetch", act: (event: FetchEvent) => void): void;
  addEventListener(type: "message", act: (event: MessageEventWithWork) => void): void;
}

const scope = globalThis as unknown as Scope;
const prefix = "tetrafront-";
const cacheName = `${prefix}${SITE.version}`;
/** Files that are fetched at the same time. */
const atOnce = 6;
/** The headers of an answer may name others that differ between pages and this worker. */
const anyRequest = { ignoreVary: true } as const;

const addressOf = ({ path }: SiteFile): string => new URL(path, scope.registration.scope).href;

const cadName = /\/occt-import-js-[^/]*$/;

/** Puts a file into the cache of this version; from that of another one if it is the same. */
async function keep(file: SiteFile): Promise<void> {
  const cache = await caches.open(cacheName);
  const address = addressOf(file);
  if (await cache.match(address, anyRequest)) return;
  const known = file.isHashed ? await caches.match(address, anyRequest) : undefined;
  // Files without a hash may be old in the browser's own cache.
  const answer = known ?? (await fetch(address, { cache: file.isHashed ? "default" : "no-cache" }));
  if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
  await cache.put(address, direct(answer));
}

/** A page must not get an answer that was redirected. */
function direct(answer: Response): Response {
  if (!answer.redirected) return answer;
  const { status, headers } = answer;
  return new Response(answer.body, { status, headers });
}

async function keepAll(files: readonly SiteFile[]): Promise<void> {
  const waiting = [...files];
  const next = async (): Promise<void> => {
    for (let file = waiting.shift(); file; file = waiting.shift()) await keep(file);
  };
  await Promise.all(Array.from({ length: atOnce }, next));
}

/** Returns whether an older version has kept the library for CAD files. */
async function hadLater(): Promise<boolean> {
  for (const name of await caches.keys()) {
    if (!name.startsWith(prefix)) continue;
    const requests = await (await caches.open(name)).keys();
    if (requests.some(({ url }) => cadName.test(url))) return true;
  }
  return false;
}

async function install(): Promise<void> {
  const all = await hadLater();
  await keepAll(SITE.files.filter(({ isLater }) => all || !isLater));
}

/** Pages that still show an older version may need its files. */
async function removeOld(): Promise<void> {
  if ((await scope.clients.matchAll({ type: "window", includeUncontrolled: true })).length > 1) return;
  const names = await caches.keys();
  const old = names.filter((name) => name.startsWith(prefix) && name !== cacheName);
  await Promise.all(old.map((name) => caches.delete(name)));
}

/** Returns the address under which an answer is kept: pages whatever their parameters are. */
function keptAddress({ url, mode }: Request): string {
  const address = new URL(url);
  address.hash = "";
  if (mode === "navigate") address.search = "";
  return address.href.replace(/\/index\.html$/, "/");
}

const laterFiles = new Set(SITE.files.filter(({ isLater }) => isLater).map(addressOf));

async function answerTo(request: Request): Promise<Response> {
  const address = keptAddress(request);
  const cache = await caches.open(cacheName);
  const known = (await cache.match(address, anyRequest)) ?? (await caches.match(address, anyRequest));
  if (known) return known;
  const answer = await fetch(request);
  if (answer.ok && laterFiles.has(address)) await cache.put(address, answer.clone());
  return answer;
}

scope.addEventListener("install", (event) => event.waitUntil(install()));

scope.addEventListener("activate", (event) => {
  event.waitUntil(Promise.all([scope.clients.claim(), removeOld()]));
});

scope.addEventListener("fetch", (event) => {
  const { request } = event;
  const isOurs = request.url.startsWith(scope.registration.scope);
  if (request.method !== "GET" || !isOurs || request.headers.has("range")) return;
  event.respondWith(answerTo(request));
  if (request.mode === "navigate") event.waitUntil(removeOld());
});

scope.addEventListener("message", (event) => {
  const { data, ports } = event;
  const [port] = ports;
  if (data.kind === "activate") event.waitUntil(scope.skipWaiting());
  else {
    const bytes = SITE.files.reduce((sum, file) => sum + file.bytes, 0);
    const kept = keepAll(SITE.files).then(
      () => port?.postMessage({ kind: "kept", bytes }),
      (error: unknown) => port?.postMessage({ kind: "failed", reason: String(error) }),
    );
    event.waitUntil(kept);
  }
});
