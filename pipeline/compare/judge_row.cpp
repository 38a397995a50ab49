#include "pipeline/compare/judge_row.h"

#include "pipeline/compare/sampler_statistics.h"

namespace edgewise::compare {

void judgeRow(Row& row, const ImageBuffer& picture, const ReferencePicture& reference) {
    row.error = judge::compareImages(picture, reference.picture);
    const std::vector<glm::dvec3> errors = judge::signedErrors(picture, reference.picture);
    row.bias_half_width = biasHalfWidth(errors, reference.picture.box.width());
    if (!reference.kinds.empty())
        row.kinds = judge::errorsByKind(picture, reference.picture, reference.kinds);
    if (!reference.edges.empty()) row.few_edges = fewEdgesError(errors, reference.edges);
}

}  // namespace edgewise::compare
