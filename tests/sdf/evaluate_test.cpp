#include "sdf/evaluate.h"

#include <gtest/gtest.h>

#include <random>

#include "sdf/scale_bounds.h"
#include "sdf/tree.h"

namespace edgewise::sdf {
namespace {

TEST(Evaluate, ASphereIsItsDistance) {
    Tree tree;
    tree.add(Kind::kSphere, {0.5});
    EXPECT_EQ(valueAt(lower(tree), glm::dvec3(3, 0, 4)), 4.5);
}

}  // namespace
}  // namespace edgewise::sdf
