// Flies a fixed path over our Earth in CesiumJS, and traces it. record.mjs opens this page and calls window.record().
import { traceCesium } from "./cesium_adapter.js";
import { LodTrace } from "./lod_trace.js";
import { addFrame, newSummary } from "./summary.js";

const { Cesium, realNow } = window;

// The recording. Times are simulated: each frame lasts 1/30 s, whatever the computer takes for it.
const FRAME_MS = 1000 / 30;
const GRID = { width: 2048, height: 1024 }; // heights.bin: Int16 metres, west to east, north to south
const TILE_SAMPLES = 65; // of a tile's side
const MAX_LEVEL = 10; // the finest level for which the provider has heights
const LATENCY_FRAMES = 6; // from the request of a tile's heights to their arrival: 200 ms
const MOST_REQUESTS = 18; // at the same time: RequestScheduler.maximumRequestsPerServer of Cesium

// The camera at times in seconds: degrees, metres above the ellipsoid, heading and pitch in degrees. It falls from orbit to
// the Himalaya, flies along it, looks around, and climbs.
const PATH = [
    { s: 0, longitude: 70, latitude: 10, height: 12e6, heading: 0, pitch: -90 },
    { s: 3, longitude: 80, latitude: 20, height: 2e6, heading: 0, pitch: -90 },
    { s: 5, longitude: 85, latitude: 25.5, height: 200e3, heading: 0, pitch: -50 },
    { s: 7, longitude: 86.5, latitude: 27.3, height: 20e3, heading: 0, pitch: -20 },
    { s: 9, longitude: 87.5, latitude: 27.6, height: 14e3, heading: 60, pitch: -12 },
    { s: 10, longitude: 87.9, latitude: 27.7, height: 14e3, heading: 180, pitch: -12 },
    { s: 12, longitude: 87.9, latitude: 27.0, height: 300e3, heading: 180, pitch: -50 },
];
const FRAMES = Math.round((PATH.at(-1).s * 1000) / FRAME_MS) + 1;

function cameraAt(s) {
    const next = Math.max(1, PATH.findIndex((point) => point.s >= s));
    const [from, to] = [PATH[next - 1], PATH[next]];
    const share = Math.min(1, Math.max(0, (s - from.s) / (to.s - from.s)));
    const eased = share * share * (3 - 2 * share);
    const at = (field) => from[field] + (to[field] - from[field]) * eased;
    // Each second divides the height by the same factor.
    const height = from.height * (to.height / from.height) ** eased;
    return { longitude: at("longitude"), latitude: at("latitude"), height, heading: at("heading"), pitch: at("pitch") };
}

// Returns the heights of a tile, bilinear in the grid. Samples of the grid are in the middle of their pixels.
function heightsOf(grid, rectangle) {
    const heights = new Float32Array(TILE_SAMPLES * TILE_SAMPLES);
    const at = (x, y) => {
        const column = ((x % GRID.width) + GRID.width) % GRID.width;
        return grid[Math.min(Math.max(y, 0), GRID.height - 1) * GRID.width + column];
    };
    for (let row = 0; row < TILE_SAMPLES; ++row) {
        const latitude = rectangle.north + ((rectangle.south - rectangle.north) * row) / (TILE_SAMPLES - 1);
        const y = (0.5 - latitude / Math.PI) * GRID.height - 0.5;
        for (let column = 0; column < TILE_SAMPLES; ++column) {
            const longitude = rectangle.west + ((rectangle.east - rectangle.west) * column) / (TILE_SAMPLES - 1);
            const x = (longitude / (2 * Math.PI) + 0.5) * GRID.width - 0.5;
            const [x0, y0] = [Math.floor(x), Math.floor(y)];
            const [dx, dy] = [x - x0, y - y0];
            const north = at(x0, y0) * (1 - dx) + at(x0 + 1, y0) * dx;
            const south = at(x0, y0 + 1) * (1 - dx) + at(x0 + 1, y0 + 1) * dx;
            heights[row * TILE_SAMPLES + column] = north * (1 - dy) + south * dy;
        }
    }
    return heights;
}

// Delivers heights a fixed number of frames after they were asked for.
class Server {
    #grid;
    #scheme = new Cesium.GeographicTilingScheme();
    #waiting = [];
    frame = 0;
    requests = 0;

    constructor(grid) {
        this.#grid = grid;
    }
    provider() {
        const provider = new Cesium.CustomHeightmapTerrainProvider({
            tilingScheme: this.#scheme,
            width: TILE_SAMPLES,
            height: TILE_SAMPLES,
            callback: (x, y, level) => this.#request(x, y, level),
        });
        provider.getTileDataAvailable = (x, y, level) => level <= MAX_LEVEL;
        return provider;
    }
    // Returns nothing if Cesium shall ask again in a later frame.
    #request(x, y, level) {
        if (this.#waiting.length >= MOST_REQUESTS) return undefined;
        ++this.requests;
        return new Promise((resolve) => {
            const rectangle = this.#scheme.tileXYToRectangle(x, y, level);
            const deliver = () => resolve(heightsOf(this.#grid, rectangle));
            this.#waiting.push({ due: this.frame + LATENCY_FRAMES, deliver });
        });
    }
    deliver() {
        const isDue = ({ due }) => due <= this.frame;
        const due = this.#waiting.filter(isDue);
        this.#waiting = this.#waiting.filter((request) => !isDue(request));
        for (const { deliver } of due) deliver();
    }
}

// Returns once no worker builds a mesh, so that the speed of the computer does not matter.
async function workersAreIdle(quadtree) {
    const TRANSFORMING = 4;
    const RECEIVING = 2;
    const isBusy = (tile) => {
        const surface = tile?.data;
        if (!surface) return false;
        const isUpsampled = surface.terrainState === RECEIVING && surface.request === undefined;
        const children = [tile._northwestChild, tile._northeastChild, tile._southwestChild, tile._southeastChild];
        return surface.terrainState === TRANSFORMING || isUpsampled || children.some(isBusy);
    };
    const end = realNow() + 20000;
    do {
        await new Promise((resolve) => setTimeout(resolve, 0));
        if (realNow() > end) throw new Error("a worker of Cesium takes more than 20 s");
    } while ((quadtree._levelZeroTiles ?? []).some(isBusy));
}

function newWidget(provider) {
    const widget = new Cesium.CesiumWidget("globe", {
        baseLayer: false,
        creditContainer: document.createElement("div"),
        skyBox: false,
        skyAtmosphere: false,
        terrainProvider: provider,
        useDefaultRenderLoop: false,
        shouldAnimate: false,
    });
    // Nothing is drawn: without a graphics card, a frame would take a second, and nothing in a trace depends on it.
    widget.scene.debugCommandFilter = () => false;
    widget.scene.screenSpaceCameraController.enableInputs = false;
    widget.resize(); // its own loop, which is off, would do it
    return widget;
}

function setCamera(camera, s) {
    const { longitude, latitude, height, heading, pitch } = cameraAt(s);
    camera.setView({
        destination: Cesium.Cartesian3.fromDegrees(longitude, latitude, height),
        orientation: { heading: Cesium.Math.toRadians(heading), pitch: Cesium.Math.toRadians(pitch), roll: 0 },
    });
}

function base64(bytes) {
    let text = "";
    for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
    return btoa(text);
}

// Flies, and returns the trace in base64 and what was counted beside it.
window.record = async () => {
    const answer = await fetch("/heights.bin");
    const grid = new Int16Array(await answer.arrayBuffer());
    if (grid.length !== GRID.width * GRID.height)
        throw new Error(`heights.bin: ${grid.length} heights; expected ${GRID.width} x ${GRID.height}`);
    const server = new Server(grid);
    const widget = newWidget(server.provider());
    const { scene } = widget;
    const epoch = Cesium.JulianDate.fromIso8601("2026-06-21T06:00:00Z");
    const trace = new LodTrace({ now: () => Math.round(window.simulatedMs * 1e6) });
    const summary = newSummary({ cesium: Cesium.VERSION, maxLevel: MAX_LEVEL, gridWidth: GRID.width });
    const tracing = traceCesium(Cesium, scene, trace, {
        name: `CesiumJS ${Cesium.VERSION}, ETOPO5`,
        timeS: () => window.simulatedMs / 1000,
        cpuMs: null, // they would be those of a frame that is not drawn
        maxLevel: MAX_LEVEL,
        onFrame: (frame) => addFrame(Cesium, summary, frame),
    });
    const began = realNow();
    for (let frame = 0; frame < FRAMES; ++frame) {
        window.simulatedMs = frame * FRAME_MS;
        server.frame = frame;
        server.deliver();
        await workersAreIdle(scene.globe._surface);
        setCamera(scene.camera, window.simulatedMs / 1000);
        scene.render(Cesium.JulianDate.addSeconds(epoch, window.simulatedMs / 1000, new Cesium.JulianDate()));
        const tiles = scene.globe._surface._tilesToRender.length;
        if (frame % 30 === 0) console.log(`frame ${frame} of ${FRAMES}: ${tiles} tiles`);
    }
    tracing.stop();
    trace.close();
    summary.heightRequests = server.requests;
    return { trace: base64(trace.bytes()), summary, stats: trace.stats(), seconds: (realNow() - began) / 1000 };
};
window.isReady = true;
