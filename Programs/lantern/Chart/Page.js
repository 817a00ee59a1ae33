// What `lantern chart` measured, to be looked at. Reads the JSON in #data; texts from there only ever become text.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const scenes = data.scenes ?? [];
const images = data.images ?? {};
const byId = (id) => document.getElementById(id);

const ERRORS = [
  { key: "relmse", title: "relMSE" },
  { key: "flip", title: "FLIP" },
  { key: "sigma", title: "temporal\u00a0σ" },
];
const PATH_ORDER = ["still", "slow", "fast", "cut"];
const FIGURES = [
  { key: "gpu_ms", title: "GPU\u00a0ms" },
  { key: "frame_gpu_ms", title: "frame GPU\u00a0ms" },
  { key: "rays_per_pixel", title: "rays per pixel" },
  { key: "memory", title: "memory", format: (bytes) => formatNumber(bytes / 1048576) + " MiB" },
  { key: "relmse", title: "relMSE" },
  { key: "flip", title: "FLIP" },
  { key: "sigma", title: "temporal\u00a0σ" },
  { key: "t90_frames", title: "frames to 90\u00a0%" },
  { key: "ghost", title: "ghost\u00a0trail" },
  { key: "leak", title: "leak" },
  { key: "frames", title: "frames" },
];

const state = { signal: "", scene: "", path: "", error: "relmse", hidden: new Set(), selected: null };

// ---------------------------------------------------------------------------------------------- figures as text

function isNumber(value) { return typeof value === "number" && Number.isFinite(value); }

function formatNumber(value) {
  if (!isNumber(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return Number(value.toPrecision(3)).toExponential();
  if (Number.isInteger(value)) return String(value);
  return Number(value.toPrecision(3)).toString();
}

function formatFigure(figure, point) {
  const value = point[figure.key];
  return isNumber(value) && figure.format ? figure.format(value) : formatNumber(value);
}

function nameOf(point) { return `${point.method} · ${point.preset}`; }

// ---------------------------------------------------------------------------------------------- what is in view

function unique(values) { return [...new Set(values)]; }
function currentScene() { return scenes.find((scene) => scene.name === state.scene); }
function scenePoints(scene) { return (scene?.points ?? []).filter((point) => point.signal === state.signal); }

/// Over all scenes, so that a method keeps its mark when the scene changes.
function methodsOfSignal() { return unique(scenes.flatMap(scenePoints).map((point) => point.method)); }
function isShown(method) { return !state.hidden.has(state.signal + "/" + method); }

function viewPoints() {
  return scenePoints(currentScene()).filter((point) => point.path === state.path && isShown(point.method));
}

/// Errors from which the reference's own noise is taken off can be below 0: as good as 0, and as each other.
function errorOf(point) { return Math.max(point[state.error], 0); }

/// Of those with both figures: none other is at least as fast and as accurate, and better in one.
function paretoFront(points) {
  const usable = points.filter((point) => isNumber(point.gpu_ms) && isNumber(point[state.error]));
  usable.sort((a, b) => a.gpu_ms - b.gpu_ms || errorOf(a) - errorOf(b));
  let best = Infinity;
  return usable.filter((point) => {
    if (errorOf(point) >= best) return false;
    best = errorOf(point);
    return true;
  });
}

// ---------------------------------------------------------------------------------------------- marks of methods

const COLORS = {
  light: ["#0072b2", "#c44e00", "#00845f", "#a8407f", "#8a6a00", "#2f8fc7", "#5b3fa0", "#5f6368"],
  dark: ["#5aaef0", "#ff9550", "#3ecf9f", "#f08cc4", "#f2c94c", "#9fd8ff", "#b79cf5", "#c3c7cc"],
};
const SHAPES = ["circle", "triangle", "rect", "rectRot", "crossRot", "star", "rectRounded"];
const DASHES = [[], [7, 4], [2, 3]];
const darkness = window.matchMedia("(prefers-color-scheme: dark)");

function cssColor(name) { return getComputedStyle(document.documentElement).getPropertyValue(name).trim(); }

/// Colours repeat after 8 and shapes after 7 methods, so a pair of them after 56.
function styleOf(method) {
  const index = Math.max(methodsOfSignal().indexOf(method), 0);
  const colors = darkness.matches ? COLORS.dark : COLORS.light;
  return {
    color: colors[index % colors.length],
    shape: SHAPES[index % SHAPES.length],
    dash: DASHES[Math.floor(index / SHAPES.length) % DASHES.length],
  };
}

function makeSwatch(method) {
  const canvas = document.createElement("canvas");
  const scale = 2;
  const [width, height] = [40, 18];
  canvas.width = width * scale;
  canvas.height = height * scale;
  canvas.setAttribute("aria-hidden", "true");
  const context = canvas.getContext("2d");
  const style = styleOf(method);
  context.scale(scale, scale);
  context.strokeStyle = context.fillStyle = style.color;
  context.lineWidth = 1.6;
  context.setLineDash(style.dash);
  context.beginPath();
  context.moveTo(1, height / 2);
  context.lineTo(width - 1, height / 2);
  context.stroke();
  context.setLineDash([]);
  Chart.helpers.drawPoint(context, { pointStyle: style.shape, radius: 5, borderWidth: 1.8 }, width / 2, height / 2);
  return canvas;
}

// ---------------------------------------------------------------------------------------------- tables

function makeCell(column, row) {
  const cell = document.createElement("td");
  const content = column.cell ? column.cell(row) : column.value(row);
  cell.className = column.className ?? "";
  cell.append(...[isNumber(content) ? formatNumber(content) : content ?? "–"].flat());
  return cell;
}

/// Nulls come last whichever way a column is sorted.
function compareRows(column, sign) {
  return (a, b) => {
    const [x, y] = [column.value(a) ?? null, column.value(b) ?? null];
    if (x === null || y === null) return (x === null) - (y === null);
    return sign * (typeof x === "number" ? x - y : String(x).localeCompare(String(y), undefined, { numeric: true }));
  };
}

const sorts = {}; // by table: { title, sign }

function fillTable(id, columns, rows, decorate = () => {}) {
  const table = byId(id);
  const sort = sorts[id];
  const sorted = columns.find((column) => column.title === sort?.title);
  const ordered = sorted ? [...rows].sort(compareRows(sorted, sort.sign)) : rows;
  const head = document.createElement("tr");
  for (const column of columns) {
    const cell = document.createElement("th");
    const button = document.createElement("button");
    cell.scope = "col";
    cell.className = column.className ?? "";
    cell.setAttribute("aria-sort", column === sorted ? (sort.sign > 0 ? "ascending" : "descending") : "none");
    button.type = "button";
    button.textContent = column.title;
    button.addEventListener("click", () => {
      sorts[id] = { title: column.title, sign: column === sorted ? -sort.sign : 1 };
      fillTable(id, columns, rows, decorate);
      [...table.tHead.querySelectorAll("button")][columns.indexOf(column)].focus();
    });
    cell.append(button);
    head.append(cell);
  }
  const lines = ordered.map((row) => {
    const line = document.createElement("tr");
    line.append(...columns.map((column) => makeCell(column, row)));
    decorate(line, row);
    return line;
  });
  table.tHead.replaceChildren(head);
  table.tBodies[0].replaceChildren(...lines);
}

function fillFigures(points, front) {
  const text = (title, value, cell) => ({ title, value, cell, className: "text" });
  const choose = (point) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = point.method;
    button.addEventListener("click", (event) => {
      event.stopPropagation();
      select(point, true);
    });
    return [makeSwatch(point.method), button];
  };
  const columns = [
    text("method", (point) => point.method, choose),
    text("preset", (point) => point.preset),
    { title: "front", value: (point) => (front.includes(point) ? 0 : 1), cell: (point) => (front.includes(point) ? "●" : "") },
    ...FIGURES.map((figure) => ({
      title: figure.title,
      value: (point) => (isNumber(point[figure.key]) ? point[figure.key] : null),
      cell: (point) => formatFigure(figure, point),
    })),
  ];
  fillTable("figures", columns, points, (line, point) => {
    line.classList.toggle("selected", point === state.selected);
    line.addEventListener("click", () => select(point, false));
  });
}

function fillFacts() {
  const rows = (currentScene()?.facts ?? []).map((fact) => {
    const known = isNumber(fact.frame_gpu_ms) && isNumber(fact.without_gpu_ms);
    return { ...fact, cost: known ? fact.frame_gpu_ms - fact.without_gpu_ms : null };
  });
  const most = Math.max(0, ...rows.map((row) => row.cost ?? 0));
  const drawBar = (row) => {
    const bar = document.createElement("span");
    bar.className = "bar";
    bar.style.width = most > 0 && row.cost > 0 ? `${(160 * row.cost) / most}px` : "0";
    return bar;
  };
  byId("facts-section").hidden = rows.length === 0;
  fillTable("facts", [
    { title: "fact", value: (row) => row.fact, className: "text" },
    { title: "frame GPU\u00a0ms", value: (row) => row.frame_gpu_ms },
    { title: "without it", value: (row) => row.without_gpu_ms },
    { title: "cost, ms", value: (row) => row.cost },
    {
      title: "share of the frame", value: (row) => (row.frame_gpu_ms > 0 && row.cost !== null ? row.cost / row.frame_gpu_ms : null),
      cell: (row) => (row.frame_gpu_ms > 0 && row.cost !== null ? `${formatNumber((100 * row.cost) / row.frame_gpu_ms)} %` : "–"),
    },
    { title: "compared", value: (row) => row.cost, cell: drawBar, className: "text" },
  ], rows);
}

function fillSkipped() {
  const rows = (currentScene()?.skipped ?? []).filter((item) => item.signal === state.signal);
  byId("skipped-section").hidden = rows.length === 0;
  byId("skipped-count").textContent = `${rows.length} of this signal and scene`;
  fillTable("skipped", ["method", "preset", "path", "reason"].map((key) => ({
    title: key, value: (row) => row[key], className: key === "reason" ? "text wrap" : "text",
  })), rows);
}

// ---------------------------------------------------------------------------------------------- the chosen point

function showImage(id, key, description) {
  const url = typeof key === "string" && Object.hasOwn(images, key) ? images[key] : null;
  const bShown = typeof url === "string" && url.startsWith("data:image/");
  const image = byId(id);
  image.hidden = !bShown;
  byId(id + "-missing").hidden = bShown;
  image.alt = bShown ? description : "";
  if (bShown) image.src = url;
  else image.removeAttribute("src");
}

function fillDetail() {
  const point = state.selected;
  byId("detail").hidden = !point;
  if (!point) return;
  byId("detail-title").textContent = nameOf(point);
  showImage("picture", point.picture, `${nameOf(point)}: the picture`);
  showImage("heatmap", point.heatmap, `${nameOf(point)}: its FLIP heat map`);
  byId("detail-figures").replaceChildren(...FIGURES.map((figure) => makeTerm(figure.title, formatFigure(figure, point))));
}

function makeTerm(term, description) {
  const pair = document.createElement("div");
  pair.append(document.createElement("dt"), document.createElement("dd"));
  pair.firstChild.textContent = term;
  pair.lastChild.textContent = description;
  return pair;
}

function select(point, bScroll) {
  state.selected = point;
  fillDetail();
  const points = viewPoints();
  const index = [...byId("figures").tBodies[0].rows].findIndex((row) => row.contains(document.activeElement));
  fillFigures(points, paretoFront(points));
  if (index >= 0) byId("figures").tBodies[0].rows[index].querySelector("button").focus(); // rows were made anew
  drawSelection(point);
  if (bScroll) byId("detail").scrollIntoView({ block: "nearest" });
}

// ---------------------------------------------------------------------------------------------- controls

function fillSelect(id, options, value, onChange) {
  const element = byId(id);
  element.replaceChildren(...options.map((option) => new Option(option.title ?? option.name, option.name)));
  element.value = value;
  element.disabled = options.length < 2;
  element.onchange = () => {
    onChange(element.value);
    update();
  };
}

function keepOrFirst(value, options) { return options.some((option) => option.name === value) ? value : options[0]?.name ?? ""; }

function fillControls() {
  const entries = scenes.flatMap((scene) => [...(scene.points ?? []), ...(scene.skipped ?? [])]);
  const titles = new Map((data.signals ?? []).map((signal) => [signal.name, signal.title ?? signal.name]));
  const known = unique([...titles.keys(), ...entries.map((entry) => entry.signal)]);
  const signals = known.filter((name) => entries.some((entry) => entry.signal === name))
    .map((name) => ({ name, title: titles.get(name) ?? name }));
  state.signal = keepOrFirst(state.signal, signals);
  state.scene = keepOrFirst(state.scene, scenes);
  const inScene = unique(scenePoints(currentScene()).map((point) => point.path));
  const paths = unique([...PATH_ORDER.filter((name) => inScene.includes(name)), ...inScene]).map((name) => ({ name }));
  state.path = keepOrFirst(state.path, paths);
  fillSelect("signal", signals, state.signal, (value) => (state.signal = value));
  fillSelect("scene", scenes.map(({ name, view }) => ({ name, title: view ? `${name}, view ${view}` : name })), state.scene, (value) => (state.scene = value));
  fillSelect("path", paths, state.path, (value) => (state.path = value));
  fillSelect("metric", ERRORS.map(({ key, title }) => ({ name: key, title })), state.error, (value) => (state.error = value));
}

function setShown(methods, bShown) {
  for (const method of methods) state.hidden[bShown ? "delete" : "add"](state.signal + "/" + method);
  update();
}

function fillMethods() {
  const inView = unique(scenePoints(currentScene()).filter((point) => point.path === state.path).map((point) => point.method));
  const focused = document.activeElement?.dataset?.method;
  byId("methods").replaceChildren(...inView.map((method) => {
    const label = document.createElement("label");
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = isShown(method);
    box.dataset.method = method;
    box.addEventListener("change", () => setShown([method], box.checked));
    label.append(box, makeSwatch(method), document.createTextNode(method));
    return label;
  }));
  if (focused) [...byId("methods").querySelectorAll("input")].find((box) => box.dataset.method === focused)?.focus();
  byId("all").onclick = () => setShown(inView, true);
  byId("none").onclick = () => setShown(inView, false);
}

function fillHeader() {
  byId("device").textContent = data.device ?? "unknown device";
  byId("driver").textContent = data.driver ?? "";
  byId("cpu-notice").hidden = !data.is_cpu;
  byId("settings").replaceChildren(...Object.entries(data.settings ?? {}).map(([name, value]) => {
    const text = value !== null && typeof value === "object" ? JSON.stringify(value) : String(value);
    return makeTerm(name.replaceAll("_", " "), text);
  }));
}

function update() {
  fillControls();
  fillMethods();
  const points = viewPoints();
  if (!points.includes(state.selected)) state.selected = null;
  const front = paretoFront(points);
  drawPlot(points, front);
  fillDetail();
  fillFigures(points, front);
  fillFacts();
  fillSkipped();
}
