#include "tests/studies/term_bounds/truth.h"

namespace edgewise::study {
namespace {

exact::Point pointOf(glm::dvec2 p) {
    return {exact::Rational(p.x), exact::Rational(p.y)};
}
const exact::Point kOrigin{0, 0};

}  // namespace

exact::Real Judge::kept(const exact::Weight& weight) const {
    reported_ = static_cast<double>(weight.error);
    return weight.value;
}

exact::Real Judge::total(const Edge& edge) const {
    return kept(weights_.ofEdge(pointOf(edge.a), pointOf(edge.b), kOrigin));
}

exact::Real Judge::piece(const Edge& edge, double t1, double t2) const {
    return kept(weights_.ofPiece(pointOf(edge.a), pointOf(edge.b), kOrigin, t1, t2));
}

exact::Real Judge::position(glm::dvec2 p) const {
    return kept(weights_.position(pointOf(p), kOrigin));
}

}  // namespace edgewise::study
