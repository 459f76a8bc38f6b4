// Runs of agglo, its files, and pages in Chromium.
//
// The folder target/browser holds the packages (see test.sh) and the runs. AGGLO names the program, CHROMIUM the browser.

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const ROOT = join(dirname(fileURLToPath(import.meta.url)), "..", "..");
const TARGET = join(ROOT, "target", "browser");
const { chromium } = createRequire(join(TARGET, "package.json"))("playwright-core");

export const scenario = (name) => join(ROOT, "scenarios", `${name}.toml`);

// A folder that did not exist before.
export function freshFolder() {
  mkdirSync(join(TARGET, "runs"), { recursive: true });
  return mkdtempSync(join(TARGET, "runs", "run-"));
}

// Calls the program; gives what it says.
export function agglo(...words) {
  const program = process.env.AGGLO ?? join(ROOT, "target", "debug", "agglo");
  return execFileSync(program, words, { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
}

// Runs a scenario or search with settings into a folder of its own; gives the folder.
export function finished(verb, file, settings = []) {
  const folder = join(freshFolder(), "out");
  agglo(verb, file, "-o", folder, ...settings.flatMap((setting) => ["--set", setting]));
  return folder;
}

// A table as columns of numbers by name.
export function table(path) {
  const [head, ...rows] = readFileSync(path, "utf8").trimEnd().split("\n").map((line) => line.split(","));
  return Object.fromEntries(head.map((name, column) => [name, rows.map((row) => Number(row[column]))]));
}

// The arrays of a .vtp file of ours: names with flat lists of numbers.
export function frame(path) {
  const bytes = readFileSync(path);
  const mark = "<AppendedData encoding=\"raw\">\n_";
  const data = bytes.indexOf(mark) + mark.length;
  const arrays = {};
  for (const [tag] of bytes.toString("latin1", 0, data).matchAll(/<DataArray [^>]*>/g)) {
    const [, name] = / Name="([^"]*)"/.exec(tag) ?? [];
    const [, type] = /type="([^"]*)"/.exec(tag);
    const [, offset] = /offset="(\d+)"/.exec(tag) ?? [];
    if (name === undefined || offset === undefined || !["Float64", "UInt32"].includes(type)) continue;
    const at = data + Number(offset);
    const size = type === "Float64" ? 8 : 4;
    const count = Number(bytes.readBigUInt64LE(at)) / size;
    arrays[name] = Array.from({ length: count }, (_, k) =>
      type === "Float64" ? bytes.readDoubleLE(at + 8 + 8 * k) : bytes.readUInt32LE(at + 8 + 4 * k));
  }
  return arrays;
}

let browser;

export async function openBrowser() {
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run"],
  });
}

export async function closeBrowser() {
  await browser.close();
}

// Opens the page of a folder from its file and waits until all of it is there. `page.trouble` collects what the console
// and the network should not have seen.
export async function open(folder, { width = 1000, height = 700, dark = false, touch = false } = {}) {
  const context = await browser.newContext({
    viewport: { width, height }, colorScheme: dark ? "dark" : "light", hasTouch: touch, reducedMotion: "reduce",
  });
  // Software renders the pages here, maybe beside other work.
  context.setDefaultTimeout(60_000);
  const page = await context.newPage();
  page.trouble = [];
  page.on("console", (message) => {
    // The software renderer of tests says that reading pixels is slow.
    if (!message.text().includes("GPU stall due to ReadPixels")) page.trouble.push(`${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", (error) => page.trouble.push(`error: ${error.message}`));
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith("blob:") && !url.startsWith("data:") && url !== page.address) page.trouble.push(`request: ${url}`);
  });
  page.address = pathToFileURL(join(folder, "report.html")).href;
  await page.goto(page.address);
  await page.waitForFunction(() => ["replay", "charts"].every((id) => {
    const part = document.getElementById(id);
    return !part || part.dataset.ready || part.querySelector("[role=alert]");
  }));
  await settled(page);
  return page;
}

// Two pictures later everything asked for so far is drawn.
export const settled = (page) => page.evaluate(() =>
  new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

// A picture of the stage; it stays in the page, which tells how many colours it has.
export async function pixels(page) {
  await settled(page);
  const taken = await page.evaluate(() => {
    const stage = document.querySelector("#replay canvas");
    const copy = document.createElement("canvas");
    Object.assign(copy, { width: stage.width, height: stage.height });
    const pen = copy.getContext("2d", { willReadFrequently: true });
    pen.drawImage(stage, 0, 0);
    const words = new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer);
    window.pictures ??= [];
    window.pictures.push(words);
    return { number: window.pictures.length - 1, colors: new Set(words).size };
  });
  return { page, ...taken };
}

export const colors = (picture) => picture.colors;

// Part of the pixels that differ between two pictures of one page and size.
export const difference = (a, b) => a.page.evaluate(([a, b]) => {
  const [one, other] = [window.pictures[a], window.pictures[b]];
  let count = 0;
  for (let at = 0; at < one.length; at += 1) count += one[at] !== other[at];
  return count / one.length;
}, [a.number, b.number]);
