// Kinds of edges: one edge a picture, in a column that is known; then curves and lines whose place is known
// in closed form, asked at the lattice's own places.
#include "pipeline/judge/edge_kinds.h"

#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include "tests/pipeline/field_pictures.h"

namespace edgewise::judge {
namespace {

using sdf::Kind;

constexpr int kWidth = 16, kHeight = 4, kPerSide = 4;
constexpr int kColumn = kWidth / 2;  // begins at x = 0 of the world

struct OneEdge : test::FieldPicture {
    OneEdge() : FieldPicture(test::flatPicture(kWidth, kHeight)) {
        field->materials[0].color = glm::dvec3(1.0);
    }
    sdf::Tree& tree() { return field->tree; }
    std::uint32_t moved(std::uint32_t node, double x, double z) {
        return tree().add(Kind::kTranslate, {x, 0, z}, {node});
    }
    std::uint32_t box(double right, double front) {
        return moved(tree().add(Kind::kBox, {40, 40, 4}), right - 20, front - 2);
    }
    void root(std::uint32_t node) { tree().root = node; }
    /// Every row has the edge in that column, or none, and nothing else.
    void expectAlone(EdgeKind kind, int column) {
        const std::vector<EdgeKind> kinds = edgeKindsOf(input(), kPerSide);
        ASSERT_EQ(kinds.size(), static_cast<std::size_t>(kWidth * kHeight));
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                EXPECT_STREQ(nameOf(kinds[static_cast<std::size_t>(y * kWidth + x)]),
                             nameOf(x == column ? kind : EdgeKind::kNone))
                    << x << "," << y;
    }
};

TEST(EdgeKinds, ASurfaceEndsBeforeNothing) {
    OneEdge picture;
    picture.root(picture.box(0.3, 0.0));
    picture.expectAlone(EdgeKind::kContour, kColumn);
}

TEST(EdgeKinds, DepthLeaps) {
    OneEdge picture;
    const auto front = picture.box(0.3, 4.0), floor = picture.tree().add(Kind::kPlane, {0, 0, 1, -2});
    picture.root(picture.tree().add(Kind::kUnion, {}, {front, floor}));
    picture.field->materials[0] = test::unlitWhite();  // it throws no shadow
    picture.expectAlone(EdgeKind::kContour, kColumn);
}

/// Depths of one plane leap by twelve pixels a pixel, and are explained by it.
TEST(EdgeKinds, AGrazingPlaneHasNone) {
    OneEdge picture;
    picture.root(picture.tree().add(Kind::kPlane, {12, 0, 1, 0}));
    picture.field->far = 1e4;
    picture.expectAlone(EdgeKind::kNone, kColumn);
}

TEST(EdgeKinds, ASurfaceTurns) {
    OneEdge picture;
    const auto turned =
        picture.tree().add(Kind::kRotate, {0, 1, 0, 45}, {picture.tree().add(Kind::kBox, {60, 60, 60})});
    picture.root(picture.moved(turned, 0.3, -60 * std::sqrt(0.5)));
    picture.expectAlone(EdgeKind::kInternal, kColumn);
}

/// Between a pixel's last sub-sample and the next one's first: the former's.
TEST(EdgeKinds, APatternChanges) {
    OneEdge picture;
    picture.root(picture.tree().add(Kind::kPlane, {0, 0, 1, 0}));
    picture.field->materials[0].pattern = sdf::SurfaceMaterial::Pattern::kStripes;
    picture.field->materials[0].pattern_size = 100.0, picture.field->materials[0].pattern_axis = {1, 0, 0};
    picture.expectAlone(EdgeKind::kTexture, kColumn - 1);
}

/// Of a box beyond the picture, whose upper edge is at x = 12, z = 5.
TEST(EdgeKinds, AShadowBegins) {
    OneEdge picture;
    const auto caster = picture.moved(picture.tree().add(Kind::kBox, {20, 200, 1}), 22, 4.5),
               floor = picture.tree().add(Kind::kPlane, {0, 0, 1, 0});
    picture.root(picture.tree().add(Kind::kUnion, {}, {caster, floor}));
    sdf::SurfaceLight light;
    light.direction_world = glm::normalize(glm::dvec3(-(12.0 - 0.75) / 5.0, 0, -1));
    picture.field->lights = {light};
    picture.expectAlone(EdgeKind::kShadow, kColumn);
}

/// Bands of rows and a crop change nothing.
TEST(EdgeKinds, ACropHasTheKindsOfTheWhole) {
    const auto kindsOf = [](const PixelBox& crop) {
        OneEdge picture;
        picture.film = test::makeFilm(kWidth, 40);
        const auto ball = picture.moved(picture.tree().add(Kind::kSphere, {0.5}), 0.03, 0.0);
        const auto floor = picture.tree().add(Kind::kPlane, {0.2, 1, 0.4, -0.9});
        picture.root(picture.tree().add(Kind::kUnion, {}, {ball, floor}));
        picture.film.crop = crop;
        return edgeKindsOf(picture.input(), kPerSide);
    };
    const std::vector<EdgeKind> whole = kindsOf({0, 0, kWidth, 40}), part = kindsOf({0, 3, kWidth, 37});
    int met = 0;
    // The part's last row knows nothing of what lies below it.
    for (std::size_t i = 0; i + kWidth < part.size(); ++i) {
        EXPECT_EQ(part[i], whole[i + 3 * kWidth]) << i;
        met += part[i] != EdgeKind::kNone;
    }
    EXPECT_GT(met, 20);
}

/// How far outside the border a place of the world's x, y lies: px, at most so far.
using DistanceAt = std::function<double(const glm::dvec2& p_world)>;

constexpr int kFilm = 24;

/// A picture with a single border, and the same border in closed form.
struct Bordered : test::FieldPicture {
    Bordered() : FieldPicture(test::flatPicture(kFilm, kFilm)) { field->materials = {test::unlitWhite()}; }
    sdf::Tree& tree() { return field->tree; }
    std::uint32_t moved(std::uint32_t node, const glm::dvec3& by) {
        return tree().add(Kind::kTranslate, {by.x, by.y, by.z}, {node});
    }
    /// Around the line of sight.
    std::uint32_t turned(std::uint32_t node, double degrees) {
        return tree().add(Kind::kRotate, {0, 0, 1, degrees}, {node});
    }
    std::uint32_t united(std::uint32_t a, std::uint32_t b) { return tree().add(Kind::kUnion, {}, {a, b}); }
    void root(std::uint32_t node) { tree().root = node; }

    /// Hits lie up to the threshold, half a sample's side each, before their surface.
    double slack_px = 0.5 * sdf::TraceSettings().threshold / kPerSide;
};

class BorderWitness {
  public:
    BorderWitness(DistanceAt distance, double slack_px) : distance_(std::move(distance)), slack_(slack_px) {}

    /// Where it is sure of them: the kind where the lattice's neighbours lie on both sides.
    void expect(const std::vector<EdgeKind>& kinds, EdgeKind kind) {
        for (int y = 0; y < kFilm; ++y)
            for (int x = 0; x < kFilm; ++x) {
                const bool crossed = crosses(x, y, 0.0);
                if (crossed != crosses(x, y, slack_) || crossed != crosses(x, y, -slack_)) continue;
                ++sure_, crossed_ += crossed;
                EXPECT_STREQ(nameOf(kinds[static_cast<std::size_t>(y * kFilm + x)]),
                             nameOf(crossed ? kind : EdgeKind::kNone))
                    << x << "," << y;
            }
    }
    int crossed() const { return crossed_; }
    int sure() const { return sure_; }

  private:
    /// With the border moved outwards.
    bool crosses(int x, int y, double moved_px) const {
        const int last = kFilm * kPerSide - 1;
        const auto inside = [&](int i, int j) { return at(i, j) < moved_px; };
        for (int j = y * kPerSide; j < (y + 1) * kPerSide; ++j)
            for (int i = x * kPerSide; i < (x + 1) * kPerSide; ++i)
                if ((i < last && inside(i, j) != inside(i + 1, j)) ||
                    (j < last && inside(i, j) != inside(i, j + 1)))
                    return true;
        return false;
    }
    double at(int i, int j) const {
        return distance_({(i + 0.5) / kPerSide - 0.5 * kFilm, 0.5 * kFilm - (j + 0.5) / kPerSide});
    }

    DistanceAt distance_;
    double slack_;
    int sure_ = 0, crossed_ = 0;
};

/// Borders at random places: each makes its picture and says where its border is.
void expectBorders(EdgeKind kind, const std::function<DistanceAt(std::mt19937&, Bordered&)>& make) {
    constexpr unsigned kSeed = 20261128;
    int crossed = 0, sure = 0;
    for (unsigned seed = kSeed; seed < kSeed + 6; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        Bordered picture;
        const DistanceAt distance = make(random, picture);
        BorderWitness witness(distance, picture.slack_px);
        witness.expect(edgeKindsOf(picture.input(), kPerSide), kind);
        crossed += witness.crossed(), sure += witness.sure();
    }
    EXPECT_GT(crossed, 6 * kFilm / 2) << "too few edges were met";
    EXPECT_GT(sure, 6 * kFilm * kFilm * 9 / 10);
}

double within(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
}

/// The line n . p = offset.
DistanceAt lineAt(double degrees, double offset) {
    const glm::dvec2 n(std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)));
    return [n, offset](const glm::dvec2& p) { return glm::dot(n, p) - offset; };
}

TEST(EdgeKindsWitness, ADiskHasContoursAlone) {
    expectBorders(EdgeKind::kContour, [](std::mt19937& random, Bordered& picture) -> DistanceAt {
        const double radius = within(random, 8.5, 11.0);
        const glm::dvec2 middle(within(random, -1, 1), within(random, -1, 1));
        picture.root(picture.moved(picture.tree().add(Kind::kSphere, {radius}), {middle, 0.0}));
        return [=](const glm::dvec2& p) { return glm::length(p - middle) - radius; };
    });
}

TEST(EdgeKindsWitness, ACheckerHasTexturesAlone) {
    expectBorders(EdgeKind::kTexture, [](std::mt19937& random, Bordered& picture) -> DistanceAt {
        const double size = within(random, 4.0, 7.0);
        const glm::dvec2 corner(within(random, 0, size), within(random, 0, size));
        auto& material = picture.field->materials[0];
        picture.slack_px = 1e-3;  // hits move along the line of sight alone
        material.pattern = sdf::SurfaceMaterial::Pattern::kChecker, material.pattern_size = size;
        picture.root(picture.moved(picture.tree().add(Kind::kPlane, {0, 0, 1, 0}), {corner, 0.0}));
        return [=](const glm::dvec2& p) {
            const glm::dvec2 cell = (p - corner) / size, off = size * glm::abs(cell - glm::round(cell));
            const glm::dvec2 at = glm::floor(cell);
            return std::fmod(std::abs(at.x + at.y), 2.0) == 1.0 ? -std::min(off.x, off.y)
                                                                : std::min(off.x, off.y);
        };
    });
}

TEST(EdgeKindsWitness, ABoxHasInternalEdgesAlone) {
    expectBorders(EdgeKind::kInternal, [](std::mt19937& random, Bordered& picture) {
        constexpr double kSide = 60;
        const double angle = within(random, 0, 360), offset = within(random, -4, 4);
        const auto box = picture.tree().add(Kind::kRotate, {0, 1, 0, 45},
                                            {picture.tree().add(Kind::kBox, {kSide, kSide, kSide})});
        picture.root(picture.turned(picture.moved(box, {offset, 0, -kSide * std::sqrt(0.5)}), angle));
        return lineAt(angle, offset);
    });
}

/// Of a ball beside the film, by a lamp: a place is dark where its way to the lamp meets the ball.
TEST(EdgeKindsWitness, ALampsShadowHasShadowsAlone) {
    expectBorders(EdgeKind::kShadow, [](std::mt19937& random, Bordered& picture) -> DistanceAt {
        const double radius = within(random, 2.5, 3.5);
        const glm::dvec3 ball(20.0, within(random, -1, 1), within(random, 19, 20)), lamp(40, 0, 40);
        picture.field->materials[0] = {};
        picture.field->materials[0].color = glm::dvec3(1.0);
        sdf::SurfaceLight light;
        light.type = sdf::SurfaceLight::Type::kPoint;
        light.position_world = lamp, light.intensity = 1e4;
        picture.field->lights = {light};
        // A shadow's ray is as wide at the ball, 28 away, as at 28 from the camera, which is 10 above the
        // floor; on the floor that is twice as much. It begins up to two thresholds above the floor.
        picture.slack_px *= 2.0 * 28.0 / 10.0 + 2.0;
        picture.root(picture.united(picture.moved(picture.tree().add(Kind::kSphere, {radius}), ball),
                                    picture.tree().add(Kind::kPlane, {0, 0, 1, 0})));
        return [=](const glm::dvec2& p) {
            const glm::dvec3 from(p, 0.0), way = glm::normalize(lamp - from);
            // The lamp is twice as far from the floor as from the ball.
            return 2.0 * (glm::length(glm::cross(ball - from, way)) - radius);
        };
    });
}

/// What a mirror shows lies behind the camera.
TEST(EdgeKindsWitness, AMirrorShowsReflectionsAlone) {
    expectBorders(EdgeKind::kReflection, [](std::mt19937& random, Bordered& picture) {
        const double angle = within(random, 0, 360), offset = within(random, -4, 4);
        picture.slack_px *= 28.0 / 10.0;  // as the lamp's
        sdf::SurfaceMaterial mirror;
        mirror.reflectance = 1.0;
        picture.field->materials = {mirror, test::unlitWhite()};
        const auto box = picture.tree().add(Kind::kBox, {60, 80, 4}, {}, 1);
        const auto shown = picture.turned(picture.moved(box, {offset - 30, 0, 30}), angle);
        picture.root(picture.united(picture.tree().add(Kind::kPlane, {0, 0, 1, 0}, {}, 0), shown));
        return lineAt(angle, offset);
    });
}

}  // namespace
}  // namespace edgewise::judge
