// SPDX-License-Identifier: MIT
// Turns the guides' Markdown, as it is read on a forge, into what Doxygen reads: formulas ($...$, $$...$$, ```math) and a table of
// contents. What is code stays as it is.
// Usage: node markdown.mjs FILE.md
import { readFileSync } from "node:fs";

const text = readFileSync(process.argv[2], "utf8"), sections = text.match(/^## /gm)?.length ?? 0;
const parts = text.split(/^( *```[\s\S]*?^ *```[^\n]*$)/m);
process.stdout.write(parts.map((part) => {
    const math = part.match(/^ *```math\n([\s\S]*?)\n *```/);
    if (math) return `\\f[\n${math[1]}\n\\f]`;
    if (/^ *```/.test(part)) return part;
    return part
        .replace(/`[^`]*`|\$\$([\s\S]+?)\$\$|\$([^\s$`](?:[^$`]*[^\s$`])?)\$/g,
            (all, block, inline) => (block ? `\\f[${block}\\f]` : inline ? `\\f$${inline}\\f$` : all))
        .replace(/(\]\([\w./]+\.md)#[\w-]+\)/g, "$1)")   // Doxygen knows pages, not the forge's names of their sections
        .replace(/\[([^\]]+)\]\(#[\w-]+\)/g, "$1")
        .replace(/^# .*$/m, (title) => (sections > 3 ? `${title}\n\n[TOC]\n` : title));
}).join(""));
