// SPDX-License-Identifier: MIT
// Headless Chromium by its own protocol over a pipe: no socket, no package. Whatever a page asks of a network fails
// and is counted.
import { spawn, execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/// The browser's program: $CHROMIUM, else the first of the usual names that answers, or does not in time, as on a machine with
/// other things to do; none: undefined.
export function find_browser() {
    for (const name of process.env.CHROMIUM ? [process.env.CHROMIUM] : names) {
        try {
            execFileSync(name, ["--version"], { stdio: ["ignore", "ignore", "ignore"], timeout: 60000 });
            return name;
        } catch (e) {
            if (e.code === "ETIMEDOUT") return name;
        }
    }
    return undefined;
}

export class browser {
    #child; #profile; #next = 0; #waiting = new Map(); #listeners = new Map(); #rest = Buffer.alloc(0);

    static async start(program) {
        const b = new browser();
        b.#profile = mkdtempSync(join(tmpdir(), "sivid-browser-"));
        b.#child = spawn(program, ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
            "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run",
            "--no-default-browser-check", "--hide-scrollbars", "--force-color-profile=srgb", "--host-resolver-rules=MAP * ~NOTFOUND",
            `--user-data-dir=${b.#profile}`, "--remote-debugging-pipe", "about:blank"],
            { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
        b.#child.on("exit", () => b.#fail("the browser ended"));
        b.#child.stdio[3].on("error", () => b.#fail("the browser does not listen"));
        b.#child.stdio[4].on("data", (data) => b.#read(data));
        await b.send("Browser.getVersion");
        return b;
    }

    #fail(why) {
        for (const call of this.#waiting.values()) call.reject(new Error(why));
        this.#waiting.clear();
    }

    #read(data) {
        this.#rest = Buffer.concat([this.#rest, data]);
        for (let end; (end = this.#rest.indexOf(0)) >= 0; this.#rest = this.#rest.subarray(end + 1)) {
            const message = JSON.parse(this.#rest.subarray(0, end).toString());
            const call = this.#waiting.get(message.id);
            this.#waiting.delete(message.id);
            if (call && message.error) call.reject(new Error(`${call.method}: ${message.error.message}`));
            else if (call) call.resolve(message.result);
            else this.#listeners.get(message.sessionId)?.(message.method, message.params);
        }
    }

    send(method, params = {}, sessionId = undefined, seconds = 120) {
        const id = ++this.#next;
        return new Promise((resolve, reject) => {
            const late = setTimeout(() => reject(new Error(`${method}: no answer in ${seconds} s`)), seconds * 1000);
            const done = (f) => (value) => { clearTimeout(late); f(value); };
            this.#waiting.set(id, { method, resolve: done(resolve), reject: done(reject) });
            this.#child.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
        });
    }

    /// A tab; `listener` hears its events.
    async tab(listener = () => {}) {
        const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
        const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
        this.#listeners.set(sessionId, listener);
        return new tab(this, targetId, sessionId);
    }

    async stop() {
        const ended = new Promise((resolve) => this.#child.once("exit", resolve));
        this.send("Browser.close").catch(() => {});
        await Promise.race([ended, new Promise((resolve) => setTimeout(resolve, 5000))]);
        this.#child.kill("SIGKILL");
        rmSync(this.#profile, { recursive: true, force: true, maxRetries: 5 });
    }
}

class tab {
    constructor(owner, target, session) { Object.assign(this, { owner, target, session }); }
    send(method, params) { return this.owner.send(method, params, this.session); }
    close() { return this.owner.send("Target.closeTarget", { targetId: this.target }); }

    /// The value of an expression in the page; a promise is waited for.
    async value(expression) {
        const { result, exceptionDetails: bad } = await this.send("Runtime.evaluate",
            { expression, awaitPromise: true, returnByValue: true });
        if (bad) throw new Error(`${bad.exception?.description ?? bad.text}`);
        return result.value;
    }
    /// What `f` returns there for these arguments.
    call(f, ...args) { return this.value(`(${f})(${args.map((a) => JSON.stringify(a)).join(",")})`); }

    async open(url) {
        await this.send("Page.navigate", { url });
        // Fonts and layout are settled after two frames.
        await this.call(async () => {
            while (document.readyState !== "complete" || location.href === "about:blank") await new Promise((f) => setTimeout(f, 10));
            await document.fonts.ready;
            await new Promise((f) => requestAnimationFrame(() => requestAnimationFrame(f)));
        });
    }
    size(width, height) {
        return this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
    }
    show(media, scheme) {
        return this.send("Emulation.setEmulatedMedia", { media, features: [{ name: "prefers-color-scheme", value: scheme }] });
    }
    mouse(x, y, type = "mouseMoved", button = "none") {
        return this.send("Input.dispatchMouseEvent", { type, x, y, button, clickCount: type === "mouseMoved" ? 0 : 1 });
    }
    key(key) {
        return this.send("Input.dispatchKeyEvent", { type: "keyDown", key, code: key, windowsVirtualKeyCode: 0 })
            .then(() => this.send("Input.dispatchKeyEvent", { type: "keyUp", key, code: key, windowsVirtualKeyCode: 0 }));
    }
    async picture(whole = true) {
        const { data } = await this.send("Page.captureScreenshot", { captureBeyondViewport: whole });
        return Buffer.from(data, "base64");
    }
}
