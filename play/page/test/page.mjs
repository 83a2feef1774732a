// Uses every exhibit of the playground in a browser.
//   node page.mjs FOLDER [ID]...     FOLDER: what `./dev play --static` has written; with IDs only these exhibits
// Pictures go to `pictures` beside FOLDER. Ends with 77 where there is no chromium.

import assert from "node:assert/strict";
import { existsSync, mkdirSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { focusable, layoutFaults } from "./layout.mjs";
import { serve } from "./server.mjs";

const [folder, ...only] = process.argv.slice(2);
const browserFile = "/usr/bin/chromium";
if (!existsSync(browserFile)) {
    console.log(`skipped: there is no ${browserFile}`);
    process.exit(77);
}
const pictures = join(dirname(folder), "pictures");
rmSync(pictures, { recursive: true, force: true });
mkdirSync(pictures, { recursive: true });
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const answersFile = fileURLToPath(new URL("../../../packaging/npm/test/answers.js", import.meta.url));
const site = await serve(folder, "/some/where/", { "/answers.js": answersFile });
const browser = await chromium.launch({
    executablePath: browserFile,
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const sizes = { desk: { width: 1280, height: 800 }, phone: { width: 390, height: 844 } };

/** Opens an exhibit, uses it, and expects that the console stays empty and nothing is loaded from elsewhere. */
async function open(id, { size = "desk", colors = "light" }, use) {
    const context = await browser.newContext({ viewport: sizes[size], colorScheme: colors, hasTouch: size === "phone", isMobile: size === "phone" });
    const page = await context.newPage();
    const complaints = [];
    page.on("console", (message) => {
        // Software rendering stalls when the screen is read, which the browser reports.
        if (["error", "warning"].includes(message.type()) && !/GPU stall due to ReadPixels|software WebGL/i.test(message.text())) complaints.push(message.text());
    });
    page.on("pageerror", (error) => complaints.push(error.stack ?? error.message));
    page.on("request", (request) => {
        if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(site.origin)) complaints.push(`loads ${request.url()}`);
    });
    await page.goto(`${site.url}#${id}`);
    await ready(page);
    try {
        await use(page, context);
        assert.deepEqual(complaints, []);
    } catch (error) {
        error.message = `${id} (${size}, ${colors}): ${error.message}`;
        await page.screenshot({ path: join(pictures, `failed-${id}.png`) });
        throw error;
    } finally {
        await context.close();
    }
}
const ready = (page) => page.waitForFunction(() => document.getElementById("status").hidden, null, { timeout: 60000 });
const settle = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const answers = (page) => page.evaluate(() => JSON.stringify(window.playground.answers()));

// --- what each exhibit has to bear ----------------------------------------------------------------------------------------

async function dragByMouse(page) {
    for (const pane of await page.locator(".pane").all()) {
        const box = await pane.boundingBox();
        const [x, y] = [box.x + 0.3 * box.width, box.y + 0.7 * box.height];
        await page.mouse.move(x, y);
        await page.mouse.down();
        await page.mouse.move(x + 60, y - 40, { steps: 4 });
        await page.mouse.up();
        await page.mouse.wheel(0, -120);
        await settle(page);
    }
    const knob = page.locator(".knob:visible").first();
    if ((await knob.count()) === 0) return;
    const box = await knob.boundingBox();
    await page.mouse.move(box.x + 12, box.y + 12);
    await page.mouse.down();
    await page.mouse.move(box.x + 42, box.y - 10, { steps: 4 });
    await page.mouse.up();
    await settle(page);
}

/** By one finger and by two, over the protocol of the browser. */
async function dragByTouch(page, context) {
    const session = await context.newCDPSession(page);
    const box = await page.locator(".pane").first().boundingBox();
    const at = (dx, dy, id) => ({ x: box.x + box.width / 2 + dx, y: box.y + box.height / 2 + dy, id });
    const touch = (type, touchPoints) => session.send("Input.dispatchTouchEvent", { type, touchPoints });
    await touch("touchStart", [at(0, 0, 0)]);
    for (let i = 1; i <= 4; ++i) await touch("touchMove", [at(8 * i, 6 * i, 0)]);
    await touch("touchStart", [at(32, 24, 0), at(-40, -40, 1)]);
    for (let i = 1; i <= 4; ++i) await touch("touchMove", [at(32 + 4 * i, 24, 0), at(-40 - 4 * i, -40, 1)]);
    await touch("touchEnd", []);
    await settle(page);
}

async function pressKeys(page) {
    for (let i = 0; i < Math.min(await page.locator(".knob").count(), 4); ++i) {
        const knob = page.locator(".knob").nth(i);
        if (!(await knob.isVisible())) continue;
        await knob.focus();
        for (const key of ["ArrowRight", "ArrowUp", "q", "e", "+", "-", "ArrowLeft", "ArrowDown"]) await page.keyboard.press(key);
        await settle(page);
    }
}

/** The keyboard comes to all that can be used. */
async function tabThrough(page) {
    await page.evaluate(() => document.querySelector("header a, header button")?.focus());
    const wanted = new Set(await page.evaluate(focusable));
    const tabs = wanted.size + 20;
    for (let i = 0; i < tabs; ++i) {
        const name = await page.evaluate(() => (document.activeElement && document.activeElement !== document.body ? window.nameOf(document.activeElement) : ""));
        wanted.delete(name);
        await page.keyboard.press("Tab");
    }
    assert.deepEqual([...wanted], [], "Tab does not come to these");
}

/** Sliders to both ends, choices through all values, toggles on and off, buttons pressed. */
async function useControls(page) {
    for (const slider of await page.locator("#panel input[type=range]:visible").all()) {
        const before = await slider.inputValue();
        for (const key of ["End", "Home"]) {
            await slider.press(key);
            await settle(page);
        }
        await slider.fill(before);
    }
    for (let i = 0; i < (await page.locator("#panel input[type=checkbox]:visible").count()); ++i)
        for (let k = 0; k < 2; ++k) {
            // An exhibit may start anew, with other controls.
            const box = page.locator("#panel input[type=checkbox]:visible").nth(i);
            if ((await box.count()) > 0) await box.press("Space");
            await settle(page);
        }
    for (let i = 0; i < (await page.locator("#panel select:visible").count()); ++i) {
        const values = await page.locator("#panel select:visible").nth(i).locator("option").evaluateAll((options) => options.map((option) => option.value));
        for (const value of [...values, values[0]]) {
            const select = page.locator("#panel select:visible").nth(i);
            if ((await select.count()) === 0) break;
            await select.selectOption(value);
            await settle(page);
        }
    }
    for (let i = 0; i < (await page.locator("#panel .actions button:visible").count()); ++i) {
        const button = page.locator("#panel .actions button:visible").nth(i);
        if ((await button.count()) > 0 && (await button.isEnabled()) && !/file|download/i.test((await button.textContent()) ?? "")) await button.press("Enter");
        await settle(page);
    }
}

/** Files that can't be read: each gets a sentence, and the answers stay. */
async function offerBadFiles(page) {
    const input = page.locator("#panel input[type=file]").first();
    if ((await input.count()) === 0) return;
    const before = await answers(page);
    // Says that it has 4,000 bytes.
    const cut = Buffer.alloc(40);
    cut.write("glTF");
    cut.writeUInt32LE(2, 4);
    cut.writeUInt32LE(4000, 8);
    const files = { "picture.png": Buffer.from("89504e470d0a1a0a", "hex"), "empty.glb": Buffer.alloc(0), "cut.glb": cut };
    for (const [name, buffer] of Object.entries(files)) {
        await input.setInputFiles({ name, mimeType: "application/octet-stream", buffer });
        const note = page.locator("#panel .note.failed", { hasText: name });
        await note.waitFor({ timeout: 30000 });
        console.log(`  ${await note.textContent()}`);
    }
    await settle(page);
    assert.equal(await answers(page), before, "a bad file changed the answers");
}

/** The link holds the whole state: opened anew it has the same answers. */
async function openLinkAgain(page) {
    await page.waitForTimeout(500);
    const before = await answers(page);
    await page.reload();
    await ready(page);
    await settle(page);
    assert.equal(await answers(page), before, "the link opened again has other answers");
}

async function findFaults(page) {
    assert.deepEqual(await page.evaluate(layoutFaults), []);
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
    const serious = violations.filter(({ impact }) => ["serious", "critical"].includes(impact));
    assert.deepEqual(serious.map(({ id, nodes }) => `${id}: ${nodes[0]?.html}`), []);
}

// --- the run --------------------------------------------------------------------------------------------------------------

let ids = [];
const started = performance.now();
await open("", {}, async (page) => {
    ids = await page.locator("#exhibits a").evaluateAll((links) => links.map((link) => link.getAttribute("href").slice(1)));
    // The same bits as in node and as in C++.
    const digest = await page.evaluate(async () => {
        const { answersOf } = await import("/answers.js");
        const bytes = await new Blob(answersOf(window.playground.abut)).arrayBuffer();
        return [...new Uint8Array(await crypto.subtle.digest("SHA-256", bytes))].map((byte) => byte.toString(16).padStart(2, "0")).join("");
    });
    const { digest: expected } = await import(answersFile);
    assert.equal(digest, expected, "the answers have other bits than in node");
    console.log(`the answers have the bits of other machines: ${digest.slice(0, 16)}`);
});
for (const id of only.length > 0 ? only : ids) {
    await open(id, {}, async (page) => {
        await findFaults(page);
        await dragByMouse(page);
        await pressKeys(page);
        await openLinkAgain(page);
        await offerBadFiles(page);
        await page.screenshot({ path: join(pictures, `${id}-desk-light.png`) });
        await tabThrough(page);
        await useControls(page);
    });
    await open(id, { colors: "dark" }, async (page) => {
        await findFaults(page);
        await page.screenshot({ path: join(pictures, `${id}-desk-dark.png`) });
    });
    await open(id, { size: "phone" }, async (page, context) => {
        await findFaults(page);
        await dragByTouch(page, context);
        await page.screenshot({ path: join(pictures, `${id}-phone-light.png`) });
    });
    await open(id, { size: "phone", colors: "dark" }, async (page) => {
        await findFaults(page);
        await page.screenshot({ path: join(pictures, `${id}-phone-dark.png`), fullPage: true });
    });
    console.log(`${id}: passed`);
}
console.log(`${ids.length} exhibits, ${Math.round((performance.now() - started) / 1000)} s`);
await browser.close();
site.close();
