// What is wrong with an SDF scene, before anyone knows the file's name.
#pragma once

#include <stdexcept>
#include <string>

namespace edgewise::sdf {

/// `element`: the path in the tree ("tree.children[3].radius") or the line of the GLSL; `rule`: what it
/// breaks.
class SceneError : public std::runtime_error {
  public:
    SceneError(const std::string& element_, const std::string& rule_)
        : std::runtime_error(element_ + ": " + rule_), element(element_), rule(rule_) {}
    std::string element, rule;
};

}  // namespace edgewise::sdf
