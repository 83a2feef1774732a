// A plain web server of a folder, under a path, as a page host would have it.

import { createReadStream, existsSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".json": "application/json" };

/** Serves `folder` at `path`, and other files by `extra`: an object from address to file. Returns the address and a function that ends it. */
export async function serve(folder, path, extra = {}) {
    const server = createServer((request, response) => {
        const address = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
        const inside = address.startsWith(path) ? normalize(address.slice(path.length)) : "";
        const file = extra[address] ?? join(folder, inside === "." || inside === "" ? "index.html" : inside);
        if (!existsSync(file) || !statSync(file).isFile()) {
            response.writeHead(404).end();
            return;
        }
        response.writeHead(200, { "content-type": types[extname(file)] ?? "application/octet-stream", "content-length": statSync(file).size });
        createReadStream(file).pipe(response);
    });
    await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
    const origin = `http://127.0.0.1:${server.address().port}`;
    return { origin, url: origin + path, close: () => server.close() };
}
