// Places chunk labels on a picture: each is centred on its chunk's middle, and none overlap. A pure function.
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
    glm::vec2 areaPx{0, 0};     // size of the picture on the screen, which may differ from the view's
    float gapPx = 4;            // between labels, and to the picture's border
    bool cube = false;          // the planet is drawn as the unprojected cube
    std::vector<Rect> taken{};  // rectangles without labels, from the picture's top left
};

using TextSize = std::function<glm::vec2(std::string_view)>;

// Returns the labels in pixels from the picture's top left, nearest chunk first. Nearer chunks take
// precedence; a label without room is left out. Chunks whose middle is behind the planet or outside the
// picture have no label. Hills do not hide labels.
std::vector<ChunkLabel> chunkLabels(const planet::View& view, const planet::ChunkTree& tree,
                                    std::span<const planet::DrawItem> items,
                                    const ChunkLabelSettings& settings, const TextSize& textSize);

}  // namespace worldy::ui
