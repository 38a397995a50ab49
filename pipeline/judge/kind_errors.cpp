#include "pipeline/judge/kind_errors.h"

#include <cmath>
#include <string>

namespace edgewise::judge {
namespace {

using Json = nlohmann::ordered_json;

std::string keyOf(EdgeKind kind) {
    return kind == EdgeKind::kNone ? "no_edge" : nameOf(kind);
}

Json errorJson(const KindError& error) {
    const std::optional<double> psnr = error.psnr();
    return {{"pixels", error.pixels}, {"rmse", error.rmse()}, {"psnr", psnr ? Json(*psnr) : Json()}};
}

}  // namespace

double KindError::rmse() const {
    return pixels == 0 ? 0.0 : std::sqrt(squares / (3.0 * static_cast<double>(pixels)));
}

std::optional<double> KindError::psnr() const {
    if (squares == 0.0) return std::nullopt;
    return -20.0 * std::log10(rmse());
}

KindError& KindError::operator+=(const KindError& other) {
    pixels += other.pixels, squares += other.squares;
    return *this;
}

KindError KindErrors::of(EdgeKind kind) const {
    const auto found = by_kind.find(kind);
    return found == by_kind.end() ? KindError() : found->second;
}

KindError KindErrors::edges() const {
    KindError all;
    for (const EdgeKind kind : kEdgeKinds) all += of(kind);
    return all;
}

KindErrors& KindErrors::operator+=(const KindErrors& other) {
    for (const auto& [kind, error] : other.by_kind) by_kind[kind] += error;
    return *this;
}

KindErrors errorsByKind(const ImageBuffer& image, const ImageBuffer& reference,
                        const std::vector<EdgeKind>& kinds) {
    KindErrors errors;
    for (int y = image.box.y0; y < image.box.y1; ++y)
        for (int x = image.box.x0; x < image.box.x1; ++x) {
            const std::size_t at = reference.index(x, y);
            const glm::dvec3 d(image.rgba[image.index(x, y)] - reference.rgba[at]);
            errors.by_kind[kinds[at]] += {1, glm::dot(d, d)};
        }
    return errors;
}

Json kindErrorsJson(const KindErrors& errors) {
    Json json{{"edges", errorJson(errors.edges())}};
    for (const EdgeKind kind : kEdgeKinds) json[keyOf(kind)] = errorJson(errors.of(kind));
    json[keyOf(EdgeKind::kNone)] = errorJson(errors.of(EdgeKind::kNone));
    return json;
}

KindErrors kindErrorsFrom(const Json& json) {
    KindErrors errors;
    const auto take = [&](EdgeKind kind) {
        const Json& one = json.at(keyOf(kind));
        const double rmse = one.at("rmse");
        const std::uint64_t pixels = one.at("pixels");
        if (pixels > 0) errors.by_kind[kind] = {pixels, 3.0 * static_cast<double>(pixels) * rmse * rmse};
    };
    for (const EdgeKind kind : kEdgeKinds) take(kind);
    take(EdgeKind::kNone);
    return errors;
}

}  // namespace edgewise::judge
