// Opens pages of `abut check --report` in a browser.
//   node report.mjs ABUT BUILT SCENES OUT     ABUT: the tool; BUILT, SCENES: the folders of the bundled scenes; OUT: for pictures
// Ends with 77 where there is no chromium.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [abut, built, scenes, out] = process.argv.slice(2);
const browserFile = "/usr/bin/chromium";
if (!existsSync(browserFile)) {
    console.log(`skipped: there is no ${browserFile}`);
    process.exit(77);
}
mkdirSync(out, { recursive: true });

// --- scenes --------------------------------------------------------------------------------------------------------------

/** Unit boxes at places, as glTF. */
function boxes(named) {
    const corners = [];
    for (let i = 0; i < 8; ++i) corners.push((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, (i >> 2) - 0.5);
    const faces = [0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5];
    const data = Buffer.concat([Buffer.from(new Float32Array(corners).buffer), Buffer.from(new Uint16Array(faces).buffer)]);
    return JSON.stringify({
        asset: { version: "2.0" },
        scene: 0,
        scenes: [{ nodes: named.map((_, i) => i) }],
        nodes: named.map(([name, translation]) => ({ name, translation, mesh: 0 })),
        meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
        accessors: [
            { bufferView: 0, componentType: 5126, count: 8, type: "VEC3", min: [-0.5, -0.5, -0.5], max: [0.5, 0.5, 0.5] },
            { bufferView: 1, componentType: 5123, count: 36, type: "SCALAR" },
        ],
        bufferViews: [
            { buffer: 0, byteLength: 96 },
            { buffer: 0, byteOffset: 96, byteLength: 72 },
        ],
        buffers: [{ byteLength: data.length, uri: `data:application/octet-stream;base64,${data.toString("base64")}` }],
    });
}

/** 2,000 boxes of which 50 pairs overlap. */
function manyBoxes() {
    const named = [];
    for (let i = 0; i < 2000; ++i) named.push([`Box ${i}`, [2 * (i % 50), 0, 2 * Math.floor(i / 50)]]);
    for (let i = 0; i < 50; ++i) named[40 * i + 1][1][0] -= 1.25;
    return named;
}

/** Checks a scene and returns the address of its page. */
function pageOf(name, scene, options = []) {
    const page = join(out, `${name}.html`);
    try {
        execFileSync(abut, ["check", scene, "--report", page, ...options], { stdio: ["ignore", "ignore", "inherit"] });
    } catch (error) {
        assert.equal(error.status, 1, `${scene}: ${error.message}`);
    }
    return pathToFileURL(page).href;
}

// --- the browser ---------------------------------------------------------------------------------------------------------

const browser = await chromium.launch({
    executablePath: browserFile,
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const sizes = { desk: { width: 1280, height: 800 }, phone: { width: 390, height: 844 } };

/** Opens a page, uses it, and expects that the console stays empty and nothing is loaded from elsewhere. */
async function open(url, { size = "desk", colors = "light" } = {}, use) {
    const context = await browser.newContext({ viewport: sizes[size], colorScheme: colors });
    const page = await context.newPage();
    const complaints = [];
    page.on("console", (message) => {
        // Software rendering stalls when the screen is read, which the browser reports.
        const text = message.text();
        if (["error", "warning"].includes(message.type()) && !text.includes("ReadPixels")) complaints.push(text);
    });
    page.on("pageerror", (error) => complaints.push(String(error)));
    page.on("request", (request) => {
        if (!/^(file|data|blob):/.test(request.url())) complaints.push(`loads ${request.url()}`);
    });
    page.on("dialog", (dialog) => {
        complaints.push(`dialog ${dialog.message()}`);
        void dialog.dismiss();
    });
    await page.goto(url);
    await use(page);
    assert.deepEqual(complaints, [], url);
    await context.close();
}

const rows = (page) => page.getByRole("option");
const selected = (page) => page.locator('[role=option][aria-selected="true"]');

/** True if the picture of the view has more than a few colours. */
async function hasPicture(page) {
    const png = await page.locator(".canvas canvas").screenshot();
    return page.evaluate(async (bytes) => {
        const bitmap = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
        context.drawImage(bitmap, 0, 0);
        const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
        const colors = new Set();
        for (let i = 0; i < data.length; i += 4 * 97) colors.add(data.slice(i, i + 4).join());
        return colors.size > 3;
    }, [...png]);
}

async function testUse(url, isAnimated) {
    await open(url, {}, async (page) => {
        assert.match(await page.locator("#verdict").innerText(), /FAULTS|WARNINGS/);
        assert.ok((await page.locator("#kinds tbody tr").count()) > 0, "a table of kinds");
        const all = await rows(page).count();
        assert.ok(all > 1, "rows");
        assert.ok(await hasPicture(page), "the view shows something");

        // By mouse: the second row, its link and its text.
        await rows(page).nth(1).click();
        const id = (await selected(page).getAttribute("id")).replace("row-", "");
        assert.ok(page.url().endsWith(`#${id}`), "the address has the finding");
        assert.equal(await page.locator(".detail h2 a").getAttribute("href"), `#${id}`);
        assert.equal(await page.getByRole("slider").count(), isAnimated ? 1 : 0, "a timeline");

        // By keys: up and down, then the view.
        await page.locator("#findings").focus();
        await page.keyboard.press("ArrowUp");
        assert.equal(await selected(page).getAttribute("id"), await rows(page).first().getAttribute("id"));
        await page.keyboard.press("End");
        assert.equal(await selected(page).getAttribute("id"), await rows(page).last().getAttribute("id"));
        await page.locator(".canvas canvas").focus();
        for (const key of ["ArrowLeft", "ArrowUp", "+", "-"]) await page.keyboard.press(key);
        assert.ok(await hasPicture(page), "the view still shows something");

        // Search: a word of the first title, then one that nothing has.
        const title = await rows(page).first().locator("strong").innerText();
        await page.keyboard.press("/");
        await page.keyboard.type(title.split(/\s/)[0]);
        const found = await rows(page).count();
        assert.ok(found >= 1 && found <= all, "found by its title");
        await page.getByRole("searchbox").fill("no finding has this");
        assert.equal(await rows(page).count(), 0);
        await page.getByRole("searchbox").fill("");
        assert.equal(await rows(page).count(), all);

        // Filters: each kind leaves out its own.
        let left = 0;
        for (const chip of await page.getByRole("group", { name: "Kinds" }).getByRole("button").all()) {
            await chip.click();
            assert.equal(await chip.getAttribute("aria-pressed"), "false");
            left += all - (await rows(page).count());
            await chip.click();
        }
        assert.equal(left, all, "each finding has one kind");
    });
    // The link of the last finding opens it.
    let last = "";
    await open(url, {}, async (page) => {
        last = (await rows(page).last().getAttribute("id")).replace("row-", "");
    });
    await open(`${url}#${last}`, {}, async (page) => {
        assert.equal(await selected(page).getAttribute("id"), `row-${last}`);
    });
}

async function takePictures(name, url) {
    for (const size of Object.keys(sizes))
        for (const colors of ["light", "dark"])
            await open(url, { size, colors }, async (page) => {
                assert.ok(await hasPicture(page), `${name} in ${colors}`);
                await page.getByRole("button", { name: "Zoom out" }).click();
                await page.waitForTimeout(300);
                const width = await page.evaluate(() => document.documentElement.scrollWidth);
                assert.ok(width <= sizes[size].width, `${name} is not wider than a ${size}`);
                await page.screenshot({ path: join(out, `${name}-${size}-${colors}.png`) });
            });
}

// --- the tests -----------------------------------------------------------------------------------------------------------

try {
    const level = pageOf("level", join(built, "level.gltf"));
    const plateau = pageOf("plateau", join(scenes, "plateau.tmj"), ["--character", "6,24", "--up", "-y"]);
    await testUse(level, true);
    await testUse(plateau, false);
    await takePictures("level", level);
    await takePictures("plateau", plateau);

    // The animation runs and stops.
    await open(level, {}, async (page) => {
        const slider = page.getByRole("slider");
        await slider.fill("0.5");
        const before = Number(await slider.inputValue());
        await page.getByRole("button", { name: "Play" }).click();
        await page.waitForFunction((time) => Number(document.querySelector("input[type=range]").value) > time, before);
        await page.getByRole("button", { name: "Stop" }).click();
    });

    // 50 findings of 2,000 objects.
    const large = join(out, "large.gltf");
    writeFileSync(large, boxes(manyBoxes()));
    const url = pageOf("large", large);
    const size = statSync(join(out, "large.html")).size;
    assert.ok(size < 5e6, `${size} bytes`);
    await open(url, {}, async (page) => {
        assert.equal(await rows(page).count(), 50);
        const ms = await page.evaluate(() => performance.getEntriesByType("navigation")[0].domComplete);
        console.log(`50 findings of 2,000 objects: ${size} bytes, ${Math.round(ms)} ms until the page is complete`);
        await page.keyboard.press("j");
        assert.ok(await hasPicture(page));
    });

    // Names are text.
    const evil = ["<script>alert(1)</script>", '</script><img src=x onerror="alert(2)">', "@TITLE@ &lt; $& \u2028 <!--"];
    const names = join(out, "<b>names.gltf");
    writeFileSync(names, boxes(evil.map((name, i) => [name, [0.5 * i, 0, 0]])));
    await open(pageOf("names", names), {}, async (page) => {
        const text = await page.locator("#findings").innerText();
        assert.equal(await page.locator("img").count(), 0);
        assert.equal(await page.locator("b").count(), 0);
        assert.match(await page.title(), /<b>names\.gltf/);
        assert.ok(text.includes("alert(1)") && text.includes("onerror"), text);
    });

    // Nothing found.
    const clean = join(out, "clean.gltf");
    writeFileSync(clean, boxes([["A", [0, 0, 0]], ["B", [5, 0, 0]]]));
    await open(pageOf("clean", clean), {}, async (page) => {
        assert.match(await page.locator("#verdict").innerText(), /^CLEAN/);
        assert.ok(await hasPicture(page));
    });
    console.log(`passed; pictures are in ${out}`);
} finally {
    await browser.close();
}
