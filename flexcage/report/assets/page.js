"use strict";

// Tables: a click on a heading sorts by that column, numbers by their value, texts by the alphabet;
// a second click turns the order round, and a third brings back the first.
function sortTable(heading) {
  const table = heading.closest("table");
  const column = [...heading.parentNode.children].indexOf(heading);
  const state = heading.getAttribute("aria-sort");
  const descending = state === "ascending";
  const key = (row) => {
    const cell = row.children[column];
    return cell.dataset.number === undefined ? cell.textContent.trim() : Number(cell.dataset.number);
  };
  const order = (a, b) => {
    const x = key(a), y = key(b);
    if (typeof x !== typeof y) return typeof x === "number" ? -1 : 1; // what is no number stands last
    const less = typeof x === "number" ? x - y : x.localeCompare(y, "en", { numeric: true });
    return descending ? -less : less;
  };
  for (const other of table.querySelectorAll("th")) other.removeAttribute("aria-sort");
  const rows = [...table.tBodies[0].rows];
  if (state === "descending") {
    rows.sort((a, b) => a.dataset.place - b.dataset.place);
  } else {
    heading.setAttribute("aria-sort", descending ? "descending" : "ascending");
    rows.sort(order);
  }
  table.tBodies[0].append(...rows);
}
for (const body of document.querySelectorAll("tbody"))
  [...body.rows].forEach((row, place) => { row.dataset.place = place; });
for (const button of document.querySelectorAll("th button"))
  button.addEventListener("click", () => sortTable(button.parentNode));

// Charts: each holds one figure, or several that its list chooses from.
const BUTTONS = (layout) => [layout.scene ? ["resetCameraDefault3d", "toImage"] : ["resetScale2d", "toImage"]];
const CONFIG = (layout) => ({ responsive: true, displaylogo: false, modeBarButtons: BUTTONS(layout) });
// A ring fills its view: its size comes with the figure, the view's shape is known only here. A size
// of 1 spans 0.44 of the view's height (plotly's orthographic projection).
function fillView(layout, plot) {
  if (!layout.scene) return;
  const width = plot.clientWidth, height = plot.clientHeight - layout.meta.spare;
  const size = Math.min(0.94 * width, layout.meta.widest * height) / (0.44 * height);
  for (const axis of ["x", "y", "z"]) layout.scene.aspectratio[axis] *= size;
}
// A legend of several lines makes its chart higher: the plot keeps its height.
const LINE = 28; // pixels of a legend that the figure's own margin holds
function makeRoom(plot) {
  const legend = plot.querySelector(".legend .bg");
  const more = legend ? Math.max(Math.ceil(legend.getBoundingClientRect().height) - LINE, 0) : 0;
  if (more === Number(plot.dataset.more || 0)) return null;
  plot.dataset.more = more;
  plot.style.height = `calc(var(--height) + ${more}px)`;
  return Plotly.Plots.resize(plot);
}
function drawChart(chart) {
  const figures = JSON.parse(chart.querySelector("script").textContent);
  const plot = chart.querySelector(".plot");
  const choice = chart.querySelector("select");
  for (const figure of figures) fillView(figure.layout, plot);
  const show = (k) => Plotly.react(plot, figures[k].data, figures[k].layout, CONFIG(figures[k].layout))
    .then(() => makeRoom(plot));
  if (choice) choice.addEventListener("change", () => show(Number(choice.value)));
  return show(0).then(() => plot.classList.add("drawn"));
}
async function drawThose(charts) {
  for (const chart of charts) {
    await drawChart(chart);
    await new Promise((resolve) => setTimeout(resolve)); // lets the page scroll in between
  }
}
// A chart that is folded away has no size: it is drawn when it is first unfolded.
for (const fold of document.querySelectorAll("details:has(.chart)"))
  fold.addEventListener("toggle", () => drawThose(fold.querySelectorAll(".chart")), { once: true });
const seen = [...document.querySelectorAll(".chart")].filter((chart) => !chart.closest("details"));
drawThose(seen).then(() => { document.body.dataset.drawn = "yes"; });

// Pictures: a click shows one at its full size, another click puts it back.
const dialog = document.createElement("dialog");
document.body.append(dialog);
dialog.addEventListener("click", () => dialog.close());
for (const image of document.querySelectorAll(".gallery img"))
  image.addEventListener("click", () => {
    const large = new Image();
    large.src = image.src;
    large.alt = image.alt;
    dialog.replaceChildren(large);
    dialog.showModal();
  });
