/**
 * The service worker of the built site, sw.js: after one visit of the app or of a lesson, the site works without a network. The
 * build replaces SITE by the list of its files (scripts/lib/site-offline.mjs).
 *
 * Each version of the site has a cache of its own, and a page gets all its files from one version. A new version is fetched in
 * the background, and waits until a page asks for it. Files of an older version stay for the pages that still show it.
 */
interface SiteFile {
  /** Relative to the folder of the site. */
  readonly path: string;
  readonly bytes: number;
  /** Missing if its name changes with its content. */
  readonly sha256?: string;
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
  readonly registration: Pick<ServiceWorkerRegistration, "scope" | "installing" | "waiting">;
  readonly clients: { claim(): Promise<void>; matchAll(options: object): Promise<readonly unknown[]> };
  skipWaiting(): Promise<void>;
  addEventListener(type: "install" | "activate", act: (event: ExtendableEvent) => void): void;
  addEventListener(type: "fetch", act: (event: FetchEvent) => void): void;
  addEventListener(type: "message", act: (event: MessageEventWithWork) => void): void;
}

const scope = globalThis as unknown as Scope;
/** All sites of a host share its caches. The path of a site has no blank. */
const prefix = `tetrafront ${new URL(scope.registration.scope).pathname} `;
const cacheName = `${prefix}${SITE.version}`;
/** Files that are fetched at the same time: browsers keep six connections to a host, and the page needs some of them. */
const atOnce = 4;
/** The headers of an answer may name others that differ between pages and this worker. */
const anyRequest = { ignoreVary: true } as const;

const addressOf = ({ path }: SiteFile): string => new URL(path, scope.registration.scope).href;

const cadName = /\/(occt-import-js|replicad_single)-[^/]*$/;

/** Names of the caches of this site, those of other versions too. */
async function siteCaches(): Promise<readonly string[]> {
  return (await caches.keys()).filter((name) => name.startsWith(prefix));
}

/** Returns what any version of the site has kept under an address. */
async function keptByAny(address: string): Promise<Response | undefined> {
  for (const cacheName of await siteCaches()) {
    const known = await caches.match(address, { ...anyRequest, cacheName });
    if (known) return known;
  }
  return undefined;
}

/** Returns whether an answer holds the file of this version: while a host gets a new version, it may have files of both. */
async function isOwn({ sha256 }: SiteFile, answer: Response): Promise<boolean> {
  if (sha256 === undefined) return true;
  const digest = await crypto.subtle.digest("SHA-256", await answer.arrayBuffer());
  const bytes = Array.from(new Uint8Array(digest), (byte) => byte.toString(16).padStart(2, "0"));
  return bytes.join("") === sha256;
}

/** Puts a file into the cache of this version; from that of another one if it is the same. */
async function keep(file: SiteFile): Promise<void> {
  const cache = await caches.open(cacheName);
  const address = addressOf(file);
  if (await cache.match(address, anyRequest)) return;
  const isHashed = file.sha256 === undefined;
  const known = isHashed ? await keptByAny(address) : undefined;
  // Files without a hash in their names may be old in the browser's own cache.
  const answer =
    known ?? (await fetch(address, { cache: isHashed ? "default" : "no-cache", priority: "low" }));
  if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
  if (!(await isOwn(file, answer.clone()))) throw new Error(`${address} is of another version`);
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
  for (const name of await siteCaches()) {
    const requests = await (await caches.open(name)).keys();
    if (requests.some(({ url }) => cadName.test(url))) return true;
  }
  return false;
}

async function install(): Promise<void> {
  const all = await hadLater();
  await keepAll(SITE.files.filter(({ isLater }) => all || !isLater));
}

/** Removes the caches of older versions, unless a page may still show one of them, or one of the caches is that of a newer version. */
async function removeOld(): Promise<void> {
  const pages = await scope.clients.matchAll({ type: "window", includeUncontrolled: true });
  const names = await siteCaches();
  const { installing, waiting } = scope.registration;
  if (pages.length > 1 || installing || waiting) return;
  await Promise.all(names.filter((name) => name !== cacheName).map((name) => caches.delete(name)));
}

/** Returns the address under which an answer is kept: pages whatever their parameters are. */
function keptAddress({ url, mode }: Request): string {
  const address = new URL(url);
  address.hash = "";
  if (mode === "navigate") address.search = "";
  return address.href.replace(/\/index\.html$/, "/");
}

const filesByAddress = new Map(SITE.files.map((file) => [addressOf(file), file]));

/** What is not kept, because it is used for the first time or the browser has dropped it, is fetched and kept. */
async function answerTo(request: Request): Promise<Response> {
  const address = keptAddress(request);
  const cache = await caches.open(cacheName);
  const own = await cache.match(address, anyRequest);
  if (own) return own;
  const file = filesByAddress.get(address);
  // A file of the same name in another version is used only without a network.
  const isOther = file?.sha256 !== undefined;
  const known = await keptByAny(address);
  if (known && !isOther) return known;
  const answer = await fetch(request).catch((error: unknown) => {
    if (known) return known;
    throw error;
  });
  if (answer !== known && file && answer.ok && (await isOwn(file, answer.clone()))) {
    // The storage may be full.
    await cache.put(address, direct(answer.clone())).catch(() => undefined);
  }
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
