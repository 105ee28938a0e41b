// The switches that programs are compiled for. A switch that is off costs nothing, even where a branch would
// not help. C++ has a bit and GLSL a constant bool (shader_prologue.h) of each name, both made from this
// table.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace planet::gl {

// clang-format off
#define PLANET_SHADER_SWITCHES(SWITCH)                                                            \
    SWITCH(switchLighting)       /* light from the sun and the sky; off: flat colours */          \
    SWITCH(switchFill)           /* the fill light on the night side */                           \
    SWITCH(switchLightByVertex)  /* light and air are computed at vertices: triangles are small */\
    SWITCH(switchAir)            /* an atmosphere in front of the ground */                       \
    SWITCH(switchPhysicalAir)    /* the physical atmosphere of air.glsl, not the analytic one */  \
    SWITCH(switchShadows)        /* the ground casts shadows on itself (shadows.glsl) */          \
    SWITCH(switchCube)           /* the unprojected cube */                                       \
    SWITCH(switchSlide)          /* some vertices morph or move onto a coarser neighbour's */     \
    SWITCH(switchMorph)          /* some vertices morph, and their light with them */             \
    SWITCH(switchGather)         /* morphing edges end where a coarser chunk's stitched edge is */\
    SWITCH(switchNormalTiles)    /* normals finer than the mesh (normal_tiles.glsl) */            \
    SWITCH(switchDetail)         /* procedural detail between the samples */                      \
    SWITCH(switchFineDetail)     /* its finest octave too */                                      \
    SWITCH(switchImage)          /* colours from an image or from tiles; off: the height ramp */  \
    SWITCH(switchTiles)          /* the image is streamed in tiles (colour_tiles.glsl) */         \
    SWITCH(switchClipmap)        /* the tiles are drawn from a clipmap (colour_clipmap.glsl) */   \
    SWITCH(switchMipmapsInTiles) /* the array of tiles also holds the mipmaps of the roots */     \
    SWITCH(switchRamp)           /* the ramp has stops of its own; off: the built-in ramp */      \
    SWITCH(switchImageOverRamp)  /* the image is translucent: the ramp shows through */           \
    SWITCH(switchLayers)         /* texture layers (layers.glsl) */                               \
    SWITCH(switchLayerPreview)   /* the weight of one layer over the picture */                   \
    SWITCH(switchSea)            /* ground below the sea level is sea */                          \
    SWITCH(switchFlooded)        /* the sea level is above 0, where an image shows dry ground */  \
    SWITCH(switchSeaSurface)     /* the sea is drawn at its level, as water (sea.glsl) */         \
    SWITCH(switchTint)           /* each chunk has a tint */                                      \
    SWITCH(switchWireframe)      /* the mesh's lines over a dimmed surface */                     \
    SWITCH(switchOutlines)       /* the chunks' borders */                                        \
    SWITCH(switchLoudSkirts)     /* skirts in one glaring colour */                               \
    SWITCH(switchAnisotropy)     /* samplers of tiles are anisotropic */                          \
    SWITCH(switchMultisampled)   /* pixels have several samples */                                \
    SWITCH(switchHeldFrame)      /* vertices hand on what shading reads of the frame */
// clang-format on

using Switches = std::uint32_t;  // bits of the switches that are on

#define PLANET_SWITCH_INDEX(name) name##Index,
enum SwitchIndex : unsigned { PLANET_SHADER_SWITCHES(PLANET_SWITCH_INDEX) switchCount };
#undef PLANET_SWITCH_INDEX

#define PLANET_SWITCH_BIT(name) inline constexpr Switches name = Switches{1} << name##Index;
PLANET_SHADER_SWITCHES(PLANET_SWITCH_BIT)
#undef PLANET_SWITCH_BIT

#define PLANET_SWITCH_NAME(name) #name,
inline constexpr std::array<std::string_view, switchCount> switchNames = {
    PLANET_SHADER_SWITCHES(PLANET_SWITCH_NAME)};
#undef PLANET_SWITCH_NAME

}  // namespace planet::gl
