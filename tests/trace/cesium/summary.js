// Counts what Cesium did in each frame, from its own objects and not from the trace: a second source for tests of whoever
// reads the trace.
import { Coarse, KIND_NAMES } from "./cesium_adapter.js";
import { Culled } from "./lod_trace.js";

export function newSummary(origin) {
    return {
        ...origin,
        frames: 0,
        drawn: 0,
        fills: 0,
        mostDrawn: 0,
        distinctDrawn: 0,
        deepestDrawn: 0,
        culled: { frustum: 0, horizon: 0, fog: 0 },
        coarse: { waits: 0, withoutData: 0, unknownChildren: 0 },
        refinedBelowTau: 0,
        refinedBeyondData: 0,
        holes: 0,
        levelSteps: 0,
        steps: {},
        worstErrorPx: 0,
        worstFrame: 0,
        perFrame: { drawn: [], deepest: [], coarse: [], fills: [] },
        tilesOf: {}, // the drawn tiles of some frames
    };
}

const SAMPLE_FRAMES = [61, 121, 211, 301, 361];

const drawnBefore = new WeakMap(); // a set of names, by summary

function nameOf(tile) {
    return `${tile.level}/${tile.x}/${tile.y}`;
}

export function addFrame(Cesium, summary, { number, frameState, drawn, culled, refined, paged }) {
    const tau = 2;
    const names = drawnBefore.get(summary) ?? new Set();
    drawnBefore.set(summary, names);
    for (const { tile } of drawn) names.add(nameOf(tile));
    const levels = drawn.map(({ tile }) => tile.level);
    const deepest = Math.max(-1, ...levels);
    summary.frames = number;
    summary.drawn += drawn.length;
    summary.fills += drawn.filter(({ isFill }) => isFill).length;
    summary.mostDrawn = Math.max(summary.mostDrawn, drawn.length);
    summary.distinctDrawn = names.size;
    summary.deepestDrawn = Math.max(summary.deepestDrawn, deepest);
    summary.culled.frustum += culled.filter(({ reason }) => reason === Culled.FRUSTUM).length;
    summary.culled.horizon += culled.filter(({ reason }) => reason === Culled.HORIZON).length;
    summary.culled.fog += culled.filter(({ reason }) => reason === Culled.OTHER).length;
    const coarse = drawn.filter(({ errorPx }) => errorPx >= tau);
    const because = (reason) => coarse.filter((each) => each.coarse === reason).length;
    summary.coarse.waits += because(Coarse.WAITS);
    summary.coarse.withoutData += because(Coarse.UPSAMPLED);
    summary.coarse.unknownChildren += because(Coarse.UNKNOWN_CHILDREN);
    summary.refinedBelowTau += refined.filter(({ errorPx }) => errorPx < tau).length;
    for (const { kind, step } of paged) {
        const key = `${KIND_NAMES[kind]} ${step}`;
        summary.steps[key] = (summary.steps[key] ?? 0) + 1;
    }
    for (const { errorPx } of drawn) {
        if (errorPx <= summary.worstErrorPx) continue;
        summary.worstErrorPx = errorPx;
        summary.worstFrame = number;
    }
    summary.perFrame.drawn.push(drawn.length);
    summary.perFrame.deepest.push(deepest);
    summary.perFrame.coarse.push(coarse.length);
    summary.perFrame.fills.push(drawn.filter(({ isFill }) => isFill).length);
    summary.refinedBeyondData += refined.filter(({ tile }) => tile.level >= summary.maxLevel).length;
    summary.holes += holesIn(drawn, culled, refined);
    summary.levelSteps += levelStepsIn(drawn);
    if (!SAMPLE_FRAMES.includes(number)) return;
    summary.tilesOf[number] = drawn.map(({ tile, errorPx, isFill }) => ({
        tile: nameOf(tile),
        errorPx,
        isFill,
        distance: tile._distance,
    }));
}

// Children of refined tiles that are neither drawn nor culled nor refined.
function holesIn(drawn, culled, refined) {
    const selected = new Set([...drawn, ...culled, ...refined].map(({ tile }) => nameOf(tile)));
    const childrenOf = ({ level, x, y }) =>
        [0, 1, 2, 3].map((i) => `${level + 1}/${2 * x + (i & 1)}/${2 * y + (i >> 1)}`);
    return refined.flatMap(({ tile }) => childrenOf(tile)).filter((name) => !selected.has(name)).length;
}

// Pairs of drawn tiles of the same root that share an edge and are more than one level apart.
function levelStepsIn(drawn) {
    const names = new Set(drawn.map(({ tile }) => nameOf(tile)));
    const pairs = new Set();
    for (const { tile } of drawn) {
        for (const [dx, dy] of [[-1, 0], [1, 0], [0, -1], [0, 1]]) {
            const x = tile.x + dx;
            const y = tile.y + dy;
            if (x < 0 || y < 0 || x >> tile.level !== tile.x >> tile.level || y >> tile.level !== 0) continue;
            for (let up = 2; up <= tile.level; ++up) {
                const coarser = `${tile.level - up}/${x >> up}/${y >> up}`;
                if (names.has(coarser)) pairs.add(`${nameOf(tile)} ${coarser}`);
            }
        }
    }
    return pairs.size;
}
