// Records the flight of page.js in a headless Chromium: node record.mjs CHROMIUM HEIGHTS OUT_FOLDER
// Writes cesium.lodtrace and cesium.json into the folder. record.sh prepares what it needs.
import { createServer } from "node:http";
import { readFile, writeFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

const LAUNCH_MS = 60_000;
const RECORD_MS = 480_000;

const [chromium, heights, out] = process.argv.slice(2);
if (!out) {
    console.error("usage: node record.mjs CHROMIUM HEIGHTS OUT_FOLDER");
    process.exit(2);
}
const here = fileURLToPath(new URL(".", import.meta.url));
const modules = process.env.NODE_MODULES ?? join(here, "node_modules");
const { default: puppeteer } = await import(join(modules, "puppeteer-core/lib/esm/puppeteer/puppeteer-core.js"));

const types = { ".html": "text/html", ".js": "text/javascript", ".json": "application/json", ".wasm": "application/wasm" };

// Serves the page, Cesium and the heights, and nothing else.
async function serve(request, response) {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname));
    const isCesium = path.startsWith("/cesium/");
    const file = path === "/heights.bin" ? heights
        : isCesium ? join(modules, "cesium/Build/Cesium", path.slice("/cesium/".length))
        : join(here, path);
    try {
        const content = await readFile(file);
        response.writeHead(200, { "content-type": types[extname(file)] ?? "application/octet-stream" });
        response.end(content);
    } catch {
        response.writeHead(404);
        response.end();
    }
}

function within(promise, ms, what) {
    let timer;
    const late = new Promise((_, reject) => {
        timer = setTimeout(() => reject(new Error(`${what} takes more than ${ms / 1000} s`)), ms);
    });
    return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

// Returns the result of window.record().
async function record(browser, origin) {
    const page = await browser.newPage();
    const outside = [];
    page.on("console", (message) => console.log(`  ${message.text()}`));
    const failed = new Promise((_, reject) => page.on("pageerror", (error) => reject(error)));
    await page.setRequestInterception(true);
    page.on("request", (request) => {
        const isLocal = request.url().startsWith(origin) || /^(data|blob):/.test(request.url());
        if (isLocal) return request.continue();
        outside.push(request.url());
        return request.abort();
    });
    await page.goto(`${origin}/page.html`, { timeout: LAUNCH_MS });
    await page.waitForFunction("window.isReady", { timeout: LAUNCH_MS });
    const result = await Promise.race([page.evaluate("window.record()"), failed]);
    if (outside.length > 0) throw new Error(`the page asked the network for ${outside[0]}; expected local files only`);
    return result;
}

const server = createServer(serve);
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
let browser;
try {
    browser = await puppeteer.launch({
        executablePath: chromium,
        timeout: LAUNCH_MS,
        protocolTimeout: RECORD_MS,
        defaultViewport: { width: 1280, height: 720, deviceScaleFactor: 1 },
        args: [
            "--no-sandbox", // a container has no user namespaces
            "--use-gl=angle",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
            "--ignore-gpu-blocklist",
            "--disable-background-networking",
            "--disable-component-update",
            "--no-first-run",
        ],
    });
    const version = await browser.version();
    const origin = `http://127.0.0.1:${server.address().port}`;
    const result = await within(record(browser, origin), RECORD_MS, "the recording");
    const trace = Buffer.from(result.trace, "base64");
    result.summary.browser = version;
    await writeFile(join(out, "cesium.lodtrace"), trace);
    await writeFile(join(out, "cesium.json"), `${JSON.stringify(result.summary)}\n`);
    const { frames, drawn, deepestDrawn, distinctDrawn } = result.summary;
    console.log(
        `${frames} frames in ${result.seconds.toFixed(1)} s: ${drawn} drawn tiles, ${distinctDrawn} different ones, ` +
            `to level ${deepestDrawn}; ${result.stats.nodes} nodes, ${trace.length} bytes ` +
            `(${version}, CesiumJS ${result.summary.cesium})`,
    );
} catch (error) {
    console.error(`record.mjs: ${error.message}`);
    process.exitCode = 1;
} finally {
    await browser?.close();
    server.close();
}
