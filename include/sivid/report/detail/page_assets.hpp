// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DETAIL_PAGE_ASSETS_HPP
#define SIVID_REPORT_DETAIL_PAGE_ASSETS_HPP

#include <string_view>

namespace sivid::report {

/// The style sheet of a page: one column of at most 1120 px, system fonts, no resource from
/// elsewhere. Figures are drawn for a width of 360 units a panel, so that they keep their type size
/// on a phone; wide figures scroll within their own frame there, and say so, and tables become
/// lists. Dark where the reader's system is, for the drawings too, whose neutral colours
/// (`palette`) are exchanged; printed always light.
inline constexpr std::string_view page_style = R"css(
:root{color-scheme:light;--paper:#fff;--ink:#1a1d21;--muted:#5b6470;--rule:#dfe3e8;--soft:#f5f6f8;--accent:#0b5f94;--tint:#eef6fb;
--proved:#00805d;--undecided:#946200;--refuted:#b84a00;--proved-soft:#e8f5f0;--undecided-soft:#fdf5e3;--refuted-soft:#fdeee5;
--proved-ink:#00604a;--undecided-ink:#7d5400;--refuted-ink:#8f3a00;--noted:#e2b25c;--noted-soft:#fffaf0;--mark:#b0006d}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue","Liberation Sans",Arial,sans-serif}
main{max-width:1160px;margin:0 auto;padding:40px 20px 24px}
header .kind{margin:0 0 4px;color:var(--muted);font-size:13px;font-weight:600;letter-spacing:.08em;text-transform:uppercase}
h1{margin:0;font-size:34px;line-height:1.2;letter-spacing:-.015em;font-weight:700;overflow-wrap:anywhere}
header .lead{margin:6px 0 0;color:var(--muted);font-size:17px;max-width:75ch;overflow-wrap:anywhere}
h2{margin:52px 0 14px;padding-top:18px;border-top:1px solid var(--rule);font-size:23px;line-height:1.25;letter-spacing:-.01em}
h3{margin:30px 0 10px;font-size:17px}
p{margin:0 0 14px;max-width:88ch;overflow-wrap:anywhere}
ul{margin:0 0 16px;padding-left:22px;max-width:96ch}
li{margin:5px 0;overflow-wrap:anywhere}
.banner{display:flex;gap:18px;align-items:flex-start;margin:26px 0 22px;padding:20px 22px;border-left:6px solid;border-radius:6px}
.banner .sign{flex:none;width:38px;height:38px;border-radius:50%;color:#fff;font-size:22px;line-height:38px;font-weight:700;text-align:center}
.banner strong{display:block;font-size:21px;line-height:1.25;margin-bottom:4px}
.banner p{margin:0;font-size:16.5px}
.proved{background:var(--proved-soft);border-color:var(--proved)}.proved .sign{background:var(--proved)}.proved strong{color:var(--proved-ink)}
.undecided{background:var(--undecided-soft);border-color:var(--undecided)}.undecided .sign{background:var(--undecided)}.undecided strong{color:var(--undecided-ink)}
.refuted{background:var(--refuted-soft);border-color:var(--refuted)}.refuted .sign{background:var(--refuted)}.refuted strong{color:var(--refuted-ink)}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(165px,1fr));gap:12px;margin:0 0 20px}
.card{padding:13px 16px 12px;background:var(--soft);border-radius:6px}
.card .name{color:var(--muted);font-size:13px}
.card .value{margin-top:1px;font-size:21px;line-height:1.3;font-weight:650;letter-spacing:-.01em;font-variant-numeric:tabular-nums;overflow-wrap:anywhere}
.card .note{color:var(--muted);font-size:13px;line-height:1.4}
.scroll{overflow-x:auto;margin:0 0 20px}
table{border-collapse:collapse;width:100%;font-size:15px;font-variant-numeric:tabular-nums}
p.caption{color:var(--muted);font-size:14.5px;margin:-10px 0 20px}
table.narrow{width:auto}
th{padding:6px 13px 7px;border-bottom:2px solid var(--ink);font-size:13.5px;font-weight:600;text-align:left;vertical-align:bottom}
td{padding:7px 13px;border-bottom:1px solid var(--rule);vertical-align:top}
th:first-child{white-space:nowrap}th:first-child,td:first-child{padding-left:2px}th:last-child,td:last-child{padding-right:2px}
.number{text-align:right;white-space:nowrap}
.symbol{font-weight:600;white-space:nowrap}
td.note{color:var(--muted);font-size:14px;min-width:11em}
tr.chosen td{background:var(--tint)}
figure{margin:18px 0 28px}
.panels{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,340px),1fr));gap:14px 18px}
.panels.wide{display:block;overflow-x:auto}
.panels.wide svg{min-width:700px}
.panels.pair{grid-template-columns:repeat(auto-fill,minmax(min(100%,360px),1fr))}
.panels svg{display:block;width:100%;height:auto}
.legend{display:flex;flex-wrap:wrap;gap:4px 22px;margin:0 0 12px;font-size:14px;list-style:none;padding:0;max-width:none}
.legend li{display:flex;align-items:center;gap:8px;margin:0}
.legend svg{flex:none}
figcaption{margin-top:10px;color:var(--muted);font-size:14.5px;line-height:1.5;max-width:112ch}
figcaption b{color:var(--ink)}
.plain{padding:18px 22px 8px;background:var(--tint);border-radius:6px;margin:0 0 20px}
.plain ul{list-style:none;padding:0}
.plain li{position:relative;padding-left:26px;margin:9px 0}
.plain li::before{content:"";position:absolute;left:4px;top:.62em;width:7px;height:7px;border-radius:50%;background:var(--accent)}
.box{padding:16px 22px 6px;border:1px solid var(--rule);border-radius:6px;margin:0 0 20px}
.box h2{margin:0 0 8px;padding:0;border:0;font-size:17px}
.warning{border-color:var(--noted);background:var(--noted-soft)}
a{color:var(--accent)}
svg:focus-visible{outline:2px solid var(--accent);outline-offset:2px}
.mark{fill:none;stroke:var(--mark);stroke-width:1.6;pointer-events:none}.mark.here{stroke-width:2.4}.mark.cursor{fill:var(--mark)}
.bubble{position:fixed;z-index:1;max-width:min(420px,92vw);padding:7px 11px;background:var(--ink);color:var(--paper);border-radius:5px;font-size:13.5px;line-height:1.4;font-variant-numeric:tabular-nums;pointer-events:none;overflow-wrap:anywhere}
.bubble:empty{display:none}.bubble.kept{outline:2px solid var(--mark)}
footer{margin-top:56px;padding-top:14px;border-top:1px solid var(--rule);color:var(--muted);font-size:13.5px}
footer span{display:inline-block;margin-right:22px;max-width:100%;overflow-wrap:anywhere}
@media(max-width:620px){main{padding:24px 16px}h1{font-size:27px}h2{font-size:20px;margin-top:38px}.banner{padding:16px;gap:13px}
.banner .sign{width:30px;height:30px;line-height:30px;font-size:19px}.banner strong{font-size:18px}.cards{grid-template-columns:1fr 1fr}.card .value{font-size:18px}
.plain,.box{padding-left:16px;padding-right:16px}.narrow{font-size:13px}.narrow .symbol,.narrow th,.narrow th:first-child{white-space:normal}.narrow :is(th,td){padding:6px 3px}}
@media(max-width:1160px){th,td{padding-left:8px;padding-right:8px}td.note{min-width:8em}}
@media screen and (max-width:740px){.panels.wide::before{content:"wider than the screen: scroll sideways \2192";position:sticky;left:0;color:var(--muted);font-size:13px}}
@media screen and (max-width:1060px){table:not(.narrow),table:not(.narrow) :is(tbody,tr){display:block}table:not(.narrow) thead{position:absolute;clip-path:inset(50%);width:1px;height:1px;overflow:hidden}
table:not(.narrow) tr{padding:8px 0;border-bottom:1px solid var(--rule)}table:not(.narrow) tr.chosen{background:var(--tint)}
table:not(.narrow) td{display:flex;gap:14px;padding:2px;border:0;text-align:left;white-space:normal;overflow-wrap:anywhere}
table:not(.narrow) td::before{content:attr(data-head);flex:none;width:9em;color:var(--muted);font-weight:400;font-size:14px}table:not(.narrow) td:empty{display:none}}
@media screen and (prefers-color-scheme:dark){:root{color-scheme:dark;--paper:#14171b;--ink:#e6e9ed;--muted:#a3adb8;--rule:#323941;--soft:#1e2329;--accent:#6cb8ea;--tint:#17262f;
--proved:#1f9b77;--undecided:#b57900;--refuted:#d4621a;--proved-soft:#10281f;--undecided-soft:#2c220c;--refuted-soft:#301a0d;
--proved-ink:#6fd6b3;--undecided-ink:#efbf62;--refuted-ink:#ff9f63;--noted:#8a6a2c;--noted-soft:#241e12;--mark:#ff7ac6}
.banner .sign{color:#14171b}
figure [fill="#ffffff"]{fill:#14171b}figure [stroke="#ffffff"]{stroke:#14171b}figure [fill="#1a1d21"]{fill:#e6e9ed}figure [stroke="#1a1d21"]{stroke:#e6e9ed}
figure [fill="#5b6470"]{fill:#a3adb8}figure [stroke="#e6e8ec"]{stroke:#2a3037}figure [fill="#eceef1"]{fill:#252a31}figure [fill="#d5d9df"]{fill:#434b55}
figure [stroke="#0072b2"]{stroke:#4aa8e0}figure [stroke="#a0447a"]{stroke:#d07ab0}
figure text[fill="#00805d"]{fill:#45c9a0}figure text[fill="#b34e00"]{fill:#ff9a57}
figure [fill="#eef2f6"]{fill:#1d242b}figure [fill="#eef6fb"]{fill:#17262f}figure [stroke="#8b94a0"]{stroke:#727c88}}
@media print{body{font-size:10.5pt}main{max-width:none;padding:0}h2{break-after:avoid;margin-top:26px}
figure .panels svg,figcaption,.banner,.card,.box,tr{break-inside:avoid}.panels{grid-template-columns:repeat(2,1fr)}.panels.pair{grid-template-columns:1fr}.panels.pair svg{max-width:70%;margin:auto}.panels.wide,.scroll{overflow:visible}.panels.wide svg{min-width:0}
table{font-size:9pt}th{font-size:8.5pt}th,td{padding-left:6px;padding-right:6px}td.note{font-size:8.5pt;min-width:7em}.bubble{display:none}.number{white-space:normal}td.text{overflow-wrap:anywhere}
*{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
)css";

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
