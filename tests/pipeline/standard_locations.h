// The Vulkan specification's table "Standard sample locations" (chapter Rasterization, Multisampling), number
// by number: the witness of pipeline/sample_pattern.
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <vector>

namespace edgewise::test {

inline const std::map<int, std::vector<glm::dvec2>>& standardLocations() {
    static const std::map<int, std::vector<glm::dvec2>> table{
        {2, {{0.75, 0.75}, {0.25, 0.25}}},
        {4, {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}},
        {8,
         {{0.5625, 0.3125},
          {0.4375, 0.6875},
          {0.8125, 0.5625},
          {0.3125, 0.1875},
          {0.1875, 0.8125},
          {0.0625, 0.4375},
          {0.6875, 0.9375},
          {0.9375, 0.0625}}},
        {16,
         {{0.5625, 0.5625},
          {0.4375, 0.3125},
          {0.3125, 0.625},
          {0.75, 0.4375},
          {0.1875, 0.375},
          {0.625, 0.8125},
          {0.8125, 0.6875},
          {0.6875, 0.1875},
          {0.375, 0.875},
          {0.5, 0.0625},
          {0.25, 0.125},
          {0.125, 0.75},
          {0.0, 0.5},
          {0.9375, 0.25},
          {0.875, 0.9375},
          {0.0625, 0.0}}}};
    return table;
}

}  // namespace edgewise::test
