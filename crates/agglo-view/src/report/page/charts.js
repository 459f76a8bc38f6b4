// Charts by plotly: hover for values, drag to zoom, double click to go back, click a name to hide its line.

const LINES = REPORT.palette.lines.map(([color, dashes, width]) => ({
  color, width, dash: dashes.split(" ").filter(Boolean).map((part) => `${part}px`).join(",") || "solid",
}));
const VIRIDIS = scaleOf("viridis");
// What each kind of chart is drawn with: its traces, and what it wants of the layout.
const KINDS = {
  curves: drawCurves, bars: drawBars, heatmap: drawHeatmap, histogram: drawHistogram, parallel: drawParallel, pairs: drawPairs,
};

class Chart {
  constructor(place, chart) {
    Object.assign(this, { place, chart });
    this.draw();
  }

  draw() {
    const style = getComputedStyle(document.documentElement);
    const tone = (name) => style.getPropertyValue(name).trim();
    const { kind, axes, series } = this.chart;
    // Many axes need room beside each other, or below; the card then scrolls.
    if (kind === "parallel") this.place.style.minWidth = `${5 * axes.length}rem`;
    if (kind === "pairs") {
      Object.assign(this.place.style, { minWidth: `${8 + 8 * axes.length}rem`, height: `${Math.max(22, 9 * axes.length)}rem` });
    }
    // On a phone each name in the legend has a row of its own.
    if (series && this.place.clientWidth < 480) this.place.style.height = `${15 + 1.4 * series.length}rem`;
    const { traces, layout } = KINDS[kind](this.chart, tone);
    const base = {
      paper_bgcolor: "transparent", plot_bgcolor: "transparent",
      font: { color: tone("--text"), family: "system-ui, sans-serif", size: 13 },
      margin: { l: 60, r: 16, t: 12, b: 48 }, hovermode: "closest", showlegend: false, legend: { orientation: "h", y: -0.25 },
      modebar: { bgcolor: "rgba(0, 0, 0, 0)", color: tone("--soft"), activecolor: tone("--text") },
      hoverlabel: { bgcolor: tone("--card"), font: { color: tone("--text") } },
    };
    const config = { responsive: true, displaylogo: false, modeBarButtonsToRemove: ["lasso2d", "select2d"] };
    Plotly.react(this.place, traces, { ...base, ...layout }, config);
  }
}

// Ticks have prefixes and units: "150 μs"; pure numbers are written out up to 100,000.
function axis({ name, unit, is_log: isLog, labels }, tone, values = []) {
  const base = {
    title: { text: name, standoff: 8 }, gridcolor: tone("--line"), zerolinecolor: tone("--line"), automargin: true,
  };
  if (labels.length > 0) return { ...base, tickvals: labels.map((_, place) => place), ticktext: labels };
  return {
    ...base, type: isLog ? "log" : "linear", exponentformat: unit ? "SI" : "power",
    minexponent: unit ? 2 : 4, ticksuffix: unit, ...(unit && { tickformat: ".6~s" }),
    hoverformat: unit ? ".4~s" : ".5~g", ...(isLog && decades(values, unit)),
  };
}

// Ticks of a logarithmic axis: at tens alone, or with numbers between, where there would be less than two tens.
function decades(values, unit) {
  const shown = values.filter((value) => value > 0);
  const [least, most] = [Math.min, Math.max].map((of) => shown.reduce((a, b) => of(a, b), shown[0]));
  return most < 100 * least ? { nticks: 3, tickformat: unit ? "~s" : "~g" } : { dtick: 1 };
}

function drawCurves({ x, y, series, references }, tone) {
  let next = 0;
  const traces = series.flatMap((one) => {
    const pen = one.look === "faint" ? { color: tone("--soft"), width: 1, dash: "solid" } : LINES[next++ % LINES.length];
    return [...bandTrace(one, pen), curveTrace(one, pen, x.is_log ? undefined : one.x_errors)];
  });
  const areLines = series.every(({ look }) => look === "line");
  const all = (side) => series.flatMap((one) => one[side]);
  return {
    traces,
    layout: {
      xaxis: axis(x, tone, all("x")), yaxis: axis(y, tone, all("y")), hovermode: areLines ? "x unified" : "closest",
      showlegend: series.length > 1 || references.length > 0, shapes: references.map((one) => referenceShape(one, tone)),
    },
  };
}

const LOOKS = {
  line: { mode: "lines" }, points: { mode: "markers" }, faint: { mode: "markers" }, dotted: { mode: "lines+markers" },
  stairs_after: { mode: "lines+markers", shape: "hv" }, stairs_before: { mode: "lines+markers", shape: "vh" },
};

function curveTrace({ name, x, y, look, spread, texts }, { color, width, dash }, xErrors) {
  const { mode, shape = "linear" } = LOOKS[look];
  const isLine = look === "line";
  return {
    type: "scatter", mode: isLine && x.length < 2 ? "markers" : mode, name, x, y, text: texts, showlegend: name !== "",
    line: { color, width, dash: isLine ? dash : "solid", shape }, marker: { color, size: look === "faint" ? 5 : 8 },
    error_y: errorBars(y, spread, color), ...(xErrors?.length > 0 && { error_x: { type: "data", array: xErrors, color, thickness: 1.5 } }),
  };
}

// Bars of error: as long up as down, or from one end to the other; none where nothing is known.
function errorBars(values, { errors, intervals }, color) {
  if (!errors && !intervals) return undefined;
  const looks = { type: "data", color, thickness: 1.5 };
  if (errors) return { ...looks, array: errors.map((error) => error || NaN) };
  const isKnown = ([low, high]) => low !== null && high !== null && high > low;
  const ends = intervals.map((ends, at) => (isKnown(ends) ? [values[at] - ends[0], ends[1] - values[at]] : [NaN, NaN]));
  return { ...looks, symmetric: false, array: ends.map(([, up]) => up), arrayminus: ends.map(([down]) => down) };
}

function bandTrace({ x, spread }, { color }) {
  if (!spread.band) return [];
  const [lower, upper] = [0, 1].map((end) => spread.band.map((ends) => ends[end]));
  return [{
    type: "scatter", mode: "none", x: [...x, ...[...x].reverse()], y: [...lower, ...upper.reverse()], fill: "toself",
    fillcolor: `${color}2e`, hoverinfo: "skip", showlegend: false,
  }];
}

// What goes all the way through: a line at a height or at a place, or all heights between two.
function referenceShape({ name, at }, tone) {
  const named = { name, showlegend: true, layer: "below" };
  if (at.heights) {
    const [y0, y1] = at.heights;
    return { ...named, type: "rect", xref: "paper", x0: 0, x1: 1, y0, y1, fillcolor: LINES[2].color, opacity: 0.2, line: { width: 0 } };
  }
  const place = at.across === undefined
    ? { xref: "paper", x0: 0, x1: 1, y0: at.height, y1: at.height, line: { color: LINES[1].color, width: 2, dash: "dash" } }
    : { yref: "paper", y0: 0, y1: 1, x0: at.across, x1: at.across, line: { color: tone("--text"), width: 1.5, dash: "dot" } };
  return { ...named, type: "line", ...place };
}

function drawBars({ label, names, axis: lengths, series }, tone) {
  const traces = series.map(({ name, values, spread }, number) => ({
    type: "bar", name, x: names.map((_, place) => place), y: values, marker: { color: LINES[number % LINES.length].color },
    error_y: errorBars(values, spread, tone("--text")),
  }));
  const x = { name: label, unit: "", is_log: false, labels: names };
  return { traces, layout: { xaxis: axis(x, tone), yaxis: axis(lengths, tone), showlegend: series.length > 1 } };
}

function drawHeatmap({ x, y, shade, columns, rows, values }, tone) {
  const colorbar = { title: { text: shade.name, side: "right" }, thickness: 14 };
  const traces = [{ type: "heatmap", name: shade.name, x: columns, y: rows, z: values, colorscale: VIRIDIS, colorbar }];
  return { traces, layout: { xaxis: axis(x, tone), yaxis: axis(y, tone) } };
}

function drawHistogram({ axis: values, range: [low, high], counts, mean }, tone) {
  const width = (high - low) / Math.max(counts.length, 1);
  const x = counts.map((_, bin) => low + (bin + 0.5) * width);
  const marker = { color: LINES[0].color, opacity: 0.8 };
  const traces = [{ type: "bar", x, y: counts, width, name: values.name, marker, showlegend: false }];
  const shapes = mean ? [{ ...referenceShape({ name: "mean", at: { across: mean[0] } }, tone), layer: "above" }] : [];
  const room = 0.04 * (high - low);
  const [across, up] = [{ ...values, is_log: false }, { name: "how many", unit: "", is_log: false, labels: [] }];
  const isFew = counts.every((count) => count <= 6);
  return {
    traces,
    layout: {
      xaxis: { ...axis(across, tone), range: [low - room, high + room] }, yaxis: { ...axis(up, tone), ...(isFew && { dtick: 1 }) },
      shapes, showlegend: shapes.length > 0, bargap: 0.03,
    },
  };
}

// Colors of candidates: good ones are bright.
function goodness({ shades, shade, is_large_good: isLargeGood }) {
  return {
    color: shades, colorscale: VIRIDIS, showscale: true, reversescale: !isLargeGood,
    colorbar: { title: { text: shade.name, side: "right" }, thickness: 14 },
  };
}

function drawParallel(chart, tone) {
  const dimensions = chart.axes.map(({ name, unit, labels }, at) => ({
    label: name, values: chart.rows.map((row) => row[at]), tickformat: unit ? ".4~s" : ".4~g",
    ...(labels.length > 0 && { tickvals: labels.map((_, place) => place), ticktext: labels }),
  }));
  const traces = [{
    type: "parcoords", labelangle: -30, labelfont: { size: 12 }, tickfont: { size: 11 }, rangefont: { size: 11 },
    dimensions, line: goodness(chart), unselected: { line: { color: tone("--line"), opacity: 0.3 } },
  }];
  return { traces, layout: { margin: { l: 90, r: 30, t: 110, b: 30 } } };
}

// A cell for each pair, below the diagonal; on the diagonal names, and how often values occur.
function drawPairs(chart, tone) {
  const count = chart.axes.length;
  const column = (at) => chart.rows.map((row) => row[at]);
  const annotations = chart.axes.map(({ name }, at) => ({
    text: name, xref: "paper", yref: "paper", x: at / count, y: 1 - at / count, xanchor: "left", yanchor: "bottom", showarrow: false,
  }));
  const [traces, layout] = [[], { annotations, margin: { l: 30, r: 30, t: 30, b: 30 }, bargap: 0.03 }];
  chart.axes.forEach((one, at) => {
    const [from, to] = [at / count, (at + 0.88) / count];
    const [x, y, often] = [at + 1, at + 1, count + at + 1];
    const { bins, range } = spanOf(column(at), one.labels);
    const cell = {
      ...axis({ ...one, name: "" }, tone), ...range, zeroline: false, showline: true, mirror: true, linecolor: tone("--line"),
      nticks: 4, tickfont: { size: 11 },
    };
    const turned = one.labels.length > 0 && { tickangle: 90 };
    layout[`xaxis${x}`] = { ...cell, ...turned, domain: [from, to], anchor: `y${at + 1 < count ? count : often}` };
    layout[`yaxis${y}`] = { ...cell, domain: [1 - to, 1 - from], anchor: "x1", visible: at > 0 };
    layout[`yaxis${often}`] = { domain: [1 - to, 1 - from], anchor: `x${x}`, visible: false, fixedrange: true };
    traces.push({
      type: "histogram", x: column(at), ...bins, xaxis: `x${x}`, yaxis: `y${often}`, name: one.name,
      marker: { color: LINES[0].color, opacity: 0.8 },
    });
    for (let left = 0; left < at; left += 1) {
      const marker = { ...goodness(chart), size: 5, showscale: at === 1 };
      traces.push({
        type: "scatter", mode: "markers", x: column(left), y: column(at), xaxis: `x${left + 1}`, yaxis: `y${y}`, name: "", marker,
      });
    }
  });
  return { traces, layout };
}

// Bins from the least to the largest value, and a range that has room for both; words have a bin each.
function spanOf(values, labels) {
  if (labels.length > 0) return { range: { range: [-0.5, labels.length - 0.5] } };
  const [least, most] = [Math.min, Math.max].map((of) => values.reduce((a, b) => of(a, b), values[0]));
  if (!(most > least)) return {};
  const [span, bins] = [most - least, Math.min(Math.max(Math.ceil(Math.sqrt(values.length)), 5), 20)];
  // A little more than the last value, which else begins a bin of its own.
  const xbins = { start: least, end: most + 1e-9 * span, size: (1 + 1e-9) * span / bins };
  return { bins: { xbins }, range: { range: [least - 0.06 * span, most + 0.06 * span] } };
}
