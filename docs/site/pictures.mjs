// SPDX-License-Identifier: MIT
// Pictures of report pages for the guides: what a reader sees first.
// Usage: node pictures.mjs PAGE.html PICTURE.png [HEIGHT | box]; box: the first paving, with the pointer on a box
import { writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { browser, find_browser } from "../../tests/browser/devtools.mjs";
import { hovered, pictures, swept } from "../../tests/browser/looks.mjs";

const [, , page, picture, height = "1250"] = process.argv;
const program = find_browser();
if (!program) {
    console.log("no Chromium here: apt-get install chromium, or name it in $CHROMIUM");
    process.exit(1);
}
const b = await browser.start(program);
let drawn = true;
try {
    const t = await b.tab(), box = height === "box";
    await t.size(1100, box ? 900 : Number(height));
    await t.show("screen", "light");
    await t.open(pathToFileURL(resolve(page)).href);
    if (box) {
        const all = (await t.call(pictures)).filter((p) => p.boxes), at = all[Math.min(1, all.length - 1)];
        const seen = at ? await t.call(swept, at.number, 40, 30, `(${hovered})`, null) : [];
        const boxes = seen.filter((h) => h.lines.some((l) => l.startsWith("box, ")) && h.marked.length > 1);
        drawn = boxes.length > 0;
        if (drawn) await t.mouse(boxes[boxes.length >> 1].x, boxes[boxes.length >> 1].y);
    }
    if (drawn) writeFileSync(picture, await t.picture(false));
} finally {
    await b.stop();
}
if (!drawn) console.log(`${page} shows no box of a paving that is in several pictures`);
process.exit(drawn ? 0 : 1);
