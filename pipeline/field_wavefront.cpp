#include "pipeline/field_wavefront.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace edgewise {
namespace {

using sdf::FieldRay, sdf::RayCounts, sdf::Shader, sdf::SurfaceHit, sdf::TravellingRay;

/// Notes which shadow rays are asked for, and says that nothing is lit.
class ShadowQuestions : public sdf::SurfaceTracer {
  public:
    SurfaceHit nearest(const FieldRay&, double) const override { return {}; }
    bool occluded(const FieldRay& ray, double sign, std::uint64_t&) const override {
        rays_.push_back({ray, sign});
        return true;
    }
    const std::vector<TravellingRay>& rays() const { return rays_; }

  private:
    mutable std::vector<TravellingRay> rays_;
};

/// The same questions in the same order, answered.
class ShadowAnswers : public sdf::SurfaceTracer {
  public:
    explicit ShadowAnswers(const char* first) : next_(first) {}
    SurfaceHit nearest(const FieldRay&, double) const override { return {}; }
    bool occluded(const FieldRay&, double, std::uint64_t&) const override {
        sight_ = sightWith(sight_, static_cast<std::uint32_t>(*next_));
        return *next_++ != 0;
    }
    /// Of the answers since it was last asked.
    std::uint32_t takeSight() const { return std::exchange(sight_, 0u); }

  private:
    mutable const char* next_;
    mutable std::uint32_t sight_ = 0;
};

/// Branches with their hits, and which of the first rays each belongs to.
struct Generation {
    std::vector<Shader::Branch> branches;
    std::vector<std::uint32_t> owners;
    std::span<const SurfaceHit> hits;  ///< the first rays', by owner; later ones', by branch
    std::vector<SurfaceHit> kept;      ///< the later ones'
    const SurfaceHit& hitOf(std::size_t i) const { return kept.empty() ? hits[owners[i]] : kept[i]; }
};

/// Neighbours in a generation, followed by one thread.
struct Part {
    std::size_t first, last;
    ShadowQuestions shadows;
    std::vector<Shader::Branch> next;
    std::vector<std::uint32_t> next_owners;
    RayCounts counts;
};
constexpr std::size_t kPart = 512;

std::vector<Part> partsOf(const Generation& g) {
    std::vector<Part> parts;
    for (std::size_t first = 0; first < g.branches.size(); first += kPart)
        parts.push_back({first, std::min(first + kPart, g.branches.size()), {}, {}, {}, {}});
    return parts;
}

/// Shadow rays of all parts, and where each part's begin.
struct ShadowBatch {
    std::vector<TravellingRay> rays;
    std::vector<std::size_t> begin;
    explicit ShadowBatch(const std::vector<Part>& parts) {
        for (const Part& part : parts) {
            begin.push_back(rays.size());
            rays.insert(rays.end(), part.shadows.rays().begin(), part.shadows.rays().end());
        }
    }
};

class Wavefront {
  public:
    Wavefront(const Shader& shader, RayBatches& batches, std::vector<glm::dvec4>& sums, RayCounts& counts,
              std::vector<std::uint32_t>* sights)
        : shader_(shader), batches_(batches), sums_(sums), counts_(counts), sights_(sights) {}

    Generation follow(const Generation& g) {
        std::vector<Part> parts = partsOf(g);
        eachPart(parts, [&](Part& part, std::size_t) { ask(g, part); });
        const ShadowBatch shadows(parts);
        const std::vector<char> answers = batches_.occluded(shadows.rays);
        std::vector<glm::dvec3> sent(g.branches.size());
        sight_of_.assign(g.branches.size(), 0u);
        eachPart(parts, [&](Part& part, std::size_t i) {
            send(g, part, ShadowAnswers(answers.data() + shadows.begin[i]), sent);
        });
        for (std::size_t i = 0; i < sent.size(); ++i) {
            sums_[g.owners[i]] += glm::dvec4(sent[i], 0.0);
            if (!sights_) continue;
            std::uint32_t& sight = (*sights_)[g.owners[i]];
            const SurfaceHit& hit = g.hitOf(i);
            sight = sightWith(sightWith(sight, sight_of_[i]), hit.hit ? hit.material + 1 : 0);
        }
        return nextOf(parts);
    }

  private:
    template <class Work>
    static void eachPart(std::vector<Part>& parts, const Work& work) {
        tbb::parallel_for(std::size_t(0), parts.size(), [&](std::size_t i) { work(parts[i], i); });
    }

    void ask(const Generation& g, Part& part) const {
        RayCounts unused;
        for (std::size_t i = part.first; i < part.last; ++i) {
            if (!g.hitOf(i).hit) continue;
            shader_.follow(g.branches[i], g.hitOf(i), part.shadows, part.next, unused);
            part.next_owners.resize(part.next.size(), g.owners[i]);
        }
    }
    void send(const Generation& g, Part& part, const ShadowAnswers& shadows, std::vector<glm::dvec3>& sent) {
        std::vector<Shader::Branch> unused;
        for (std::size_t i = part.first; i < part.last; ++i) {
            unused.clear();
            sent[i] = g.hitOf(i).hit ? shader_.follow(g.branches[i], g.hitOf(i), shadows, unused, part.counts)
                                     : g.branches[i].share * shader_.settings().background;
            sight_of_[i] = shadows.takeSight();
        }
    }

    Generation nextOf(const std::vector<Part>& parts) {
        Generation next;
        for (const Part& part : parts) {
            next.branches.insert(next.branches.end(), part.next.begin(), part.next.end());
            next.owners.insert(next.owners.end(), part.next_owners.begin(), part.next_owners.end());
            counts_ += part.counts;
        }
        std::vector<TravellingRay> rays;
        rays.reserve(next.branches.size());
        for (const Shader::Branch& branch : next.branches) rays.push_back(branch.way);
        if (!rays.empty()) next.kept = batches_.nearest(rays);
        return next;
    }

    const Shader& shader_;
    RayBatches& batches_;
    std::vector<glm::dvec4>& sums_;
    RayCounts& counts_;
    std::vector<std::uint32_t>* sights_;
    std::vector<std::uint32_t> sight_of_;  ///< of the generation's lights
};

}  // namespace

std::vector<glm::dvec4> shadeWavefront(const Shader& shader, RayBatches& batches,
                                       std::span<const TravellingRay> rays, std::span<const SurfaceHit> hits,
                                       RayCounts& counts, std::vector<std::uint32_t>* sights) {
    if (sights) sights->assign(rays.size(), 0u);
    std::vector<glm::dvec4> sums(rays.size(), glm::dvec4(shader.settings().background, 0.0));
    Generation g;
    g.hits = hits;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].hit) continue;
        sums[i] = {0.0, 0.0, 0.0, 1.0};
        g.owners.push_back(static_cast<std::uint32_t>(i));
    }
    g.branches.resize(g.owners.size());
    tbb::parallel_for(std::size_t(0), g.owners.size(), [&](std::size_t i) {
        const TravellingRay& ray = rays[g.owners[i]];
        g.branches[i] = shader.first(ray.ray, ray.sign);
        g.branches[i].way = ray;
    });
    Wavefront wavefront(shader, batches, sums, counts, sights);
    while (!g.branches.empty()) g = wavefront.follow(g);
    return sums;
}

}  // namespace edgewise
