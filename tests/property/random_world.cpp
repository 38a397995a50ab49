#include "tests/property/random_world.h"

#include <algorithm>
#include <cmath>

#include "tests/witness/dice.h"

namespace edgewise::property {
namespace {

using glm::dvec2;
using glm::vec3;

constexpr int kBoxPx = 6;
constexpr int kNodes = 3;
constexpr int kIngredients = 11;

/// The nearest float32 that is a multiple of `quantum`: at least 2^-30, so that it and the middle of two such
/// lie on the screen's grid.
float onGrid(double x, double quantum) {
    return static_cast<float>(std::nearbyint(x / quantum) * quantum);
}

class Maker {
  public:
    explicit Maker(std::uint64_t seed)
        : dice_(seed), centre_(dvec2(dice_.integer(-24, 24), dice_.integer(-24, 24)) * 0.125) {
        if (dice_.coin()) quantum_ = 0x1p-30;
        if (dice_.integer(0, 3) == 0) lens_ = Lens::kPerspective;
    }

    RandomWorld make() {
        triangles(dice_.integer(0, 3));
        for (int k = dice_.integer(2, 3); k > 0; --k) ingredient(dice_.integer(0, kIngredients - 1));
        if (made_.empty()) triangles(2);
        std::stable_sort(made_.begin(), made_.end(),
                         [](const WorldTriangle& a, const WorldTriangle& b) { return a.node < b.node; });
        const int x = kFilmPx / 2 + int(std::floor(centre_.x)), y = kFilmPx / 2 - int(std::floor(centre_.y));
        const int half = kBoxPx / 2;
        return {{std::move(made_), lens_}, {x - half, y - half, x + half, y + half}};
    }

  private:
    void ingredient(int kind) {
        switch (kind) {
            case 0:
                return triangles(4);
            case 1:
                return lattice();
            case 2:
                return slivers();
            case 3:
                return fan();
            case 4:
                return nearCoincident();
            case 5:
                return echoes();
            case 6:
                return decals();
            case 7:
                return corners();
            default:
                return extremes();
        }
    }

    /// Of 20 bits: the middle of two is a float32.
    float depth() { return onGrid(-dice_.uniform(0, 1), 0x1p-20); }
    int node() { return dice_.integer(0, kNodes - 1); }
    vec3 at(dvec2 p, float z) { return {onGrid(p.x, quantum_), onGrid(p.y, quantum_), z}; }
    vec3 near(dvec2 p, double reach) { return at(dice_.around(p, reach), depth()); }
    /// A sample, a pixel's corner or side, or a quarter of one.
    dvec2 special(int reach) {
        const dvec2 step(dice_.integer(-4 * reach, 4 * reach), dice_.integer(-4 * reach, 4 * reach));
        return glm::floor(centre_) + 0.25 * step;
    }
    void add(const vec3& a, const vec3& b, const vec3& c, int in) { made_.push_back({{a, b, c}, in}); }
    const WorldTriangle& any() {
        if (made_.empty()) triangles(1);
        return made_[std::size_t(dice_.integer(0, int(made_.size()) - 1))];
    }

    void triangles(int count) {
        for (; count > 0; --count) {
            const dvec2 p = dice_.around(centre_, 1.5);
            add(near(p, 2.5), near(p, 2.5), near(p, 2.5), node());
        }
    }

    /// Few positions and few depths: shared sides, T-junctions, ties, axis-parallel sides through samples.
    void lattice() {
        const int in = node();
        const bool one_plane = dice_.coin();
        for (int k = 0; k < 5; ++k) {
            std::array<vec3, 3> p;
            for (vec3& corner : p) {
                const dvec2 q = special(2);
                corner =
                    at(q, one_plane ? float(0.25 * q.x - 0.125 * q.y - 4) : -0.25f * dice_.integer(0, 2));
            }
            add(p[0], p[1], p[2], dice_.integer(0, 3) ? in : node());
        }
    }

    void slivers() {
        for (int k = 0; k < 4; ++k) {
            const dvec2 a = dice_.around(centre_, 2),
                        along = dice_.uniform(0.5, 6) * witness::unitVector(dice_.angle());
            const dvec2 across = dice_.magnitude(-8, -2) * dvec2(-along.y, along.x);
            add(at(a, depth()), at(a + along, depth()), at(a + dice_.uniform(0, 1) * along + across, depth()),
                node());
        }
    }

    void fan() {
        const dvec2 hub = special(1);
        const int wedges = dice_.integer(3, 7), in = node();
        const bool flat = dice_.coin();
        const float z = depth();
        std::vector<vec3> rim;
        for (int k = 0; k < wedges; ++k) {
            const double angle = 2 * std::numbers::pi * (k + dice_.uniform(0, 0.8)) / wedges;
            rim.push_back(at(hub + dice_.uniform(0.4, 3) * witness::unitVector(angle), flat ? z : depth()));
        }
        for (int k = 0; k < wedges; ++k)
            if (dice_.integer(0, 6)) add(at(hub, z), rim[k], rim[(k + 1) % wedges], in);
    }

    /// Planes through two corners that differ by 2^-30 to 2^-58: where both are 0, float32 holds that much.
    void nearCoincident() {
        const vec3 a = at(dice_.around(centre_, 2), 0), b = at(dice_.around(centre_, 2), 0),
                   c = near(centre_, 3);
        const auto nudge = [&] { return -std::ldexp(float(dice_.integer(0, 3)), -dice_.integer(30, 58)); };
        for (int k = 0; k < 4; ++k)
            add({a.x, a.y, k ? nudge() : 0}, {b.x, b.y, k ? nudge() : 0}, c,
                dice_.integer(0, 3) ? k % kNodes : 0);
    }

    /// Triangles that are there already once more, exactly or but for the last bit of a corner.
    void echoes() {
        for (int k = 0; k < 3; ++k) {
            WorldTriangle echo = any();
            if (dice_.coin()) std::swap(echo.p_world[1], echo.p_world[2]);
            if (dice_.coin()) echo.node = node();
            float& z = echo.p_world[std::size_t(dice_.integer(0, 2))].z;
            if (dice_.coin()) z = std::nextafter(z, -1.0f);
            made_.push_back(echo);
        }
    }

    /// Triangles on others: corners at quarters of theirs, in their plane wherever float32 has such a point.
    void decals() {
        for (int k = 0; k < 3; ++k) {
            const WorldTriangle on = any();
            std::array<vec3, 3> p;
            for (vec3& corner : p) corner = inside(on);
            add(p[0], p[1], p[2], dice_.integer(0, 3) ? on.node : node());
        }
    }

    vec3 inside(const WorldTriangle& t) {
        const int u = dice_.integer(0, 4), v = dice_.integer(0, 4 - u);
        const auto mix = [&](float a, float b, float c) {
            return 0.25 * ((4 - u - v) * double(a) + u * double(b) + v * double(c));
        };
        const auto& [a, b, c] = t.p_world;
        return at({mix(a.x, b.x, c.x), mix(a.y, b.y, c.y)}, float(mix(a.z, b.z, c.z)));
    }

    /// New triangles at the corners and in the sides of old ones.
    void corners() {
        for (int k = 0; k < 3; ++k) {
            const WorldTriangle t = any();
            const vec3 from = dice_.coin() ? t.p_world[0] : inside(t);
            add(from, dice_.coin() ? t.p_world[1] : near(centre_, 3), near(centre_, 3), t.node);
        }
    }

    void extremes() {
        for (int k = 0; k < 2; ++k) {
            const dvec2 through = dice_.around(centre_, 1.5);
            const double angle = dice_.angle();
            const auto far = [&](double turn) {
                return through + dice_.magnitude(2, 5.5) * witness::unitVector(angle + turn);
            };
            add(at(through, depth()), at(far(0), depth()), at(far(dice_.uniform(0.3, 2.9)), depth()), node());
            const dvec2 small = dice_.coin() ? special(1) : through;
            add(near(small, 1e-4), near(small, 1e-4), near(small, 1e-4), node());
        }
    }

    /// Bar k lies over bar k + 1 where its far end meets that one's near end.
    void ring() {
        const double start = dice_.angle(), radius = dice_.uniform(0.5, 1.5);
        const dvec2 middle = dice_.around(centre_, 1);
        for (int k = 0; k < 3; ++k) {
            const auto corner = [&](int i) {
                return middle + radius * witness::unitVector(start + 2 * std::numbers::pi * i / 3);
            };
            const dvec2 along = corner(k + 1) - corner(k), a = corner(k) - 0.4 * along,
                        b = corner(k + 1) + 0.4 * along;
            add(at(a, -0.75f), at(b, -0.5f),
                at(a + dice_.uniform(0.1, 0.3) * dvec2(along.y, -along.x), -0.75f), node());
        }
    }

    /// Sides along the axes, through samples or along pixels; both diagonals.
    void rectangles() {
        for (int k = 0; k < 2; ++k) {
            const dvec2 p = special(1), q = p + 0.5 * dvec2(dice_.integer(1, 5), dice_.integer(1, 5));
            const int in = node();
            const bool tilted = dice_.coin();
            const float z = -0.25f * dice_.integer(0, 3);
            const auto corner = [&](double x, double y) {
                return at({x, y}, tilted ? float(0.125 * x - 1.5) : z);
            };
            add(corner(p.x, p.y), corner(q.x, p.y), corner(q.x, q.y), in);
            add(corner(p.x, p.y), corner(q.x, q.y), corner(p.x, q.y), in);
            if (dice_.coin()) add(corner(q.x, p.y), corner(q.x, q.y), corner(p.x, q.y), in);
        }
    }

    witness::Dice dice_;
    dvec2 centre_;
    double quantum_ = 0x1p-18;
    Lens lens_ = Lens::kOrthographic;
    std::vector<WorldTriangle> made_;
};

}  // namespace

RandomWorld makeRandomWorld(std::uint64_t seed) {
    return Maker(seed * 1024 + 5).make();
}

}  // namespace edgewise::property
