// What Keinert et al. 2014 add to sphere tracing beside relaxation: level set, discontinuity reduction,
// dynamic epsilon, convex objects.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "sdf/evaluate.h"
#include "sdf/scene_trace.h"
#include "sdf/shader.h"
#include "trace_scenes.h"

namespace edgewise::sdf {
namespace {

constexpr std::array<Relaxation, 4> kAll{Relaxation::kNone, Relaxation::kKeinert, Relaxation::kBalint,
                                         Relaxation::kAuto};

glm::dvec3 pointAt(const FieldRay& ray, double t) {
    return ray.origin_world + ray.direction_world * t;
}

/// A unit ball in the middle of a picture whose pixels are seen at `slope` from 5 away: each ray's closest
/// approach to its centre says whether it meets the ball.
struct BallPicture {
    Tree tree;
    std::vector<FieldRay> rays;
    explicit BallPicture(int size) {
        tree.add(Kind::kSphere, {1.0});
        rays = pictureRays({"ball", {}, {0, 0, 5}, {0, 0, 0}}, size);
    }
    static double clearance(const FieldRay& ray) {
        return glm::length(glm::cross(ray.origin_world, ray.direction_world)) - 1.0;
    }
};

TEST(LevelSet, ASpheresOutlineIsNotInflated) {
    const BallPicture ball(256);
    const Tape tape = lower(ball.tree);
    for (const Relaxation relaxation : kAll) {
        TraceSettings plain, lifted;
        plain.relaxation = lifted.relaxation = relaxation;
        plain.threshold = lifted.threshold = 1.0;
        lifted.level_set = true;
        int inflated = 0, wrong = 0, thin = 0, annulus = 0;
        for (const FieldRay& ray : ball.rays) {
            const double pixel = ray.pixel_slope * 5.0, clearance = BallPicture::clearance(ray);
            // The sphere that a lifted distance allows is smaller by the lift's slope: so far may a ray that
            // passes outside still end; one that dips in by less than (pixel / 2)^2 may pass on one step.
            const double outside = pixel * ray.pixel_slope, inside = 0.25 * pixel * pixel;
            annulus += clearance > outside && clearance < 0.9 * pixel;
            inflated += clearance > outside && traceRay(tape, ray, plain).hit();
            const bool hit = traceRay(tape, ray, lifted).hit();
            wrong += hit ? clearance > outside : clearance < -inside;
            thin += clearance > -inside && clearance < outside;
        }
        std::printf("%d: %d pixels inflated of %d in the annulus, %d wrong with the level set\n",
                    static_cast<int>(relaxation), inflated, annulus, wrong);
        EXPECT_GE(inflated, annulus);
        EXPECT_GT(annulus, 150);
        EXPECT_EQ(wrong, 0);
        EXPECT_LT(thin, 20);
    }
}

/// Hits lie on f = 0 or within a pixel's radius behind it; one step of equation 3 is exact on what is flat.
TEST(LevelSet, HitsAreOnTheSurface) {
    for (const TraceScene& scene : traceScenes()) {
        const Tape tape = lower(scene.tree);
        TraceSettings settings;
        settings.threshold = 1.0, settings.level_set = true;
        int hits = 0;
        double front = 0.0, evened = 0.0;
        for (const FieldRay& ray : pictureRays(scene, 48)) {
            settings.discontinuity_steps = 0;
            const TraceHit hit = traceRay(tape, ray, settings);
            if (hit.end != TraceEnd::kSurface) continue;
            ++hits;
            const double pixel = ray.pixel_slope * hit.t, value = hit.value / tape.lipschitz;
            front = std::max(front, value / pixel);
            EXPECT_GE(value, -pixel * (1.0 + 1e-9)) << scene.name;
            settings.discontinuity_steps = 8;
            evened += std::abs(traceRay(tape, ray, settings).value / tape.lipschitz) / pixel;
        }
        std::printf("%-12s at most %.1e pixels in front, %.1e on average after 8 steps\n", scene.name.c_str(),
                    front, evened / hits);
        EXPECT_GT(hits, 300) << scene.name;
        EXPECT_LE(front, 0.828 / 48.0) << scene.name;  // threshold^2 times twice the pixel's slope
        EXPECT_LT(evened / hits, 0.05) << scene.name;
    }
}

struct Seen {
    bool hit = false, steep = false;
    double value = 0.0;  ///< f
    double off = 0.0;    ///< f less what is permitted there
    const Instruction* surface = nullptr;
};

Seen seenBy(const Tape& tape, const FieldRay& ray, const TraceSettings& settings) {
    const TraceHit hit = traceRay(tape, ray, settings);
    if (hit.end != TraceEnd::kSurface) return {};
    const glm::dvec3 p = pointAt(ray, hit.t);
    glm::dvec3 local;
    // Along the ray f falls by slope times cosine.
    const double falls = -glm::dot(gradientAt(tape, p).gradient, ray.direction_world) / tape.lipschitz;
    const double permitted = tape.lipschitz * settings.threshold * ray.pixel_slope * hit.t;
    return {true, falls >= 0.6, hit.value, hit.value - permitted, &winnerAt(tape, p, local)};
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

/// The medians of a quantity's jumps between neighbours of one surface, without and with three steps.
struct Jumps {
    std::vector<double> before, after;
    void add(double a, double b, double c, double d) {
        before.push_back(std::abs(a - b)), after.push_back(std::abs(c - d));
    }
    void add(const Jumps& more) {
        before.insert(before.end(), more.before.begin(), more.before.end());
        after.insert(after.end(), more.after.begin(), more.after.end());
    }
    double fall() const { return median(before) / median(after); }
};

/// Equation 3, whose step leaves 1 - slope cosine of what f is off. What is permitted itself changes along a
/// surface, so that where hits are already near, as on boxes, f cannot fall tenfold; what it is off by does.
TEST(DiscontinuityReduction, JumpsBetweenNeighboursFallTenfold) {
    constexpr int kSize = 96;
    Jumps all;
    for (const TraceScene& scene : traceScenes()) {
        const Tape tape = lower(scene.tree);
        std::array<std::vector<Seen>, 2> seen;
        for (const FieldRay& ray : pictureRays(scene, kSize))
            for (const int steps : {0, 3}) {
                TraceSettings settings;
                settings.threshold = 1.0, settings.discontinuity_steps = steps;
                seen[steps / 3].push_back(seenBy(tape, ray, settings));
            }
        Jumps value, off;
        for (int i = 0; i + kSize < kSize * kSize; ++i)
            for (const int j : {i + 1, i + kSize}) {
                const Seen &a = seen[0][i], &b = seen[0][j], &c = seen[1][i], &d = seen[1][j];
                const bool wraps = j == i + 1 && j % kSize == 0;
                if (wraps || !(a.steep && b.steep && c.hit && d.hit) || a.surface != b.surface) continue;
                value.add(a.value, b.value, c.value, d.value);
                off.add(a.off, b.off, c.off, d.off);
            }
        std::printf(
            "%-12s %5zu pairs, median jump of f %.2e, %.1f times less with 3 steps; of what it is off "
            "%.2e, %.1f times less\n",
            scene.name.c_str(), value.before.size(), median(value.before), value.fall(), median(off.before),
            off.fall());
        EXPECT_GT(value.before.size(), 500u) << scene.name;
        EXPECT_GE(off.fall(), 10.0) << scene.name;
        all.add(value);
    }
    std::printf("all: the median jump of f falls %.1f times\n", all.fall());
    EXPECT_GE(all.fall(), 10.0);
}

/// Counts rays that move away from a facet's plane and end on it. A ray has left the facet on whose normal,
/// through the hit, it begins. Beside an edge, where hits lie outside of two facets, some move back through
/// it.
class SelfMeetings : public SurfaceTracer {
  public:
    explicit SelfMeetings(const SceneTracer& tracer) : tracer_(tracer) {}
    SurfaceHit nearest(const FieldRay& ray, double sign) const override {
        const SurfaceHit hit = tracer_.nearest(ray, sign);
        ++rays;
        for (const SurfaceHit& left : hits) {
            const glm::dvec3 way = ray.origin_world - left.p_world;
            if (glm::length(glm::cross(way, left.normal_world)) > 1e-12) continue;
            ++known;
            const bool away =
                glm::dot(way, left.normal_world) * glm::dot(ray.direction_world, left.normal_world) > 0.0;
            back += !away;
            self += away && hit.hit && glm::dot(left.normal_world, hit.normal_world) > 1.0 - 1e-9;
            break;
        }
        if (hit.hit) hits.push_back(hit);
        return hit;
    }
    bool occluded(const FieldRay& ray, double sign, std::uint64_t& evaluations) const override {
        return tracer_.occluded(ray, sign, evaluations);
    }
    mutable std::vector<SurfaceHit> hits;  ///< of a pixel
    mutable int rays = 0, known = 0, self = 0, back = 0;

  private:
    const SceneTracer& tracer_;
};

FieldScene glassScene() {
    FieldScene scene;
    SurfaceMaterial glass;
    glass.reflectance = 0.1, glass.transmittance = 0.9, glass.ior = 1.5;
    scene.materials = {glass};
    const auto body = scene.tree.add(Kind::kDodecahedron, {1.0}, {}, 0);
    scene.tree.root = scene.tree.add(Kind::kRotate, {0.3, 1, 0.2, 25}, {body});
    return scene;
}

TEST(DynamicEpsilon, NoRayMeetsTheFacetThatItLeaves) {
    const FieldScene scene = glassScene();
    const Tape tape = lower(scene.tree);
    for (const bool dynamic : {false, true}) {
        TraceSettings settings;
        settings.threshold = 1.0, settings.dynamic_epsilon = dynamic;
        const SceneTracer tracer(scene, tape, settings);
        SelfMeetings spy(tracer);
        const Shader shader(shadingOf(scene, settings), spy);
        RayCounts rays;
        int primary = 0;
        for (const FieldRay& ray : pictureRays({"glass", {}, {0, 1, 4.5}, {0, 0, 0}}, 64)) {
            const SurfaceHit hit = tracer.nearest(ray, 1.0);
            primary += hit.hit;
            spy.hits = {hit};
            shader.shade(ray, hit, rays);
        }
        std::printf(
            "%s epsilon: %d of %d secondary rays end on the facet that they leave, %d go back through it\n",
            dynamic ? "dynamic" : "fixed", spy.self, spy.rays, spy.back);
        EXPECT_GT(primary, 500);
        EXPECT_GT(spy.rays, 2 * primary);
        EXPECT_EQ(spy.known, spy.rays);
        if (dynamic) {
            EXPECT_EQ(spy.self, 0);
            EXPECT_LT(spy.back, spy.rays / 100);
        } else {
            EXPECT_GT(spy.self, spy.rays / 10);
        }
    }
}

/// Section 3.5: from within, the ray that comes back from the bound meets what the ray through meets.
TEST(ConvexShortcut, FewerEvaluationsAndTheSameHits) {
    FieldScene scene = glassScene();
    scene.convex = ConvexBound{{0, 0, 0}, 1.26};  // the circumscribed sphere has radius 1.2584
    const Tape tape = lower(scene.tree);
    std::array<std::uint64_t, 2> evaluations{};
    std::array<std::vector<TraceHit>, 2> hits;
    constexpr unsigned kSeed = 31;
    for (const bool convex : {false, true}) {
        TraceSettings settings;
        settings.convex = convex;
        const SceneTracer tracer(scene, tape, settings);
        std::mt19937_64 random(kSeed);
        std::normal_distribution<double> normal;
        const auto direction = [&] {
            const double x = normal(random), y = normal(random), z = normal(random);
            return glm::normalize(glm::dvec3(x, y, z));
        };
        for (int i = 0; i < 4000; ++i) {
            const glm::dvec3 from = 0.9 * direction(), way = direction();
            const bool inside = i % 2 == 0;
            FieldRay ray{inside ? from : 4.0 * from, inside ? way : glm::normalize(0.9 * way - 4.0 * from)};
            ray.t_max = 30.0, ray.pixel_slope = 1e-5, ray.pixel_radius = 1e-5;
            hits[convex].push_back(tracer.traceField(ray, inside ? -1.0 : 1.0));
            evaluations[convex] += hits[convex].back().evaluations;
        }
    }
    double apart = 0.0;
    int through = 0;
    for (std::size_t i = 0; i < hits[0].size(); ++i) {
        ASSERT_EQ(hits[0][i].hit(), hits[1][i].hit()) << "ray " << i << " seed " << kSeed;
        if (!hits[0][i].hit()) continue;
        through += i % 2 == 0;
        apart = std::max(apart, std::abs(hits[0][i].t - hits[1][i].t));
    }
    const double fewer = double(evaluations[0]) / double(evaluations[1]);
    std::printf("%.2f times fewer evaluations, hits at most %.1e apart, %d from within\n", fewer, apart,
                through);
    EXPECT_EQ(through, 2000);
    EXPECT_GT(fewer, 1.05);
    EXPECT_LT(apart, 0.01);
}

}  // namespace
}  // namespace edgewise::sdf
