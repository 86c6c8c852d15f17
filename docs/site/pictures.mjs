// SPDX-License-Identifier: MIT
// Pictures of report pages for the guides: what a reader sees first.
// Usage: node pictures.mjs PAGE.html PICTURE.png [HEIGHT]
import { writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { browser, find_browser } from "../../tests/browser/devtools.mjs";

const [, , page, picture, height = "1250"] = process.argv;
const b = await browser.start(find_browser());
const t = await b.tab();
await t.size(1100, Number(height));
await t.show("screen", "light");
await t.open(pathToFileURL(resolve(page)).href);
writeFileSync(picture, await t.picture(false));
await b.stop();
