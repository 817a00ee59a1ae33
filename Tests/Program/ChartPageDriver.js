// Appended to a chart page by ChartPageTests.cpp: uses it as a person does and writes what it saw into the document.
"use strict";

const seen = {};
const methodB = "B \u003c!--\u003cscript>"; // a script must not spell that out
const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
const nextFrame = () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
const textOf = (element) => element.textContent.replaceAll("\u00a0", " ").trim();
const element = (id) => document.getElementById(id);
const plot = () => Chart.getChart(element("chart"));

/// Cells of a table, by row.
function readTable(id) {
  return [...element(id).tBodies[0].rows].map((row) => [...row.cells].map(textOf));
}

/// "method/preset" of the rows marked as on the front, in the table's order.
function readFront() {
  return readTable("figures").filter((row) => row[2] === "●").map((row) => `${row[0]}/${row[1]}`);
}

function readView() {
  return { rows: readTable("figures").map((row) => `${row[0]}/${row[1]}`), front: readFront(), ink: countInk() };
}

/// Pixels of the chart that have a colour: marks and lines of methods, not the grey axes, texts and front.
function countInk() {
  const copy = document.createElement("canvas");
  copy.width = element("chart").width;
  copy.height = element("chart").height;
  const context = copy.getContext("2d", { willReadFrequently: true }); // or the browser remarks on it
  context.drawImage(element("chart"), 0, 0);
  const pixels = context.getImageData(0, 0, copy.width, copy.height).data;
  let count = 0;
  for (let at = 0; at < pixels.length; at += 4) {
    const [red, green, blue, alpha] = pixels.subarray(at, at + 4);
    if (alpha > 128 && Math.max(red, green, blue) - Math.min(red, green, blue) > 60) ++count;
  }
  return count;
}

/// Where a point is drawn, by what the chart holds for it, in the window's pixels.
function locate(method, preset) {
  for (const [index, dataset] of plot().data.datasets.entries()) {
    const at = dataset.label === method ? dataset.data.findIndex((item) => item.point.preset === preset) : -1;
    if (at < 0) continue;
    const mark = plot().getDatasetMeta(index).data[at];
    const corner = element("chart").getBoundingClientRect();
    return { clientX: corner.left + mark.x, clientY: corner.top + mark.y, bubbles: true, view: window };
  }
  throw new Error(`${method}/${preset} is not drawn`);
}

async function point(type, method, preset) {
  element("chart").dispatchEvent(new MouseEvent(type, locate(method, preset)));
  await nextFrame(); // Chart.js answers movement with the next frame
  await pause(20);
}

async function choose(id, value) {
  element(id).value = value;
  element(id).dispatchEvent(new Event("change", { bubbles: true }));
  await pause(60);
}

async function clickMethod(method) {
  [...document.querySelectorAll("#methods label")].find((label) => textOf(label) === method).querySelector("input").click();
  await pause(60);
}

async function clickHeading(title) {
  [...element("figures").tHead.querySelectorAll("button")].find((button) => textOf(button) === title).click();
  await pause(20);
}

async function readDetail() {
  const read = async (id) => {
    const image = element(id);
    if (image.hidden) return null;
    for (let wait = 0; !image.complete && wait < 100; ++wait) await pause(20);
    const box = image.getBoundingClientRect();
    return { width: image.naturalWidth, height: image.naturalHeight, left: box.left, top: box.top, shown: box.width };
  };
  if (element("detail").hidden) return null;
  return { title: textOf(element("detail-title")), picture: await read("picture"), heatmap: await read("heatmap") };
}

function isShownById(id) { return element(id).getBoundingClientRect().height > 0; }

async function useFully() {
  await pause(100);
  seen.start = readView();
  seen.device = textOf(element("device"));
  seen.driver = textOf(element("driver"));
  seen.notice = isShownById("cpu-notice");
  seen.notDrawn = textOf(element("not-drawn"));
  seen.facts = readTable("facts");
  seen.skipped = readTable("skipped");

  await point("mousemove", "A", "p2");
  const tooltip = plot().tooltip;
  seen.hover = { opacity: tooltip.opacity, title: tooltip.title, lines: tooltip.body.flatMap((body) => body.lines) };
  seen.beforeClick = await readDetail();
  await point("click", methodB, "q1");
  seen.afterClick = await readDetail();
  await point("click", "A", "p1");
  seen.withoutPictures = await readDetail();
  element("chart").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
  seen.afterArrow = await readDetail();

  await clickHeading("relMSE");
  seen.ascending = readTable("figures").map((row) => row[1]);
  await clickHeading("relMSE");
  seen.descending = readTable("figures").map((row) => row[1]);

  await clickMethod(methodB);
  seen.onlyA = readView();
  await choose("metric", "flip");
  seen.flip = readView();
  element("none").click();
  await pause(60);
  seen.none = readView();
  seen.noneText = isShownById("nothing");
  element("all").click();
  await choose("path", "fast");
  seen.fast = readView();
  seen.selectionKept = await readDetail();
  await choose("scene", "second");
  seen.second = readView();
  await choose("signal", "ao");
  seen.ao = readView();
}

async function lookOnly() {
  await pause(100);
  seen.start = readView();
  seen.notice = isShownById("cpu-notice");
}

(document.documentElement.dataset.drive === "look" ? lookOnly() : useFully())
  .catch((error) => window.driverErrors.push(String(error?.stack ?? error)))
  .then(() => {
    const result = document.createElement("pre");
    seen.errors = window.driverErrors;
    result.id = "driver-result";
    // Nothing that the dump of the document would escape.
    result.textContent = JSON.stringify(seen).replace(/[&<>\u00a0]/g, (c) => "\\u" + c.charCodeAt(0).toString(16).padStart(4, "0"));
    document.body.append(result);
  });
