// SPDX-License-Identifier: MIT
// Pictures of report pages for the guides: what a reader sees first.
// Usage: node pictures.mjs PAGE.html PICTURE.png [HEIGHT | box]; box: the first paving, with the pointer on a box
import { writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { browser, find_browser } from "../../tests/browser/devtools.mjs";
import { hovered, pictures } from "../../tests/browser/looks.mjs";

const [, , page, picture, height = "1250"] = process.argv;
const b = await browser.start(find_browser());
const t = await b.tab();
const box = height === "box";
await t.size(1100, box ? 900 : Number(height));
await t.show("screen", "light");
await t.open(pathToFileURL(resolve(page)).href);
if (box) {
    const all = (await t.call(pictures)).filter((p) => p.boxes), at = all[Math.min(1, all.length - 1)];
    await t.value(`scrollTo(0, ${at.top - 60})`);
    const top = at.top - (await t.value("scrollY"));
    for (let k = 8; k < 24; ++k) {
        await t.mouse(at.left + at.width * 0.3, top + (at.height * k) / 30);
        if ((await t.call(hovered)).lines.some((l) => l.startsWith("box, "))) break;
    }
}
writeFileSync(picture, await t.picture(false));
await b.stop();
