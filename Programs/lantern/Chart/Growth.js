// The page of lantern bench growth: one line for each quantity and clock, and the table of all points.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const clocks = [{ key: "gpu", title: "GPU", dash: [] }, { key: "cpu", title: "render thread", dash: [6, 4] }];
const colors = ["#0b77d0", "#d1495b", "#2a9d5c", "#b07d00"];

function byId(id) { return document.getElementById(id); }
function isNumber(value) { return typeof value === "number" && Number.isFinite(value); }
function formatNumber(value, digits) { return isNumber(value) ? value.toLocaleString("en", { maximumFractionDigits: digits }) : "\u2013"; }
function cssColor(name) { return getComputedStyle(document.documentElement).getPropertyValue(name).trim(); }

function makeDatasets() {
  return data.lines.flatMap((line, index) => clocks.map((clock) => ({
    label: `${line.name}, ${clock.title}: exponent ${formatNumber(line[`${clock.key}_exponent`], 2)}`,
    data: line.points.filter((point) => point[`${clock.key}_ms`] > 0).map((point) => ({ x: point.value, y: point[`${clock.key}_ms`] })),
    borderColor: colors[index % colors.length], backgroundColor: colors[index % colors.length], borderDash: clock.dash,
    borderWidth: 2, pointRadius: 4, tension: 0,
  }))).filter((dataset) => dataset.data.length > 0);
}

function makeAxis(title) {
  return {
    type: "logarithmic",
    title: { display: true, text: title, color: cssColor("--text"), font: { size: 13, weight: 600 } },
    ticks: { color: cssColor("--quiet"), callback: (value) => (Number.isInteger(Math.round(1e6 * Math.log10(value)) / 1e6) ? formatNumber(value, 4) : "") },
    grid: { color: cssColor("--grid"), borderColor: cssColor("--line") },
  };
}

function fillTable() {
  const addRow = (parent, tag, cells) => {
    const row = document.createElement("tr");
    row.replaceChildren(...cells.map((text) => Object.assign(document.createElement(tag), { textContent: text })));
    parent.append(row);
  };
  addRow(byId("figures").tHead, "th", ["line", "number", "GPU ms", "render thread ms", "what stays"]);
  for (const line of data.lines) {
    for (const point of line.points) {
      addRow(byId("figures").tBodies[0], "td", [line.name, formatNumber(point.value, 0), formatNumber(point.gpu_ms, 3), formatNumber(point.cpu_ms, 3), line.held]);
    }
  }
}

byId("device").textContent = data.device;
byId("driver").textContent = data.driver;
fillTable();
new Chart(byId("chart"), {
  type: "line",
  data: { datasets: makeDatasets() },
  options: {
    animation: false, responsive: true, maintainAspectRatio: false,
    scales: { x: makeAxis("objects, triangles, materials or pixels (log)"), y: makeAxis("milliseconds (log)") },
    plugins: { legend: { position: "right", labels: { color: cssColor("--text") } } },
  },
});
