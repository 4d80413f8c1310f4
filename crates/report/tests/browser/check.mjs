// Opens a report in headless Chromium and uses it as a reader would.
//
//   node crates/report/tests/browser/check.mjs REPORT.html [SCREENSHOT.png]
//
// Needs Node 18 or newer, the npm package `playwright-core` where Node finds it
// (`npm install --no-save playwright-core`, or its folder's parent in NODE_PATH),
// and Chromium (CHROMIUM, by default /usr/bin/chromium). Exits with 1 and says
// why if the report misbehaves.

import assert from "node:assert/strict";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [report, screenshot] = process.argv.slice(2);
if (!report) {
  console.error("usage: check.mjs REPORT.html [SCREENSHOT.png]");
  process.exit(2);
}
// `require` also looks where the command is run and in NODE_PATH; `import` does not.
const require = createRequire(path.join(process.cwd(), "check.cjs"));
const { chromium } = require("playwright-core");

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"],
});

async function open(options) {
  const page = await browser.newPage(options);
  const faults = [];
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(error.message));
  const url = pathToFileURL(path.resolve(report)).href;
  page.on("request", (request) => request.url() !== url && faults.push(`loads ${request.url()}`));
  await page.goto(url);
  return [page, faults];
}
const pixels = (page, id) => page.$eval(`#${id}`, (canvas) => canvas.toDataURL());
const text = (page, id) => page.$eval(`#${id}`, (node) => node.innerText);
async function choose(page, id, value) {
  await page.$eval(`#${id}`, (input, v) => {
    input.value = v;
    input.dispatchEvent(new Event("input", { bubbles: true }));
  }, value);
}

let epochs = 0;
try {
  const [page, faults] = await open({ viewport: { width: 1280, height: 900 }, colorScheme: "light" });
  epochs = await page.evaluate(() => JSON.parse(document.getElementById("record").textContent).epochs.length);
  assert.ok(epochs > 0, "the report has no epochs");

  // Every canvas shows more than one colour.
  for (const id of ["map", "section", "profile", "utility", "history"]) {
    const colours = await page.$eval(`#${id}`, (canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return new Set(new Uint32Array(data.buffer)).size;
    });
    assert.ok(colours > 4, `#${id} is blank`);
  }

  // The slider, by keyboard, changes name, numbers and pictures.
  await page.focus("#epoch");
  for (let k = 1; k < epochs; k++) {
    const before = [await text(page, "epoch-name"), await text(page, "tiles"), await pixels(page, "map")];
    await page.keyboard.press("ArrowRight");
    const after = [await text(page, "epoch-name"), await text(page, "tiles"), await pixels(page, "map")];
    before.forEach((value, n) => assert.notEqual(value, after[n], `epoch ${k}: ${["name", "numbers", "map"][n]} unchanged`));
    assert.match(after[0], new RegExp(`^Epoch ${k} `));
  }
  assert.equal(await page.$eval("#next", (button) => button.disabled), true);
  assert.equal(await page.$$eval("#numbers thead th", (cells) => cells.length), epochs + 1);

  // Every layer draws, and differs from the one before.
  let seen = await pixels(page, "map");
  for (const layer of await page.$$eval("#layer option", (options) => options.map((o) => o.value))) {
    await page.selectOption("#layer", layer);
    const drawn = await pixels(page, "map");
    if (layer !== "detection") assert.notEqual(drawn, seen, `layer ${layer} draws nothing new`);
    seen = drawn;
  }
  for (const id of ["show-current", "show-depth"]) await page.check(`#${id}`);

  // Time within the epoch moves vehicles; a chosen vehicle tells its route.
  seen = await pixels(page, "map");
  await choose(page, "time", "0.2");
  assert.notEqual(await pixels(page, "map"), seen, "time moves nothing");
  const vehicles = await page.$$eval("#vehicle option", (options) => options.map((o) => o.value));
  if (vehicles.length > 1) {
    await page.selectOption("#vehicle", vehicles[1]);
    assert.match(await text(page, "route"), /Expected travel time/);
  }

  // Pointing at the map reads its cells; a click moves the section.
  const { width, height } = await (await page.$("#map")).boundingBox();
  await page.hover("#map", { position: { x: width * 0.3, y: height * 0.3 } });
  const first = await text(page, "cell");
  await page.hover("#map", { position: { x: width * 0.6, y: height * 0.6 } });
  assert.notEqual(await text(page, "cell"), first, "pointing reads nothing");
  assert.match(first, /° E/);
  await page.focus("#map");
  const title = await text(page, "section-title");
  await page.keyboard.press("ArrowUp");
  assert.notEqual(await text(page, "section-title"), title, "arrow keys do not move the cell");
  if (screenshot) await page.screenshot({ path: screenshot, fullPage: true });
  assert.deepEqual(faults, []);
  await page.close();

  // Dark, on a telephone: no sideways scrolling, no errors.
  const [phone, phoneFaults] = await open({ viewport: { width: 390, height: 800 }, colorScheme: "dark" });
  const wide = await phone.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `the page is ${wide} pixels wide on a screen of 390`);
  assert.deepEqual(phoneFaults, []);
} catch (error) {
  console.error(`${report}: ${error.message}`);
  process.exitCode = 1;
} finally {
  await browser.close();
}
if (!process.exitCode) console.log(`${report}: ${epochs} epochs, every control works, no errors`);
