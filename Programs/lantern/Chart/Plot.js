// The chart itself: log axes, one line per method, the Pareto front under all of them.
"use strict";

const frontLabel = "Pareto front";
let chart = null;

// ---------------------------------------------------------------------------------------------- log axes

/// The next round number at or below value (sign -1), or at or above it.
function roundOutward(value, sign) {
  const decade = 10 ** Math.floor(Math.log10(value));
  const steps = [1, 1.5, 2, 3, 4, 5, 7, 10].map((step) => step * decade);
  return sign < 0 ? steps.filter((step) => step <= value).pop() ?? decade : steps.find((step) => step >= value) ?? 10 * decade;
}

/// Where an axis begins and ends. A figure of 0 has no place on it and is drawn at its foot.
function axisRange(values) {
  const positive = values.filter((value) => value > 0);
  const bZero = values.some((value) => value <= 0);
  if (positive.length === 0) return { min: 1e-6, max: 1, foot: 1e-6 };
  const least = Math.min(...positive);
  const min = roundOutward(bZero ? least / 4 : least * 0.85, -1);
  return { min, max: Math.max(roundOutward(Math.max(...positive) * 1.18, 1), min * 2), foot: min };
}

function makeTicks(min, max) {
  const decades = Math.log10(max / min);
  const steps = decades > 3.2 ? [1] : decades > 0.9 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9];
  const ticks = [];
  for (let exponent = Math.floor(Math.log10(min) - 1e-9); 10 ** exponent <= max * 1.001; ++exponent) {
    for (const step of steps) {
      const value = Number(`${step}e${exponent}`);
      if (value >= min * 0.999 && value <= max * 1.001) ticks.push({ value, major: step === 1 });
    }
  }
  return ticks;
}

function makeAxis(title, range) {
  return {
    type: "logarithmic",
    min: range.min,
    max: range.max,
    title: { display: true, text: title, color: cssColor("--text"), font: { size: 13, weight: 600 } },
    afterBuildTicks: (axis) => { axis.ticks = makeTicks(axis.min, axis.max); },
    ticks: { color: cssColor("--quiet"), callback: (value) => formatNumber(value), maxRotation: 0 },
    grid: { color: cssColor("--grid"), tickColor: cssColor("--line"), borderColor: cssColor("--line") },
  };
}

// ---------------------------------------------------------------------------------------------- lines and marks

/// On the axes, or null where a figure is missing.
function place(point, ranges) {
  if (!isNumber(point.gpu_ms) || !isNumber(point[state.error])) return null;
  const put = (value, range) => (value > 0 ? value : range.foot);
  return { x: put(point.gpu_ms, ranges.x), y: put(point[state.error], ranges.y), point };
}

function makeLine(method, points, ranges) {
  const style = styleOf(method);
  const bHollow = (item) => item.point.gpu_ms <= 0 || item.point[state.error] <= 0;
  const items = points.filter((point) => point.method === method).map((point) => place(point, ranges)).filter(Boolean);
  return {
    label: method, data: items, clip: 10, borderColor: style.color, borderWidth: 1.8, borderDash: style.dash, tension: 0,
    pointStyle: style.shape, pointRadius: 5.5, pointHoverRadius: 8, pointHitRadius: 6,
    pointBackgroundColor: items.map((item) => (bHollow(item) ? cssColor("--panel") : style.color)),
    pointBorderColor: style.color, pointHoverBackgroundColor: style.color, pointBorderWidth: 2, order: 1,
  };
}

function makeFront(front, ranges) {
  return {
    label: frontLabel, data: front.map((point) => place(point, ranges)), stepped: "before", order: 2,
    borderColor: cssColor("--front") + "66", borderWidth: 7, borderJoinStyle: "round", borderCapStyle: "round",
    pointRadius: 0, pointHoverRadius: 0, pointHitRadius: 0,
  };
}

function tooltipLines(item) {
  const point = item.raw.point;
  const lines = FIGURES.map((figure) => `${figure.title}: ${formatFigure(figure, point)}`);
  if (point.gpu_ms <= 0 || point[state.error] <= 0) lines.push("0 or less: drawn at the axis' foot");
  return lines;
}

function overlap(a, b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// The presets' names beside the front's points, where one can be put without covering a mark or another name.
function drawPresets(target) {
  const context = target.ctx;
  const isFront = (dataset) => dataset.label === frontLabel;
  const front = target.data.datasets.findIndex(isFront);
  const taken = target.data.datasets.flatMap((dataset, index) => (isFront(dataset) ? [] : target.getDatasetMeta(index).data))
    .map(({ x, y }) => ({ x: x - 6, y: y - 6, width: 12, height: 12 }));
  const { left, right, top, bottom } = target.chartArea;
  context.font = `12px ${getComputedStyle(document.body).fontFamily}`;
  context.fillStyle = cssColor("--text");
  context.strokeStyle = cssColor("--panel");
  context.lineWidth = 3;
  context.lineJoin = "round";
  target.getDatasetMeta(front).data.forEach(({ x, y }, index) => {
    const text = target.data.datasets[front].data[index].point.preset;
    const width = context.measureText(text).width;
    const box = [[9, -19], [-9 - width, 4], [-9 - width, -19], [9, 4]]
      .map(([dx, dy]) => ({ x: x + dx, y: y + dy, width, height: 15 }))
      .find((place) => place.x > left && place.x + width < right && place.y > top && place.y + 15 < bottom &&
        !taken.some((other) => overlap(place, other)));
    if (!box) return;
    taken.push(box);
    context.strokeText(text, box.x, box.y + 12); // a halo, to be read over lines
    context.fillText(text, box.x, box.y + 12);
  });
}

function drawRing(target) {
  const chosen = findElement(state.selected);
  if (!chosen) return;
  target.ctx.strokeStyle = cssColor("--text");
  target.ctx.lineWidth = 2;
  target.ctx.beginPath();
  target.ctx.arc(chosen.x, chosen.y, 11, 0, 2 * Math.PI);
  target.ctx.stroke();
}

const annotations = {
  id: "annotations",
  afterDatasetsDraw(target) {
    target.ctx.save();
    drawPresets(target);
    drawRing(target);
    target.ctx.restore();
  },
};

function findElement(point) {
  for (const [index, dataset] of (point && chart ? chart.data.datasets : []).entries()) {
    const at = dataset.label === frontLabel ? -1 : dataset.data.findIndex((item) => item.point === point);
    if (at >= 0) return chart.getDatasetMeta(index).data[at];
  }
  return null;
}

function makeOptions(ranges, errorTitle) {
  return {
    animation: false, responsive: true, maintainAspectRatio: false, layout: { padding: { top: 6, right: 12 } },
    interaction: { mode: "nearest", intersect: true },
    onClick: (event, found) => {
      const item = found.find(({ datasetIndex }) => chart.data.datasets[datasetIndex].label !== frontLabel);
      if (item) select(chart.data.datasets[item.datasetIndex].data[item.index].point, true);
    },
    onHover: (event, found) => { event.native.target.style.cursor = found.length > 0 ? "pointer" : "default"; },
    scales: { x: makeAxis("GPU ms (log)", ranges.x), y: makeAxis(`${errorTitle} (log)`, ranges.y) },
    plugins: {
      legend: { display: false },
      tooltip: {
        displayColors: false, backgroundColor: "#0c0e11", borderColor: "#59626d", borderWidth: 1, titleFont: { size: 14 }, bodyFont: { size: 12.5 }, padding: 11,
        filter: (item) => item.dataset.label !== frontLabel,
        callbacks: { title: (items) => (items.length > 0 ? nameOf(items[0].raw.point) : ""), label: tooltipLines },
      },
    },
  };
}

// ---------------------------------------------------------------------------------------------- drawing

function drawPlot(points, front) {
  const usable = points.filter((point) => isNumber(point.gpu_ms) && isNumber(point[state.error]));
  const ranges = { x: axisRange(usable.map((point) => point.gpu_ms)), y: axisRange(usable.map((point) => point[state.error])) };
  const errorTitle = ERRORS.find((error) => error.key === state.error).title;
  const methods = unique(points.map((point) => point.method));
  const missing = points.length - usable.length;
  chart?.destroy();
  chart = new Chart(byId("chart"), {
    type: "line",
    data: { datasets: [...methods.map((method) => makeLine(method, points, ranges)), makeFront(front, ranges)] },
    options: makeOptions(ranges, errorTitle),
    plugins: [annotations],
  });
  byId("chart").setAttribute("aria-label", `${errorTitle} against GPU milliseconds: ${usable.length} points of ${methods.length} methods; the table below has them all`);
  byId("not-drawn").textContent = missing > 0 ? `${missing} not drawn: no GPU time or no ${errorTitle}.` : "";
  byId("nothing").hidden = usable.length > 0;
  byId("nothing").textContent = points.length > 0 ? `No point of this view has both a GPU time and ${errorTitle}.` : "Nothing to show: no method is chosen, or none was measured here.";
}

function drawSelection(point) {
  if (point) chart.draw();
}

function stepSelection(step) {
  const order = viewPoints().filter((point) => findElement(point)).sort((a, b) => a.gpu_ms - b.gpu_ms);
  if (order.length === 0) return;
  const at = order.indexOf(state.selected);
  select(order[at < 0 ? (step > 0 ? 0 : order.length - 1) : (at + step + order.length) % order.length], false);
}

byId("chart").addEventListener("keydown", (event) => {
  const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (!step) return;
  event.preventDefault();
  stepSelection(step);
});
darkness.addEventListener("change", update);
fillHeader();
update();
