// Lines on the film against closed forms, columns of the square, and points of the edges themselves.
#include "sdf/film_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace edgewise::sdf {
namespace {

constexpr unsigned kSeed = 20234;
constexpr double kEpsilon = 0x1p-52;

std::mt19937 seeded() {
    std::printf("seed %u\n", kSeed);
    return std::mt19937(kSeed);
}

glm::dvec3 randomVector(std::mt19937& random, double size) {
    std::uniform_real_distribution<> number(-size, size);
    return {number(random), number(random), number(random)};
}

FilmLine randomLine(std::mt19937& random, const glm::dvec2& centre, double reach) {
    std::uniform_real_distribution<> turn(0.0, 2.0 * std::acos(-1.0)), offset(-reach, reach);
    const double angle = turn(random);
    const glm::dvec2 n(std::cos(angle), std::sin(angle));
    return {n.x, n.y, offset(random) - glm::dot(n, centre)};
}

/// Inclusion and exclusion of the corners' triangles: of [0,1]^2 where a x + b y <= c, for a, b > 0.
double halfPlaneOfSquare(double a, double b, double c) {
    const auto triangle = [&](double s) { return s > 0.0 ? s * s / (2.0 * a * b) : 0.0; };
    return triangle(c) - triangle(c - a) - triangle(c - b) + triangle(c - a - b);
}

TEST(FilmLine, HalfASquareIsItsClosedForm) {
    std::mt19937 random = seeded();
    int cut = 0;
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec2 centre(40.5, 17.5);
        const FilmLine line = randomLine(random, centre, 0.9);
        const double a = std::abs(line.a), b = std::abs(line.b);
        if (std::min(a, b) < 1e-3) continue;  // the form divides by both
        const double exact = halfPlaneOfSquare(a, b, 0.5 * (a + b) - line.at(centre));
        const double area = areaOf(squareWithin(centre, {&line, 1}));
        cut += exact > 0.0 && exact < 1.0;
        // The form loses the square's own size over 2 a b; positions lose 64 px.
        EXPECT_NEAR(area, exact, 8.0 * kEpsilon * (64.0 + 1.0 / (a * b)));
    }
    EXPECT_GT(cut, 2000);
}

TEST(FilmLine, PartsBetweenLinesAreTheirColumns) {
    constexpr int kColumns = 2048;
    std::mt19937 random = seeded();
    int empty = 0, inner = 0;
    for (int round = 0; round < 300; ++round) {
        const glm::dvec2 centre(3.5, 8.5);
        const int count = 2 + round % 2;
        std::vector<FilmLine> lines;
        for (int i = 0; i < count; ++i) lines.push_back(randomLine(random, centre, 0.5));
        double area = 0.0;
        glm::dvec2 moment(0.0);
        for (int i = 0; i < kColumns; ++i) {
            const double x = centre.x - 0.5 + (i + 0.5) / kColumns;
            double low = centre.y - 0.5, high = centre.y + 0.5;
            for (const FilmLine& line : lines) {
                const double y = -(line.a * x + line.c) / line.b;
                (line.b > 0.0 ? high : low) = line.b > 0.0 ? std::min(high, y) : std::max(low, y);
            }
            const double height = std::max(high - low, 0.0) / kColumns;
            area += height, moment += height * glm::dvec2(x, 0.5 * (low + high));
        }
        const std::vector<glm::dvec2> part = squareWithin(centre, lines);
        // A convex part's height rises once by at most 1 and falls once: columns are off by its variation
        // times half a column.
        constexpr double kColumnError = 2.0 * 0.5 / kColumns;
        EXPECT_NEAR(areaOf(part), area, kColumnError);
        empty += part.empty(), inner += area > 0.1 && area < 0.9;
        if (area < 0.05) continue;
        const glm::dvec2 middle = centroidOf(part);
        // Of the moment about the middle as of the area, and about the mean of both.
        EXPECT_NEAR(middle.x, moment.x / area, 3.0 * kColumnError / area);
        EXPECT_NEAR(middle.y, moment.y / area, 3.0 * kColumnError / area);
    }
    EXPECT_GT(empty, 10);
    EXPECT_GT(inner, 100);
}

RayGrid randomGrid(std::mt19937& random, bool perspective) {
    RayGrid grid;
    grid.perspective = perspective;
    grid.axis_world = glm::normalize(randomVector(random, 1.0));
    const glm::dvec3 right = glm::normalize(glm::cross(grid.axis_world, randomVector(random, 1.0)));
    const double pixel = perspective ? 1.0 / 64.0 : 0.05;
    grid.right_world = pixel * right, grid.down_world = pixel * glm::cross(grid.axis_world, right);
    grid.eye_world = randomVector(random, 3.0);
    const glm::dvec3 middle = perspective ? grid.axis_world : grid.eye_world;
    grid.corner_world = middle - 32.0 * (grid.right_world + grid.down_world);
    return grid;
}

/// A point in front, seen somewhere on 64 x 64 pixels.
glm::dvec3 pointBefore(const RayGrid& grid, std::mt19937& random) {
    std::uniform_real_distribution<> on_film(0.0, 64.0), depth(2.0, 9.0);
    const FieldRay ray = grid.ray({on_film(random), on_film(random)});
    return ray.origin_world + ray.direction_world * depth(random);
}

TEST(FilmLine, APointIsSeenWhereItsRayIs) {
    std::mt19937 random = seeded();
    for (int i = 0; i < 2000; ++i) {
        const RayGrid grid = randomGrid(random, i % 2 == 0);
        std::uniform_real_distribution<> on_film(0.0, 64.0);
        const glm::dvec2 q(on_film(random), on_film(random));
        const FieldRay ray = grid.ray(q);
        // Some ten roundings of coordinates up to 16 in pixels of 1/64.
        EXPECT_LE(glm::distance(filmPosition(grid, ray.origin_world + 4.0 * ray.direction_world), q),
                  16.0 * kEpsilon * 16.0 * 64.0);
    }
}

/// Points of the planes' common line are on the film's line.
TEST(FilmLine, ACreaseIsWhereBothPlanesAre) {
    std::mt19937 random = seeded();
    std::uniform_real_distribution<> along(-0.5, 0.5);
    double worst = 0.0;
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
        const RayGrid grid = randomGrid(random, i % 2 == 0);
        const glm::dvec3 n = glm::normalize(randomVector(random, 1.0)),
                         m = glm::normalize(randomVector(random, 1.0));
        const glm::dvec3 direction = glm::cross(n, m);
        if (glm::length(direction) < 0.1) continue;
        const glm::dvec3 common = pointBefore(grid, random);
        // Somewhere else on either plane.
        const glm::dvec3 p = common + glm::cross(n, randomVector(random, 1.0)),
                         q = common + glm::cross(m, randomVector(random, 1.0));
        const auto line = crease(grid, p, n, q, m);
        ASSERT_TRUE(line);
        const glm::dvec3 on_it = common + along(random) * direction;
        const double depth = glm::dot(on_it - grid.eye_world, grid.axis_world);
        if (grid.perspective && depth < 1.0) continue;
        // The line is as sharp as the eye's distance from the planes, or their fall along the view, is large.
        const double e = grid.perspective
                             ? std::hypot(glm::dot(grid.eye_world - p, n), glm::dot(grid.eye_world - q, m))
                             : std::hypot(glm::dot(grid.axis_world, n), glm::dot(grid.axis_world, m));
        if (e < 0.1) continue;
        const double off = std::abs(line->at(filmPosition(grid, on_it)));
        worst = std::max(worst, off), ++met;
        EXPECT_LE(off, 64.0 * kEpsilon * 16.0 * 64.0 / (0.1 * 0.1));
    }
    std::printf("%d lines, off by at most %.2e px\n", met, worst);
    EXPECT_GT(met, 1000);
    const RayGrid grid = randomGrid(random, true);
    const glm::dvec3 n(0.0, 0.0, 1.0), p = pointBefore(grid, random);
    EXPECT_FALSE(crease(grid, p, n, p, n)) << "parallel planes";
}

/// A straight edge, touched by the ray that passes its nearest point at a right angle.
TEST(FilmLine, AnOutlineIsItsStraightEdge) {
    std::mt19937 random = seeded();
    std::uniform_real_distribution<> along(-0.5, 0.5), away(0.1, 1.0);
    double worst_flat = 0.0, worst_deep = 0.0;
    int met = 0;
    for (int i = 0; i < 4000; ++i) {
        const RayGrid grid = randomGrid(random, i % 2 == 0);
        const glm::dvec3 edge = pointBefore(grid, random);
        const glm::dvec3 view = grid.perspective ? glm::normalize(edge - grid.eye_world) : grid.axis_world;
        const glm::dvec3 direction = glm::normalize(randomVector(random, 1.0));
        const double sine = glm::length(glm::cross(direction, view));
        if (sine < 0.3) continue;
        const double t = glm::distance(edge, grid.eye_world);
        // The ray past it: at a right angle to what leads out, up to a pixel away.
        const double pixel = 2.0 * grid.halfPixel() * (grid.perspective ? t : 1.0);
        const double distance = away(random) * pixel;
        glm::dvec3 ray = view, out = glm::normalize(glm::cross(direction, ray));
        for (int k = 0; k < 8 && grid.perspective; ++k) {
            ray = glm::normalize(edge + distance * out - grid.eye_world);
            out = glm::normalize(glm::cross(direction, ray));
        }
        const auto line = outline(grid, edge, out);
        ASSERT_TRUE(line);
        ++met;
        const glm::dvec2 from = filmPosition(grid, edge);
        EXPECT_LE(std::abs(line->at(from)), 1e3 * kEpsilon * 64.0 / sine);
        EXPECT_GT(line->at(filmPosition(grid, edge + distance * out)), 0.0);
        // Half a pixel along the edge.
        const glm::dvec2 to = filmPosition(grid, edge + 0.5 * pixel / sine * direction);
        const double off = std::abs(line->at(to));
        double& worst = grid.perspective ? worst_deep : worst_flat;
        worst = std::max(worst, off);
        if (grid.perspective) {
            // What leads out is at a right angle to the ray, not to the view of the edge: they differ by
            // distance / t, which turns the line by that times the edge's slope towards the eye. The film is
            // aslant of the view by up to half its width: a cosine of sqrt(1.5).
            const double slope = std::abs(glm::dot(direction, view)) / sine;
            const double widened = glm::distance(from, to);
            EXPECT_LE(off, (1.0 + distance / t) * std::sqrt(1.5) * widened * slope * distance / t + 1e-10);
        } else {
            EXPECT_LE(off, 1e3 * kEpsilon * 64.0 / sine);
        }
    }
    std::printf("%d edges, half a pixel along them off by at most %.1e px flat, %.1e in perspective\n", met,
                worst_flat, worst_deep);
    EXPECT_GT(met, 1000);
    EXPECT_FALSE(outline(randomGrid(random, false), {0, 0, 0}, {0, 0, 0}));
}

/// Halving again and again loses nothing, and a point is in the half that its side of the line says.
TEST(FilmLine, HalvesOfPolygonsHoldTheirPoints) {
    std::mt19937 random = seeded();
    const glm::dvec2 centre(12.5, 700.5);
    std::uniform_real_distribution<> place(-0.5, 0.5);
    int cut = 0, asked = 0;
    for (int round = 0; round < 500; ++round) {
        std::vector<glm::dvec2> polygon = squareWithin(centre, {});
        for (int k = 0; k < 4; ++k) {
            const FilmLine line = randomLine(random, centre, 0.4);
            const std::vector<glm::dvec2> inner = within(polygon, line),
                                          outer = within(polygon, line.reversed());
            EXPECT_NEAR(areaOf(inner) + areaOf(outer), areaOf(polygon), 64.0 * 700.0 * kEpsilon);
            const glm::dvec2 p = centre + glm::dvec2(place(random), place(random));
            const double side = line.at(p);
            if (holds(polygon, p) && std::abs(side) > 1e-9) {
                ++asked;
                EXPECT_EQ(holds(inner, p), side < 0.0);
                EXPECT_EQ(holds(outer, p), side > 0.0);
            }
            cut += areaOf(inner) > 0.0 && areaOf(outer) > 0.0;
            polygon = areaOf(inner) > areaOf(outer) ? inner : outer;
        }
    }
    EXPECT_GT(cut, 500);
    EXPECT_GT(asked, 500);
}

}  // namespace
}  // namespace edgewise::sdf
