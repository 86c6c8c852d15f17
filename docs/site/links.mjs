// SPDX-License-Identifier: MIT
// Every link of the site leads to a file of the site, and to a place in it that exists; nothing is loaded from elsewhere.
// Usage: node links.mjs SITE
import { existsSync, readdirSync, readFileSync, statSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";

const site = resolve(process.argv[2]), pages = [], bad = [];
const walk = (folder) => {
    for (const name of readdirSync(folder)) {
        const path = join(folder, name);
        if (statSync(path).isDirectory()) walk(path);
        else if (name.endsWith(".html")) pages.push(path);
    }
};
walk(site);
const texts = new Map(pages.map((p) => [p, readFileSync(p, "utf8")]));
const anchors = new Map(pages.map((p) => [p, new Set([...texts.get(p).matchAll(/\b(?:id|name)="([^"]+)"/g)].map((m) => m[1]))]));
const plain = (text) => decodeURIComponent(text.replaceAll("&amp;", "&"));
let links = 0;
for (const [page, text] of texts) {
    for (const [, name, target] of text.matchAll(/\b(href|src)="([^"]*)"/g)) {
        if (/^(javascript:|mailto:|data:|$)/.test(target)) continue;
        if (target === "#define-members") continue;   // Doxygen 1.9.4 writes it where all macros are undocumented
        const where = `${relative(site, page)}: ${target}`;
        if (/^(https?:)?\/\//.test(target)) {
            // A reader may follow a link out; the page itself loads nothing.
            if (name === "src" || new RegExp(`<link[^>]*${target.replace(/[.?*+^$()|[\]\\]/g, "\\$&")}`).test(text)) bad.push(`${where} is loaded from elsewhere`);
            continue;
        }
        ++links;
        const [file, anchor] = target.split("#");
        const to = file ? resolve(dirname(page), plain(file).split("?")[0]) : page;
        if (!existsSync(to)) bad.push(`${where} leads to nothing`);
        else if (anchor && anchors.has(to) && !anchors.get(to).has(plain(anchor))) bad.push(`${where} leads to no place there`);
    }
}
for (const line of bad.slice(0, 200)) console.log(line);
console.log(`${pages.length} pages, ${links} links, ${bad.length} of them bad`);
process.exit(bad.length ? 1 : 0);
