// Errors of pictures of SDF scenes, by the kind of edge that crosses a pixel.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "pipeline/image_buffer.h"
#include "pipeline/judge/edge_kinds.h"

namespace edgewise::judge {

/// Over linear RGB, peak 1.
struct KindError {
    std::uint64_t pixels = 0;
    double squares = 0.0;  ///< summed over the pixels' three values
    double rmse() const;   ///< 0 without pixels
    /// dB; none without pixels or error.
    std::optional<double> psnr() const;
    KindError& operator+=(const KindError& other);
};

/// Kinds that have pixels; kNone: those without an edge.
struct KindErrors {
    std::map<EdgeKind, KindError> by_kind;
    KindError of(EdgeKind kind) const;
    KindError edges() const;  ///< all kinds but kNone
    KindErrors& operator+=(const KindErrors& other);
};

/// `image`: the reference's box or a part of it; `kinds`: by pixel of the reference.
KindErrors errorsByKind(const ImageBuffer& image, const ImageBuffer& reference,
                        const std::vector<EdgeKind>& kinds);

/// {edges, contour, ...: {pixels, rmse, psnr}}; `none` as "no_edge". And back: equal but for rounding.
nlohmann::ordered_json kindErrorsJson(const KindErrors& errors);
KindErrors kindErrorsFrom(const nlohmann::ordered_json& json);

}  // namespace edgewise::judge
