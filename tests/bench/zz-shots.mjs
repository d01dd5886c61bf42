import { chromium } from "playwright";
const [, , name, ...args] = process.argv;
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium-headless-shell",
  args: ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const run = (await import(`/tmp/fixB-shots/${name}.mjs`)).default;
await run({ browser, base: "http://127.0.0.1:5382/", args, out: (n) => `/tmp/fixB-shots/${n}.png` });
await browser.close();
