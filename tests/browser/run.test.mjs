// The page of a run of soft spheres: it opens offline, draws, and does what its controls say.

import assert from "node:assert/strict";
import { readdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { closeBrowser, colors, difference, finished, frame, open, openBrowser, pixels, scenario, settled, table } from "./tools.mjs";

let folder;
let page;

const replay = (body) => page.evaluate(`{ const replay = window.agglo.replay; ${body} }`);
const part = (name) => page.locator(`#replay [data-part=${name}]`);
const shown = () => replay("replay.frame");

before(async () => {
  folder = finished("run", scenario("ink-agglomerate"),
    ["time.end=\"0.6 us\"", "output.frames=\"0.05 us\"", "output.series=\"0.01 us\""]);
  await openBrowser();
});

after(closeBrowser);

test("opens from its file without a request or a word in the console", async () => {
  page = await open(folder);
  assert.deepEqual(page.trouble, []);
  assert.equal(await page.locator("#replay[data-ready]").count(), 1);
  assert.equal(await page.locator("#charts[data-ready]").count(), 1);
  assert.equal(await page.locator("[role=alert]").count(), 0);
});

test("draws grains, bonds and rays in many colours", async () => {
  const whole = await pixels(page);
  assert.ok(colors(whole) > 500, `${colors(whole)} colours`);
  await replay("replay.show(6)");
  const all = await pixels(page);
  for (const name of ["rays", "bonds"]) {
    await part(name).uncheck();
    const without = await pixels(page);
    // Bonds are inside of grains that touch, but these are apart.
    assert.ok(await difference(all, without) > 1e-4, `${name} change nothing`);
    await part(name).check();
  }
  assert.equal(await difference(all, await pixels(page)), 0, "and back");
  const small = part("size");
  await small.fill("0.3");
  assert.ok(await difference(all, await pixels(page)) > 0.05, "smaller grains");
  await small.fill("1");
});

test("plays, scrubs and steps", async () => {
  await replay("replay.show(0)");
  const first = await pixels(page);
  await part("rate").selectOption("30");
  await part("play").click();
  await page.waitForFunction(() => window.agglo.replay.frame >= 3);
  await part("play").click();
  const stopped = await shown();
  assert.ok(await difference(first, await pixels(page)) > 0.005, "it moves");
  await page.waitForTimeout(150);
  assert.equal(await shown(), stopped, "a pause is a pause");
  await part("play").click();
  const last = (await replay("replay.frames.count")) - 1;
  await page.waitForFunction((last) => window.agglo.replay.frame === last && !window.agglo.replay.playing, last);
  assert.equal(await part("play").textContent(), "Play", "it stops at the end");
  await part("scrub").fill("2");
  assert.equal(await shown(), 2);
  assert.match(await part("time").textContent(), /^10\d(\.\d+)? ns$/);
  await part("on").click();
  assert.equal(await shown(), 3);
  await part("back").click();
  await part("back").click();
  assert.equal(await shown(), 1);
});

test("colours by what the frames hold", async () => {
  await replay("replay.show(8)");
  const choices = await part("color").locator("option").evaluateAll((options) => options.map((option) => option.value));
  for (const wanted of ["speed", "cluster", "absorbed_power", "size", "id"]) assert.ok(choices.includes(wanted), wanted);
  const pictures = [];
  for (const choice of choices) {
    await part("color").selectOption(choice);
    const legend = await part("legend").textContent();
    const label = await part("color").locator(`option[value=${choice}]`).textContent();
    assert.ok(legend.includes(label), `${legend} does not say ${label}`);
    const picture = await pixels(page);
    for (const other of pictures) assert.ok(await difference(picture, other) > 0.01, `${choice} looks like another`);
    pictures.push(picture);
  }
  await part("color").selectOption("speed");
});

test("turns, zooms and moves by mouse and keys", async () => {
  const canvas = page.locator("#replay canvas");
  const box = await canvas.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  let before = await pixels(page);
  const changed = async (what) => {
    const now = await pixels(page);
    assert.ok(await difference(before, now) > 0.01, what);
    before = now;
  };
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 90, y + 40, { steps: 4 });
  await page.mouse.up();
  await changed("drag turns");
  assert.ok(await part("follow").isChecked(), "turning does not end following");
  await page.mouse.wheel(0, -300);
  await changed("wheel zooms");
  assert.ok(!(await part("follow").isChecked()), "zooming ends following");
  await page.keyboard.down("Shift");
  await page.mouse.down();
  await page.mouse.move(x - 60, y, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.up("Shift");
  await changed("shift and drag moves");
  await canvas.focus();
  for (const key of ["ArrowLeft", "ArrowUp", "+", "-", "Home"]) {
    await page.keyboard.press(key);
    await changed(key);
  }
  await page.keyboard.press("Space");
  assert.ok(await replay("replay.playing"), "space plays");
  await page.keyboard.press("Space");
  await replay("replay.show(4)");
  await page.keyboard.press(".");
  assert.equal(await shown(), 5);
  await page.keyboard.press(",");
  assert.equal(await shown(), 4);
  const outline = await canvas.evaluate((stage) => getComputedStyle(stage).outlineStyle);
  assert.equal(outline, "solid", "the focus is seen");
});

// Shows a frame; gives its grains, the grain that reaches nearest to the eye, which hides nothing of its middle from us, and where
// that is on the page.
async function nearestGrain(number) {
  await replay(`replay.reset(); replay.show(${number})`);
  const canvas = page.locator("#replay canvas");
  await canvas.scrollIntoViewIfNeeded();
  const grains = frame(join(folder, "frames", `grains_${String(number).padStart(6, "0")}.vtp`));
  const eye = await replay("replay.camera.eye()");
  const center = (grain) => grains.Points.slice(3 * grain, 3 * grain + 3);
  const away = (grain) => Math.hypot(...center(grain).map((part, k) => part - eye[k])) - grains.radius_m[grain];
  const nearest = grains.id.map((_, grain) => grain).reduce((a, b) => (away(a) < away(b) ? a : b));
  const box = await canvas.boundingBox();
  const [view, projection] = await replay(
    `[Array.from(replay.camera.view()), Array.from(replay.camera.projection(${box.width / box.height}))]`);
  const times = (matrix, vector) => [0, 1, 2, 3].map((row) => vector.reduce((sum, part, k) => sum + matrix[4 * k + row] * part, 0));
  const clip = times(projection, times(view, [...center(nearest), 1]));
  const at = [box.x + (box.width * (1 + clip[0] / clip[3])) / 2, box.y + (box.height * (1 - clip[1] / clip[3])) / 2];
  return { grains, nearest, at, box };
}

test("a click shows the figures of the grain that is there", async () => {
  const canvas = page.locator("#replay canvas");
  const { grains, nearest, at, box } = await nearestGrain(8);
  const before = await pixels(page);
  await page.mouse.click(...at);
  const figures = await part("chosen").evaluate((list) =>
    Object.fromEntries([...list.querySelectorAll("dt")].map((name) => [name.textContent, name.nextSibling.textContent])));
  assert.equal(figures.grain, String(grains.id[nearest]));
  const columns = await replay("replay.plan.columns");
  const close = (label, wanted) => {
    const { low, high } = columns.find((column) => column.label === label);
    const found = Number.parseFloat(figures[label]);
    assert.ok(Math.abs(found - wanted) <= (high - low) / 65535 + 1e-2 * Math.abs(wanted), `${label}: ${found}, not ${wanted}`);
  };
  close("speed", Math.hypot(...grains.velocity_m_s.slice(3 * nearest, 3 * nearest + 3)));
  close("radius", grains.radius_m[nearest]);
  close("absorbed power", grains.absorbed_power_w[nearest]);
  assert.equal(Number(figures.cluster), grains.cluster[nearest]);
  assert.ok(await difference(before, await pixels(page)) > 1e-4, "the grain is marked");
  await page.mouse.click(box.x + 4, box.y + 4);
  assert.ok(await part("chosen").isHidden(), "a click beside all grains lets go");
  await part("name").fill("17");
  await part("name").press("Enter");
  assert.match(await part("chosen").textContent(), /grain17/);
  await canvas.focus();
  await page.keyboard.press("Escape");
  assert.ok(await part("chosen").isHidden());
});

test("charts hold the numbers of the tables", async () => {
  const drawn = await page.evaluate(() => Object.fromEntries([...document.querySelectorAll(".chart")].map((place) =>
    [place.id.slice("chart-".length), place.data.map(({ name, x, y }) => ({ name, x: [...x], y: [...y] }))])));
  const wanted = {
    stores: ["energy", { kinetic: "kinetic_J", elastic: "elastic_J", bonds: "bonds_J" }],
    flows: ["energy", { "put in by rays": "work_rays_J", "lost to drag": "lost_drag_J" }],
    dispersion: ["clusters", { "dispersion degree": "dispersion_degree", "largest cluster": "largest_fraction" }],
    clusters: ["clusters", { clusters: "clusters", bonds: "bonds" }],
    rays: ["rays", { "in flight": "in_flight", reflections: "reflections" }],
    beam: ["rays", { "along x": "beam_x", "in all": "beam_magnitude" }],
    flying: ["rays", { "along x": "flying_x", "in all": "flying_magnitude" }],
    speed: ["moments", { largest: "largest_speed_m_s" }],
    step: ["steps", { "step size": "step_size_s" }],
  };
  let numbers = 0;
  for (const [id, [file, columns]] of Object.entries(wanted)) {
    const rows = table(join(folder, "series", `${file}.csv`));
    for (const [name, column] of Object.entries(columns)) {
      const line = drawn[id].find((one) => one.name === name);
      assert.ok(line, `${id} has no ${name}`);
      assert.deepEqual(line.x, rows.time_s);
      assert.deepEqual(line.y, rows[column]);
      numbers += line.y.length;
    }
  }
  assert.ok(numbers > 500, `${numbers} numbers`);
});

test("charts say figures where one points, and zoom", async () => {
  const place = page.locator("#chart-stores");
  await place.scrollIntoViewIfNeeded();
  const box = await place.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 3];
  await page.mouse.move(x - 5, y);
  await page.mouse.move(x, y);
  await page.waitForSelector("#chart-stores .hoverlayer text");
  assert.match(await place.locator(".hoverlayer").textContent(), /kinetic.*J/);
  const range = () => place.evaluate((chart) => chart.layout.xaxis.range.map(Number));
  const whole = await range();
  await page.mouse.down();
  await page.mouse.move(x + 80, y, { steps: 5 });
  await page.mouse.up();
  await page.waitForFunction((before) => document.querySelector("#chart-stores").layout.xaxis.range[1] < before, whole[1]);
  const [from, to] = await range();
  assert.ok(to - from < 0.5 * (whole[1] - whole[0]));
});

test("every picture has words", async () => {
  for (const image of await page.locator("[role=img]:not(svg *)").all()) {
    const words = await image.getAttribute("aria-label");
    assert.ok(words?.length > 20, `${words}`);
  }
  const charts = await page.locator("figure").count();
  assert.equal(await page.locator("figure details li").first().count(), 1);
  assert.equal(await page.locator("figure figcaption").count(), charts);
});

test("tells what was run, how to run it again, what to cite, and licences", async () => {
  const text = await page.locator("body").evaluate((body) => body.textContent);
  for (const wanted of ["Pigment agglomerate", "634 grains were followed", "energy drift", "agglo run scenario.toml -o again",
    "seed", "K. L. Johnson", "Plotly, Inc.", "WITHOUT WARRANTY", "default"]) {
    assert.ok(text.includes(wanted), wanted);
  }
  assert.ok(await page.locator(".file .default").count() > 10, "defaults are marked");
});

test("nothing was asked of the network and nothing complained in all of this", async () => {
  await settled(page);
  assert.deepEqual(page.trouble, []);
  await page.context().close();
});

test("a phone shows it without scrolling sideways, also in the dark", async () => {
  for (const dark of [false, true]) {
    page = await open(folder, { width: 390, height: 844, dark, touch: true });
    const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(content <= window, `${content} > ${window}`);
    assert.ok(colors(await pixels(page)) > 300);
    await page.touchscreen.tap(...(await nearestGrain(0)).at);
    await part("chosen").waitFor({ state: "visible" });
    const back = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = Number(/\d+/.exec(back)[0]);
    assert.ok(dark ? light < 60 : light > 200, back);
    assert.deepEqual(page.trouble, []);
    await page.context().close();
  }
});

test("every frame of the folder is in the replay", async () => {
  page = await open(folder);
  const files = readdirSync(join(folder, "frames")).filter((name) => /^grains_.*vtp$/.test(name));
  assert.equal(await replay("replay.frames.count"), files.length);
  const last = files.length - 1;
  const wanted = frame(join(folder, "frames", `grains_${String(last).padStart(6, "0")}.vtp`));
  const found = await replay(`Array.from(replay.frames.grains(${last}, 1).centers)`);
  const reach = Math.max(...wanted.Points) - Math.min(...wanted.Points);
  wanted.Points.forEach((place, at) => assert.ok(Math.abs(place - found[at]) < 1e-4 * reach));
  await page.context().close();
});
