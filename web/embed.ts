/** The page embed.html: one state of a recorded front, without panels. Everything else is loaded when it comes into view. */
const root = document.getElementById("root");

/** Calls back when the element is first in view, also in a frame of another page. */
function whenSeen(element: Element, act: () => void): void {
  const watch = new IntersectionObserver((entries) => {
    if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
    watch.disconnect();
    act();
  });
  watch.observe(element);
}

if (root) {
  // An element without height is never in view.
  root.style.minHeight = "100dvh";
  whenSeen(root, () => {
    void import("./teach/embed/start-embed").then(({ startEmbed }) =>
      startEmbed(root, new URLSearchParams(window.location.search)),
    );
  });
}
