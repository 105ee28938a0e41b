// Writes a small trace with each event: node write_events.mjs OUT.lodtrace
// tests/planet/trace/lod_trace_js_test.cpp makes the same calls of lod_trace.h, and compares what a reader gets.
import { writeFileSync } from "node:fs";

import { Bounds, Culled, ErrorUnit, Ids, LodTrace, quadtreeId, Requests, Severity, Shape, TAU } from "./lod_trace.js";

const FRAMES = 300; // more than between two key blocks
let ns = 1_000_000;
const trace = new LodTrace({ now: () => ns });
trace.describe({
    name: "engine \u03b1",
    shape: Shape.SPHERE,
    radius: 6371000.5,
    metresPerUnit: 0.25,
    ids: Ids.QUADTREE,
    error: ErrorUnit.PIXELS,
    requests: Requests.CHILDREN,
    kinds: ["mesh", "", "colour"],
});
trace.threadName(0, "main");
trace.setting(TAU, 2);
trace.setting("mode", "fast");
trace.setting("mode", "x".repeat(5000)); // is cut

const farId = quadtreeId(5, 28, 2 ** 28 - 1, 2 ** 28 - 2);
trace.node({ id: 1, bounds: Bounds.SPHERE, centre: [1, -2, 3.5], radius: 4.25, error: 0.5, bytes: 2 ** 40, triangles: 7 });
trace.node({
    id: farId,
    parent: 1,
    level: 28,
    bounds: Bounds.BOX,
    centre: [1e7, 2, 3],
    axes: [0, 1, 0, -1, 0, 0, 0, 0, 1],
    halfSize: [3, 2, 1],
    error: 1e-9,
});
trace.node({ id: 4, bounds: 3, centre: [1, 2, 3], radius: 1 }); // no known shape
trace.node({ id: 3, parent: 0xfedcba9876543210n, level: 2, error: Infinity });

for (let frame = 1; frame <= FRAMES; ++frame) {
    ns += 1000;
    if (frame === 2) trace.node({ id: 3, parent: 1, level: 1, error: 0.125 }); // changes
    trace.frameBegin(frame / 64);
    const view = { eye: [frame, 0.1, -0], view: [], projection: [], viewport: [-1, 2, 1280, 720] };
    for (let i = 0; i < 16; ++i) {
        view.view.push(i === 15 ? frame : i);
        view.projection.push(i / 3);
    }
    trace.view(0, view);
    if (frame % 2 === 0) trace.view(15, view);
    trace.drawn(0, 1);
    trace.drawn(0, farId, 1);
    trace.drawn(15, 3, 0.25, 1.75);
    trace.drawn(0, 3, 0, Infinity);
    trace.culled(15, 1, Culled.OTHER);
    trace.culled(15, 40, Culled.HORIZON); // was never told
    trace.culled(0, 40, 7); // no known reason
    ns += 500;
    if (frame === 3) {
        trace.requested(1, 0);
        trace.requested(3, 0, -2.5);
        trace.requested(farId, 2, 1e9);
        trace.started(1, 0);
        ns += 70_000_000_000; // more than 32 bits
        trace.arrived(1, 0);
        trace.cancelled(3, 0);
        trace.started(farId, 2);
        trace.failed(farId, 2, "disk");
        trace.requested(50, 3);
        ns += 7;
        trace.started(50, 3);
        trace.requested(51, 1);
    }
    if (frame === 299) {
        trace.evicted(1, 0);
        trace.arrived(51, 1);
    }
    trace.counter("whole", frame - 5);
    trace.counter("large", -(2 ** 53) + 1);
    trace.counter("real", frame / 3);
    trace.counter("zero", -0);
    trace.message(Severity.WARNING, "message \u03b2");
    trace.message(3, "of no known severity");
    if (frame === 4) trace.dropped(300);
    trace.frameEnd(1.5, frame % 2 ? -1 : 2.25);
}
trace.close();
writeFileSync(process.argv[2], trace.bytes());
console.log(JSON.stringify(trace.stats()));
