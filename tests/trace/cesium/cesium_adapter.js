// Traces the terrain of a CesiumJS scene: which tiles its globe draws in each frame, which it culls, what their errors are,
// and how their data is loaded. Nothing of Cesium is changed: the adapter listens to two public events, and wraps one method
// of the globe's tile provider to look at the tiles just after they are selected.
//
//   import { LodTrace } from "./lod_trace.js";
//   import { traceCesium } from "./cesium_adapter.js";
//   const trace = new LodTrace();
//   const tracing = traceCesium(Cesium, viewer.scene, trace);
//   ...
//   tracing.stop();
//   trace.close();
//   download(trace.bytes());
//
// Cesium offers no public way to its tiles, so this reads private fields, those that begin with an underscore, and private
// classes. It was written for CesiumJS 1.140; another version is refused only if a field is missing. README.md beside this
// file explains each number.
//
// MIT License; the text is in lod_trace.js.
import { Bounds, Culled, ErrorUnit, Ids, MAX_LEVEL, quadtreeId, Requests, Shape, TAU } from "./lod_trace.js";

export const WRITTEN_FOR = "1.140";

// The kinds of data that are paged. A tile without heights of its own gets a mesh that is upsampled from its parent's: it has
// no data that tools should count as there, so that mesh is a kind of its own.
export const Kind = Object.freeze({ MESH: 0, HEIGHTS: 1, UPSAMPLED: 2 });
export const KIND_NAMES = ["mesh", "heights", "upsampled mesh"];

// Values of Cesium's private enumerations.
const TerrainState = { FAILED: 0, UNLOADED: 1, RECEIVING: 2, RECEIVED: 3 };
const Selection = { CULLED: 1, RENDERED: 2, REFINED: 3, KICKED: 4 };
const LOAD_STATE_FAILED = 3;
const OUTSIDE = -1; // of Intersect

const MOST_FACES = 6; // of the ids of a quadtree

// How far the load queues are apart in the priority of a request: more than 2 distances to the far side of the planet.
const QUEUE_STEP = 1e8;

function requireFields(Cesium, object, path, fields) {
    for (const field of fields) {
        if (object !== undefined && object !== null && field in object) continue;
        throw new Error(
            `${path}.${field} is missing in CesiumJS ${Cesium?.VERSION}; expected the fields of CesiumJS ${WRITTEN_FOR}`,
        );
    }
}

// Returns the children that exist, without creating any as the public getters do.
function existingChildren(tile) {
    return [tile._northwestChild, tile._northeastChild, tile._southwestChild, tile._southeastChild].filter(
        (child) => child !== undefined,
    );
}

// Cesium's tiling scheme has several roots beside each other; each is a face of the quadtree.
function idOf(tile) {
    const scheme = tile.tilingScheme;
    const rootX = tile.x >>> tile.level;
    const rootY = tile.y >>> tile.level;
    const face = rootY * scheme.getNumberOfXTilesAtLevel(0) + rootX;
    return quadtreeId(face, tile.level, tile.x - rootX * 2 ** tile.level, tile.y - rootY * 2 ** tile.level);
}

// The error on screen that QuadtreePrimitive compares with its tolerance, pixels. Cesium does not store it, so this repeats
// its private function screenSpaceError() for a perspective camera.
export function screenSpaceError(Cesium, quadtree, frameState, tile) {
    const geometricError = quadtree.tileProvider.getLevelMaximumGeometricError(tile.level);
    const { fog, camera, context, pixelRatio } = frameState;
    let error = (geometricError * context.drawingBufferHeight) / (tile._distance * camera.frustum.sseDenominator);
    if (fog.enabled) error -= Cesium.Math.fog(tile._distance, fog.density) * fog.sse;
    return error / pixelRatio;
}

// Returns the oriented box of a tile as the trace has it; nothing if Cesium knows no heights for it yet.
function boxOf(Cesium, tile) {
    const surface = tile.data;
    const box = surface?.tileBoundingRegion?.boundingVolume;
    if (!box || surface.boundingVolumeSourceTile === undefined) return { bounds: Bounds.NONE };
    const half = box.halfAxes; // columns are the axes, times half their size
    const columns = [0, 1, 2].map((i) => new Cesium.Cartesian3(half[3 * i], half[3 * i + 1], half[3 * i + 2]));
    const sizes = columns.map((column) => Cesium.Cartesian3.magnitude(column));
    // A flat box has an axis of length 0.
    const axes = columns.map((column, i) => {
        if (sizes[i] > 0) return Cesium.Cartesian3.divideByScalar(column, sizes[i], column);
        const normal = Cesium.Cartesian3.cross(columns[(i + 1) % 3], columns[(i + 2) % 3], new Cesium.Cartesian3());
        return Cesium.Cartesian3.magnitude(normal) > 0 ? Cesium.Cartesian3.normalize(normal, normal) : null;
    });
    if (axes.includes(null)) return { bounds: Bounds.NONE };
    return {
        bounds: Bounds.BOX,
        centre: [box.center.x, box.center.y, box.center.z],
        axes: axes.flatMap((axis) => [axis.x, axis.y, axis.z]),
        halfSize: sizes,
    };
}

// Why a drawn tile is coarser than the tolerance, by the state that the selection left behind.
export const Coarse = Object.freeze({
    WAITS: "waits for descendants", // they were selected, but not all can be drawn, so this tile replaced them
    UPSAMPLED: "has no finer data", // its four children are made from its own heights
    UNKNOWN_CHILDREN: "cannot be refined yet", // whether children exist is not known before it is loaded
});
function reasonOfCoarse(tile, frameNumber) {
    const children = existingChildren(tile);
    const isKicked = (child) =>
        child._lastSelectionResultFrame === frameNumber && (child._lastSelectionResult & Selection.KICKED) !== 0;
    if (children.some(isKicked)) return Coarse.WAITS;
    if (children.length === 4 && children.every((child) => child.upsampledFromParent)) return Coarse.UPSAMPLED;
    return Coarse.UNKNOWN_CHILDREN;
}

// Starts to trace a scene, and returns an object with stop(). Throws an Error if Cesium lacks a field that is read.
//   Cesium   the module or global
//   scene    in 3D mode, with a perspective camera; frames of other modes and cameras are left out
//   trace    a LodTrace without a frame
// Options:
//   name     of the scene in the trace
//   timeS    returns the engine's clock, seconds; default: since the start, by the computer's clock
//   cpuMs    returns milliseconds, for how long a frame takes; default: performance.now(). null: times are not told
//   maxLevel the finest level for which the terrain provider has data; unlimited if undefined
//   onFrame  receives what is told of each frame, for tests: { number, frameState, drawn, culled, refined, paged }
export function traceCesium(Cesium, scene, trace, options = {}) {
    requireFields(Cesium, scene, "scene", ["globe", "preRender", "postRender", "mode", "camera"]);
    requireFields(Cesium, scene.globe, "scene.globe", ["_surface", "maximumScreenSpaceError"]);
    const quadtree = scene.globe._surface;
    requireFields(Cesium, quadtree, "scene.globe._surface", [
        "_tilesToRender",
        "_tileLoadQueueHigh",
        "_tileLoadQueueMedium",
        "_tileLoadQueueLow",
        "_levelZeroTiles",
        "_debug",
        "tileProvider",
        "maximumScreenSpaceError",
        "tileCacheSize",
        "loadingDescendantLimit",
        "preloadAncestors",
        "preloadSiblings",
    ]);
    requireFields(Cesium, quadtree._debug, "scene.globe._surface._debug", [
        "tilesVisited",
        "tilesCulled",
        "tilesWaitingForChildren",
    ]);
    const provider = quadtree.tileProvider;
    requireFields(Cesium, provider, "scene.globe._surface.tileProvider", [
        "endUpdate",
        "getLevelMaximumGeometricError",
        "tilingScheme",
    ]);
    return new Tracing(Cesium, scene, trace, options).start();
}

class Tracing {
    #Cesium;
    #scene;
    #trace;
    #options;
    #quadtree;
    #tiles = new Map(); // by id: what was told of a tile
    #settings = new Map();
    #selected = null; // of the frame in progress
    #isDescribed = false;
    #areTilesChecked = false;
    #startMs = 0;
    #frameStartMs = 0;
    #loaded = []; // tiles whose node has changed since it was told
    #undo = [];

    constructor(Cesium, scene, trace, options) {
        this.#Cesium = Cesium;
        this.#scene = scene;
        this.#trace = trace;
        this.#options = options;
        this.#quadtree = scene.globe._surface;
        this.#startMs = performance.now();
    }

    start() {
        this.#undo.push(
            this.#scene.preRender.addEventListener(() => (this.#frameStartMs = this.#cpuMs())),
            this.#scene.postRender.addEventListener(() => this.#endFrame()),
        );
        // Called when the tiles of a frame are selected, and before tiles that are not loaded get their fill.
        const provider = this.#quadtree.tileProvider;
        const isOwn = Object.hasOwn(provider, "endUpdate");
        const { endUpdate } = provider;
        provider.endUpdate = (frameState) => {
            if (frameState.passes.render) this.#beginFrame(frameState);
            endUpdate.call(provider, frameState);
        };
        this.#undo.push(() => {
            if (isOwn) provider.endUpdate = endUpdate;
            else delete provider.endUpdate;
        });
        return this;
    }

    stop() {
        for (const undo of this.#undo.splice(0)) undo();
    }

    #cpuMs() {
        const { cpuMs = () => performance.now() } = this.#options;
        return cpuMs === null ? NaN : cpuMs();
    }

    // ---- what is told once, or when it changes ----

    #describe(frameState) {
        requireFields(this.#Cesium, frameState, "frameState", [
            "camera",
            "context",
            "cullingVolume",
            "fog",
            "frameNumber",
            "pixelRatio",
            "verticalExaggeration",
        ]);
        requireFields(this.#Cesium, frameState.camera.frustum, "frameState.camera.frustum", ["sseDenominator"]);
        const scheme = this.#quadtree.tileProvider.tilingScheme;
        const roots = scheme.getNumberOfXTilesAtLevel(0) * scheme.getNumberOfYTilesAtLevel(0);
        if (roots > MOST_FACES)
            throw new Error(`tiling scheme: ${roots} roots are too many; expected at most ${MOST_FACES}`);
        const ellipsoid = this.#scene.globe.ellipsoid;
        const { x, y, z } = ellipsoid.radii;
        this.#trace.describe({
            name: this.#options.name ?? `CesiumJS ${this.#Cesium.VERSION}`,
            shape: Shape.SPHERE,
            // The mean radius, 6371008.8 m for WGS 84. The ellipsoid is up to 7.1 km above this sphere and 14.3 km below.
            radius: (x + y + z) / 3,
            metresPerUnit: 1,
            ids: Ids.QUADTREE,
            error: ErrorUnit.WORLD,
            requests: Requests.NODE,
            kinds: KIND_NAMES,
        });
        this.#isDescribed = true;
    }

    #set(name, value) {
        if (value === undefined || this.#settings.get(name) === value) return;
        this.#settings.set(name, value);
        this.#trace.setting(name, value);
    }

    #tellSettings(frameState) {
        const { fog, globe } = this.#scene;
        const quadtree = this.#quadtree;
        this.#set(TAU, quadtree.maximumScreenSpaceError);
        this.#set(MAX_LEVEL, this.#options.maxLevel);
        this.#set("cesium_version", this.#Cesium.VERSION);
        this.#set("pixel_ratio", frameState.pixelRatio);
        this.#set("tile_cache_size", quadtree.tileCacheSize);
        this.#set("loading_descendant_limit", quadtree.loadingDescendantLimit);
        this.#set("preload_ancestors", Number(quadtree.preloadAncestors));
        this.#set("preload_siblings", Number(quadtree.preloadSiblings));
        this.#set("skirts", Number(globe.showSkirts));
        this.#set("vertical_exaggeration", frameState.verticalExaggeration);
        this.#set("fog", Number(fog.enabled));
        this.#set("fog_density", fog.density);
        this.#set("fog_height_falloff", fog.heightFalloff);
        this.#set("fog_max_height_m", fog.maxHeight);
        this.#set("fog_sse_factor", fog.screenSpaceErrorFactor);
    }

    #checkTile(tile) {
        const path = "QuadtreeTile";
        requireFields(this.#Cesium, tile, path, [
            "_distance",
            "_loadPriority",
            "_lastSelectionResult",
            "_lastSelectionResultFrame",
            "_northwestChild",
            "_northeastChild",
            "_southwestChild",
            "_southeastChild",
            "renderable",
            "upsampledFromParent",
            "state",
            "data",
        ]);
        if (!tile.data) return;
        requireFields(this.#Cesium, tile.data, `${path}.data`, [
            "tileBoundingRegion",
            "boundingVolumeSourceTile",
            "terrainState",
            "terrainData",
            "vertexArray",
            "mesh",
        ]);
        this.#areTilesChecked = true;
    }

    // Returns what is remembered of a tile, and tells its node if it is new or has changed.
    #tell(tile) {
        const id = idOf(tile);
        let told = this.#tiles.get(id);
        if (!told) {
            if (!this.#areTilesChecked) this.#checkTile(tile);
            told = { id, states: KIND_NAMES.map(() => "absent"), bytes: 0, triangles: 0 };
            this.#tiles.set(id, told);
            if (tile.parent) this.#tell(tile.parent);
        }
        const mesh = tile.data?.mesh;
        if (mesh) {
            told.bytes = mesh.vertices.byteLength;
            told.triangles = mesh.indices.length / 3; // those of the skirts too
        }
        this.#trace.node({
            id,
            parent: tile.parent ? idOf(tile.parent) : undefined,
            level: tile.level,
            ...boxOf(this.#Cesium, tile),
            error: this.#quadtree.tileProvider.getLevelMaximumGeometricError(tile.level),
            bytes: told.bytes,
            triangles: told.triangles,
        });
        return told;
    }

    // ---- a frame ----

    // Tells what was selected. Distances and boxes change again when tiles are loaded at the end of the frame.
    #beginFrame(frameState) {
        this.#selected = null;
        const isPerspective = frameState.camera.frustum instanceof this.#Cesium.PerspectiveFrustum;
        if (frameState.mode !== this.#Cesium.SceneMode.SCENE3D || !isPerspective) return;
        if (!this.#isDescribed) this.#describe(frameState);
        this.#tellSettings(frameState);
        const selected = this.#selectedTiles(frameState);
        // Before the frame begins, so that it needs no new block.
        for (const tile of this.#loaded.splice(0)) if (tile.data) this.#tell(tile);
        for (const { tile } of [...selected.drawn, ...selected.culled, ...selected.refined]) this.#tell(tile);
        this.#trace.frameBegin(this.#options.timeS?.() ?? (performance.now() - this.#startMs) / 1000);
        this.#trace.view(0, this.#viewOf(frameState));
        for (const { tile, errorPx } of selected.drawn) this.#trace.drawn(0, idOf(tile), 0, errorPx);
        for (const { tile, reason } of selected.culled) this.#trace.culled(0, idOf(tile), reason);
        this.#tellCounters(selected);
        this.#selected = selected;
    }

    #viewOf(frameState) {
        const { camera, context } = frameState;
        const eye = camera.positionWC;
        return {
            eye: [eye.x, eye.y, eye.z],
            view: this.#Cesium.Matrix4.toArray(camera.viewMatrix),
            projection: this.#Cesium.Matrix4.toArray(camera.frustum.projectionMatrix),
            viewport: [0, 0, context.drawingBufferWidth, context.drawingBufferHeight],
        };
    }

    #selectedTiles(frameState) {
        const quadtree = this.#quadtree;
        const isDrawn = new Set(quadtree._tilesToRender);
        const selected = { frameState, drawn: [], culled: [], refined: [] };
        for (const tile of isDrawn) {
            const errorPx = screenSpaceError(this.#Cesium, quadtree, frameState, tile);
            const isTooCoarse = errorPx >= quadtree.maximumScreenSpaceError;
            const coarse = isTooCoarse ? reasonOfCoarse(tile, frameState.frameNumber) : undefined;
            selected.drawn.push({ tile, errorPx, coarse, isFill: tile.data.vertexArray === undefined });
        }
        // Nothing below a drawn tile is told: what was selected there was replaced by it.
        const visit = (tile) => {
            if (isDrawn.has(tile) || tile._lastSelectionResultFrame !== frameState.frameNumber) return;
            const result = tile._lastSelectionResult & 3;
            if (result === Selection.CULLED) {
                selected.culled.push({ tile, reason: this.#reasonOfCull(tile, frameState) });
            } else if (result === Selection.REFINED) {
                selected.refined.push({ tile, errorPx: screenSpaceError(this.#Cesium, quadtree, frameState, tile) });
                existingChildren(tile).forEach(visit);
            }
        };
        (quadtree._levelZeroTiles ?? []).forEach(visit);
        return selected;
    }

    // Asks in the order of GlobeSurfaceTileProvider.computeTileVisibility().
    #reasonOfCull(tile, frameState) {
        const { fog, cullingVolume } = frameState;
        if (fog.enabled && this.#Cesium.Math.fog(tile._distance, fog.density) >= 1) return Culled.OTHER;
        const region = tile.data.tileBoundingRegion;
        const volume = region.boundingVolume ?? region.boundingSphere;
        return cullingVolume.computeVisibility(volume) === OUTSIDE ? Culled.FRUSTUM : Culled.HORIZON;
    }

    #tellCounters({ frameState, drawn, refined }) {
        const quadtree = this.#quadtree;
        const tau = quadtree.maximumScreenSpaceError;
        const count = (reason) => drawn.filter((each) => each.coarse === reason).length;
        const counters = {
            tiles_visited: quadtree._debug.tilesVisited,
            tiles_culled: quadtree._debug.tilesCulled,
            tiles_waiting_for_children: quadtree._debug.tilesWaitingForChildren,
            load_queue_high: quadtree._tileLoadQueueHigh.length,
            load_queue_medium: quadtree._tileLoadQueueMedium.length,
            load_queue_low: quadtree._tileLoadQueueLow.length,
            fill_tiles: drawn.filter((each) => each.isFill).length,
            coarse_waiting: count(Coarse.WAITS),
            coarse_without_data: count(Coarse.UPSAMPLED),
            coarse_unknown_children: count(Coarse.UNKNOWN_CHILDREN),
            refined_below_tau: refined.filter((each) => each.errorPx < tau).length,
            fog_density: frameState.fog.enabled ? frameState.fog.density : 0,
        };
        for (const [name, value] of Object.entries(counters)) this.#trace.counter(name, value);
    }

    #endFrame() {
        const selected = this.#selected;
        if (!selected) return;
        this.#selected = null;
        const paged = this.#tellPaging();
        const cpuMs = this.#cpuMs() - this.#frameStartMs;
        this.#trace.frameEnd(Number.isNaN(cpuMs) ? -1 : cpuMs);
        this.#options.onFrame?.({ number: this.#trace.stats().frames, ...selected, paged });
    }

    // ---- loading ----

    // The tiles that this frame wants to load, with the priority of their request, larger first.
    #queuedTiles() {
        const queued = new Map();
        const { _tileLoadQueueHigh: high, _tileLoadQueueMedium: medium, _tileLoadQueueLow: low } = this.#quadtree;
        [low, medium, high].forEach((queue, rank) => {
            for (const tile of queue) queued.set(tile, rank * QUEUE_STEP - tile._loadPriority);
        });
        return queued;
    }

    // Compares the state of all tiles with what was told of them. Returns the steps.
    #tellPaging() {
        const steps = [];
        const queued = this.#queuedTiles();
        const absent = new Set(this.#tiles.keys());
        const visit = (tile) => {
            if (!tile.data) return;
            const told = this.#tiles.get(idOf(tile)) ?? this.#tell(tile);
            absent.delete(told.id);
            const states = statesOf(tile, queued.has(tile));
            if (hasMesh(states) && !hasMesh(told.states)) this.#loaded.push(tile);
            states.forEach((state, kind) => this.#step(steps, told, kind, state, queued.get(tile)));
            existingChildren(tile).forEach(visit);
        };
        (this.#quadtree._levelZeroTiles ?? []).forEach(visit);
        for (const id of absent)
            KIND_NAMES.forEach((_, kind) => this.#step(steps, this.#tiles.get(id), kind, "absent"));
        return steps;
    }

    // Tells the steps from the state that was told to the one that is. A step that took less than a frame is told too.
    #step(steps, told, kind, state, priority) {
        let before = told.states[kind];
        if (before === state) return;
        told.states[kind] = state;
        const tell = (step, ...values) => {
            this.#trace[step](told.id, kind, ...values);
            steps.push({ id: told.id, kind, step });
        };
        if (before === "resident") tell("evicted");
        if (!isPending(before)) before = "absent";
        if (before !== "absent" && (state === "absent" || state === "requested")) {
            tell("cancelled");
            before = "absent";
        }
        if (state === "absent") return;
        if (before === "absent") tell("requested", priority);
        if (state !== "requested" && before !== "started") tell("started");
        if (state === "resident") tell("arrived");
        if (state === "failed") tell("failed", "the terrain provider gave no heights");
    }
}

function hasMesh(states) {
    return states[Kind.MESH] === "resident" || states[Kind.UPSAMPLED] === "resident";
}

function isPending(state) {
    return state === "requested" || state === "started";
}

// Returns the state of each kind of a tile's data: absent, requested, started, resident or failed.
function statesOf(tile, isQueued) {
    const { terrainState, terrainData, request } = tile.data;
    const states = KIND_NAMES.map(() => "absent");
    // A tile that is made from its parent's heights is receiving, too, but without a request.
    const isReceiving = terrainState === TerrainState.RECEIVING;
    const isUpsampled =
        terrainState === TerrainState.FAILED ||
        (isReceiving && request === undefined) ||
        (terrainData?.wasCreatedByUpsampling() ?? false);
    if (!isUpsampled && terrainState >= TerrainState.RECEIVED) states[Kind.HEIGHTS] = "resident";
    else if (!isUpsampled && isReceiving) states[Kind.HEIGHTS] = "started";
    let mesh = "absent";
    if (tile.renderable) mesh = "resident";
    else if (tile.state === LOAD_STATE_FAILED) mesh = "failed";
    else if (isQueued) mesh = terrainState >= TerrainState.RECEIVING ? "started" : "requested";
    states[isUpsampled ? Kind.UPSAMPLED : Kind.MESH] = mesh;
    return states;
}
