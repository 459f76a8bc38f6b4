// Charts by plotly: hover for figures, drag to zoom, double click to go back, click a name to hide its line.

const LINES = REPORT.palette.lines.map(([color, dashes, width]) => ({
  color, width, dash: dashes.split(" ").filter(Boolean).map((part) => `${part}px`).join(",") || "solid",
}));
const VIRIDIS = scaleOf("viridis");

class Chart {
  constructor(place, chart) {
    Object.assign(this, { place, chart });
    this.draw();
  }

  draw() {
    const style = getComputedStyle(document.documentElement);
    const tone = (name) => style.getPropertyValue(name).trim();
    const { x, y, kind, series } = this.chart;
    const isParallel = kind === "parallel";
    // Many axes need room beside each other; the card then scrolls.
    if (isParallel) this.place.style.minWidth = `${5 * series[0].dimensions.length}rem`;
    // On a phone each name in the legend has a row of its own.
    if (kind === "lines" && this.place.clientWidth < 480) this.place.style.height = `${15 + 1.4 * series.length}rem`;
    const layout = {
      paper_bgcolor: "transparent", plot_bgcolor: "transparent",
      font: { color: tone("--text"), family: "system-ui, sans-serif", size: 13 },
      margin: isParallel ? { l: 90, r: 30, t: 110, b: 30 } : { l: 60, r: 16, t: 12, b: 48 },
      hovermode: kind === "lines" ? "x unified" : "closest",
      hoverlabel: { bgcolor: tone("--card"), font: { color: tone("--text") } },
      showlegend: kind !== "map" && !isParallel && series.length > 1, legend: { orientation: "h", y: -0.25 },
      ...(!isParallel && { xaxis: axis(x, tone), yaxis: axis(y, tone) }),
    };
    const config = { responsive: true, displaylogo: false, modeBarButtonsToRemove: ["lasso2d", "select2d"] };
    Plotly.react(this.place, this.traces(tone), layout, config);
  }

  traces(tone) {
    const kinds = { lines: lineTrace, points: pointTrace, bars: barTrace, map: mapTrace, parallel: parallelTrace };
    return this.chart.series.map((series, number) => kinds[this.chart.kind](series, LINES[number % LINES.length], tone));
  }
}

// Ticks have prefixes and units: "150 μs"; pure numbers are written out up to 100,000. Decades have a tick each, and lines between that say nothing.
function axis({ label, unit, log, names }, tone) {
  const base = {
    title: { text: label, standoff: 8 }, gridcolor: tone("--line"), zerolinecolor: tone("--line"), automargin: true,
  };
  if (names) return { ...base, tickvals: names.map((_, place) => place), ticktext: names };
  return {
    ...base, type: log ? "log" : "linear", exponentformat: unit ? "SI" : "power",
    minexponent: unit ? 2 : 4, ticksuffix: unit,
    hoverformat: unit ? ".4~s" : ".5~g", ...(log && { dtick: 1 }),
  };
}

function lineTrace({ name, x, y, error }, { color, width, dash }) {
  return {
    type: "scatter", mode: x.length > 1 ? "lines" : "markers", name, x, y,
    line: { color, width, dash }, error_y: errorBars(error, color),
  };
}

function pointTrace({ name, x, y, text, error, colors, label }, { color }) {
  const scale = colors && { color: colors, colorscale: VIRIDIS, showscale: true, colorbar: { title: { text: label } } };
  return {
    type: "scatter", mode: "markers", name, x, y, text, marker: { color, size: 8, ...scale }, error_y: errorBars(error, color),
  };
}

function barTrace({ name, x, y, error }, { color }, tone) {
  return { type: "bar", name, x, y, marker: { color }, error_y: errorBars(error, tone("--text")) };
}

function errorBars(error, color) {
  return error && { type: "data", array: error, color, thickness: 1.5 };
}

function mapTrace({ name, x, y, z, label }) {
  return {
    type: "heatmap", name, x, y, z, colorscale: VIRIDIS, colorbar: { title: { text: label, side: "right" }, thickness: 14 },
  };
}

function parallelTrace({ dimensions, colors, label, ascending }, _, tone) {
  return {
    type: "parcoords", labelangle: -30, labelfont: { size: 12 }, tickfont: { size: 11 }, rangefont: { size: 11 },
    dimensions: dimensions.map((dimension) => ({ tickformat: ".4~g", ...dimension })),
    line: { color: colors, colorscale: VIRIDIS, showscale: true, reversescale: !ascending, colorbar: { title: { text: label, side: "right" } } },
    unselected: { line: { color: tone("--line"), opacity: 0.3 } },
  };
}
