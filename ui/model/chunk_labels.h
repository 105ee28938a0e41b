// Where the labels of chunks stand on a picture: each over its chunk's middle, none over another. A pure
// function.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/settings/view_settings.h"
#include "planet/select/lod_select.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"
#include "ui/model/layout.h"

namespace worldy::ui {

struct ChunkLabel {
    planet::ChunkId id;
    std::string text;  // "3", "1.5 px", "3: 1.5 px"
    glm::vec2 topLeft{0, 0};
    glm::vec2 size{0, 0};
};

struct ChunkLabelSettings {
    ChunkLabels show = ChunkLabels::Level;
    glm::vec2 areaPx{0, 0};     // of the picture on the screen, whatever the view's own size
    float gapPx = 4;            // between labels, and to the picture's border
    bool cube = false;          // the planet is drawn as the cube before it is blown up
    std::vector<Rect> taken{};  // of the picture, from its top left: no label lies there
};

using TextSize = std::function<glm::vec2(std::string_view)>;

// In pixels from the picture's top left, nearest first: near chunks get their labels before far ones, and
// those that have no room have none. Chunks whose middle lies behind the planet or outside the picture have
// none either; hills hide no label.
std::vector<ChunkLabel> chunkLabels(const planet::View& view, const planet::ChunkTree& tree,
                                    std::span<const planet::DrawItem> items,
                                    const ChunkLabelSettings& settings, const TextSize& textSize);

}  // namespace worldy::ui
