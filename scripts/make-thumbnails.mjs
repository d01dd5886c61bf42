/**
 * Renders the pictures of the gallery, public/thumbnails/<id>.webp, with the built site in Chromium: `node
 * scripts/make-thumbnails.mjs [id …]`. Run it after you change a model or the look of the view.
 */
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { chromium } from "playwright";
import { preview } from "vite";
import { inRoot } from "./lib/paths.mjs";
import { main } from "./lib/run.mjs";
import { findChromium } from "./lib/tools.mjs";

/** The view is rendered larger and then reduced, which smooths its edges. */
const size = { width: 240, height: 150 };
const reduction = 4;
const quality = 0.7;
/** Keys pressed in the view before rendering: a small picture needs no margin. */
const closer = ["+", "+"];
const launchArguments = [
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--use-gl=angle",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
];
/** Hides everything but the picture, on a transparent background; the gallery adds its own. */
const style = `
  [data-testid="viewport"] { position: fixed; inset: 0; z-index: 9; }
  html, body, [data-testid="app"], main { background: transparent !important; }
  header, nav, footer, main > :not([data-testid="viewport"]) { visibility: hidden; }
  [data-testid="viewport"] > div { display: none; }
  canvas { outline: none !important; }
`;

async function picture(page, url, id) {
  await page.goto(`${url}?test=1&model=${id}`);
  const viewport = page.getByTestId("viewport");
  await viewport.and(page.locator("[data-status=done][data-busy=false]")).waitFor({ timeout: 300_000 });
  await page.addStyleTag({ content: style });
  await page.evaluate(() => globalThis.dispatchEvent(new Event("resize")));
  await page.getByTestId("viewport-canvas").focus();
  for (const key of ["0", ...closer]) await page.keyboard.press(key);
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 600)));
  const png = await page.screenshot({ omitBackground: true });
  const reduced = await page.evaluate(
    async ([source, { width, height }, wantedQuality]) => {
      const image = new globalThis.Image();
      image.src = source;
      await image.decode();
      const canvas = globalThis.document.createElement("canvas");
      canvas.width = width;
      canvas.height = height;
      const context = canvas.getContext("2d");
      context.imageSmoothingQuality = "high";
      context.drawImage(image, 0, 0, width, height);
      return canvas.toDataURL("image/webp", wantedQuality);
    },
    [`data:image/png;base64,${png.toString("base64")}`, size, quality],
  );
  return Buffer.from(reduced.split(",")[1], "base64");
}

async function makeThumbnails() {
  const { models } = JSON.parse(readFileSync(inRoot("public", "index.json"), "utf8"));
  const wanted = process.argv.slice(2);
  const server = await preview({ root: inRoot("web"), preview: { port: 0, host: "127.0.0.1" } });
  const browser = await chromium.launch({ executablePath: findChromium(), args: launchArguments });
  try {
    const viewport = { width: size.width * reduction, height: size.height * reduction };
    mkdirSync(inRoot("public", "thumbnails"), { recursive: true });
    for (const { id } of models.filter((model) => wanted.length === 0 || wanted.includes(model.id))) {
      const context = await browser.newContext({ bypassCSP: true, viewport, colorScheme: "dark" });
      const page = await context.newPage();
      const bytes = await picture(page, server.resolvedUrls.local[0], id);
      writeFileSync(path.join(inRoot("public", "thumbnails"), `${id}.webp`), bytes);
      process.stdout.write(`${id}: ${bytes.length} bytes\n`);
      await context.close();
    }
  } finally {
    await browser.close();
    await server.close();
  }
}

await main(makeThumbnails);
