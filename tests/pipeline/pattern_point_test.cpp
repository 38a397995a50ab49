// Patterns on surfaces that lie on a boundary of their cells: the cells below show, whole, by every method.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "pipeline/field_rays.h"
#include "tests/pipeline/field_pictures.h"

namespace edgewise {
namespace {

using sdf::Kind, sdf::SurfaceMaterial;
using test::FieldPicture;

constexpr double kCell = 1.0;
constexpr double kMirrorZ = -4.0;

sdf::AnalyticShape planeOf(const glm::dvec3& normal, double offset, std::uint32_t material) {
    sdf::AnalyticShape plane;
    plane.type = sdf::AnalyticShape::Type::kPlane;
    plane.normal_world = normal, plane.offset = offset, plane.material = material;
    return plane;
}

/// From above, towards -z: a floor at y = 0 of that material 0; material 1 is a mirror that stands at
/// kMirrorZ, material 2 glass that bends nothing, a slab before the left half, which touches no floor: solids
/// are one where they meet.
FieldPicture floorPicture(SurfaceMaterial::Pattern pattern) {
    FieldPicture picture(96, 72);
    picture.camera.camera.yfov = 0.9;
    picture.camera.camera_from_world =
        glm::lookAt(glm::dvec3(0.1, 1.7, 3.2), glm::dvec3(0, 0.2, -1), {0, 1, 0});
    picture.camera.camera.world_from_camera = glm::inverse(picture.camera.camera_from_world);
    SurfaceMaterial floor = test::unlitWhite(), mirror, glass;
    floor.second_color = glm::dvec3(0.25);
    floor.pattern = pattern, floor.pattern_size = kCell, floor.pattern_axis = {0, 1, 0};
    mirror.reflectance = 1.0;
    glass.transmittance = 1.0, glass.ior = 1.0;
    picture.field->materials = {floor, mirror, glass};
    picture.field->analytic = {planeOf({0, 0, 1}, kMirrorZ, 1)};
    picture.field->far = 100.0;
    return picture;
}

std::uint32_t slab(sdf::Tree& tree) {
    const auto box = tree.add(Kind::kBox, {4, 3.9, 0.2}, {}, 2);
    return tree.add(Kind::kTranslate, {-2.1, 2.15, 0.3}, {box});
}

/// Where the film's point lies in the floor's cells, mirrors followed.
glm::dvec2 cellAt(const sdf::RayGrid& grid, const glm::dvec2& p_px) {
    const sdf::FieldRay ray = grid.ray(p_px);
    glm::dvec3 p = ray.origin_world, d = ray.direction_world;
    const auto down = [&] { return d.y < 0.0 ? -p.y / d.y : HUGE_VAL; };
    if (const double wall = (kMirrorZ - p.z) / d.z; wall > 0.0 && wall < down()) p += d * wall, d.z = -d.z;
    if (d.y >= 0.0) return glm::dvec2(NAN);
    p += d * down();
    return glm::floor(glm::dvec2(p.x, p.z) / kCell);
}

/// Pixels all of whose neighbourhood, 3 px to each side, shows one cell: a cell is convex, so the corners
/// tell. 11 rays reach 2 px, heights of hits over the floor at most another.
bool oneCell(const sdf::RayGrid& grid, int x, int y) {
    const glm::dvec2 cell = cellAt(grid, {x - 3, y - 3});
    for (const glm::dvec2 corner : {glm::dvec2(x + 4, y - 3), {x - 3, y + 4}, {x + 4, y + 4}})
        if (cellAt(grid, corner) != cell) return false;
    return true;
}

/// `level`: of the cells below the floor's surface, in the floor's frame.
void expectCells(FieldPicture& picture, int level, const char* what) {
    const sdf::RayGrid grid = rayGrid(picture.camera, picture.film, picture.field->far);
    const bool checker = picture.field->materials[0].pattern == SurfaceMaterial::Pattern::kChecker;
    for (const char* method : {"none", "sphere:threshold=1", "ssaa:2", "path:4", "lottes:grain=0"}) {
        const ImageBuffer image = picture.made(method).image;
        int counts[2] = {0, 0}, wrong = 0;
        for (int y = 0; y < picture.film.height; ++y)
            for (int x = 0; x < picture.film.width; ++x) {
                if (!oneCell(grid, x, y)) continue;
                const glm::dvec2 cell = cellAt(grid, {x, y});
                const bool second =
                    std::abs(std::fmod((checker ? cell.x + cell.y : level) + level, 2.0)) == 1.0;
                ++counts[second];
                wrong += std::abs(image.rgba[image.index(x, y)].r - (second ? 0.25 : 1.0)) > 1e-12;
            }
        EXPECT_GT(counts[0] + counts[1], 200) << what;
        EXPECT_GT(std::min(counts[0], counts[1]), checker ? 80 : -1) << what;
        EXPECT_EQ(wrong, 0) << what << " by " << method;
    }
}

TEST(PatternPoint, AFloorOnABoundaryShowsTheCellsBelowIt) {
    FieldPicture picture = floorPicture(SurfaceMaterial::Pattern::kChecker);
    sdf::Tree& tree = picture.field->tree;
    const auto box = tree.add(Kind::kBox, {60, 2, 60}, {}, 0);
    const auto floor = tree.add(Kind::kTranslate, {0, -1, 0}, {box});
    tree.root = tree.add(Kind::kUnion, {}, {floor, slab(tree)});
    expectCells(picture, 0, "a box whose top is at 1 of its frame");
}

TEST(PatternPoint, AnAnalyticFloorShowsTheCellsBelowIt) {
    FieldPicture picture = floorPicture(SurfaceMaterial::Pattern::kChecker);
    picture.field->analytic.push_back(planeOf({0, 1, 0}, 0.0, 0));
    picture.field->tree.root = slab(picture.field->tree);
    expectCells(picture, -1, "a plane at 0");
}

TEST(PatternPoint, StripesAcrossTheNormalShowOneColour) {
    FieldPicture picture = floorPicture(SurfaceMaterial::Pattern::kStripes);
    sdf::Tree& tree = picture.field->tree;
    tree.root = tree.add(Kind::kPlane, {0, 1, 0, 0}, {}, 0);
    // A stripe and its gap are a cell wide together: -1 is the uppermost below 0, and odd.
    const ImageBuffer image = picture.made("none").image;
    int wrong = 0;
    for (int y = 40; y < 72; ++y)
        for (int x = 0; x < 96; ++x) wrong += image.rgba[image.index(x, y)].r != 0.25;
    EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace edgewise
