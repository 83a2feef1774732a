// Frames a second while a shape is dragged in the exhibits that one drags in, where the processor makes the pictures.
//   node frames.mjs FOLDER [ID]...     FOLDER: what `./dev play --static` has written; with IDs only these exhibits
// With PROFILE=FILE it writes a profile of the page's scripts of the last exhibit, for the developer tools of a browser.

import { writeFileSync } from "node:fs";
import { chromium } from "playwright-core";
import { serve } from "./server.mjs";

const [folder, ...only] = process.argv.slice(2);
const site = await serve(folder, "/");
const browser = await chromium.launch({
    executablePath: "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const seconds = 4;
for (const id of only.length > 0 ? only : ["two-shapes", "steps", "sweep", "closest-features"])
    for (const space of [false, true]) {
        const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
        await page.goto(`${site.url}#${id}?${encodeURIComponent(JSON.stringify({ space }))}`);
        await page.waitForFunction(() => document.getElementById("status").hidden, null, { timeout: 60000 });
        const box = await page.locator(".knob:visible").first().boundingBox();
        const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
        const session = await page.context().newCDPSession(page);
        if (process.env.PROFILE) {
            await session.send("Profiler.enable");
            await session.send("Profiler.start");
        }
        await page.mouse.move(x, y);
        await page.mouse.down();
        await page.evaluate(() => {
            window.frames_seen = 0;
            const count = () => {
                ++window.frames_seen;
                requestAnimationFrame(count);
            };
            requestAnimationFrame(count);
        });
        const start = performance.now();
        for (let i = 0; performance.now() - start < 1000 * seconds; ++i) await page.mouse.move(x + 60 * Math.sin(0.05 * i), y + 40 * Math.cos(0.05 * i));
        const frames = await page.evaluate(() => window.frames_seen);
        const took = (performance.now() - start) / 1000;
        await page.mouse.up();
        if (process.env.PROFILE) writeFileSync(process.env.PROFILE, JSON.stringify((await session.send("Profiler.stop")).profile));
        console.log(`${id}, ${space ? "space" : "plane"}: ${(frames / took).toFixed(1)} frames a second`);
        await page.close();
    }
await browser.close();
site.close();
