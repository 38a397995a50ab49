// The oracle's weights of many pixels of one scene: every side between two faces is integrated once.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "analytic/exact/kernel_weights.h"

namespace edgewise::test {

/// Faces and what is between them.
class PixelTruth {
  public:
    explicit PixelTruth(std::vector<exact::Face> faces) : faces_(std::move(faces)) {
        for (std::size_t f = 0; f < faces_.size(); ++f)
            for (const auto& cycle : faces_[f].cycles)
                for (std::size_t i = 0; i < cycle.size(); ++i)
                    addSide(f, cycle[i], cycle[(i + 1) % cycle.size()]);
    }

    /// Of every owner, the background included.
    std::map<Owner, exact::Weight> weights(const exact::KernelWeights& kernel,
                                           const exact::Point& sample) const {
        std::vector<bool> near;
        for (const exact::Face& face : faces_) near.push_back(reaches(face, sample, kernel.radius()));
        std::map<Owner, exact::Weight> weights;
        weights[kBackground].value = 1;
        for (const auto& [ends, sides] : sides_) {
            const bool left = sides.left && near[*sides.left], right = sides.right && near[*sides.right];
            if (!left && !right) continue;
            const exact::Weight w = kernel.ofEdge(ends.a, ends.b, sample);
            if (left) add(weights, faces_[*sides.left].owner, w, 1);
            if (right) add(weights, faces_[*sides.right].owner, w, -1);
        }
        return weights;
    }

    std::map<Owner, exact::Rational> boxWeights(const exact::Point& sample,
                                                const exact::Rational& radius) const {
        std::map<Owner, exact::Rational> weights;
        exact::Rational rest = 1;
        for (const exact::Face& face : faces_) {
            const exact::Rational w = exact::boxWeight(face, sample, radius);
            weights[face.owner] += w, rest -= w;
        }
        weights[kBackground] = rest;
        return weights;
    }

    const std::vector<exact::Face>& faces() const { return faces_; }

  private:
    /// a before b.
    struct Ends {
        exact::Point a, b;
        bool operator<(const Ends& o) const {
            return std::tie(a.x, a.y, b.x, b.y) < std::tie(o.a.x, o.a.y, o.b.x, o.b.y);
        }
    };
    /// Faces whose cycles run from a to b, and from b to a.
    struct Sides {
        std::optional<std::size_t> left, right;
    };

    void addSide(std::size_t face, const exact::Point& a, const exact::Point& b) {
        const bool forward = std::tie(a.x, a.y) < std::tie(b.x, b.y);
        Sides& sides = sides_[forward ? Ends{a, b} : Ends{b, a}];
        (forward ? sides.left : sides.right) = face;
    }

    static bool reaches(const exact::Face& face, const exact::Point& s, const exact::Rational& r) {
        return face.high.x > s.x - r && face.low.x < s.x + r && face.high.y > s.y - r && face.low.y < s.y + r;
    }

    static void add(std::map<Owner, exact::Weight>& weights, Owner owner, const exact::Weight& w, int sign) {
        weights[owner].value += sign * w.value, weights[owner].error += w.error;
        weights[kBackground].value -= sign * w.value, weights[kBackground].error += w.error;
    }

    std::vector<exact::Face> faces_;
    std::map<Ends, Sides> sides_;
};

}  // namespace edgewise::test
