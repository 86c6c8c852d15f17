// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_STYLE_HPP
#define SIVID_REPORT_PAGE_STYLE_HPP

#include <string_view>

namespace sivid::report {

/// The style sheet of a page: one column of at most 1120 px, system fonts, no script and no
/// resource from elsewhere. Figures are drawn for a width of 360 units a panel, so that they keep
/// their type size on a phone; wide figures scroll within their own frame there.
inline constexpr std::string_view page_style = R"css(
:root{color-scheme:light;--ink:#1a1d21;--muted:#5b6470;--rule:#dfe3e8;--soft:#f5f6f8;--accent:#0b5f94;
--proved:#00805d;--undecided:#b57900;--refuted:#c24f00}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:#fff;color:var(--ink);font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue","Liberation Sans",Arial,sans-serif}
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
.proved{background:#e8f5f0;border-color:var(--proved)}.proved .sign{background:var(--proved)}.proved strong{color:#00604a}
.undecided{background:#fdf5e3;border-color:var(--undecided)}.undecided .sign{background:var(--undecided)}.undecided strong{color:#7d5400}
.refuted{background:#fdeee5;border-color:var(--refuted)}.refuted .sign{background:var(--refuted)}.refuted strong{color:#8f3a00}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(165px,1fr));gap:12px;margin:0 0 20px}
.card{padding:13px 16px 12px;background:var(--soft);border-radius:6px}
.card .name{color:var(--muted);font-size:13px}
.card .value{margin-top:1px;font-size:21px;line-height:1.3;font-weight:650;letter-spacing:-.01em;font-variant-numeric:tabular-nums;overflow-wrap:anywhere}
.card .note{color:var(--muted);font-size:13px;line-height:1.4}
.scroll{overflow-x:auto;margin:0 0 20px}
table{border-collapse:collapse;width:100%;font-size:15px;font-variant-numeric:tabular-nums}
p.caption{color:var(--muted);font-size:14.5px;margin:-10px 0 20px}
table.narrow{width:auto}
th{padding:6px 14px 7px;border-bottom:2px solid var(--ink);font-size:13.5px;font-weight:600;text-align:left;vertical-align:bottom;white-space:nowrap}
td{padding:7px 14px;border-bottom:1px solid var(--rule);vertical-align:top}
th:first-child,td:first-child{padding-left:2px}th:last-child,td:last-child{padding-right:2px}
.number{text-align:right;white-space:nowrap}
.symbol{font-weight:600;white-space:nowrap}
td.note{color:var(--muted);font-size:14px;min-width:14em}
tr.chosen td{background:#eef6fb}
figure{margin:18px 0 28px}
.panels{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,340px),1fr));gap:14px 18px}
.panels.wide{display:block;overflow-x:auto}
.panels.wide svg{min-width:780px}
.panels.pair{grid-template-columns:repeat(auto-fill,minmax(min(100%,400px),1fr))}
.panels svg{display:block;width:100%;height:auto}
.legend{display:flex;flex-wrap:wrap;gap:4px 22px;margin:0 0 12px;font-size:14px;list-style:none;padding:0;max-width:none}
.legend li{display:flex;align-items:center;gap:8px;margin:0}
.legend svg{flex:none}
figcaption{margin-top:10px;color:var(--muted);font-size:14.5px;line-height:1.5;max-width:112ch}
figcaption b{color:var(--ink)}
.plain{padding:18px 22px 8px;background:#eef6fb;border-radius:6px;margin:0 0 20px}
.plain ul{list-style:none;padding:0}
.plain li{position:relative;padding-left:26px;margin:9px 0}
.plain li::before{content:"";position:absolute;left:2px;top:.5em;width:11px;height:6px;border-left:2.5px solid var(--accent);border-bottom:2.5px solid var(--accent);transform:rotate(-45deg)}
.box{padding:16px 22px 6px;border:1px solid var(--rule);border-radius:6px;margin:0 0 20px}
.box h3,.plain h3{margin:0 0 8px}
.warning{border-color:#e2b25c;background:#fffaf0}
a{color:var(--accent)}
footer{margin-top:56px;padding-top:14px;border-top:1px solid var(--rule);color:var(--muted);font-size:13.5px}
footer span{display:inline-block;margin-right:22px}
@media(max-width:620px){main{padding:24px 16px}h1{font-size:27px}h2{font-size:20px;margin-top:38px}.banner{padding:16px;gap:13px}
.banner .sign{width:30px;height:30px;line-height:30px;font-size:18px}.banner strong{font-size:18px}.cards{grid-template-columns:1fr 1fr}.card .value{font-size:18px}
table{font-size:14px}th,td{padding-left:9px;padding-right:9px}.panels.wide{margin-right:-16px}.plain,.box{padding-left:16px;padding-right:16px}}
@media print{body{font-size:10.5pt}main{max-width:none;padding:0}h2{break-after:avoid;margin-top:26px}
figure,.banner,.cards,.plain,.box,tr{break-inside:avoid}.panels{grid-template-columns:repeat(3,1fr)}.panels.pair{grid-template-columns:1fr 1fr}.panels.wide,.scroll{overflow:visible}.panels.wide svg{min-width:0}
*{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
)css";

} // namespace sivid::report

#endif
