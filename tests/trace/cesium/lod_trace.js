// Traces what an engine's level of detail does, frame by frame, in JavaScript: a browser or node. One ES module without
// dependencies. It writes the format of lod_trace.h, which planet/trace/README.md describes byte by byte, and its calls have
// the same meaning as those of that header: read its comments first.
//
//   import { LodTrace, TAU, Shape } from "./lod_trace.js";
//   const trace = new LodTrace();                       // keeps the bytes; or { write: (bytes) => socket.send(bytes) }
//   trace.describe({ name: "my engine", shape: Shape.SPHERE, radius: 6371000 });
//   trace.setting(TAU, 2);
//   trace.node({ id: 1, bounds: Bounds.SPHERE, centre: [0, 0, 0], radius: 100, error: 0.5 });
//   each frame: trace.frameBegin(timeS); trace.view(0, {...}); trace.drawn(0, 1); trace.frameEnd(cpuMs);
//   trace.close(); download(trace.bytes());
//
// Differences from the C header: there is one stream, from the first call on, and no second thread, so nothing is dropped.
// A call encodes at once. Blocks are passed to write() when they are full, or when a frame begins after blockMs.
//
// Numbers are plain numbers. Ids are unsigned integers of 64 bits: numbers up to 2^53, or BigInts. Matrices are arrays of
// 16 numbers in column-major order, vectors arrays of 3.
//
// MIT License
//
// Copyright (c) 2026 the Worldy authors
//
// Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated
// documentation files (the "Software"), to deal in the Software without restriction, including without limitation the
// rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit
// persons to whom the Software is furnished to do so, subject to the following conditions:
//
// The above copyright notice and this permission notice shall be included in all copies or substantial portions of the
// Software.
//
// THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE
// WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR
// COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR
// OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.

export const VERSION = 1; // of the format
// Names of settings that tools know; see LOD_TRACE_TAU in lod_trace.h.
export const TAU = "tau";
export const HYSTERESIS = "hysteresis";
export const MAX_LEVEL = "max_level";

export const Shape = Object.freeze({ FLAT: 0, SPHERE: 1 });
export const Ids = Object.freeze({ OPAQUE: 0, QUADTREE: 1 });
export const ErrorUnit = Object.freeze({ WORLD: 0, PIXELS: 1 });
export const Requests = Object.freeze({ NODE: 0, CHILDREN: 1 });
export const Bounds = Object.freeze({ NONE: 0, SPHERE: 1, BOX: 2 });
export const Culled = Object.freeze({ FRUSTUM: 0, HORIZON: 1, OCCLUSION: 2, OTHER: 3 });
export const Severity = Object.freeze({ INFO: 0, WARNING: 1, ERROR: 2 });

const MAX_VIEWS = 16;
const MAX_KINDS = 4;
const MAX_NAME_BYTES = 255;
const MAX_TEXT_BYTES = 4095;
const MAX_NAMES = 4096;
const MAX_THREADS = 64;
const MAX_NODES = 1 << 22;

const Definition = { DESCRIPTION: 1, NAME: 2, NODE: 3 };
const Event = {
    FRAME_BEGIN: 1,
    FRAME_END: 2,
    VIEW: 3,
    DRAWN: 4,
    CULLED: 5,
    SELECT_VIEW: 6,
    REQUESTED: 7,
    STARTED: 8,
    ARRIVED: 9,
    CANCELLED: 10,
    FAILED: 11,
    EVICTED: 12,
    COUNTER: 13,
    SETTING: 14,
    MESSAGE: 15,
    DROPPED: 16,
    THREAD: 17,
    THREAD_NAME: 18,
    RESTORED: 19,
};
const FLAG_1 = 0x20;
const FLAG_2 = 0x40;

// The state of a node's data, as in event 19.
const Data = { ABSENT: 0, REQUESTED: 1, STARTED: 2, RESIDENT: 3, FAILED: 4 };
const stateAfter = {
    [Event.REQUESTED]: Data.REQUESTED,
    [Event.STARTED]: Data.STARTED,
    [Event.ARRIVED]: Data.RESIDENT,
    [Event.FAILED]: Data.FAILED,
    [Event.CANCELLED]: Data.ABSENT,
    [Event.EVICTED]: Data.ABSENT,
};

const ENOUGH_BYTES = 1 << 20; // of a block, even if no frame begins
const KEY_FRAMES = 256;
const KEY_BYTES = 4 << 20;

const utf8 = new TextEncoder();

// Returns a text's bytes, cut at a whole character.
function textBytes(text, most) {
    const bytes = utf8.encode(String(text));
    if (bytes.length <= most) return bytes;
    let end = most;
    while (end > 0 && (bytes[end] & 0xc0) === 0x80) --end;
    return bytes.subarray(0, end);
}

// Packs an id of Ids.QUADTREE, a BigInt; see lod_trace_quadtree_id. face: [0, 6); level: [0, 28]; x, y: [0, 2^level).
export function quadtreeId(face, level, x, y) {
    return (BigInt(face) << 61n) | (BigInt(level) << 56n) | (BigInt(y) << 28n) | BigInt(x);
}

// FNV-1a of 32 bits.
function checksum(hash, bytes) {
    for (let i = 0; i < bytes.length; ++i) hash = Math.imul(hash ^ bytes[i], 16777619);
    return hash >>> 0;
}
const CHECKSUM_START = 2166136261;

// A growing array of little-endian bytes.
class ByteWriter {
    #bytes = new Uint8Array(4096);
    #view = new DataView(this.#bytes.buffer);
    size = 0;

    #grow(more) {
        if (this.#bytes.length - this.size >= more) return;
        const grown = new Uint8Array(Math.max(2 * this.#bytes.length, this.size + more));
        grown.set(this.#bytes.subarray(0, this.size));
        this.#bytes = grown;
        this.#view = new DataView(grown.buffer);
    }
    // The bytes so far; valid until the next call.
    written() {
        return this.#bytes.subarray(0, this.size);
    }
    bytes(bytes) {
        this.#grow(bytes.length);
        this.#bytes.set(bytes, this.size);
        this.size += bytes.length;
    }
    u8(value) {
        this.#grow(1);
        this.#bytes[this.size++] = value;
    }
    u16(value) {
        this.#grow(2);
        this.#view.setUint16(this.size, value, true);
        this.size += 2;
    }
    u32(value) {
        this.#grow(4);
        this.#view.setUint32(this.size, value, true);
        this.size += 4;
    }
    u64(value) {
        this.#grow(8);
        this.#view.setBigUint64(this.size, value, true);
        this.size += 8;
    }
    f32(value) {
        this.#grow(4);
        this.#view.setFloat32(this.size, value, true);
        this.size += 4;
    }
    f64(value) {
        this.#grow(8);
        this.#view.setFloat64(this.size, value, true);
        this.size += 8;
    }
    f64s(values, count) {
        for (let i = 0; i < count; ++i) this.f64(values[i]);
    }
    // value: a whole number in [0, 2^53], or a BigInt in [0, 2^64).
    varint(value) {
        if (typeof value === "bigint") {
            if (value > BigInt(Number.MAX_SAFE_INTEGER)) {
                for (; value >= 128n; value >>= 7n) this.u8(Number(value & 127n) | 128);
            }
            value = Number(value);
        }
        for (; value >= 128; value = Math.floor(value / 128)) this.u8((value % 128) | 128);
        this.u8(value);
    }
    // A difference: a whole number, or a BigInt.
    delta(difference) {
        const isSmall = difference < 2 ** 52 && difference > -(2 ** 52);
        const d = isSmall ? Number(difference) : BigInt.asIntN(64, BigInt(difference));
        if (isSmall) this.varint(d >= 0 ? 2 * d : -2 * d - 1);
        else this.varint(d >= 0n ? 2n * d : -2n * d - 1n);
    }
    text(bytes) {
        this.varint(bytes.length);
        this.bytes(bytes);
    }
}

function isSameBytes(a, b) {
    if (a.length !== b.length) return false;
    for (let i = 0; i < a.length; ++i) if (a[i] !== b[i]) return false;
    return true;
}

// Returns a value of an enumeration from 0 to `last`, or `other` for any that the format does not know.
function known(value, last, other) {
    return Number.isInteger(value) && value >= 0 && value <= last ? value : other;
}

// Unknown amounts are 0.
function amount(value) {
    return value > 0 ? Math.min(Math.floor(value), Number.MAX_SAFE_INTEGER) : 0;
}

// A view's 39 numbers as 64-bit words, so that they are compared by their bits.
function viewWords(info) {
    const doubles = new Float64Array(35);
    doubles.set(info.eye, 0);
    doubles.set(info.view, 3);
    doubles.set(info.projection, 19);
    const words = new BigUint64Array(39);
    words.set(new BigUint64Array(doubles.buffer), 0);
    for (let i = 0; i < 4; ++i) words[35 + i] = BigInt(info.viewport[i] >>> 0);
    return words;
}

export class LodTrace {
    #write;
    #now;
    #blockNs;
    #blockBytes;
    #kept = [];
    #isClosed = false;

    #definitions = new ByteWriter();
    #events = new ByteWriter();
    #scratch = new ByteWriter();

    #description = null; // encoded
    #isDescriptionDirty = false;
    #names = [utf8.encode("(too many names)")];
    #nameIndices = new Map();
    #namesStored = 0;
    #settings = new Map(); // by the index of the name
    #threadNames = new Map();
    #nodes = []; // by index: id, definition, isStored, isDirty, data by kind
    #nodeIndices = new Map(); // by id, a BigInt
    #dirty = [];

    #frame = 0;
    #isKey = false;
    #isInside = true;
    #framesSinceKey = 0;
    #bytesSinceKey = 0;
    #keyBytes = 0;
    #blockFrame = 0;
    #blockStartNs = 0n; // times in the block are relative to it
    #lastFrame = 0;
    #lastNs = 0n;
    #lastDrawn = 0;
    #lastPaged = 0;
    #lastView = 0;
    #lastThread = 0;
    #views = new Array(MAX_VIEWS).fill(null);
    #blockFrames = 0;
    #blockEvents = 0;
    #stats = { events: 0, bytes: 0, blocks: 0 };

    // Options:
    //   write       receives each piece of the stream, a Uint8Array that it may keep; without it the trace keeps them
    //   now         returns the time in whole nanoseconds, a number or a BigInt; monotonic. Default: performance.now()
    //   blockMs     of now(), after which a frame begins a new block, >= 0
    //   blockBytes  of events, after which a frame begins a new block, > 0
    constructor({ write, now, blockMs = 250, blockBytes = 49152 } = {}) {
        this.#write = write ?? ((bytes) => this.#kept.push(bytes));
        this.#now = now ?? (() => Math.round(performance.now() * 1e6));
        this.#blockNs = BigInt(Math.round(blockMs * 1e6));
        this.#blockBytes = blockBytes;
        const header = new ByteWriter();
        header.bytes(utf8.encode("LODTRACE"));
        header.u16(VERSION);
        header.u16(16);
        header.u32(0);
        this.#output(header.written().slice());
        this.#startKeyBlock(0, true);
    }

    // Describes the engine; call it before the first node. Fields and defaults are those of lod_trace_description:
    // name, shape, radius, metresPerUnit, ids, error, requests, kinds (up to 4 names).
    describe({
        name = "",
        shape = Shape.FLAT,
        radius = 0,
        metresPerUnit = 1,
        ids = Ids.OPAQUE,
        error = ErrorUnit.WORLD,
        requests = Requests.NODE,
        kinds = [],
    } = {}) {
        if (this.#events.size > 0) this.#flushBlock();
        const out = new ByteWriter();
        out.u8(Definition.DESCRIPTION);
        for (const value of [shape, ids, error, requests]) out.u8(known(value, 1, 0));
        out.f64(radius);
        out.f64(metresPerUnit || 1);
        out.text(textBytes(name, MAX_NAME_BYTES));
        for (let kind = 0; kind < MAX_KINDS; ++kind) out.text(textBytes(kinds[kind] ?? "", MAX_NAME_BYTES));
        this.#description = out.written().slice();
        this.#isDescriptionDirty = true;
    }

    // Tells a node, or its new values; telling the same values again costs no bytes. Fields are those of lod_trace_node_info:
    // id, parent (undefined or null for a root), level, bounds, centre, radius, axes (9 numbers), halfSize, error, bytes,
    // triangles. Returns false if too many nodes are known.
    node(info) {
        const index = this.#indexOf(info.id);
        if (index === undefined) return false;
        const definition = this.#nodeDefinition(index, info);
        const entry = this.#nodes[index];
        if (entry.definition && isSameBytes(entry.definition, definition)) return true;
        // Events of this block refer to the values that are not written yet.
        if (entry.definition && entry.isDirty && this.#events.size > 0) this.#flushBlock();
        this.#markDirty(index);
        entry.definition = definition.slice();
        return true;
    }

    // Begins a frame. timeS: the engine's own clock, seconds.
    frameBegin(timeS) {
        const ns = this.#time();
        this.#frame += 1;
        const isFull =
            this.#events.size > this.#blockBytes ||
            (this.#blockEvents > 0 && ns - this.#blockStartNs > this.#blockNs);
        // A key is worth its bytes once the blocks since the last one take as many.
        if (
            this.#framesSinceKey >= KEY_FRAMES ||
            this.#bytesSinceKey > (this.#keyBytes > KEY_BYTES / 2 ? this.#keyBytes : KEY_BYTES)
        ) {
            this.#startKeyBlock(this.#frame, false);
        } else if (isFull) {
            this.#flushBlock();
        }
        if (this.#blockEvents === 0) {
            this.#blockFrame = this.#lastFrame = this.#frame;
            this.#isInside = false;
        }
        ++this.#framesSinceKey;
        ++this.#blockFrames;
        this.#begin(Event.FRAME_BEGIN);
        this.#events.delta(this.#frame - this.#lastFrame);
        this.#lastFrame = this.#frame;
        this.#putTime(ns);
        this.#events.f64(timeS);
    }

    // Tells a view of this frame: eye, view, projection, viewport (x, y, width, height in pixels).
    view(view, info) {
        if (!this.#isView(view)) return;
        const words = viewWords(info);
        const before = this.#views[view] ?? new BigUint64Array(39);
        let low = 0;
        let high = 0; // the mask has 39 bits
        for (let i = 0; i < 39; ++i) {
            if (words[i] === before[i]) continue;
            if (i < 28) low += 2 ** i;
            else high += 2 ** (i - 28);
        }
        this.#views[view] = words;
        this.#begin(Event.VIEW);
        this.#events.u8(view);
        this.#events.varint(high * 2 ** 28 + low);
        for (let i = 0; i < 39; ++i) {
            if (words[i] === before[i]) continue;
            if (i < 35) this.#events.u64(words[i]);
            else this.#events.u32(Number(words[i]));
        }
    }

    // Tells that a view draws a node in this frame. morph: [0, 1]. errorPx: the error on screen as the engine computed it,
    // pixels; undefined if tools should compute it.
    drawn(view, id, morph = 0, errorPx = undefined) {
        const index = this.#isView(view) ? this.#indexOf(id) : undefined;
        if (index === undefined) return;
        this.#selectView(view);
        const morphBits = Object.is(morph, 0) ? 0 : morph === 1 ? 1 : 2;
        const hasPx = errorPx !== undefined;
        this.#begin(Event.DRAWN | (morphBits << 5) | (hasPx ? 0x80 : 0));
        this.#putDrawn(index);
        if (morphBits === 2) this.#events.f32(morph);
        if (hasPx) this.#events.f32(errorPx);
    }

    // Tells that a view draws neither a node nor its descendants in this frame. reason: Culled.
    culled(view, id, reason) {
        const index = this.#isView(view) ? this.#indexOf(id) : undefined;
        if (index === undefined) return;
        this.#selectView(view);
        this.#begin(Event.CULLED | (known(reason, Culled.OTHER, Culled.OTHER) << 5));
        this.#putDrawn(index);
    }

    // Ends the frame. Milliseconds; negative: unknown.
    frameEnd(cpuMs = -1, gpuMs = -1) {
        this.#begin(Event.FRAME_END);
        this.#putTime(this.#time());
        this.#events.f64(cpuMs);
        this.#events.f64(gpuMs);
    }

    // The way of a request; see lod_trace_requested. priority: larger first, NaN or undefined: unknown.
    requested(id, kind = 0, priority = NaN) {
        this.#paged(Event.REQUESTED, id, kind, priority);
    }
    started(id, kind = 0) {
        this.#paged(Event.STARTED, id, kind);
    }
    arrived(id, kind = 0) {
        this.#paged(Event.ARRIVED, id, kind);
    }
    cancelled(id, kind = 0) {
        this.#paged(Event.CANCELLED, id, kind);
    }
    failed(id, kind = 0, reason = "") {
        this.#paged(Event.FAILED, id, kind, NaN, reason);
    }
    evicted(id, kind = 0) {
        this.#paged(Event.EVICTED, id, kind);
    }

    // Sets a setting from this frame on: a number, or a text.
    setting(name, value) {
        const index = this.#nameOf(name);
        if (index === 0) return;
        this.#settings.set(index, typeof value === "number" ? value : textBytes(value, MAX_TEXT_BYTES));
        this.#putSetting(index);
    }

    // Tells a number that changes from frame to frame.
    counter(name, value) {
        const index = this.#nameOf(name);
        // -0 is no whole number, because it would come back as 0.
        const isWhole = Number.isSafeInteger(value) && !Object.is(value, -0);
        this.#begin(Event.COUNTER | (isWhole ? FLAG_1 : 0));
        this.#events.varint(index);
        if (isWhole) this.#events.delta(value);
        else this.#events.f64(value);
    }

    // severity: Severity.
    message(severity, text) {
        this.#putThread();
        this.#begin(Event.MESSAGE | (known(severity, Severity.ERROR, Severity.ERROR) << 5));
        this.#putTime(this.#time());
        this.#events.text(textBytes(text, MAX_TEXT_BYTES));
    }

    // Tells that the caller lost events of this frame, for example because a socket was too slow.
    dropped(count) {
        this.#begin(Event.DROPPED);
        this.#events.varint(count);
    }

    // The thread, such as a worker, of the paging events and messages that follow, [0, 63]; at first 0.
    thread = 0;

    // Names a thread.
    threadName(thread, name) {
        if (!(thread >= 0 && thread < MAX_THREADS)) return;
        this.#threadNames.set(thread, this.#nameOf(name));
        this.#putThreadName(thread);
    }

    // Passes the block in progress on, for a tool that watches.
    flush() {
        this.#flushBlock();
    }

    // Ends the trace. No call may follow but bytes() and stats().
    close() {
        if (this.#isClosed) return;
        this.#flushBlock();
        this.#isClosed = true;
    }

    // The whole stream so far, if no write() was given.
    bytes() {
        const size = this.#kept.reduce((sum, piece) => sum + piece.length, 0);
        const all = new Uint8Array(size);
        let at = 0;
        for (const piece of this.#kept) {
            all.set(piece, at);
            at += piece.length;
        }
        return all;
    }

    // Counts so far: events and bytes in the stream, its blocks, frames and nodes.
    stats() {
        return { ...this.#stats, frames: this.#frame, nodes: this.#nodes.length };
    }

    // ---- blocks ----

    #output(bytes) {
        this.#stats.bytes += bytes.length;
        this.#write(bytes);
    }

    #time() {
        return BigInt(this.#now());
    }

    #startBlock(frame) {
        this.#isKey = false;
        this.#isInside = true;
        this.#blockFrame = this.#lastFrame = frame;
        this.#blockStartNs = this.#lastNs = this.#time();
        this.#blockFrames = this.#blockEvents = 0;
        this.#lastDrawn = this.#lastPaged = 0;
        this.#lastView = this.#lastThread = 0;
        this.#views.fill(null);
        this.#definitions.size = this.#events.size = 0;
    }

    // Starts a block with all that later events build on, but for the nodes' definitions.
    #startKeyBlock(frame, isInside) {
        this.#flushBlock();
        this.#startBlock(frame);
        this.#isKey = true;
        this.#isInside = isInside;
        this.#isDescriptionDirty = this.#description !== null;
        for (const index of this.#settings.keys()) this.#putSetting(index);
        for (const thread of this.#threadNames.keys()) this.#putThreadName(thread);
        for (let index = 0; index < this.#nodes.length; ++index) {
            this.#nodes[index].data.forEach((data, kind) => {
                if (data && data.state !== Data.ABSENT) this.#putRestored(index, kind, data);
            });
        }
        this.#framesSinceKey = this.#bytesSinceKey = 0;
        this.#keyBytes = this.#events.size;
    }

    // Puts what events refer to before them: the description, names, and nodes that are new or changed.
    #putDefinitions() {
        const out = this.#definitions;
        if (this.#isDescriptionDirty) out.bytes(this.#description);
        this.#isDescriptionDirty = false;
        for (; this.#namesStored < this.#names.length; ++this.#namesStored) {
            out.u8(Definition.NAME);
            out.varint(this.#namesStored);
            out.text(this.#names[this.#namesStored]);
        }
        for (const index of this.#dirty) {
            const entry = this.#nodes[index];
            out.bytes(entry.definition ?? this.#namedDefinition(index, entry.id));
            entry.isDirty = false;
            entry.isStored = true;
        }
        this.#dirty.length = 0;
    }

    #flushBlock() {
        this.#putDefinitions();
        const definitions = this.#definitions.written();
        const events = this.#events.written();
        if (definitions.length + events.length === 0) return;
        const size = definitions.length + events.length;
        const out = new ByteWriter();
        out.bytes(utf8.encode("LTB1"));
        out.u32(size);
        out.u32(definitions.length);
        out.u32((this.#isKey ? 1 : 0) | (this.#isInside ? 2 : 0));
        out.u64(BigInt(this.#blockFrame));
        out.u64(this.#blockStartNs);
        out.u32(this.#blockFrames);
        out.u32(this.#blockEvents);
        out.u32(checksum(checksum(CHECKSUM_START, definitions), events));
        out.u32(checksum(CHECKSUM_START, out.written()));
        out.bytes(definitions);
        out.bytes(events);
        this.#stats.events += this.#blockEvents;
        ++this.#stats.blocks;
        this.#bytesSinceKey += out.size;
        this.#output(out.written().slice());
        this.#startBlock(this.#frame);
    }

    // ---- tables ----

    #indexOf(id) {
        const key = BigInt.asUintN(64, BigInt(id));
        const known = this.#nodeIndices.get(key);
        if (known !== undefined) return known;
        const index = this.#nodes.length;
        if (index >= MAX_NODES) return undefined;
        this.#nodes.push({ id: key, definition: null, isStored: false, isDirty: false, data: [] });
        this.#nodeIndices.set(key, index);
        this.#markDirty(index);
        return index;
    }

    #markDirty(index) {
        const entry = this.#nodes[index];
        if (entry.isDirty) return;
        // The events so far refer to the old values.
        if (entry.isStored && this.#events.size > 0) this.#flushBlock();
        entry.isDirty = true;
        this.#dirty.push(index);
    }

    // Of a node that was named by its id alone.
    #namedDefinition(index, id) {
        const out = new ByteWriter();
        out.u8(Definition.NODE);
        out.u8(0);
        out.varint(index);
        out.u64(id);
        return out.written();
    }

    // Valid until the next call.
    #nodeDefinition(index, info) {
        const out = this.#scratch;
        const bounds = known(info.bounds, Bounds.BOX, Bounds.NONE);
        const hasParent = info.parent !== undefined && info.parent !== null;
        out.size = 0;
        out.u8(Definition.NODE);
        out.u8(1 | (hasParent ? 2 : 0) | (bounds << 2));
        out.varint(index);
        out.u64(BigInt.asUintN(64, BigInt(info.id)));
        if (hasParent) out.u64(BigInt.asUintN(64, BigInt(info.parent)));
        out.varint(info.level ?? 0);
        if (bounds !== Bounds.NONE) out.f64s(info.centre, 3);
        if (bounds === Bounds.SPHERE) out.f64(info.radius);
        if (bounds === Bounds.BOX) {
            out.f64s(info.axes, 9);
            out.f64s(info.halfSize, 3);
        }
        out.f64(info.error ?? 0);
        out.varint(amount(info.bytes));
        out.varint(amount(info.triangles));
        return out.written();
    }

    // Returns the index of a name; 0 if there are too many.
    #nameOf(name) {
        const bytes = textBytes(name, MAX_NAME_BYTES);
        const key = String.fromCharCode(...bytes);
        const known = this.#nameIndices.get(key);
        if (known !== undefined) return known;
        if (this.#names.length >= MAX_NAMES) return 0;
        this.#names.push(bytes.slice());
        this.#nameIndices.set(key, this.#names.length - 1);
        return this.#names.length - 1;
    }

    // ---- events ----

    // Begins an event with its first byte.
    #begin(type) {
        this.#events.u8(type);
        ++this.#blockEvents;
    }

    #putTime(ns) {
        this.#events.delta(ns - this.#lastNs);
        this.#lastNs = ns;
    }

    #isView(view) {
        return Number.isInteger(view) && view >= 0 && view < MAX_VIEWS;
    }

    #selectView(view) {
        if (this.#events.size > ENOUGH_BYTES) this.#flushBlock();
        if (this.#lastView === view) return;
        this.#lastView = view;
        this.#begin(Event.SELECT_VIEW);
        this.#events.u8(view);
    }

    #putDrawn(index) {
        this.#events.delta(index - this.#lastDrawn);
        this.#lastDrawn = index;
    }

    #putThread() {
        const thread = this.thread >= 0 && this.thread < MAX_THREADS ? this.thread : 0;
        if (this.#lastThread === thread) return;
        this.#lastThread = thread;
        this.#begin(Event.THREAD);
        this.#events.varint(thread);
    }

    #putThreadName(thread) {
        this.#begin(Event.THREAD_NAME);
        this.#events.varint(thread);
        this.#events.varint(this.#threadNames.get(thread));
    }

    #putSetting(index) {
        const value = this.#settings.get(index);
        const isText = typeof value !== "number";
        this.#begin(Event.SETTING | (isText ? FLAG_1 : 0));
        this.#events.varint(index);
        if (isText) this.#events.text(value);
        else this.#events.f64(value);
    }

    #putRestored(index, kind, data) {
        this.#begin(Event.RESTORED);
        this.#events.u8(data.state | (kind << 4));
        this.#events.delta(index - this.#lastPaged);
        this.#lastPaged = index;
        const isPending = data.state === Data.REQUESTED || data.state === Data.STARTED;
        if (isPending) this.#events.delta(data.requestedNs - this.#blockStartNs);
        if (data.state === Data.STARTED) this.#events.delta(data.startedNs - this.#blockStartNs);
    }

    #paged(event, id, kind, priority = NaN, reason = "") {
        const isKind = Number.isInteger(kind) && kind >= 0 && kind < MAX_KINDS;
        const index = isKind ? this.#indexOf(id) : undefined;
        if (index === undefined) return;
        if (this.#events.size > ENOUGH_BYTES) this.#flushBlock();
        const ns = this.#time();
        this.#follow(index, kind, event, ns);
        const hasPriority = event === Event.REQUESTED && !Number.isNaN(priority);
        const reasonIndex = event === Event.FAILED ? this.#nameOf(reason) : 0;
        this.#putThread();
        this.#begin(event | (kind ? FLAG_1 : 0) | (hasPriority ? FLAG_2 : 0));
        if (kind) this.#events.u8(kind);
        this.#events.delta(index - this.#lastPaged);
        this.#lastPaged = index;
        this.#putTime(ns);
        if (hasPriority) this.#events.f32(priority);
        if (event === Event.FAILED) this.#events.varint(reasonIndex);
    }

    // Follows the state of a node's data, for key blocks.
    #follow(index, kind, event, ns) {
        const all = this.#nodes[index].data;
        const data = (all[kind] ??= { state: Data.ABSENT, requestedNs: 0n, startedNs: 0n });
        if (event === Event.REQUESTED) data.requestedNs = ns;
        if (event === Event.STARTED) {
            if (data.state !== Data.REQUESTED) data.requestedNs = ns;
            data.startedNs = ns;
        }
        data.state = stateAfter[event];
    }
}
