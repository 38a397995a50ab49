// Kinds of edges: one edge a picture, in a column that is known.
#include "pipeline/judge/edge_kinds.h"

#include <cmath>

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

}  // namespace
}  // namespace edgewise::judge
