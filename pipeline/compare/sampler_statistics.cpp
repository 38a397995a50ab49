#include "pipeline/compare/sampler_statistics.h"

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

namespace edgewise::compare {
namespace {

constexpr int kBlockPx = 8;
constexpr std::size_t kFewestBlocks = 30;
constexpr double kNormal95 = 1.959963984540054;

struct Block {
    double sum = 0.0, pixels = 0.0;
};

std::vector<Block> blocksOf(std::span<const glm::dvec3> errors, int width) {
    const int height = static_cast<int>(errors.size()) / width;
    const int across = (width + kBlockPx - 1) / kBlockPx, down = (height + kBlockPx - 1) / kBlockPx;
    std::vector<Block> blocks(static_cast<std::size_t>(across) * down);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Block& block = blocks[static_cast<std::size_t>(y / kBlockPx) * across + x / kBlockPx];
            const glm::dvec3& e = errors[static_cast<std::size_t>(y) * width + x];
            block.sum += (e.x + e.y + e.z) / 3.0;
            block.pixels += 1.0;
        }
    return blocks;
}

}  // namespace

std::optional<FewEdgesError> fewEdgesError(std::span<const glm::dvec3> errors,
                                           std::span<const EdgeClass> classes) {
    FewEdgesError out;
    double squares = 0.0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        if (classes[i] != EdgeClass::kFew) continue;
        squares += glm::dot(errors[i], errors[i]);
        ++out.pixels;
    }
    if (out.pixels == 0) return {};
    out.rmse = std::sqrt(squares / (3.0 * static_cast<double>(out.pixels)));
    return out;
}

std::optional<double> biasHalfWidth(std::span<const glm::dvec3> errors, int width) {
    const std::vector<Block> blocks = blocksOf(errors, width);
    if (blocks.size() < kFewestBlocks) return {};
    double sum = 0.0, pixels = 0.0;
    for (const Block& b : blocks) sum += b.sum, pixels += b.pixels;
    const double mean = sum / pixels;
    double squares = 0.0;
    for (const Block& b : blocks) squares += (b.sum - mean * b.pixels) * (b.sum - mean * b.pixels);
    const auto n = static_cast<double>(blocks.size());
    return kNormal95 * std::sqrt(squares * n / (n - 1.0)) / pixels;
}

}  // namespace edgewise::compare
