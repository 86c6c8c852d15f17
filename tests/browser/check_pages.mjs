// SPDX-License-Identifier: MIT
// Opens pages in headless Chromium: at four widths, light and dark, and printed. Nothing may overflow, be cut, collide or be hard to
// see; no script may fail, nothing may be asked of a network; what the pointer shows is right.
// Usage: node check_pages.mjs [--pictures DIR] --axe AXE.JS PAGE.html...; 1 with findings, 77 without a browser.
import { readFileSync, writeFileSync, mkdirSync } from "node:fs";
import { basename, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { browser, find_browser } from "./devtools.mjs";
import { accessibility, hovered, layout, pictures, swept } from "./looks.mjs";

const widths = [400, 800, 1100, 1400];
const ends = [400, 1400];   // axe and the pointer: what lies between has the same texts
const options = { pages: [] };
for (let i = 2; i < process.argv.length; ++i) {
    if (process.argv[i].startsWith("--")) options[process.argv[i].slice(2)] = process.argv[++i];
    else options.pages.push(process.argv[i]);
}
const program = find_browser();
if (!program) {
    console.log("SKIPPED: no Chromium here, so that NO PAGE WAS OPENED. Install it (apt-get install chromium) or name it in $CHROMIUM.");
    process.exit(77);
}
if (!options.pages.length || !options.axe) {
    console.log("usage: node check_pages.mjs [--pictures DIR] --axe AXE.JS PAGE.html...");
    process.exit(2);
}
const axe = readFileSync(options.axe, "utf8");

/// All findings of one page, each with where it was seen.
async function findings_of(b, url, pointer = true) {
    const all = [];
    let requests = [];
    const t = await b.tab((method, p) => {
        if (method === "Runtime.exceptionThrown") all.push(`script: ${p.exceptionDetails.exception?.description ?? p.exceptionDetails.text}`);
        if (method === "Log.entryAdded" && ["error", "warning"].includes(p.entry.level)) all.push(`console: ${p.entry.text}`);
        if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(p.type)) all.push(`console: ${p.args[0]?.value}`);
        if (method === "Network.requestWillBeSent" && p.request.url !== url) requests.push(p.request.url.slice(0, 100));
    });
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await t.send(`${domain}.enable`);
    const add = (where, list) => all.push(...list.map((f) => `${where}: ${f}`));
    let opened = false;
    for (const width of widths) {
        await t.size(width, 900);
        for (const scheme of ["light", "dark"]) {
            await t.show("screen", scheme);
            if (!opened) await t.open(url);
            else await t.call(() => new Promise((f) => requestAnimationFrame(() => requestAnimationFrame(f))));
            if (!opened) await t.value(axe + ";0");
            opened = true;
            const where = `${width} px, ${scheme}`;
            add(where, await t.call(layout, width < 740));
            if (ends.includes(width)) add(where, await t.call(accessibility, scheme === "dark"));
            if (options.pictures && pointer) writeFileSync(join(options.pictures, `${basename(url, ".html")}-${width}-${scheme}.png`), await t.picture());
        }
        if (pointer && ends.includes(width)) add(`${width} px, pointer`, await pointed(t));
    }
    // A4 less a margin of 10 mm on each side.
    await t.show("print", "dark");
    await t.size(718, 1047);
    add("printed", await t.call(layout, false));
    if ((await t.value("getComputedStyle(document.body).backgroundColor")) !== "rgb(255, 255, 255)") add("printed", ["not on white paper"]);
    const { data } = await t.send("Page.printToPDF", { printBackground: true, paperWidth: 8.27, paperHeight: 11.69 });
    if (options.pictures && pointer) writeFileSync(join(options.pictures, `${basename(url, ".html")}.pdf`), Buffer.from(data, "base64"));
    if (Buffer.from(data, "base64").length < 2000) add("printed", ["an empty document"]);
    add("network", requests);
    await t.close();
    return all;
}

/// Moves the pointer over every picture of the page; the mouse itself then shows the same at one of the places.
async function pointed(t) {
    const findings = [];
    for (const p of await t.call(pictures)) {
        if (!(p.values || p.boxes || p.tips)) continue;
        const name = `“${p.name}”`, seen = await t.call(swept, p.number, 8, 6, `(${hovered})`, null);
        if (seen.some((h) => h.beyond)) findings.push(`${name}: what is shown lies beyond the screen`);
        if (seen.some((h) => h.marksOutside)) findings.push(`${name}: an outline lies beyond its picture`);
        if (!seen.length) findings.push(`${name}: the pointer shows nothing`);
        else if (p.values && !seen.some((h) => / = [-\d]/.test(h.lines[0]))) findings.push(`${name}: the pointer shows no values`);
        if (!seen.length) continue;
        const { x, y, lines } = seen[Math.floor(seen.length / 2)];
        await t.mouse(x, y);
        const h = await t.call(hovered);
        if (h.lines.join("\n") !== lines.join("\n")) findings.push(`${name}: the mouse shows “${h.lines}”, not “${lines}”`);
    }
    await t.mouse(1, 1);
    return findings;
}

/// Boxes are linked: some place of each paving outlines a box in it and in other pictures; a click keeps it, Escape does not.
async function linked(b, url) {
    const findings = [], t = await b.tab();
    await t.size(1400, 900);
    await t.show("screen", "light");
    await t.open(url);
    const pavings = (await t.call(pictures)).filter((q) => q.boxes);
    for (const p of pavings) {
        const box = (h, number) => h.lines.some((l) => l.startsWith("box, ")) && h.marked.includes(number);
        const place = (await t.call(swept, p.number, 40, 30, `(${hovered})`, `(${box})`)).find((h) => box(h, p.number));
        if (place) await t.mouse(place.x, place.y);
        const hit = place && (await t.call(hovered));
        if (!hit || !box(hit, p.number)) findings.push(`“${p.name}”: no box under the pointer`);
        else {
            if (hit.marked.length < 2 && pavings.length > 1) findings.push(`“${p.name}”: the box is outlined in no other picture`);
            await t.mouse(place.x, place.y, "mousePressed", "left");
            await t.mouse(place.x, place.y, "mouseReleased", "left");
            await t.mouse(2, 2);
            const kept = await t.call(hovered);
            if (!kept.kept || kept.marked.length !== hit.marked.length) findings.push(`“${p.name}”: a click does not keep the box`);
            await t.key("Escape");
            if ((await t.call(hovered)).lines.length) findings.push(`“${p.name}”: Escape does not let the box go`);
        }
    }
    await t.close();
    return findings;
}

/// A page with every fault: the checks see them all, or they are worth nothing.
async function planted(b) {
    const faults = `<!DOCTYPE html><html><head><meta charset="utf-8"><title>faults</title></head><body><main><h1>Faults</h1>
        <p style="color:#aaa">pale</p><div style="width:300px;overflow:auto"><table><tr><td style="white-space:nowrap">${"wide ".repeat(60)}</td></tr></table></div>
        <p style="width:1500px">beyond</p><img src="http://example.invalid/x.png"><svg role="img" width="100" height="50" viewBox="0 0 100 50"><rect width="100" height="50" fill="#fff"/>
        <text x="90" y="20" font-size="12">cut</text><text x="5" y="20" font-size="12">one</text><text x="8" y="22" font-size="12">two</text>
        <text x="5" y="40" font-size="3">tiny</text><rect y="25" x="50" width="50" height="25" fill="#333"/><text x="55" y="45" font-size="12">dark</text>
        <svg x="60" y="0" width="40" height="24" viewBox="60 0 40 24" overflow="hidden"><rect x="0" y="0" width="500" height="500" fill="#222"/><text x="62" y="18" font-size="9">inner</text></svg></svg>
        <div class="panels"></div><div class="bubble"></div></main><script>throw new Error("planted")</script></body></html>`;
    const found = await findings_of(b, "data:text/html;charset=utf-8," + encodeURIComponent(faults), false);
    const wanted = ["script: Error: planted", "color-contrast", "image-alt", "cut, ", "beyond the edge", "cut by its picture", "lie on each other", "px small", "contrast 1.", "contrast 1.32: “inner”",
        "a picture without a name", "network: http://example.invalid", "html-has-lang", "the page is"];
    return wanted.filter((w) => !found.some((f) => f.includes(w))).map((w) => `the planted fault was not seen: ${w}`);
}

if (options.pictures) mkdirSync(options.pictures, { recursive: true });
const b = await browser.start(program);
let bad = 0;
let begin = performance.now();
const report = (name, findings) => {
    const lines = [...new Set(findings)], now = performance.now();
    bad += lines.length;
    console.log(`${lines.length ? "FAILED" : "passed"}: ${name} (${((now - begin) / 1000).toFixed(1)} s)`);
    begin = now;
    for (const line of lines) console.log(`  ${line}`);
};
try {
    report("planted faults are seen", await planted(b));
    let pavings = 0;
    for (const page of options.pages) {
        const url = pathToFileURL(resolve(page)).href;
        report(basename(page), await findings_of(b, url));
        if (!readFileSync(page, "utf8").includes("<figure data-sides=")) continue;
        ++pavings;
        report(`${basename(page)}, boxes and their places`, await linked(b, url));
    }
    if (pavings === 0) report("boxes and their places", ["no page shows a paving with its boxes"]);
} finally {
    await b.stop();
}
console.log(bad ? `${bad} findings` : `nothing to find in ${options.pages.length} pages`);
process.exit(bad ? 1 : 0);
