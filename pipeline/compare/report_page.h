// What is the same on every report: style and behaviour.
#pragma once

namespace edgewise::compare {

inline constexpr const char* kReportStyle = R"css(
body{font:15px/1.5 system-ui,sans-serif;color:#222;margin:0;background:#f6f6f4}
main{max-width:1500px;margin:0 auto;padding:24px}
h1{margin:0 0 4px;font-size:26px}h2{margin:32px 0 10px;font-size:19px}
code{background:#ececea;padding:1px 5px;border-radius:3px;font-size:13px;overflow-wrap:anywhere}
.card{background:#fff;border:1px solid #ddd;border-radius:6px;padding:12px 14px}
.card svg{display:block;width:100%;max-width:900px;height:auto}
.scroll{overflow-x:auto}
table{border-collapse:collapse;font-size:13px;font-variant-numeric:tabular-nums;width:100%}
th,td{padding:4px 9px;border-bottom:1px solid #e5e5e5;text-align:right;white-space:nowrap}
th{cursor:pointer;user-select:none;vertical-align:bottom}
th[aria-sort=ascending]::after{content:" \25B4"}th[aria-sort=descending]::after{content:" \25BE"}
td:first-child,th:first-child,td:nth-child(2),th:nth-child(2){text-align:left}
.bad{color:#b3261e}
.bar{display:flex;flex-wrap:wrap;gap:8px 18px;align-items:center;margin-bottom:10px}
select,button{font:inherit;padding:2px 8px}
.views{display:grid;grid-template-columns:1fr 1fr;gap:10px}
.views.one{grid-template-columns:1fr}.views.one .view.second{display:none}
.view{border:1px solid #ccc;background:#888;overflow:hidden;position:relative;aspect-ratio:4/3;cursor:grab;touch-action:none}
.view canvas{position:absolute;inset:0;width:100%;height:100%}
.view b{position:absolute;left:6px;top:4px;background:#fffc;padding:0 6px;border-radius:3px;font-weight:600}
.scale{display:inline-flex;align-items:center;gap:6px;font-size:12px}
.scale[hidden]{display:none}
.scale i{display:inline-block;width:200px;height:12px;border:1px solid #bbb}
dl{display:grid;grid-template-columns:max-content 1fr;gap:4px 16px;margin:0}dt{font-weight:600}dd{margin:0}
details{margin:6px 0}summary{cursor:pointer}
)css";

/// A click on a header sorts its table, by data-value where cells have one.
inline constexpr const char* kSortScript = R"js(
"use strict";
for (const header of document.querySelectorAll("th")) header.addEventListener("click", () => {
  const body = header.closest("table").tBodies[0], column = header.cellIndex;
  const up = header.getAttribute("aria-sort") !== "ascending";
  for (const other of header.parentNode.cells) other.removeAttribute("aria-sort");
  header.setAttribute("aria-sort", up ? "ascending" : "descending");
  const key = (row) => {
    const cell = row.cells[column], number = cell.dataset.value;
    return number === undefined ? cell.textContent : number === "" ? Infinity : Number(number);
  };
  [...body.rows].sort((a, b) => {
    const p = key(a), q = key(b), order = p < q ? -1 : p > q ? 1 : 0;
    return up ? order : -order;
  }).forEach((row) => body.append(row));
});
)js";

/// Of `rows`: [{name, picture, signed, absolute}], the first one the reference.
inline constexpr const char* kReportScript = R"js(
"use strict";
const rows = JSON.parse(document.getElementById("pictures").textContent);
const views = document.querySelector(".views");
const kinds = {picture: "picture", signed: "signed error", absolute: "absolute error"};
const state = {left: 0, right: Math.min(2, rows.length - 1), kind: "picture", whole: true, zoom: 1, x: 0, y: 0, flipped: false};
const loaded = new Map();

function image(row, kind) {
  const source = rows[row][kind] || rows[row].picture;
  if (!loaded.has(source)) {
    const element = new Image();
    element.onload = draw;
    element.src = source;
    loaded.set(source, element);
  }
  return loaded.get(source);
}

function drawOne(view, row) {
  const canvas = view.querySelector("canvas"), ratio = window.devicePixelRatio || 1;
  const width = Math.round(view.clientWidth * ratio), height = Math.round(view.clientHeight * ratio);
  if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
  const context = canvas.getContext("2d"), shown = image(row, state.kind);
  context.clearRect(0, 0, width, height);
  view.querySelector("b").textContent = rows[row].name + (state.kind === "picture" ? "" : ", " + kinds[state.kind]);
  if (!shown.complete || !shown.naturalWidth) return;
  if (state.whole) fit(shown, view);
  const scale = state.zoom * ratio;
  context.imageSmoothingEnabled = state.zoom < 1;
  context.drawImage(shown, width / 2 - state.x * scale, height / 2 - state.y * scale,
                    shown.naturalWidth * scale, shown.naturalHeight * scale);
}

function fit(shown, view) {
  state.zoom = Math.min(view.clientWidth / shown.naturalWidth, view.clientHeight / shown.naturalHeight);
  state.x = shown.naturalWidth / 2;
  state.y = shown.naturalHeight / 2;
}

function draw() {
  const [first, second] = views.querySelectorAll(".view");
  const swapped = views.classList.contains("one") && state.flipped;
  drawOne(first, swapped ? state.right : state.left);
  if (!views.classList.contains("one")) drawOne(second, state.right);
  document.getElementById("zoom").textContent = (100 * state.zoom).toFixed(0) + " %";
  for (const scale of document.querySelectorAll(".scale")) scale.hidden = scale.dataset.kind !== state.kind;
}

function zoomBy(factor, view, event) {
  const box = view.getBoundingClientRect();
  const dx = (event ? event.clientX : box.left + box.width / 2) - box.left - box.width / 2;
  const dy = (event ? event.clientY : box.top + box.height / 2) - box.top - box.height / 2;
  const next = Math.min(64, Math.max(0.05, state.zoom * factor));
  state.x += dx / state.zoom - dx / next;
  state.y += dy / state.zoom - dy / next;
  state.zoom = next;
  state.whole = false;
  draw();
}

function flip() {
  views.classList.add("one");
  document.getElementById("side").checked = false;
  state.flipped = !state.flipped;
  draw();
}

for (const view of views.querySelectorAll(".view")) {
  view.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoomBy(Math.pow(2, -event.deltaY / 300), view, event);
  }, {passive: false});
  let held = null;
  view.addEventListener("pointerdown", (event) => { held = event; view.setPointerCapture(event.pointerId); });
  view.addEventListener("pointermove", (event) => {
    if (!held) return;
    state.x -= (event.clientX - held.clientX) / state.zoom;
    state.y -= (event.clientY - held.clientY) / state.zoom;
    held = event;
    state.whole = false;
    draw();
  });
  view.addEventListener("pointerup", () => { held = null; });
}
for (const side of ["left", "right"]) {
  const select = document.getElementById(side);
  rows.forEach((row, index) => select.add(new Option(row.name, index)));
  select.value = state[side];
  select.addEventListener("change", () => { state[side] = Number(select.value); draw(); });
}
document.getElementById("kind").addEventListener("change", (event) => { state.kind = event.target.value; draw(); });
document.getElementById("flip").addEventListener("click", flip);
document.getElementById("side").addEventListener("change", (event) => {
  views.classList.toggle("one", !event.target.checked);
  state.flipped = false;
  draw();
});
document.getElementById("whole").addEventListener("click", () => { state.whole = true; draw(); });
document.getElementById("pixels").addEventListener("click", () => { state.zoom = 8; state.whole = false; draw(); });
document.addEventListener("keydown", (event) => {
  if (event.key === "f") flip();
  if (event.key === "+") zoomBy(2, views.querySelector(".view"));
  if (event.key === "-") zoomBy(0.5, views.querySelector(".view"));
});
window.addEventListener("resize", draw);

draw();
)js";

}  // namespace edgewise::compare
