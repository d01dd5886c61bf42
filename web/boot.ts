/**
 * The first script of index.html: loads the app behind the shell of the page, and shows how much of it has arrived. It is small,
 * because on a slow line nothing else runs before it.
 */

/** Bytes of the app's scripts, by their links in the page (scripts/lib/site-preload.mjs). */
function showArrival(bar: HTMLProgressElement): void {
  const links = [...document.querySelectorAll<HTMLLinkElement>("link[data-bytes]")];
  const bytesOf = (link: HTMLLinkElement): number => Number(link.dataset["bytes"]);
  const arrived = new Set(performance.getEntriesByType("resource").map(({ name }) => name));
  const total = links.reduce((sum, link) => sum + bytesOf(link), 0);
  let bytes = 0;
  const add = (link: HTMLLinkElement): void => {
    bytes += bytesOf(link);
    if (total > 0) bar.value = bytes / total;
  };
  for (const link of links) {
    if (arrived.has(link.href)) add(link);
    else link.addEventListener("load", () => add(link), { once: true });
  }
}

const bar = document.getElementById("arrived");
if (bar instanceof HTMLProgressElement) showArrival(bar);

/**
 * Returns the page that a link to a lesson leads to, `?lesson=7`; null for another address. Earlier versions of the app had the
 * lessons in a tab.
 */
function lessonPage(query: URLSearchParams): string | null {
  const lesson = query.get("lesson");
  if (lesson === null) return null;
  return /^(\d|1[01])$/.test(lesson) ? `./lessons/${lesson}/` : "./lessons/";
}

function load(): void {
  import("./main").catch(() => {
    const text = document.getElementById("loading");
    bar?.remove();
    if (text) {
      text.textContent =
        "A part of Tetrafront could not be loaded. Check the connection to the network, then reload this page.";
    }
  });
}

const lesson = lessonPage(new URLSearchParams(location.search));
if (lesson === null) load();
else location.replace(lesson);
