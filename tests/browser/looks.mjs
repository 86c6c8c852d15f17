// SPDX-License-Identifier: MIT
// What is looked for in an open page. Each function runs inside the page and returns findings, a line each.

/// What is cut, overflows, is too small to read or hard to see. `sideways`: wide pictures may scroll in their own frame, if they say so.
export function layout(sideways) {
    const findings = [], seen = new Set();
    const words = (e) => `<${e.tagName.toLowerCase()}${e.classList?.length ? " class=" + [...e.classList].join(".") : ""}> “${e.textContent.trim().replace(/\s+/g, " ").slice(0, 50)}”`;
    const found = (what) => { if (!seen.has(what) && seen.size < 40) { seen.add(what); findings.push(what); } };
    const root = document.documentElement, width = root.clientWidth;
    if (root.scrollWidth > width) found(`the page is ${root.scrollWidth} px wide on ${width}`);
    const frame = (e) => e.closest(".panels.wide");
    const shown = (e) => e.checkVisibility({ visibilityProperty: true });
    const hidden = (e) => e.closest("thead") && getComputedStyle(e.closest("thead")).clipPath !== "none";   // tables as lists
    for (const e of document.body.querySelectorAll("*")) {
        if (!shown(e) || e.ownerSVGElement || hidden(e)) continue;
        const style = getComputedStyle(e);
        if (e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0 && style.overflowX !== "visible") {
            const says = e === frame(e) && getComputedStyle(e, "::before").content.includes("scroll");
            if (!sideways || !says) found(`cut, ${e.scrollWidth} px in a frame of ${e.clientWidth}: ${words(e)}`);
            else if (!e.querySelector("[tabindex]") && e.tabIndex < 0) found(`scrolls, but not by keys: ${words(e)}`);
        }
        if (frame(e)) continue;
        const box = e.getBoundingClientRect();
        if (box.width > 0 && (box.right > width + 0.5 || box.left < -0.5)) found(`beyond the edge (${Math.round(box.left)} to ${Math.round(box.right)} of ${width}): ${words(e)}`);
    }

    // Lightness as in WCAG 2.
    const channel = (c) => (c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
    const parsed = (text) => { const n = text.match(/[\d.]+/g)?.map(Number); return n && (n[3] === undefined || n[3] > 0) ? n : undefined; };
    const light = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
    const contrast = (p, q) => { const [a, b] = [light(p), light(q)].sort((x, y) => y - x); return (a + 0.05) / (b + 0.05); };
    const inside = (b, x, y) => x >= b.left && x <= b.right && y >= b.top && y <= b.bottom;
    for (const svg of document.querySelectorAll("svg[role=img]")) {
        if (!shown(svg)) continue;
        const name = svg.getAttribute("aria-label");
        if (!name?.trim()) found(`a picture without a name: ${words(svg)}`);
        const area = svg.getBoundingClientRect();
        if (area.height > 1000) found(`a picture ${Math.round(area.height)} px high, more than a screen or a page: ${name}`);
        const scale = svg.getScreenCTM().a;
        // In painting order; what a text stands on is the last shape under its middle.
        const all = [...svg.querySelectorAll("rect,path,circle,text")].filter((e) => !e.closest("defs")), texts = [];
        const boxes = new Map(all.map((e) => [e, e.getBoundingClientRect()]));
        // What an inner picture cuts off is not under a text; its own rectangle would contain that.
        const windows = new Map([...svg.querySelectorAll("svg")].map((inner) => {
            const m = inner.getScreenCTM(), v = inner.viewBox.baseVal, from = new DOMPoint(v.x, v.y).matrixTransform(m);
            return [inner, new DOMRect(from.x, from.y, v.width * m.a, v.height * m.d)];
        }));
        all.forEach((t, order) => {
            if (t.tagName !== "text" || !t.textContent.trim()) return;
            const b = boxes.get(t), what = `“${t.textContent}” in “${name}”`;
            if (b.left < area.left - 1 || b.right > area.right + 1 || b.top < area.top - 1 || b.bottom > area.bottom + 1) found(`cut by its picture: ${what}`);
            const size = parseFloat(getComputedStyle(t).fontSize) * scale;
            if (size < 7) found(`${size.toFixed(1)} px small: ${what}`);
            for (const [other, o] of texts) {
                const wide = Math.min(b.right, o.right) - Math.max(b.left, o.left), high = Math.min(b.bottom, o.bottom) - Math.max(b.top, o.top);
                if (wide > 2 && high > 0.35 * Math.min(b.height, o.height)) found(`“${other.textContent}” and ${what} lie on each other`);
            }
            texts.push([t, b]);
            const x = (b.left + b.right) / 2, y = (b.top + b.bottom) / 2;
            let ground = parsed(getComputedStyle(svg.querySelector("rect")).fill) ?? [255, 255, 255];
            for (const under of all.slice(0, order)) {
                const u = boxes.get(under);
                const window = windows.get(under.ownerSVGElement) ?? area;
                if (under.tagName === "text" || !inside(u, x, y) || !inside(window, x, y)) continue;
                const style = getComputedStyle(under), fill = style.fill.startsWith("url") ? parsed(getComputedStyle(svg.querySelector(style.fill.match(/#[^")]+/)[0] + " rect")).fill) : parsed(style.fill);
                const p = new DOMPoint(x, y).matrixTransform(under.getScreenCTM().inverse());
                if (!fill || !under.isPointInFill(p)) continue;
                const part = Number(style.opacity);
                ground = ground.slice(0, 3).map((g, i) => g * (1 - part) + fill[i] * part);
            }
            const ratio = contrast(parsed(getComputedStyle(t).fill) ?? [0, 0, 0], ground);
            if (ratio < 4.5) found(`contrast ${ratio.toFixed(2)}: ${what}`);
        });
    }
    return findings;
}

/// Findings of axe-core, which has been put into the page. `colours`: what else it looks for does not depend on them.
export async function accessibility(colours) {
    const tags = { type: "tag", values: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"] };
    const runOnly = colours ? { type: "rule", values: axe.getRules(["cat.color"]).map((r) => r.ruleId).filter((id) => id !== "color-contrast-enhanced") } : tags;
    const result = await axe.run(document, { runOnly, resultTypes: ["violations"] });
    return result.violations.flatMap((v) => v.nodes.slice(0, 5).map((n) => `${v.id}: ${v.help}; ${n.html.slice(0, 110)} ${n.any.map((a) => a.message).join("; ").slice(0, 160)}`));
}

/// Places of the pictures, for the pointer. `boxes`: they show boxes of a paving.
export function pictures() {
    return [...document.querySelectorAll(".panels svg[role=img]")].map((svg, number) => {
        const b = svg.getBoundingClientRect();
        return { number, name: svg.getAttribute("aria-label"), left: b.left + scrollX, top: b.top + scrollY, width: b.width, height: b.height,
            boxes: Boolean(svg.closest("figure[data-boxes]")), values: Boolean(svg.dataset.x), tips: svg.querySelectorAll("title").length };
    });
}

/// What the pointer has brought up: the bubble's lines, the numbers of the pictures with outlines, and whether all is in view.
export function hovered() {
    const bubble = document.querySelector(".bubble"), b = bubble.getBoundingClientRect(), all = [...document.querySelectorAll(".panels svg[role=img]")];
    return { lines: [...bubble.children].map((e) => e.textContent), kept: bubble.classList.contains("kept"),
        marked: all.flatMap((svg, i) => (svg.querySelector(".mark:not(.cursor)") ? [i] : [])),
        beyond: bubble.children.length > 0 && (b.left < 0 || b.top < 0 || b.right > innerWidth || b.bottom > innerHeight),
        marksOutside: [...document.querySelectorAll(".mark")].filter((m) => { const r = m.getBoundingClientRect(), s = m.ownerSVGElement.getBoundingClientRect();
            return r.left < s.left - 1 || r.right > s.right + 1 || r.top < s.top - 1 || r.bottom > s.bottom + 1; }).length };
}

/// Moves a pointer over one picture in a grid, by events of the page's own: a mouse takes a frame for each place. What `hovered` tells at
/// the places where something is shown, with the places on the screen; `until`: a function of that and the picture's number, to stop at;
/// it is asked in the middles of the paving's boxes first, which may be smaller than any grid.
export function swept(number, columns, rows, hovered, until) {
    const svg = document.querySelectorAll(".panels svg[role=img]")[number], stop = until && eval(until), told = eval(hovered), seen = [];
    scrollTo(0, svg.getBoundingClientRect().top + scrollY - 60);
    const b = svg.getBoundingClientRect(), places = [];
    const numbers = (text) => text.trim().split(/\s+/).map(Number);
    const boxes = until && svg.closest("figure[data-boxes]")?.dataset;
    if (boxes) {
        const names = boxes.sides.split("\n"), scales = numbers(boxes.scales), to_screen = svg.getScreenCTM();
        const place = (key, ends) => {
            const k = names.findIndex((n, i) => i % 2 === 0 && n === svg.dataset[key + "Name"]) / 2, [from, to, lo, hi] = numbers(svg.dataset[key]);
            const middle = scales[2 * k] + ((ends[2 * k] + ends[2 * k + 1]) / 2e4) * (scales[2 * k + 1] - scales[2 * k]);
            return from + ((to - from) * (middle - lo)) / (hi - lo);
        };
        for (const text of boxes.boxes.split(";").filter(Boolean).slice(0, 100)) {
            const p = new DOMPoint(place("x", numbers(text).slice(1)), place("y", numbers(text).slice(1))).matrixTransform(to_screen);
            places.push([p.x, p.y]);
        }
    }
    for (let i = 1; i < columns; ++i)
        for (let k = 1; k < rows; ++k) places.push([b.left + (b.width * i) / columns, b.top + (b.height * k) / rows]);
    for (const [x, y] of places) {
        const under = document.elementFromPoint(x, y);
        if (under?.closest("svg[role=img]") !== svg) continue;
        under.dispatchEvent(new PointerEvent("pointermove", { clientX: x, clientY: y, bubbles: true }));
        const h = told();
        if (h.lines.length) seen.push({ x, y, ...h });
        if (stop && stop(h, number)) break;
    }
    svg.dispatchEvent(new PointerEvent("pointerleave"));
    return seen;
}
