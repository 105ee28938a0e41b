// Transforms and lights a vertex of the grid that all chunks share.

// The inputs' locations follow their order in planet/gl/draw/chunk_instances.cpp.
in uvec2 gridVertex;  // column, row
in uint skirt;        // 1 at the skirt's lower end
in uint chunkFace;
in uint chunkLevel;
in uvec2 chunkPlace;  // x, y
in uint chunkSlot;
in uvec4 beside;      // slots of the neighbours of the same level: west, east, south, north
in float skirtDepthM;
in float morph;       // [0, 1]
in vec4 chunkTint;    // sRGB and opacity
in uvec4 coarserBy;   // levels by which the neighbour is coarser and stitched to: west, east, south, north
in vec4 edgeMorph;    // west, east, south, north: [0, 1]

uniform isampler2DArray heightPool;

out vec3 surface;         // position relative to the eye
out vec3 facePlace;       // [0, 1] along u and v; height, metres
out vec2 imagePlace;      // the same in the colour image, whose outermost texels have their centres on the edges
out vec3 aboveSea;        // height above the sea level: metres; metres of the Earth; 1 at the ramp's highest band
out vec4 surfaceNormal;   // not unit length; roughness of the ground, [0, 1]
out vec3 sunLit;          // the sun's light on the ground
out vec3 skyLit;          // the sky's light on the ground
out vec3 airLit;          // the sun's light on the air before the ground
out vec4 groundArriving;  // lit per vertex: light of white land at the eye; ratio of the sea's to it
out vec4 airArriving;     // lit per vertex: light that the air scatters; ratio of the sea's glint to land
out float steep;          // lit per vertex: [0, 1]
out vec3 meshPlace;       // column and row, for the mesh's lines; 0 on the ground, 1 at a skirt's lower end
flat out float onFace;
flat out float flooded;   // 1 if the sea level is raised by 30 m of the Earth or more
flat out vec4 tint;
flat out float meshLevel;  // level of the tiles whose texels are the mesh's vertices
flat out ShadingFrame held;  // with switchHeldFrame

invariant gl_Position;

// Returns the texel of a slot's first height: column and row in its page, and the page.
ivec3 slotCorner(uint slot, int last) {
    return ivec3(ivec2(int(slot & 0x3FFu), int((slot >> 10u) & 0x3FFu)) * (last + 1), int(slot >> 20u));
}

int stepAt(ivec3 corner, ivec2 vertex) {
    return texelFetch(heightPool, corner + ivec3(vertex, 0), 0).r;
}

// Returns two slopes at a vertex along one axis, in steps per cell. The first one is a central difference
// over vertices `apart` cells away, also across the chunk's border if the neighbour is drawn at the same
// level. Elsewhere on the border it is one-sided and of second order, so that both sides agree as far as
// their heights determine it. The second one is the larger of the absolute differences to either side; it is
// 0 if only one is known. So on a face's edge both faces see only the steps along the edge, which are the
// same.
vec2 slope(ivec3 corner, ivec2 vertex, ivec2 axis, int last, int here, uint slotBefore, uint slotAfter,
           int apart) {
    int at = vertex.x * axis.x + vertex.y * axis.y;
    bool first = at == 0;
    bool border = first || at == last;
    uint slotBeside = first ? slotBefore : slotAfter;
    bool across = border && slotBeside != noSlot;
    bool oneSided = border && slotBeside == noSlot;
    // One vertex lies inside the chunk, the other one on the other side, or behind the first one if that is unknown.
    int inward = at == last ? -1 : 1;
    int beyond = across ? last - apart : oneSided ? 2 * apart : -apart;
    ivec3 cornerBeyond = across ? slotCorner(slotBeside, last) : corner;
    int inside = stepAt(corner, vertex + axis * (inward * apart));
    int other = stepAt(cornerBeyond, vertex + axis * (inward * beyond));
    int twice = inward * (oneSided ? 4 * inside - 3 * here - other : inside - other);
    float steepest = oneSided ? 0.0 : float(max(abs(here - inside), abs(here - other)));
    return vec2(0.5 * float(twice), steepest) / float(apart);
}

void lightGround(vec3 position, vec3 up, float height) {
    float sunRise = dot(up, shading.sun);
    float day = smoothRise(-0.06, 0.10, sunRise);
    vec3 sky = vec3(0.0125, 0.013, 0.0145);
    sunLit = sunLight * day;
    airLit = vec3(0.0);
    if (switchPhysicalAir) {
        float above = height * air.kmPerM;
        sunLit = air.light * sunThroughAir(above, sunRise);
        skyLit = skyIrradianceAt(above, sunRise);
        return;
    }
    if (switchAir) {
        sky = vec3(0.085, 0.115, 0.165) * smoothRise(-0.18, 0.30, sunRise) + vec3(0.0025, 0.003, 0.0045);
        sunLit *= sunThrough(0.1, sunRise);
        airLit = sunOnAirBefore(position, normalize(position), up, max(height, 0.0) * shading.scaleHeightsPerM);
    }
    skyLit = sunLight * 0.55 * sky;
}

void lightByVertex(vec3 position, vec3 up, vec3 normal, float height) {
    vec3 ray = normalize(position);
    vec3 land = sunLit * max(dot(normal, shading.sun), 0.0) + skyLit + fillLight(normal, -ray, up);
    vec3 sea = sunLit * max(dot(up, shading.sun), 0.0) + skyLit + fillLight(up, -ray, up);
    steep = steepness(normal, up);
    groundArriving = vec4(land, sea.g / land.g);
    airArriving = vec4(0.0, 0.0, 0.0, seaGlint(up, -ray) * sunLit.g / land.g);
    if (!switchAir) return;
    if (switchPhysicalAir) {
        AirLight before = lightBefore(position, height, 0.5);
        groundArriving.rgb *= before.through;
        airArriving.rgb = before.scattered;
        return;
    }
    float mass = airBefore(ray, up, max(height, 0.0) * shading.scaleHeightsPerM);
    vec3 amount = scatteringBeforeGround();
    groundArriving.rgb *= exp(-(amount + vec3(haze)) * mass);
    airArriving.rgb = scattered(mass, amount, airLit, dot(ray, shading.sun));
}

// Returns both slopes at a vertex: along u and along v.
mat2 slopes(ivec3 corner, ivec2 vertex, int last, int here, int apart) {
    return mat2(slope(corner, vertex, ivec2(1, 0), last, here, beside.x, beside.y, apart),
                slope(corner, vertex, ivec2(0, 1), last, here, beside.z, beside.w, apart));
}

// The slide of a vertex while its chunk turns into a coarser one, as in planet/select/drawn_surface.h.
struct Slide {
    ivec2 vertex;    // itself, or the coarser neighbour's vertex that it coincides with
    ivec2 aside;     // offset to either end of the edge or diagonal that replaces it; 0: it stays
    float amount;    // share of the way to the middle between those ends, [0, 1]
    ivec2 onto;      // offset to the vertex that it is gathered to in the end
    float gathered;  // share of the way there, [0, 1]
};

// Returns the multiple of four next to an odd vertex.
int gatherPoint(int vertex) {
    return (vertex & 3) == 1 ? vertex - 1 : vertex + 1;
}

Slide slideOf(ivec2 vertex, int last) {
    bool west = vertex.x == 0;
    bool east = vertex.x == last;
    bool south = vertex.y == 0;
    if (!(west || east || south || vertex.y == last))
        return Slide(vertex, vertex & 1, morph, ivec2(0), 0.0);
    int edge = west ? 0 : east ? 1 : south ? 2 : 3;
    ivec2 along = edge < 2 ? ivec2(0, 1) : ivec2(1, 0);
    int levels = int(coarserBy[edge]);
    // Counts along the whole face, so that both sides of an edge count alike.
    int here = vertex.x * along.x + vertex.y * along.y;
    int start = int(edge < 2 ? chunkPlace.y : chunkPlace.x) << frame.chunkCellsLog2;
    int at = start + here;
    for (int level = 0; level < levels; ++level) {
        if (((at >> level) & 1) != 0) at = gatherPoint(at >> level) << level;
    }
    Slide slide = Slide(vertex + along * (at - start - here), ivec2(0), edgeMorph[edge], ivec2(0), 0.0);
    int coarse = at >> levels;
    if ((coarse & 1) == 0) return slide;
    slide.aside = along << levels;
    if (!switchGather) return slide;
    slide.onto = along * ((gatherPoint(coarse) << levels) - at);
    slide.gathered = max(4.0 * slide.amount - 3.0, 0.0);
    return slide;
}

// Returns log2 of the chunk's cell side in cells of the finest grid.
int cellLog2() {
    return fineGridLog2 - frame.chunkCellsLog2 - int(chunkLevel);
}

ivec2 gridPointOf(ivec2 vertex) {
    return ((ivec2(chunkPlace) << frame.chunkCellsLog2) + vertex) << cellLog2();
}

// Returns the position relative to the eye, and in `up` the direction from the planet's centre, of about unit
// length.
vec3 positionOf(OwnedPoint point, int heightStep, float drop, out vec3 up) {
    GridPlace place = gridPlace(point);
    up = frame.faces[point.face].direction + place.turn;
    if (switchCube)
        return positionOnCube(point.face, place, frame.baseHeightM + float(heightStep) * frame.quantumM - drop);
    float rise = float(heightStep - frame.referenceStep) * frame.quantumM;
    if (switchSeaSurface) rise = max(rise, frame.seaRiseM);
    return positionOnSphere(point.face, place, rise - drop);
}

OwnedPoint pointOf(ivec2 vertex) {
    return ownedPoint(int(chunkFace), gridPointOf(vertex));
}

// The drawn state of a vertex, or of several mixed.
struct Drawn {
    vec3 position;
    vec3 up;       // from the planet's centre, of about unit length
    vec2 place;    // on the face's grid, in cells of the finest level
    float height;  // steps
};

// Returns the state of a vertex that does not slide.
Drawn ownDrawn(ivec3 corner, ivec2 vertex, float drop) {
    int heightStep = stepAt(corner, vertex);
    Drawn drawn;
    drawn.position = positionOf(pointOf(vertex), heightStep, drop, drawn.up);
    drawn.place = vec2(gridPointOf(vertex));
    drawn.height = float(heightStep);
    return drawn;
}

Drawn middleOf(Drawn a, Drawn b) {
    return Drawn(0.5 * (a.position + b.position), a.up, 0.5 * (a.place + b.place), 0.5 * (a.height + b.height));
}

// Keeps the direction up of the vertex that slides.
void slideTo(inout Drawn drawn, Drawn to, float amount) {
    drawn.position += amount * (to.position - drawn.position);
    drawn.place += amount * (to.place - drawn.place);
    drawn.height += amount * (to.height - drawn.height);
}

// Slides like slideTo, but reaches its end exactly at 1, so that no gap opens.
void gatherTo(inout Drawn drawn, Drawn to, float amount) {
    float kept = 1.0 - amount;
    drawn.position = kept * drawn.position + amount * to.position;
    drawn.up += amount * (to.up - drawn.up);
    drawn.place = kept * drawn.place + amount * to.place;
    drawn.height = kept * drawn.height + amount * to.height;
}

// A vertex that slides is mixed from up to four vertices: itself, both ends of the edge that replaces it, and the one
// that it is gathered to. A loop computes them, because llvmpipe executes both sides of a condition but leaves a loop as soon
// as none of eight vertices remains in it. The loop tests its condition at the end, because otherwise its body would be
// executed once more.
//
// Returns how many vertices are mixed.
int mixedFrom(Slide slide) {
    return slide.amount <= 0.0 ? 1 : slide.gathered > 0.0 ? 4 : 3;
}

// Returns the grid's vertex of an index in that order.
ivec2 mixedVertex(Slide slide, int index) {
    return slide.vertex + (index == 1 ? -slide.aside : index == 2 ? slide.aside : index == 3 ? slide.onto : ivec2(0));
}

// Adds the next one of these vertices to those that are mixed so far. before: keeps the second one for the third.
void mixIn(Drawn next, Slide slide, int index, inout Drawn mixed, inout Drawn before) {
    if (index == 0) mixed = next;
    if (index == 1) before = next;
    if (index == 2) slideTo(mixed, middleOf(before, next), slide.amount);
    if (index == 3) gatherTo(mixed, next, slide.gathered);
}

// Returns the state of a coarser chunk's vertex, which stitching may have moved along its edge.
Drawn coarserDrawn(ivec3 corner, inout ivec2 vertex, int last, float drop) {
    Slide slide = slideOf(vertex, last);
    vertex = slide.vertex;
    bool inside = all(greaterThan(vertex, ivec2(0))) && all(lessThan(vertex, ivec2(last)));
    int count = inside || slide.aside == ivec2(0) ? 1 : mixedFrom(slide);
    Drawn mixed, before;
    int index = 0;
    do {
        mixIn(ownDrawn(corner, mixedVertex(slide, index), drop), slide, index, mixed, before);
    } while (++index < count);
    return mixed;
}

void main() {
    shading = frame.shading;
    if (switchHeldFrame) held = shading;
    int face = int(chunkFace);
    int last = 1 << frame.chunkCellsLog2;
    Slide slide = Slide(ivec2(gridVertex), ivec2(0), 0.0, ivec2(0), 0.0);
    if (switchSlide) slide = slideOf(slide.vertex, last);

    ivec3 corner = slotCorner(chunkSlot, last);
    float drop = skirt == 0u ? 0.0 : skirtDepthM;
    bool withSlopes = switchLighting || switchLayers || switchLayerPreview;
    Drawn drawn, before;
    mat2 steps, stepsBefore;
    // Only vertices that morph slide: others have moved to the coarser neighbour's vertex.
    int count = switchMorph ? mixedFrom(slide) : 1;
    int index = 0;
    do {
        ivec2 vertex = mixedVertex(slide, index);
        bool ofCoarser = index == 1 || index == 2;
        Drawn next;
        if (switchGather && ofCoarser)
            next = coarserDrawn(corner, vertex, last, drop);
        else
            next = ownDrawn(corner, vertex, drop);
        mixIn(next, slide, index, drawn, before);
        if (withSlopes) {
            // Lighting also changes to that of the coarser mesh, interpolated between the same two of its vertices.
            mat2 nextSteps = slopes(corner, vertex, last, stepAt(corner, vertex), ofCoarser ? 2 : 1);
            if (index == 0) steps = nextSteps;
            if (index == 1) stepsBefore = nextSteps;
            if (index == 2) steps += slide.amount * (0.5 * (stepsBefore + nextSteps) - steps);
            if (index == 3) steps += slide.gathered * (nextSteps - steps);
        }
    } while (++index < count);
    vec3 up = drawn.up;
    vec3 position = drawn.position;
    float height = frame.baseHeightM + drawn.height * frame.quantumM;
    vec3 normal = up;
    float rough = 0.0;
    sunLit = skyLit = airLit = vec3(0.0);
    groundArriving = airArriving = vec4(0.0);
    steep = 0.0;
    if (withSlopes) {
        float stepsPerSlope = frame.quantumM / (float(1 << cellLog2()) * fineCell);
        vec2 heightSlope = vec2(steps[0].x, steps[1].x) * (stepsPerSlope * frame.reliefBoost);
        vec2 coordinates = drawn.place * fineCell - 1.0;
        normal = switchCube
                     ? fromFace(face, vec3(frame.cubeHalfM, -heightSlope))
                     : normalOnSphere(face, coordinates, up, frame.radiusM + height, heightSlope);
        normal *= inversesqrt(dot(normal, normal));
        float steepest = max(steps[0].y, steps[1].y) * stepsPerSlope / (0.75 * frame.radiusM);
        rough = smoothRise(0.0, 0.09, steepest);
        vec3 unitUp = normalize(up);
        lightGround(position, unitUp, height);
        if (switchLightByVertex) lightByVertex(position, unitUp, normal, height);
    }

    surface = position;
    facePlace = vec3(drawn.place * (0.5 * fineCell), height);
    imagePlace = facePlace.xy * (1.0 - shading.imageStep) + 0.5 * shading.imageStep;
    float aboveM = height - shading.seaLevelM;
    aboveSea = vec3(aboveM, aboveM * shading.earthRadii, aboveM * shading.perRampTopM);
    flooded = switchFlooded ? clamp(shading.seaLevelM * shading.earthRadii * (1.0 / 30.0), 0.0, 1.0) : 0.0;
    onFace = float(chunkFace);
    surfaceNormal = vec4(normal, rough);
    meshPlace = vec3(gridVertex, skirt);
    tint = chunkTint;
    meshLevel = float(int(chunkLevel) + frame.chunkCellsLog2 - 8);
    gl_Position = frame.clipFromWorld * vec4(position, 1.0);
}
