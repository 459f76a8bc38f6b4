// Puts the page together from the data in it. The text of the report is in the page already; this adds the replay and
// the charts.

function complain(part, error) {
  const note = element("p", `This part cannot be shown: ${error.message}.`);
  note.className = "note";
  note.setAttribute("role", "alert");
  part.replaceChildren(note);
}

async function startReplay(report) {
  const root = document.getElementById("replay");
  if (!root || !report.replay) return;
  try {
    const replay = new Replay(root, report.replay, await unpack("frames"));
    root.dataset.ready = "yes";
    window.agglo = { ...window.agglo, replay };
  } catch (error) {
    complain(root, error);
  }
}

// One that cannot be drawn leaves the others alone.
function startChart(chart) {
  const place = document.getElementById(`chart-${chart.id}`);
  try {
    return new Chart(place, chart);
  } catch (error) {
    complain(place, error);
    return null;
  }
}

async function startCharts(report) {
  const section = document.getElementById("charts");
  if (!section || report.charts.length === 0) return;
  try {
    const library = document.createElement("script");
    library.textContent = new TextDecoder().decode(await unpack("plotly"));
    document.head.append(library);
    const charts = report.charts.map(startChart).filter((chart) => chart);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => charts.forEach((chart) => chart.draw()));
    section.dataset.ready = "yes";
    window.agglo = { ...window.agglo, charts };
  } catch (error) {
    complain(section, error);
  }
}

startReplay(REPORT);
startCharts(REPORT);
