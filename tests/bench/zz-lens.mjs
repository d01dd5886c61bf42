import { chromium } from "@playwright/test";
const b = await chromium.launch({ executablePath: "/usr/bin/chromium-headless-shell", args: ["--no-sandbox"] });
for (const [lesson, w, h, q] of [[7, 1440, 900, ""], [10, 1440, 900, ""], [6, 1440, 900, "&presenter=1"], [5, 390, 844, ""]]) {
  const p = await b.newPage({ viewport: { width: w, height: h } });
  await p.goto(`http://127.0.0.1:5398/?lesson=${lesson}&test=1${q}`);
  await p.waitForTimeout(7000);
  const lens = p.getByTestId("lens-toggle").or(p.getByRole("tab", { name: "Lens" })).or(p.getByRole("button", { name: /lens/i })).first();
  console.log(lesson, await lens.count());
  if (await lens.count()) { await lens.click().catch((e) => console.log(String(e).slice(0, 100))); await p.waitForTimeout(1500); }
  await p.screenshot({ path: `/tmp/lens${lesson}-${w}.png` });
  await p.close();
}
await b.close();
