// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_DETAIL_PAGE_SCRIPT_HPP
#define SIVID_REPORT_PAGE_DETAIL_PAGE_SCRIPT_HPP

#include <string_view>

namespace sivid::report {

/// The script of a page. Under the pointer - or the arrow keys, when a picture has the focus - it
/// shows the values of the axes, what is drawn there, and the box of a paving, which it outlines in
/// all other pictures that have a side of it. A click or Enter keeps it, Escape lets it go. Texts
/// enter as texts only; nothing is asked of a network.
inline constexpr std::string_view page_script = R"js(
"use strict";
addEventListener("DOMContentLoaded", () => {
const regions = ["outside", "pending: not looked at closely", "undecided"];
const make = (name, attributes, parent) => {
  const e = document.createElementNS(parent.namespaceURI, name);
  for (const key in attributes) e.setAttribute(key, attributes[key]);
  return parent.appendChild(e);
};
const numbers = (text) => text.trim().split(/\s+/).map(Number);
// As many digits as the picture can show.
const about = (v, step) => {
  const digits = Math.max(0, Math.ceil(-Math.log10(step)));
  return digits > 9 || Math.abs(v) >= 1e6 ? v.toPrecision(4) : v.toFixed(digits);
};
const value = (name, v, step, unit) => `${name} = ${about(v, step)}${unit ? "\u00a0" + unit : ""}`;

const axis = (svg, key) => {
  if (!svg.dataset[key]) return null;
  const [from, to, lo, hi] = numbers(svg.dataset[key]);
  return { name: svg.dataset[key + "Name"], unit: svg.dataset[key + "Unit"], low: Math.min(from, to), high: Math.max(from, to),
    step: (hi - lo) / Math.abs(to - from), at: (p) => lo + (hi - lo) * (p - from) / (to - from), place: (v) => from + (to - from) * (v - lo) / (hi - lo) };
};
const paving = (figure) => {
  const names = figure.dataset.sides.split("\n"), scales = numbers(figure.dataset.scales), sides = [];
  for (let k = 0; 2 * k + 1 < scales.length; ++k)
    sides.push({ name: names[2 * k], unit: names[2 * k + 1], lo: scales[2 * k], step: (scales[2 * k + 1] - scales[2 * k]) / 1e4 });
  const boxes = figure.dataset.boxes.split(";").filter(Boolean).map((text) => {
    const [what, ...ends] = numbers(text);
    return { what, sides: new Map(sides.map((s, k) => [s.name, { ...s, low: s.lo + s.step * ends[2 * k], high: s.lo + s.step * ends[2 * k + 1] }])) };
  });
  return { boxes, inside: figure.dataset.inside, outside: figure.dataset.outside, leftOut: Number(figure.dataset.leftOut) };
};
const pavings = new Map();
for (const f of document.querySelectorAll("figure[data-boxes]")) pavings.set(f, paving(f));

const plots = [...document.querySelectorAll(".panels svg[role=img]")].map((svg) => {
  const tips = [];
  for (const t of svg.querySelectorAll("title")) {
    tips.push({ of: t.parentNode, text: t.textContent });
    t.remove();                                   // or the browser shows it as well
  }
  const rows = (svg.dataset.rows ?? "").split("\n").filter(Boolean).map((line) => {
    const [, head, name] = line.match(/^((?:\S+ ){6})(.*)$/);
    const [from, to, lo, hi, y, height] = numbers(head);
    return { name, from, to, lo, hi, y, height };
  });
  svg.tabIndex = 0;
  return { svg, tips, rows, x: axis(svg, "x"), y: axis(svg, "y"), paving: pavings.get(svg.closest("figure")) };
});

const bubble = document.createElement("div");
bubble.className = "bubble";
bubble.setAttribute("role", "status");
document.querySelector("main").append(bubble);
let kept = false, marks = [], cursor = null;

const mark = (plot, box, here) => {
  const { x, y } = plot, sx = x && box.sides.get(x.name), sy = y && box.sides.get(y.name);
  // A strip where only one axis is a side of the box; at least 5 units, so that it can be found.
  const span = (a, s) => {
    let [p, q] = s ? [a.place(s.low), a.place(s.high)].sort((l, r) => l - r) : [a.low, a.high];
    if (q < a.low || p > a.high) return null;
    const more = Math.max(0, 5 - (q - p)) / 2;
    p = Math.max(a.low, p - more); q = Math.min(a.high, q + more);
    return [p, Math.max(q - p, 1)];
  };
  if (sx || sy) {
    const h = span(x, sx), v = span(y, sy);
    if (h && v) marks.push(make("rect", { class: here ? "mark here" : "mark", x: h[0], width: h[1], y: v[0], height: v[1] }, plot.svg));
  }
  for (const r of plot.rows) {
    const s = box.sides.get(r.name);
    if (!s) continue;
    const at = (v) => r.from + (r.to - r.from) * Math.min(Math.max((v - r.lo) / (r.hi - r.lo), 0), 1);
    const width = Math.max(at(s.high) - at(s.low), 4);
    marks.push(make("rect", { class: "mark", x: Math.min(at(s.low), r.to - width), width, y: r.y - 2, height: r.height + 4 }, plot.svg));
  }
};
const clear = () => {
  for (const m of marks) m.remove();
  marks = [];
  bubble.textContent = "";
  bubble.classList.remove("kept");
  kept = false;
};
const inside = (a, p) => p >= a.low && p <= a.high;
// What the picture shows at (px, py), in its own units.
const read = (plot, px, py) => {
  const { x, y } = plot, lines = [];
  const framed = x && y && inside(x, px) && inside(y, py);
  if (framed) lines.push(value(x.name, x.at(px), x.step, x.unit) + ", " + value(y.name, y.at(py), y.step, y.unit));
  let nearest = null, least = 10;
  for (const t of plot.tips) {
    const b = t.box ??= t.of.getBBox();
    const d = Math.hypot(Math.max(b.x - px, 0, px - b.x - b.width), Math.max(b.y - py, 0, py - b.y - b.height)) + 1e-3 * Math.sqrt(b.width * b.height);
    if (d < least) { least = d; nearest = t; }
  }
  if (nearest) lines.push(nearest.text);
  let box = null;
  if (framed && plot.paving) {
    const u = x.at(px), v = y.at(py);
    for (const b of plot.paving.boxes) {
      const sx = b.sides.get(x.name), sy = b.sides.get(y.name);
      const over = sx && sy && u >= sx.low - x.step && u <= sx.high + x.step && v >= sy.low - y.step && v <= sy.high + y.step;
      if (over && (!box || b.what > box.what)) box = b;
    }
    if (box) {
      lines.push("box, " + (regions[box.what] ?? plot.paving.inside) + "; its sides, about:");
      for (const s of box.sides.values()) lines.push(`${s.name} ${about(s.low, s.step)} \u2026 ${about(s.high, s.step)}${s.unit ? "\u00a0" + s.unit : ""}`);
    } else if (plot.paving.leftOut) lines.push(`no box here among the largest ${plot.paving.boxes.length}; ${plot.paving.leftOut} smaller ones are not listed`);
    else lines.push(plot.paving.outside);
  }
  return { lines, box };
};
const show = (plot, px, py, left, top) => {
  clear();
  const { lines, box } = read(plot, px, py);
  if (box) for (const p of plots) mark(p, box, p === plot);
  for (const line of lines) bubble.append(Object.assign(document.createElement("div"), { textContent: line }));
  bubble.style.left = "0";                        // or what was near an edge stays narrow
  const { width, height } = bubble.getBoundingClientRect();
  bubble.style.left = Math.max(4, Math.min(left + 14, document.documentElement.clientWidth - width - 6)) + "px";
  bubble.style.top = (top + 18 + height < innerHeight ? top + 18 : Math.max(4, top - height - 12)) + "px";
  return lines.length > 0;
};
const keep = (yes) => { kept = yes; bubble.classList.toggle("kept", yes); };
for (const plot of plots) {
  const { svg } = plot;
  const units = (e) => new DOMPoint(e.clientX, e.clientY).matrixTransform(svg.getScreenCTM().inverse());
  const at = (e) => { const p = units(e); return show(plot, p.x, p.y, e.clientX, e.clientY); };
  let last = null;
  svg.addEventListener("pointermove", (e) => { last = e; if (!kept) at(e); });
  svg.addEventListener("pointerleave", () => { if (!kept) clear(); });
  // Clicks come in whole pixels: what was seen is kept, not what lies beside it.
  const near = (e) => last && Math.hypot(e.clientX - last.clientX, e.clientY - last.clientY) < 1.5 ? last : e;
  svg.addEventListener("click", (e) => { if (at(near(e))) keep(true); });
  const move = () => {
    const p = new DOMPoint(cursor.x, cursor.y).matrixTransform(svg.getScreenCTM());
    show(plot, cursor.x, cursor.y, p.x, p.y);
    marks.push(make("circle", { class: "mark cursor", cx: cursor.x, cy: cursor.y, r: 4 }, svg));
  };
  svg.addEventListener("keydown", (e) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
    const area = svg.viewBox.baseVal, x = plot.x ?? { low: 0, high: area.width }, y = plot.y ?? { low: 0, high: area.height };
    if (cursor?.svg !== svg) cursor = { svg, x: (x.low + x.high) / 2, y: (y.low + y.high) / 2 };
    if (step) {
      cursor.x = Math.min(Math.max(cursor.x + step[0] * (x.high - x.low) / 60, x.low), x.high);
      cursor.y = Math.min(Math.max(cursor.y + step[1] * (y.high - y.low) / 60, y.low), y.high);
      move();
      e.preventDefault();
    } else if (e.key === "Enter") { move(); keep(true); }
  });
  svg.addEventListener("blur", () => { if (!kept && cursor?.svg === svg) clear(); });
}
addEventListener("keydown", (e) => { if (e.key === "Escape") clear(); });
addEventListener("click", (e) => { if (kept && !e.target.closest("svg")) clear(); });
for (const s of document.querySelectorAll(".scroll")) if (s.scrollWidth > s.clientWidth) s.tabIndex = 0;
});
)js";

} // namespace sivid::report

#endif
