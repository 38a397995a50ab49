// A shipped scene, projected and ready to be shaded.
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "pipeline/project.h"
#include "pipeline/shade.h"
#include "tests/pipeline/shipped_picture.h"

namespace edgewise::test {

struct ShadedPicture {
    ShippedPicture picture;
    ScreenPieces pieces;
    ScreenScene screen;
    Shading shading;

    explicit ShadedPicture(const std::string& name)
        : picture(shippedPicture(name, 64)),
          screen(project(picture.scene, picture.camera, picture.film, pieces)),
          shading(picture.scene, picture.camera, picture.film, screen, pieces) {
        EXPECT_FALSE(screen.triangles.empty());
    }
    ShadedPicture(const ShadedPicture&) = delete;
};

/// Flat and lit, plain and textured.
inline auto shadedScenes() {
    return testing::Values("zone-plate", "log-grid", "torus-20k", "torus-sequence", "random-2k");
}

/// A pixel's centre in or around a triangle.
template <class Random>
glm::dvec2 sampleNear(const ScreenTriangle& t, Random& random) {
    std::uniform_real_distribution<double> near(-3.0, 3.0);
    const glm::dvec2 middle = (t.p_px[0] + t.p_px[1] + t.p_px[2]) / 3.0;
    return glm::floor(middle + glm::dvec2(near(random), near(random))) + 0.5;
}

}  // namespace edgewise::test
