// Colours. Numbers go through viridis (S. van der Walt, N. Smith, 2015, CC0): even steps look even, also to the
// colour-blind and in grey. Names go through the eight colours of M. Okabe and K. Ito (2008).

const VIRIDIS = ["440154", "482475", "414487", "355f8d", "2a788e", "21918c", "22a884", "44bf70", "7ad151", "bddf26",
  "fde725"].map(parseColor);
const NAMED = ["0072b2", "e69f00", "009e73", "d55e00", "56b4e9", "cc79a7", "f0e442", "7a7a7a"].map(parseColor);

function parseColor(text) {
  return [0, 2, 4].map((at) => parseInt(text.slice(at, at + 2), 16) / 255);
}

// The colour [r, g, b] of a part in [0, 1].
function viridis(part) {
  const place = Math.min(Math.max(part, 0), 1) * (VIRIDIS.length - 1);
  const from = Math.min(Math.floor(place), VIRIDIS.length - 2);
  return VIRIDIS[from].map((a, k) => a + (place - from) * (VIRIDIS[from + 1][k] - a));
}

function named(number) {
  return NAMED[number % NAMED.length];
}

// What stands alone among things that have names.
const ALONE = parseColor("b4b4b4");

function css(color) {
  return `rgb(${color.map((part) => Math.round(255 * part)).join(" ")})`;
}

// A figure in few digits, for people: 0.00123 -> "1.23e-3".
function figure(value) {
  if (!Number.isFinite(value)) return "none";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return value.toExponential(2).replace("e+", "e");
  return String(Number(value.toPrecision(4)));
}
