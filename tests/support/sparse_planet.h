// A sparse planet, baked from a formula: leaves of level 5, and patches of leaves down to level 9 whose rims
// lie on edges of chunks of level 5. So chunks four levels deeper lie beside a coarse leaf: within a face,
// across an edge of a face, and at a corner of the cube.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <memory>

#include "planet/bake/bake.h"
#include "planet/format/chunk_file.h"
#include "planet/planet.h"
#include "planet/tree/chunk_tree.h"
#include "tests/support/sparse_source.h"
#include "tests/support/temporary_folder.h"

namespace planet::test {

constexpr double rimChunk = 2.0 / 32;  // side of a chunk of level 5 on the cube

// Mountains that are rough at the spacing of level 9, 38 m.
inline double roughM(const glm::dvec3& d) {
    return std::round(1500 * std::sin(7 * d.x + 1) * std::cos(6 * d.y - 2 * d.z) +
                      90 * std::sin(500 * d.x + 300 * d.z) * std::sin(450 * d.y - 350 * d.z) +
                      60 * std::sin(2100 * d.x + 900 * d.y) * std::sin(1900 * d.z - 1500 * d.y));
}

inline std::vector<FineBox> rimPatches(int cells) {
    const double a = rimChunk;
    return {{{4 * a, 2 * a, 1}, {4 * a + 0.02, 2 * a + 0.03, 1}, cells},     // its corner is one of level 5
            {{1 - 0.02, -3 * a, 1}, {1, -3 * a + 0.02, 1}, cells},           // up to the edge with +x
            {{1 - 0.015, 1 - 0.02, 1}, {1, 1, 1}, cells},                    // up to a corner of the cube
            {{-1, -1, -1}, {-1 + 0.02, -1 + 0.015, -1 + 0.02}, cells / 2}};  // around a corner
}

inline HeightSource rimSource() {
    constexpr int cells = 16 << 9;
    return sparse(formulaSource(roughM, -2000, 2000, 1, cells + 1), rimPatches(cells));
}

struct SparsePlanet {
    ::tests::TemporaryFolder folder;
    std::shared_ptr<const ChunkFile> file;

    SparsePlanet() {
        const BakeSettings settings{.chunkSize = 17, .radiusM = 2e5, .quantumM = 0.25};
        bake(rimSource(), settings, path()).value();
        file = std::make_shared<const ChunkFile>(ChunkFile::open(path()).value());
    }
    std::filesystem::path path() const { return folder / "sparse.chk"; }

    // Everything resident, each node in the slot of its own index.
    ChunkTree wholeTree() const {
        std::array<ChunkData, faceCount> roots;
        for (const Face face : allFaces) roots[static_cast<std::size_t>(face)] = file->readRoot(face).value();
        const ChunkFileInfo& info = file->info();
        ChunkTree tree = makeChunkTree(info.shape, info.minStep, info.maxStep, std::move(roots)).value();
        tree.allChunks = info.chunks;
        for (NodeIndex i = 0; i < tree.nodes.size(); ++i) {
            const ChunkNode& node = tree.nodes[i];
            if (node.childrenState == ChildrenState::None) continue;
            const auto next = static_cast<std::uint32_t>(tree.nodes.size());
            auto children = file->readChildren(node.id, node.children, *node.heights).value();
            addChildren(tree, i, std::move(children), {next, next + 1, next + 2, next + 3});
        }
        return tree;
    }
};

// One for all tests of a program.
inline const SparsePlanet& sparsePlanet() {
    static const SparsePlanet planet;
    return planet;
}

}  // namespace planet::test
