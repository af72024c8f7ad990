"use strict";

// Tables: a click on a heading sorts by that column, numbers by their value, texts by the alphabet.
function sortTable(heading) {
  const table = heading.closest("table");
  const column = [...heading.parentNode.children].indexOf(heading);
  const descending = heading.getAttribute("aria-sort") === "ascending";
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
  heading.setAttribute("aria-sort", descending ? "descending" : "ascending");
  const body = table.tBodies[0];
  body.append(...[...body.rows].sort(order));
}
for (const button of document.querySelectorAll("th button"))
  button.addEventListener("click", () => sortTable(button.parentNode));

// Charts: each holds one figure, or several that its list chooses from.
const BUTTONS = (layout) => [layout.scene ? ["resetCameraDefault3d", "toImage"] : ["resetScale2d", "toImage"]];
const CONFIG = (layout) => ({ responsive: true, displaylogo: false, modeBarButtons: BUTTONS(layout) });
// A narrow view must stand further back to hold a whole ring: by how much, from its width and height.
function standBack(layout, plot) {
  if (!layout.scene) return;
  const aspect = plot.clientWidth / plot.clientHeight;
  const eye = layout.scene.camera.eye;
  const factor = Math.max(1, 1.25 / aspect);
  for (const axis of ["x", "y", "z"]) eye[axis] *= factor;
}
function drawChart(chart) {
  const figures = JSON.parse(chart.querySelector("script").textContent);
  const plot = chart.querySelector(".plot");
  const choice = chart.querySelector("select");
  for (const figure of figures) standBack(figure.layout, plot);
  const show = (k) => Plotly.react(plot, figures[k].data, figures[k].layout, CONFIG(figures[k].layout));
  if (choice) choice.addEventListener("change", () => show(Number(choice.value)));
  return show(0).then(() => plot.classList.add("drawn"));
}
async function drawAll() {
  for (const chart of document.querySelectorAll(".chart")) {
    await drawChart(chart);
    await new Promise((resolve) => setTimeout(resolve)); // lets the page scroll in between
  }
  document.body.dataset.drawn = "yes";
}
drawAll();

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
