// Colors, as the data of the page give them: perceptually even maps for numbers, colors that the color-blind can tell apart for
// names, colors with dashes for lines.

const REPORT = JSON.parse(document.getElementById("report").textContent);
const MAPS = Object.fromEntries(Object.entries(REPORT.palette.maps).map(([name, stops]) => [name, stops.map(parseColor)]));
const NAMED = REPORT.palette.names.map(parseColor);
// What stands alone among things that have names.
const ALONE = parseColor(REPORT.palette.plain);

function parseColor(text) {
  return [0, 2, 4].map((at) => parseInt(text.slice(at, at + 2), 16) / 255);
}

// The color [r, g, b] of a part in [0, 1] in a map.
function mapped(map, part) {
  const stops = MAPS[map];
  const place = Math.min(Math.max(part, 0), 1) * (stops.length - 1);
  const from = Math.min(Math.floor(place), stops.length - 2);
  return stops[from].map((a, k) => a + (place - from) * (stops[from + 1][k] - a));
}

function named(number) {
  return NAMED[number % NAMED.length];
}

// What is neutral and stands out from a stage of that color.
function stageInk(stage) {
  return stage[1] > 0.5 ? [0.1, 0.1, 0.1] : [0.95, 0.95, 0.95];
}

// Walls stand back on a stage of that color.
function wallColor(stage) {
  return stage[1] > 0.5 ? [0.45, 0.53, 0.62] : [0.6, 0.68, 0.77];
}

// The heaviest cluster has the first color for itself.
function clusterColor(cluster) {
  return NAMED[cluster === 0 ? 0 : 1 + ((cluster - 1) % (NAMED.length - 1))];
}

// A map as plotly wants it.
function scaleOf(map) {
  return MAPS[map].map((color, k, all) => [k / (all.length - 1), css(color)]);
}

function css(color) {
  return `rgb(${color.map((part) => Math.round(255 * part)).join(" ")})`;
}

// A quantity in few digits, for people: 0.00123 -> "1.23e-3".
function quantity(value) {
  if (!Number.isFinite(value)) return "none";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return value.toExponential(2).replace("e+", "e");
  return String(Number(value.toPrecision(4)));
}
