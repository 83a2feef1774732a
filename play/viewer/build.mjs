// Makes the template of the report page: one file with all styles and scripts in it.
// node build.mjs OUT.html

import { readFile, writeFile } from "node:fs/promises";
import { build } from "esbuild";

const out = process.argv[2] ?? "report_template.html";
const here = (name) => new URL(name, import.meta.url);
const result = await build({
    entryPoints: [here("src/page.ts").pathname],
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    charset: "ascii",
    legalComments: "inline",
    write: false,
});
const styles = await Promise.all(["src/parts.css", "src/page.css"].map((name) => readFile(here(name), "utf8")));
const parts = { STYLE: styles.join(""), SCRIPT: result.outputFiles[0].text };
const page = await readFile(here("src/page.html"), "utf8");
await writeFile(out, page.replace(/@(STYLE|SCRIPT)@/g, (_, part) => parts[part]));
